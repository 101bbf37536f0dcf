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

"""Free motion of a rigid body, and of the water that it takes along, over one step."""

from .free_rotation import free_rotation
from ..boat.state import Motion
from ..compiled import compiled
from ..forces.added_mass import mass_in_force, munk
from ..rotation import rotation_matrix, to_body, to_world
from ..vectors import (add, add_scaled, divide, dot, factor, multiply, solve_factored, subtract,
                       three, times)


@compiled
def free_motion(boat, load, motion, h):
    """
    Return the `Motion` after h s without any force, the mass that of ``load``.

    x' = R v.  Without added mass v stays as it is in the world.  With it (Kirchhoff, velocities
    relative to the stream) the momentum P = R M v does, and the angular momentum changes by
    (M v) x v: halves of that and of the way before and after the turns.
    """
    position, orientation, velocity, spin = motion
    R = rotation_matrix(orientation)
    if boat.has_added_mass == 0 or load.wetness == 0.0:
        moving = to_world(R, velocity)
        axes = three(boat.axis_1), three(boat.axis_2), three(boat.axis_3)
        position = add_scaled(position, h, moving)
        orientation, spin = free_rotation(three(boat.moments), axes, orientation, spin, h)
        return Motion(position, orientation, to_body(rotation_matrix(orientation), moving), spin)

    mass, inertia = mass_in_force(boat, load.wetness)
    factors, stream = factor(inertia), to_world(R, load.stream)
    position = add_scaled(position, 0.5 * h, to_world(R, velocity))
    relative = subtract(velocity, load.stream)
    spin = add_scaled(spin, 0.5 * h, solve_factored(factors, munk(mass, relative)))
    momentum = to_world(R, multiply(mass, relative))
    # The axes are those of the boat all wet: what a skewed tensor has besides, part wet, is left
    # out of the turns.
    axes = three(boat.wet_axis_1), three(boat.wet_axis_2), three(boat.wet_axis_3)
    moments = (dot(axes[0], times(inertia, axes[0])), dot(axes[1], times(inertia, axes[1])),
               dot(axes[2], times(inertia, axes[2])))
    orientation, spin = free_rotation(moments, axes, orientation, spin, h)
    R = rotation_matrix(orientation)
    relative = divide(to_body(R, momentum), mass)
    spin = add_scaled(spin, 0.5 * h, solve_factored(factors, munk(mass, relative)))
    velocity = add(relative, to_body(R, stream))
    return Motion(add_scaled(position, 0.5 * h, to_world(R, velocity)), orientation, velocity,
                  spin)
