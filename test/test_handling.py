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

"""How a boat answers a push, against the motion itself and an independent solution."""

from pathlib import Path

from boat_buoyancy.physics import load_scene
from boat_buoyancy.tools.handling import Axis, handling
from boat_buoyancy.tools.report import main
import numpy as np
import pytest
from scipy.integrate import solve_ivp

CONFIG = Path(__file__).parents[1] / 'config'
# What the speed at rest leaves out: the boat trims and heels a little as it is driven.
COUPLING = 0.03


@pytest.mark.parametrize('scene', ['default', 'wam_v', 'otter', 'wigley'])
def test_the_speed_ahead_is_the_one_that_a_pushed_boat_comes_to(scene):
    scene = load_scene(CONFIG / f'{scene}.yaml')
    # A small push, as a strong one lifts the bow.
    push = 0.1 * scene.boat.mass
    found = handling(scene, push)
    surge = found['speed_ahead_m_per_s']
    # Where drag is linear what is left falls by e within m / c, and faster where it is not.
    settled = 6.0 * 2.0 * scene.boat.mass * surge / push
    run = scene.simulation().run(settled, [push, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert run.body_velocity[-1][0] == pytest.approx(surge, rel=COUPLING)


@pytest.mark.parametrize('scene', ['default', 'wam_v', 'otter', 'wigley'])
def test_the_time_to_turn_is_that_of_a_boat_that_is_turned(scene):
    scene = load_scene(CONFIG / f'{scene}.yaml')
    push = 0.1 * scene.boat.mass
    found = handling(scene, push)
    run = scene.simulation(rate=200.0).run(
        3.0 * found['time_to_turn_90_deg_s'],
        [0.0, 0.0, 0.0, 0.0, 0.0, found['turning_torque_n_m']])
    turned = run.time[np.argmax(np.unwrap(run.yaw) >= np.pi / 2)]
    assert turned == pytest.approx(found['time_to_turn_90_deg_s'], rel=COUPLING)


@pytest.mark.parametrize('linear', [0.0, 1e-6, 0.3, 40.0])
@pytest.mark.parametrize('quadratic', [0.0, 1e-9, 0.5, 30.0])
def test_way_and_time_are_those_of_the_differential_equation(linear, quadratic):
    axis, push, distance = Axis(2.5, linear, quadratic), 7.0, 3.0

    def arrived(_, y):
        return y[0] - distance

    arrived.terminal = True
    solved = solve_ivp(
        lambda _, y: [y[1], (push - axis.drag(y[1])) / axis.inertia], (0.0, 1e4), [0.0, 0.0],
        events=arrived, rtol=1e-10, atol=1e-12)
    assert axis.time_to(distance, push) == pytest.approx(solved.t[-1], rel=1e-7)
    steady = axis.steady_speed(push)
    assert np.isinf(steady) if linear == quadratic == 0.0 else axis.drag(steady) == (
        pytest.approx(push, rel=1e-12))


@pytest.mark.parametrize('part, grows', [(0.8, False), (1.2, True)])
def test_a_boat_keeps_its_course_up_to_the_speed_that_is_told_and_not_beyond(part, grows):
    mass, added = 2000.0, [50.0, 700.0, 900.0, 100.0, 300.0, 200.0]
    scene = load_scene({
        'boat.mass': mass, 'hull.size': [4.0, 1.5, 1.0], 'added_mass': added,
        'boat.inertia': [800.0, 2500.0, 2600.0],
        'damping.linear': [60.0, 300.0, 800.0, 300.0, 900.0, 500.0], 'damping.probe': 0.0,
        'start.angular_velocity': [0.0, 0.0, 1e-6]})
    steady = handling(scene)['steady_course_up_to_m_per_s']
    assert steady == pytest.approx(
        np.sqrt(300.0 * 500.0 / ((mass + added[0]) * (added[1] - added[0]))))
    # Pushed to a speed a little below and above it.
    run = scene.simulation().run(200.0, [60.0 * part * steady, 0.0, 0.0, 0.0, 0.0, 0.0])
    turning = np.abs(run.angular_velocity[:, 2])
    assert (turning[-1] > 2.0 * turning[10000]) == grows


def test_thrusters_push_with_all_that_they_have():
    # Two of -1000 to 2353.5 N, 1.027135 m to each side.
    found = handling(load_scene(CONFIG / 'wam_v.yaml'))
    assert found['push_n'] == pytest.approx(2 * 2353.5)
    assert found['turning_torque_n_m'] == pytest.approx(1.027135 * (1000.0 + 2353.5))


def test_without_drag_there_is_no_end_to_the_speed():
    still = {'damping.linear_retention': [1.0], 'damping.angular_retention': [1.0],
             'damping.probe': 0.0}
    found = handling(load_scene({**still, 'boat.inertia': [800.0, 3000.0, 3500.0]}), 500.0)
    assert found['speed_ahead_m_per_s'] is None and found['push_for_1_m_per_s_n'] == 0.0
    # 500 N at half the beam of 2 m: pi / 2 = M t^2 / 2 I.
    assert found['time_to_turn_90_deg_s'] == pytest.approx(np.sqrt(np.pi * 3500.0 / 500.0))


def test_the_report_takes_the_push_that_is_given(capsys):
    assert main([str(CONFIG / 'default.yaml'), '--thrust', '400']) == 0
    assert 'pushed by 400 N' in capsys.readouterr().out
    assert main([str(CONFIG / 'default.yaml'), '--thrust', '-3']) == 2
    assert capsys.readouterr().err == (
        'buoyancy_report: --thrust: expected a finite number above 0, got -3.0\n')
