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

"""How fast a motion changes, and a motion moved along such a rate: for explicit integrators."""

from typing import NamedTuple

from .equations_of_motion import explicit_accelerations
from ..boat.state import Motion
from ..compiled import compiled
from ..rotation import normalise, product, rotation_matrix, to_body, to_world
from ..vectors import add_scaled, scale


class Rate(NamedTuple):
    """The rates of position, orientation, velocity in world axes, and angular velocity."""

    position: tuple
    orientation: tuple
    velocity: tuple
    angular_velocity: tuple


@compiled
def rate_of(boat, load, thrust, motion):
    """Return the `Rate` of a motion: x' = R v, q' = q (w, 0) / 2, R v' and w' from M a = f."""
    R, (x, y, z) = rotation_matrix(motion.orientation), scale(0.5, motion.angular_velocity)
    linear, angular = explicit_accelerations(
        boat, load, thrust, motion.body_velocity, motion.angular_velocity)
    return Rate(to_world(R, motion.body_velocity), product(motion.orientation, (x, y, z, 0.0)),
                to_world(R, linear), angular)


@compiled
def add_rates(a, s, b):
    """Return a + s b."""
    return Rate(add_scaled(a.position, s, b.position),
                add_scaled_quaternion(a.orientation, s, b.orientation),
                add_scaled(a.velocity, s, b.velocity),
                add_scaled(a.angular_velocity, s, b.angular_velocity))


@compiled
def moved(motion, rate, h):
    """Return a motion moved along a rate for h s, its quaternion normalised."""
    orientation = normalise(add_scaled_quaternion(motion.orientation, h, rate.orientation))
    moving = to_world(rotation_matrix(motion.orientation), motion.body_velocity)
    moving = add_scaled(moving, h, rate.velocity)
    return Motion(add_scaled(motion.position, h, rate.position), orientation,
                  to_body(rotation_matrix(orientation), moving),
                  add_scaled(motion.angular_velocity, h, rate.angular_velocity))


@compiled
def add_scaled_quaternion(p, s, q):
    """Return p + s q."""
    return (p[0] + s * q[0], p[1] + s * q[1], p[2] + s * q[2], p[3] + s * q[3])
