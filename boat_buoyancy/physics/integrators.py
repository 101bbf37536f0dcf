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

from . import kick
from .forces import evaluate, mixed
from .implicit import implicit
from .linear import symmetric_product
from .motion import begin, Memory, Motion
from .quaternion import cross, multiply, normalise, to_body, to_world


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
    memory = begin(system, sea, position, orientation, time + h, h)
    return Motion(position, orientation, to_body(memory.load.rotation, moving), spin), memory


def _retained(system, load, retention, velocity, spin):
    """Return M^-1 times the retention's damping of a velocity relative to the water."""
    force = tuple(a * (v - w) for a, v, w in zip(retention[:3], velocity, load.water_velocity))
    return kick.solve(kick.factor(system, load.damping, 0.0), force,
                      symmetric_product(retention[3:], spin))


METHODS = {method.name: method for method in (
    Method('leapfrog', leapfrog, 2, 1, _begin_leapfrog),
    Method('implicit', implicit, 1, 1, begin),
    Method('rk4', rk4, 4, 4, begin),
    Method('symplectic_euler', symplectic_euler, 1, 1, begin),
    Method('euler', euler, 1, 1, begin))}
