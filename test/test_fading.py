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

"""A sea that turns into another while a boat lies in it."""

import math

from boat_buoyancy.physics import Fleet, load_scene, Sea, State
from boat_buoyancy.physics.boat.records import readable
from boat_buoyancy.physics.compiled import machine_code, numba
from boat_buoyancy.physics.sea.fading import current, fade, FadingSea, ramp, smooth, STEEPEST
from boat_buoyancy.physics.sea.waves import KX, PHASE, surface
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from textbook import water

FLAT = Sea()
OLD = Sea([[0.2, 3.0, 0.0, 0.0], [0.1, 2.0, 1.0, 0.5]], current=(0.5, 0.0))
NEW = Sea([[0.3, 2.5, 2.0, 1.0]], current=(0.0, -0.4))
SHALLOW = Sea([[0.1, 4.0, -1.0, 2.0], [0.2, 3.0, 0.0, 0.0]], depth=5.0)
START, DURATION, END = 10.0, 4.0, 14.0
X, Y = np.linspace(-5.0, 5.0, 7), np.linspace(3.0, -4.0, 7)
# Of heights below a metre: a hundred times their round-off.
ROUND_OFF = 1e-14


def everything(sea, time):
    """Return elevation and velocity, current included, at seven places, in one array."""
    return np.column_stack([sea.elevation(X, Y, time), sea.velocity(X, Y, time)])


def mixed(*parts):
    """Return what `everything` does of seas (sea, weight, change of weight in 1/s) together."""
    def of(sea, weight, change, time):
        return np.array([[weight * height, *(weight * velocity + [0.0, 0.0, change * height])]
                         for height, velocity in (water(sea, x, y, time) for x, y in zip(X, Y))])

    return lambda time: sum(of(*part, time) for part in parts)


def weights(time, start=START):
    """Return the weight of a sea that comes and its change in 1/s, by a polynomial of NumPy."""
    rise = np.polynomial.Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])
    part = min(max((time - start) / DURATION, 0.0), 1.0)
    return rise(part), rise.deriv()(part) / DURATION


def test_the_ramp_leaves_and_arrives_without_slope_or_bend_and_is_never_steeper_than_is_said():
    rise = np.polynomial.Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])
    part = np.linspace(0.0, 1.0, 101)
    weight, slope = smooth(part)
    np.testing.assert_allclose(weight, rise(part), atol=ROUND_OFF)
    np.testing.assert_allclose(slope, rise.deriv()(part), atol=ROUND_OFF)
    for end, height in ((0.0, 0.0), (1.0, 1.0)):
        assert smooth(end) == (height, 0.0)
        assert rise.deriv(2)(end) == pytest.approx(0.0, abs=ROUND_OFF)
    # The slope is steepest in the middle, where it bends neither way.
    assert slope.max() == slope[50] == STEEPEST and (slope >= 0.0).all()


def test_the_old_sea_until_the_start_and_the_new_from_the_end_on():
    sea = fade(OLD, NEW, START, DURATION)
    for time in (0.0, 9.9, START):
        np.testing.assert_allclose(everything(sea, time), everything(OLD, time), atol=ROUND_OFF)
        assert not sea.settled(time)
    for time in (END, 14.1, 1000.0):
        np.testing.assert_allclose(everything(sea, time), everything(NEW, time), atol=ROUND_OFF)
        assert sea.settled(time)


@pytest.mark.parametrize('old, new', [(OLD, NEW), (FLAT, NEW), (OLD, FLAT), (OLD, SHALLOW)])
def test_in_between_the_water_is_that_of_both_by_weight_and_rises_with_the_change(old, new):
    sea = fade(old, new, START, DURATION)
    for time in np.linspace(START, END, 9):
        s, rate = weights(time)
        expected = mixed((old, 1.0 - s, -rate), (new, s, rate))(time)
        np.testing.assert_allclose(everything(sea, time), expected, atol=1e-12)


def test_a_third_sea_in_the_middle_starts_from_what_is_there():
    middle = 11.3
    first = fade(OLD, NEW, START, DURATION)
    both = fade(first, SHALLOW, middle, DURATION)
    # No jump, and from there on what is there fades out as it is.
    np.testing.assert_allclose(both.elevation(X, Y, middle), first.elevation(X, Y, middle),
                               atol=ROUND_OFF)
    there, _ = weights(middle)
    for time in np.linspace(middle, middle + DURATION, 9):
        s, rate = weights(time, middle)
        expected = mixed((OLD, (1.0 - s) * (1.0 - there), -rate * (1.0 - there)),
                         (NEW, (1.0 - s) * there, -rate * there), (SHALLOW, s, rate))(time)
        np.testing.assert_allclose(everything(both, time), expected, atol=1e-12)


def random_sea(random, current):
    """
    Return a sea of up to four waves, some of them those of other such seas, or flat water.

    ``current`` (2,) m/s, None = any that the shortest of them, of 1 s, can run against.
    """
    if current is None:
        current = random.uniform(-0.27, 0.27, 2) * random.integers(2)
    rows = [[random.uniform(0.0, 0.5), *random.choice([[3.0, 0.0, 0.0], [2.0, 1.0, 0.5],
                                                       random.uniform(1.0, 6.0, 3)])]
            for _ in range(random.integers(5))]
    return Sea(rows, current, random.choice([0.0, 2.0]))


def random_fades(random, count, current=None):
    """Yield fades (from, to, when, over how long) of seas that follow each other at random."""
    sea, time = random_sea(random, current), 0.0
    for _ in range(count):
        time += random.choice([0.0, 0.05, 1.3, 3.0, 9.0])
        duration = random.choice([0.5, 2.0, 4.0])
        faded = fade(sea, random_sea(random, current), time, duration)
        if faded is not None:
            yield sea, faded, time, duration
            sea = faded


def test_the_surface_never_jumps_and_the_water_rises_as_fast_as_it_does():
    # As who drifts with the current sees it.
    random, h, (u, v) = np.random.default_rng(2), 1e-4, (0.2, -0.25)
    for before, sea, start, duration in random_fades(random, 100, (u, v)):
        assert sea.elevation(X, Y, start) == pytest.approx(before.elevation(X, Y, start),
                                                           abs=ROUND_OFF)
        for time in start + duration * np.array([-0.1, 0.0, 0.2, 0.5, 0.9, 1.0, 1.1]):
            rise = (sea.elevation(X + u * h, Y + v * h, time + h)
                    - sea.elevation(X - u * h, Y - v * h, time - h)) / (2 * h)
            # Heights of at most 4 m in three seas, h^2 / 6 times their third derivative; that of
            # the ramp is 60 / duration^3, of the waves up to (2 pi)^3.
            error = h * h / 6.0 * 4.0 * (2 * math.pi + 60.0 ** (1 / 3) / duration) ** 3
            assert np.abs(sea.velocity(X, Y, time)[:, 2] - rise).max() < error


def test_the_bound_of_the_water_speed_holds_throughout():
    random = np.random.default_rng(3)
    for _, sea, start, duration in random_fades(random, 100):
        x, y = random.uniform(-50.0, 50.0, (2, 400))
        times = start + duration * random.uniform(-0.2, 1.2, 400)
        fastest = np.linalg.norm(sea.velocity(x, y, times), axis=1).max()
        assert fastest <= sea.fastest_water * (1.0 + ROUND_OFF)


def test_of_a_slow_fade_the_bound_is_not_above_that_of_both_seas_together():
    sea = fade(OLD, NEW, START, 1e6)
    both = OLD.fastest_water + NEW.fastest_water
    assert max(OLD.fastest_water, NEW.fastest_water) <= sea.fastest_water <= both * 1.00001


def test_a_wave_of_both_seas_only_changes_its_amplitude():
    high = Sea(OLD.waves * [2.5, 1.0, 1.0, 1.0], OLD.current)
    sea = fade(OLD, high, START, DURATION)
    assert sea.table.shape == OLD.table.shape
    for time in np.linspace(START - 1.0, END + 1.0, 9):
        s, _ = weights(time)
        assert sea.elevation(X, Y, time) == pytest.approx(
            (1.0 + 1.5 * s) * OLD.elevation(X, Y, time), abs=ROUND_OFF)


def test_given_again_a_little_higher_twice_a_second_it_keeps_phase_and_pace():
    # As of somebody who estimates the sea and publishes what is seen.
    sea, waiting = Sea([[0.2, 3.0, 0.3, 0.0]]), None
    for step, time in enumerate(np.arange(0.0, 30.0, 0.05)):
        if step % 10 == 0:
            waiting = Sea([[0.2 + 0.0005 * time, 3.0, 0.3, 0.0]])
        faded = waiting and fade(sea, waiting, time, DURATION)
        if faded:
            sea, waiting = faded, None
        # At most a fade behind and one that waits for its turn.
        exact = (0.2 + 0.0005 * time) * np.cos(2 * np.pi * time / 3.0)
        assert abs(sea.elevation(0.0, 0.0, time) - exact) <= 0.0005 * (2 * DURATION + 0.5)


def test_a_wave_of_another_depth_or_phase_is_another_wave():
    for other in (Sea(OLD.waves, depth=2.0), Sea(OLD.waves + [0.0, 0.0, 0.0, 0.1])):
        assert fade(OLD, other, START, DURATION).table.shape == (10, 4)


def test_waves_go_on_as_they_are_when_only_the_current_across_them_changes():
    rows = [[0.2, 3.0, 0.0, 0.0], [0.1, 2.0, 0.0, 0.5]]
    old = Sea(rows, current=(0.0, -0.5))
    sea = fade(old, Sea(rows, current=(0.0, 1.0)), START, DURATION)
    for time in (10.5, 12.0, 13.9):
        s, _ = weights(time)
        np.testing.assert_array_equal(sea.elevation(X, Y, time), old.elevation(X, Y, time))
        np.testing.assert_allclose(sea.current_at(time), [0.0, 1.5 * s - 0.5], atol=ROUND_OFF)


def test_each_wave_keeps_the_length_that_it_has_on_the_current_of_its_own_sea():
    row, change = [[0.2, 3.0, 0.0, 0.0]], ((0.0, 0.0), (1.0, 0.0))
    sea = fade(*(Sea(row, current) for current in change), START, DURATION)
    lengths = 2 * np.pi / sea.table[KX]
    # T = 3 s: w^2 = g k, and (w - k)^2 = g k on 1 m/s along the wave.
    np.testing.assert_allclose(lengths, [14.0518, 19.5924], rtol=1e-5)
    # Both pass a fixed point in their 3 s, all the time.
    later = sea.starting_at(3.0)
    np.testing.assert_allclose(np.cos(later.table[PHASE]), np.cos(sea.table[PHASE]), atol=1e-14)


def test_no_duration_is_at_once():
    assert fade(OLD, NEW, START, 0.0) is NEW
    assert fade(fade(OLD, FLAT, START, DURATION), NEW, 11.0, 0.0) is NEW


def test_a_fade_that_is_over_is_its_new_sea():
    after = fade(fade(OLD, NEW, START, DURATION), SHALLOW, END, DURATION)
    assert after.table.shape[1] == len(NEW.waves) + len(SHALLOW.waves) and not after.layered
    np.testing.assert_allclose(everything(after, END), everything(NEW, END), atol=ROUND_OFF)


def test_seas_of_one_instant_are_the_last_of_them():
    flood = OLD
    for i in range(50):
        flood = fade(flood, Sea([[0.1, 3.0, 0.01 * i, 0.0]], [i, 0.0]), START, DURATION)
    flood = fade(flood, NEW, START, DURATION)
    alone = fade(OLD, NEW, START, DURATION)
    assert flood.table.shape == alone.table.shape and not flood.layered
    for time in (START, 10.6, 11.3, END):
        np.testing.assert_allclose(everything(flood, time), everything(alone, time),
                                   atol=ROUND_OFF)


def test_a_fourth_sea_waits_until_the_third_is_there():
    third = fade(fade(OLD, NEW, START, DURATION), SHALLOW, 12.0, DURATION)
    for time in (12.1, 14.0, 15.999):
        assert fade(third, FLAT, time, DURATION) is None
    last = fade(third, FLAT, 16.0, DURATION)
    np.testing.assert_allclose(everything(last, 16.0), everything(SHALLOW, 16.0),
                               atol=ROUND_OFF)


@pytest.mark.parametrize('interval', [0.01, 0.5, 3.0, 4.5])
def test_however_fast_seas_arrive_no_step_is_dearer_than_three_and_the_newest_wins(interval):
    rows, sea, waiting = 5, FLAT, None
    for i in range(300):
        time = interval * i
        waiting = Sea([[0.1, 3.0 + 0.01 * j, 0.001 * i, 0.0] for j in range(rows)])
        faded = fade(sea, waiting, time, DURATION)
        if faded is not None:
            sea, waiting = faded, None
        assert sea.table.shape[1] <= 3 * rows
    newest = sea.new if waiting is None else waiting
    if waiting is not None:
        time = sea.start + sea.duration
        sea = fade(sea, waiting, time, DURATION)
    assert (newest.waves[:, 2] == 0.001 * 299).all()
    np.testing.assert_allclose(everything(sea, time + DURATION),
                               everything(newest, time + DURATION), atol=1e-13)


def test_asked_for_many_places_and_times_at_once_a_sea_answers_as_one_by_one():
    sea = fade(OLD, SHALLOW, START, DURATION)
    times = np.linspace(START - 1.0, END + 1.0, 5)[:, None]
    for name in ('elevation', 'slope', 'velocity'):
        of = getattr(sea, name)
        one_by_one = [[of(x, y, time) for x, y in zip(X, Y)] for time in times[:, 0]]
        np.testing.assert_allclose(of(X, Y, times), one_by_one, atol=ROUND_OFF)


def test_shifting_the_clock_shifts_the_fade():
    sea = fade(fade(OLD, NEW, START, DURATION), SHALLOW, 11.3, DURATION)
    shifted = sea.starting_at(9.0)
    assert shifted.layered
    for time in (11.4, 12.0, 13.3, 15.3, 16.0):
        np.testing.assert_allclose(everything(shifted, time - 9.0), everything(sea, time),
                                   atol=1e-13)
        assert shifted.settled(time - 9.0) == sea.settled(time)


@pytest.mark.parametrize('twin', [lambda function: function, machine_code],
                         ids=['plain', 'compiled'])
def test_the_step_sees_the_water_that_a_sea_says(twin):
    random = np.random.default_rng(5)
    seas = [OLD, SHALLOW, FLAT, *(sea for _, sea, *_ in random_fades(random, 20))]
    for sea in seas:
        record = readable(sea.record)
        for x, y, t in random.uniform([-20.0, -20.0, 0.0], [20.0, 20.0, 60.0], (20, 3)):
            weight, rate = ramp(record, t)
            height, velocity = twin(surface)(sea.table, record.waves, x, y, t, weight,
                                             rate)
            # Angles of some hundred rad to round-off, times the heights and speeds of waves.
            assert height == pytest.approx(sea.elevation(x, y, t), abs=1e-12)
            assert np.add(velocity, current(record, weight)) == pytest.approx(
                sea.velocity(x, y, t), abs=1e-11)


def test_a_boat_floats_on_the_fading_sea_that_is_there():
    scene = load_scene({'sea.waves': OLD.waves, 'boat.mass': 1500.0, 'sea.current': [0.5, 0.0]})
    simulation = scene.simulation()
    simulation.sea = sea = fade(scene.sea, NEW, 0.5, 1.0)
    run = simulation.run(2.0)
    assert isinstance(simulation.sea, FadingSea)
    np.testing.assert_allclose(run.elevation, [
        sea.elevation(x, y, t) for (x, y, _), t in zip(run.position, run.time)], atol=1e-12)
    # Level enough for the mean depth of the probes to be that of the middle.
    assert np.abs(run.roll_pitch_yaw[:, :2]).max() < 0.3
    bottoms = run.elevation - run.position[:, 2] - scene.boat.hull.positions[0, 2]
    assert np.corrcoef(run.probe_depths.mean(axis=1), bottoms)[0, 1] > 0.9


# What a boat feels: the greatest heave acceleration of many, over that of the new sea alone.

RATE, SETTLED, ALONE = 25.0, 10.0, 50.0
SEEDS, BOATS = 4, 50
WAVE = Sea([[0.2, 4.0, 0.5, 0.0]])


def irregular(state, seed):
    return load_scene({'sea.sea_state': state, 'sea.seed': seed}).sea


@pytest.fixture(scope='module')
def ratios():
    """Return {change of sea: (SEEDS,)} greatest heave accelerations over the new sea's own."""
    if numba() is None:
        pytest.skip('half a minute of a thousand boats wants the compiled step')
    new = {'flat to state 2': [irregular(2, seed) for seed in range(SEEDS)],
           'state 2 to state 3': [irregular(3, seed) for seed in range(SEEDS)],
           'flat to a wave': [WAVE] * SEEDS}
    old = {'state 2 to state 3': [irregular(2, seed + SEEDS) for seed in range(SEEDS)]}
    groups = [(name, fading) for name in new for fading in (True, False)]
    seas = [fade(old.get(name, [FLAT] * SEEDS)[seed], sea, SETTLED, DURATION) if fading else sea
            for name, fading in groups for seed, sea in enumerate(new[name])]
    scene = load_scene({})
    # All over 300 m of water: as many moments of the waves.
    places = np.random.default_rng(0).uniform(0.0, 300.0, (len(seas) * BOATS, 2))
    fleet = Fleet([scene.boat] * len(places), [sea for sea in seas for _ in range(BOATS)],
                  State(np.insert(places, 2, scene.start.position[2], axis=1)), rate=RATE)
    speed = [fleet.state.velocity[:, 2]]
    for _ in range(round(ALONE * RATE)):
        fleet.step()
        speed.append(fleet.state.velocity[:, 2])
    assert not fleet.failed.any()
    acceleration = np.abs(np.diff(speed, axis=0))[round(SETTLED * RATE):] * RATE
    peaks = acceleration.reshape(-1, len(new), 2, SEEDS, BOATS)
    # During the fade and as long again, against all the time that boats in the new sea alone had.
    faded = peaks[:round(2 * DURATION * RATE), :, 0].max(axis=(0, -1))
    return dict(zip(new, faded / peaks[:, :, 1].max(axis=(0, -1))))


@pytest.mark.parametrize('change, period', [('flat to state 2', 2.1), ('state 2 to state 3', 3.6)])
def test_an_irregular_sea_shakes_a_boat_no_more_as_it_comes_than_alone(ratios, change, period):
    def scatter(seconds):
        """Return the relative standard deviation of the greatest of so many peaks (Gumbel)."""
        return math.pi / math.sqrt(6.0) / (2.0 * math.log(BOATS * seconds / period))

    # Of a Gaussian process, whose mean zero-crossing period is given.
    error = math.hypot(scatter(2 * DURATION), scatter(ALONE - SETTLED)) / math.sqrt(SEEDS)
    assert ratios[change].mean() <= 1.0 + 2.0 * error


def test_a_fade_to_one_wave_shakes_a_boat_as_an_oscillator_by_linear_theory(ratios):
    """In one wave a boat feels the same at every crest, and more while the wave comes up."""
    (_, period, direction, _), = WAVE.waves
    omega = 2 * math.pi / period
    k = omega ** 2 / 9.81
    # The default boat: 2000 kg on 4 x 2 m, its columns at the Gauss points, 0.3 of critical.
    mass, stiffness = 2000.0, 1025.0 * 9.81 * 4.0 * 2.0
    drag = 0.3 * 2.0 * math.sqrt(stiffness * mass) - mass * math.log(0.95)
    share = (math.cos(k * math.cos(direction) * 4.0 / math.sqrt(12.0))
             * math.cos(k * math.sin(direction) * 2.0 / math.sqrt(12.0)))

    def acceleration(time, height, speed):
        weight, rate = weights(time, 0.0)
        turning = share * np.exp(-1j * omega * time)
        rise = (rate - 1j * omega * weight) * turning
        return (stiffness * (weight * turning - height) + drag * (rise - speed)) / mass

    answer = solve_ivp(lambda t, values: [values[1], acceleration(t, *values)],
                       (0.0, 2 * DURATION), [0j, 0j], max_step=0.05, rtol=1e-8, atol=1e-10)
    amplitudes = np.abs([acceleration(t, *values) for t, values in zip(answer.t, answer.y.T)])
    # Linear theory is right to the first order of the slope, 0.05.
    assert ratios['flat to a wave'] == pytest.approx(amplitudes.max() / amplitudes[-1],
                                                     rel=k * WAVE.waves[0, 0])
