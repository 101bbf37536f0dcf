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
The step methods, one signature.

Each is a `Method` with a function (system, sea, motion, memory, thrust, time, h) -> (motion,
memory), pure, for one boat and a fleet.  ``memory`` is the load at the motion's own place and
time (and what the method wants to keep with it), so that every force is computed once.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from . import kick
from .forces import buoyancy, evaluate, Load, mixed
from .linear import factor_blocks, solve_blocks
from .quaternion import cross, multiply, normalise, to_body, to_world


class Motion(NamedTuple):
    """
    A state in components, as the step carries it.

    ``position`` (3) world and ``orientation`` (4); ``velocity`` (3) and ``angular_velocity`` (3)
    in body axes; all of the centre of mass.
    """

    position: tuple
    orientation: tuple
    velocity: tuple
    angular_velocity: tuple


class Memory(NamedTuple):
    """What a step leaves for the next: the `Load` of the new motion, and leapfrog's factors."""

    load: Load
    factors: object = None


@dataclass(frozen=True)
class Method:
    """
    A step method.

    ``step`` as in the module's docstring; ``order`` on smooth motion; ``evaluations`` of the
    force per step; ``begin`` (system, sea, position, orientation, time, h) -> memory for a
    first step.
    """

    name: str
    step: Callable
    order: int
    evaluations: int
    begin: Callable


def _begin(system, sea, position, orientation, time, h):
    return Memory(evaluate(system, sea, position, orientation, time))


def _begin_leapfrog(system, sea, position, orientation, time, h):
    load = evaluate(system, sea, position, orientation, time)
    # With quadratic drag the matrix depends on the speed and cannot be kept.
    if system.quadratic is not None:
        return Memory(load)
    return Memory(load, kick.factor(system, load.damping, 0.25 * h))


def leapfrog(system, sea, motion, memory, thrust, time, h):
    """
    Kick-drift-kick (Stoermer-Verlet), damping by Crank-Nicolson in the kicks.

    Second order, one force per step, no energy drift; stable for w h < 2 at any damping.
    The default: best for waves and drops.
    """
    backend = system.backend
    velocity, spin = kick.crank_nicolson(
        system, *memory, thrust, motion.velocity, motion.angular_velocity, 0.5 * h)
    moving = to_world(memory.load.rotation, velocity)
    orientation, spin = system.rotate(backend, motion.orientation, spin, h)
    position = kick.advance(motion.position, moving, h)
    memory = _begin_leapfrog(system, sea, position, orientation, time + h, h)
    velocity, spin = kick.crank_nicolson(
        system, *memory, thrust, to_body(memory.load.rotation, moving), spin, 0.5 * h)
    return Motion(position, orientation, velocity, spin), memory


def lift_stiffness(system, load):
    """
    Return K+ as its force block (6), coupling block (9) and torque block (6), body axes.

    K+ = sum k_i J_i^T z z^T J_i over the probes on the slope of their spring, at the point of
    force p_i: the positive part of the stiffness, which no heel or cap makes indefinite.
    J_i^T z is (up, p_i x up), so that sums of k_i, k_i p_i and k_i p_i p_i^T are all it takes.
    To it comes the pendulum of a boat hung below its points of force, sum F_i p_i.up, when that
    is positive.
    """
    backend, arrays, wetting = system.backend, system.arrays, load.wetting
    ux, uy, uz = up = load.rotation[6:]
    slope = system.law.slope(backend, arrays.inverse_height, wetting, load.depth, uz)
    height = arrays.homogeneous[:, 2:3]
    if system.law.has_arm:
        half = arrays.half_height * wetting.share
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
    _, (mx, my, mz) = buoyancy(system, wetting, uz)
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
    memory = _begin(system, sea, position, orientation, time + h, h)
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


def symmetric_product(matrix, vector):
    """Return A v of a symmetric 3 x 3 matrix xx, yy, zz, xy, xz, yz."""
    xx, yy, zz, xy, xz, yz = matrix
    x, y, z = vector
    return (xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z)


def _rotational_energy(system, spin):
    """Return the rotational kinetic energy in J."""
    x, y, z = spin
    a, b, c = symmetric_product(system.inertia, spin)
    return 0.5 * (x * a + y * b + z * c)


def _spinning(orientation, spin):
    """Return dq/dt = q w / 2."""
    return tuple(0.5 * c for c in multiply(orientation, (*spin, 0.0)))


def _gyroscopic(system, thrust, spin):
    """Return the thrust wrench with the gyroscopic torque -w x I w added."""
    torque = cross(spin, symmetric_product(system.inertia, spin))
    return (*thrust[:3], *(t - g for t, g in zip(thrust[3:], torque)))


def _derivative(system, load, thrust, motion):
    """Return d/dt of position, orientation, world velocity and body angular velocity."""
    linear, angular = kick.accelerations(
        system, load, _gyroscopic(system, thrust, motion.angular_velocity),
        motion.velocity, motion.angular_velocity)
    return (*to_world(load.rotation, motion.velocity),
            *_spinning(motion.orientation, motion.angular_velocity),
            *to_world(load.rotation, linear), *angular)


def _advance(values, rates, h):
    """Return values + h * rates of any number of components."""
    return tuple([y + h * f for y, f in zip(values, rates)])


def _inertial(motion, load):
    """Return the 13 numbers of a motion with the velocity in world axes."""
    return (*motion.position, *motion.orientation,
            *to_world(load.rotation, motion.velocity), *motion.angular_velocity)


def _evaluated(system, sea, values, time):
    """Return the motion of `_inertial` numbers, and its load."""
    orientation = normalise(system.backend, values[3:7])
    load = evaluate(system, sea, values[:3], orientation, time)
    return Motion(values[:3], orientation, to_body(load.rotation, values[7:10]),
                  values[10:]), load


def rk4(system, sea, motion, memory, thrust, time, h):
    """
    Classic fourth-order Runge-Kutta, four forces per step; stable for w h < 2.83.

    For smooth motion to high accuracy; a kink (entry, cap) takes it to second order.
    """
    start = _inertial(motion, memory.load)
    slopes = [_derivative(system, memory.load, thrust, motion)]
    for part in (0.5, 0.5, 1.0):
        stage, load = _evaluated(system, sea, _advance(start, slopes[-1], part * h),
                                 time + part * h)
        slopes.append(_derivative(system, load, thrust, stage))
    values = tuple(y + h / 6.0 * (a + 2.0 * (b + c) + d)
                   for y, a, b, c, d in zip(start, *slopes))
    motion, load = _evaluated(system, sea, values, time + h)
    return motion, Memory(load)


def euler(system, sea, motion, memory, thrust, time, h):
    """Explicit Euler, velocity and position from the old state: never stable, for study."""
    values = _advance(_inertial(motion, memory.load),
                      _derivative(system, memory.load, thrust, motion), h)
    motion, load = _evaluated(system, sea, values, time + h)
    return motion, Memory(load)


def symplectic_euler(system, sea, motion, memory, thrust, time, h):
    """
    Take the plain game loop: v += a h; v *= 1 - drag h; x += v h.

    First order, one force per step; all but the retention drag is an explicit force.  Stable for
    w h < 2 and drag h < 1.
    """
    load = memory.load
    retention = mixed(system.retention, load.submersion)
    linear, angular = kick.accelerations(
        system, load, _gyroscopic(system, thrust, motion.angular_velocity),
        motion.velocity, motion.angular_velocity)
    # The load's damping holds the retention too: give back what the factor will take.
    back = _retained(system, load, retention, motion.velocity, motion.angular_velocity)
    velocity = kick.advance(kick.advance(motion.velocity, linear, h), back[0], h)
    spin = kick.advance(kick.advance(motion.angular_velocity, angular, h), back[1], h)
    lost = _retained(system, load, retention, velocity, spin)
    moving = to_world(load.rotation, kick.advance(velocity, lost[0], -h))
    spin = kick.advance(spin, lost[1], -h)
    orientation = normalise(system.backend, _advance(
        motion.orientation, _spinning(motion.orientation, spin), h))
    position = kick.advance(motion.position, moving, h)
    memory = _begin(system, sea, position, orientation, time + h, h)
    return Motion(position, orientation, to_body(memory.load.rotation, moving), spin), memory


def _retained(system, load, retention, velocity, spin):
    """Return M^-1 times the retention's damping of a velocity relative to the water."""
    force = tuple(a * (v - w) for a, v, w in zip(retention[:3], velocity, load.water_velocity))
    return kick.solve(kick.factor(system, load.damping, 0.0), force,
                      symmetric_product(retention[3:], spin))


METHODS = {method.name: method for method in (
    Method('leapfrog', leapfrog, 2, 1, _begin_leapfrog),
    Method('implicit', implicit, 1, 1, _begin),
    Method('rk4', rk4, 4, 4, _begin),
    Method('symplectic_euler', symplectic_euler, 1, 1, _begin),
    Method('euler', euler, 1, 1, _begin))}
