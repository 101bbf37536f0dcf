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

"""The picture of part four of the chart: what moving in waves as a hull does costs and brings."""

import matplotlib
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from .fidelity import ALL, ALONE, MOTIONS, NONE, PERIODS
from .fidelity_text import COUNT, overall
from .speed_accuracy_plots import MODELS as STYLES
from ..plot_style import figure, logarithmic, save, SETTINGS

# The models that are drawn, and on which side of their marker their name stands.
DRAWN = {('springs', (2, 2)): 11, ('columns', (2, 2)): -11, ('columns', (6, 4)): -11,
         ('panels', (6, 4)): -11}
UNITS = {'heave': 'amplitude', 'roll': 'slope', 'pitch': 'slope'}
TITLE = 'Added mass, damping and wave force: all three bring a boat close to a real hull in waves'


@matplotlib.rc_context(SETTINGS)
def draw(rows, path):
    """Draw the error of heave, roll and pitch over the cost of a step, an arrow for each model."""
    made, panels = figure(9.0, 4.2, 1, len(MOTIONS), sharex=True, sharey=True)
    for number, (axes, motion) in enumerate(zip(panels[0], MOTIONS)):
        for (model, probes), side in DRAWN.items():
            colour, marker, _ = STYLES[model]
            bare, whole = (_place(rows, number, model, '{}x{}'.format(*probes), parts)
                           for parts in (NONE, ALL))
            for place, face in ((bare, 'white'), (whole, colour)):
                axes.plot(*place, color=colour, marker=marker, markersize=7.5, linestyle='none',
                          markerfacecolor=face, markeredgewidth=1.6)
            axes.annotate('', whole, bare, arrowprops={
                'arrowstyle': '->', 'color': colour, 'linewidth': 1.5, 'shrinkA': 4, 'shrinkB': 4})
            axes.annotate(model if model == 'panels' else f'{probes[0] * probes[1]} {model}',
                          (whole[0], max(bare[1], whole[1]) if side > 0 else min(
                              bare[1], whole[1])), (0, side), textcoords='offset points',
                          ha='center', va='bottom' if side > 0 else 'top', color=colour,
                          fontsize=9)
        for parts, marker in zip(ALONE, 'x+'):
            axes.plot(*_place(rows, number, 'columns', COUNT, parts), color=STYLES['columns'][0],
                      marker=marker, markersize=7.5, markeredgewidth=1.8, linestyle='none')
        logarithmic(axes, 'time of a step [µs]', '')
        axes.margins(x=0.2, y=0.13)
        axes.set_title(f'{motion[0].upper()}{motion[1:]}, % of the {UNITS[motion]}')
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 3.0)))
        axes.yaxis.set_major_formatter('{x:g}')
    panels[0][0].set_ylabel('error in waves of {:g} to {:g} s'.format(*PERIODS))
    _legend(made)
    save(made, path)


def _place(rows, number, model, grid, parts):
    """Return where a model stands in one of the panels: µs a step, error in %."""
    errors, cost = overall(rows, model, grid, parts)
    return cost, errors[number]


def _legend(made):
    """Write the title, and under it what the markers mean."""
    made.suptitle(f'{TITLE}\n ', fontsize=10.5, fontweight='bold')
    handles = [Line2D([], [], color='#555555', marker=marker, linestyle='none', markersize=7,
                      markerfacecolor=face, markeredgewidth=1.6)
               for marker, face in (('o', 'white'), ('o', '#555555'), ('x', 'none'),
                                    ('+', 'none'))]
    labels = 'none of the three', 'all three', 'added mass alone', 'wave force alone'
    made.legend(handles, labels, ncols=4, loc='upper center', bbox_to_anchor=(0.5, 0.96))
