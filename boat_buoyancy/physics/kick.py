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
Changes of velocity at a fixed place: accelerations, and Crank-Nicolson for damping.

Velocities are pairs (velocity, angular_velocity) of three components each in body axes.
"""

from .forces import DampingMatrix
from .linear import factor_ldl_3, solve_ldl_3


def with_drag(system, load, velocity, angular_velocity):
    """
    Return damping matrix and force with quadratic drag at the speed given, linear in velocity.

    Speed is relative to the water for the three axes of the force.  Without quadratic
    coefficients both are the load's own.
    """
    if system.quadratic is None:
        return load.damping, load.force
    relative = [v - w for v, w in zip(velocity, load.water_velocity)]
    drag = [load.submersion * q * abs(u)
            for q, u in zip(system.quadratic, (*relative, *angular_velocity))]
    linear, coupling, angular = load.damping
    damping = DampingMatrix(
        tuple(a + d for a, d in zip(linear, drag)), coupling,
        tuple(a + d for a, d in zip(angular[:3], drag[3:])) + tuple(angular[3:]))
    force = tuple(f + d * w for f, d, w in zip(load.force, drag, load.water_velocity))
    return damping, force


def net_wrench(damping, force, torque, thrust, velocity, angular_velocity):
    """Return force (3) N and torque (3) N m on a moving boat, damping included."""
    (ax, ay, az), (sx, sy, sz), (xx, yy, zz, xy, xz, yz) = damping
    vx, vy, vz = velocity
    wx, wy, wz = angular_velocity
    fx, fy, fz, tx, ty, tz = thrust
    return ((force[0] + fx - ax * vx - (wy * sz - wz * sy),
             force[1] + fy - ay * vy - (wz * sx - wx * sz),
             force[2] + fz - az * vz - (wx * sy - wy * sx)),
            (torque[0] + tx - (sy * vz - sz * vy) - (xx * wx + xy * wy + xz * wz),
             torque[1] + ty - (sz * vx - sx * vz) - (xy * wx + yy * wy + yz * wz),
             torque[2] + tz - (sx * vy - sy * vx) - (xz * wx + yz * wy + zz * wz)))


def factor(system, damping, half_step):
    """
    Return the factors of M + half_step C, for `solve`: inverse force block, lever, torque block.

    The force block is diagonal and is eliminated first; what is left for the rotation is a
    symmetric positive definite 3 x 3 matrix (its Schur complement).
    """
    mass = system.mass
    (ax, ay, az), (sx, sy, sz), (xx, yy, zz, xy, xz, yz) = damping
    ixx, iyy, izz, ixy, ixz, iyz = system.inertia
    ix, iy, iz = (1.0 / (mass + half_step * ax), 1.0 / (mass + half_step * ay),
                  1.0 / (mass + half_step * az))
    x, y, z = half_step * sx, half_step * sy, half_step * sz
    return (ix, iy, iz), (x, y, z), factor_ldl_3(
        ixx + half_step * xx - z * z * iy - y * y * iz,
        iyy + half_step * yy - z * z * ix - x * x * iz,
        izz + half_step * zz - y * y * ix - x * x * iy,
        ixy + half_step * xy + x * y * iz,
        ixz + half_step * xz + x * z * iy,
        iyz + half_step * yz + y * z * ix)


def solve(factors, force, torque):
    """Return the accelerations (3), (3) of (M + dt/2 C) a = (force, torque)."""
    (ix, iy, iz), (sx, sy, sz), lower = factors
    fx, fy, fz = force
    tx, ty, tz = torque
    # Written out, as this runs twice a step: with the lever S, torque - S x (force / m) first,
    # then (force + S x angular) / m.
    fx, fy, fz = ix * fx, iy * fy, iz * fz
    ax, ay, az = angular = solve_ldl_3(
        lower, tx - (sy * fz - sz * fy), ty - (sz * fx - sx * fz), tz - (sx * fy - sy * fx))
    return (fx + ix * (sy * az - sz * ay), fy + iy * (sz * ax - sx * az),
            fz + iz * (sx * ay - sy * ax)), angular


def accelerations(system, load, thrust, velocity, angular_velocity):
    """Return the accelerations of all explicit forces, without the gyroscopic torque."""
    damping, force = with_drag(system, load, velocity, angular_velocity)
    return solve(factor(system, damping, 0.0), *net_wrench(
        damping, force, load.torque, thrust, velocity, angular_velocity))


def advance(values, rates, dt):
    """Return values + dt * rates of three components."""
    (x, y, z), (a, b, c) = values, rates
    return x + dt * a, y + dt * b, z + dt * c


def crank_nicolson(system, load, factors, thrust, velocity, angular_velocity, dt):
    """
    Return velocity and angular velocity after a kick of ``dt`` s at one place.

    (M + dt/2 C) u+ = (M - dt/2 C) u + dt f: stable at any damping.  ``factors`` are those of
    dt/2 and the load's own damping.  With quadratic drag the speed is taken at the middle of
    the kick, in two passes, which keeps second order.
    """
    if system.quadratic is None:
        return _kicked(load.damping, load.force, load.torque, factors, thrust,
                       velocity, angular_velocity, dt)
    middle = velocity, angular_velocity
    for _ in range(2):
        damping, force = with_drag(system, load, *middle)
        new = _kicked(damping, force, load.torque, factor(system, damping, 0.5 * dt), thrust,
                      velocity, angular_velocity, dt)
        middle = tuple(tuple(0.5 * (a + b) for a, b in zip(old, late))
                       for old, late in zip((velocity, angular_velocity), new))
    return new


def _kicked(damping, force, torque, factors, thrust, velocity, angular_velocity, dt):
    force, torque = net_wrench(damping, force, torque, thrust, velocity, angular_velocity)
    (ax, ay, az), (p, q, r) = solve(factors, force, torque)
    x, y, z = velocity
    u, v, w = angular_velocity
    return ((x + dt * ax, y + dt * ay, z + dt * az), (u + dt * p, v + dt * q, w + dt * r))
