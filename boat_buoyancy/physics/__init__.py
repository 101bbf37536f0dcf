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
The physics of boats that float, without ROS: NumPy, and Numba where it is installed.

``load_scene`` turns a parameter file into a `Scene`, whose ``simulation()`` steps a `Boat` on its
`Sea`; ``load_fleet`` steps many.  SI units, world x east, y north, z up, z = 0 the mean water
level; body axes x forward, y left, z up; quaternions (x, y, z, w), body to world; angles in
radians.
"""

from .boat.boat import Boat, Damping
from .boat.hull import Hull
from .boat.state import State
from .forces.thrusters import Propulsion, Thruster
from .scene.scene import load_fleet, load_scene, Scene
from .sea.waves import Sea
from .stepping.fleet import Fleet
from .stepping.simulation import Simulation, SimulationError
from .stepping.trajectory import Trajectory

__all__ = ['Boat', 'Damping', 'Fleet', 'Hull', 'load_fleet', 'load_scene', 'Propulsion', 'Scene',
           'Sea', 'Simulation', 'SimulationError', 'State', 'Thruster', 'Trajectory']
