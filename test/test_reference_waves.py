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

from dataclasses import replace
import re

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.boat.boat import Damping
from boat_buoyancy.physics.boat.state import State
from boat_buoyancy.physics.sea.dispersion import wavenumber
from boat_buoyancy.physics.sea.waves import Sea
from boats import (
    all_damping, asymmetric_boat, DRAFT, HEAVE, last_state, MASS, random_states, reference_boat,
    simulate, start, undamped, wind_sea)
import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation
from textbook import dispersion, water

pytestmark = pytest.mark.plain

GRAVITY = 9.81


@pytest.mark.parametrize(('period', 'depth', 'length', 'digit'), [
    (8.0, 0.0, 99.9238, 5e-5), (4.0, 0.0, 24.981, 5e-4), (8.0, 10.0, 70.8984, 5e-5),
    (10.0, 20.0, 121.2369, 5e-5)])
def test_wave_length_by_dispersion(period, depth, length, digit):
    k = wavenumber(2 * np.pi / period, depth)
    assert 2 * np.pi / k == pytest.approx(length, abs=digit)
    assert k == pytest.approx(dispersion(2 * np.pi / period, depth, GRAVITY), rel=1e-13)


def test_deep_waves_are_as_long_as_the_square_of_their_period():
    for period in (0.5, 4.0, 8.0, 30.0):
        assert 2 * np.pi / wavenumber(2 * np.pi / period) == pytest.approx(
            GRAVITY * period**2 / (2 * np.pi), rel=1e-14)


@pytest.mark.parametrize('depth', [0.01, 0.3, 3.0, 50.0, 1e4])
def test_dispersion_holds_from_ripples_to_tides(depth):
    frequency = 2 * np.pi / np.geomspace(0.1, 1e5, 61)
    k = wavenumber(frequency, depth)
    assert GRAVITY * k * np.tanh(k * depth) == pytest.approx(frequency**2, rel=1e-12)
    # Both limits of linear theory: deep water, and g h as the fastest speed of all.
    assert (k >= frequency**2 / GRAVITY * (1 - 1e-12)).all()
    assert (frequency / k <= np.sqrt(GRAVITY * depth) * (1 + 1e-12)).all()


# On a current.

def test_a_wave_of_3_s_going_with_1_m_per_s_is_longer_and_its_water_slower():
    # (w - k)^2 = g k, by the quadratic formula.
    w = 2 * np.pi / 3.0
    k = min(np.roots([1.0, -2.0 * w - GRAVITY, w**2]))
    assert (2 * np.pi / k, GRAVITY * 9.0 / (2 * np.pi)) == pytest.approx((19.6, 14.1), abs=0.06)
    sea = Sea([[0.1, 3.0, 0.0, 0.0]], current=(1.0, 0.0))
    assert sea.wave_vector[0, 0] == pytest.approx(k, rel=1e-13)
    x, time = np.linspace(0.0, 30.0, 7), 1.7
    theta = k * x - w * time
    np.testing.assert_allclose(sea.elevation(x, 0.0, time), 0.1 * np.cos(theta), atol=1e-14)
    np.testing.assert_allclose(sea.velocity(x, 0.0, time), np.stack([
        1.0 + 0.1 * (w - k) * np.cos(theta), 0.0 * x, 0.1 * (w - k) * np.sin(theta)], axis=1),
        atol=1e-13)


@pytest.mark.parametrize('depth', [0.0, 0.3, 3.0, 50.0])
def test_the_length_on_a_current_is_that_of_the_branch_of_still_water(depth):
    random = np.random.default_rng(8)
    frequency, current = 2 * np.pi / 10 ** random.uniform(-1, 3, 100), random.normal(0, 1.5, 100)
    found = wavenumber(frequency, depth, GRAVITY, current)
    assert 20 < np.isfinite(found).sum() < 100
    for w, u, k in zip(frequency, current, found):
        # In steps of a thousandth from where still water comes from, k = 0, or past the greatest
        # root there could be: the frequency on the current falls beyond g / (4 u^2).
        tried = np.geomspace(1e-6 * w**2 / GRAVITY, max(GRAVITY / u**2, 2.0 * w / abs(u)), 40000)
        shallow = np.tanh(tried * depth) if depth else 1.0
        excess = np.sqrt(GRAVITY * tried * shallow) + u * tried - w
        if np.isnan(k):
            assert excess.max() < 1e-6 * w
        else:
            assert k == pytest.approx(dispersion(w, depth, GRAVITY, u), rel=1e-7)


@pytest.mark.parametrize('depth', [0.0, 2.0])
def test_the_current_stops_a_wave_where_its_energy_stands_still(depth):
    against = 1.0

    def group_speed(k):
        return (np.sqrt(GRAVITY * (k + h) * tanh(k + h)) - np.sqrt(GRAVITY * k * tanh(k))) / h

    def tanh(k):
        return np.tanh(k * depth) if depth else 1.0
    h = 1e-7
    k = brentq(lambda k: group_speed(k) - against, 0.01, 100.0)
    period = 2 * np.pi / (np.sqrt(GRAVITY * k * tanh(k)) - against * k)
    if not depth:
        # w U = g / 4.
        assert period == pytest.approx(8 * np.pi * against / GRAVITY, rel=1e-5)
    for direction, current in ((np.pi, (against, 0.0)), (0.5, (-np.cos(0.5), -np.sin(0.5)))):
        Sea([[0.1, 1.0001 * period, direction, 0.0]], current, depth)
        with pytest.raises(ValueError, match='row 2') as raised:
            Sea([[0.1, 9.0, 0.0, 0.0], [0.1, 0.9999 * period, direction, 0.0]], current, depth)
        said = re.search(r'cannot run against 1 m/s of sea.current: \[.*\]; expected a period of '
                         r'at least (.*) s there: give it a longer', str(raised.value))
        assert period <= float(said[1]) <= period + 0.011


def test_a_current_faster_than_the_longest_waves_of_a_depth_stops_them_all():
    speed = np.sqrt(GRAVITY * 2.0)
    Sea([[0.1, 1e4, 0.0, 0.0]], (-0.99 * speed, 0.0), 2.0)
    with pytest.raises(ValueError, match='expected less than 4.43 m/s, at which the longest'):
        Sea([[0.1, 1e6, 0.0, 0.0]], (-1.01 * speed, 0.0), 2.0)


@pytest.mark.parametrize('depth', [0.0, 1.5])
@pytest.mark.parametrize('integrator', ['leapfrog', 'rk4'])
def test_a_boat_adrift_moves_as_in_still_water_that_the_current_carries_along(depth, integrator):
    """Who moves with the water cannot tell that it moves (Galileo)."""
    current, sea = np.array([0.6, -0.3]), wind_sea()
    on_current = Sea(sea.waves, current, depth)
    # The same lengths; the periods that who drifts sees.
    still = sea.waves.copy()
    still[:, 1] = 2 * np.pi / (2 * np.pi / sea.waves[:, 1] - on_current.wave_vector @ current)
    # The air does not drift.
    boat = asymmetric_boat(damping=replace(all_damping(), air_linear_retention=[1.0]))
    state = random_states((), 9)
    adrift = replace(state, velocity=state.velocity + [*current, 0.0])
    run = {'rate': 50, 'integrator': integrator}
    moved = last_state(boat, adrift, 8.0, sea=on_current, **run)
    stayed = last_state(boat, state, 8.0, sea=Sea(still, depth=depth), **run)
    assert moved.position - [*(8.0 * current), 0.0] == pytest.approx(stayed.position, abs=1e-10)
    assert moved.velocity - [*current, 0.0] == pytest.approx(stayed.velocity, abs=1e-10)
    assert moved.orientation == pytest.approx(stayed.orientation, abs=1e-10)
    assert moved.angular_velocity == pytest.approx(stayed.angular_velocity, abs=1e-10)


def test_a_boat_that_heads_along_a_spread_sea_rolls_and_along_a_long_crested_one_never():
    def swing(spreading):
        run = load_scene({'sea.sea_state': 2, 'sea.spreading': spreading}).simulation().run(30.0)
        return run.roll.std(), run.pitch.std()
    roll, pitch = swing(0.0)
    assert roll < 1e-12 and pitch > 0.01
    # Slopes across over slopes along, by the mean of cos(2 theta): s (s - 1) / (s + 1) (s + 2).
    roll, pitch = swing(10.0)
    double = 90.0 / 132.0
    slopes = np.sqrt((1.0 - double) / (1.0 + double))
    # Half a minute of a boat that is stiffer in roll than in pitch: within a factor of three.
    assert slopes / 3.0 < roll / pitch < 3.0 * slopes


def test_elevation_of_a_linear_wave():
    sea = Sea([[2.0, 10.0, 0.0, 0.0]])
    assert sea.elevation(0.0, 0.0, 5.0) == pytest.approx(-2.0, abs=1e-12)
    for x in (2.5, -2.5):
        assert sea.elevation(x, 7.0, 5.0) == pytest.approx(-1.989886648, abs=5e-10)


def test_crests_go_where_the_direction_says():
    direction, period = 2.0, 6.0
    sea = Sea([[1.0, period, direction, 0.0]])
    speed = GRAVITY * period / (2 * np.pi)
    for time in (0.0, 1.3, 4.4):
        x, y = speed * time * np.cos(direction), speed * time * np.sin(direction)
        assert sea.elevation(x, y, time) == pytest.approx(1.0, abs=1e-12)


def test_phase_moves_the_crest_back():
    sea = Sea([[1.0, 6.0, 0.0, 0.5]])
    assert sea.elevation(-0.5 / wavenumber(2 * np.pi / 6.0), 0.0, 0.0) == pytest.approx(1.0)


@pytest.mark.parametrize('depth', [0.0, 1.5])
def test_water_at_the_surface_rises_with_it(depth):
    waves, step = wind_sea().waves, 1e-5
    sea = Sea(waves, depth=depth)
    x, y = np.random.default_rng(1).uniform(-20, 20, (2, 50))
    rise = (sea.elevation(x, y, 3.0 + step) - sea.elevation(x, y, 3.0 - step)) / (2 * step)
    assert sea.velocity(x, y, 3.0)[:, 2] == pytest.approx(rise, abs=1e-9)


@pytest.mark.parametrize('depth', [0.0, 1.5])
def test_horizontal_acceleration_of_the_surface_is_gravity_times_its_slope(depth):
    # Linear theory at constant pressure: du/dt = -g grad(eta).
    sea, step = Sea(wind_sea().waves, depth=depth), 1e-5
    x, y = np.random.default_rng(2).uniform(-20, 20, (2, 50))
    rate = (sea.velocity(x, y, 3.0 + step) - sea.velocity(x, y, 3.0 - step)) / (2 * step)
    assert rate[:, :2] == pytest.approx(-GRAVITY * sea.slope(x, y, 3.0), abs=1e-8)
    along = (sea.elevation(x + step, y, 3.0) - sea.elevation(x - step, y, 3.0)) / (2 * step)
    across = (sea.elevation(x, y + step, 3.0) - sea.elevation(x, y - step, 3.0)) / (2 * step)
    assert sea.slope(x, y, 3.0) == pytest.approx(np.stack([along, across], axis=-1), abs=1e-9)


@pytest.mark.parametrize('depth', [0.0, 2.0])
def test_water_is_that_of_the_textbook(depth):
    sea = Sea(wind_sea().waves, wind_sea().current, depth)
    for x, y, time in np.random.default_rng(3).uniform(-50, 50, (30, 3)):
        height, velocity = water(sea, x, y, time)
        assert sea.elevation(x, y, time) == pytest.approx(height, abs=1e-12)
        assert sea.velocity(x, y, time) == pytest.approx(velocity, abs=1e-12)


def test_probes_are_as_deep_as_the_surface_is_above_them():
    sea, boat = wind_sea(), asymmetric_boat()
    fleet = start(boat, random_states((12,), 6), sea=sea, rate=50)
    for _ in range(7):
        fleet.step()
    state, depths = fleet.state, fleet.probe_depths
    assert depths.shape == (12, 5)
    for i in range(12):
        turn = Rotation.from_quat(state.orientation[i])
        probes = state.position[i] + turn.apply(boat.probe_offsets)
        surface = [water(sea, x, y, 7 / 50)[0] for x, y, _ in probes]
        assert depths[i] == pytest.approx(surface - probes[:, 2], abs=1e-12)


def test_a_sea_set_to_another_hour_is_the_same_sea():
    sea, noon = wind_sea(), 43200.0
    later = sea.starting_at(noon)
    x, y = np.random.default_rng(4).uniform(-20, 20, (2, 30))
    assert later.elevation(x, y, 1.5) == pytest.approx(sea.elevation(x, y, noon + 1.5), abs=1e-9)


def test_fastest_water_bounds_the_water():
    sea = Sea(wind_sea().waves, wind_sea().current, 0.8)
    x, y = np.random.default_rng(5).uniform(-100, 100, (2, 2000))
    speeds = np.linalg.norm(sea.velocity(x, y, np.linspace(0, 100, 2000)), axis=1)
    assert 0.5 * sea.fastest_water < speeds.max() <= sea.fastest_water


def response(period, rate):
    """Return the amplitude of heave over that of the wave, by a fit of a sinusoid."""
    half = 4.0 / (2 * np.sqrt(3.0))
    places = [[half, 1.0, 0.0], [half, -1.0, 0.0], [-half, 1.0, 0.0], [-half, -1.0, 0.0]]
    boat = reference_boat(positions=places, inertia=(1e3, 1e3, 1e3),
                          damping=undamped(probe=2 * 0.2 * HEAVE * MASS))
    amplitude = 1e-6
    sea = Sea([[amplitude, period, 0.0, 0.0]])
    time, states = simulate(boat, State((0.0, 0.0, -DRAFT)), 33.0, sea=sea, rate=rate,
                            integrator='rk4')
    # The last 8 s, when what the start has set off is gone: exp(-0.2 * 4.43 * 25) = 2e-10.
    time, height = time[25 * rate:], states.position[25 * rate:, 2]
    omega = 2 * np.pi / period
    angle = omega * time
    shape = np.stack([np.cos(angle), np.sin(angle), np.ones_like(angle)], axis=1)
    (a, b, _), *_ = np.linalg.lstsq(shape, height, rcond=None)
    k = omega**2 / GRAVITY
    r, z = omega / HEAVE, 0.2
    exact = abs(np.cos(k * half)) * np.sqrt(
        (1 + (2 * z * r)**2) / ((1 - r**2)**2 + (2 * z * r)**2))
    return np.hypot(a, b) / amplitude, exact


@pytest.mark.parametrize(('period', 'published'), [
    (20.0, 1.0050), (10.0, 1.0194), (5.0, 1.0676), (3.0, 1.1075), (2.0, 0.7225)])
def test_heave_in_waves_is_that_of_a_damped_oscillator(period, published):
    measured, exact = response(period, 100)
    assert exact == pytest.approx(published, abs=5e-5)
    # What is not linear is of the order of the wave's amplitude in parts of the boat, 1e-6.
    assert measured == pytest.approx(exact, abs=1e-6)


def test_a_boat_drifts_to_the_speed_of_the_current():
    damping = Damping(linear_retention=[0.5], angular_retention=[0.5])
    sea = Sea(current=[0.4, -0.3])
    for boat in (reference_boat(damping=damping), reference_boat(damping=undamped(probe=800.0))):
        state = last_state(boat, State((0.0, 0.0, -DRAFT)), 60.0, sea=sea, rate=20)
        assert state.velocity == pytest.approx((0.4, -0.3, 0.0), abs=1e-9)


@pytest.mark.parametrize('integrator', ['leapfrog', 'implicit', 'rk4'])
def test_a_boat_that_moves_with_the_current_feels_none(integrator):
    boat = reference_boat(damping=Damping(probe=500.0, linear=[100.0] * 6, quadratic=[100.0] * 6))
    moving = State((0.0, 0.0, -DRAFT), velocity=(0.4, -0.3, 0.0))
    state = last_state(boat, moving, 10.0, sea=Sea(current=[0.4, -0.3]), rate=20,
                       integrator=integrator)
    assert state.velocity == pytest.approx((0.4, -0.3, 0.0), abs=1e-12)
    assert state.position == pytest.approx((4.0, -3.0, -DRAFT), abs=1e-11)


def test_a_long_wave_carries_the_boat_up_and_down():
    boat = reference_boat(damping=undamped(probe=1000.0))
    sea = Sea([[1.0, 60.0, 0.0, 0.0]])
    time, states = simulate(boat, State((0.0, 0.0, 1.0 - DRAFT)), 60.0, sea=sea, rate=20)
    surface = sea.elevation(states.position[:, 0], states.position[:, 1], time)
    # An oscillator that follows a slow base lags by r^2 of the amplitude, and that much again
    # swings freely, as it starts without.
    r = 2 * np.pi / 60 / HEAVE
    away = states.position[:, 2] - (surface - DRAFT)
    assert abs(away).max() < 2 * r**2
