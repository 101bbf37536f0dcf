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

from boat_buoyancy.physics.boat.boat import Boat
from boat_buoyancy.physics.boat.hull import Hull
from boat_buoyancy.physics.boat.state import State
from boat_buoyancy.physics.rotation import to_roll_pitch_yaw
from boats import (
    crossings, DRAFT, HEAVE, last_state, MASS, reference_boat, simulate, STIFFNESS, turned,
    undamped)
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

pytestmark = pytest.mark.plain

GRAVITY = 9.81
SPEED = np.sqrt(2 * GRAVITY)  # after a fall of 1 m


def heave_of(states):
    return states.position[:, 2], states.velocity[:, 2]


def released(height):
    return State(position=(0.0, 0.0, height))


def roll_and_rate(states):
    roll, pitch, yaw = to_roll_pitch_yaw(states.orientation.T)
    assert abs(pitch).max() < 1e-9 and abs(yaw).max() < 1e-9
    return roll, states.angular_velocity[:, 0]


@pytest.mark.parametrize(('integrator', 'rate'), [
    ('rk4', 400), ('leapfrog', 2000), ('implicit', 2000)])
def test_heave_has_the_period_of_mass_on_springs(integrator, rate):
    time, states = simulate(reference_boat(), released(-DRAFT + 0.1), 4.5,
                            rate=rate, integrator=integrator)
    height, speed = heave_of(states)
    up = crossings(time, height + DRAFT, speed, rising=True)
    assert HEAVE == pytest.approx(4.42944692, abs=5e-9)
    # The angle by which one step turns a linear oscillation, and how much it is too small.
    h, u = 1.0 / rate, HEAVE / rate
    turn, late = {
        'rk4': (np.arctan2(u - u**3 / 6, 1 - u**2 / 2 + u**4 / 24), u**4 / 120),
        'leapfrog': (2 * np.arcsin(u / 2), u**2 / 24),
        'implicit': (np.arctan(u), u**2 / 3)}[integrator]
    assert 2 * np.pi / turn * h == pytest.approx(1.41850335, rel=1.01 * late + 4e-9)
    # Crossings are found on cubics; the speeds of implicit lag by up to one step.
    slack = u * h if integrator == 'implicit' else 1e-10
    assert np.diff(up) == pytest.approx(2 * np.pi / turn * h, abs=slack)


def test_undamped_heave_is_a_cosine():
    time, states = simulate(reference_boat(), released(-DRAFT + 0.1), 10.0,
                            rate=400, integrator='rk4')
    assert states.position[:, 2] == pytest.approx(-DRAFT + 0.1 * np.cos(HEAVE * time), abs=2e-9)


@pytest.mark.parametrize(('integrator', 'rate'), [('rk4', 200), ('leapfrog', 4000)])
def test_heave_with_a_fifth_of_critical_damping(integrator, rate):
    boat = reference_boat(damping=undamped(probe=1771.776))
    decay = 1771.776 / (2 * MASS)
    damped = np.sqrt(HEAVE**2 - decay**2)
    assert decay / HEAVE == pytest.approx(0.2, abs=1e-6)
    # The first maximum after the release is one damped period later.
    time, states = simulate(boat, released(-DRAFT + 0.1), 1.6, rate=rate, integrator=integrator)
    height, speed = heave_of(states)
    acceleration = -HEAVE**2 * (height + DRAFT) - 2 * decay * speed
    late = time > 1.0
    at_top = crossings(time[late], speed[late], acceleration[late], rising=False)[0]
    exact = 2 * np.pi / damped
    assert exact == pytest.approx(1.44775383, abs=5e-9)
    assert at_top == pytest.approx(exact, abs=1e-6)
    peak = height[late].max() + DRAFT
    assert np.exp(-decay * exact) == pytest.approx(0.27732983, abs=5e-9)
    assert peak / 0.1 == pytest.approx(0.27732983, abs=1e-4)
    # The whole course, not only its peak.
    course = np.exp(-decay * time) * (
        np.cos(damped * time) + decay / damped * np.sin(damped * time))
    assert height + DRAFT == pytest.approx(0.1 * course, abs=1e-7)


@pytest.mark.parametrize(('integrator', 'rate'), [('rk4', 4000), ('leapfrog', 4000)])
def test_drop_from_one_metre(integrator, rate):
    # Free fall, then half a swing about the draft that begins at the surface at full speed.
    entry = np.sqrt(2 / GRAVITY)
    amplitude = np.hypot(DRAFT, SPEED / HEAVE)
    wet = (np.pi + 2 * np.arctan2(DRAFT, SPEED / HEAVE)) / HEAVE
    assert entry == pytest.approx(0.45152364, abs=5e-9)
    assert DRAFT + amplitude == pytest.approx(1.61803399, abs=5e-9)
    assert 2 * entry + wet == pytest.approx(1.82164682, abs=5e-9)

    time, states = simulate(reference_boat(), released(1.0), 1.9, rate=rate, integrator=integrator)
    height, speed = heave_of(states)
    depth = -height
    assert crossings(time, depth, -speed, rising=True)[0] == pytest.approx(entry, abs=1e-7)
    assert depth.max() == pytest.approx(DRAFT + amplitude, abs=1e-6)
    assert depth[rate] == pytest.approx(1.53194025, abs=1e-6)
    top = crossings(time[rate:], speed[rate:], np.full(len(speed) - rate, -GRAVITY),
                    rising=False)[0]
    assert top == pytest.approx(2 * entry + wet, abs=1e-6)


@pytest.mark.parametrize(('integrator', 'rate'), [('rk4', 4000), ('leapfrog', 4000)])
def test_drop_from_three_metres_through_the_cap(integrator, rate):
    boat = reference_boat(floatiness=3.0)
    entry, full = np.sqrt(6 / GRAVITY), 1.5
    fast = np.sqrt(6 * GRAVITY)
    # On the spring: depth = DRAFT - DRAFT cos + fast / HEAVE sin, solved for the cap.
    to_cap = brentq(lambda t: DRAFT * (1 - np.cos(HEAVE * t)) + fast / HEAVE * np.sin(HEAVE * t)
                    - full, 0.0, 0.4, xtol=1e-14)
    at_cap = np.sqrt(fast**2 + 2 * GRAVITY * full - STIFFNESS / MASS * full**2)
    capped = 2 * at_cap / (2 * GRAVITY)
    assert entry == pytest.approx(0.78206189, abs=5e-9)
    assert to_cap == pytest.approx(0.19619549, abs=5e-9)
    assert capped == pytest.approx(0.67728546, abs=5e-9)
    assert full + at_cap**2 / (4 * GRAVITY) == pytest.approx(2.625, abs=1e-12)
    cycle = 2 * entry + 2 * to_cap + capped
    assert cycle == pytest.approx(2.63380021, abs=5e-9)

    time, states = simulate(boat, released(3.0), 2.7, rate=rate, integrator=integrator)
    height, speed = heave_of(states)
    depth = -height
    assert crossings(time, depth, -speed, rising=True)[0] == pytest.approx(entry, abs=1e-7)
    into = crossings(time, depth - full, -speed, rising=True)[0]
    out = crossings(time, depth - full, -speed, rising=False)[0]
    assert into == pytest.approx(entry + to_cap, abs=1e-6)
    assert out - into == pytest.approx(capped, abs=1e-6)
    under = (time > into + 1e-3) & (time < out - 1e-3)
    assert np.diff(speed[under]) * rate == pytest.approx(19.62, abs=1e-6)
    assert depth.max() == pytest.approx(2.625, abs=1e-6)
    late = time > 2.0
    top = crossings(time[late], speed[late], np.full(late.sum(), -GRAVITY), rising=False)[0]
    assert top == pytest.approx(cycle, abs=1e-6)


def test_soft_spring_swings_as_deep_as_its_work_allows():
    boat = reference_boat(law='soft', floatiness=3.0)
    height = 1.5

    def work(depth):
        return quad(lambda d: 3.0 * MASS * GRAVITY * (1 - np.exp(-d / height)), 0.0, depth)[0]

    deepest = brentq(lambda depth: work(depth) - MASS * GRAVITY * (1.0 + depth), 0.5, 10.0)
    _, states = simulate(boat, released(1.0), 3.0, rate=2000, integrator='rk4')
    assert -states.position[:, 2].min() == pytest.approx(deepest, abs=1e-6)


def dragged(probe=0.0):
    return undamped(linear_retention=[np.exp(-0.5)], air_linear_retention=[np.exp(-0.5)],
                    probe=probe)


TERMINAL_SPEEDS = [(1e-12, 0.0, -1.0, -19.62), (3.0, 0.0, -5000.0, 39.24),
                   (3.0, 1000.0, -5000.0, 13.08)]


@pytest.mark.parametrize(('floatiness', 'probe', 'start', 'speed'), TERMINAL_SPEEDS)
def test_terminal_speed(floatiness, probe, start, speed):
    boat = reference_boat(floatiness=floatiness, damping=dragged(probe))
    for integrator in ('leapfrog', 'implicit', 'rk4', 'euler'):
        state = last_state(boat, released(start), 60.0, rate=20, integrator=integrator)
        assert state.position[2] < -2.0
        assert state.velocity == pytest.approx((0.0, 0.0, speed), abs=1e-9), integrator


@pytest.mark.parametrize(('floatiness', 'probe', 'start', 'speed'), TERMINAL_SPEEDS)
def test_plain_game_loop_is_slower_by_its_last_line(floatiness, probe, start, speed):
    # v = (v + (a - c v) h) (1 - d h), solved for v: d h too slow without other drag.
    h, d, c = 0.05, 0.5, probe / MASS
    push = speed * (d + c)
    slower = push * (1 - d * h) / (d + c * (1 - d * h))
    boat = reference_boat(floatiness=floatiness, damping=dragged(probe))
    state = last_state(boat, released(start), 60.0, rate=20, integrator='symplectic_euler')
    assert state.velocity == pytest.approx((0.0, 0.0, slower), abs=1e-9)


def test_terminal_speed_of_a_fall_through_air():
    boat = reference_boat(damping=dragged())
    state = last_state(boat, released(5000.0), 60.0, rate=20)
    assert state.velocity[2] == pytest.approx(-19.62, abs=1e-9)


def rolling_boat(height):
    offsets = np.array([[1.0, 3**-0.5, height], [1.0, -3**-0.5, height],
                        [-1.0, 3**-0.5, height], [-1.0, -3**-0.5, height]])
    return reference_boat(positions=offsets, inertia=(500.0, 700.0, 900.0))


@pytest.mark.parametrize(('integrator', 'rate'), [('rk4', 100), ('leapfrog', 2000)])
def test_roll_has_the_period_of_its_stiffness(integrator, rate):
    stiffness = STIFFNESS / 3 - MASS * GRAVITY * 0.3
    assert stiffness == pytest.approx(3597.0, abs=1e-9)
    assert 2 * np.pi * np.sqrt(500.0 / stiffness) == pytest.approx(2.34258119, abs=5e-9)
    # Small, as the period grows with the square of the amplitude.
    start = State((0.0, 0.0, 0.3 - DRAFT), turned(roll=1e-4))
    time, states = simulate(rolling_boat(-0.3), start, 5.5, rate=rate, integrator=integrator)
    roll, spin = roll_and_rate(states)
    periods = np.diff(crossings(time, roll, spin, rising=True))
    assert periods == pytest.approx(2.34258119, abs=1e-6)


def test_pitch_has_the_period_of_its_stiffness():
    start = State((0.0, 0.0, -DRAFT), turned(pitch=1e-4))
    time, states = simulate(reference_boat(), start, 4.0, rate=200, integrator='rk4')
    pitch = to_roll_pitch_yaw(states.orientation.T)[1]
    period = 2 * np.pi * np.sqrt(700.0 / STIFFNESS)
    assert np.diff(crossings(time, pitch, states.angular_velocity[:, 1], rising=True)) == (
        pytest.approx(period, abs=1e-6))


def test_wam_v_runs_at_its_published_speed():
    # Drag as tabulated for the RobotX WAM-V: 100 u + 150 u^2 = 500 N ahead.
    mass = 180.0
    damping = undamped(linear=[100.0, 100.0, 500.0, 300.0, 900.0, 800.0],
                       quadratic=[150.0, 100.0, 0.0, 600.0, 900.0, 800.0])
    places = [(0.6, 1.03, -0.1), (0.6, -1.03, -0.1), (-1.4, 1.03, -0.1), (-1.4, -1.03, -0.1)]
    budget = 1.5 * mass * GRAVITY
    # The centre of mass is not midway: weights that float it level.
    shares = np.array([1.4, 1.4, 0.6, 0.6]) / 4.0
    boat = Boat(mass, Hull(places, budget * shares, np.full(4, 0.4)), (120.0, 393.0, 446.0),
                damping)
    state = last_state(boat, released(-0.1), 60.0, thrust=(500.0, 0, 0, 0, 0, 0), rate=50)
    exact = (-100 + np.sqrt(100**2 + 4 * 150 * 500)) / 300
    assert exact == pytest.approx(1.5226, abs=5e-5)
    assert state.velocity == pytest.approx((exact, 0.0, 0.0), abs=1e-9)
