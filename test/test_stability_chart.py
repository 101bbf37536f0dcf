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

from boat_buoyancy.tools.chart import stability_plot
from boat_buoyancy.tools.chart.stability_map import (bobbing_boat, loop_growth, measure_map,
                                                     predicted_angle, predicted_loop_growth,
                                                     scene_points, shipped_scenes)
from boats import METHODS
import numpy as np
import pytest


@pytest.mark.parametrize('integrator', METHODS)
def test_every_run_of_a_grid_agrees_with_the_predicted_boundary(integrator):
    angles, ratios = np.linspace(0.15, 3.15, 8), np.linspace(0.05, 1.95, 6)
    measured = measure_map(integrator, angles, ratios, steps=90)
    predicted = [[angle < predicted_angle(bobbing_boat(ratio), integrator) for angle in angles]
                 for ratio in ratios]
    assert (measured.calm == np.array(predicted)).all()


@pytest.mark.parametrize('integrator, ratio, angle', [
    ('leapfrog', 0.0, 2.0), ('leapfrog', 0.6, 2.5), ('leapfrog', 1.1, np.inf),
    ('implicit', 0.0, np.inf), ('rk4', 0.0, 2.0 * np.sqrt(2.0)), ('euler', 0.0, 0.0),
    ('euler', 0.5, 1.0), ('symplectic_euler', 0.0, 2.0),
    ('symplectic_euler', 0.75, 1.0)])
def test_predicted_boundaries_are_those_of_the_closed_formulas(integrator, ratio, angle):
    # 2 / sqrt(1 - ratio^2); never; 2 sqrt 2; 2 ratio; u^2 / 2 + 2 ratio u = 2.
    assert predicted_angle(bobbing_boat(ratio), integrator) == pytest.approx(angle, rel=1e-5)


@pytest.mark.parametrize('angle', [0.0, 0.0886, 0.5])
def test_the_growth_of_the_game_loop_is_as_predicted(angle):
    for drag in (0.3, 0.9, 1.1, 1.5, 1.9, 2.1, 3.0):
        assert loop_growth(angle, drag) == pytest.approx(
            float(predicted_loop_growth(angle, drag)), abs=1e-6)


def test_every_shipped_scene_is_marked_at_three_rates():
    scenes = shipped_scenes()
    assert {'default', 'barge', 'v4_tuned'} <= {path.stem for path in scenes}
    for path in scenes:
        (first, middle, last), ratio = scene_points(path).T
        assert first == pytest.approx(2.0 * middle) == pytest.approx(last / 0.3)
        assert (ratio >= 0.0).all()


def test_the_chart_is_written_as_a_picture(tmp_path, monkeypatch):
    monkeypatch.setitem(stability_plot.GRIDS, True, (6, 4, 60))
    said = []
    path = stability_plot.draw_stability(tmp_path / 'new', quick=True, progress=said.append)
    assert path == tmp_path / 'new' / 'stability.png'
    assert path.read_bytes().startswith(b'\x89PNG')
    assert len(said) == len(METHODS)
