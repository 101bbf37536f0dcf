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
Wind: drag in the air on the whole boat, wet or dry, quadratic in its speed relative to the air.

Surge -X |u_a| u_a and sway -Y |v_a| v_a in body axes, (u_a, v_a) the velocity less the wind's.
The side force acts at a point l ahead of the centre of mass: v_a is taken there, v + l r less the
wind's, and its torque is N |v_a| v_a with N = Y l.  N < 0 turns the bow into the wind.
"""

from .damping import with_point
from ..compiled import compiled
from ..vectors import add, cross, multiply


@compiled
def air_speed(boat, wind, body_velocity, angular_velocity):
    """Return u_a and v_a, m/s; all velocities in body axes."""
    return (body_velocity[0] - wind[0],
            body_velocity[1] + boat.wind_arm * angular_velocity[2] - wind[1])


@compiled
def with_air_drag(boat, wind, damping, force, torque, body_velocity, angular_velocity):
    """
    Return damping matrix, force and torque with the drag in the air at the speed given.

    Linear in velocity: -c (u_P - w) at the point P, c = X |u_a| and Y |v_a|.  C is positive
    semi-definite, as that of any damping point.
    """
    u, v = air_speed(boat, wind, body_velocity, angular_velocity)
    c = (boat.wind_drag[0] * abs(u), boat.wind_drag[1] * abs(v), 0.0)
    place, pull = (boat.wind_arm, 0.0, 0.0), multiply(c, wind)
    return with_point(damping, c, place), add(force, pull), add(torque, cross(place, pull))
