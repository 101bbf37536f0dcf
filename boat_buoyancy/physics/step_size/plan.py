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

How many substeps an integrator needs, which are refused, and what the boat will be seen to do.
"""

from dataclasses import dataclass
import math

from .balance import at_rest, drifting
from .limits import is_stable, largest_stable_step, least
from .. import checks
from ..boat.boat import Boat
from ..hydrostatics.natural_modes import Equilibrium
from ..hydrostatics.rest import draft, rest_state
from ..stepping.integrators import INTEGRATORS

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

    ``integrator`` by name; ``substeps`` its steps per period; ``warnings`` sentences that
    say what is wrong, what will be seen and what to do.
    """

    integrator: str
    substeps: int
    warnings: tuple[str, ...]


def plan(boat: Boat, *, integrator: str = 'leapfrog', rate: float = 100.0, substeps: int = 0,
         allow_unstable: bool = False) -> Plan:
    """
    Return the `Plan` for stepping a boat at ``rate`` Hz.

    Main arguments: ``integrator`` a name; ``substeps`` steps per period, 0 = chosen.
    Other arguments: ``allow_unstable`` runs what would be refused, for study.

    Chosen are ceil(h omega_max / 0.5) substeps for leapfrog, ceil(max(h omega_max / 0.5,
    h lambda / 2)) for rk4, symplectic_euler and euler, with lambda the greatest damping rate,
    and 1 for implicit; more where that is not stable, and implicit where it is more than 64.
    ValueError when the substeps given break a limit: the limit, and what to do.
    """
    if integrator not in INTEGRATORS:
        raise ValueError(f'integrator: expected one of {", ".join(INTEGRATORS)}, '
                         f'got {integrator!r}')
    rate = checks.number('rate', rate, above=0.0)
    asked = checks.count('substeps', substeps, at_least=0)
    rest = Equilibrium.of(boat)
    needed = _needed(boat, rest, integrator, rate)
    warnings = []
    if not asked and needed > MAX_SUBSTEPS:
        warnings.append(
            f'{integrator} would need {needed} substeps at {rate:g} Hz (at most {MAX_SUBSTEPS} '
            'are chosen), so the boat is stepped by implicit with one step: it never blows up, '
            'but it damps free oscillation; to keep the integrator, lower probes.stiffness (a '
            'hull: more mass or a smaller waterplane) or damping.probe, raise rate, or give '
            'substeps yourself.')
        integrator, needed = 'implicit', 1
    chosen = asked or needed
    h = 1.0 / (rate * chosen)
    if chosen < needed and not _is_stable(boat, integrator, h):
        broken = (f'{chosen} at {rate:g} Hz is a step of {h:.4g} s, and '
                  f'{integrator} is unstable from {least(h, _limit(boat, integrator)):.4g} s on')
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


def _needed(boat, rest, integrator, rate):
    """Return the substeps that an integrator needs to settle at rest."""
    if integrator == 'implicit':
        return 1
    needed = rest.highest_frequency / (rate * CALM)
    if integrator != 'leapfrog':
        needed = max(needed, rest.highest_damping_rate / (rate * DAMPED))
    # A quotient that is a whole number but for round-off is that number.
    needed = max(1, math.ceil(needed * (1.0 - 1e-12)))
    if integrator == 'symplectic_euler':
        needed = max(needed, math.floor(1.0 / (rate * _turning_step(boat))) + 1)
    if integrator in ('rk4', 'symplectic_euler'):
        # Stiffness and damping together can ask for more than either.
        while needed <= MAX_SUBSTEPS and not is_stable(
                at_rest(boat), integrator, 1.0 / (rate * needed)):
            needed += 1
    return needed


def _is_stable(boat, integrator, h):
    """Return whether a step of h s is let pass."""
    if integrator == 'symplectic_euler' and h >= _turning_step(boat):
        return False
    return all(is_stable(balance, integrator, h) for balance in _balances(boat, integrator))


def _limit(boat, integrator):
    """Return the step in s from which an integrator is refused, or None."""
    limits = [largest_stable_step(balance, integrator)
              for balance in _balances(boat, integrator)]
    if integrator == 'symplectic_euler':
        limits.append(_turning_step(boat))
    return least(*limits)


def _balances(boat, integrator):
    """Return the `Balance`s about which a step has to be stable."""
    if integrator in ('leapfrog', 'implicit'):
        # Their damping is no explicit force: they are stable at any.
        return [at_rest(boat)]
    # The oscillation of euler always grows, which is warned of: only what explodes counts.
    return drifting(boat) + [at_rest(boat)] * (integrator != 'euler')


def _turning_step(boat):
    """Return the step in s from which 1 - d h turns a velocity round, infinite for none."""
    rate = float(boat.damping.rates.max())
    return 1.0 / rate if rate > 0.0 else math.inf


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


def _creeping(boat, rest):
    """Return the sentence on a boat with probe damping far above critical, in a tuple."""
    heave = rest.modes['heave'].angular_frequency
    if heave is None:
        return ()
    critical = 2.0 * rest.mass[2, 2] * heave
    heavy = boat.damping.probe[2]
    ratio = heavy / critical
    if ratio < HEAVY_DAMPING:
        return ()
    return (f'Probe damping is {ratio:.3g} times critical in heave: the boat will creep back to '
            'its draft instead of bobbing, and waves will drag it along; lower damping.probe '
            f'from {heavy:.4g} to at most {critical:.4g} N s/m (0.2 to 0.5 of that is usual).',)


def _length(metres):
    """Return a length with a unit that suits it."""
    if metres < 0.01:
        return f'{1000 * metres:.2g} mm'
    return f'{100 * metres:.2g} cm' if metres < 1.0 else f'{metres:.3g} m'
