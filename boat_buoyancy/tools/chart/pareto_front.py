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
from .accuracy import force_evaluations
from .fidelity import NONE
from .settings import Setting
from .stretch import stretches
from .table import Row
from .trial import Trial
from ...physics.scene.scene import load_scene

PART = 'both'
# The scene of the chart when none is given: the barge of `hull_shapes` in sea state 5, held in
# surge and sway as in heave: a boat that glides adds up error of place, which is another scene.
DEFAULT_NAME = 'barge in sea state 5'
DEFAULT_SCENE = {'hull.size': [20.0, 6.0, 3.0], 'hull.bottom': 0.0, 'hull.probes': [2, 2],
                 'boat.mass': 184500.0, 'boat.center_of_mass': [0.0, 0.0, 1.8],
                 'damping.probe': 283097.8, 'sea.sea_state': 5, 'sea.direction': 0.6}
RATES = tuple(rate for rate in settings.RATES if rate <= 128.0)
QUICK_RATES = tuple(rate for rate in settings.RATES[::2] if rate <= 16.0)
QUICK_DURATION = 15.0
# An integrator's error has levelled off when three finer steps in a row change it by less.
LEVEL = 0.05
# What costs more belongs on the front only when it is at least this much more accurate; less is
# within the noise of the clock.
GAIN = 0.9


def stretch_of(items, quick):
    """Return the `Stretch` by which settings are chosen, of parameters as sorted pairs."""
    stretch, _ = stretches(dict(items))
    return replace(stretch, duration=min(stretch.duration, QUICK_DURATION)) if quick else stretch


@lru_cache(maxsize=1)
def trial(items, quick):
    """Return the `settings.Trial` of parameters, given as sorted pairs, solved once a process."""
    return Trial.of(stretch_of(items, quick))


def scene_items(source):
    """Return the parameters of a scene file or dict as pairs that can be compared and sent."""
    return tuple(sorted(load_scene(source).given.items()))


def tasks(name, items, quick):
    """Return the arguments of `measured`, one tuple for each piece of work."""
    return [(name, items, model, quick) for model in settings.choices(dict(items))]


def measured(task):
    """Return [(`Setting`, error m)] of all integrators and steps with one model of the hull."""
    _, items, model, quick = task
    of_scene = trial(items, quick)
    found = []
    # What the others would do on the finest panels takes minutes to see, and never leads.
    for integrator in settings.CONVERGING if model[1] else settings.INTEGRATORS:
        errors = []
        for rate in QUICK_RATES if quick else RATES:
            setting = Setting(integrator, rate, *model)
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
    stretch = stretch_of(items, quick)
    seconds = settings.step_costs(stretch, repeats=3 if quick else 9)
    cost = {setting: cpu for cpu, setting in settings.candidates(
        seconds, QUICK_RATES if quick else RATES)}
    accepts = settings.acceptance(dict(items))
    hulls = {model: stretch.run(settings.hull_values(*model)).boat.hull
             for model in settings.choices(dict(items))}
    results = sorted(((cost[setting], setting, error) for setting, error in found),
                     key=lambda entry: (settings.counted(*entry[:2]), entry[1].probe_count,
                                        entry[2]))
    made, best = [], float('inf')
    for cpu, setting, error in results:
        # The front: dearer only for a smaller error, and nothing that is started with a warning.
        leads = error < GAIN * best and accepts(setting)
        best = min(best, error) if leads else best
        made.append(_row(name, hulls[setting.choice], setting, error, cpu,
                         leads))
    return made


def _row(name, hull, setting, error, cpu, leads):
    return Row(PART, name, setting.integrator, setting.rate, setting.model,
               len(hull.positions), 0 if hull.panels is None else len(hull.panels.triangles),
               '{}x{}'.format(*setting.probes) if setting.probes else None, setting.panel_size,
               evaluations=force_evaluations(setting.integrator, setting.rate),
               cpu=cpu, error=error, front=int(leads),
               parts=NONE if setting.bare else None)


def setting_of(row):
    """Return the `Setting` of a row of the table."""
    probes = tuple(map(int, row.grid.split('x'))) if row.grid else None
    return Setting(row.integrator, row.rate, probes, row.panel_size, row.parts == NONE)
