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

"""Part three of the chart: step and model together, and the settings that nothing else beats."""

from dataclasses import replace
from functools import lru_cache

from . import settings
from .settings import Setting, Trial
from .stretch import stretches
from .table import Row
from ...physics.scene.scene import load_scene

PART = 'both'
# The scene of the chart when none is given: the barge of `hull_shapes` in sea state 5.
DEFAULT_NAME = 'barge in sea state 5'
DEFAULT_SCENE = {'hull.size': [20.0, 6.0, 3.0], 'hull.bottom': 0.0, 'hull.probes': [2, 2],
                 'boat.mass': 184500.0, 'boat.center_of_mass': [0.0, 0.0, 1.8],
                 'sea.sea_state': 5, 'sea.direction': 0.6}
RATES = tuple(rate for rate in settings.RATES if rate <= 128.0)
QUICK_RATES = tuple(rate for rate in settings.RATES[::2] if rate <= 16.0)
QUICK_DURATION = 15.0
# An integrator's error has levelled off when three finer steps in a row change it by less.
LEVEL = 0.05
# What costs more belongs on the front only when it is at least this much more accurate; less is
# within the noise of the clock.
GAIN = 0.9


@lru_cache(maxsize=1)
def trial(items, quick):
    """Return the `settings.Trial` of parameters, given as sorted pairs, solved once a process."""
    stretch, _ = stretches(dict(items))
    if quick:
        stretch = replace(stretch, duration=min(stretch.duration, QUICK_DURATION))
    return Trial.of(stretch)


def scene_items(source):
    """Return the parameters of a scene file or dict as pairs that can be compared and sent."""
    return tuple(sorted(load_scene(source).given.items()))


def tasks(name, items, quick):
    """Return the arguments of `measured`, one tuple for each piece of work."""
    return [(name, items, probes, quick) for probes in settings.choices(dict(items))]


def measured(task):
    """Return [(`Setting`, error m)] of all integrators and steps with one choice of probes."""
    _, items, probes, quick = task
    of_scene = trial(items, quick)
    found = []
    for integrator in settings.INTEGRATORS:
        errors = []
        for rate in QUICK_RATES if quick else RATES:
            setting = Setting(integrator, rate, probes)
            errors.append(of_scene.error(setting))
            found.append((setting, errors[-1]))
            last = errors[-3:]
            if errors[-1] < 2.0 * of_scene.own_error or (
                    len(last) == 3 and max(last) - min(last) < LEVEL * min(last)):
                break
    return found


def rows(name, items, found, quick):
    """
    Return the table's rows of settings ``found`` [(`Setting`, error m)], with their cost.

    Measures the time of a step: to be run on a quiet machine.
    """
    seconds = settings.step_costs(trial(items, quick), repeats=3 if quick else 9)
    cost = {setting: cpu for cpu, setting in settings.candidates(
        seconds, QUICK_RATES if quick else RATES)}
    results = sorted(((cost[setting], setting.probe_count, error, setting)
                      for setting, error in found), key=lambda entry: entry[:3])
    made, best = [], float('inf')
    for cpu, _, error, setting in results:
        # The front: dearer only for a smaller error, and not refused by the library.
        leads = error < GAIN * best and settings.is_allowed(dict(items), setting)
        best = min(best, error) if leads else best
        made.append(_row(name, items, setting, error, cpu, leads))
    return made


def _row(name, items, setting, error, cpu, leads):
    probes = load_scene(dict(items)).boat.hull
    return Row(PART, name, setting.integrator, setting.rate,
               setting.probe_count or len(probes.positions),
               '{}x{}'.format(*setting.probes) if setting.probes else 'as given',
               probes.law, evaluations=settings.force_evaluations(
                   setting.integrator, setting.rate),
               cpu=cpu, error=error, front=int(leads))
