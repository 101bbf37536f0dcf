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

"""A sea that changes while a boat lies in it."""

import math

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.boat import State
from boat_buoyancy.physics.fading import pace, same_waves, STEEPEST, weight
from boat_buoyancy.physics.simulation import Simulation
from boat_buoyancy.physics.transition import fade, MAX_FADING, SeaTransition
from boat_buoyancy.physics.waves import Sea
import numpy as np
import pytest


FLAT = Sea()
OLD = Sea([[0.2, 3.0, 0.0, 0.0], [0.1, 2.0, 1.0, 0.5]], current=(0.5, 0.0))
NEW = Sea([[0.3, 2.5, 2.0, 1.0]], current=(0.0, -0.4))
THIRD = Sea([[0.1, 4.0, -1.0, 2.0]], depth=5.0)
START, DURATION, END = 10.0, 2.0, 12.0
X, Y = np.linspace(-5.0, 5.0, 7), np.linspace(3.0, -4.0, 7)
POINTS = np.stack([X, Y, np.zeros(7)])[:, :, None]


def everything(sea, time):
    """Return elevation, velocity and what a step is given, in one array."""
    now = sea.at(time)
    one_boat = np.vstack([POINTS[:, :, 0], np.ones(7), np.full(7, time)])
    return np.concatenate([now.elevation(X, Y, time).ravel(), now.velocity(X, Y, time).ravel(),
                           now.surface(POINTS, time).ravel(),
                           now.surface(one_boat, time).ravel(), now.current])


def test_both_ends_are_exact():
    sea = fade(OLD, NEW, START, DURATION)
    for time in (0.0, 9.9, START):
        np.testing.assert_array_equal(everything(sea, time), everything(OLD, time))
    for time in (END, 12.1, 1000.0):
        np.testing.assert_array_equal(everything(sea, time), everything(NEW, time))


def test_a_third_sea_during_the_fade_is_exact_at_its_end_and_continuous():
    first = fade(OLD, NEW, START, DURATION)
    both = fade(first, THIRD, 11.0, DURATION)
    for time in (10.5, 11.0):
        np.testing.assert_array_equal(everything(both, time), everything(first, time))
    np.testing.assert_array_equal(everything(both, 13.0), everything(THIRD, 13.0))
    times = np.arange(9.0, 14.0, 0.01)
    height = np.array([both.elevation(X, Y, time) for time in times])
    # 30 cm of waves of 2 s and more, and fades over 2 s: no speed above this.
    assert np.abs(np.diff(height, axis=0)).max() < 0.01 * 0.7 * (math.pi + STEEPEST)


def test_zero_duration_changes_at_once():
    assert fade(OLD, NEW, START, 0.0) is NEW


@pytest.mark.parametrize('old', [FLAT, OLD])
@pytest.mark.parametrize('time', [10.0, 10.3, 11.0, 11.7, 12.0])
def test_the_water_rises_as_fast_as_the_surface(old, time):
    sea = fade(old, NEW, START, DURATION)
    h = 1e-5
    rise = (sea.elevation(X, Y, time + h) - sea.elevation(X, Y, time - h)) / (2 * h)
    # Linear waves: w = d eta/dt at the surface.
    np.testing.assert_allclose(sea.velocity(X, Y, time)[:, 2], rise, atol=2e-5)


def test_what_the_step_is_given_is_elevation_and_velocity_without_current():
    sea, time = fade(OLD, NEW, START, DURATION), 10.8
    surface = sea.at(time).surface(POINTS, time)[:, :, 0]
    np.testing.assert_allclose(surface[0], sea.elevation(X, Y, time), atol=1e-12)
    velocity = sea.velocity(X, Y, time) - [*sea.at(time).current, 0.0]
    np.testing.assert_allclose(surface[1:].T, velocity, atol=1e-12)


def test_the_bound_of_the_water_speed_holds():
    sea = fade(OLD, NEW, START, DURATION)
    fastest = max(np.linalg.norm(sea.velocity(X, Y, time), axis=1).max()
                  for time in np.linspace(9.0, 13.0, 400))
    assert fastest <= sea.fastest_water


@pytest.mark.parametrize('seas', [(OLD, NEW), (OLD, NEW, THIRD), (NEW, OLD, OLD, NEW)])
def test_one_boat_is_given_the_surface_that_a_fleet_is_given(seas):
    sea = seas[0]
    for i, new in enumerate(seas[1:]):
        sea = fade(sea, new, START + 0.7 * i, DURATION)
    for time in np.arange(9.5, 14.5, 0.1):
        one_boat = np.vstack([POINTS[:, :, 0], np.ones(7), np.full(7, time)])
        now = sea.at(time)
        np.testing.assert_allclose(now.surface(one_boat, time),
                                   now.surface(POINTS, time)[:, :, 0], atol=1e-12)


def test_weights_add_up_to_one_whatever_came_between():
    random, sea, time = np.random.default_rng(3), OLD, START
    for _ in range(40):
        time += random.choice([0.0, 0.05, 0.6, 1.5, 3.0])
        new = [NEW, THIRD, FLAT, OLD, Sea(OLD.waves[:1]), Sea([[0.2, 3.0, 0.0, 0.4]])]
        sea = fade(sea, new[random.integers(6)], time, DURATION) or sea
        for now in time + np.arange(0.0, 2.2, 0.1):
            if isinstance(sea.at(now), Sea):
                continue
            # Waves and current of a sea fade by one weight: count each sea once, by its fades.
            weights = {tuple((fade.start, fade.comes) for fade in group.fades):
                       group.weight(now) for group in sea.groups}
            assert sum(weight for weight, _ in weights.values()) == pytest.approx(1.0)
            assert sum(change for _, change in weights.values()) == pytest.approx(0.0, abs=1e-12)


def test_a_new_sea_every_second_for_an_hour_makes_no_step_dearer():
    sea, most = FLAT, 0
    for second in range(3600):
        sea = fade(sea, Sea([[0.1, 3.0 + 0.001 * second, 0.0, 0.0]]), float(second), DURATION)
        most = max(most, len(sea.groups))
        assert np.isfinite(sea.fastest_water)
    assert most <= 4
    np.testing.assert_array_equal(sea.at(3601.0).elevation(X, Y, 3601.0).shape, X.shape)


def test_seas_of_one_instant_are_the_last_of_them():
    flood = OLD
    for i in range(1000):
        flood = fade(flood, Sea([[0.1, 3.0, 0.01 * i, 0.0]]), START, DURATION)
    flood = fade(flood, NEW, START, DURATION)
    alone = fade(OLD, NEW, START, DURATION)
    for time in (START, 10.6, 11.3, END):
        np.testing.assert_array_equal(everything(flood, time), everything(alone, time))


@pytest.mark.parametrize('period', [1.8, 3.0, 4.0])
def test_waves_that_are_given_again_a_little_higher_keep_their_pace(period):
    # As of somebody who estimates the sea and publishes it twice a second.
    sea, times = Sea([[0.2, period, 0.3, 0.0]]), np.arange(0.0, 20.0, 0.02)
    height = []
    for step, time in enumerate(times):
        if step % 25 == 0:
            sea = fade(sea, Sea([[0.2 + 0.0005 * time, period, 0.3, 0.0]]), time, DURATION)
        height.append(sea.elevation(0.0, 0.0, time))
    late = 0.2 + 0.0005 * times
    exact = late * np.cos(2 * np.pi * times / period)
    assert np.abs(height - exact).max() < 0.0005 * (DURATION + 0.5)


def test_waves_that_are_shifted_by_a_step_are_never_off_by_more_than_that_step():
    waves = Sea([[0.2, 1.8, 0.0, 0.0], [0.1, 4.0, 1.0, 2.0]])
    shifted = waves.starting_at(0.01)
    sea = fade(waves, shifted, START, DURATION)
    for time in np.arange(START, END, 0.01):
        off = np.abs(sea.elevation(X, Y, time) - shifted.elevation(X, Y, time)).max()
        assert off <= 0.01 * fastest_rise(waves)


def test_the_same_wave_has_the_period_the_direction_and_about_the_phase():
    old = Sea([[0.2, 3.0, 0.0, 0.0], [0.1, 2.0, 1.0, 0.5], [0.1, 2.0, 1.0, 3.0]])
    new = Sea([[0.1, 2.0, 1.0, 3.0 + 4 * math.pi], [0.3, 3.0, 0.0, 2.0], [0.1, 2.0, 1.0, 0.6],
               [0.1, 2.5, 1.0, 0.5]])
    kept, again = same_waves(old, new)
    assert kept.tolist() == [False, True, True]
    assert again.tolist() == [True, False, True, False]
    assert not same_waves(old, Sea(new.waves, depth=5.0))[0].any()


def test_seas_given_again_and_again_wait_their_turn():
    sea, taken = FLAT, 0
    for i in range(100):
        faded = fade(sea, Sea([[0.1, 3.0, 0.1 * i, 0.0]]), START + 0.001 * i, DURATION)
        if faded is not None:
            sea, taken = faded, taken + 1
    assert taken == MAX_FADING == sea.fading(START + 0.1)
    # Once the oldest are over there is room again.
    assert fade(sea, NEW, END + 0.1, DURATION) is not None


def test_shifting_the_clock_shifts_the_fade():
    sea = fade(OLD, NEW, START, DURATION)
    shifted = sea.starting_at(9.0)
    for time in (9.5, 10.0, 11.3, 12.0, 13.0):
        np.testing.assert_allclose(everything(shifted, time - 9.0), everything(sea, time),
                                   atol=1e-12)


CHOP = [0.06, 1.9, 0.0, 0.0, 0.03, 1.4, 0.7, 1.0]
OTHER = [0.10, 3.4, 2.0, 0.5, 0.06, 2.2, -1.0, 2.0]
SWELL = [0.4, 9.0, 0.3, 0.0, 0.2, 7.0, 0.0, 1.0]


def irregular(state, direction=0.0, seed=1):
    """Return the parameters of a sea state."""
    return {'sea.sea_state': state, 'sea.direction': direction, 'sea.seed': seed}


SETTLING, FADE, RATE = 400, 250, 50.0


def fleet(sea, state=None):
    """Return 150 of the default boat all over 300 m of water: as many moments of the waves."""
    scene = load_scene({})
    if state is None:
        places = np.random.default_rng(0).uniform(0.0, 300.0, (150, 2))
        state = State(np.column_stack([places, np.full(150, scene.start.position[2])]))
    return Simulation(scene.boat, sea, state, rate=RATE)


def heave_acceleration(boats, steps):
    """Return the largest of all boats and steps in m/s^2, upwards in the world."""
    speed = [boats.state.velocity[:, 2]]
    for _ in range(steps):
        boats.step()
        speed.append(boats.state.velocity[:, 2])
    return np.abs(np.diff(speed, axis=0)).max() * RATE


def in_the_fade_and_alone(old, new, then):
    """
    Return the largest heave acceleration in m/s^2 of boats while old gives way to new, and alone.

    First of the fade of two seconds and what comes after it; then, for the worse of both seas,
    of the start at rest, and of ``then`` more steps with boats that move with their waves.
    """
    started, settled = [], []
    for sea in (new, old):
        boats = fleet(sea)
        started.append(heave_acceleration(boats, SETTLING))
        state, time = boats.state, boats.time
        settled.append(heave_acceleration(boats, then))
    boats = fleet(old, state)
    boats.sea = fade(old.starting_at(time), new.starting_at(time), 0.0, DURATION)
    return heave_acceleration(boats, FADE), max(started), max(settled)


@pytest.mark.parametrize('old, new', [
    ({}, irregular(2)), (irregular(3), {}), (irregular(2), irregular(3)),
    (irregular(4), irregular(2)), (irregular(3, 1.0, 5), irregular(2, -1.0, 9))])
def test_heave_acceleration_in_a_fade_is_within_what_either_irregular_sea_alone_gives(old, new):
    # Not of every pair: see the long test, and doc/long_runs.md.
    old, new = load_scene(old).sea, load_scene(new).sea
    faded, _, settled = in_the_fade_and_alone(old, new, 5000)
    assert faded <= settled


@pytest.mark.long
def test_heave_acceleration_in_fades_between_any_irregular_seas():
    random, over = np.random.default_rng(11), []
    while len(over) < 20:
        given = [irregular(int(random.integers(1, 5)), float(random.choice([0.0, 1.0, 2.5, -1.0])),
                           int(random.integers(1, 50))) if random.integers(5) else {}
                 for _ in range(2)]
        if given[0] == given[1]:
            continue
        faded, _, settled = in_the_fade_and_alone(
            *(load_scene(one).sea for one in given), 5000)
        over.append(faded / settled)
    print(f'over either sea alone: median {np.median(over):.2f}, '
          f'{sum(one <= 1.0 for one in over)} of {len(over)} within, worst {max(over):.2f}')
    assert np.median(over) <= 1.0


@pytest.mark.parametrize('old, new', [
    ([], [0.2, 4.0, 0.5, 0.0]), ([0.2, 4.0, 0.5, 0.0], []), (CHOP, OTHER),
    ([0.15, 3.0, 0.0, 0.0], [0.2, 4.0, 0.5, 0.0]), ([], SWELL)])
def test_heave_acceleration_in_a_fade_of_regular_waves_is_far_below_that_of_a_start_in_them(
        old, new):
    # Settled in one wave a boat feels the same at every crest, and a fade of two seconds makes it
    # feel more. From rest to a wave's crest without more than its own acceleration takes at least
    # omega T = 2, so that for more than 6.3 s no surface at all could.
    faded, started, _ = in_the_fade_and_alone(Sea(old), Sea(new), 1)
    assert faded < 0.5 * started


@pytest.mark.parametrize('sea', [CHOP, OTHER, [0.3, 6.5, 0.0, 0.0]])
def test_no_step_of_the_surface_exceeds_what_the_waves_themselves_do(sea):
    # From flat water and back, up to a period of 3.3 times the duration.
    for old, new in ((Sea(sea), Sea()), (Sea(), Sea(sea))):
        assert largest_step(old, new) <= fastest_rise(Sea(sea)) * STEP


def test_the_longest_period_whose_steps_are_not_exceeded_is_3_3_times_the_duration():
    # A wave of weight w and pace p rises by at most a hypot(w p omega, w'); its own is a omega.
    part = np.linspace(0.0, 1.0, 100_001)[:-1]
    grown, slope = weight(part)
    least = np.max(slope / np.sqrt(1.0 - (grown * pace(1.0 - part)[0]) ** 2))
    assert least == pytest.approx(1.89, abs=0.005)
    assert 2.0 * math.pi / least == pytest.approx(3.3, abs=0.05)


@pytest.mark.parametrize('old, new', [
    (irregular(2), irregular(3)), (irregular(4), irregular(3)),
    (irregular(3, 1.0, 5), irregular(2, -1.0, 9))])
def test_no_step_between_irregular_seas_exceeds_what_either_does_alone(old, new):
    old, new = load_scene(old).sea, load_scene(new).sea
    x, y = np.random.default_rng(1).uniform(0.0, 300.0, (2, 200))

    def step(sea, times):
        height = [sea.elevation(x, y, time) for time in times]
        return np.abs(np.diff(height, axis=0)).max()

    alone = max(step(sea, np.arange(0.0, 60.0, STEP)) for sea in (old, new))
    assert step(fade(old, new, START, DURATION), np.arange(9.9, 12.1, STEP)) <= alone


@pytest.mark.parametrize('old, new', [(CHOP, OTHER), (OTHER, CHOP), (CHOP, CHOP[4:])])
def test_no_step_between_regular_waves_exceeds_what_both_together_do(old, new):
    old, new = Sea(old), Sea(new)
    assert largest_step(old, new) <= (fastest_rise(old) + fastest_rise(new)) * STEP


@pytest.mark.parametrize('old, new', [(SWELL, CHOP), ([], SWELL)])
def test_a_fade_adds_no_more_to_a_step_than_the_heights_over_its_duration(old, new):
    old, new = Sea(old), Sea(new)
    height = old.waves[:, 0].sum() + new.waves[:, 0].sum()
    bound = max(fastest_rise(old), fastest_rise(new)) + height * STEEPEST / DURATION
    assert largest_step(old, new) <= bound * STEP


@pytest.mark.parametrize('part, expected', [(0.001, 0.0), (0.5, 0.25), (0.999, 1.0)])
def test_waves_that_fade_in_start_from_a_standstill_and_end_at_their_pace(part, expected):
    sea, h = fade(FLAT, NEW, 0.0, DURATION), 1e-6

    def seen(part):
        return sea.at(part * DURATION).parts[-1].time

    assert (seen(part + h) - seen(part - h)) / (2 * h * DURATION) == pytest.approx(
        expected, abs=0.003)


def test_waves_go_on_as_they_are_when_only_the_current_changes():
    sea = fade(OLD, Sea(OLD.waves, current=(0.0, 1.0)), START, DURATION)
    for time in (10.5, 11.0, 11.9):
        np.testing.assert_allclose(sea.elevation(X, Y, time), OLD.elevation(X, Y, time),
                                   atol=1e-15)
    np.testing.assert_allclose(sea.at(11.0).current, [0.25, 0.5])


STEP = 0.01


def fastest_rise(sea):
    """Return the most that a surface can rise in m/s, all components together."""
    return float((sea.waves[:, 0] * sea.angular_frequency).sum())


def largest_step(old, new):
    """Return the largest change of elevation in m from one period to the next, over fades."""
    grid = np.linspace(-5.0, 5.0, 9)
    largest = 0.0
    for start in np.arange(20.0, 24.0, 0.37):
        sea = fade(old, new, start, DURATION)
        times = np.arange(start - STEP, start + DURATION + 2 * STEP, STEP)
        height = np.array([sea.elevation(grid, -grid, time) for time in times])
        largest = max(largest, np.abs(np.diff(height, axis=0)).max())
    return largest


def test_a_simulation_takes_a_sea_in_transition_wherever_it_takes_a_sea():
    scene = load_scene({'sea.waves': CHOP})
    simulation = scene.simulation()
    simulation.sea = fade(scene.sea, Sea(OTHER), 0.0, DURATION)
    for step in range(250):
        simulation.step()
        if step % 50 == 0:
            # Setting the state, the boat or a third sea looks at the one in force.
            simulation.state = simulation.state
            simulation.boat = scene.boat
            simulation.sea = fade(simulation.sea, Sea(CHOP), simulation.time, DURATION)
    assert np.isfinite(simulation.state.position).all()
    assert len(simulation.sea.at(simulation.time).waves) >= 2


def test_a_transition_ends_as_a_plain_sea():
    sea = fade(OLD, NEW, START, DURATION)
    assert isinstance(sea, SeaTransition) and sea.at(END) is NEW
    after = fade(sea, THIRD, END, DURATION)
    assert [group.sea.waves.tolist() for group in after.groups] == [NEW.waves.tolist(),
                                                                    THIRD.waves.tolist()]
