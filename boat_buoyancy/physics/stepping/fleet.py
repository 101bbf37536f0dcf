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

"""Fleet: many boats stepped together, each with its own mass, hull, damping, sea and start."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
import os
from warnings import warn

import numpy as np
from numpy.typing import ArrayLike

from .engine import Engine, NO_THRUST, Stepped
from .simulation import checked_rows, thrust_rows
from .. import checks
from ..boat.boat import Boat
from ..boat.state import from_rows, State
from ..compiled import turned_off
from ..sea.waves import Water

# Fewer boats than these a thread are done before a second thread has begun.
LEAST_BOATS = 250


class Fleet(Stepped):
    """
    Boats that do not meet, stepped at one rate by one integrator.

    Main arguments: ``boats`` and ``seas``, sequences of B `Boat`s of equally many probes and of
    as many seas (one sea may stand many times); ``state`` the start `State` (B,).
    Other arguments: ``rate`` Hz; ``integrator`` a name in `integrators.INTEGRATORS`;
    ``substeps`` per period, a number or one for each; ``warnings`` sentences; ``threads``, at
    most, by default as many as there are processors; a fleet too small to gain stays in one.

    A boat alone and in a fleet, on one thread or more, moves the same to the bit.
    """

    def __init__(self, boats: Sequence[Boat], seas: Sequence[Water], state: State, *,
                 rate: float = 100.0, integrator: str = 'leapfrog', substeps: ArrayLike = 1,
                 threads: int | None = None, warnings: tuple = ()):
        """Check everything and stand at time 0."""
        size, self.warnings = len(boats), tuple(warnings)
        if not size or len(seas) != size:
            raise ValueError('fleet: expected at least one boat, and a sea for each, got '
                             f'{size} boats and {len(seas)} seas')
        self._start = checked_rows(state, (size,))
        self._engine = Engine(boats, seas, self._start, rate=rate, integrator=integrator,
                              substeps=_for_each(substeps, size))
        # Of a Numba that is there and no good, `compiled` has told.
        if find_spec('numba') is None and not turned_off():
            warn('this fleet is stepped by plain Python, some fifty times slower than compiled: '
                 './install.sh fast, or pip install "boat_buoyancy[fast]"', RuntimeWarning,
                 stacklevel=2)
        count = _processors() if threads is None else checks.count('threads', threads, at_least=1)
        count = 1 if self._engine.is_plain else max(1, min(count, size // LEAST_BOATS))
        edges = np.linspace(0, size, count + 1).astype(int).tolist()
        self._parts = [slice(*pair) for pair in zip(edges, edges[1:])]
        self._pool = ThreadPoolExecutor(count) if count > 1 else None

    def __len__(self) -> int:
        """Return how many boats there are."""
        return len(self._engine.boats)

    @property
    def boats(self) -> tuple[Boat, ...]:
        """Return the boats as a tuple."""
        return tuple(self._engine.boats)

    @property
    def seas(self) -> tuple[Water, ...]:
        """Return the sea of each boat as a tuple."""
        return tuple(self._engine.seas)

    @property
    def state(self) -> State:
        """Return the `State` (B,); ``state[i]`` is that of boat i.  Set it to put all boats."""
        return from_rows(self._engine.rows)

    @state.setter
    def state(self, state: State):
        self._engine.put(np.arange(len(self)), checked_rows(state, (len(self),)))

    @property
    def probe_depths(self) -> np.ndarray:
        """Return (B, probes) m under water, at the time of `state`."""
        return self._engine.depths

    @property
    def wetness(self) -> np.ndarray:
        """Return (B,), how far each boat is in the water, 0 to 1: its probes' weighted mean."""
        return self._engine.wetness

    @property
    def failed(self) -> np.ndarray:
        """
        Return (B,) bool: the boats that left what physics allows.

        Such a boat stands still from then on: its state and its probe depths stay those of the
        last period that was good, speed included.
        """
        return self._engine.failed > 0

    def reset(self, which: ArrayLike | None = None) -> None:
        """
        Put the boats ``which`` (B,) bool back to their start; sea and time go on.

        All of them by default, and then time is 0 again, too.
        """
        if which is None:
            self._engine.steps = 0
            which = np.ones(len(self), bool)
        which = np.asarray(which)
        if which.shape != (len(self),) or which.dtype != bool:
            raise ValueError(f'which: expected a bool for each of {len(self)} boats, got an array '
                             f'of {which.dtype} of shape {which.shape}')
        chosen = np.flatnonzero(which)
        self._engine.put(chosen, self._start[chosen])

    def step(self, thrust: ArrayLike | None = None) -> None:
        """
        Advance 1/rate s; a boat that fails is noted in `failed`, and the rest goes on.

        ``thrust`` (B, 6) or (6,) for all: force N and torque N m in body axes at the body origin;
        default none.  ValueError for one that is not finite or of another shape.
        """
        wrench, by_boat = NO_THRUST, 0
        if thrust is not None:
            wrench = thrust_rows(thrust, (6,), (len(self), 6))
            by_boat = int(len(wrench) > 1)
            if not np.isfinite(wrench).all():
                raise ValueError('thrust: expected finite numbers, got '
                                 f'{wrench[~np.isfinite(wrench).all(axis=1)][0].tolist()}')
        if self._pool is None:
            self._engine.advance(wrench, by_boat, 0, 1)
        else:
            self._engine.advance_parts(self._pool, self._parts, wrench, by_boat)


def _for_each(substeps, size):
    """Return substeps for each of ``size`` boats as a list."""
    if np.ndim(substeps) and len(substeps) != size:
        raise ValueError(f'substeps: expected a number, or one for each of {size} boats, '
                         f'got {len(substeps)}')
    return np.broadcast_to(substeps, (size,)).tolist()


def _processors():
    """Return how many processors this process may use."""
    if hasattr(os, 'sched_getaffinity'):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1  # not on Linux
