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

"""Doing all the work of the chart: errors on two processes, then times on a quiet one."""

from dataclasses import replace
from pathlib import Path

from . import (hull_accuracy, pareto_front, righting_arm_plot, speed_accuracy_plots as plots,
               summary, table, time_stepping)
from .processes import results

NAME = 'speed_accuracy'


def write_chart(out, scenes, quick, progress):
    """
    Measure, write and draw the chart, and return its summary as lines.

    Main arguments: ``out`` a folder; ``scenes`` parameter files for part three, none for the
    built-in one; ``quick`` takes coarser steps and shorter runs; ``progress`` a function of one
    text.
    """
    sources = ({Path(path).stem: path for path in scenes}
               or {pareto_front.DEFAULT_NAME: pareto_front.DEFAULT_SCENE})
    # Read first: a bad scene is to be told at once.
    items = {name: pareto_front.scene_items(source) for name, source in sources.items()}
    out = Path(out)
    out.mkdir(parents=True, exist_ok=True)
    rows, found = measure_errors(items, quick, progress)
    rows = add_times(rows, found, items, quick, progress)
    table.write(out / f'{NAME}.csv', rows)
    # Read again: pictures and summary are of the digits that the table has.
    rows = table.read(out / f'{NAME}.csv')
    progress('drawing')
    plots.draw_time_stepping(rows, out / f'{NAME}.png')
    plots.draw_model(rows, out / f'{NAME}_model.png')
    righting_arm_plot.draw(out / righting_arm_plot.NAME)
    for name in items:
        suffix = f'_{name}' if scenes else ''
        plots.draw_front(rows, name, out / f'{NAME}_front{suffix}.png')
    lines = list(summary.lines(rows))
    (out / f'{NAME}.txt').write_text('\n'.join(lines) + '\n', encoding='utf-8')
    return lines


def measure_errors(items, quick, progress):
    """
    Return the rows of parts one and two, and {scene: settings found} of part three.

    ``items`` {scene: parameters as pairs}.  No times yet: two processes disturb each other.
    """
    work = ([(pareto_front.measured, task) for name, pairs in items.items()
             for task in pareto_front.tasks(name, pairs, quick)]
            + [(time_stepping.measured, task) for task in time_stepping.tasks(quick)]
            + [(hull_accuracy.measured, task) for task in hull_accuracy.tasks(quick)])
    rows, found = [], {name: [] for name in items}
    for function, (name, *_), part in results(work, progress, 'errors'):
        if function is pareto_front.measured:
            found[name] += part
        else:
            rows += part
    return rows, found


def add_times(rows, found, items, quick, progress):
    """Return all rows, with the CPU time of each."""
    progress('times: steps of the scenes')
    seconds = time_stepping.step_costs(quick)
    rows = [row if row.rate is None or row.part != time_stepping.PART
            else replace(row, cpu=row.rate * seconds[row.scene, row.integrator]) for row in rows]
    progress('times: models of hulls')
    models = [row for row in rows if row.part == hull_accuracy.PART]
    rows = ([row for row in rows if row.part != hull_accuracy.PART]
            + hull_accuracy.costs(models, hull_accuracy.tasks(quick)))
    for name, settings in found.items():
        progress(f'times: settings of {name}')
        rows += pareto_front.rows(name, items[name], settings, quick)
    return rows
