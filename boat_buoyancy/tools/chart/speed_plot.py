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

"""The picture of the speed of the step."""

import matplotlib

from .speed import BASE_WAVES, Case, LARGE_FLEET, PROBES
from .speed_report import microseconds, sizes
from ..plot_style import figure, logarithmic, save, SERIES, SETTINGS, title_and_legend

TICKS = [digit * 10.0 ** power for power in range(-2, 3) for digit in (1, 2, 5)]


@matplotlib.rc_context(SETTINGS)
def draw(best, path):
    """Draw cost per boat-step over the size of the fleet, and over the number of waves."""
    made, panels = figure(9.0, 4.6, 1, 2, sharey=True)
    left, right = panels[0]
    fleets, waves = sizes(best)
    boats = [1, *fleets]
    for probes, (colour, marker) in zip(PROBES, SERIES):
        _pair(left, best, [(Case('step', b, probes), b) for b in boats], colour, marker,
              f'{probes} probes')
        # Flat water has no place on a logarithmic axis: it stands half a wave to the left.
        _pair(right, best, [(Case('step', LARGE_FLEET, probes, w), max(w, 0.5)) for w in waves],
              colour, marker, f'{probes} probes')
        _others(left, best, probes, boats, colour, marker)
    logarithmic(left, 'boats stepped together', 'time per boat-step [µs]')
    logarithmic(right, 'waves', '')
    left.set_title(f'Over boats ({BASE_WAVES} waves)')
    right.set_title(f'Over waves ({LARGE_FLEET} boats)')
    right.set_xticks([max(w, 0.5) for w in waves], [str(w) for w in waves])
    left.set_xticks(boats, [f'{b:,}'.replace(',', ' ') for b in boats])
    low, high = left.get_ylim()
    ticks = [tick for tick in TICKS if low <= tick <= high]
    left.set_yticks(ticks, [f'{tick:g}' for tick in ticks])
    for axes in (left, right):
        axes.minorticks_off()
    title_and_legend(made, 'Time of one step of one boat: alone, in a run, and in fleets', left)
    save(made, path)


def _others(axes, best, probes, boats, colour, marker):
    """Draw hollow what one boat costs in a run, and fleets with all processors."""
    first = marker == SERIES[0][1]
    found = [('run', 1), *(('threads', b) for b in boats if b >= LARGE_FLEET)]
    for place, (kind, count) in enumerate(found):
        axes.plot([count], [microseconds(best, Case(kind, count, probes))], linestyle='none',
                  marker=marker if kind == 'threads' else '_', color=colour,
                  markerfacecolor='none', markersize=7,
                  label={0: '1 boat in a run', 1: 'all threads'}.get(place) if first else None)


def _pair(axes, best, cases, colour, marker, label):
    """Draw the step, and below it dashed the trigonometry alone."""
    axes.plot([x for _, x in cases], [microseconds(best, case) for case, _ in cases],
              color=colour, marker=marker, label=label)
    limits = [(Case('trigonometry', case.boats, case.probes, case.waves), x)
              for case, x in cases]
    found = [(x, microseconds(best, limit)) for limit, x in limits if limit in best]
    axes.plot(*zip(*found), color=colour, linestyle='--', linewidth=1.0,
              label="NumPy's cosines" if marker == SERIES[0][1] else None)
