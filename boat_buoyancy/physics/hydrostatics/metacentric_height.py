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

"""Metacentric heights: how stiffly a boat at rest rights itself."""

from .natural_modes import equilibrium_stiffness, RESTORED
from .rest import floats


def metacentric_heights(boat):
    """
    Return the transverse and longitudinal metacentric heights GM in m of a boat at rest.

    The slope of the righting arms there about level axes, free to rise and sink.  None, None for
    a boat that does not float.
    """
    if not floats(boat):
        return None, None
    heave, roll, pitch = equilibrium_stiffness(boat)[RESTORED, RESTORED]

    def free_to_rise(row, angle):
        coupling = row[0] ** 2 / heave[0] if heave[0] > 0.0 else 0.0
        return float((row[angle] - coupling) / boat.weight)

    return free_to_rise(roll, 1), free_to_rise(pitch, 2)
