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
What `Simulation` and `Fleet` share: boats made ready for the step, and the step called on them.

Compiled code works on arrays; plain Python on lists and named tuples of the same numbers.
"""

from concurrent.futures import wait

import numpy as np

from .equations_of_motion import explicit_accelerations
from .guard import slowest_reached
from .integrators import INTEGRATORS
from .march import (about_center_of_mass, begin, LOAD_SIZE, march_by, PACE, read_load,
                    read_motion)
from .speed_bound import SpeedBound
from .. import checks
from ..boat.hull import LAWS
from ..boat.records import readable
from ..compiled import compile_now
from ..forces.probe_laws import wetting
from ..forces.wave_force import wave_decay
from ..rotation import rotation_matrix

NO_THRUST, NO_TRACK = np.zeros((1, 6)), np.empty((0, 0))


class Engine:
    """
    Boats of equally many probes, stepped at one rate by one integrator.

    Main arguments: ``boats`` and ``seas``, a `Boat` and a sea for each; ``rows`` (B, 13), their
    motions; ``rate`` Hz; ``integrator`` a name; ``substeps``, integrator steps per period of each.
    Public: all of these; ``steps``, periods done; ``failed`` (B,), the number of the period in
    which a boat failed, or 0; ``is_plain`` Python.
    """

    def __init__(self, boats, seas, rows, *, rate, integrator, substeps):
        """Check everything and compute the loads at time 0."""
        if integrator not in INTEGRATORS:
            raise ValueError(f'integrator: expected one of {", ".join(INTEGRATORS)}, '
                             f'got {integrator!r}')
        self.integrator, self.rate = integrator, checks.number('rate', rate, above=0.0)
        self.substeps = [checks.count('substeps', number, at_least=1) for number in substeps]
        self.boats, self.seas, self.steps = list(boats), list(seas), 0
        counts = {len(boat.hull.share) for boat in self.boats}
        if len(counts) > 1:
            raise ValueError('fleet: expected boats of equally many probes, got boats of '
                             f'{" and ".join(map(str, sorted(counts)))} probes')
        size = len(self.boats)
        self.failed, self._reached = np.zeros(size, int), np.zeros(size)
        self._rows = np.array(rows, float)
        self._loads, self._depths = np.zeros((size, LOAD_SIZE)), np.zeros((size, 2, *counts))
        self.is_plain = False
        self._set_records()
        march = march_by(integrator)
        self._march = compile_now(march, *self._records, *self._memory, NO_THRUST, 0, 0, 0, 1,
                                  NO_TRACK, NO_TRACK)
        self._begin = compile_now(begin, *self._records, *self._memory[:4], self._all, 0.0)
        if self._march is march or self._begin is begin:
            self.is_plain, self._march, self._begin = True, march, begin
            self._rows, self._loads, self._depths = (
                values.tolist() for values in (self._rows, self._loads, self._depths))
            self._set_records()
        self._start(self._all)

    @property
    def rows(self):
        """Return the motions (B, 13) of all boats."""
        return np.array(self._rows)

    def row(self, boat):
        """Return the motion of one boat, 13 floats."""
        return self._rows[boat] if self.is_plain else self._rows[boat].tolist()

    @property
    def depths(self):
        """Return (B, n) m, how deep all probes are."""
        return np.array([depths[0] for depths in self._depths])

    @property
    def wetness(self):
        """Return (B,), how far all boats are in the water, 0 to 1."""
        return np.array([read_load(load).wetness for load in self._loads])

    def forces(self, boat):
        """Return the lift (n,) N of each probe of one boat."""
        hull, up = self.boats[boat].hull, rotation_matrix(self.row(boat)[3:7])[2]
        law = LAWS.index(hull.law)
        return hull.max_force * [wetting(law, height, depth, up[2])[1] for height, depth in zip(
            hull.height.tolist(), np.asarray(self._depths[boat][0]).tolist())]

    def accelerations(self, boat, thrust):
        """Return linear and angular acceleration, body axes, of one boat under a thrust (6)."""
        record = self.boats[boat].plain_records[0]
        motion = read_motion(self.row(boat))
        return explicit_accelerations(
            record, read_load(np.asarray(self._loads[boat]).tolist()),
            about_center_of_mass(record, thrust), motion.body_velocity, motion.angular_velocity)

    @property
    def time(self):
        """Return the time in s: periods done / rate, never a running sum."""
        return self.steps / self.rate

    def put(self, chosen, rows):
        """Put the boats ``chosen`` (k,) to other motions ``rows`` (k, 13), none of them failed."""
        chosen = np.asarray(chosen)
        for place, row in zip(chosen, rows):
            self._rows[place] = row.tolist() if self.is_plain else row
        self.failed[chosen] = 0
        self._start(chosen)

    def replace(self, boats=None, seas=None):
        """Go on with other boats or seas; on an error with those before."""
        before = self.boats, self.seas
        self.boats, self.seas = boats or self.boats, seas or self.seas
        try:
            self._set_records()
        except Exception:
            self.boats, self.seas = before
            raise
        self._start(self._all)

    def advance(self, thrust, by_boat, by_period, periods, track=NO_TRACK, depth_track=NO_TRACK):
        """
        Advance all boats by some periods; arguments as of `march`.

        Returns how many have failed.
        """
        if self.is_plain:
            failed = self._advance_plain(thrust, by_boat, by_period, self.steps, periods, track,
                                         depth_track)
        else:
            failed = self._march(*self._records, *self._memory, thrust, by_boat, by_period,
                                 self.steps, periods, track, depth_track)
        self.steps += periods
        return failed

    def advance_parts(self, pool, parts, thrust, by_boat):
        """Advance all boats by one period, slices ``parts`` of them each in a thread of a pool."""
        # Compiled code lets go of Python's lock.
        futures = [pool.submit(
            self._march, *self._part(part), thrust[part] if by_boat else thrust, by_boat, 0,
            self.steps, 1, NO_TRACK, NO_TRACK) for part in parts]
        try:
            wait(futures)
        finally:
            # Ctrl-C leaves no boat a period behind the others.
            wait(futures)
            self.steps += 1

    def _part(self, boats):
        """Return records and memory of a slice of the boats, for `march`."""
        fleet, probes, corners, triangles, decays, seas, waves, paces = self._records
        return (fleet[boats], probes[boats], corners, triangles, decays, seas, waves, paces[boats],
                *(values[boats] for values in self._memory))

    def _advance_plain(self, thrust, by_boat, by_period, first, periods, track, depth_track):
        """Do what `march` does, boat by boat: what Python raises is the end of that boat only."""
        thrust = thrust.tolist()
        for i in range(len(self.boats)):
            part = self._part(slice(i, i + 1))
            for j in range(periods):
                row = i * by_boat + j * by_period
                rows = slice(j, j + 1)
                written, written_depths = ([[0.0] * 13], [list(self._depths[i][0])]) if len(
                    track) else (NO_TRACK, NO_TRACK)
                try:
                    self._march(*part, thrust[row:row + 1], 0, 0, first + j, 1, written,
                                written_depths)
                except ArithmeticError:
                    # A division by nothing, or a number too large for one.
                    self.failed[i] = first + j + 1
                    self._begin(*self._records, *self._memory[:4], [i],
                                (first + j) / self.rate)
                if self.failed[i]:
                    break
                if len(track):
                    track[rows], depth_track[rows] = written, written_depths
        return int(np.count_nonzero(self.failed))

    @property
    def _memory(self):
        return (self._rows, self._loads, self._depths, self._places, self._reached,
                self.failed)

    @property
    def _all(self):
        return np.arange(len(self.boats))

    def _set_records(self):
        """Write boats and seas as the records of `march`."""
        seas, sea_of = different(map(id, self.seas))
        panelled, panels_of = different(map(id, self.boats))
        dying, decay_of = different((boat.immersion.tobytes(), number) if boat.follows_waves
                                    else () for boat, number in zip(self.boats, sea_of))
        bounds = [SpeedBound.of(boat, sea) for boat, sea in zip(self.boats, self.seas)]
        paces = np.array([(*pace, self.rate, bound.record.item()) for *pace, bound in zip(
            sea_of, panels_of, decay_of, self.substeps, bounds)], PACE)
        records = (
            np.array([boat.record for boat in self.boats]),
            np.array([boat.probe_records for boat in self.boats]),
            *map(padded, zip(*(self.boats[i].panel_rows for i in panelled))),
            padded([decay_of_waves(self.boats[i], self.seas[i]) for i in dying]),
            np.array([self.seas[i].record for i in seas]),
            padded([self.seas[i].table for i in seas]), paces)
        places = np.zeros((len(self.boats), 5, records[2].shape[2]))
        self._places = places.tolist() if self.is_plain else places
        self._records = tuple(map(readable, records)) if self.is_plain else records
        self._bounds = bounds

    def _start(self, chosen):
        """Compute loads and depths of some boats, and from which speed the guard counts."""
        self._begin(*self._records, *self._memory[:4], chosen, self.time)
        with np.errstate(over='ignore'):
            for i in chosen:
                boat, load = self.boats[i], read_load(self._loads[i])
                u = np.array(self._rows[i][7:])
                if boat.added_mass.any():
                    u[:3] -= load.stream
                norm = np.sqrt(u @ boat.mass_matrix_at(load.wetness) @ u)
                self._reached[i] = max(norm, slowest_reached(self._bounds[i], 1.0 / self.rate))


def different(keys):
    """Return the places of the first of each different key, and which of them each one is."""
    first = {}
    which = [first.setdefault(key, (len(first), place))[0] for place, key in enumerate(keys)]
    return [place for _, place in first.values()], which


def decay_of_waves(boat, sea):
    """Return how the waves of a sea die out below a boat, as `HullView` has it."""
    if not boat.follows_waves:
        return np.zeros((len(boat.hull.share), 4, 0))
    return wave_decay(boat.immersion, sea.table)


def padded(tables):
    """Return tables (..., n) of different lengths as one array; no step reads what is added."""
    tables = list(tables)
    whole = np.zeros((len(tables), *tables[0].shape[:-1],
                      max(table.shape[-1] for table in tables)), tables[0].dtype)
    for place, table in zip(whole, tables):
        place[..., :table.shape[-1]] = table
    return whole


class Stepped:
    """What a simulation and a fleet tell of how they are stepped, by their `Engine`."""

    _engine: Engine

    @property
    def rate(self) -> float:
        """Return the rate in Hz."""
        return self._engine.rate

    @property
    def integrator(self) -> str:
        """Return the name of the integrator."""
        return self._engine.integrator

    @property
    def steps(self) -> int:
        """Return how many periods were stepped."""
        return self._engine.steps

    @property
    def time(self) -> float:
        """Return the time in s: steps taken / rate, never a running sum."""
        return self._engine.time
