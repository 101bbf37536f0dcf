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

"""Style of all pictures: colours that survive colour blindness, sizes for a README's width."""

import matplotlib
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

# Okabe and Ito's palette; every colour has a marker of its own besides.
STYLES = {
    'leapfrog': ('#0072B2', 'o', 'leapfrog (default)'),
    'rk4': ('#D55E00', 's', 'rk4'),
    'implicit': ('#009E73', '^', 'implicit'),
    'symplectic_euler': ('#E69F00', 'D', 'plain game loop'),
    'euler': ('#888888', 'x', 'euler'),
}
SERIES = (('#0072B2', 'o'), ('#D55E00', 's'), ('#009E73', '^'), ('#CC79A7', 'D'),
          ('#E69F00', 'v'), ('#56B4E9', 'P'))
SETTINGS = {
    'font.size': 9.5, 'axes.titlesize': 10.5, 'axes.titleweight': 'bold',
    'axes.titlelocation': 'left', 'axes.grid': True, 'grid.color': '#DDDDDD',
    'axes.axisbelow': True, 'axes.spines.top': False, 'axes.spines.right': False,
    'lines.linewidth': 1.6, 'lines.markersize': 4.5, 'legend.frameon': False,
}
DPI = 150


def figure(width, height, rows, columns, **options):
    """Return a figure of ``width`` x ``height`` inches and its axes (rows, columns)."""
    with matplotlib.rc_context(SETTINGS):
        made = Figure(figsize=(width, height), layout='constrained')
        return made, made.subplots(rows, columns, squeeze=False, **options)


def title_and_legend(made, title, axes):
    """Write a title over all panels, and under it the legend of ``axes`` in one line."""
    # The empty lines keep the room that the legend takes, in every version's layout.
    made.suptitle(f'{title}\n \n ', fontsize=11, linespacing=0.9)
    handles, labels = axes.get_legend_handles_labels()
    made.legend(handles, labels, ncols=len(labels), loc='upper center',
                bbox_to_anchor=(0.5, 1.0 - 0.26 / made.get_figheight()))


def save(made, path):
    """Write a figure as PNG, without a date so that equal data give equal files."""
    with matplotlib.rc_context(SETTINGS):
        made.savefig(path, dpi=DPI, metadata={'Software': None})


def logarithmic(axes, x, y, *, bottom=None, top=None):
    """Make both axes logarithmic, with labels and limits of y."""
    axes.set_xscale('log')
    axes.set_yscale('log')
    # As many numbers on a decade as there is room for, whatever part of it there is.
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 3.0)))
    axes.xaxis.set_major_formatter('{x:g}')
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_formatter(NullFormatter())
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if bottom is not None:
        axes.set_ylim(bottom, top)
