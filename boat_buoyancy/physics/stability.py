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
Steps chosen before the start, and warnings in whole sentences.

How many substeps a method needs, which are refused, and what the boat will be seen to do.
"""

from dataclasses import dataclass
import math

from . import checks
from .bound import SpeedBound
from .equilibrium import (Equilibrium, equilibrium_stiffness, highest_damping_rate,
                          highest_frequency, Mode, modes)
from .hydrostatics import draft, rest_state
from .integrators import METHODS
from .step_limits import (combined_step, damping_step, least, max_stable_steps, step_limit,
                          StepLimit)

__all__ = ['CALM', 'equilibrium_stiffness', 'highest_damping_rate', 'highest_frequency',
           'MAX_SUBSTEPS', 'max_stable_steps', 'Mode', 'modes', 'Plan', 'plan', 'SpeedBound',
           'step_limit', 'StepLimit']

# A boat settles at rest up to this omega h; above 1 it can be left in a limit cycle.
CALM = 0.5
# Explicit damping is stable up to a rate times h of 2.
DAMPED = 2.0
MAX_SUBSTEPS = 64
# From this many times critical a boat visibly creeps instead of floating.
HEAVY_DAMPING = 3.0


@dataclass(frozen=True)
class Plan:
    """
    How a boat is stepped.

    ``integrator`` the method; ``substeps`` its steps per period; ``warnings`` sentences that
    say what is wrong, what will be seen and what to do.
    """

    integrator: str
    substeps: int
    warnings: tuple


def plan(boat, *, integrator='leapfrog', rate=100.0, substeps=0, allow_unstable=False):
    """
    Return the `Plan` for stepping a boat at ``rate`` Hz.

    Main arguments: ``integrator`` a method's name; ``substeps`` steps per period, 0 = chosen.
    Other arguments: ``allow_unstable`` runs what would be refused, for study.

    Chosen are ceil(h omega_max / 0.5) substeps for leapfrog, ceil(max(h omega_max / 0.5,
    h lambda / 2)) for rk4, symplectic_euler and euler, with lambda the greatest damping rate,
    and 1 for implicit; more where that is not stable, and implicit where it is more than 64.
    ValueError when the substeps given break a limit: the limit, and what to do.
    """
    if integrator not in METHODS:
        raise ValueError(f'integrator: expected one of {", ".join(METHODS)}, got {integrator!r}')
    rate = checks.number('rate', rate, above=0.0)
    asked = checks.count('substeps', substeps, at_least=0)
    rest = Equilibrium.of(boat)
    limit = _limit(boat, rest, integrator)
    needed = _needed(rest, integrator, rate, limit)
    warnings = []
    if not asked and needed > MAX_SUBSTEPS:
        warnings.append(
            f'{integrator} would need {needed} substeps at {rate:g} Hz (at most {MAX_SUBSTEPS} '
            'are chosen), so the boat is stepped by implicit with one step: it never blows up, '
            'but it damps free oscillation; to keep the method, lower probes.stiffness (a '
            'hull: more mass or a smaller waterplane) or damping.probe, raise rate, or give '
            'substeps yourself.')
        integrator, needed, limit = 'implicit', 1, None
    chosen = asked or needed
    if limit is not None and 1.0 / (rate * chosen) >= limit:
        broken = (f'{chosen} at {rate:g} Hz is a step of {1.0 / (rate * chosen):.4g} s, and '
                  f'{integrator} is unstable from {limit:.4g} s on')
        cure = f'give {needed} substeps or more, 0 to have them chosen, or integrator: implicit'
        if not allow_unstable:
            raise ValueError(f'substeps: {broken}; {cure}')
        warnings.append(f'The step is too long: {broken}, so the boat will shake itself to '
                        f'pieces; {cure}.')
    else:
        warnings += _rattling(boat, rest, integrator, rate, chosen, needed)
    if integrator == 'euler':
        warnings.append(_growing(rest, rate, chosen))
    return Plan(integrator, chosen, (*warnings, *_creeping(boat, rest)))


def _needed(rest, integrator, rate, limit):
    """Return the substeps that a method needs to settle at rest."""
    if integrator == 'implicit':
        return 1
    needed = rest.highest_frequency / (rate * CALM)
    if integrator != 'leapfrog':
        needed = max(needed, rest.highest_damping_rate / (rate * DAMPED))
    # A quotient that is a whole number but for round-off is that number.
    count = max(1, math.ceil(needed * (1.0 - 1e-12)))
    # Stiffness and damping together can ask for more than either.
    return count if limit is None else max(count, math.floor(1.0 / (rate * limit)) + 1)


def _limit(boat, rest, integrator):
    """Return the step in s from which a method is refused, or None."""
    limit = damping_step(rest, integrator)
    if integrator == 'euler':
        # Its oscillation always grows, which is warned of; here only what explodes at once.
        return limit
    limit = least(limit, combined_step(rest, integrator))
    rate = float(boat.damping.rates.max())
    if integrator == 'symplectic_euler' and rate > 0:
        # From d h = 1 on, 1 - d h turns the velocity round instead of slowing it.
        limit = least(limit, 1.0 / rate)
    return limit


def _rattling(boat, rest, integrator, rate, substeps, needed):
    """Yield the sentence for a step that is stable but too long to come to rest with."""
    angle = rest.highest_frequency / (rate * substeps)
    if integrator == 'implicit' or angle <= CALM * (1.0 + 1e-12):
        return
    yield (f'At {rate * substeps:g} Hz this boat will rattle at rest: draft '
           f'{_length(draft(boat, rest_state(boat)))}, omega h = {angle:.2g} (at most {CALM:g} '
           f'settles); take substeps: {needed}, integrator: implicit, or a lower '
           'probes.stiffness (a hull: more mass or a smaller waterplane).')


def _growing(rest, rate, substeps):
    """Return the sentence that euler always gets."""
    angle = rest.highest_frequency / (rate * substeps)
    return ('euler is for study only: without damping every oscillation grows, here by a factor '
            f'of {math.hypot(1.0, angle):.6g} a step (omega h = {angle:.3g}), until the boat '
            'jumps about; take integrator: leapfrog.')


def damping_warnings(boat):
    """Return the sentence on a `Boat` with probe damping far above critical, in a tuple."""
    return _creeping(boat, Equilibrium.of(boat))


def _creeping(boat, rest):
    heave = rest.modes['heave'].angular_frequency
    if heave is None:
        return ()
    critical = 2.0 * boat.mass * heave
    ratio = boat.damping.probe / critical
    if ratio < HEAVY_DAMPING:
        return ()
    return (f'Probe damping is {ratio:.3g} times critical in heave: the boat will creep back to '
            'its draft like a spoon in honey, and waves will drag it along; lower damping.probe '
            f'from {boat.damping.probe:.4g} to at most {critical:.4g} N s/m (0.2 to 0.5 of that '
            'is usual).',)


def _length(metres):
    """Return a length with a unit that suits it."""
    if metres < 0.01:
        return f'{1000 * metres:.2g} mm'
    return f'{100 * metres:.2g} cm' if metres < 1.0 else f'{metres:.3g} m'
