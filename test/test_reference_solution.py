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

"""The chart's reference solution against closed forms and an independent model."""

from boat_buoyancy.physics.boat.state import State
from boat_buoyancy.physics.scene.scene import load_scene
from boat_buoyancy.physics.sea.waves import Sea
from boat_buoyancy.tools.chart.accuracy import apart, measure, reference_error, Run
from boat_buoyancy.tools.chart.reference_solution import solve
from boats import (asymmetric_boat, box_boat, DRAFT, HEAVE, MASS, reference_boat, undamped,
                   wind_sea, windy)
import numpy as np
import pytest
import textbook

STILL = Sea()
TIMES = np.linspace(0.0, 10.0, 201)


def heights(boat, start, times=TIMES):
    """Return the heights in m of a boat in still water, one for every time."""
    return solve(boat, STILL, start, times[-1]).at(times).position[:, 2]


def test_damped_heave_follows_the_closed_form():
    # A fifth of critical damping, about the draft of 0.5 m, ramps full.
    boat = reference_boat(damping=undamped(probe=1771.776))
    ratio = 1771.776 / (2 * MASS * HEAVE)
    swing = HEAVE * np.sqrt(1 - ratio**2)
    expected = 0.2 * np.exp(-ratio * HEAVE * TIMES) * (
        np.cos(swing * TIMES) + ratio / np.sqrt(1 - ratio**2) * np.sin(swing * TIMES))
    found = heights(boat, State((0.0, 0.0, 0.2 - DRAFT)))
    np.testing.assert_allclose(found + DRAFT, expected, atol=1e-10)
    one_period = heights(boat, State((0.0, 0.0, 0.2 - DRAFT)), np.array([0.0, 1.44775383]))
    assert one_period[-1] + DRAFT == pytest.approx(0.2 * 0.27732983, rel=1e-7)


def test_drop_from_one_metre_enters_turns_and_comes_back_on_time():
    # Springs that are never full.
    boat = reference_boat(floatiness=100.0)
    motion = solve(boat, STILL, State((0.0, 0.0, 1.0)), 1.82164682)
    assert motion.kinks[0] == pytest.approx(0.45152364, abs=1e-8)
    depth = -motion.at(np.linspace(0.0, 1.82164682, 200_001)).position[:, 2]
    assert depth.max() == pytest.approx(1.61803399, abs=1e-8)
    assert -motion.at([1.0]).position[0, 2] == pytest.approx(1.53194025, abs=1e-8)
    assert motion.at([1.82164682]).position[0, 2] == pytest.approx(1.0, abs=1e-8)


def test_drop_from_three_metres_is_restarted_at_entry_and_at_the_cap():
    boat = reference_boat(floatiness=3.0)
    motion = solve(boat, STILL, State((0.0, 0.0, 3.0)), 2.63380021)
    entry, cap = 0.78206189, 0.78206189 + 0.19619549
    for time in (entry, cap, cap + 0.67728546, 2.63380021 - entry):
        assert np.abs(np.array(motion.kinks) - time).min() < 2e-8
    assert motion.at([2.63380021 / 2]).position[0, 2] == pytest.approx(-2.625, abs=1e-8)
    above = motion.at(cap + 0.67728546 * np.array([0.25, 0.5, 0.75])).velocity[:, 2]
    assert np.diff(above) / (0.67728546 / 4) == pytest.approx(19.62, rel=1e-9)


def test_torque_free_tumbling_follows_the_elliptic_functions():
    boat = reference_boat(inertia=(1.0, 2.0, 3.0))
    start = State((0.0, 0.0, 1e4), angular_velocity=(1.0, 0.0, 1.2))
    motion = solve(boat, STILL, start, 5.58617892)
    found = motion.at([5.0, 5.58617892]).angular_velocity
    np.testing.assert_allclose(found[0], [0.7704195, -0.63753728, 1.14215384], atol=1e-8)
    np.testing.assert_allclose(found[1], [1.0, 0.0, 1.2], atol=1e-8)


def test_quadratic_drag_slows_a_floating_boat_as_the_logarithm():
    drag, speed = 300.0, 2.0
    boat = reference_boat(damping=undamped(quadratic=[drag, 0.0, 0.0, 0.0, 0.0, 0.0]))
    start = State((0.0, 0.0, -DRAFT), velocity=(speed, 0.0, 0.0))
    found = solve(boat, STILL, start, 10.0).at(TIMES).position[:, 0]
    np.testing.assert_allclose(
        found, MASS / drag * np.log1p(drag * speed / MASS * TIMES), atol=1e-10)


def test_it_agrees_with_a_model_written_a_second_time():
    # In a light wind, so that the boat's speed relative to it turns round.
    boat, sea = asymmetric_boat('column', damping=windy()), wind_sea().with_wind((0.2, 0.1))
    start = State((0.0, 0.0, 0.4), (0.0, 0.0, 0.0, 1.0), (0.3, -0.2, 0.0), (0.2, -0.3, 0.1))
    times = np.linspace(0.0, 1.2, 7)
    # Without restarts, so with short steps to keep what the kinks cost small.
    other = textbook.solve(boat, sea, start, times, tolerance=1e-9, max_step=0.01)
    motion = solve(boat, sea, start, 1.2).at(times)
    np.testing.assert_allclose(motion.position, other[:, :3], atol=1e-6)
    np.testing.assert_allclose(motion.velocity, other[:, 7:10], atol=1e-5)
    np.testing.assert_allclose(motion.angular_velocity, other[:, 10:], atol=1e-5)


def test_a_box_that_rolls_over_is_followed_across_the_jump_on_its_side():
    # The point of force jumps where the columns lie level: a restart must land on it.
    start = State((0.0, 0.0, -0.2), angular_velocity=(4.0, 0.3, 0.2))
    run = Run('roll over', box_boat(), STILL, start, 4.0)
    motion = run.solve()
    upright = motion.at(np.linspace(0.0, 4.0, 401)).orientation
    assert (1 - 2 * (upright[:, 0]**2 + upright[:, 1]**2)).min() < -0.5
    assert reference_error(run, motion).total < 1e-9


def test_restarts_are_worth_their_trouble():
    run = Run('drop', reference_boat(floatiness=3.0, damping=undamped(probe=1000.0)), STILL,
              State((0.0, 0.0, 3.0), (0.05, 0.02, 0.0, np.sqrt(1 - 0.05**2 - 0.02**2))), 5.0)
    motion = run.solve()
    own = reference_error(run, motion).total
    assert len(motion.kinks) > 8
    assert own < 1e-10
    across = run.solve(restart=False, tolerance=1e-9)
    assert apart(run, motion, across).total > 10 * own


def test_a_boat_at_rest_meets_no_kinks():
    # Depth 0 above a probe that floats exactly at the surface is round-off, not a crossing.
    start = State((0.0, 0.0, -DRAFT))
    boat = reference_boat(damping=undamped(quadratic=[10.0] * 6))
    motion = solve(boat, STILL, start, 20.0)
    assert motion.kinks == ()
    np.testing.assert_allclose(motion.at([20.0]).position, [[0.0, 0.0, -DRAFT]], atol=1e-11)


def test_waves_that_die_out_with_depth_move_the_reference_as_they_move_a_fine_step():
    scene = load_scene({
        'sea.waves': [0.05, 3.0, 0.4, 0.0], 'wave_force': 'froude_krylov',
        'added_mass': [300.0, 700.0, 4900.0, 800.0, 4900.0, 1000.0],
        'damping.linear': [800.0, 2200.0, 8500.0, 900.0, 5200.0, 1000.0]})
    run = Run('waves', scene.boat, scene.sea, scene.start, 6.0)
    truth = run.solve(tolerance=1e-10)
    # A hull that the wave moves as far as itself, and rk4 of (omega h)^4 / 120 for each of some 40
    # rad, omega h = 6 / 128: 2e-6 of a wave of 5 cm, with a factor of 10 for the rest of the boat.
    assert np.ptp(truth.at(TIMES[:120]).position[:, 2]) > 0.05
    assert measure(run, truth, 'rk4', 128.0).total < 1e-6
