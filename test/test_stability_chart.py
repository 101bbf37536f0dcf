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

"""The stability chart shows what the shipped code does, and its prediction agrees with it."""

from boat_buoyancy.tools.chart import stability_map, stability_plot
from boat_buoyancy.tools.chart.stability_map import (bobbing_boat, loop_growth, measure_map,
                                                     predicted_angle, predicted_loop_growth,
                                                     scene_points)
from boat_buoyancy.tools.command_line import shipped_scenes
from boats import INTEGRATORS
import numpy as np
import pytest


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_every_run_of_a_grid_agrees_with_the_predicted_boundary(integrator, monkeypatch):
    angles, ratios = np.linspace(0.15, 3.15, 8), np.linspace(0.05, 1.95, 6)
    monkeypatch.setattr(stability_map, 'BOUNDARY', 2)
    measured = measure_map(integrator, angles, ratios, steps=90)
    predicted = [predicted_angle(bobbing_boat(ratio), integrator) for ratio in ratios]
    assert (measured.calm == (angles < np.reshape(predicted, (-1, 1)))).all()


def test_the_growth_of_the_game_loop_is_as_the_closed_form_says():
    for angle in (0.0, 0.0886, 0.5):
        for drag in (0.3, 0.9, 1.1, 1.5, 1.9, 2.1, 3.0):
            assert loop_growth(angle, drag) == pytest.approx(
                float(predicted_loop_growth(angle, drag)), abs=1e-8)


def test_every_shipped_scene_is_marked_at_three_rates():
    scenes = shipped_scenes()
    assert {'default', 'barge', 'v4_tuned'} <= {path.stem for path in scenes}
    for path in scenes:
        (first, middle, last), ratio = scene_points(path).T
        assert first == pytest.approx(2.0 * middle) == pytest.approx(last / 0.3)
        assert (ratio >= 0.0).all()


def test_the_chart_is_written_as_a_picture(tmp_path, monkeypatch):
    monkeypatch.setitem(stability_plot.GRIDS, True, (6, 4, 60))
    monkeypatch.setattr(stability_map, 'BOUNDARY', 5)
    said = []
    path = stability_plot.draw_stability(tmp_path / 'new', quick=True, progress=said.append)
    assert path == tmp_path / 'new' / 'stability.png'
    assert path.read_bytes().startswith(b'\x89PNG')
    assert len(said) == len(INTEGRATORS)
