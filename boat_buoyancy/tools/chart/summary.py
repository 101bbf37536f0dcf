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

"""What the chart's table says, in a few lines."""

import math

from . import hull_accuracy, pareto_front, time_stepping
from .scenes import SCENES, SWELL

# Errors in % below this are round-off.
EXACT = 1e-6


def lines(rows):
    """Return the summary of a whole table as lines."""
    return [*_stepping(rows), *_model(rows), *_fronts(rows)]


def fronts(rows):
    """Return {scene: its rows on the front, cheapest first} of part three."""
    found = {}
    for row in rows:
        if row.part == pareto_front.PART:
            found.setdefault(row.scene, []).extend([row] if row.front else [])
    return {name: sorted(best, key=lambda row: row.cpu) for name, best in found.items()}


def _stepping(rows):
    own = [row for row in rows if row.integrator == 'reference']
    if not own:
        return []
    worst = max(own, key=lambda row: row.error)
    yield ('Time stepping: force evaluations per simulated second to an accuracy '
           '(CPU time per simulated second)')
    for scene in (*SCENES, SWELL):
        cpu = dict(time_stepping.ranking(rows, scene.name, scene.tolerance, 'cpu'))
        ranked = ', '.join(
            f'{name} {cost:.0f} ({1e6 * cpu[name]:.3g} µs)' if math.isfinite(cost)
            else f'{name} not at all' for name, cost in time_stepping.ranking(
                rows, scene.name, scene.tolerance))
        yield f'  {scene.name} to {1e3 * scene.tolerance:g} mm: {ranked}'
    for scene, finest in (time_stepping.SMOOTH, time_stepping.KINKED):
        yield f'  observed order on {scene}: ' + ', '.join(
            f'{name} {order:.2f}'
            for name, order in time_stepping.orders(rows, scene, finest).items())
    yield (f'  own error of the reference: at most {worst.error:.1g} m, rms '
           f'({worst.scene})')


def _model(rows):
    rows = [row for row in rows if row.part == hull_accuracy.PART]
    if not rows:
        return
    yield 'Model: error against the hull itself (CPU time of a step)'
    for shape in hull_accuracy.SHAPES:
        for quantity in ('GM', *hull_accuracy.RIGHTING.values()):
            yield from _models(rows, shape.name, quantity)
    for scene in hull_accuracy.RATIOS:
        yield from _models(rows, scene, 'motion')


def _models(rows, scene, quantity):
    for model in ('springs', 'columns', 'panels'):
        found = sorted((row for row in rows if (row.scene, row.quantity, row.model)
                        == (scene, quantity, model)), key=lambda row: row.panels or row.probes)
        yield f'  {quantity} of the {scene}, {model}: ' + ', '.join(
            f'{row.panels or row.probes} {_percent(row)} ({1e6 * row.cpu / row.rate:.2g} µs)'
            for row in found)


def _percent(row):
    return 'exact' if abs(row.percent) < EXACT else f'{row.percent:.3g} %'


def _fronts(rows):
    for name, best in fronts(rows).items():
        yield f'Both at once: {name}, the cheapest settings that start without a warning'
        for row in best:
            setting = pareto_front.setting_of(row)
            yield f'  {row.error:.2g} m, {1e6 * row.cpu:.3g} µs: ' + ', '.join(
                f'{name}: {value}' for name, value in setting.values().items())
