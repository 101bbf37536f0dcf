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

"""Wind pushes a boat by drag in the air: what it comes to, where it turns, what it never gives."""

from dataclasses import replace

from boat_buoyancy.physics import Damping, load_scene, Sea, Simulation, State
from boat_buoyancy.physics.sea.fading import fade
from boat_buoyancy.physics.stepping.speed_bound import speed_norm
from boats import (asymmetric_boat, DRAFT, last_state, MASS, random_states, reference_boat, same,
                   start, turned, undamped, wind_sea, windy)
import numpy as np
import pytest

pytestmark = pytest.mark.plain

AFLOAT = State((0.0, 0.0, -DRAFT))
# The moment about the vertical of the reference boat, kg m^2.
YAW_MOMENT = 900.0


def blown_boat(wind, **damping):
    """Return the reference boat with such a drag in the air, and damping in the water."""
    return reference_boat(damping=undamped(wind=wind, **damping))


def heading(state):
    """Return the bow's direction in the world."""
    x, y, z, w = state.orientation
    return np.array([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z)])


@pytest.mark.parametrize('yaw', [0.0, np.pi / 2])
@pytest.mark.parametrize('wind', [12.0, -12.0])
def test_a_boat_drifts_as_fast_as_drag_in_water_and_air_are_equal(yaw, wind):
    # X (W - u)^2 = D u, ahead and abeam; 300 s are ten times as long as it takes.
    surge, sway, drag = 5.0, 20.0, 100.0
    boat = blown_boat([surge, sway, 0.0], linear=[drag] * 6)
    state = last_state(boat, replace(AFLOAT, orientation=turned(yaw=yaw)), 300.0, rate=20.0,
                       sea=Sea(wind=[wind, 0.0]))
    ahead = surge if yaw == 0.0 else sway
    drift, = (root for root in np.roots([ahead, -(2.0 * ahead * 12.0 + drag), ahead * 144.0])
              if root < 12.0)
    assert state.velocity[0] == pytest.approx(np.sign(wind) * drift, rel=1e-9)
    assert abs(state.velocity[1]) < 1e-9


def test_a_boat_that_falls_through_the_air_is_blown_along():
    # m u' = X (W - u)^2, so W - u = W / (1 + X W t / m).
    boat = blown_boat([15.0, 0.0, 0.0])
    state = last_state(boat, State((0.0, 0.0, 1000.0)), 5.0, rate=100.0, sea=Sea(wind=[20.0, 0.0]))
    gone = 20.0 / (1.0 + 15.0 * 20.0 * 5.0 / MASS)
    assert state.velocity == pytest.approx([20.0 - gone, 0.0, -9.81 * 5.0], abs=1e-6)


def test_a_boat_that_moves_with_the_wind_feels_none():
    wind = [3.0, -4.0]
    state = State((0.0, 0.0, -DRAFT), turned(yaw=0.7), (*wind, 0.0))
    for boat in (asymmetric_boat(), asymmetric_boat(damping=windy())):
        free = boat.with_damping(replace(boat.damping, wind=[0.0] * 3))
        moving, still = (Simulation(one, Sea(wind=wind), state).acceleration()
                         for one in (boat, free))
        np.testing.assert_allclose(moving, still, rtol=0.0, atol=1e-12)


def test_a_wind_pushes_a_boat_at_rest_by_its_numbers_on_each_axis():
    # 10 m/s towards 30 degrees to port of the bow.
    boat, along, across = blown_boat([2.0, 6.0, -4.0]), 10.0 * np.sqrt(0.75), 5.0
    wind = [10.0 * np.cos(1.2), 10.0 * np.sin(1.2)]
    simulation = Simulation(boat, Sea(wind=wind),
                            replace(AFLOAT, orientation=turned(yaw=1.2 - np.pi / 6)))
    linear, angular = simulation.acceleration()
    assert linear == pytest.approx([2.0 * along**2 / MASS, 6.0 * across**2 / MASS, 0.0], abs=1e-12)
    assert angular == pytest.approx([0.0, 0.0, -4.0 * across**2 / YAW_MOMENT], abs=1e-12)


@pytest.mark.parametrize(('yaw_drag', 'bow'), [(-8.0, -1.0), (8.0, 1.0)])
def test_a_boat_pushed_aft_of_its_middle_turns_its_bow_into_the_wind(yaw_drag, bow):
    boat = blown_boat([4.0, 10.0, yaw_drag], linear=[2000.0] * 3 + [500.0] * 3)
    state = last_state(boat, replace(AFLOAT, orientation=turned(yaw=1.3)), 120.0, rate=20.0,
                       sea=Sea(wind=[10.0, 0.0]))
    assert heading(state) == pytest.approx([bow, 0.0], abs=1e-2)


def test_drag_in_the_air_follows_the_wind_and_not_the_water():
    # In still air a current carries the boat into the wind that this makes: X u^2 = D (U - u).
    boat = blown_boat([30.0, 30.0, 0.0], linear=[100.0] * 6)
    state = last_state(boat, AFLOAT, 300.0, rate=20.0, sea=Sea(current=[2.0, 0.0]))
    drift, = (root for root in np.roots([30.0, 100.0, -200.0]) if root > 0.0)
    assert state.velocity[0] == pytest.approx(drift, rel=1e-9)


@pytest.mark.parametrize('integrator', ['leapfrog', 'implicit'])
@pytest.mark.parametrize('rate', [100.0, 1.0, 0.1])
def test_still_air_never_gives_energy_to_a_boat_in_flight_at_any_step(integrator, rate):
    # Hardly any gravity and one moment of inertia: what is left to change the energy is drag.
    boat = replace(reference_boat(inertia=(700.0,) * 3,
                                  damping=undamped(wind=[400.0, 900.0, -5000.0])), gravity=1e-12)
    states = random_states((50,), 4, speed=30.0)
    states = replace(states, position=states.position + [0.0, 0.0, 1e6])
    fleet = start(boat, states, rate=rate, integrator=integrator)
    norm = speed_norm(boat, fleet.state)
    first = norm.copy()
    for _ in range(30):
        fleet.step()
        after = speed_norm(boat, fleet.state)
        assert (after <= norm * (1.0 + 1e-12)).all()
        norm = after
    assert (norm < 0.99 * first).all()


def test_without_drag_in_the_air_the_wind_changes_nothing():
    boat, state = asymmetric_boat(), random_states((), 3)
    one, other = (last_state(boat, state, 2.0, sea=sea)
                  for sea in (wind_sea(), wind_sea().with_wind([30.0, 20.0])))
    assert same(one, other)


def test_a_new_wind_blows_at_once_while_the_sea_fades():
    old, new = wind_sea().with_wind([5.0, 0.0]), Sea(wind=[0.0, 7.0])
    fading = fade(old, new, 1.0, 4.0)
    assert fading.wind.tolist() == fading.record['wind'].tolist() == [0.0, 7.0]
    gust = fading.with_wind([1.0, 2.0]).starting_at(0.5)
    assert gust.wind.tolist() == gust.new.wind.tolist() == [1.0, 2.0]
    x = np.linspace(-5.0, 5.0, 9)
    np.testing.assert_allclose(gust.elevation(x, x, 1.5), fading.elevation(x, x, 2.0), atol=1e-12)


def test_gusts_of_a_simulation_act_with_the_next_step_and_leave_its_boat():
    boat = blown_boat([2.0, 6.0, -4.0])
    simulation = Simulation(boat, Sea(), AFLOAT)
    for wind in ((10.0, 0.0), (0.0, -5.0)):
        simulation.wind = wind
        linear, _ = simulation.acceleration()
        assert linear[:2] == pytest.approx([2.0 * wind[0]**2 / MASS, -6.0 * wind[1]**2 / MASS])
    with pytest.raises(ValueError, match='wind.velocity'):
        simulation.wind = (np.nan, 0.0)
    assert simulation.wind.tolist() == [0.0, -5.0] and simulation.boat is boat


@pytest.mark.parametrize(('drag', 'said'), [
    ([1.0, 0.0, 2.0], 'as it is the sway times how far ahead its force acts, got [1.0, 0.0, 2.0]'),
    ([1.0, 1e-9, 2.0], 'expected a yaw of at most 1e+06 m times the sway'),
    ([-1.0, 0.0, 0.0], 'expected surge and sway of at least 0, got [-1.0, 0.0, 0.0]'),
    ([1.0, -2.0, 0.0], 'expected surge and sway of at least 0'),
    ([1.0, 2.0], 'expected 3 numbers, got 2'),
    ([1.0, np.nan, 0.0], 'expected a finite number')])
def test_a_drag_that_no_boat_has_is_refused(drag, said):
    for make in (lambda: Damping(wind=drag), lambda: load_scene({'wind.drag': drag})):
        with pytest.raises(ValueError) as raised:
            make()
        assert str(raised.value).startswith('wind.drag') and said in str(raised.value)


def test_a_wind_that_is_none_is_refused():
    for wind in ([np.inf, 0.0], [1.0], 'strong'):
        with pytest.raises(ValueError, match='wind.velocity'):
            Sea(wind=wind)
        with pytest.raises(ValueError, match='wind.velocity'):
            load_scene({'wind.velocity': wind})


def test_a_scene_has_its_wind_and_is_told_when_nothing_feels_it():
    scene = load_scene({'wind.velocity': [6.0, -2.0], 'wind.drag': [1.0, 3.0, -0.5]})
    assert scene.sea.wind.tolist() == [6.0, -2.0]
    assert scene.boat.damping.wind.tolist() == [1.0, 3.0, -0.5]
    assert scene.warnings == ()
    said, = load_scene({'wind.velocity': [6.0, -2.0]}).warnings
    assert said.startswith('wind.velocity has no effect')
