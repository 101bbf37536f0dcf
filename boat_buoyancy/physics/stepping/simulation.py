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

"""Simulation: one boat stepped at a fixed rate, inputs checked."""

from collections.abc import Callable
import math

import numpy as np
from numpy.typing import ArrayLike

from .engine import Engine, NO_THRUST, Stepped
from .guard import FARTHEST
from .march import read_motion
from .trajectory import Trajectory
from .. import checks
from ..boat.boat import Boat
from ..boat.state import from_rows, Motion, PARTS, State, to_rows
from ..sea.waves import Water

# A row of a run is some 200 bytes: this many are two gigabytes.
MAX_PERIODS = 10_000_000
# Steps of a run in one call, after which Ctrl-C is heard.
CHUNK = 10_000


class SimulationError(RuntimeError):
    """
    The motion left what physics allows; the simulation keeps its last good state.

    ``trajectory`` is what a `Simulation.run` had done by then, else None.
    """

    def __init__(self, sentence: str, trajectory: Trajectory | None = None):
        """Keep both."""
        super().__init__(sentence)
        self.trajectory = trajectory


class Simulation(Stepped):
    """
    A boat on a sea, stepped at a fixed rate.

    Main arguments: ``boat`` a `Boat`; ``sea`` a `Sea`; ``state`` the start `State`.
    Other arguments: ``rate`` Hz, one `step` is 1/rate s; ``integrator`` a name in
    `integrators.INTEGRATORS`; ``substeps`` integrator steps per period; ``warnings`` sentences.
    """

    def __init__(self, boat: Boat, sea: Water, state: State, *, rate: float = 100.0,
                 integrator: str = 'leapfrog', substeps: int = 1, warnings: tuple = ()):
        """Check everything and stand at time 0."""
        self.warnings = tuple(warnings)
        self._start = checked_rows(state, ())
        self._engine = Engine([boat], [sea], self._start[None], rate=rate, integrator=integrator,
                              substeps=[substeps])

    @property
    def substeps(self) -> int:
        """Return the integrator steps per period."""
        return self._engine.substeps[0]

    @property
    def boat(self) -> Boat:
        """Return the boat; setting another of as many probes takes effect with the next step."""
        return self._engine.boats[0]

    @boat.setter
    def boat(self, boat: Boat):
        if len(boat.hull.share) != len(self.boat.hull.share):
            raise ValueError(f'boat: expected {len(self.boat.hull.share)} probes as before, '
                             f'got {len(boat.hull.share)}')
        self._engine.replace(boats=[boat.on(self.sea)])

    @property
    def sea(self) -> Water:
        """
        Return the sea; setting another takes effect with the next step.

        Panels that are as fine as the sea needs them change with it.
        """
        return self._engine.seas[0]

    @sea.setter
    def sea(self, sea: Water):
        self._engine.replace(boats=[self.boat.on(sea)], seas=[sea])

    @property
    def wind(self) -> np.ndarray:
        """Return the wind in m/s (2,), world x and y; set it for what blows from the next step."""
        return self.sea.wind

    @wind.setter
    def wind(self, wind: ArrayLike):
        # Nothing but the wind: panels are not looked at again, so that gusts are cheap.
        self._engine.replace(seas=[self.sea.with_wind(wind)])

    @property
    def state(self) -> State:
        """Return the `State` after the last step; set it to put the boat somewhere else."""
        return from_rows(self._engine.rows[0])

    @state.setter
    def state(self, state: State):
        self._engine.put([0], checked_rows(state, ())[None])

    @property
    def motion(self) -> Motion:
        """Return the `Motion`: floats, cheaper to get than `state`."""
        return read_motion(self._engine.row(0))

    @property
    def probe_depths(self) -> np.ndarray:
        """Return (probes,) m under water, in parameter order, at the time of `state`."""
        return self._engine.depths[0]

    @property
    def probe_forces(self) -> np.ndarray:
        """
        Return (probes,) N, the lift of each probe in still water as deep, at the time of `state`.

        With panels, what the columns there would lift; in waves with the wave force of Froude and
        Krylov, what they would lift without it.
        """
        return self._engine.forces(0)

    def acceleration(self, thrust: ArrayLike | None = None) -> tuple[tuple, tuple]:
        """
        Return the accelerations of the centre of mass at the time of `state`, from the forces.

        Linear (3) m/s^2, the change of the velocity in the world, and angular (3) rad/s^2, both
        in body axes; gravity is in them.  ``thrust`` (6) as in `step`, what acts at that time.
        """
        wrench = NO_THRUST if thrust is None else thrust_rows(thrust, (6,))
        return self._engine.accelerations(0, wrench[0].tolist())

    def reset(self, state: State | None = None) -> None:
        """Go back to time 0 and the start state, or to ``state`` and keep it as the start."""
        if state is not None:
            self._start = checked_rows(state, ())
        self._engine.steps = 0
        self._engine.put([0], self._start[None])

    def step(self, thrust: ArrayLike | None = None) -> None:
        """
        Advance 1/rate s.

        ``thrust`` (6,): force N and torque N m in body axes at the body origin, constant over the
        period; default none.  ValueError for a thrust that is not finite or of another shape;
        SimulationError when the motion leaves what physics allows.  Neither changes anything.
        """
        wrench = NO_THRUST if thrust is None else thrust_rows(thrust, (6,))
        if self._engine.advance(wrench, 0, 0, 1):
            self._fail(wrench[0])

    def run(self, duration: float, thrust: ArrayLike | Callable | None = None, *,
            progress: Callable | None = None) -> Trajectory:
        """
        Advance ``duration`` s, whole periods, and return the `Trajectory` from now on.

        Main arguments: ``thrust`` (6,) as in `step`; (steps, 6), a row for each period; or a
        function (time, state) -> (6,), called before each period.
        Other arguments: ``progress``, a function called with the time in s now and then.
        SimulationError as in `step`, with what was done by then.
        """
        periods = periods_of(duration, self.rate)
        first, rows = self.steps, np.empty((periods + 1, 13))
        depths = np.empty((periods + 1, len(self.boat.hull.share)))
        time = (first + np.arange(periods + 1)) / self.rate
        rows[0], depths[0] = self._engine.rows[0], self._engine.depths[0]
        # What a controller does to them counts from the next period on, not for the record.
        boat, sea = self.boat, self.sea
        given, wrench = callable(thrust), NO_THRUST
        if thrust is not None and not given:
            wrench = thrust_rows(thrust, (6,), (periods, 6))
        by_period = int(len(wrench) > 1)
        chunk = 1 if given or self._engine.is_plain else max(1, CHUNK // self.substeps)
        for done in range(0, periods, chunk):
            count = min(chunk, periods - done)
            if given:
                wrench = thrust_rows(thrust(self.time, self.state), (6,))
            push, part = wrench[done * by_period:], slice(done + 1, done + 1 + count)
            if self._engine.advance(push, 0, by_period, count, rows[part], depths[part]):
                whole = self._engine.failed[0] - first
                self._fail(wrench[(whole - 1) * by_period],
                           Trajectory.of(boat, sea, time[:whole], rows[:whole], depths[:whole]))
            if progress:
                progress(self.time)
        return Trajectory.of(boat, sea, time, rows, depths)

    def _fail(self, row, trajectory=None):
        """Raise the error of a step that left what physics allows, its state kept."""
        engine = self._engine
        number = int(engine.failed[0])
        engine.steps, engine.failed[0] = number - 1, 0
        if not np.isfinite(row).all():
            raise ValueError(f'thrust: expected finite numbers, got {row.tolist()}')
        state = self.state
        before = ', '.join(f'{name} {getattr(state, name).tolist()}' for name in PARTS)
        raise SimulationError(
            f'step {number} of {self.rate:g} Hz ({self.integrator}, substeps {self.substeps}) '
            'made the motion infinite or faster than any force can; the state before is kept: '
            f'{before}; thrust: {row.tolist() if row.any() else "none"}; take more substeps or '
            'integrator: implicit, then reset', trajectory)


def thrust_rows(thrust, *shapes):
    """Return a thrust of one of some shapes as rows (k, 6) of floats; ValueError for another."""
    try:
        given = np.array(thrust, float)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f'thrust: expected six numbers, got {thrust!r}') from None
    if given.shape not in shapes:
        raise ValueError(f'thrust: expected shape {" or ".join(map(str, shapes))}, '
                         f'got {given.shape}')
    return given.reshape(-1, 6)


def periods_of(duration, rate):
    """Return how many periods cover ``duration`` s at ``rate`` Hz; ValueError for no time."""
    duration = checks.number('duration', duration, above=0.0)
    # 0.3 s at 10 Hz are three periods, whatever round-off says.
    periods = math.ceil(duration * rate * (1.0 - 1e-12))
    if periods > MAX_PERIODS:
        raise ValueError(f'duration: expected at most {MAX_PERIODS} periods, got {duration:g} s '
                         f'at {rate:g} Hz, {periods} periods')
    return periods


def checked_rows(state, batch):
    """Return a `State` of a batch shape as rows for the step; ValueError for one that is none."""
    if state.batch_shape != batch:
        raise ValueError(f'state: expected batch shape {batch}, got {state.batch_shape}')
    for name in PARTS:
        _require(np.isfinite(getattr(state, name)).all(axis=-1), state, name, 'finite numbers')
    _require(np.abs(state.position).sum(axis=-1) < FARTHEST, state, 'position',
             f'less than {FARTHEST:g} m from the origin')
    _require(np.abs((state.orientation ** 2).sum(axis=-1) - 1.0) < 1e-3, state, 'orientation',
             'a unit quaternion')
    return to_rows(state)


def _require(good, state, name, what):
    """Raise ValueError for the first boat of a `State` whose part is not ``good`` (...)."""
    if not good.all():
        raise ValueError(f'state.{name}: expected {what}, '
                         f'got {getattr(state, name)[~good][0].tolist()}')
