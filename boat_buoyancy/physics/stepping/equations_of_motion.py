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
Newton and Euler: M a = f - C u, M = diag(m, m, m, I), about the centre of mass in body axes.

With added mass M is that in force (Kirchhoff), as `forces.added_mass` has it.  Velocities and
wrenches are pairs of vectors, of translation and of rotation.
"""

from ..compiled import compiled
from ..forces.added_mass import mass_in_force, munk
from ..forces.damping import coupled_force, coupled_torque, damping_wrench
from ..forces.load import at_speed
from ..vectors import (add, add_scaled_matrix, cross, factor, multiply, scale_matrix,
                       solve_factored, subtract, times)


@compiled
def net_wrench(damping, force, torque, thrust, body_velocity, angular_velocity):
    """Return f - C u: force N and torque N m on a moving boat, thrust and damping included."""
    drag, drag_torque = damping_wrench(damping, body_velocity, angular_velocity)
    return (subtract(add(force, thrust[0]), drag),
            subtract(add(torque, thrust[1]), drag_torque))


@compiled
def damped_accelerations(boat, load, damping, s, force, torque):
    """
    Return a of (M + s C) a = (force, torque): M^-1 f with s = 0, Crank-Nicolson with dt / 2.

    The force block is diagonal, with inverse n: it is eliminated, which leaves for the rotation
    I + s angular - B n B^T, B = s coupling: symmetric and positive definite.
    """
    m, inertia = mass_in_force(boat, load.wetness)
    n = (1.0 / (m[0] + s * damping.linear[0]), 1.0 / (m[1] + s * damping.linear[1]),
         1.0 / (m[2] + s * damping.linear[2]))
    B = (xy, xz, yx, yz, zx, zy) = scale_matrix(s, damping.coupling)
    left = add_scaled_matrix(inertia, s, damping.angular)
    left = add_scaled_matrix(left, -1.0, (
        xy * xy * n[1] + xz * xz * n[2], yx * yx * n[0] + yz * yz * n[2],
        zx * zx * n[0] + zy * zy * n[1], xz * yz * n[2], xy * zy * n[1], yx * zx * n[0]))
    moving = multiply(n, force)
    turning = solve_factored(factor(left), subtract(torque, coupled_torque(B, moving)))
    return subtract(moving, multiply(n, coupled_force(B, turning))), turning


@compiled
def explicit_accelerations(boat, load, thrust, body_velocity, angular_velocity):
    """Return linear and angular acceleration, body axes, the gyroscopic torque included."""
    damping, force, torque = at_speed(boat, load, body_velocity, angular_velocity)
    force, torque = net_wrench(damping, force, torque, thrust, body_velocity,
                               angular_velocity)
    mass, inertia = mass_in_force(boat, load.wetness)
    spin = angular_velocity
    torque = subtract(torque, cross(spin, times(inertia, spin)))
    if boat.has_added_mass == 0:
        return damped_accelerations(boat, load, damping, 0.0, force, torque)
    # The momentum M v turns with the boat, v relative to the stream.
    relative = subtract(body_velocity, load.stream)
    momentum = multiply(mass, relative)
    linear, angular = damped_accelerations(
        boat, load, damping, 0.0, subtract(force, cross(spin, momentum)),
        add(torque, munk(mass, relative)))
    return add(linear, cross(spin, relative)), angular
