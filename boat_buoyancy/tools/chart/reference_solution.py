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
The reference solution: the same equations of motion, solved by an integrator that is none of ours.

An adaptive eighth-order Runge-Kutta (SciPy's DOP853), restarted wherever the force has a kink:
a high order is worth nothing across one.  Force and damping are those of `physics.forces`, so
that what is left between it and a simulation is the error of the time step alone.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from ...physics.backend import ONE_BOAT
from ...physics.boat import State
from ...physics.forces import evaluate, RAMP, System
from ...physics.kick import accelerations
from ...physics.laws import MIN_UPRIGHT
from ...physics.quaternion import cross, multiply, normalise, to_body, to_world

# A kink counts as passed when its function is this far on the other side: round-off about zero,
# of a boat at rest or of a speed that stays zero, is no crossing.
PASSED = 1e-12
# Kinks closer together than this are one: probes of a level boat enter together.
TOGETHER = 1e-9


@dataclass(frozen=True)
class Reference:
    """
    A motion as a function of time.

    ``ends`` (k,) s and ``pieces`` (k,), the interpolants up to each end; ``kinks``, the times in
    s at which the solver was restarted.
    """

    ends: np.ndarray
    pieces: tuple[Callable, ...]
    kinks: tuple[float, ...]

    def at(self, times):
        """Return the `State` at ``times`` (n,) s, of shape (n,)."""
        times = np.asarray(times, float)
        chosen = np.minimum(np.searchsorted(self.ends, times), len(self.ends) - 1)
        values = np.empty((13, len(times)))
        for piece in np.unique(chosen):
            here = chosen == piece
            values[:, here] = self.pieces[piece](times[here])
        orientation = values[3:7] / np.linalg.norm(values[3:7], axis=0)
        return State(values[:3].T, orientation.T, values[7:10].T, values[10:].T)


@dataclass(frozen=True)
class Equations:
    """
    The equations of motion of one boat as y' = f(t, y), and where f has kinks.

    y (13,) is position, orientation, velocity in world axes and angular velocity in body axes.
    """

    system: System
    sea: object

    def _load(self, time, values):
        values = values.tolist()
        orientation = normalise(ONE_BOAT, values[3:7])
        return values, orientation, evaluate(
            self.system, self.sea, values[:3], orientation, time)

    def derivative(self, time, values):
        """Return y' (13,)."""
        (*_, vx, vy, vz, wx, wy, wz), orientation, load = self._load(time, values)
        xx, yy, zz, xy, xz, yz = self.system.inertia
        momentum = (xx * wx + xy * wy + xz * wz, xy * wx + yy * wy + yz * wz,
                    xz * wx + yz * wy + zz * wz)
        gyroscopic = cross(momentum, (wx, wy, wz))
        linear, angular = accelerations(
            self.system, load, (0.0, 0.0, 0.0, *gyroscopic),
            to_body(load.rotation, (vx, vy, vz)), (wx, wy, wz))
        turning = multiply(orientation, (0.5 * wx, 0.5 * wy, 0.5 * wz, 0.0))
        return np.array([vx, vy, vz, *turning, *to_world(load.rotation, linear), *angular])

    def kink_functions(self, time, values):
        """
        Return functions of the motion that change sign where the force has a kink.

        Each probe's entry, end of ramp and cap; for columns, the boat lying on its side and the
        heel from which it counts as lying; with quadratic drag, every reversal of speed.
        """
        values, _, load = self._load(time, values)
        height, wet = self.system.boat.hull.height, load.depth
        attitude = []
        if self.system.boat.hull.law == 'column':
            upright = load.rotation[8]
            wet = (wet - height * min(upright, 0.0)) / max(abs(upright), MIN_UPRIGHT)
            attitude = [upright, upright - MIN_UPRIGHT, upright + MIN_UPRIGHT]
        speeds = []
        if self.system.quadratic is not None:
            velocity = to_body(load.rotation, values[7:10])
            speeds = [v - w for v, w in zip(velocity, load.water_velocity)] + values[10:]
        return np.concatenate([wet, wet - RAMP * height, wet - height, attitude, speeds])


def solve(boat, sea, start, duration, *, tolerance=1e-12, restart=True):
    """
    Return the `Reference` motion of one boat over ``duration`` s.

    Main arguments: ``boat``, ``sea``, ``start`` as for a `Simulation`.
    Other arguments: ``tolerance``, relative and in SI units absolute, of one solver step;
    ``restart`` False leaves the kinks to the step control, for hulls of very many probes.
    """
    equations = Equations(System.of(boat, ONE_BOAT), sea)
    time = 0.0
    values = np.concatenate([start.position, start.orientation, start.velocity,
                             start.angular_velocity])
    sides = np.where(equations.kink_functions(time, values) < 0.0, -1.0, 1.0)
    pieces, kinks = [], []
    while time < duration:
        solver = DOP853(equations.derivative, time, values, duration,
                        rtol=tolerance, atol=tolerance)
        crossed = np.zeros(len(sides), bool)
        while solver.status == 'running' and not crossed.any():
            message = solver.step()
            if solver.status == 'failed':
                raise RuntimeError(f'reference solution failed at {solver.t:.6g} s: {message}')
            piece = solver.dense_output()
            if restart:
                crossed = sides * equations.kink_functions(solver.t, solver.y) < -PASSED
            if not crossed.any():
                pieces.append(piece)
        time, values = solver.t, solver.y
        if crossed.any():
            when = _crossings(equations, piece, np.flatnonzero(crossed), sides)
            first = min(when.values())
            landed, values = _land(equations, piece, first, tolerance)
            pieces += landed
            sides[[i for i, t in when.items() if t <= first + TOGETHER]] *= -1.0
            time = first
            kinks.append(first)
    return Reference(np.array([piece.t for piece in pieces]), tuple(pieces), tuple(kinks))


def _crossings(equations, piece, indices, sides):
    """Return a dict of the kink functions that changed side, and when in s."""
    def beyond(time, index):
        return sides[index] * equations.kink_functions(time, piece(time))[index]

    return {index: piece.t_old if beyond(piece.t_old, index) <= 0.0 else brentq(
        beyond, piece.t_old, piece.t, args=(index,), xtol=1e-15, rtol=1e-15)
        for index in indices}


def _land(equations, piece, end, tolerance):
    """Return the pieces from the start of ``piece`` to a kink at ``end`` s, and y there."""
    values = piece(piece.t_old)
    pieces = []
    if end > piece.t_old:
        solver = DOP853(equations.derivative, piece.t_old, values, end,
                        rtol=tolerance, atol=tolerance)
        while solver.status == 'running':
            solver.step()
            pieces.append(solver.dense_output())
        values = solver.y
    return pieces, values
