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

from boat_buoyancy.physics.blocks import block_size, MOST_BOATS
from boat_buoyancy.physics.boat import State
from boat_buoyancy.physics.simulation import Simulation
from boat_buoyancy.physics.waves import Sea
from boats import asymmetric_boat, LAWS, METHODS, random_states, wind_sea
import numpy as np
import pytest

PARTS = ('position', 'orientation', 'velocity', 'angular_velocity')


def one_of(states, place):
    return State(*(getattr(states, part)[place] for part in PARTS))


def difference(one, fleet, place):
    return max(abs(getattr(one, part) - getattr(fleet, part)[place]).max() for part in PARTS)


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('method', METHODS)
def test_fleet_of_a_hundred_moves_as_a_hundred_single_boats(method, law):
    # Waves, current, quadratic drag, full inertia tensor, a thrust for every boat; upside down,
    # in the air, deep under water.
    boat, sea, starts = asymmetric_boat(law), wind_sea(), random_states((100,), 1, tilt=3.0)
    thrusts = np.random.default_rng(2).normal(size=(100, 6)) * 500.0
    fleet = Simulation(boat, sea, starts, rate=100, integrator=method, substeps=2)
    for _ in range(10):
        fleet.step(thrusts)
    state, depths = fleet.state, fleet.probe_depths
    assert state.batch_shape == (100,) and depths.shape == (100, 5)
    for place in range(100):
        single = Simulation(boat, sea, one_of(starts, place), rate=100, integrator=method,
                            substeps=2)
        for _ in range(10):
            single.step(thrusts[place])
        assert difference(single.state, state, place) < 1e-12
        assert abs(single.probe_depths - depths[place]).max() < 1e-12


@pytest.mark.parametrize('method', ['leapfrog', 'implicit', 'rk4'])
def test_shape_of_a_fleet_is_kept(method):
    boat, sea, starts = asymmetric_boat('column'), wind_sea(), random_states((100,), 3)
    thrusts = np.random.default_rng(4).normal(size=(100, 6)) * 500.0
    square = State(*(getattr(starts, part).reshape(4, 25, -1) for part in PARTS))
    row = Simulation(boat, sea, starts, integrator=method)
    table = Simulation(boat, sea, square, integrator=method)
    for _ in range(5):
        row.step(thrusts)
        table.step(thrusts.reshape(4, 25, 6))
    assert table.state.batch_shape == (4, 25)
    assert table.probe_depths.shape == (4, 25, 5)
    assert np.array_equal(table.probe_depths.reshape(100, 5), row.probe_depths)
    for part in PARTS:
        assert np.array_equal(getattr(table.state, part).reshape(100, -1),
                              getattr(row.state, part))


def test_one_thrust_serves_the_whole_fleet():
    boat, starts = asymmetric_boat(), random_states((7,), 5)
    thrust = np.array([300.0, -20.0, 10.0, 5.0, 6.0, 70.0])
    shared, own = Simulation(boat, Sea(), starts), Simulation(boat, Sea(), starts)
    for _ in range(5):
        shared.step(thrust)
        own.step(np.tile(thrust, (7, 1)))
    for part in PARTS:
        assert np.array_equal(getattr(shared.state, part), getattr(own.state, part))


def test_fleet_larger_than_a_block_is_stepped_whole():
    boat, sea = asymmetric_boat(), wind_sea()
    block = block_size(len(boat.hull.share), len(sea.waves))
    count = 2 * block + 3
    starts = random_states((count,), 6)
    thrusts = np.random.default_rng(7).normal(size=(count, 6)) * 500.0
    fleet = Simulation(boat, sea, starts)
    for _ in range(3):
        fleet.step(thrusts)
    state, depths = fleet.state, fleet.probe_depths
    for place in (0, block - 1, block, 2 * block - 1, 2 * block, count - 1):
        single = Simulation(boat, sea, one_of(starts, place))
        for _ in range(3):
            single.step(thrusts[place])
        assert difference(single.state, state, place) < 1e-12
        assert abs(single.probe_depths - depths[place]).max() < 1e-12


def test_blocks_shrink_with_probes_and_waves_and_a_new_sea_cuts_the_fleet_anew():
    assert block_size(4, 0) == MOST_BOATS
    assert block_size(16, 64) < block_size(4, 64) < block_size(4, 4) <= MOST_BOATS
    assert block_size(10 ** 6, 1000) == 1
    boat, starts = asymmetric_boat(), random_states((MOST_BOATS + 5,), 9)
    rows = np.tile([0.01, 5.0, 0.0, 0.0], (64, 1))
    changed, fresh = Simulation(boat, Sea(), starts), Simulation(boat, Sea(rows), starts)
    changed.sea = Sea(rows)
    for part in PARTS:
        assert np.array_equal(getattr(changed.state, part), getattr(fresh.state, part))
    changed.step()
    fresh.step()
    for part in PARTS:
        assert np.array_equal(getattr(changed.state, part), getattr(fresh.state, part))


def test_fleet_of_one_is_a_fleet():
    boat, starts = asymmetric_boat(), random_states((1,), 8)
    fleet, single = Simulation(boat, wind_sea(), starts), Simulation(
        boat, wind_sea(), one_of(starts, 0))
    for _ in range(5):
        fleet.step()
        single.step()
    assert fleet.state.position.shape == (1, 3) and fleet.probe_depths.shape == (1, 5)
    assert difference(single.state, fleet.state, 0) < 1e-12


@pytest.mark.parametrize('law', LAWS)
def test_a_boat_with_all_probes_wet_moves_as_beside_one_that_is_not(law):
    # A fleet all wet takes its sums over the probes in one, any other one by the ramps.
    boat, sea = asymmetric_boat(law), wind_sea()
    wet = State([[0.0, 0.0, -0.2]] * 2)
    mixed = State([[0.0, 0.0, -0.2], [0.0, 0.0, 30.0]])
    fleets = [Simulation(boat, sea, state) for state in (wet, mixed)]
    for _ in range(20):
        for fleet in fleets:
            fleet.step()
    assert (fleets[0].probe_depths > 0.1 * boat.hull.height).all()
    for part in ('position', 'orientation', 'velocity', 'angular_velocity'):
        one, other = (getattr(fleet.state, part)[0] for fleet in fleets)
        np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-13)
