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
The largest stable step of each integrator, found from the shipped step itself.

One step of a boat in balance is a map of small displacements and velocities to those a step
later.  Its Jacobian, by central differences, tells: a step is stable when no eigenvalue leaves
the unit circle.
"""

from dataclasses import dataclass
import math

import numpy as np

from .balance import at_rest, Balance, displaced, displacement, drifting, without_damping
from ..boat.boat import Boat
from ..boat.records import hull_view
from ..boat.state import to_rows
from ..compiled import calling, compile_now, compiled, notice
from ..forces.load import load_at
from ..hydrostatics.rest import MANY_PIECES
from ..hydrostatics.stiffness import STILL_WATER
from ..sea.waves import Sea
from ..stepping.integrators import INTEGRATORS
from ..stepping.leapfrog import leapfrog as step
from ..stepping.march import read_motion, write_motion
from ..vectors import ZERO

# Steps looked at, in radians of the fastest and of the slowest of the boat's motions: what is
# unstable at the least is never stable, what is stable up to the greatest has no limit.
LEAST, FIRST, GREATEST = 3e-4, 0.25, 10.0
PRECISION = 1e-6


@dataclass(frozen=True)
class StepLimit:
    """
    The largest stable steps of one integrator in s; None = no limit, 0.0 = never stable.

    ``oscillation`` without damping; ``damping`` without stiffness, in water or in air, whichever
    is less; ``combination`` both, at rest: what the boat itself does.
    """

    oscillation: float | None
    damping: float | None
    combination: float | None


@compiled
def one_step(boat, hull, sea, waves, row, h):
    """Advance a row (13) by one step of h s from time 0, without thrust."""
    motion = read_motion(row)
    load = load_at(boat, hull, sea, waves, motion.position, motion.orientation, 0.0)
    motion, load = step(boat, hull, sea, waves, motion, load, (ZERO, ZERO), 0.0, h)
    write_motion(motion, row)


def step_jacobian(balance: Balance, integrator: str, h: float) -> np.ndarray:
    """
    Return the Jacobian (9, 9) of one step of h s of a `Balance` in still water.

    Of heave, roll and pitch and of all six velocities, all without a unit: in terms of a length,
    of an angle, and of those a step.
    """
    boat, start, advance = balance.boat, to_rows(balance.state), calling(
        one_step, step=INTEGRATORS[integrator].step)
    units = balance.units / np.array([1.0] * 3 + [h] * 6)
    records = (boat.plain_records[0], hull_view(boat, plain=True), *STILL_WATER)
    compiled_for_many = False
    if boat.pieces >= MANY_PIECES:
        sea, plain = Sea(), advance
        arrays = (boat.record[()], hull_view(boat, plain=False), sea.record[()], sea.table.copy())
        advance = compile_now(plain, *arrays, start, h)
        compiled_for_many = advance is not plain
        if compiled_for_many:
            records = arrays

    def after(move):
        row = displaced(start, move)
        row = row if compiled_for_many else row.tolist()
        advance(*records, row, h)
        return displacement(start, np.array(row))

    return np.stack([(after(move) - after(-move)) / (2.0 * balance.small * units)
                     for move in np.diag(balance.small * units)], axis=1)


def is_stable(balance: Balance, integrator: str, h: float) -> bool:
    """
    Return True when small motions about a `Balance` do not grow by steps of h s.

    A boat that falls over does so by any step, no faster than e to the ``falling`` h; a step that
    is too long turns the motion round, lets it swing wider, or outruns that.
    """
    matrix = step_jacobian(balance, integrator, h)
    values = np.linalg.eigvals(matrix)
    allowed = np.where((values.real > 0.0) & (values.imag == 0.0),
                       math.exp(min(balance.falling * h, 700.0)), 1.0)
    return bool((np.abs(values) <= allowed + balance.round_off * np.abs(matrix).max()).all())


def largest_stable_step(balance: Balance, integrator: str,
                        precision: float = PRECISION) -> float | None:
    """Return the step in s at which an integrator turns unstable, None or 0.0 as `StepLimit`."""
    if not balance.fastest > 0.0:
        return None
    stable, unstable = 0.0, math.inf
    # An oscillation that grows by less than round-off, u^2 / 2 a step of euler, is not seen to.
    least_seen = max(LEAST, 4.0 * math.sqrt(2.0 * balance.round_off))
    tried = FIRST / balance.fastest
    while stable < (1.0 - precision) * unstable:
        if is_stable(balance, integrator, tried):
            if tried * balance.slowest > GREATEST:
                return None
            stable = tried
        else:
            if tried * balance.fastest < least_seen:
                return 0.0
            unstable = tried
        tried = min(2.0 * tried, 0.5 * (stable + unstable))
    return float(stable)


def damping_step(boat: Boat, integrator: str) -> float | None:
    """Return the largest step in s without stiffness, in water or in air, or None."""
    return least(*(largest_stable_step(balance, integrator) for balance in drifting(boat)))


def combined_step(boat: Boat, integrator: str) -> float | None:
    """Return the largest step in s at rest, stiffness and damping together, or None."""
    return largest_stable_step(at_rest(boat), integrator)


def step_limit(boat: Boat, integrator: str) -> StepLimit:
    """Return the `StepLimit` of one integrator for a `Boat`."""
    return StepLimit(oscillation=combined_step(without_damping(boat), integrator),
                     damping=damping_step(boat, integrator),
                     combination=combined_step(boat, integrator))


def max_stable_steps(boat: Boat) -> dict[str, float | None]:
    """
    Return {integrator: s}, the largest step at which a boat at rest stays at rest.

    None = no limit, 0.0 = never stable: the combination of `StepLimit`.
    """
    return {integrator: combined_step(boat, integrator) for integrator in INTEGRATORS}


def notice_of(boat: Boat) -> str:
    """Return a sentence when the limits of a boat are about to take a while, else ''."""
    if boat.pieces < MANY_PIECES:
        return ''
    return notice(calling(one_step, step=INTEGRATORS['euler'].step))


def least(*steps):
    """Return the smallest of some steps, None counting as no limit."""
    return min((step for step in steps if step is not None), default=None)
