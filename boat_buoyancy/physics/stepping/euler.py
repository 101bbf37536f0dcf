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

"""The two Euler integrators, for study: explicit, and symplectic as in a plain game loop."""

from .arrival import arrival
from .equations_of_motion import damped_accelerations, explicit_accelerations
from .rates import add_scaled_quaternion, moved, rate_of
from ..boat.state import Motion
from ..compiled import compiled
from ..forces.damping import no_damping, retention
from ..rotation import normalise, product, rotation_matrix, to_body, to_world
from ..vectors import add_scaled, multiply, scale, subtract, times


@compiled
def euler(boat, hull, sea, waves, motion, load, thrust, t, h):
    """Return motion and load after h s, both from the old rates: never stable, for study."""
    motion = moved(motion, rate_of(boat, load, thrust, motion), h)
    return arrival(boat, hull, sea, waves, motion, load, t + h)


@compiled
def symplectic_euler(boat, hull, sea, waves, motion, load, thrust, t, h):
    """
    Return motion and load after h s of the plain game loop: v += a h; v *= 1 - d h; x += v h.

    First order, one force a step.  d is the rate of retention; all other damping is an explicit
    force in a.  Stable for w h < 2 and d h < 1.
    """
    body_velocity, spin = motion.body_velocity, motion.angular_velocity
    acceleration, spin_up = explicit_accelerations(boat, load, thrust, body_velocity, spin)
    # The load's damping holds the retention, too: give back what the factor will take.
    back = retained(boat, load, body_velocity, spin)
    body_velocity = add_scaled(add_scaled(body_velocity, h, acceleration), h, back[0])
    spin = add_scaled(add_scaled(spin, h, spin_up), h, back[1])
    lost = retained(boat, load, body_velocity, spin)
    body_velocity, spin = add_scaled(body_velocity, -h, lost[0]), add_scaled(spin, -h, lost[1])

    velocity = to_world(rotation_matrix(motion.orientation), body_velocity)
    position = add_scaled(motion.position, h, velocity)
    x, y, z = scale(0.5, spin)
    orientation = normalise(add_scaled_quaternion(
        motion.orientation, h, product(motion.orientation, (x, y, z, 0.0))))
    motion = Motion(position, orientation, to_body(rotation_matrix(orientation), velocity), spin)
    return arrival(boat, hull, sea, waves, motion, load, t + h)


@compiled
def retained(boat, load, body_velocity, spin):
    """Return what retention takes a second of a velocity relative to the water, M^-1 D u."""
    drag, spin_drag = retention(boat, load.wetness)
    return damped_accelerations(boat, load, no_damping(), 0.0, multiply(
        drag, subtract(body_velocity, load.water)), times(
            spin_drag, subtract(spin, load.turning)))
