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
a high order is worth nothing across one.  Forces and equations of motion are those of `physics`,
so that what is left between it and a simulation is the error of the time step alone.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from ...physics.boat.boat import Boat
from ...physics.boat.records import hull_view, readable
from ...physics.boat.state import Motion, State
from ...physics.compiled import compile_now
from ...physics.forces.damping import RAMP
from ...physics.forces.load import load_at
from ...physics.forces.probe_laws import MIN_UPRIGHT
from ...physics.forces.wind import air_speed
from ...physics.rotation import normalise, rotation_matrix, to_body
from ...physics.sea.waves import Water
from ...physics.stepping.engine import decay_of_waves
from ...physics.stepping.rates import rate_of
from ...physics.vectors import subtract, ZERO

NO_THRUST, UPRIGHT = (ZERO, ZERO), (0.0, 0.0, 0.0, 1.0)
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


class Equations:
    """
    The equations of motion of one boat as y' = f(t, y), and where f has kinks.

    y (13,) is position, orientation, velocity in world axes and angular velocity in body axes.
    """

    def __init__(self, boat: Boat, sea: Water):
        """Make boat and sea ready for the force functions, compiled where Numba is installed."""
        self.boat = boat.plain_records[0]
        self.law, self.height = boat.hull.law, boat.hull.height
        decay = decay_of_waves(boat, sea)
        self._hull = hull_view(boat, plain=False)._replace(decay=decay)
        self._records = (boat.record[()], self._hull, sea.record[()], sea.table)
        self._load_at = compile_now(load_at, *self._records, ZERO, UPRIGHT, 0.0)
        if self._load_at is load_at:
            self._hull = hull_view(boat, plain=True)._replace(decay=decay.tolist())
            self._records = (self.boat, self._hull, readable(sea.record), sea.table.tolist())

    def _motion(self, time, values):
        """Return the `Motion` of y, and the `Load` there; writes the probes' depths."""
        x, y, z, qx, qy, qz, qw, *moving = values.tolist()
        orientation = normalise((qx, qy, qz, qw))
        velocity = to_body(rotation_matrix(orientation), moving[:3])
        motion = Motion((x, y, z), orientation, velocity, tuple(moving[3:]))
        return motion, self._load_at(*self._records, motion.position, motion.orientation,
                                     float(time))

    def derivative(self, time, values):
        """Return y' (13,)."""
        motion, load = self._motion(time, values)
        return np.concatenate(rate_of(self.boat, load, NO_THRUST, motion))

    def kink_functions(self, time, values):
        """
        Return functions of the motion that change sign where the force has a kink.

        Each probe's entry, end of ramp and cap; for columns, the boat lying on its side and the
        heel from which it counts as lying; with quadratic drag, every reversal of speed.
        """
        motion, load = self._motion(time, values)
        upright = rotation_matrix(motion.orientation)[2][2]
        # The wet length in m, not clipped to the height that there is.
        wet, height, attitude = np.array(self._hull.depths), self.height, []
        if self.law == 'column':
            wet = (wet - height * min(upright, 0.0)) / max(abs(upright), MIN_UPRIGHT)
            attitude = [upright, upright - MIN_UPRIGHT, upright + MIN_UPRIGHT]
        speeds = []
        if self.boat.has_quadratic:
            speeds = [*subtract(motion.body_velocity, load.water), *motion.angular_velocity,
                      *air_speed(self.boat, load.wind, motion.body_velocity,
                                 motion.angular_velocity)]
        return np.concatenate([wet, wet - RAMP * height, wet - height, attitude, speeds])


def solve(boat, sea, start, duration, *, tolerance=1e-12, restart=True):
    """
    Return the `Reference` motion of one boat over ``duration`` s.

    Main arguments: ``boat``, ``sea``, ``start`` as for a `Simulation`.
    Other arguments: ``tolerance``, relative and in SI units absolute, of one solver step;
    ``restart`` False leaves the kinks to the step control, for hulls of very many probes.
    """
    equations = Equations(boat, sea)
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
