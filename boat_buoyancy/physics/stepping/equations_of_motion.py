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

Velocities and wrenches are pairs of vectors, of translation and of rotation.
"""

from ..compiled import compiled
from ..forces.damping import coupled_force, coupled_torque, damping_wrench
from ..forces.load import at_speed
from ..vectors import (add, add_scaled_matrix, cross, factor, multiply, scale_matrix, six,
                       solve_factored, subtract, times)


@compiled
def net_wrench(damping, force, torque, thrust, body_velocity, angular_velocity):
    """Return f - C u: force N and torque N m on a moving boat, thrust and damping included."""
    drag, drag_torque = damping_wrench(damping, body_velocity, angular_velocity)
    return (subtract(add(force, thrust[0]), drag),
            subtract(add(torque, thrust[1]), drag_torque))


@compiled
def damped_accelerations(boat, damping, s, force, torque):
    """
    Return a of (M + s C) a = (force, torque): M^-1 f with s = 0, Crank-Nicolson with dt / 2.

    The force block is diagonal, with inverse n: it is eliminated, which leaves for the rotation
    I + s angular - B n B^T, B = s coupling: symmetric and positive definite.
    """
    m = boat.mass
    n = (1.0 / (m + s * damping.linear[0]), 1.0 / (m + s * damping.linear[1]),
         1.0 / (m + s * damping.linear[2]))
    B = (xy, xz, yx, yz, zx, zy) = scale_matrix(s, damping.coupling)
    left = add_scaled_matrix(six(boat.inertia), s, damping.angular)
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
    gyroscopic = cross(angular_velocity, times(six(boat.inertia), angular_velocity))
    return damped_accelerations(boat, damping, 0.0, force, subtract(torque, gyroscopic))
