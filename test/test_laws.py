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

from itertools import product

from boat_buoyancy.physics.boat.boat import Boat, Damping
from boat_buoyancy.physics.boat.hull import Hull, probe_hull
from boat_buoyancy.physics.boat.state import State
from boat_buoyancy.physics.sea.waves import Sea
from boat_buoyancy.physics.stepping.simulation import Simulation
from boats import (
    asymmetric_boat, INTEGRATORS, last_state, LAWS, MASS, reference_boat, SQUARE, turned,
    undamped, wind_sea)
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from textbook import solve, wrench

pytestmark = pytest.mark.plain

GRAVITY = 9.81
WEIGHT = MASS * GRAVITY


def acceleration(boat, state, *, sea=None, thrust=None):
    """
    Return the acceleration in world axes and the angular acceleration in body axes.

    As `Simulation` does it: the change of velocity over one plain Euler step, which is the
    acceleration at the start times the step.
    """
    rate = 1024.0
    simulation = Simulation(boat, sea or Sea(), state, rate=rate, integrator='euler')
    simulation.step(thrust)
    after = simulation.state
    return ((after.velocity - state.velocity) * rate,
            (after.angular_velocity - state.angular_velocity) * rate)


def one_probe(law, depth, roll=0.0, *, height=0.8, share=3.0):
    """Return lift over the greatest lift, and torque (3,) over it, of one probe at a depth."""
    hull = Hull([(0.0, 0.0, 0.0)], [share * WEIGHT], [height], law)
    boat = Boat(MASS, hull, (500.0, 500.0, 500.0), undamped())
    linear, angular = acceleration(boat, State((0.0, 0.0, -depth), turned(roll=roll)))
    assert linear[:2] == pytest.approx((0.0, 0.0), abs=1e-9)
    return (linear[2] + GRAVITY) / (share * GRAVITY), angular * 500.0 / (share * WEIGHT)


def test_lift_of_an_upright_probe():
    for depth in (-5.0, -1e-6, 0.0, 0.1, 0.4, 0.7999, 0.8, 0.81, 100.0):
        wet = min(max(depth, 0.0), 0.8)
        assert one_probe('spring', depth)[0] == pytest.approx(wet / 0.8, abs=1e-10)
        assert one_probe('column', depth)[0] == pytest.approx(wet / 0.8, abs=1e-10)
        assert one_probe('soft', depth)[0] == pytest.approx(
            1.0 - np.exp(-max(depth, 0.0) / 0.8), abs=1e-10)


def test_laws_have_the_same_slope_at_the_surface():
    # To first order: 1 - exp(-x) is less than x by x / 2 of it.
    for law in LAWS:
        assert one_probe(law, 1e-4)[0] == pytest.approx(1e-4 / 0.8, rel=1e-4 / 0.8)


def thin_column(depth, roll, height, pieces=20000):
    """Return lift and roll torque of a column cut into slices, each a little buoyant ball."""
    along = (np.arange(pieces) + 0.5) / pieces * height
    # Body z in the world at a roll: y turns by -sin, z by cos.
    under = depth - along * np.cos(roll) > 0.0
    lift = under.mean()
    return lift, (under * -along * np.sin(roll)).mean()


def test_column_lifts_as_its_slices_do_at_any_heel():
    for degrees, depth in product((0, 20, 60, 80, 100, 135, 180, -45, -150),
                                  (-0.5, -0.1, 0.05, 0.2, 0.5, 1.5)):
        roll, height = np.radians(degrees), 0.8
        lift, torque = one_probe('column', depth, roll, height=height)
        exact_lift, arm = thin_column(depth, roll, height)
        # One slice more or less at either end.
        assert lift == pytest.approx(exact_lift, abs=1e-4), (degrees, depth)
        # The arm of slices up the column: r x F with F up, about x: y of the point times lift.
        assert torque == pytest.approx((arm, 0.0, 0.0), abs=1e-4), (degrees, depth)


def test_column_upside_down_is_wet_from_its_top_end():
    # Bottom 0.3 m above the water, top end 0.5 m under it: wet 0.5 of 0.8.
    lift, torque = one_probe('column', -0.3, np.pi)
    assert lift == pytest.approx(0.5 / 0.8, abs=1e-10)
    assert torque == pytest.approx((0.0, 0.0, 0.0), abs=1e-10)
    # The same on its side by 120 degrees: the force acts in the middle of the wet part.
    lift, torque = one_probe('column', -0.1, np.radians(120.0))
    wet = (0.8 * 0.5 - 0.1) / 0.5
    assert lift == pytest.approx(wet / 0.8, abs=1e-10)
    assert torque[0] == pytest.approx(
        -(0.8 - wet / 2) * np.sin(np.radians(120.0)) * wet / 0.8, abs=1e-10)


def test_column_on_its_side_is_held_to_a_cosine_of_a_twentieth():
    nearly = np.radians(89.0)
    lift, _ = one_probe('column', 0.01, nearly)
    assert lift == pytest.approx(0.01 / 0.05 / 0.8, abs=1e-10)


@pytest.mark.parametrize('law', LAWS)
def test_gravity_acts_once_and_makes_no_torque(law):
    for count in (1, 4, 9):
        places = np.random.default_rng(count).uniform(-1.0, 1.0, (count, 3))
        boat = reference_boat(positions=places, law=law, center_of_mass=(0.3, -0.2, 0.1))
        state = State((0.0, 0.0, 50.0), turned(0.4, 0.3, 0.2), (1.0, 2.0, 3.0))
        linear, angular = acceleration(boat, state)
        assert linear == pytest.approx((0.0, 0.0, -GRAVITY), abs=1e-9)
        assert angular == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize('law', LAWS)
def test_more_probes_never_add_lift(law):
    for count in (1, 2, 4, 8, 100):
        boat = reference_boat(positions=np.zeros((count, 3)), weights=np.linspace(1, 3, count),
                              law=law, floatiness=1.2)
        for depth in (0.1, 0.3, 0.59):
            one = one_probe(law, depth, height=0.6, share=1.2)[0]
            linear, _ = acceleration(boat, State((0.0, 0.0, -depth)))
            assert (linear[2] + GRAVITY) / (1.2 * GRAVITY) == pytest.approx(one, abs=1e-10)
        # Far below: all of the budget and no more.
        linear, _ = acceleration(boat, State((0.0, 0.0, -500.0)))
        assert linear[2] == pytest.approx(0.2 * GRAVITY, abs=1e-9)


def test_budget_is_shared_by_weight():
    hull = probe_hull(SQUARE, [1.0, 2.0, 3.0, 4.0], weight=WEIGHT, floatiness=1.5, stiffness=4.0,
                      law='spring')
    assert hull.max_force == pytest.approx(np.array([0.1, 0.2, 0.3, 0.4]) * 1.5 * WEIGHT)
    assert hull.height == pytest.approx(0.25)
    assert hull.stiffness == pytest.approx(4.0 * hull.max_force)
    assert Boat(MASS, hull, (1.0, 1.0, 1.0)).floatiness == pytest.approx(1.5, rel=1e-14)


def test_weights_trim_the_boat_at_rest():
    # 60 % of the budget forward: it must float bow up (negative pitch) until both ends carry half.
    boat = reference_boat(weights=[3.0, 3.0, 2.0, 2.0], floatiness=2.5, positions=SQUARE,
                          damping=undamped(probe=4000.0))
    state = last_state(boat, State((0.0, 0.0, -0.5)), 120.0, rate=50)
    pitch = Rotation.from_quat(np.array(state.orientation)).as_euler('xyz')[1]
    # Each end carries half the weight at the depth half the weight over its own stiffness.
    fore, aft = (WEIGHT / 2 / (19620.0 * part) for part in (0.6, 0.4))
    assert np.sin(pitch) == pytest.approx((fore - aft) / 2.0, abs=1e-7)
    assert state.position[2] == pytest.approx(-(fore + aft) / 2.0, abs=1e-7)
    assert abs(state.velocity).max() < 1e-8


def test_light_probe_that_is_full_cannot_trim():
    boat = reference_boat(weights=[2.0, 1.0, 1.0, 1.0], floatiness=1.2, positions=SQUARE,
                          damping=Damping(probe=4000.0))
    state = last_state(boat, State((0.0, 0.0, -0.5)), 120.0, rate=50)
    up = Rotation.from_quat(np.array(state.orientation)).as_matrix()[2, 2]
    assert up < 0.5


@pytest.mark.parametrize(('floatiness', 'speed'), [(0.8, -0.2), (1.0, 0.0), (1.3, 0.3)])
def test_floatiness_decides_whether_a_deep_boat_sinks_hangs_or_rises(floatiness, speed):
    boat = reference_boat(floatiness=floatiness)
    state = last_state(boat, State((0.0, 0.0, -100.0)), 1.0, rate=100)
    assert state.velocity[2] == pytest.approx(speed * GRAVITY, abs=1e-10)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_retention_is_the_part_of_the_speed_kept_after_a_second(integrator):
    # Deep below with floatiness 1, and the exact discrete decay of every integrator.
    kept, rate, seconds = 0.6, 50.0, 3
    x = -np.log(kept) / rate
    boat = reference_boat(floatiness=1.0, damping=undamped(linear_retention=[kept]))
    start = State((0.0, 0.0, -100.0), velocity=(2.0, -1.0, 0.5))
    state = last_state(boat, start, seconds, rate=rate, integrator=integrator)
    # The decay of one step, and by how much of itself it misses exp(-x), to leading order.
    factor, error = {
        'leapfrog': (((1 - x / 4) / (1 + x / 4))**2, x**3 / 48),
        'implicit': (1 / (1 + x), x**2 / 2),
        'rk4': (1 - x + x**2 / 2 - x**3 / 6 + x**4 / 24, x**5 / 120),
        'symplectic_euler': (1 - x, x**2 / 2), 'euler': (1 - x, x**2 / 2)}[integrator]
    steps = round(rate * seconds)
    assert state.velocity == pytest.approx(start.velocity * factor**steps, rel=1e-12)
    assert factor**steps == pytest.approx(kept**seconds, rel=1.02 * steps * error)


def test_each_axis_of_the_body_keeps_its_own_part():
    damping = undamped(linear_retention=[0.9, 0.5, 0.2], angular_retention=[0.8, 0.6, 0.3])
    boat = reference_boat(floatiness=1.0, damping=damping, inertia=(500.0, 700.0, 900.0))
    attitude = turned(0.3, -0.5, 1.0)
    body = Rotation.from_quat(np.array(attitude))
    state = last_state(boat, State((0.0, 0.0, -100.0), attitude, body.apply([1.0, 2.0, 3.0])),
                       1.0, rate=1000)
    assert body.inv().apply(np.array(state.velocity)) == pytest.approx(
        np.array([0.9, 0.5, 0.2]) * [1.0, 2.0, 3.0], rel=1e-6)
    for axis, kept in enumerate((0.8, 0.6, 0.3)):
        spin = np.eye(3)[axis] * 0.7
        state = last_state(boat, State((0.0, 0.0, -100.0), angular_velocity=spin), 1.0, rate=1000)
        assert state.angular_velocity == pytest.approx(spin * kept, abs=1e-6)


def test_retention_mixes_water_and_air_by_the_wet_part():
    # Probes one above the other: the lower ones deep in water, the upper ones in the air.
    damping = undamped(linear_retention=[0.5], angular_retention=[0.25],
                       air_linear_retention=[0.9], air_angular_retention=[0.8])
    for wet_probes in range(5):
        heights = [-5.0] * wet_probes + [5.0] * (4 - wet_probes)
        boat = reference_boat(positions=[(0.0, 0.0, z) for z in heights], floatiness=4.0,
                              damping=damping)
        linear, angular = acceleration(boat, State(velocity=(2.0, 0.0, 0.0),
                                                   angular_velocity=(0.0, 0.0, 0.3)))
        part = wet_probes / 4
        assert linear[0] == pytest.approx(
            2.0 * (part * np.log(0.5) + (1 - part) * np.log(0.9)), abs=1e-9)
        assert angular[2] == pytest.approx(
            0.3 * (part * np.log(0.25) + (1 - part) * np.log(0.8)), abs=1e-9)


def test_damping_ramps_in_over_the_first_tenth_of_the_column():
    for depth, ramp in ((-0.1, 0.0), (0.02, 0.1), (0.1, 0.5), (0.2, 1.0), (1.5, 1.0)):
        boat = reference_boat(floatiness=4.0, damping=undamped(probe=1000.0))
        linear, _ = acceleration(boat, State((0.0, 0.0, -depth), velocity=(2.0, 0.0, 0.0)))
        assert linear[0] == pytest.approx(-ramp * 1000.0 * 2.0 / MASS, abs=1e-9)


@pytest.mark.parametrize('law', LAWS)
def test_all_forces_together_are_those_of_the_textbook(law):
    boat, sea, random = asymmetric_boat(law), wind_sea(), np.random.default_rng(5)
    for _ in range(60):
        attitude = random.normal(size=4)
        attitude = attitude / np.linalg.norm(attitude)
        state = State(random.uniform(-1.0, 1.0, 3), attitude, random.normal(size=3),
                      random.normal(size=3))
        thrust = random.normal(size=6) * 500.0
        force, torque = wrench(boat, sea, 0.0, state.position, attitude, state.velocity,
                               state.angular_velocity, thrust)
        linear, angular = acceleration(boat, state, sea=sea, thrust=thrust)
        assert linear == pytest.approx(force / MASS, abs=1e-9)
        spin = state.angular_velocity
        assert boat.inertia @ angular + np.cross(spin, boat.inertia @ spin) == pytest.approx(
            torque, abs=1e-6)


@pytest.mark.parametrize('law', LAWS)
def test_motion_is_that_of_the_textbook(law):
    # Thrown about in waves with every force there is, through entry and cap.
    boat, sea = asymmetric_boat(law), wind_sea()
    start = State((0.2, 0.1, 0.6), turned(0.4, -0.3, 0.2), (0.5, 0.2, -0.3), (0.4, -0.5, 0.6))
    thrust = np.array([300.0, 50.0, -30.0, 20.0, -10.0, 40.0])
    exact = solve(boat, sea, start, [0.8], thrust, tolerance=1e-9)[0]
    state = last_state(boat, start, 0.8, sea=sea, thrust=thrust, rate=2500, integrator='rk4')
    got = np.concatenate([state.position, state.orientation, state.velocity,
                          state.angular_velocity])
    # Either is of second order across a kink, and the five probes pass a dozen: 12 h^2.
    assert got == pytest.approx(exact, abs=12 / 2500**2)
