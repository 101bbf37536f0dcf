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

"""Many boats stepped together: each moves as it does alone, whatever becomes of the others."""

import threading
from types import SimpleNamespace

from boat_buoyancy.physics import Boat, Damping, Fleet, Hull, Sea, Simulation, SimulationError
from boat_buoyancy.physics.boat.state import PARTS, State
from boat_buoyancy.physics.compiled import kind
from boat_buoyancy.physics.sea.fading import fade
from boat_buoyancy.physics.stepping import engine, fleet as fleet_module
from boat_buoyancy.physics.stepping.fleet import LEAST_BOATS
from boats import (
    all_damping, asymmetric_boat, box_boat, fleet_of, INTEGRATORS, LAWS, random_states, same,
    undamped, wind_sea)
import numpy as np
import pytest

pytestmark = pytest.mark.plain

COUNT = 12


def waves(count, seed):
    """Return rows of so many small waves."""
    random = np.random.default_rng(seed)
    return np.stack([random.uniform(0.02, 0.1, count), random.uniform(2.0, 6.0, count),
                     random.uniform(-3.0, 3.0, count), random.uniform(0.0, 6.0, count)], axis=1)


def one_of_each(place):
    """Return a boat of five probes, unlike any other place's."""
    random = np.random.default_rng(place)
    mass = random.uniform(500.0, 5000.0)
    budget = random.uniform(1.5, 5.0) * mass * 9.81 * random.dirichlet([5.0] * 5)
    hull = Hull(random.uniform(-1.0, 1.0, (5, 3)), budget, random.uniform(0.3, 2.0, 5),
                LAWS[place % 3])
    damping = (all_damping(), undamped(), undamped(probe=900.0), Damping(),
               undamped(linear=[80.0] * 6, wind=[5.0, 9.0, 7.0]),
               undamped(quadratic=[0.0, 50.0, 0.0, 9.0, 0.0, 9.0]),
               undamped(air_angular_retention=[0.7, 0.8, 0.9]))[place % 7]
    inertia = mass * random.uniform(0.5, 1.0, 3)
    if place % 2:
        inertia = [*inertia, *(mass * random.uniform(-0.1, 0.1, 3))]
    return Boat(mass, hull, inertia, damping, random.uniform(-0.2, 0.2, 3))


def different():
    """Return boats, seas, starts, substeps and thrust (20, COUNT, 6), all of them different."""
    seas = [Sea(), wind_sea(), Sea(waves(5, 1), depth=4.0), Sea(waves(19, 2), (0.5, -0.3)),
            fade(wind_sea(), Sea(waves(3, 3), (0.0, 1.0), wind=(8.0, -6.0)), 0.05, 0.1),
            Sea(current=(1.0, 0.0)),
            Sea(waves(33, 4))]
    thrust = np.random.default_rng(2).normal(size=(20, COUNT, 6)) * 500.0
    return SimpleNamespace(
        boats=[one_of_each(place) for place in range(COUNT)],
        seas=[seas[place % len(seas)] for place in range(COUNT)],
        # Upside down, in the air, deep under water.
        state=random_states((COUNT,), 1, tilt=3.0),
        substeps=[1 + place % 3 for place in range(COUNT)], thrust=thrust)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_each_of_many_different_boats_moves_to_the_bit_as_alone(integrator):
    many = different()
    fleet = fleet_of(many.boats, many.seas, many.state, integrator=integrator,
                     substeps=many.substeps)
    for thrust in many.thrust:
        fleet.step(thrust)
    assert not fleet.failed.any() and len(fleet) == COUNT
    assert fleet.steps == 20 and fleet.time == 0.2
    assert fleet.state.batch_shape == (COUNT,) and fleet.probe_depths.shape == (COUNT, 5)
    for place in range(COUNT):
        single = Simulation(many.boats[place], many.seas[place], many.state[place],
                            integrator=integrator, substeps=many.substeps[place])
        assert not same(single.state, fleet.state[place])
        for thrust in many.thrust:
            single.step(thrust[place])
        assert same(single.state, fleet.state[place])
        assert np.array_equal(single.probe_depths, fleet.probe_depths[place])


def test_one_thrust_one_substeps_and_one_sea_serve_the_whole_fleet():
    boat, starts = asymmetric_boat(), random_states((7,), 5)
    thrust = np.array([300.0, -20.0, 10.0, 5.0, 6.0, 70.0])
    shared = fleet_of([boat] * 7, [wind_sea()] * 7, starts, substeps=2)
    own = fleet_of([boat] * 7, [wind_sea() for _ in range(7)], starts, substeps=[2] * 7)
    for _ in range(5):
        shared.step(thrust)
        own.step(np.tile(thrust, (7, 1)))
    assert same(shared.state, own.state)


def test_fleet_of_one_is_a_fleet():
    boat, starts = asymmetric_boat(), random_states((1,), 8)
    fleet = fleet_of([boat], [wind_sea()], starts)
    single = Simulation(boat, wind_sea(), starts[0])
    for _ in range(5):
        fleet.step([[10.0] * 6])
        single.step([10.0] * 6)
    assert fleet.state.position.shape == (1, 3) and fleet.probe_depths.shape == (1, 5)
    assert same(single.state, fleet.state[0])


def test_two_threads_move_a_fleet_to_the_bit_as_one_does():
    count = 2 * LEAST_BOATS + 3
    many, starts = different(), random_states((count,), 6, tilt=3.0)
    boats = [many.boats[place % COUNT] for place in range(count)]
    # One of them fails in each thread's part.
    boats[7] = boats[count - 2] = exploding_boat()
    seas = [many.seas[place % COUNT] for place in range(count)]
    one, two = (fleet_of(boats, seas, starts, rate=10.0, integrator='euler', threads=threads)
                for threads in (1, 2))
    thrust = np.random.default_rng(7).normal(size=(count, 6)) * 500.0
    which = np.arange(count) % 3 == 0
    for periods in range(10):
        for fleet in (one, two):
            fleet.step(None if periods == 4 else thrust if periods % 2 else thrust[0])
            if periods == 6:
                fleet.reset(which)
    assert same(one.state, two.state) and np.array_equal(one.probe_depths, two.probe_depths)
    assert np.array_equal(one.failed, two.failed)
    assert one.failed[[7, count - 2]].all() and not one.failed.all()


def test_only_a_large_compiled_fleet_starts_threads():
    for count, threads, expected in ((2 * LEAST_BOATS - 1, 2, False), (2 * LEAST_BOATS, 1, False),
                                     (2 * LEAST_BOATS, 2, kind() == 'compiled')):
        fleet = fleet_of([box_boat()] * count, [Sea()] * count, random_states((count,), 1),
                         threads=threads)
        before = set(threading.enumerate())
        fleet.step()
        assert bool(set(threading.enumerate()) - before) == expected


def exploding_boat():
    """Return a boat of five probes whose damping blows up under explicit integrators."""
    return asymmetric_boat(damping=undamped(probe=8e4))


@pytest.mark.parametrize('place', range(5))
def test_a_boat_that_diverges_stands_still_and_the_rest_goes_on_as_without_it(place):
    many = different()
    boats, seas = many.boats[:5], many.seas[:5]
    boats[place] = exploding_boat()
    rest = [i for i in range(5) if i != place]
    options = {'rate': 10.0, 'integrator': 'rk4'}
    fleet = fleet_of(boats, seas, many.state[:5], **options, substeps=3)
    without = fleet_of([boats[i] for i in rest], [seas[i] for i in rest], many.state[rest],
                       **options, substeps=3)
    alone = Simulation(boats[place], seas[place], many.state[place], **options, substeps=3)
    for thrust in many.thrust[:, :5]:
        fleet.step(thrust)
        without.step(thrust[rest])
        if not fleet.failed[place]:
            alone.step(thrust[place])
            last = thrust
        elif last is not None:
            # A simulation alone says so in an error, and keeps the same state.
            with pytest.raises(SimulationError):
                alone.step(thrust[place])
            last = None
        assert same(fleet.state[place], alone.state)
        assert np.array_equal(fleet.probe_depths[place], alone.probe_depths)
    assert 0 < alone.steps < 20 and fleet.steps == 20
    assert fleet.failed.dtype == bool
    assert np.flatnonzero(fleet.failed).tolist() == [place]
    assert same(fleet.state[rest], without.state)
    assert np.array_equal(fleet.probe_depths[rest], without.probe_depths)


def test_a_masked_reset_puts_only_those_back():
    many = different()
    boats = [*many.boats[:5], exploding_boat()]
    fleet, left = (fleet_of(boats, many.seas[:6], many.state[:6], rate=10.0, integrator='euler')
                   for _ in range(2))
    for _ in range(10):
        fleet.step()
        left.step()
    assert fleet.failed.tolist() == [False] * 5 + [True]
    which = np.array([False, True, False, False, False, True])
    fleet.reset(which)
    # The sea goes on, and so does the clock.
    assert fleet.steps == 10 and not fleet.failed.any()
    assert same(fleet.state[~which], left.state[~which])
    assert np.array_equal(fleet.probe_depths[~which], left.probe_depths[~which])
    alone = Simulation(boats[1], many.seas[1], many.state[1], rate=10.0, integrator='euler')
    alone.run(1.0)
    begin = alone.state
    alone.state = many.state[1]
    assert same(fleet.state[1], alone.state) and not same(begin, alone.state)
    assert np.array_equal(fleet.probe_depths[1], alone.probe_depths)
    for _ in range(5):
        fleet.step()
        left.step()
        alone.step()
    assert same(fleet.state[~which], left.state[~which])
    assert same(fleet.state[1], alone.state)


def test_a_whole_reset_starts_anew_with_the_time():
    many = different()
    fleet = fleet_of(many.boats, many.seas, many.state)
    depths = fleet.probe_depths
    ends = []
    for _ in range(2):
        for thrust in many.thrust[:5]:
            fleet.step(thrust)
        ends.append(fleet.state)
        fleet.reset()
        assert fleet.time == 0.0 and np.array_equal(fleet.probe_depths, depths)
    assert same(*ends)


def test_setting_the_state_puts_all_boats_and_mends_the_failed():
    boats = [exploding_boat()] * 3
    fleet = fleet_of(boats, [Sea()] * 3, random_states((3,), 2), rate=10.0, integrator='euler')
    for _ in range(30):
        fleet.step()
    assert fleet.failed.all()
    there = random_states((3,), 3)
    fleet.state = there
    assert not fleet.failed.any() and fleet.steps == 30
    for part in PARTS:
        assert getattr(fleet.state, part) == pytest.approx(getattr(there, part), abs=1e-15)


@pytest.mark.parametrize(('thrust', 'says'), [
    (np.zeros((6, 6)), r'expected shape \(6,\) or \(3, 6\), got \(6, 6\)'),
    (np.zeros((3, 1, 6)), r'expected shape \(6,\) or \(3, 6\), got \(3, 1, 6\)'),
    (3.0, r'expected shape .* got \(\)'), ('ahead', "expected six numbers, got 'ahead'"),
    ([[0.0] * 6, [0.0] * 5, [0.0] * 6], 'expected six numbers'),
    ([[0.0] * 6, [0.0] * 6, [0.0, np.nan, 0.0, 0.0, 0.0, 0.0]],
     r'expected finite numbers, got \[0.0, nan')])
def test_bad_thrust_is_refused_in_one_line_and_changes_nothing(thrust, says):
    fleet = fleet_of([asymmetric_boat()] * 3, [wind_sea()] * 3, random_states((3,), 1))
    before = fleet.state
    with pytest.raises(ValueError, match='^thrust: ' + says) as caught:
        fleet.step(thrust)
    assert '\n' not in str(caught.value)
    assert same(fleet.state, before) and fleet.steps == 0


@pytest.mark.parametrize('which', [
    [True, False], [[True, False, True]], True, [1, 0, 1], [0], np.array([0.0, 1.0, 0.0])])
def test_what_is_reset_is_a_bool_for_each_boat(which):
    fleet = fleet_of([asymmetric_boat()] * 3, [wind_sea()] * 3, random_states((3,), 1))
    fleet.step()
    before = fleet.state
    with pytest.raises(ValueError, match='^which: expected a bool for each of 3 boats'):
        fleet.reset(which)
    assert same(fleet.state, before)
    fleet.reset([False] * 3)
    assert same(fleet.state, before)


@pytest.mark.parametrize(('changes', 'says'), [
    ({'boats': []}, 'fleet: expected at least one boat, and a sea for each, got 0 boats'),
    ({'seas': [Sea()] * 2}, 'got 3 boats and 2 seas'),
    ({'boats': [asymmetric_boat()] * 2 + [box_boat()]},
     'fleet: expected boats of equally many probes, got boats of 4 and 5 probes'),
    ({'state': random_states((4,), 1)}, r'state: expected batch shape \(3,\), got \(4,\)'),
    ({'state': State()}, r'state: expected batch shape \(3,\), got \(\)'),
    ({'state': State([[0.0, 0.0, 0.0]] * 2 + [[np.nan, 0.0, 0.0]])},
     r'state.position: expected finite numbers, got \[nan, 0.0, 0.0\]'),
    ({'substeps': [1, 1, 0]}, 'substeps: expected an integer of at least 1, got 0'),
    ({'substeps': [1, 2]}, 'substeps: expected a number, or one for each of 3 boats, got 2'),
    ({'threads': 0}, 'threads: expected an integer of at least 1, got 0'),
    ({'threads': 1.5}, 'threads: '),
    ({'rate': 0.0}, 'rate: expected a finite number above 0'),
    ({'integrator': 'heun'}, "integrator: expected one of leapfrog, .*, got 'heun'")])
def test_a_fleet_that_cannot_be_is_refused_in_one_line(changes, says):
    given = {'boats': [asymmetric_boat()] * 3, 'seas': [Sea()] * 3,
             'state': random_states((3,), 1), **changes}
    with pytest.raises(ValueError, match=says) as caught:
        fleet_of(**given)
    assert '\n' not in str(caught.value)


def test_a_fleet_in_plain_python_says_what_to_install(monkeypatch):
    monkeypatch.setattr(engine, 'compile_now', lambda function, *arguments: function)
    monkeypatch.setattr(fleet_module, 'find_spec', lambda name: None)
    with pytest.warns(RuntimeWarning, match=r'pip install "boat_buoyancy\[fast\]"') as caught:
        fleet = Fleet([asymmetric_boat()] * 2, [wind_sea()] * 2, random_states((2,), 1))
    assert len(caught) == 1 and caught[0].filename == __file__
    fleet.step()
