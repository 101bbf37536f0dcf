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

"""Stiffness, periods and damping ratios at rest are those of the force and of the motion."""

from boat_buoyancy.physics.boat.boat import Boat, Damping
from boat_buoyancy.physics.boat.columns import box_hull
from boat_buoyancy.physics.boat.state import State
from boat_buoyancy.physics.hydrostatics.natural_modes import (
    equilibrium_stiffness, highest_damping_rate, highest_frequency, modes)
from boat_buoyancy.physics.hydrostatics.rest import rest_attitude, rest_state
from boat_buoyancy.physics.rotation import from_roll_pitch_yaw, to_roll_pitch_yaw
from boat_buoyancy.physics.sea.waves import Sea
from boats import (asymmetric_boat, box_boat, crossings, HEAVE, LAWS, reference_boat, simulate,
                   SQUARE, undamped)
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from textbook import wrench

pytestmark = pytest.mark.plain


@pytest.mark.parametrize('law', LAWS)
def test_the_stiffness_at_rest_is_the_slope_of_the_force(law):
    boat, size = asymmetric_boat(law), 1e-6
    rest, measured = rest_state(boat), np.zeros((6, 6))
    for column in range(6):
        force = []
        for sign in (1.0, -1.0):
            nudge = sign * size * np.eye(6)[column]
            turned = Rotation.from_rotvec(nudge[3:]) * Rotation.from_quat(rest.orientation)
            push, twist = wrench(boat, Sea(), 0.0, rest.position + nudge[:3], turned.as_quat(),
                                 np.zeros(3), np.zeros(3))
            force.append(np.concatenate([push, turned.apply(twist)]))
        measured[:, column] = (force[1] - force[0]) / (2.0 * size)
    expected = equilibrium_stiffness(boat)
    # Round-off of the difference: a few 1e-16 of the weight over 2e-6.
    assert expected[2:5, 2:5] == pytest.approx(
        measured[2:5, 2:5], rel=1e-6, abs=1e-9 * boat.weight)
    assert np.abs(rest_attitude(boat)).min() > 0.01
    assert not expected[:2].any() and not expected[5].any()


def test_roll_and_heave_of_the_reference_case_take_their_published_periods():
    boat = reference_boat(positions=SQUARE * [1.0, 1.0 / np.sqrt(3.0), 0.0] + [0.0, 0.0, -0.3])
    assert modes(boat)['roll'].period == pytest.approx(2.34258119, rel=1e-8)
    assert modes(boat)['heave'].period == pytest.approx(1.41850335, rel=1e-8)


def test_the_barge_heaves_as_published():
    hull = box_hull((4.0, 2.0, 1.0), -0.5, (2, 2), specific_weight=1000.0 * 9.81)
    inertia = 2000.0 / 12.0 * np.array([5.0, 17.0, 20.0])
    assert modes(Boat(2000.0, hull, inertia, undamped()))['heave'].period == pytest.approx(
        1.0030, abs=5e-5)


def test_a_boat_that_capsizes_has_no_roll_period():
    boat = reference_boat(positions=SQUARE * [1.0, 1.0 / np.sqrt(3.0), 0.0] + [0.0, 0.0, -0.7])
    found = modes(boat)
    roll = found['roll']
    assert (roll.angular_frequency, roll.period, roll.damping_ratio) == (None, None, None)
    assert found['heave'].period == pytest.approx(1.41850335, rel=1e-8)
    assert found['pitch'].angular_frequency == pytest.approx(
        np.sqrt((19620.0 - 9810.0 * 0.7) / 700.0), rel=1e-9)


@pytest.mark.parametrize('mode, row', [('heave', 0), ('roll', 1), ('pitch', 2)])
def test_small_swings_of_a_box_take_the_predicted_period(mode, row):
    boat = box_boat(damping=undamped())
    rest, size = rest_state(boat), 1e-4
    nudge = size * np.eye(3)[row]
    start = State(rest.position + [0.0, 0.0, nudge[0]],
                  np.array(from_roll_pitch_yaw(nudge[1], nudge[2], 0.0)))
    time, states = simulate(boat, start, 4.0, rate=400.0, integrator='rk4')
    roll, pitch, _ = to_roll_pitch_yaw(tuple(states.orientation.T))
    value = (states.position[:, 2] - rest.position[2], roll, pitch)[row]
    rate = (states.velocity[:, 2], states.angular_velocity[:, 0],
            states.angular_velocity[:, 1])[row]
    passed = crossings(time, value, rate, rising=True)
    assert passed[1] - passed[0] == pytest.approx(modes(boat)[mode].period, rel=1e-4)


def test_a_swing_dies_out_by_the_predicted_damping_ratio():
    boat = box_boat(damping=undamped(probe=5000.0))
    heave = modes(boat)['heave']
    rest = rest_state(boat)
    time, states = simulate(boat, State(rest.position + [0.0, 0.0, 1e-3]), 2.0, rate=400.0,
                            integrator='rk4')
    below = -(states.position[:, 2] - rest.position[2])
    damped = 2.0 * np.pi / (heave.angular_frequency * np.sqrt(1.0 - heave.damping_ratio**2))
    after = np.interp(damped, time, below)
    assert after / below[0] == pytest.approx(
        np.exp(-heave.damping_ratio * heave.angular_frequency * damped), rel=1e-3)


def test_coupled_modes_keep_the_name_of_what_moves_most():
    found = modes(asymmetric_boat())
    assert set(found) == {'heave', 'roll', 'pitch'}
    # At 4 degrees of list and trim it heaves nearly as it would level.
    assert found['heave'].angular_frequency == pytest.approx(HEAVE, rel=0.03)


def test_the_fastest_oscillation_counts_a_boat_hung_below_its_probes():
    # K+ gives sqrt(19620 / 1000); the pendulum adds m g 2 m to roll: 19620 y^2 + 19620.
    hung = reference_boat(positions=SQUARE * 0.1 + [0.0, 0.0, 2.0], inertia=[20.0, 20.0, 30.0])
    assert highest_frequency(hung) == pytest.approx(
        np.sqrt((19620.0 * 0.01 + 9810.0 * 2.0) / 20.0), rel=1e-9)
    low = reference_boat(positions=SQUARE * 0.1 - [0.0, 0.0, 0.1], inertia=[20.0, 20.0, 30.0])
    assert highest_frequency(low) == pytest.approx(HEAVE, rel=1e-9)


def test_the_fastest_damping_is_the_larger_of_water_and_air():
    fast, slow = [np.exp(-5.0)], [np.exp(-2.0)]
    assert highest_damping_rate(reference_boat(damping=Damping(
        slow, slow, fast, slow))) == pytest.approx(5.0, rel=1e-9)
    assert highest_damping_rate(reference_boat(damping=Damping(
        slow, slow, slow, slow, probe=6000.0))) == pytest.approx(
            2.0 + 6000.0 * 2.0 / 900.0, rel=1e-9)
