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

"""Advice: the cheapest setting that meets a tolerance on a given scene, and proof of it."""

from dataclasses import dataclass, replace
import math

from . import settings
from .stretch import stretches
from .trial import present_result, Result, result_of, Trial
from ...physics.stepping.integrators import INTEGRATORS

# How fast an error may fall, more than it ever does: one order above the integrator's own, and a
# factor besides.  What cannot meet the tolerance even so is not tried.
MARGIN_ORDER, MARGIN = 1, 4.0
# An error of this part of the boat's length is no approximation any more.
WRONG = 0.1
# A finer step changes the error by less than this part: the step is not what limits it.
UNCHANGED = 0.1


@dataclass(frozen=True)
class Advice:
    """
    What to write into the parameter file.

    ``best`` `Result` that meets the tolerance, or the most accurate one when none does, None
    where there is none; ``cheaper``, the most accurate `Result` of all that cost less, and
    ``present``, that of the scene as it is, None when there is none;
    ``limit`` says what stands in the way, or is empty.
    ``chosen_on`` and ``checked_on`` name the stretches, of ``duration`` s each.
    """

    best: Result | None
    cheaper: Result | None
    present: Result | None
    limit: str
    chosen_on: str
    checked_on: str
    duration: float


def advise(given, tolerance, *, rates=settings.RATES, step_costs=settings.step_costs,
           progress=lambda text: None):
    """
    Return the `Advice` for a scene's parameters ``given`` and a ``tolerance`` in m.

    Other arguments: ``rates`` to choose from; ``step_costs`` as `settings.step_costs`;
    ``progress`` a function of one text.

    Settings are tried from the cheapest on; the first to meet the tolerance on the stretch it is
    chosen by and on another one is taken.  None that is started with a warning.
    """
    first, second = stretches(given)
    progress(f'solving {first.duration:g} s of the true motion')
    trial = Trial.of(first)
    if not trial.own_error <= tolerance / 4.0:
        return _unpredictable(trial, tolerance, second)
    progress('measuring the cost of a step')
    ordered = settings.candidates(step_costs(first), rates)
    present, accepts = present_result(trial, ordered), settings.acceptance(given)
    names = first.name, second.name, first.duration
    tried, other = [], None
    for number, (cpu, setting) in enumerate(ordered):
        # A motion that is all wrong, as an unstable one, says nothing of finer steps.
        if _is_hopeless([result for result in tried if result.worst < WRONG * trial.length],
                        setting, tolerance):
            continue
        progress(f'trying {number + 1} of {len(ordered)}: {setting}')
        result = result_of(trial, cpu, setting)
        if not math.isfinite(result.error) or (
                result.error <= tolerance and not accepts(setting)):
            continue
        if result.error <= tolerance:
            other = other or Trial.of(second)
            result = replace(result, checked=other.error(setting))
            if result.checked <= tolerance:
                less = [cheaper for cheaper in tried if cheaper.cpu < cpu]
                return Advice(result, _most_accurate(accepts, less), present, '', *names)
        tried.append(result)
    best = _most_accurate(accepts, tried)
    if best is None:
        return Advice(None, None, present, 'Whatever was tried is unstable, all wrong or started '
                      'with a warning.', *names)
    other = other or Trial.of(second)
    return Advice(replace(best, checked=other.error(best.setting)), None, present,
                  _limit(trial, best), *names)


def _is_hopeless(tried, setting, tolerance):
    """Return True when what was tried shows that this setting cannot meet the tolerance."""
    order = INTEGRATORS[setting.integrator].order
    alike = [result for result in tried
             if replace(result.setting, rate=setting.rate) == setting]
    if alike and MARGIN * tolerance < alike[-1].worst * (
            alike[-1].setting.rate / setting.rate) ** (order + MARGIN_ORDER):
        return True
    return any(_is_flat(tried, replace(setting, integrator=integrator), tolerance)
               for integrator in settings.CONVERGING)


def _is_flat(tried, setting, tolerance):
    """Return True when the error has stopped falling with the step, above the tolerance."""
    errors = [result.worst for result in tried
              if replace(result.setting, rate=setting.rate) == setting]
    last = errors[-3:]
    return (len(last) == 3 and tolerance < min(last)
            and max(last) - min(last) < UNCHANGED * min(last))


def _most_accurate(accepts, results):
    """Return the most accurate of the results whose setting is accepted, or None."""
    ordered = sorted(results, key=lambda result: result.worst)
    return next((result for result in ordered if accepts(result.setting)), None)


def _limit(trial, best):
    """Return what keeps the best of all settings from the tolerance, as a sentence."""
    setting = best.setting
    finer = trial.error(replace(setting, rate=2.0 * setting.rate))
    if best.error - finer > UNCHANGED * best.error:
        return (f'The time step limits it: the finest that was tried and starts without a '
                f'warning is {setting}, and twice as many steps leave {finer:.2g} m.')
    if setting.probes is not None:
        return (f'The model of the hull limits it: {setting.hull} miss the motion of the hull '
                f'itself by {finer:.2g} m at any step.')
    return f'Round-off or a kink limits it: half the step leaves {finer:.2g} m.'


def _unpredictable(trial, tolerance, second):
    """Return the advice where the true motion itself is not known to the tolerance."""
    return Advice(None, None, None,
                  f'The true motion limits it: by {trial.compared} it is known to '
                  f'{trial.own_error:.2g} m, and a tolerance has to be five times that to mean '
                  f'something; take {5.0 * trial.own_error:.2g} m, more damping or a gentler sea.',
                  trial.stretch.name, second.name, trial.stretch.duration)


def report(name, advice, tolerance):
    """Return the advice as the lines that are printed."""
    best, cheaper, present = advice.best, advice.cheaper, advice.present
    if advice.limit:
        lines = [f'{name}: no setting meets {tolerance:g} m.', advice.limit]
        if best is not None:
            lines += ['The most accurate of all that were tried:', '']
            lines += [f'    {line}' for line in best.setting.lines()]
            lines += ['', _worth(advice, tolerance)]
        return lines
    lines = [f'{name}: the cheapest setting that meets {tolerance:g} m. In its parameter file, '
             'each in place of the line of that name in its group, if it has one:', '']
    lines += [f'    {line}' for line in best.setting.lines()]
    lines += ['', _worth(advice, tolerance),
              'rate is also how often the node publishes: where that is too seldom, keep yours.']
    if cheaper is None:
        lines.append('Nothing that was tried is cheaper.')
    else:
        lines.append(f'Next cheaper: {cheaper.setting}: {100 * (1 - cheaper.cpu / best.cpu):.0f} '
                     f'% less CPU time, error {metres(cheaper.worst, tolerance)} m, '
                     f'{cheaper.worst / best.worst:.1f} times as much.')
    if present is not None and present.setting != best.setting:
        lines.append(f'As the scene stands: {present.setting}: error '
                     f'{metres(present.error, tolerance)} m at {present.cpu / best.cpu:.2g} times '
                     'the CPU time.')
    return lines


def _worth(advice, tolerance):
    """Return a sentence with error and cost."""
    best = advice.best
    return (f'Error {metres(best.error, tolerance)} m over {advice.duration:g} s of '
            f'{advice.chosen_on}, {metres(best.checked, tolerance)} m on {advice.checked_on}. '
            f'Cost {best.evaluations:g} force evaluations and {1e6 * best.cpu:.3g} µs of CPU time '
            f'per simulated second: {_rounded(1.0 / best.cpu)} times real time on this machine.')


def metres(error, tolerance):
    """Return an error as text, to as many digits as it takes to tell it from the tolerance."""
    return next(text for text in (f'{error:.{digits}g}' for digits in range(2, 18))
                if (float(text) <= tolerance) == (error <= tolerance))


def _rounded(value):
    """Return a number to two digits, without an exponent."""
    return f'{float(f"{value:.2g}"):,.0f}' if value >= 10 else f'{value:.2g}'
