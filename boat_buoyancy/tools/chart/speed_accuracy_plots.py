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
from ..plot_style import (figure, logarithmic, save, SETTINGS, STYLES,
                          title_and_legend)

COSTS = (('evaluations', 'force evaluations per simulated second', 1.0, '{:.0f}'),
         ('cpu', 'CPU time per simulated second [µs]', 1e6, '{:.2g} µs'))
# How each model of a hull is drawn, and what its numbers count.
MODELS = {'springs': ('#D55E00', 's', 'springs, as in games'),
          'columns': ('#0072B2', 'o', 'columns'), 'panels': ('#009E73', '^', 'panels')}
# Errors in % below this are drawn on it, and above the other not at all.
EXACT, ABSURD = 1e-2, 1e3
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
    """Draw the error over the cost of every model of three hulls heeled and of one in waves."""
    made, panels = figure(9.0, 7.4, 2, 2, sharex=True)
    rows = [row for row in rows if row.part == hull_accuracy.PART]
    for axes, shape in zip(panels.flat, hull_accuracy.SHAPES):
        of_shape = [row for row in rows if row.scene == shape.name]
        _models(axes, {f'heeled to {heel:g}°': [row for row in of_shape
                                                if row.quantity == quantity]
                       for heel, quantity in hull_accuracy.RIGHTING.items()})
        axes.set_title(f'{shape.name[0].upper()}{shape.name[1:]}, heeled')
        axes.set_ylabel('error of GZ [% of its largest]')
    axes = panels[1][1]
    _models(axes, {f'waves {ratio:g} L long': [row for row in rows if row.scene == scene]
                   for scene, ratio in hull_accuracy.RATIOS.items()})
    axes.set_title('Box of length L in waves')
    axes.set_ylabel('error of motion [% of amplitude]')
    title_and_legend(made, 'Three models of a hull, error over cost: down and left is better.  '
                     'Numbers: how many of them', panels[0][0])
    save(made, path)


def _models(axes, cases):
    """Draw error over cost of each model, for two cases {meaning: rows}: full and dotted."""
    meanings = []
    for (meaning, rows), style in zip(cases.items(), '-:'):
        meanings += axes.plot([], [], color='black', linestyle=style)
        for model, (colour, marker, label) in MODELS.items():
            points = sorted((1e6 * row.cpu / row.rate, min(max(abs(row.percent), EXACT), ABSURD),
                             row.panels or row.probes) for row in rows if row.model == model)
            axes.plot([point[0] for point in points], [point[1] for point in points], style,
                      color=colour, marker=marker, label=label if style == '-' else None)
            for x, y, count in points[::max(1, len(points) - 1)] if style == '-' else ():
                axes.annotate(f'{count}', (x, y), xytext=(0, 9 if model == 'springs' else -9),
                              textcoords='offset points', ha='center', va='center', color=colour,
                              fontsize=8.5)
    logarithmic(axes, 'CPU time of a step [µs]', '', bottom=0.3 * EXACT, top=1.6 * ABSURD)
    axes.tick_params(labelbottom=True)
    powers = range(round(math.log10(EXACT)) + 1, 4)
    axes.set_yticks([EXACT, *(10.0 ** power for power in powers)],
                    ['exact', *(f'{10.0 ** power:g}' for power in powers)])
    axes.yaxis.minorticks_off()
    # Where nothing is drawn in any of them.
    axes.legend(meanings, list(cases), fontsize=8.5, loc='lower right',
                bbox_to_anchor=(1.0, 0.1))


@matplotlib.rc_context(SETTINGS)
def draw_front(rows, name, path):
    """Draw every setting of one scene, and those that nothing else beats."""
    made, panels = figure(9.0, 6.2, 1, 1)
    axes = panels[0][0]
    rows = [row for row in rows if (row.part, row.scene) == (pareto_front.PART, name)
            and math.isfinite(row.error)]
    for integrator, (colour, marker, label) in STYLES.items():
        for filled in (True, False):
            points = [(1e6 * row.cpu, row.error) for row in rows if row.integrator == integrator
                      and (row.model != 'panels') == filled]
            if points:
                axes.plot(*zip(*points), color=colour, marker=marker, linestyle='none', alpha=0.3,
                          markersize=4, label=label if filled else None,
                          markerfacecolor=colour if filled else 'none')
    best = sorted((row for row in rows if row.front), key=lambda row: row.cpu)
    axes.plot([1e6 * row.cpu for row in best], [row.error for row in best], color='black',
              linewidth=1.2, drawstyle='steps-post', label='cheapest without a warning')
    last = math.inf
    for row in best:
        colour, marker, _ = STYLES[row.integrator]
        axes.plot([1e6 * row.cpu], [row.error], color=colour, marker=marker, markersize=7,
                  **({'markerfacecolor': 'white', 'markeredgewidth': 1.8}
                     if row.model == 'panels' else {'markeredgecolor': 'black'}))
        if row.error * LABEL_GAP < last:
            last = row.error
            axes.annotate(f'{pareto_front.setting_of(row)}', (1e6 * row.cpu, row.error),
                          xytext=(-9, -9), textcoords='offset points', ha='right', va='center',
                          fontsize=8.5)
    logarithmic(axes, 'CPU time per simulated second [µs]',
                'error of the motion, hull and step together [m]')
    _front_limits(axes, best or rows)
    faster = axes.secondary_xaxis('top', functions=(_reciprocal, _reciprocal))
    faster.set_xlabel('times real time')
    title_and_legend(made, f'{name[0].upper()}{name[1:]}: the cheapest setting for every accuracy.'
                     '  Hollow: panels', axes)
    save(made, path)


def _reciprocal(microseconds):
    """Return times real time for microseconds per simulated second, and back."""
    return 1e6 / (microseconds + 1e-30)


def _front_limits(axes, best):
    """Leave room on the left for the labels."""
    low, high = 1e6 * best[0].cpu, 1e6 * best[-1].cpu
    axes.set_xlim(low / max(8.0, (high / low) ** 0.3), high * 4.0)
    axes.set_ylim(best[-1].error / 3.0, min(best[0].error * 3.0, 3.0))
