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

"""The table and the pictures of the chart that are shipped in doc/, and what the text says."""

import math
from pathlib import Path

from boat_buoyancy.tools import chart_summary, hull_accuracy, time_stepping
from boat_buoyancy.tools.chart_scenes import BY_NAME, SCENES
from boat_buoyancy.tools.chart_table import read
from PIL import Image
import pytest

DOC = Path(__file__).parents[1] / 'doc'


@pytest.fixture(scope='module')
def rows():
    """Return the rows of the table in doc/."""
    return read(DOC / 'speed_accuracy.csv')


def ranking(rows, scene, cost='evaluations'):
    return dict(time_stepping.ranking(rows, scene, BY_NAME[scene].tolerance, cost))


def test_orders_of_convergence_on_the_smooth_scene(rows):
    found = time_stepping.orders(rows, *time_stepping.SMOOTH)
    assert found['leapfrog'] == pytest.approx(2.0, abs=0.05)
    assert found['rk4'] == pytest.approx(4.0, abs=0.05)
    assert found['symplectic_euler'] == pytest.approx(1.0, abs=0.05)
    # These two damp or feed the oscillation itself, and reach their order late.
    assert found['implicit'] == pytest.approx(1.0, abs=0.15)
    assert found['euler'] == pytest.approx(1.0, abs=0.15)


def test_orders_of_convergence_at_kinks(rows):
    found = time_stepping.orders(rows, *time_stepping.KINKED)
    assert found['leapfrog'] == pytest.approx(2.0, abs=0.15)
    assert found['rk4'] == pytest.approx(2.0, abs=0.15)
    assert found['symplectic_euler'] == pytest.approx(1.0, abs=0.05)


def test_every_scene_has_the_method_that_is_told_to_be_best(rows):
    best = {scene.name: next(iter(ranking(rows, scene.name))) for scene in SCENES}
    assert best == {'free decay': 'rk4', 'irregular sea': 'leapfrog', 'drop': 'leapfrog',
                    'stiff barge': 'implicit'}


def test_the_plain_game_loop_is_nowhere_ahead(rows):
    for scene in BY_NAME:
        for cost in ('evaluations', 'cpu'):
            ranked = ranking(rows, scene, cost)
            assert ranked['leapfrog'] < ranked['symplectic_euler']


def test_implicit_kills_free_oscillation_and_lags_a_stiff_boat_in_swell(rows):
    assert math.isinf(ranking(rows, 'free decay')['implicit'])
    swell = ranking(rows, 'stiff barge in swell')
    assert swell['implicit'] > 10 * swell['leapfrog']


def test_reference_is_far_better_than_anything_it_judges(rows):
    own = {row.scene: row.error for row in rows if row.method == 'reference'}
    assert set(own) == set(BY_NAME)
    assert max(own.values()) < 1e-11


def test_front_falls_as_it_gets_dearer(rows):
    for best in chart_summary.fronts(rows).values():
        assert len(best) > 5
        errors = [row.error for row in best]
        assert errors == sorted(errors, reverse=True)


def test_columns_at_gauss_points_are_exact_for_the_box(rows):
    found = [row for row in rows if (row.scene, row.law, row.placement)
             == ('box', 'column', 'gauss') and row.quantity != hull_accuracy.GZ_LARGE]
    assert len(found) == 3 * len(hull_accuracy.COUNTS)
    assert max(abs(row.percent) for row in found) < 1e-6


def test_summary_is_that_of_the_table(rows):
    # Orders and counts; the last digit of a time may be rounded twice.
    text = (DOC / 'speed_accuracy.txt').read_text(encoding='utf-8').splitlines()
    assert len(text) == len(list(chart_summary.lines(rows)))
    assert [line for line in text if 'order' in line] == [
        line for line in chart_summary.lines(rows) if 'order' in line]


def test_pictures_are_there():
    for name in ('speed_accuracy', 'speed_accuracy_model', 'speed_accuracy_front'):
        assert Image.open(DOC / f'{name}.png').width == 1350
