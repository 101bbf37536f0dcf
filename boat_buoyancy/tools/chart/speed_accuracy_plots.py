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

"""The pictures of the chart: time stepping, model, and both at once."""

import math

import matplotlib

from . import hull_accuracy, pareto_front, time_stepping
from .scenes import SCENES
from ..plot_style import (figure, logarithmic, save, SERIES, SETTINGS, STYLES,
                          title_and_legend)

COSTS = (('evaluations', 'force evaluations per simulated second', 1.0, '{:.0f}'),
         ('cpu', 'CPU time per simulated second [µs]', 1e6, '{:.2g} µs'))
HULL_SERIES = (('column', 'gauss', 'columns at Gauss points'),
               ('column', 'midpoint', 'columns at midpoints'),
               ('column', 'corner', 'columns at corners'),
               ('spring', 'gauss', 'springs at Gauss points'),
               ('spring', 'midpoint', 'springs at midpoints'),
               ('spring', 'corner', 'springs at corners'))
# Errors in % below this are drawn on it, and above the other not at all.
EXACT, ABSURD = 1e-3, 2e3
# Labels on the front this far apart, as a factor of the error.
LABEL_GAP = 1.45


@matplotlib.rc_context(SETTINGS)
def draw_time_stepping(rows, path):
    """Draw the error of every integrator over both costs, a row of panels for each scene."""
    made, panels = figure(9.0, 12.5, len(SCENES), 2)
    for scene, pair in zip(SCENES, panels):
        of_scene = [row for row in rows if row.part == time_stepping.PART
                    and row.scene == scene.name]
        for axes, (cost, label, scale, form) in zip(pair, COSTS):
            for integrator, (colour, marker, name) in STYLES.items():
                points = sorted((scale * getattr(row, cost), row.error) for row in of_scene
                                if row.integrator == integrator)
                axes.plot(*zip(*points), color=colour, marker=marker, label=name)
            logarithmic(axes, label, 'error [m]', bottom=2e-6, top=1.0)
            axes.axhline(scene.tolerance, color='black', linewidth=0.9, linestyle='--')
            best, value = time_stepping.ranking(rows, scene.name, scene.tolerance, cost)[0]
            if math.isfinite(value):
                axes.plot([scale * value], [scene.tolerance], marker='*', markersize=15,
                          color=STYLES[best][0], markeredgecolor='black', linestyle='none',
                          zorder=5)
                axes.set_title(f'{1e3 * scene.tolerance:g} mm: {STYLES[best][2]} at '
                               + form.format(scale * value), loc='right', fontsize=9,
                               fontweight='normal')
        pair[0].set_title(scene.name[0].upper() + scene.name[1:], loc='left')
        pair[1].set_ylabel('')
    title_and_legend(made, 'Error over cost: down and left is better.  Star: the cheapest '
                     'integrator to the accuracy of the dashed line', panels[0][0])
    save(made, path)


@matplotlib.rc_context(SETTINGS)
def draw_model(rows, path):
    """Draw what the number, placement and law of probes make of a hull."""
    made, panels = figure(9.0, 8.2, 2, 2)
    rows = [row for row in rows if row.part == hull_accuracy.PART]
    _hull_panel(panels[0][0], rows, 'box', 'GM')
    panels[0][0].set_title('Barge upright')
    panels[0][0].set_ylabel('error of GM [%]')
    _curved_panel(panels[0][1], rows)
    _waves_panel(panels[1][0], rows)
    _hull_panel(panels[1][1], rows, 'barge in waves', 'wavelength 2 lengths')
    panels[1][1].set_title('Barge in waves of 2 L')
    panels[1][1].set_ylabel('error of motion [% of amplitude]')
    made.suptitle('Columns at Gauss points are exact for a box and converge fastest in waves;\n'
                  'springs (dashed) do not converge, however many', fontsize=11)
    save(made, path)


def _hull_panel(axes, rows, scene, quantity):
    """Draw error over number of probes for every placement and law."""
    for (law, placement, label), (colour, marker) in zip(HULL_SERIES, SERIES):
        points = sorted((row.probes, abs(row.percent)) for row in rows
                        if (row.scene, row.quantity, row.law, row.placement)
                        == (scene, quantity, law, placement))
        _line(axes, points, color=colour, marker=marker, label=label,
              linestyle='-' if law == 'column' else '--')
    _probe_axes(axes)


def _curved_panel(axes, rows):
    """Draw the error of GZ of every hull on columns at Gauss points."""
    for shape, (colour, marker) in zip(hull_accuracy.SHAPES, SERIES):
        for quantity, style in ((hull_accuracy.GZ_SMALL, '-'), (hull_accuracy.GZ_LARGE, ':')):
            points = sorted((row.probes, row.percent) for row in rows
                            if (row.scene, row.quantity, row.law, row.placement)
                            == (shape.name, quantity, 'column', 'gauss'))
            _line(axes, points, color=colour, marker=marker, linestyle=style,
                  label=f'{shape.name}, {quantity[3:-4]}°')
    _probe_axes(axes)
    axes.set_title('Three hulls heeled, columns at Gauss points')
    axes.set_ylabel('error of GZ [% of its largest]')


def _waves_panel(axes, rows):
    """Draw the error of the barge's motion in waves of several lengths."""
    for ratio, (colour, marker) in zip(hull_accuracy.WAVELENGTHS, SERIES):
        for placement, style in (('gauss', '-'), ('midpoint', ':')):
            points = sorted((row.probes, row.percent) for row in rows
                            if (row.scene, row.quantity, row.law, row.placement)
                            == ('barge in waves', f'wavelength {ratio:g} lengths', 'column',
                                placement))
            _line(axes, points, color=colour, marker=marker, linestyle=style,
                  label=f'{ratio:g} L, {placement}')
    _probe_axes(axes)
    axes.set_title('Barge of length L in waves, columns')
    axes.set_ylabel('error of motion [% of amplitude]')


def _line(axes, points, **style):
    """Draw one line of (probes, %), what is exact to round-off on the line for that."""
    axes.plot([x for x, _ in points], [max(y, EXACT) for _, y in points], **style)


def _probe_axes(axes):
    logarithmic(axes, 'number of probes', '', bottom=0.6 * EXACT, top=ABSURD)
    ticks = [count ** 2 for count in hull_accuracy.COUNTS]
    axes.set_xticks(ticks, [str(tick) for tick in ticks])
    powers = range(round(math.log10(EXACT)) + 1, 4)
    axes.set_yticks([EXACT, *(10.0 ** power for power in powers)],
                    ['exact', *(f'{10.0 ** power:g}' for power in powers)])
    axes.minorticks_off()
    axes.legend(fontsize=8, loc='upper center', bbox_to_anchor=(0.5, -0.16), ncols=2)


@matplotlib.rc_context(SETTINGS)
def draw_front(rows, name, path):
    """Draw every setting of one scene, and those that nothing else beats."""
    made, panels = figure(9.0, 6.2, 1, 1)
    axes = panels[0][0]
    rows = [row for row in rows if (row.part, row.scene) == (pareto_front.PART, name)
            and math.isfinite(row.error)]
    for integrator, (colour, marker, label) in STYLES.items():
        points = [(1e6 * row.cpu, row.error) for row in rows if row.integrator == integrator]
        if points:
            axes.plot(*zip(*points), color=colour, marker=marker, linestyle='none', alpha=0.3,
                      markersize=4, label=label)
    best = sorted((row for row in rows if row.front), key=lambda row: row.cpu)
    axes.plot([1e6 * row.cpu for row in best], [row.error for row in best], color='black',
              linewidth=1.2, drawstyle='steps-post', label='nothing beats these')
    last = math.inf
    for row in best:
        colour, marker, _ = STYLES[row.integrator]
        axes.plot([1e6 * row.cpu], [row.error], color=colour, marker=marker, markersize=7,
                  markeredgecolor='black')
        if row.error * LABEL_GAP < last:
            last = row.error
            probes = '' if row.placement == 'as given' else f', {row.placement} probes'
            axes.annotate(f'{row.integrator} {row.rate:g} Hz{probes}', (1e6 * row.cpu, row.error),
                          xytext=(-9, -9), textcoords='offset points', ha='right', va='center',
                          fontsize=8.5)
    logarithmic(axes, 'CPU time per simulated second [µs]',
                'error of the motion, hull and step together [m]')
    _front_limits(axes, best)
    faster = axes.secondary_xaxis('top', functions=(_reciprocal, _reciprocal))
    faster.set_xlabel('times real time')
    title_and_legend(made, f'{name[0].upper()}{name[1:]}: the cheapest setting for every accuracy',
                     axes)
    save(made, path)


def _reciprocal(microseconds):
    """Return times real time for microseconds per simulated second, and back."""
    return 1e6 / (microseconds + 1e-30)


def _front_limits(axes, best):
    """Leave room on the left for the labels."""
    low, high = 1e6 * best[0].cpu, 1e6 * best[-1].cpu
    axes.set_xlim(low / 8.0, high * 4.0)
    axes.set_ylim(best[-1].error / 3.0, min(best[0].error * 3.0, 3.0))
