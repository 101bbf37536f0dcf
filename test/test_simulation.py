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

from dataclasses import FrozenInstanceError
import subprocess
import sys

from boat_buoyancy.physics.boat import State
from boat_buoyancy.physics.simulation import Simulation, SimulationError
from boat_buoyancy.physics.waves import Sea
from boats import (
    asymmetric_boat, DRAFT, LAWS, MASS, METHODS, random_states, reference_boat, turned, undamped,
    wind_sea)
import numpy as np
import pytest

PARTS = ('position', 'orientation', 'velocity', 'angular_velocity')


def simulation(boat=None, sea=None, state=None, **options):
    return Simulation(boat or asymmetric_boat(), sea or wind_sea(),
                      state or State((0.0, 0.0, 0.2), turned(0.2, 0.1, 0.3)), **options)


def same(one, other):
    return all(np.array_equal(getattr(one, part), getattr(other, part)) for part in PARTS)


def stepped(moving, count=20, thrust=(100.0, 20.0, 0.0, 0.0, 5.0, 30.0)):
    for _ in range(count):
        moving.step(thrust)
    return moving


@pytest.mark.parametrize('method', METHODS)
def test_same_inputs_give_bitwise_the_same_motion(method):
    for state in (None, random_states((50,), 1)):
        one = stepped(simulation(state=state, integrator=method))
        # Arrays of other sizes in between, so that memory is laid out anew.
        held = [np.ones(size) for size in range(1, 200)]
        other = stepped(simulation(state=state, integrator=method))
        assert same(one.state, other.state) and len(held) == 199
        assert np.array_equal(one.probe_depths, other.probe_depths)


def test_another_process_gives_bitwise_the_same_motion():
    code = ('import sys; sys.path[:0] = {path!r}\n'
            'from test_simulation import *\n'
            'state = stepped(simulation()).state\n'
            'print([value.hex() for part in PARTS for value in getattr(state, part).tolist()])')
    answers = {subprocess.run(
        [sys.executable, '-c', code.format(path=sys.path)], capture_output=True, text=True,
        check=True, env={'PYTHONHASHSEED': seed}).stdout for seed in ('1', '2')}
    assert len(answers) == 1 and '0x' in answers.pop()


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
    fine = simulation(rate=200.0)
    coarse = simulation(rate=50.0, substeps=4)
    stepped(fine, 40)
    stepped(coarse, 10)
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


@pytest.mark.parametrize('method', METHODS)
def test_thrust_is_in_body_axes(method):
    moving = simulation(boat=reference_boat(), sea=Sea(), rate=100.0, integrator=method,
                        state=State((0.0, 0.0, -DRAFT), turned(yaw=np.pi / 2)))
    stepped(moving, 100, (100.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert moving.state.velocity == pytest.approx((0.0, 0.1, 0.0), abs=1e-9)


@pytest.mark.parametrize(('thrust', 'says'), [
    ([1.0, 2.0, 3.0, 4.0, 5.0], r'expected shape \(6,\), got \(5,\)'),
    ([[1.0] * 6], r'expected shape \(6,\), got \(1, 6\)'),
    (3.0, r'got \(\)'),
    ([0.0, 0.0, np.nan, 0.0, 0.0, 0.0], 'expected finite numbers, got .*nan'),
    ([0.0, 0.0, np.inf, 0.0, 0.0, 0.0], 'expected finite numbers, got .*inf'),
    ('full ahead', "expected six numbers, got 'full ahead'"),
    ([1.0, 2.0, [3.0], 4.0, 5.0, 6.0], 'expected six numbers')])
def test_bad_thrust_is_refused_and_changes_nothing(thrust, says):
    moving = stepped(simulation())
    before = moving.state
    with pytest.raises(ValueError, match='^thrust: .*' + says):
        moving.step(thrust)
    assert same(moving.state, before) and moving.steps == 20


def test_fleet_says_which_thrust_shapes_it_takes():
    moving = simulation(state=random_states((3, 2), 1))
    with pytest.raises(ValueError, match=r'expected shape \(6,\) or \(3, 2, 6\), got \(6, 6\)'):
        moving.step(np.zeros((6, 6)))


@pytest.mark.parametrize(('state', 'says'), [
    (State((0.0, np.nan, 0.0)), 'state: expected finite numbers'),
    (State(velocity=(np.inf, 0.0, 0.0)), 'state: expected finite numbers'),
    (State(orientation=(0.0, 0.0, 0.0, 0.0)), 'state.orientation: expected unit quaternions'),
    (State(orientation=(1.0, 0.0, 0.0, 1.0)), 'state.orientation: expected unit quaternions')])
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


def test_state_of_another_fleet_is_refused():
    moving = simulation(state=random_states((3,), 1))
    with pytest.raises(ValueError, match=r'state: expected batch shape \(3,\), got \(4,\)'):
        moving.state = random_states((4,), 1)


@pytest.mark.parametrize(('options', 'says'), [
    ({'rate': 0.0}, 'rate: expected a finite number above 0, got 0.0'),
    ({'rate': -10.0}, 'rate: '), ({'rate': np.nan}, 'rate: '), ({'rate': 'fast'}, 'rate: '),
    ({'substeps': 0}, 'substeps: expected an integer of at least 1, got 0'),
    ({'substeps': 1.5}, 'substeps: '),
    ({'integrator': 'heun'}, "integrator: expected one of leapfrog, .*, got 'heun'")])
def test_bad_options_are_refused(options, says):
    with pytest.raises(ValueError, match=says):
        simulation(**options)


@pytest.mark.parametrize('method', METHODS)
def test_reset_goes_back_to_the_start(method):
    moving = simulation(integrator=method)
    start, depths = moving.state, moving.probe_depths
    first = stepped(moving).state
    moving.reset()
    assert moving.time == 0.0 and moving.steps == 0
    assert same(moving.state, start) and np.array_equal(moving.probe_depths, depths)
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
    assert moving.probe_depths == pytest.approx(simulation(state=there).probe_depths, abs=0.7)


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
    moving.state = State((0.0, 0.0, 30.0))
    moving.boat = reference_boat(damping=undamped(air_linear_retention=[0.5]))
    for _ in range(2000):
        moving.step()
        if moving.state.position[2] < 5.0:
            break
    fallen = 30.0 - moving.state.position[2]
    assert moving.state.velocity[2] > -np.sqrt(2 * 9.81 * fallen) * 0.9
    assert moving.boat.damping.air_linear_retention[0] == 0.5


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('method', METHODS)
def test_probe_depths_are_those_of_the_published_state(method, law):
    moving = stepped(simulation(boat=asymmetric_boat(law), integrator=method))
    fresh = simulation(boat=asymmetric_boat(law), sea=wind_sea().starting_at(moving.time),
                       state=moving.state, integrator=method)
    assert moving.probe_depths == pytest.approx(fresh.probe_depths, abs=1e-12)


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


@pytest.mark.parametrize('fleet', [(), (3,)])
@pytest.mark.parametrize('method', METHODS)
def test_motion_past_what_numbers_hold_is_one_clear_error(method, fleet):
    # Thrust so large that the numbers overflow: nothing is published, the last state is kept.
    position = np.zeros((*fleet, 3))
    moving = simulation(boat=reference_boat(), sea=Sea(), integrator=method, rate=1.0,
                        state=State(position))
    with pytest.raises(SimulationError), np.errstate(all='ignore'):
        for _ in range(100):
            before = moving.state
            moving.step([1e308, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert same(moving.state, before)
    assert all(np.isfinite(getattr(moving.state, part)).all() for part in PARTS)


def test_a_state_out_of_reach_of_the_arithmetic_is_refused_and_changes_nothing():
    moving = simulation()
    before = moving.state
    with pytest.raises(ValueError, match=r'state.position: expected less than 1e\+100 m .*got'):
        moving.state = State([0.0, -1e200, 0.0])
    with pytest.raises(ValueError, match='state.position'):
        moving.state = State([9e99, -9e99, 0.0])
    assert same(moving.state, before)
