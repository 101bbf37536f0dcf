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

"""
The guard of a simulation: motion that is not finite, or faster than any force can make it.

What becomes of a boat that does not pass is in `march`: it stands still in its last good state.
"""

import math

from ..compiled import compiled
from ..vectors import dot

# The bound is proved for the implicit integrator.  Others may pass it a little by their error;
# once unstable they pass it by orders of magnitude within a few steps.
MARGIN = 10.0
# No boat is farther away, in m, all three coordinates together; below, nothing that is computed
# of one can overflow.
FARTHEST = 1e100


@compiled
def slowest_reached(bound, period):
    """Return the |u|_M below which the power of moving water over the speed means nothing."""
    return math.sqrt(period * bound.power) + 1e-150


@compiled
def speed_reached(bound, reached, thrust, h):
    """
    Return the greatest |u|_M that forces can have given h s after it was ``reached``.

    At most F + P / |u| a second, and never past the bound's limit from below (see `speed_bound`).
    ``thrust`` as in `integrators.step`.
    """
    force = bound.force + math.sqrt(dot(thrust[0], thrust[0]))
    torque = bound.torque + math.sqrt(dot(thrust[1], thrust[1]))
    forcing = math.sqrt(force * force / bound.mass + torque * torque / bound.least_moment)
    forcing += bound.power_rate
    risen = reached + h * (forcing + bound.power / reached)
    if not bound.drag > 0.0:
        return risen
    limit = (forcing + math.sqrt(forcing * forcing + 4.0 * bound.drag * bound.power)) / (
        2.0 * bound.drag)
    return min(risen, max(reached, limit))


@compiled
def is_possible(bound, reached, motion):
    """Return whether a motion is finite and its speed possible after |u|_M ``reached``."""
    (x, y, z), (a, b, c, d), v, w = motion
    # The least moment stands for all three; what is infinite or no number makes the sum one.
    squared = (bound.mass * dot(v, v) + bound.least_moment * dot(w, w)
               + 0.0 * (a + b + c + d))
    allowed = MARGIN * reached + bound.carried
    return squared < allowed * allowed and abs(x) + abs(y) + abs(z) < FARTHEST
