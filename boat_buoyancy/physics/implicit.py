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

"""The implicit step method: stable at any step, stiffness and damping."""

from . import kick
from .forces import buoyancy
from .linear import factor_blocks, solve_blocks, symmetric_product
from .motion import begin, Motion
from .quaternion import cross, to_body, to_world


def lift_stiffness(system, load):
    """
    Return K+ as its force block (6), coupling block (9) and torque block (6), body axes.

    K+ = sum k_i J_i^T z z^T J_i over the probes on the slope of their spring, at the point of
    force p_i: the positive part of the stiffness, which no heel or cap makes indefinite.
    J_i^T z is (up, p_i x up), so that sums of k_i, k_i p_i and k_i p_i p_i^T are all it takes.
    To it comes the pendulum of a boat hung below its points of force, sum F_i p_i.up, when that
    is positive.
    """
    backend, arrays, share = system.backend, system.arrays, load.share
    ux, uy, uz = up = load.rotation[6:]
    slope = system.law.slope(backend, arrays.heights, share, load.depth, uz)
    height = arrays.above
    if system.law.has_arm:
        half = arrays.half_height * share
        height = height + backend.where(uz > 0.0, half, 2.0 * arrays.half_height - half)
    raised = slope * height
    k, x, y, xx, yy, xy = backend.components(arrays.stiffness_rows.dot(slope))
    z, xz, yz = backend.components(arrays.stiffness_rows[:3].dot(raised))
    zz, = backend.components(arrays.stiffness_rows[:1].dot(raised * height))
    lx, ly, lz = cross((x, y, z), up)
    # Sum k (p x up)(p x up)^T: rows of the second moments crossed with up, then columns.
    ax, ay, az = cross((xx, xy, xz), up)
    bx, by, bz = cross((xy, yy, yz), up)
    cx, cy, cz = cross((xz, yz, zz), up)
    _, (mx, my, mz) = buoyancy(system, share, uz)
    swing = backend.maximum(mx * ux + my * uy + mz * uz, 0.0)
    return ((k * ux * ux, k * uy * uy, k * uz * uz, k * ux * uy, k * ux * uz, k * uy * uz),
            (lx * ux, lx * uy, lx * uz, ly * ux, ly * uy, ly * uz, lz * ux, lz * uy, lz * uz),
            (bx * uz - cx * uy + swing * (1.0 - ux * ux),
             cy * ux - ay * uz + swing * (1.0 - uy * uy),
             az * uy - bz * ux + swing * (1.0 - uz * uz),
             cx * ux - ax * uz - swing * ux * uy, ax * uy - bx * ux - swing * ux * uz,
             ay * uy - by * ux - swing * uy * uz))


def implicit(system, sea, motion, memory, thrust, time, h):
    """
    Semi-implicit Euler, (M + h C + h^2 K+) u+ = M u + h f, then drift.

    First order, one force per step; stable for every step, stiffness and damping, with a proven
    bound (see `bound`).  For stiff boats; it damps free oscillation.
    """
    backend, load = system.backend, memory.load
    damping, force = kick.with_drag(system, load, motion.velocity, motion.angular_velocity)
    pull, twist = kick.net_wrench(damping, force, load.torque, thrust,
                                  motion.velocity, motion.angular_velocity)
    stiffness = lift_stiffness(system, load)
    # In the unknown (u+ - u) / h the spring's own term is -h K+ u.
    sprung, wrung = _product(stiffness, motion.velocity, motion.angular_velocity)
    linear, angular = solve_blocks(
        factor_blocks(*_implicit_matrix(system, damping, stiffness, h)),
        kick.advance(pull, sprung, -h), kick.advance(twist, wrung, -h))
    moving = to_world(load.rotation, kick.advance(motion.velocity, linear, h))
    spin = kick.advance(motion.angular_velocity, angular, h)

    orientation, turned = system.rotate(backend, motion.orientation, spin, h)
    # The splitting keeps angular momentum, not energy; the bound needs energy to be kept, and
    # scaling only downwards would let it leak away.
    before, after = _rotational_energy(system, spin), _rotational_energy(system, turned)
    scale = backend.sqrt(before / (after + 1e-300))
    x, y, z = turned
    position = kick.advance(motion.position, moving, h)
    memory = begin(system, sea, position, orientation, time + h, h)
    return Motion(position, orientation, to_body(memory.load.rotation, moving),
                  (x * scale, y * scale, z * scale)), memory


def _implicit_matrix(system, damping, stiffness, h):
    """Return force, coupling and torque block of M + h C + h^2 K."""
    linear, (sx, sy, sz), angular = damping
    force, coupling, torque = stiffness
    m, hh = system.mass, h * h
    ax, ay, az = linear
    kxx, kyy, kzz, kxy, kxz, kyz = force
    xx, xy, xz, yx, yy, yz, zx, zy, zz = coupling
    return ((m + h * ax + hh * kxx, m + h * ay + hh * kyy, m + h * az + hh * kzz,
             hh * kxy, hh * kxz, hh * kyz),
            # The damping's coupling is the matrix of S x.
            (hh * xx, hh * xy - h * sz, hh * xz + h * sy,
             hh * yx + h * sz, hh * yy, hh * yz - h * sx,
             hh * zx - h * sy, hh * zy + h * sx, hh * zz),
            tuple([i + h * c + hh * k for i, c, k in zip(system.inertia, angular, torque)]))


def _product(blocks, velocity, spin):
    """Return the force and torque of a 6 x 6 matrix in blocks times a velocity."""
    force, (a, b, c, d, e, f, g, h, i), torque = blocks
    x, y, z = velocity
    p, q, r = spin
    sx, sy, sz = symmetric_product(force, velocity)
    tx, ty, tz = symmetric_product(torque, spin)
    return ((sx + a * p + d * q + g * r, sy + b * p + e * q + h * r, sz + c * p + f * q + i * r),
            (tx + a * x + b * y + c * z, ty + d * x + e * y + f * z, tz + g * x + h * y + i * z))


def _rotational_energy(system, spin):
    """Return the rotational kinetic energy in J."""
    x, y, z = spin
    a, b, c = symmetric_product(system.inertia, spin)
    return 0.5 * (x * a + y * b + z * c)
