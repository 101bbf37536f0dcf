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

"""The implicit integrator: stable at any step, stiffness and damping, with a proven bound."""

import math

from .arrival import arrival
from .equations_of_motion import net_wrench
from .free_motion import free_motion
from ..boat.state import Motion
from ..compiled import compiled
from ..forces.added_mass import mass_in_force
from ..forces.buoyancy import lift_stiffness
from ..forces.load import at_speed
from ..rotation import rotation_matrix, to_body, to_world
from ..vectors import (add_scaled, add_scaled_matrix, diagonal, dot, factor, multiply, outer,
                       scale, scale_matrix, solve_factored, subtract, times)


@compiled
def implicit(boat, hull, sea, waves, motion, load, thrust, t, h):
    """
    Return motion and load after h s of (M + h C + h^2 K+) u+ = M u + h f, then a drift.

    First order, one force a step.  For stiff boats; it damps free oscillation.  Solved for
    (u+ - u) / h, where the spring's own term is -h K+ u.
    """
    v, w = motion.body_velocity, motion.angular_velocity
    R = rotation_matrix(motion.orientation)
    up = R[2]
    damping, force, torque = at_speed(boat, load, v, w)
    force, torque = net_wrench(damping, force, torque, thrust, v, w)
    k, lever, K = lift_stiffness(boat, hull, R)
    # K+ u, with the speed up that the springs feel: k up.v + l.w.
    sprung = scale(k * dot(up, v) + dot(lever, w), up)
    wrung = add_scaled(times(K, w), dot(up, v), lever)
    mass, inertia = mass_in_force(boat, load.wetness)
    acceleration, spin_up = solve_implicit(
        mass, inertia, damping, up, k, lever, K, h, add_scaled(force, -h, sprung),
        add_scaled(torque, -h, wrung))
    before = Motion(motion.position, motion.orientation, add_scaled(v, h, acceleration),
                    add_scaled(w, h, spin_up))
    motion = with_energy_of(boat, load, before, free_motion(boat, load, before, h))
    return arrival(boat, hull, sea, waves, motion, load, t + h)


@compiled
def with_energy_of(boat, load, before, after):
    """
    Return a `Motion` ``after`` a free one, its kinetic energy that of ``before``.

    A free motion keeps momentum to round-off, and energy only nearly; the bound needs energy to
    be kept, and scaling only downwards would let it leak away.
    """
    mass, inertia = mass_in_force(boat, load.wetness)
    spin, turned = before.angular_velocity, after.angular_velocity
    was, is_now = dot(spin, times(inertia, spin)), dot(turned, times(inertia, turned))
    if boat.has_added_mass == 0:
        return Motion(after.position, after.orientation, after.body_velocity,
                      scale(math.sqrt(was / (is_now + 1e-300)), turned))
    stream = to_body(rotation_matrix(after.orientation), to_world(
        rotation_matrix(before.orientation), load.stream))
    moved = subtract(before.body_velocity, load.stream)
    moving = subtract(after.body_velocity, stream)
    part = math.sqrt((was + dot(moved, multiply(mass, moved))) / (
        is_now + dot(moving, multiply(mass, moving)) + 1e-300))
    return Motion(after.position, after.orientation, add_scaled(stream, part, moving),
                  scale(part, turned))


@compiled
def solve_implicit(mass, inertia, damping, up, k, lever, K, h, force, torque):
    """
    Return a of (M + h C + h^2 K+) a = (force, torque), by blocks.

    With F = m + h diag(linear) + h^2 k up up^T, B = h coupling + h^2 l up^T,
    T = I + h angular + h^2 K: (T - B F^-1 B^T) a_w = torque - B F^-1 force, then
    a_v = F^-1 (force - B^T a_w).
    """
    hh = h * h
    F = add_scaled_matrix(diagonal(mass), h, diagonal(damping.linear))
    F = factor(add_scaled_matrix(F, hh * k, outer(up)))
    T = add_scaled_matrix(add_scaled_matrix(inertia, h, damping.angular), hh, K)
    xy, xz, yx, yz, zx, zy = scale_matrix(h, damping.coupling)
    lx, ly, lz = scale(hh, lever)
    # The rows of B.
    bx = add_scaled((0.0, xy, xz), lx, up)
    by = add_scaled((yx, 0.0, yz), ly, up)
    bz = add_scaled((zx, zy, 0.0), lz, up)
    fx, fy, fz = solve_factored(F, bx), solve_factored(F, by), solve_factored(F, bz)
    T = add_scaled_matrix(T, -1.0, (dot(bx, fx), dot(by, fy), dot(bz, fz),
                                    dot(bx, fy), dot(bx, fz), dot(by, fz)))
    moving = solve_factored(F, force)
    turning = solve_factored(factor(T), subtract(torque, (
        dot(bx, moving), dot(by, moving), dot(bz, moving))))
    p, q, r = turning
    moving = add_scaled(add_scaled(add_scaled(moving, -p, fx), -q, fy), -r, fz)
    return moving, turning
