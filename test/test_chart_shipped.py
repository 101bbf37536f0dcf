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

"""The chart that is shipped in doc/ says what doc/accuracy.md says of it."""

import math
from pathlib import Path

from boat_buoyancy.tools.chart import summary, time_stepping
from boat_buoyancy.tools.chart.scenes import BY_NAME, SCENES
from boat_buoyancy.tools.chart.table import read
import pytest

DOC = Path(__file__).parents[1] / 'doc'


@pytest.fixture(scope='module')
def rows():
    """Return the rows of the table in doc/."""
    return read(DOC / 'speed_accuracy.csv')


def ranking(rows, scene, cost='evaluations'):
    return dict(time_stepping.ranking(rows, scene, BY_NAME[scene].tolerance, cost))


def test_every_scene_has_the_integrator_that_is_told_to_be_best(rows):
    best = {scene.name: next(iter(ranking(rows, scene.name))) for scene in SCENES}
    assert best == {'free decay': 'rk4', 'irregular sea': 'leapfrog', 'drop': 'leapfrog',
                    'stiff barge': 'implicit'}


def test_the_plain_game_loop_is_ahead_nowhere_but_where_its_cheaper_step_makes_up_for_more(rows):
    for scene in BY_NAME:
        ranked = ranking(rows, scene)
        assert ranked['leapfrog'] < ranked['symplectic_euler']
    for scene in SCENES:
        ranked = ranking(rows, scene.name, 'cpu')
        assert ranked['leapfrog'] < ranked['symplectic_euler']
    # doc/accuracy.md says that they are level there: a tenth of each other.
    ranked = ranking(rows, 'stiff barge in swell', 'cpu')
    assert ranked['symplectic_euler'] == pytest.approx(ranked['leapfrog'], rel=0.1)


def test_implicit_kills_free_oscillation_and_lags_a_stiff_boat_in_swell(rows):
    assert math.isinf(ranking(rows, 'free decay')['implicit'])
    assert list(ranking(rows, 'stiff barge in swell'))[-2:] == ['implicit', 'euler']


def test_summary_is_that_of_the_table(rows):
    written = (DOC / 'speed_accuracy.txt').read_text(encoding='utf-8')
    assert written.splitlines() == list(summary.lines(rows))
