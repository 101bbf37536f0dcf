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

"""
Make a table of how a hull answers waves by a boundary element method, to hold models against.

``python -m boat_buoyancy.tools.chart.wave_responses SCENE FILE.json`` made those in ``responses``
of config/default.yaml (box), barge.yaml and wigley.yaml; needs capytaine.
"""

from importlib.metadata import version
import json
from math import pi, radians
from pathlib import Path
import sys

import numpy as np

from .. import command_line
from ..boundary_elements import at_natural_periods, Hulls
from ..progress import Progress
from ...physics.hydrostatics.moving_water import critical_damping
from ...physics.hydrostatics.natural_modes import Equilibrium
from ...physics.hydrostatics.rest import rest_state
from ...physics.scene.scene import load_scene

PROGRAM = 'wave_responses'
COLUMNS = ('T', 'heading_deg', 'heave', 'roll_over_slope', 'pitch_over_slope', 'surge', 'sway')
# s: close together where hulls of 4 to 20 m resonate.
PERIODS = (*np.arange(1.75, 6.5, 0.25).tolist(), 6.5, 7.0, 7.5, 8.0, 9.0, 10.0, 11.0, 12.0, 14.0,
           20.0, 40.0)
HEADINGS = (0, 45, 90)
# Of critical, what friction and eddies take of roll.
VISCOUS_ROLL = 0.05
PANELS = 1500


def table(boat, panels=PANELS, tell=lambda text: None):
    """
    Return a table {name: value} of a boat that lies level, as the files in ``responses`` have it.

    Body axes, about the centre of mass, whose height over the water is in ``com``, m.  Six numbers
    each: ``added_mass`` and ``radiation_damping``, each at its own natural period, and the
    diagonal of ``stiffness``, kg, N, m, s, rad.  ``viscous_roll`` N m/(rad/s) comes on top.
    ``rows`` (n, 7) of ``columns``: T s, heading degrees that the waves go to from ahead, and
    amplitudes over that of the waves, of roll and pitch over their slope.
    """
    hulls, rest = Hulls(boat, panels), Equilibrium.of(boat)
    own = at_natural_periods(boat, panels, tell)
    viscous = np.zeros(6)
    viscous[3] = VISCOUS_ROLL * critical_damping(boat, own.added_mass)[3]
    rows = []
    for number, period in enumerate(PERIODS):
        tell(f'{hulls.panels} panels, period {number + 1} of {len(PERIODS)}: {period} s')
        omega = 2.0 * pi / period
        added, damping = hulls.radiation(period)
        system = (rest.stiffness - omega ** 2 * (rest.mass + added)
                  - 1j * omega * (damping + np.diag(viscous)))
        slope = omega ** 2 / boat.gravity
        for heading in HEADINGS:
            surge, sway, heave, roll, pitch, _ = np.abs(np.linalg.solve(
                system, hulls.excitation(period, radians(heading)))).tolist()
            rows.append([period, heading, *(_rounded(value) for value in (
                heave, roll / slope, pitch / slope, surge, sway))])
    return {
        'source': f'capytaine {version("capytaine")}, {hulls.panels} panels and a lid, deep water',
        'mass': boat.mass, 'inertia': np.diag(boat.inertia).tolist(),
        'com': [0.0, 0.0, _rounded(rest_state(boat).position[2])],
        'water_density': boat.hull.specific_weight / boat.gravity,
        'added_mass': [_rounded(value) for value in own.added_mass],
        'radiation_damping': [_rounded(value) for value in own.damping],
        'viscous_roll': _rounded(viscous[3]),
        'stiffness': [_rounded(value) for value in np.diag(rest.stiffness)],
        'columns': COLUMNS, 'rows': rows}


def _rounded(value):
    """Return a number with six digits, and what is only round-off as 0."""
    return float(f'{value:.6g}') if abs(value) > 1e-9 else 0.0


def main(arguments=None):
    """Run the program and return its exit code."""
    parser = command_line.scene_parser(PROGRAM, __doc__.strip().splitlines()[0],
                                       'config/barge.yaml barge.json')
    parser.add_argument('file', metavar='FILE.json', type=Path, help='where the table goes')
    given = parser.parse_args(arguments)

    def make():
        command_line.check_writable(given.file)
        progress = Progress(sys.stderr)
        try:
            made = table(load_scene(given.scene).boat, tell=progress)
        finally:
            progress.clear()
        rows = ',\n  '.join(json.dumps(row) for row in made.pop('rows'))
        text = ',\n '.join(f'"{name}": {json.dumps(value)}' for name, value in made.items())
        given.file.write_text(f'{{{text},\n "rows": [\n  {rows}]}}\n', encoding='utf-8')

    return command_line.run(PROGRAM, make)


if __name__ == '__main__':
    sys.exit(main())
