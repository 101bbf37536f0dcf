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
Print added mass and damping of a boat to paste: ``buoyancy_hydrodynamics SCENE [--bem]``.

By strips of its hull within a second, or by a boundary element method.
"""

import argparse
import sys

import numpy as np

from . import boundary_elements, command_line
from .progress import Progress
from ..physics.hydrostatics.moving_water import COORDINATES, critical_damping, modes_with
from ..physics.hydrostatics.natural_modes import MODES
from ..physics.hydrostatics.rest import rest_state
from ..physics.hydrostatics.stiffness import still_load
from ..physics.hydrostatics.strip_theory import first_guess
from ..physics.scene.scene import load_scene

PROGRAM = 'buoyancy_hydrodynamics'
ROLL_RATIO = 0.05
# What the boundary element method finds, over what the strips do: least and most of a box, a
# barge, a Wigley hull, a rigid inflatable and a catamaran of two slender hulls.
ADDED_MASS_TRUST = (
    (0.15, 1.7), (0.7, 2.3), (0.6, 0.9), (0.3, 0.9), (0.55, 0.85), (0.6, 2.1))
DAMPING_TRUST = ((0.35, 2.0), (0.15, 2.5), (0.7, 1.7), (0.0, 1.1), (0.6, 1.8), (0.05, 7.0))
# How many times fewer panels tell how much the number of them matters.
COARSER = 4


def by_strips(boat, roll_ratio):
    """
    Return added mass and damping (6,) of a `Boat` by strips, and lines of how far to trust them.

    ``roll_ratio`` of critical is what friction and eddies take of roll.
    """
    added, damping = first_guess(boat, roll_ratio)
    return added, damping, [
        'How far to trust them: first guesses. Of a box, a barge, a Wigley hull, a RIB and a',
        'catamaran a boundary element method (--bem) gives so many times as much:',
        '        added mass      damping',
        *(f'{name:6}  {mass[0]:4} to {mass[1]:4}    {drag[0]:4} to {drag[1]:4}'
          + ' without friction' * (name == 'roll')
          for name, mass, drag in zip(COORDINATES, ADDED_MASS_TRUST, DAMPING_TRUST))]


def by_boundary_elements(boat, roll_ratio, tell):
    """Return the same as `by_strips`, by capytaine; ``tell`` is called with texts as it goes."""
    fine = boundary_elements.at_natural_periods(boat, tell=tell)
    coarse = boundary_elements.at_natural_periods(boat, boundary_elements.PANELS // COARSER, tell)
    critical = critical_damping(boat, fine.added_mass)
    mass = np.abs(coarse.added_mass - fine.added_mass) / (
        np.diag(boat.mass_matrix) + fine.added_mass)
    drag = np.abs(coarse.damping - fine.damping) / critical
    damping = fine.damping + roll_ratio * critical * (np.array(COORDINATES) == 'roll')
    own = {}
    for name, period in zip(COORDINATES, fine.periods.tolist()):
        own.setdefault(period, []).append(name)
    return fine.added_mass, damping, [
        'Each at its own natural period: '
        + '; '.join(f'{", ".join(names)} {period:.3g} s' for period, names in own.items()),
        f'How far to trust them: with {fine.panels} panels in place of {coarse.panels}, mass and '
        'added mass changed by',
        f'at most {100 * mass.max():.1f} %, damping by {100 * drag.max():.1f} % of critical. '
        'Small motions in deep water, without',
        'friction and speed; hulls side by side one by one.']


def text(source, boat, added, damping, roll_ratio, trust):
    """Return what the program prints, lines of YAML."""
    kept = [np.maximum(values, 0.0) for values in (added, damping)]
    below = [name for values in (added, damping)
             for name, value in zip(COORDINATES, values) if value < 0.0]
    before, after = modes_with(boat, np.zeros(6)), modes_with(boat, *kept)
    # Both are of a hull that is wet as at rest; the parameters are of one that is all wet.
    kept = [values / still_load(boat, rest_state(boat))[0].wetness for values in kept]
    return '\n'.join([
        f'# {source}: surge, sway, heave, roll, pitch, yaw; kg, kg m2, N/(m/s), N m/(rad/s);',
        '# about the centre of mass, body axes. Paste these under ros__parameters, indented.',
        f'added_mass: {_listed(kept[0])}',
        f'damping.linear: {_listed(kept[1])}',
        'wave_force: froude_krylov',
        '#',
        '#         period s: without  with the water   damping ratio',
        *(f'# {name:6} {before[name].period:18.4g} {after[name].period:15.4g} '
          f'{after[name].damping_ratio:15.3f}' for name in MODES),
        *(f'# {line}' for line in (
            *trust,
            f'Damping of roll: {roll_ratio:g} of critical are for friction and eddies '
            '(--roll-damping).',
            'Damping of surge, sway and yaw: of the waves that it makes as it rolls and pitches; '
            'measure',
            'how it drives and turns, and take that in its place.',
            *(f'Came out below 0 and was set to 0: {name}.' for name in dict.fromkeys(below))))])


def _listed(values):
    """Return numbers with five digits, as ROS and YAML both read them."""
    return '[' + ', '.join(np.format_float_positional(
        value, precision=5, fractional=False, trim='0') for value in values) + ']'


def ratio(word):
    """Return a damping ratio from the command line."""
    try:
        value = float(word)
    except ValueError:
        value = -1.0
    if not 0.0 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f'expected a damping ratio from 0 to 1, got {word!r}')
    return value


def main(arguments=None):
    """Run the program and return its exit code."""
    parser = command_line.scene_parser(
        PROGRAM, 'Print added mass and damping of a boat as parameters to paste, with the natural '
        'periods that it has without and with them.', 'config/barge.yaml --bem')
    parser.add_argument('--bem', action='store_true',
                        help='by a boundary element method, capytaine, within a minute or so; '
                        'else by strips, within a second')
    parser.add_argument('--roll-damping', metavar='RATIO', type=ratio, default=ROLL_RATIO,
                        help='what friction and eddies take of roll, 1 is critical '
                        '(default: %(default)s)')
    given = parser.parse_args(arguments)

    def work():
        boat, progress = load_scene(given.scene).boat, Progress(sys.stderr)
        try:
            found = (by_boundary_elements(boat, given.roll_damping, progress) if given.bem
                     else by_strips(boat, given.roll_damping))
        finally:
            progress.clear()
        added, damping, trust = found
        print(text(given.scene, boat, added, damping, given.roll_damping, trust))

    return command_line.run(PROGRAM, work)


if __name__ == '__main__':
    sys.exit(main())
