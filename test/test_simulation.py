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

"""One boat stepped: the same inputs give the same motion, and wrong ones one clear sentence."""

from dataclasses import fields, FrozenInstanceError
import os
import subprocess
import sys

from boat_buoyancy.physics import Sea, Simulation, SimulationError, State, Trajectory
from boat_buoyancy.physics.boat.state import PARTS
from boat_buoyancy.physics.stepping import simulation as module
from boats import (
    asymmetric_boat, box_boat, DRAFT, INTEGRATORS, LAWS, MASS, reference_boat, same, turned,
    undamped, wind_sea)
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from textbook import water

pytestmark = pytest.mark.plain

# What a trajectory has a row of for its start and every period.
ROWS = (*(field.name for field in fields(Trajectory) if field.name != 'sea'), 'elevation')

PUSH = (100.0, 20.0, 0.0, 0.0, 5.0, 30.0)


def simulation(boat=None, sea=None, state=None, **options):
    return Simulation(boat or asymmetric_boat(), sea or wind_sea(),
                      state or State((0.0, 0.0, 0.2), turned(0.2, 0.1, 0.3)), **options)


def stepped(moving, count=20, thrust=PUSH):
    for _ in range(count):
        moving.step(thrust)
    return moving


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_same_inputs_give_bitwise_the_same_motion(integrator):
    one = stepped(simulation(integrator=integrator))
    # Arrays of other sizes in between, so that memory is laid out anew.
    held = [np.ones(size) for size in range(1, 200)]
    other = stepped(simulation(integrator=integrator))
    assert same(one.state, other.state) and len(held) == 199
    assert np.array_equal(one.probe_depths, other.probe_depths)


def in_digits(state):
    return str([value.hex() for part in PARTS for value in getattr(state, part).tolist()])


def test_another_process_gives_bitwise_the_same_motion():
    code = (f'import sys; sys.path[:0] = {sys.path!r}\n'
            'from test_simulation import *\n'
            'print(in_digits(stepped(simulation()).state))')
    answers = {subprocess.run(
        [sys.executable, '-c', code], capture_output=True, text=True, check=True,
        env={**os.environ, 'PYTHONHASHSEED': seed}).stdout.strip() for seed in ('1', '2')}
    assert answers == {in_digits(stepped(simulation()).state)}


def test_time_is_exact_after_many_steps():
    moving = simulation(boat=reference_boat(), sea=Sea(), rate=10.0)
    for count in range(1, 3001):
        moving.step()
        assert moving.steps == count
        assert moving.time == count / 10.0
    third = simulation(rate=3.0, substeps=7)
    for _ in range(9):
        third.step()
    assert third.time == 3.0


def test_substeps_are_shorter_steps():
    fine = stepped(simulation(rate=200.0), 40)
    coarse = stepped(simulation(rate=50.0, substeps=4), 10)
    assert fine.time == coarse.time == 0.2
    assert coarse.substeps == 4 and coarse.rate == 50.0
    assert same(fine.state, coarse.state)


def test_thrust_off_the_centre_of_mass_turns_the_boat():
    boat = reference_boat(center_of_mass=(0.5, -0.2, 0.3))
    moving = simulation(boat=boat, sea=Sea(), state=State((0.0, 0.0, 50.0)), rate=1000.0)
    force, moment = np.array([10.0, 20.0, 30.0]), np.array([1.0, 2.0, 3.0])
    moving.step([*force, *moment])
    torque = moment + np.cross(-boat.center_of_mass, force)
    assert moving.state.angular_velocity == pytest.approx(
        torque / [500.0, 700.0, 900.0] / 1000.0, rel=1e-6)
    assert moving.state.velocity + [0, 0, 9.81 / 1000.0] == pytest.approx(
        force / MASS / 1000.0, abs=1e-8)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_thrust_is_in_body_axes(integrator):
    moving = simulation(boat=reference_boat(), sea=Sea(), rate=100.0, integrator=integrator,
                        state=State((0.0, 0.0, -DRAFT), turned(yaw=np.pi / 2)))
    stepped(moving, 100, (100.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert moving.state.velocity == pytest.approx((0.0, 0.1, 0.0), abs=1e-9)
    assert moving.state.body_velocity == pytest.approx((0.1, 0.0, 0.0), abs=1e-9)


@pytest.mark.parametrize(('thrust', 'says'), [
    ([1.0, 2.0, 3.0, 4.0, 5.0], r'expected shape \(6,\), got \(5,\)'),
    ([[1.0] * 6], r'expected shape \(6,\), got \(1, 6\)'),
    (3.0, r'got \(\)'),
    ([0.0, 0.0, np.nan, 0.0, 0.0, 0.0], 'expected finite numbers, got .*nan'),
    ([0.0, 0.0, np.inf, 0.0, 0.0, 0.0], 'expected finite numbers, got .*inf'),
    ([0.0, 0.0, 0.0, 0.0, 0.0, -np.inf], 'expected finite numbers, got .*inf'),
    ('full ahead', "expected six numbers, got 'full ahead'"),
    ([1.0, 2.0, [3.0], 4.0, 5.0, 6.0], 'expected six numbers')])
def test_bad_thrust_is_refused_and_changes_nothing(thrust, says):
    moving = stepped(simulation())
    before, depths = moving.state, moving.probe_depths
    with pytest.raises(ValueError, match='^thrust: .*' + says):
        moving.step(thrust)
    assert same(moving.state, before) and moving.steps == 20
    assert np.array_equal(moving.probe_depths, depths)


@pytest.mark.parametrize(('state', 'says'), [
    (State((0.0, np.nan, 0.0)), r'state.position: expected finite numbers, got \[0.0, nan'),
    (State(velocity=(np.inf, 0.0, 0.0)), 'state.velocity: expected finite numbers'),
    (State(orientation=(0.0, 0.0, 0.0, 0.0)), 'state.orientation: expected a unit quaternion'),
    (State(orientation=(1.0, 0.0, 0.0, 1.0)), 'state.orientation: expected a unit quaternion'),
    # What is computed of it would overflow.
    (State((0.0, -1e200, 0.0)), r'state.position: expected less than 1e\+100 m .*got'),
    (State((9e99, -9e99, 0.0)), 'state.position'),
    (State([[0.0, 0.0, 0.0]] * 3), r'state: expected batch shape \(\), got \(3,\)')])
def test_bad_state_is_refused_and_changes_nothing(state, says):
    with pytest.raises(ValueError, match=says):
        simulation(state=state)
    moving = stepped(simulation())
    before = moving.state
    with pytest.raises(ValueError, match=says):
        moving.state = state
    with pytest.raises(ValueError, match=says):
        moving.reset(state)
    assert same(moving.state, before) and moving.steps == 20
    moving.reset()
    assert moving.steps == 0


def test_quaternion_a_little_off_is_made_a_unit_one():
    moving = simulation(state=State(orientation=(0.0, 0.0, 0.0, 1.0002)))
    assert moving.state.orientation == pytest.approx((0.0, 0.0, 0.0, 1.0), abs=1e-15)


@pytest.mark.parametrize(('shapes', 'says'), [
    ({'position': (0.0, 0.0)}, r'state.position: expected shape \(..., 3\), got \(2,\)'),
    ({'orientation': (0.0, 0.0, 0.0)}, r'state.orientation: expected shape \(..., 4\)'),
    ({'velocity': 1.0}, r'state.velocity: expected shape \(..., 3\), got \(\)')])
def test_state_of_a_wrong_shape_is_refused(shapes, says):
    with pytest.raises(ValueError, match=says):
        State(**shapes)


@pytest.mark.parametrize(('options', 'says'), [
    ({'rate': 0.0}, 'rate: expected a finite number above 0, got 0.0'),
    ({'rate': -10.0}, 'rate: '), ({'rate': np.nan}, 'rate: '), ({'rate': 'fast'}, 'rate: '),
    ({'substeps': 0}, 'substeps: expected an integer of at least 1, got 0'),
    ({'substeps': 1.5}, 'substeps: '),
    ({'integrator': 'heun'}, "integrator: expected one of leapfrog, .*, got 'heun'")])
def test_bad_options_are_refused(options, says):
    with pytest.raises(ValueError, match=says):
        simulation(**options)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_reset_goes_back_to_the_start(integrator):
    moving = simulation(integrator=integrator)
    begin, depths = moving.state, moving.probe_depths
    first = stepped(moving).state
    moving.reset()
    assert moving.time == 0.0 and moving.steps == 0
    assert same(moving.state, begin) and np.array_equal(moving.probe_depths, depths)
    assert same(stepped(moving).state, first)


def test_reset_to_another_state_keeps_it_as_the_start():
    moving, there = stepped(simulation()), State((5.0, 6.0, 0.5))
    moving.reset(there)
    assert same(moving.state, there) and moving.time == 0.0
    stepped(moving)
    moving.reset()
    assert same(moving.state, there)


def test_setting_the_state_leaves_the_clock_alone():
    moving, there = stepped(simulation()), State((5.0, 6.0, 0.5))
    moving.state = there
    assert moving.steps == 20 and same(moving.state, there)
    for (x, y, z), depth in zip(there.position + moving.boat.probe_offsets, moving.probe_depths):
        assert depth == pytest.approx(water(moving.sea, x, y, moving.time)[0] - z, abs=1e-12)


def test_sea_and_boat_can_be_changed_between_two_steps():
    moving = simulation(boat=reference_boat(), sea=Sea(), state=State((0.0, 0.0, -DRAFT)))
    stepped(moving, 10, None)
    assert moving.state.velocity == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    moving.sea = Sea([[1.0, 1e6, 0.0, 0.0]])
    assert moving.probe_depths == pytest.approx([DRAFT + 1.0] * 4, abs=1e-6)
    moving.step()
    # A metre more water than it needs: 2 g up.
    assert moving.state.velocity[2] == pytest.approx(2 * 9.81 / 100.0, rel=1e-2)
    moving.sea = Sea()
    moving.state = State((0.0, 0.0, 1e6))
    moving.boat = reference_boat(damping=undamped(air_linear_retention=[0.5]))
    assert moving.boat.damping.air_linear_retention[0] == 0.5
    moving.run(20.0)
    # Falling through air it nears g / ln 2, what is left halves every second.
    assert moving.state.velocity[2] == pytest.approx(-9.81 / np.log(2.0), rel=2 * 0.5 ** 20)
    with pytest.raises(ValueError, match='boat: expected 4 probes as before, got 5'):
        moving.boat = asymmetric_boat()


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_probe_depths_are_those_of_the_published_state(integrator, law):
    moving = stepped(simulation(boat=asymmetric_boat(law), integrator=integrator))
    state = moving.state
    places = state.position + Rotation.from_quat(state.orientation).apply(
        moving.boat.probe_offsets)
    for (x, y, z), depth in zip(places, moving.probe_depths):
        assert depth == pytest.approx(water(moving.sea, x, y, moving.time)[0] - z, abs=1e-12)


def test_probe_forces_are_the_lifts_of_the_published_depths():
    # Springs: 3 weights in all, shared as 1.0, 1.2, 0.9, 1.1 and 0.8.
    moving = stepped(simulation())
    assert moving.probe_forces == pytest.approx(3.0 * MASS * 9.81 / 5.0 * np.array(
        [1.0, 1.2, 0.9, 1.1, 0.8]) * np.clip(moving.probe_depths / (3.0 * DRAFT), 0.0, 1.0))
    assert (moving.probe_forces > 0.0).any()


def test_states_are_read_only_and_are_not_moved_by_later_steps():
    moving = simulation()
    state = moving.state
    kept = [getattr(state, part).copy() for part in PARTS]
    with pytest.raises(ValueError, match='read-only'):
        state.position[0] = 1.0
    with pytest.raises(FrozenInstanceError):
        state.position = np.zeros(3)
    stepped(moving)
    assert all(np.array_equal(a, getattr(state, part)) for a, part in zip(kept, PARTS))


def pushes(count):
    """Return thrust that is another in every period."""
    scale = [300.0, 200.0, 100.0, 30.0, 20.0, 10.0]
    return np.random.default_rng(5).normal(size=(count, 6)) * scale


@pytest.mark.parametrize('kind', ['none', 'constant', 'a row a period', 'function'])
@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_a_run_is_step_by_step_to_the_bit(integrator, kind, monkeypatch):
    # As long runs are: in calls of some periods each.
    monkeypatch.setattr(module, 'CHUNK', 7)
    rows = pushes(50)
    if kind == 'none':
        rows = [None] * 50
    elif kind == 'constant':
        rows = np.tile(PUSH, (50, 1))
    called = []

    def function(time, state):
        called.append((time, state))
        return rows[len(called) - 1]

    one, other = (simulation(integrator=integrator, rate=50.0, substeps=2) for _ in range(2))
    stepped(one, 3)
    stepped(other, 3)
    run = other.run(1.0, {'none': None, 'constant': PUSH, 'a row a period': rows,
                          'function': function}[kind])
    states, depths, times = [one.state], [one.probe_depths], [one.time]
    for row in rows:
        one.step(row)
        states.append(one.state)
        depths.append(one.probe_depths)
        times.append(one.time)
    assert same(other.state, one.state) and other.steps == one.steps == 53
    assert run.time.tolist() == times and len(run.time) == 51
    assert np.array_equal(run.probe_depths, depths)
    for name in ('orientation', 'angular_velocity'):
        assert np.array_equal(getattr(run, name), [getattr(state, name) for state in states])
    # And goes on so, also where a run was asked for before.
    assert same(stepped(one, 5).state, stepped(other, 5).state)
    if kind == 'function':
        assert [time for time, _ in called] == times[:-1]
        assert all(same(state, kept) for (_, state), kept in zip(called, states))


def test_a_trajectory_is_the_body_frame_over_the_water():
    moving = simulation(rate=20.0)
    states = [moving.state]
    sea, offset = moving.sea, moving.boat.center_of_mass
    run = moving.run(2.0, PUSH)
    moving.reset()
    for _ in range(40):
        moving.step(PUSH)
        states.append(moving.state)
    assert [len(getattr(run, name)) for name in ROWS] == [41] * 7
    for i, state in enumerate(states):
        rotation = Rotation.from_quat(state.orientation)
        turn = rotation.as_matrix()
        origin = state.position - turn @ offset
        velocity = state.velocity + np.cross(turn @ state.angular_velocity,
                                             origin - state.position)
        assert run.position[i] == pytest.approx(origin, abs=1e-14)
        assert run.velocity[i] == pytest.approx(velocity, abs=1e-14)
        assert run.body_velocity[i] == pytest.approx(turn.T @ velocity, abs=1e-14)
        assert [run.roll[i], run.pitch[i], run.yaw[i]] == pytest.approx(
            rotation.as_euler('xyz'), abs=1e-14)
        assert run.elevation[i] == pytest.approx(water(sea, *origin[:2], i / 20.0)[0], abs=1e-14)


def test_every_few_rows_of_a_trajectory_start_with_the_first():
    run = simulation(rate=20.0).run(1.0)
    some = run.every(4)
    assert some.time.tolist() == [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]
    for name in ROWS:
        assert np.array_equal(getattr(some, name), getattr(run, name)[::4])


@pytest.mark.parametrize(('rate', 'duration', 'periods'), [
    (10.0, 0.3, 3), (100.0, 0.07, 7), (10.0, 0.31, 4), (10.0, 1e-6, 1), (3.0, 1.0, 3),
    (7.0, 100.0 / 7.0, 100)])
def test_a_run_takes_the_periods_that_cover_its_duration(rate, duration, periods):
    moving = simulation(rate=rate)
    assert len(moving.run(duration).time) == periods + 1
    assert moving.steps == periods


@pytest.mark.parametrize(('duration', 'thrust', 'says'), [
    (0.0, None, '^duration: expected a finite number above 0, got 0.0'),
    (-1.0, None, '^duration: '), (np.nan, None, '^duration: '), ('long', None, '^duration: '),
    (1e6, None, '^duration: expected at most 10000000 periods, got 1e[+]06 s at 100 Hz'),
    (0.1, np.zeros((9, 6)), r'^thrust: expected shape \(6,\) or \(10, 6\), got \(9, 6\)'),
    (0.1, np.zeros(5), r'^thrust: expected shape \(6,\) or \(10, 6\), got \(5,\)'),
    (0.1, [[1.0] * 6, [2.0]], '^thrust: expected six numbers'),
    (0.1, 'ahead', '^thrust: expected six numbers'),
    (0.1, lambda time, state: None, r'^thrust: expected shape \(6,\), got \(\)'),
    (0.1, lambda time, state: [np.nan] * 6, '^thrust: expected finite numbers')])
def test_a_bad_run_is_refused_and_changes_nothing(duration, thrust, says):
    moving = simulation()
    before = moving.state
    with pytest.raises(ValueError, match=says):
        moving.run(duration, thrust)
    assert same(moving.state, before) and moving.steps == 0


def test_a_row_of_thrust_that_is_not_finite_ends_a_run_before_its_period():
    rows = pushes(10)
    rows[6, 2] = np.nan
    moving = simulation()
    with pytest.raises(ValueError, match='^thrust: expected finite numbers, got .*nan'):
        moving.run(0.1, rows)
    other = simulation()
    other.run(0.06, rows[:6])
    assert same(moving.state, other.state) and moving.steps == 6


@pytest.mark.parametrize('error', [
    ValueError('no thrust left'), ZeroDivisionError('mine'), KeyboardInterrupt()])
def test_what_a_function_of_thrust_raises_comes_out_as_it_is(error):
    def thrust(time, state):
        if time >= 0.05:
            raise error
        return PUSH

    moving = simulation()
    with pytest.raises(type(error)) as caught:
        moving.run(1.0, thrust)
    assert caught.value is error
    assert moving.steps == 5 and same(moving.state, stepped(simulation(), 5).state)


@pytest.mark.parametrize('kind', ['constant', 'a row a period', 'function'])
def test_the_error_of_a_run_holds_what_was_done(kind, monkeypatch):
    monkeypatch.setattr(module, 'CHUNK', 4)
    rows = np.tile((0.0, 0.0, 50.0, 0.0, 0.0, 0.0), (1000, 1))
    thrust = {'constant': rows[0], 'a row a period': rows,
              'function': lambda time, state: rows[0]}[kind]

    def exploding():
        return simulation(boat=box_boat(undamped(probe=5e4)), rate=10.0, integrator='euler')

    moving, other = exploding(), exploding()
    stepped(moving, 2, None)
    stepped(other, 2, None)
    with pytest.raises(SimulationError, match=r'thrust: \[0.0, 0.0, 50.0,') as caught:
        moving.run(100.0, thrust)
    run = caught.value.trajectory
    assert 5 < moving.steps < 100
    assert run.time.tolist() == [(2 + i) / 10.0 for i in range(moving.steps - 1)]
    again = other.run((moving.steps - 2) / 10.0, rows[0])
    for name in ROWS:
        assert np.array_equal(getattr(run, name), getattr(again, name))
    assert same(moving.state, other.state)
    with pytest.raises(SimulationError) as caught:
        moving.step(rows[0])
    assert caught.value.trajectory is None


def test_a_sea_that_is_none_is_refused_and_the_one_before_stays():
    moving = simulation()
    before = moving.sea
    with pytest.raises(AttributeError):
        moving.sea = 5.0
    assert moving.sea is before
    moving.step()


def test_every_row_of_none_is_refused_in_one_line():
    with pytest.raises(ValueError, match='every: expected an integer of at least 1, got 0'):
        simulation().run(1.0).every(0)
