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

"""What part four of the chart says: how far hulls in waves are off, and what a scene needs."""

import math

from .fidelity import (ALL, ALONE, HULLS, LONG, LONG_WAVES, MODELS, MOTIONS, NONE, PART,
                       PERIODS)

WORDS = {NONE: 'none of the three', ALL: 'all three',
         **{name: f'{name} alone' for name in ALONE}}
# The springs and columns that are spoken of.
COUNT = '6x4'


def overall(rows, model, grid, parts, where=''):
    """
    Return (errors (3,) in % of heave, roll and pitch, µs a step) of a model over all hulls.

    ``where`` as in the table's quantity.  Errors as the root of their mean square, costs as their
    mean.
    """
    of_model = [row for row in rows
                if (row.part, row.model, row.grid, row.parts) == (PART, model, grid, parts)]
    errors = [[row.percent for row in of_model if row.quantity == f'{motion}{where}']
              for motion in MOTIONS]
    costs = [1e6 * row.cpu / row.rate for row in of_model]
    return ([math.sqrt(sum(error ** 2 for error in found) / len(found)) for found in errors],
            sum(costs) / len(costs))


def lines(rows):
    """Return what is printed of the table, the sentences last."""
    return [*_table(rows), '', *sentences(rows)]


def sentences(rows):
    """Return three sentences: when to leave it off, when to give all of it, and never a part."""
    def columns(parts, where=''):
        return overall(rows, 'columns', COUNT, parts, where)

    (before, cheap), (after, dear) = columns(NONE), columns(ALL)
    gentle = columns(NONE, LONG_WAVES)[0]
    springs = overall(rows, 'springs', COUNT, ALL)[0]
    heave, roll, pitch = (f'from {_percent(old)} to {_percent(new)} %'
                          for old, new in zip(before, after))
    return (
        f'Leave it off where a boat only has to feel like one, or where waves are at least '
        f'{LONG:g} times as long as it is and roll does not matter: 24 columns then miss heave by '
        f'{_percent(gentle[0])} % of the amplitude and pitch by {_percent(gentle[2])} % of the '
        'slope.',
        'Give all three, added_mass, damping.linear and wave_force, where waves are shorter, or '
        'where roll or natural periods matter: in waves of '
        f'{PERIODS[0]:g} to {PERIODS[1]:g} s the error of 24 columns falls {heave} in heave, '
        f'{roll} in roll and {pitch} in pitch, for {dear / cheap:.2g} times the time of a step; '
        f'springs, whose GM is wrong, still miss roll by {_percent(springs[1])} %.',
        'Never give added_mass alone, with which the columns miss by '
        f'{_listed(columns("added_mass")[0])} %; wave_force alone, for a hull whose added mass is '
        f'not known, leaves {_listed(columns("wave_force")[0])} %.')


def _table(rows):
    yield ('Error against the boundary element method, waves of '
           f'{PERIODS[0]:g} to {PERIODS[1]:g} s: of heave in % of the amplitude, of roll and '
           'pitch in % of the slope (time of a step)')
    for hull in HULLS:
        yield f'  {hull}'
        for model, probes in MODELS:
            for parts, words in WORDS.items():
                found = [row for row in rows if (row.scene, row.model, row.grid, row.parts) == (
                    hull, model, '{}x{}'.format(*probes), parts) and row.quantity in MOTIONS]
                if found:
                    count = '' if model == 'panels' else f'{probes[0] * probes[1]} '
                    yield (f'    {count}{model}, {words}: '
                           f'{_listed([row.percent for row in found])} '
                           f'({1e6 * found[0].cpu / found[0].rate:.2g} µs)')


def _listed(errors):
    return '{}, {} and {}'.format(*map(_percent, errors))


def _percent(value):
    return f'{value:.0f}' if value >= 9.95 else f'{value:.1f}'
