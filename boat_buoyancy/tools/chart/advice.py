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
from .settings import Result, Setting, Trial
from .stretch import stretches
from ...physics.scene.scene import scene_from_values
from ...physics.stepping.integrators import INTEGRATORS

# How fast an error may fall, more than it ever does: one order above the integrator's own, and a
# factor besides.  What cannot meet the tolerance even so is not tried.
MARGIN_ORDER, MARGIN = 1, 4.0
# An error of this part of the boat's length is no approximation any more.
WRONG = 0.1
# A finer step changes the error by less than this part: the step is not what limits it.
UNCHANGED = 0.1
# The integrators that show it: of second order and more, they do not level off by themselves.
CONVERGING = ('leapfrog', 'rk4')


@dataclass(frozen=True)
class Advice:
    """
    What to write into the parameter file.

    ``best`` `Result` that meets the tolerance, or the most accurate one when none does, None
    where that means nothing;
    ``checked`` m, its error on the other stretch; ``cheaper``, the most accurate `Result` of all
    that cost less, and ``present``, that of the scene as it is, None when there is none;
    ``limit`` says what stands in the way, or is empty.
    ``chosen_on`` and ``checked_on`` name the stretches, of ``duration`` s each; ``warnings`` are
    the sentences that ``best`` brings and the scene as it is does not.
    """

    best: Result | None
    checked: float
    cheaper: Result | None
    present: Result | None
    limit: str
    chosen_on: str
    checked_on: str
    duration: float
    warnings: tuple = ()


def advise(given, tolerance, *, rates=settings.RATES, step_costs=settings.step_costs,
           progress=lambda text: None):
    """
    Return the `Advice` for a scene's parameters ``given`` and a ``tolerance`` in m.

    Other arguments: ``rates`` to choose from; ``step_costs`` as `settings.step_costs`;
    ``progress`` a function of one text.

    Settings are tried from the cheapest on; the first to meet the tolerance on the stretch it is
    chosen by and on another one is taken.
    """
    first, second = stretches(given)
    progress(f'solving {first.duration:g} s of the true motion')
    trial = Trial.of(first)
    if not trial.own_error <= tolerance / 4:
        return _unpredictable(trial, tolerance, second)
    progress('measuring the cost of a step')
    ordered = settings.candidates(step_costs(trial), rates)
    present = settings.present(trial, ordered)
    names = first.name, second.name, first.duration
    tried, other = [], None
    for number, (cpu, setting) in enumerate(ordered):
        # A motion that is all wrong, as an unstable one, says nothing of finer steps.
        if _is_hopeless([result for result in tried if result.error < WRONG * trial.length],
                        setting, tolerance):
            continue
        progress(f'trying {number + 1} of {len(ordered)}: {setting}')
        result = settings.result(trial, cpu, setting)
        if not math.isfinite(result.error) or (
                result.error <= tolerance and not settings.is_allowed(given, setting)):
            continue
        tried.append(result)
        if result.error <= tolerance:
            other = other or Trial.of(second)
            checked = other.error(setting)
            if checked <= tolerance:
                return Advice(result, checked, _most_accurate(given, tried[:-1]), present, '',
                              *names, _new_warnings(given, setting))
            tried[-1] = replace(result, error=checked)
    best = _most_accurate(given, tried)
    return Advice(best, Trial.of(second).error(best.setting), None, present,
                  _limit(trial, best), *names, _new_warnings(given, best.setting))


def _new_warnings(given, setting):
    """Return the sentences that a setting is started with and the scene as it is is not."""
    try:
        known = scene_from_values(given).simulation().warnings
    except ValueError:
        known = ()
    return tuple(sentence for sentence in settings.warnings(given, setting)
                 if sentence not in known)


def _is_hopeless(tried, setting, tolerance):
    """Return True when what was tried shows that this setting cannot meet the tolerance."""
    order = INTEGRATORS[setting.integrator].order
    alike = [result for result in tried
             if (result.setting.integrator, result.setting.probes)
             == (setting.integrator, setting.probes)]
    if alike and MARGIN * tolerance < alike[-1].error * (
            alike[-1].setting.rate / setting.rate) ** (order + MARGIN_ORDER):
        return True
    return any(_is_flat(tried, integrator, setting.probes, tolerance)
               for integrator in CONVERGING)


def _is_flat(tried, integrator, probes, tolerance):
    """Return True when an integrator's error has stopped falling above the tolerance."""
    errors = [result.error for result in tried
              if (result.setting.integrator, result.setting.probes) == (integrator, probes)]
    last = errors[-3:]
    return (len(last) == 3 and tolerance < min(last)
            and max(last) - min(last) < UNCHANGED * min(last))


def _most_accurate(given, results):
    """Return the most accurate of the results that the library does not refuse, or None."""
    for result in sorted(results, key=lambda result: result.error):
        if settings.is_allowed(given, result.setting):
            return result
    return None


def _limit(trial, best):
    """Return what keeps the best of all settings from the tolerance, as a sentence."""
    setting = best.setting
    finer = trial.error(Setting(setting.integrator, 2.0 * setting.rate, setting.probes))
    if best.error - finer > UNCHANGED * best.error:
        return (f'The time step limits it: {setting.rate:g} Hz is the finest tried, and twice '
                f'that leaves {finer:.2g} m.')
    if setting.probes is not None:
        along, across = setting.probes
        return (f'The probes limit it: {along} x {across} of them miss the motion of the hull '
                f'itself by {finer:.2g} m at any step.')
    return f'Round-off or a kink limits it: half the step leaves {finer:.2g} m.'


def _unpredictable(trial, tolerance, second):
    """Return the advice where the true motion itself is not known to the tolerance."""
    why = 'two solutions of tolerance 1e-12 and 1e-13'
    if settings.has_hull(trial.stretch.given):
        why = 'the hull as {} x {} columns and as {} x {}'.format(
            *settings.HULL, *settings.COARSER_HULL)
    return Advice(None, math.nan, None, None,
                  f'The true motion limits it: {why} differ by {trial.own_error:.2g} m, so '
                  f'{tolerance:g} m means nothing here; damping, a gentler sea or a tolerance '
                  f'above {4 * trial.own_error:.1g} m do.',
                  trial.stretch.name, second.name, trial.stretch.duration)


def report(name, advice, tolerance):
    """Return the advice as the lines that are printed."""
    best, cheaper = advice.best, advice.cheaper
    if advice.limit:
        lines = [f'{name}: no setting meets {tolerance:g} m.', advice.limit]
        if best is not None:
            lines += ['The most accurate of all that were tried:', '']
            lines += [f'    {line}' for line in best.setting.lines()]
            lines += ['', _worth(advice), *_warned(advice)]
        return lines
    lines = [f'{name}: the cheapest setting that meets {tolerance:g} m. In its parameter file, '
             'each in place of the line of that name in its group, if it has one:', '']
    lines += [f'    {line}' for line in best.setting.lines()]
    lines += ['', _worth(advice),
              'rate is also how often the node publishes: where that is too seldom, keep yours.',
              *_warned(advice)]
    if cheaper is None:
        lines.append('Nothing that was tried is cheaper.')
    else:
        lines.append(f'Next cheaper: {cheaper.setting}: {100 * (1 - cheaper.cpu / best.cpu):.0f} '
                     f'% less CPU time, error {cheaper.error:.2g} m, '
                     f'{cheaper.error / best.error:.1f} times as much.')
    if advice.present is not None and advice.present.setting != best.setting:
        lines.append(f'As the scene stands: {advice.present.setting}: error '
                     f'{advice.present.error:.2g} m at {advice.present.cpu / best.cpu:.2g} times '
                     'the CPU time.')
    return lines


def _warned(advice):
    """Return the warnings as lines."""
    return [f'It will be started with a warning: {sentence}' for sentence in advice.warnings]


def _worth(advice):
    """Return a sentence with error and cost."""
    best = advice.best
    return (f'Error {best.error:.2g} m over {advice.duration:g} s of {advice.chosen_on}, '
            f'{advice.checked:.2g} m on {advice.checked_on}. Cost {best.evaluations:g} force '
            f'evaluations and {1e6 * best.cpu:.3g} µs of CPU time per simulated second: '
            f'{_rounded(1.0 / best.cpu)} times real time on this machine.')


def _rounded(value):
    """Return a number to two digits, without an exponent."""
    return f'{float(f"{value:.2g}"):,.0f}' if value >= 10 else f'{value:.2g}'
