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
from boat_buoyancy.physics.transition import fade, MAX_FADING, SeaTransition, STEEPEST
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
    """Return elevation, velocity and what the step is given, in one array."""
    now = sea.at(time)
    return np.concatenate([now.elevation(X, Y, time).ravel(), now.velocity(X, Y, time).ravel(),
                           now.surface(POINTS, time).ravel(), now.current])


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


def heave_acceleration(simulation, steps):
    """Return (steps - 1,) m/s^2, upwards in the world."""
    speed = []
    for _ in range(steps):
        simulation.step()
        speed.append(simulation.state.velocity[2])
    return np.diff(speed) * simulation.rate


@pytest.mark.parametrize('old, new', [
    ({'sea.waves': CHOP}, {'sea.waves': OTHER}),
    ({'sea.sea_state': 3}, {'sea.sea_state': 0}),
    ({'sea.sea_state': 2}, {'sea.sea_state': 2, 'sea.direction': 2.0, 'sea.seed': 5})])
def test_heave_acceleration_in_the_fade_is_about_what_either_sea_alone_gives(old, new):
    old, new = load_scene(old), load_scene(new)
    # Alone and settled, without the start from rest. Two seconds are less than a wave's period,
    # so that the worst moment to change shows a little.
    alone = max(np.abs(heave_acceleration(scene.simulation(), 4000)[1000:]).max()
                for scene in (old, new))
    peaks = [np.abs(heave_acceleration(faded(simulation, old, new), 300)).max()
             for simulation in moments(old)]
    assert np.median(peaks) <= alone
    assert max(peaks) <= 1.5 * alone


@pytest.mark.parametrize('new', [{'sea.waves': [0.2, 3.0, 0.0, 0.0]}, {'sea.sea_state': 3}])
def test_a_fade_from_flat_water_shakes_less_than_a_start_in_the_waves(new):
    old, new = load_scene({}), load_scene(new)
    gently, at_once = [], []
    for simulation in moments(old):
        gently.append(np.abs(heave_acceleration(faded(simulation, old, new), 300)).max())
        suddenly = new.simulation(state=simulation.state)
        suddenly.sea = new.sea.starting_at(simulation.time)
        at_once.append(np.abs(heave_acceleration(suddenly, 100)).max())
    settled = np.abs(heave_acceleration(new.simulation(), 4000)[1000:]).max()
    assert max(gently) <= 1.75 * settled
    assert max(gently) < 0.5 * max(at_once)


def moments(scene):
    """Yield a simulation at ten moments from 10 s on."""
    simulation = scene.simulation()
    for step in range(1, 1231):
        simulation.step()
        if step > 1000 and step % 23 == 0:
            yield simulation


def faded(simulation, old, new):
    """Return a copy of a simulation, at time 0 of a fade of two seconds."""
    copy = old.simulation(state=simulation.state)
    copy.sea = fade(simulation.sea.starting_at(simulation.time),
                    new.sea.starting_at(simulation.time), 0.0, DURATION)
    return copy


@pytest.mark.parametrize('sea', [CHOP, OTHER, [0.3, 5.5, 0.0, 0.0]])
def test_no_step_of_the_surface_exceeds_what_the_waves_themselves_do(sea):
    # From flat water and back: sqrt(w'^2 + w^2 omega^2) <= omega up to 2.8 times the duration.
    for old, new in ((Sea(sea), Sea()), (Sea(), Sea(sea))):
        assert largest_step(old, new) <= fastest_rise(Sea(sea)) * STEP


@pytest.mark.parametrize('old, new', [(CHOP, OTHER), (OTHER, CHOP), (SWELL, CHOP), ([], SWELL)])
def test_a_fade_adds_no_more_to_a_step_than_the_heights_over_its_duration(old, new):
    old, new = Sea(old), Sea(new)
    height = old.waves[:, 0].sum() + new.waves[:, 0].sum()
    bound = max(fastest_rise(old), fastest_rise(new)) + height * STEEPEST / DURATION
    assert largest_step(old, new) <= bound * STEP


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
    assert isinstance(fade(sea, THIRD, END, DURATION).old, Sea)
