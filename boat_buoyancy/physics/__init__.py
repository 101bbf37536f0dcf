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
The physics of boats that float, in NumPy and without ROS.

``load_scene`` turns a parameter file into a `Scene`, whose ``simulation()`` steps a `Boat`, or a
fleet, on its `Sea`.  SI units, world x east, y north, z up, z = 0 the mean water level; body
axes x forward, y left, z up; quaternions (x, y, z, w), body to world; angles in radians.
"""

from .boat import Boat, Damping, State
from .hull import Hull
from .scene import load_scene, Scene
from .simulation import Simulation, SimulationError
from .waves import Sea

__all__ = ['Boat', 'Damping', 'Hull', 'Scene', 'Sea', 'Simulation', 'SimulationError', 'State',
           'load_scene']
