# Copyright 2026 boat_buoyancy maintainers
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""Righting arms: what rights a heeled boat, from upright to upside down."""

import math

import numpy as np

from .rest import floats, rest_state, still_load


def righting_arms(boat, heel):
    """
    Return the righting arm GZ (n,) m at each angle of ``heel`` (n,) rad, NaN for one that sinks.

    -(roll torque about the centre of mass) / (m g), free to rise and sink, trim 0; positive when
    it rights a positive heel.  The model's own: what the simulation does.
    """
    heel = np.asarray(heel, float)
    if not floats(boat):
        return np.full(heel.shape, math.nan)
    rest = rest_state(boat, roll=heel.ravel())
    torque = [still_load(boat, rest[i])[0].torque[0] for i in range(heel.size)]
    return -np.reshape(torque, heel.shape) / boat.weight


def wall_sided_heel(beam, depth, draft):
    """
    Return the heel in rad at which a box's deck edge dips or its bilge comes out of the water.

    ``beam``, ``depth`` and ``draft`` m.  Up to there its sides are vertical walls through the
    water and columns at Gauss points give its righting arm without error.
    """
    return math.atan(2.0 * min(depth - draft, draft) / beam)
