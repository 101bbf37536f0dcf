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

from .speed import BASE_WAVES, Case, PROBES
from .speed_report import microseconds
from ..plot_style import figure, logarithmic, save, SERIES, SETTINGS, title_and_legend


@matplotlib.rc_context(SETTINGS)
def draw(best, path):
    """Draw cost per boat-step over the size of the fleet, and over the number of waves."""
    made, panels = figure(9.0, 4.6, 1, 2, sharey=True)
    left, right = panels[0]
    steps = [case for case in best if case.kind == 'step' and case.integrator == 'leapfrog'
             and case.damped]
    boats = sorted({case.boats for case in steps})
    waves = sorted({case.waves for case in steps})
    fleet = min(1000, boats[-1])
    for probes, (colour, marker) in zip(PROBES, SERIES):
        _pair(left, best, [(Case('step', b, probes, BASE_WAVES), b) for b in boats], colour,
              marker, f'{probes} probes')
        # Flat water has no place on a logarithmic axis: it stands half a wave to the left.
        _pair(right, best, [(Case('step', fleet, probes, w), max(w, 0.5)) for w in waves],
              colour, marker, f'{probes} probes')
    logarithmic(left, 'boats stepped together', 'CPU time per boat-step [µs]')
    logarithmic(right, 'waves', '')
    left.set_title(f'Over boats ({BASE_WAVES} waves)')
    right.set_title(f'Over waves ({fleet} boats)')
    right.set_xticks([max(w, 0.5) for w in waves], [str(w) for w in waves])
    left.set_xticks(boats, [f'{b:,}'.replace(',', ' ') for b in boats])
    for axes in (left, right):
        axes.minorticks_off()
    title_and_legend(made, 'CPU time of one step of one boat: fleets share the cost of a call, '
                     'many waves cost less than their plain cosines', left)
    save(made, path)


def _pair(axes, best, cases, colour, marker, label):
    """Draw the step, and below it dashed the trigonometry alone."""
    axes.plot([x for _, x in cases], [microseconds(best, case) for case, _ in cases],
              color=colour, marker=marker, label=label)
    limits = [(Case('trigonometry', case.boats, case.probes, case.waves), x)
              for case, x in cases]
    found = [(x, microseconds(best, limit)) for limit, x in limits if limit in best]
    axes.plot(*zip(*found), color=colour, linestyle='--', linewidth=1.0,
              label='cosines alone' if marker == 'o' else None)
