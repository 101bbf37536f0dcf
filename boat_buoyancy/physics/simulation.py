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

"""Simulation: a boat or a fleet stepped at a fixed rate, inputs checked."""

import numpy as np

from . import blocks, checks, integrators
from .backend import FARTHEST, FLEET, ONE_BOAT
from .forces import System
from .guard import Guard

NO_THRUST = (0.0,) * 6


class SimulationError(RuntimeError):
    """The motion left what physics allows; the simulation keeps its last good state."""


class Simulation:
    """
    A boat, or a fleet of equal boats, on a sea, stepped at a fixed rate.

    Main arguments: ``boat`` a `Boat`; ``sea`` a `Sea`; ``state`` the start `State`, of one boat
    or with leading batch dimensions.
    Other arguments: ``rate`` Hz, one `step` is 1/rate s; ``integrator`` a name in
    `integrators.METHODS`; ``substeps`` integrator steps per period; ``warnings`` sentences.
    """

    def __init__(self, boat, sea, state, *, rate=100.0, integrator='leapfrog', substeps=1,
                 warnings=()):
        """Check everything and stand at time 0."""
        if integrator not in integrators.METHODS:
            raise ValueError(f'integrator: expected one of {", ".join(integrators.METHODS)}, '
                             f'got {integrator!r}')
        self._rate = checks.number('rate', rate, above=0.0)
        self._substeps = checks.count('substeps', substeps, at_least=1)
        self._method = integrators.METHODS[integrator]
        self.warnings = tuple(warnings)
        self._batch = state.batch_shape
        self._backend = FLEET if self._batch else ONE_BOAT
        self._start, self._steps = state, 0
        self._block = _block_of(boat, sea, 0.0)
        self._prepare(self._to_motions(state), boat, sea)

    @property
    def rate(self):
        """Return the rate in Hz."""
        return self._rate

    @property
    def integrator(self):
        """Return the name of the step method."""
        return self._method.name

    @property
    def substeps(self):
        """Return the integrator steps per period."""
        return self._substeps

    @property
    def steps(self):
        """Return how many periods were stepped."""
        return self._steps

    @property
    def time(self):
        """Return the time in s: steps taken / rate, never a running sum."""
        return self._steps / self._rate

    @property
    def boat(self):
        """Return the boat; setting another takes effect with the next step."""
        return self._boat

    @boat.setter
    def boat(self, boat):
        self._prepare(self._motions, boat, self._sea)

    @property
    def sea(self):
        """Return the sea; setting another takes effect with the next step."""
        return self._sea

    @sea.setter
    def sea(self, sea):
        self._prepare(self._motions, self._boat, sea)

    @property
    def state(self):
        """Return the `State` after the last step; set it to put the boat somewhere else."""
        return blocks.to_state(self._backend, self._motions, self._batch)

    @state.setter
    def state(self, state):
        self._prepare(self._to_motions(state), self._boat, self._sea)

    @property
    def probe_depths(self):
        """Return (..., probes) m under water, in parameter order, at the time of `state`."""
        return self._per_probe([memory.load.depth for memory in self._memories])

    @property
    def probe_forces(self):
        """Return (..., probes) N, the lift of each probe, straight up, at the time of `state`."""
        shares = self._per_probe([memory.load.share for memory in self._memories])
        return shares * self._boat.hull.max_force

    @property
    def motion(self):
        """Return the `Motion` of one boat: floats, cheaper to get than `state`."""
        motion, = self._motions
        return motion

    def reset(self, state=None):
        """Go back to time 0 and the start state, or to ``state`` and keep it as the start."""
        motions = self._to_motions(self._start if state is None else state)
        self._start = self._start if state is None else state
        self._steps = 0
        self._prepare(motions, self._boat, self._sea)

    def step(self, thrust=None):
        """
        Advance 1/rate s.

        ``thrust`` (6,), or (..., 6) for a fleet: force N and torque N m in body axes at the body
        origin, constant over the period; default none.  ValueError for a thrust that is not
        finite or of another shape; SimulationError when the motion leaves what physics allows.
        Neither changes anything.
        """
        if self._batch:
            with np.errstate(all='ignore'):
                self._step(thrust)
        else:
            # Floats warn of nothing, and setting NumPy's warnings costs as much as four calls.
            self._step(thrust)

    def _step(self, thrust):
        wrench = NO_THRUST if thrust is None else self._wrench(thrust)
        parts = (wrench,) if len(self._motions) == 1 else blocks.of_blocks(wrench, self._block)
        advance, system, sea = self._method.step, self._system, self._sea
        step_rate = self._rate * self._substeps
        h, first = 1.0 / step_rate, self._steps * self._substeps
        motions, memories = [], []
        try:
            for motion, memory, part in zip(self._motions, self._memories, parts):
                for k in range(first, first + self._substeps):
                    motion, memory = advance(system, sea, motion, memory, part, k / step_rate, h)
                motions.append(motion)
                memories.append(memory)
        except (ArithmeticError, ValueError) as error:
            # What a float that is no number any more does to sqrt, sin and division.
            raise self._left(thrust) from error
        if not self._guard.passes(motions, None if thrust is None else wrench):
            raise self._left(thrust, motions)
        self._motions, self._memories = motions, memories
        self._steps += 1

    def _per_probe(self, parts):
        """Return (..., probes) of what each block has for each probe."""
        return np.concatenate(parts, axis=-1).T.reshape(*self._batch, -1)

    def _prepare(self, motions, boat, sea):
        """Take boat and sea and compute the loads of the motions; on an error change nothing."""
        system = System.of(boat, self._backend)
        block = _block_of(boat, sea, self.time)
        if self._batch and block != self._block:
            motions = blocks.recut(motions, block)
        h = 1.0 / (self._rate * self._substeps)
        memories = [self._method.begin(system, sea, motion.position, motion.orientation,
                                       self.time, h)
                    for motion in motions]
        state = blocks.to_state(self._backend, motions, self._batch)
        self._guard = Guard(boat, sea, state, 1.0 / self._rate)
        self._boat, self._sea, self._system, self._block = boat, sea, system, block
        self._motions, self._memories = motions, memories

    def _wrench(self, thrust):
        """Return the thrust about the centre of mass, six components."""
        try:
            given = np.asarray(thrust, float)
        except (TypeError, ValueError):
            raise ValueError(f'thrust: expected six numbers, got {thrust!r}') from None
        if given.shape != (6,) and given.shape != (*self._batch, 6):
            raise ValueError(f'thrust: expected shape (6,)'
                             f'{f" or {(*self._batch, 6)}" if self._batch else ""}, '
                             f'got {given.shape}')
        if not np.isfinite(given).all():
            raise ValueError(f'thrust: expected finite numbers, got {given.tolist()}')
        if given.ndim == 1:
            fx, fy, fz, tx, ty, tz = given.tolist()
        else:
            fx, fy, fz, tx, ty, tz = np.ascontiguousarray(given.reshape(-1, 6).T)
        x, y, z = self._boat.center_of_mass.tolist()
        return fx, fy, fz, tx - (y * fz - z * fy), ty - (z * fx - x * fz), tz - (x * fy - y * fx)

    def _left(self, thrust, motions=None):
        """Return the error for a step that left what physics allows; nothing has changed yet."""
        boat = self._guard.fastest(motions) if self._batch and motions else 0
        state, given = self.state, 'none'
        if thrust is not None:
            rows = np.broadcast_to(np.asarray(thrust, float), (*self._batch, 6))
            given = rows.reshape(-1, 6)[boat].tolist()
        before = ', '.join(f'{name} {values.reshape(-1, values.shape[-1])[boat].tolist()}'
                           for name, values in vars(state).items())
        return SimulationError(
            f'step {self._steps + 1} of {self._rate:g} Hz ({self._method.name}, substeps '
            f'{self._substeps}) made the motion infinite or faster than any force can'
            f'{f" (boat {boat} of the fleet)" if self._batch else ""}; the state before is kept: '
            f'{before}; thrust: {given}; take more substeps or integrator: implicit, then reset')

    def _to_motions(self, state):
        if state.batch_shape != self._batch:
            raise ValueError(f'state: expected batch shape {self._batch}, '
                             f'got {state.batch_shape}')
        arrays = (state.position, state.orientation, state.velocity, state.angular_velocity)
        if not all(np.isfinite(values).all() for values in arrays):
            raise ValueError(f'state: expected finite numbers, got {state}')
        if not (np.abs(state.position).sum(axis=-1) < FARTHEST).all():
            raise ValueError(f'state.position: expected less than {FARTHEST:g} m from the origin, '
                             f'got {state.position.tolist()}')
        if not (np.abs((state.orientation ** 2).sum(axis=-1) - 1.0) < 1e-3).all():
            raise ValueError('state.orientation: expected unit quaternions, '
                             f'got {state.orientation.tolist()}')
        return blocks.from_state(self._backend, state, self._block)


def _block_of(boat, sea, time):
    return blocks.block_size(len(boat.hull.share), len(sea.at(time).waves))
