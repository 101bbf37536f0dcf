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

"""The five integrators by name: all of them take the same step."""

from collections.abc import Callable
from dataclasses import dataclass

from .euler import euler, symplectic_euler
from .implicit import implicit
from .leapfrog import leapfrog
from .runge_kutta import rk4


@dataclass(frozen=True)
class Integrator:
    """
    An integrator.

    ``step`` (boat, hull, sea, waves, motion, load, thrust, t, h) -> (motion, load) after h s from
    t: ``boat`` and ``sea`` records, ``hull`` a `HullView`, read and written, ``waves`` a table;
    ``motion`` a `Motion`, ``load`` that of its own place and time; ``thrust`` force N and torque
    N m about the centre of mass, body axes.
    ``order`` on smooth motion; ``evaluations`` of the force a step.
    """

    step: Callable
    order: int
    evaluations: int


INTEGRATORS = {'leapfrog': Integrator(leapfrog, 2, 1), 'implicit': Integrator(implicit, 1, 1),
               'rk4': Integrator(rk4, 4, 4),
               'symplectic_euler': Integrator(symplectic_euler, 1, 1),
               'euler': Integrator(euler, 1, 1)}
