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

"""The chart's measures and its first part: errors, costs, orders and ranking."""

import math

from boat_buoyancy.physics.boat.state import State
from boat_buoyancy.physics.rotation import from_roll_pitch_yaw, to_roll_pitch_yaw
from boat_buoyancy.tools.chart import accuracy, time_stepping
from boat_buoyancy.tools.chart.scenes import BY_NAME, SCENES
from boat_buoyancy.tools.chart.table import COLUMNS, cost_to_reach, observed_order, Row, write
from boats import box_boat, reference_boat
import numpy as np
import pytest


@pytest.fixture(scope='module')
def rows():
    """Return the chart's own quick rows of part one, what the tests read from it."""
    wanted = [task for task in time_stepping.tasks(True)
              if task[1] in ('leapfrog', 'rk4', 'symplectic_euler', 'implicit')
              and task[0] in {scene.name for scene in SCENES}]
    return [row for task in wanted for row in time_stepping.measured(task)]


def test_rotation_angle_is_exact_for_small_and_large_angles():
    level = np.array([0.0, 0.0, 0.0, 1.0])
    for angle in (1e-9, 1e-3, 1.0, 3.0):
        turned = np.array(from_roll_pitch_yaw(0.0, 0.0, angle))
        assert accuracy.rotation_angle(level, turned) == pytest.approx(angle, rel=1e-12)
        # q and -q are the same attitude.
        assert accuracy.rotation_angle(turned, -level) == pytest.approx(angle, rel=1e-12)


def test_error_is_the_root_mean_square_of_distance_and_of_angle_times_length():
    truth = State(np.zeros((4, 3)))
    moved = State(np.array([[0.0, 0.0, 0.2], [0.2, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0] * 3]),
                  np.array(from_roll_pitch_yaw(0.1, 0.0, 0.0)))
    error = accuracy.difference(moved, truth, 3.0)
    assert error.position == pytest.approx(0.2 / math.sqrt(2.0))
    assert error.rotation == pytest.approx(0.3)
    assert error.total == pytest.approx(math.hypot(0.2 / math.sqrt(2.0), 0.3))


def test_length_of_a_boat_reaches_to_its_farthest_probe():
    # The upper end of a column at a Gauss point: half of 4 / sqrt 3, 2 / sqrt 3 and 1 m.
    assert accuracy.boat_length(box_boat()) == pytest.approx(math.sqrt(4 / 3 + 1 / 3 + 1 / 4))
    single = reference_boat(positions=[[0.0, 0.0, 0.0]], inertia=(9000.0, 9000.0, 9000.0),
                            floatiness=1.01)
    assert accuracy.boat_length(single) == pytest.approx(3.0)


def test_force_evaluations_are_counted_per_simulated_second():
    assert accuracy.force_evaluations('leapfrog', 50.0) == 50.0
    assert accuracy.force_evaluations('rk4', 50.0, 2) == 400.0


def test_a_motion_that_blows_up_is_an_infinite_error():
    run = BY_NAME['stiff barge'].run(quick=True)
    assert math.isinf(accuracy.measure(run, run.solve(tolerance=1e-6), 'rk4', 5.0).total)


def test_cost_to_reach_reads_between_steps_on_logarithmic_axes():
    made = [Row('p', 's', 'm', rate=r, evaluations=r, error=100.0 / r**2) for r in (10, 20, 40)]
    assert cost_to_reach(made, 0.25) == pytest.approx(20.0)
    assert cost_to_reach(made, 100.0 / 28.0**2) == pytest.approx(28.0)
    assert cost_to_reach(made, 2.0) == 10.0
    assert math.isinf(cost_to_reach(made, 0.01))
    # A lucky coarse step does not count when a finer one fails.
    made[0] = Row('p', 's', 'm', rate=10, evaluations=10, error=0.01)
    assert cost_to_reach(made, 0.2) > 20.0


def test_observed_order_is_the_slope():
    made = [Row('p', 's', rate=r, error=3.0 / r**4) for r in (10, 20, 40)]
    assert observed_order(made) == pytest.approx(4.0)


@pytest.mark.parametrize('scene, integrator, order, coarsest', [
    ('free decay', 'leapfrog', 2, 40), ('free decay', 'rk4', 4, 40),
    ('free decay', 'symplectic_euler', 1, 40),
    # A kink within the step costs its square, whatever the integrator.
    ('drop', 'leapfrog', 2, 10), ('drop', 'rk4', 2, 10),
    # In a free decay it kills the oscillation first, and reaches its order late.
    ('irregular sea', 'implicit', 1, 20)])
def test_observed_orders_are_those_of_the_integrators(rows, scene, integrator, order, coarsest):
    found = [row for row in rows if (row.scene, row.integrator) == (scene, integrator)
             and row.evaluations >= coarsest]
    assert observed_order(found) == pytest.approx(order, abs=0.2)


@pytest.mark.parametrize('scene, first', [
    ('free decay', 'rk4'), ('irregular sea', 'leapfrog'), ('drop', 'leapfrog'),
    ('stiff barge', 'implicit')])
def test_cheapest_integrator_of_every_scene(rows, scene, first):
    ranked = time_stepping.ranking(rows, scene, BY_NAME[scene].tolerance)
    assert ranked[0][0] == first
    assert ranked[0][1] < ranked[1][1]


def test_reference_is_a_million_times_better_than_what_it_judges():
    for scene in ('irregular sea', 'drop'):
        row, = time_stepping.measured((scene, None, True))
        assert row.integrator == 'reference'
        assert row.error < 1e-6 * BY_NAME[scene].tolerance


def test_scene_of_the_stiff_barge_starts_lying_on_its_swell():
    # 10 cm of a swell of 8 s, at its node: its steepest slope a w^2 / g, rising by a w.
    frequency = 2.0 * math.pi / 8.0
    run = BY_NAME['stiff barge in swell'].run()
    _, pitch, _ = to_roll_pitch_yaw(tuple(run.start.orientation))
    assert abs(pitch) == pytest.approx(math.atan(0.1 * frequency**2 / 9.81), rel=1e-4)
    assert run.start.velocity[2] == pytest.approx(0.1 * frequency, rel=1e-4)
    # 37 kg on 18 square metres, as far as the wave is straight under the probes and the start is
    # written: a (k x)^3 / 6 at the Gauss points, and a hundredth of a millimetre.
    bend = 0.1 * (frequency**2 / 9.81 * math.sqrt(3.0))**3 / 6.0
    depths = run.simulation('leapfrog', 100.0).probe_depths
    assert depths == pytest.approx(37.0 / (1025.0 * 18.0), rel=0.0, abs=bend + 1e-5)


def test_table_keeps_its_columns_and_leaves_empty_what_does_not_apply(tmp_path):
    write(tmp_path / 'table.csv', [Row('time stepping', 'drop', 'rk4', 10.0, error=0.5)])
    header, line = (tmp_path / 'table.csv').read_text().splitlines()
    assert header.split(',') == list(COLUMNS)
    assert dict(zip(COLUMNS, line.split(',')))['error_m'] == '0.5'
    assert dict(zip(COLUMNS, line.split(',')))['cpu_s_per_s'] == ''
