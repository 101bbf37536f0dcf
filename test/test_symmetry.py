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

from boat_buoyancy.physics.boat import Boat, Damping, State
from boat_buoyancy.physics.quaternion import from_roll_pitch_yaw, to_roll_pitch_yaw
from boat_buoyancy.physics.simulation import Simulation
from boat_buoyancy.physics.waves import Sea
from boats import box_boat, LAWS, reference_boat, simulate, SQUARE, turned, undamped, wind_sea
import numpy as np
import pytest

METHODS = ('leapfrog', 'implicit', 'rk4')
HEAVE, ROLL, PITCH = range(3)


def released():
    """Return three boats: one pushed down, one rolled, one pitched, the last two off balance."""
    zero, tilt = np.zeros(3), 0.2
    return State([[0.0, 0.0, -0.6], [0.0, 0.0, -0.3], [0.0, 0.0, -0.3]],
                 np.stack(from_roll_pitch_yaw(zero + [0, tilt, 0], zero + [0, 0, tilt], zero), -1))


def worst_strays(boat, seconds, rate, method):
    """Return the largest x, y, yaw and angle across the release of each boat, and their ends."""
    worst, ends = np.zeros(3), []
    # One at a time: the same numbers as a fleet of three, and faster.
    for kind in (HEAVE, ROLL, PITCH):
        fleet = released()
        simulation = Simulation(boat, Sea(), State(fleet.position[kind], fleet.orientation[kind]),
                                rate=rate, integrator=method)
        for _ in range(seconds):
            for _ in range(rate):
                simulation.step()
            state = simulation.state
            roll, pitch, yaw = abs(np.array(to_roll_pitch_yaw(state.orientation)))
            across = {HEAVE: max(roll, pitch), ROLL: pitch, PITCH: roll}[kind]
            worst = np.maximum(worst, [abs(state.position[:2]).max(), yaw, across])
        ends.append(state)
    return worst, ends


def even_boat(law, damping):
    """Return a boat symmetric fore and aft and to both sides, its probes at the height of G."""
    return reference_boat(law=law, floatiness=3.0, positions=SQUARE, damping=damping)


def test_no_horizontal_force_and_no_yaw_out_of_nothing_for_an_hour():
    # Undamped, so that it moves on for the whole hour.
    worst, ends = worst_strays(even_boat('column', undamped()), 3600, 10, 'leapfrog')
    assert worst.max() < 1e-9
    for state in ends:
        assert abs(state.velocity[2]) + abs(state.position[2] + 0.5) > 0.01


@pytest.mark.long
@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('method', METHODS)
def test_the_same_hour_for_every_method_and_law(method, law):
    # Without probe drag: that pushes a tilted boat sideways in earnest, see below.
    damping = undamped(linear_retention=[0.999], angular_retention=[0.999])
    worst, _ = worst_strays(even_boat(law, damping), 3600, 20, method)
    assert worst.max() < 1e-9


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('method', METHODS)
def test_no_drift_out_of_nothing_with_damping(method, law):
    worst, _ = worst_strays(even_boat(law, Damping()), 20, 25, method)
    assert worst.max() < 1e-12


@pytest.mark.parametrize('method', METHODS)
def test_probe_drag_below_the_centre_of_mass_sways_but_never_yaws(method):
    # A rolling boat drags its probes sideways: y moves, and that is right. Nothing else does.
    boat = box_boat(Damping(probe=5000.0))
    simulation = Simulation(boat, Sea(), released(), rate=25, integrator=method)
    for _ in range(500):
        simulation.step()
        state = simulation.state
        roll, pitch, yaw = to_roll_pitch_yaw(state.orientation.T)
        x, y = state.position[:, 0], state.position[:, 1]
        assert abs(np.concatenate([x[:2], y[[HEAVE, PITCH]], roll[[HEAVE, PITCH]],
                                   pitch[:2], yaw])).max() < 1e-12
    assert abs(y[ROLL]) > 1e-3 and abs(x[PITCH]) > 1e-4


def mirrored(state):
    """Return a motion seen in a mirror along the boat: y turns its sign."""
    return State(state.position * [1, -1, 1], state.orientation * [-1, 1, -1, 1],
                 state.velocity * [1, -1, 1], state.angular_velocity * [-1, 1, -1])


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('method', METHODS)
def test_mirror_image_of_a_motion_is_a_motion(method, law):
    boat = reference_boat(law=law, floatiness=2.5, positions=SQUARE - [0.0, 0.0, 0.3],
                          damping=Damping(probe=800.0, quadratic=[50.0] * 6))
    start = State((0.1, 0.2, 0.3), turned(0.3, -0.2, 0.4), (0.5, 0.3, 0.1), (0.3, 0.4, -0.2))
    waves = wind_sea().waves
    sea = Sea(waves, (0.3, -0.2))
    mirror_sea = Sea(waves * [1, 1, -1, 1], (0.3, 0.2))
    thrust = np.array([100.0, 40.0, 30.0, 20.0, -10.0, 50.0])
    _, one = simulate(boat, start, 2.0, sea=sea, thrust=thrust, rate=50, integrator=method)
    _, other = simulate(boat, mirrored(start), 2.0, sea=mirror_sea,
                        thrust=thrust * [1, -1, 1, -1, 1, -1], rate=50, integrator=method)
    other = mirrored(other)
    for name in ('position', 'orientation', 'velocity', 'angular_velocity'):
        assert getattr(one, name) == pytest.approx(getattr(other, name), abs=1e-10), name


@pytest.mark.parametrize('method', METHODS)
def test_motion_does_not_depend_on_where_the_boat_points_or_is(method):
    boat = reference_boat(floatiness=2.5, positions=SQUARE - [0.0, 0.0, 0.3],
                          damping=Damping(probe=800.0, linear_retention=[0.9, 0.7, 0.5]))
    yaw, c, s = 1.1, np.cos(1.1), np.sin(1.1)
    matrix = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    velocity = np.array([0.5, 0.3, 0.1])
    thrust, shift = (100.0, 20.0, 0.0, 5.0, 6.0, 40.0), np.array([300.0, -200.0, 0.0])
    _, one = simulate(boat, State((0.0, 0.0, 0.3), turned(0.3, -0.2, 0.0), velocity,
                                  (0.3, 0.4, -0.2)), 2.0, thrust=thrust, rate=50,
                      integrator=method)
    _, other = simulate(boat, State(shift + (0.0, 0.0, 0.3), turned(0.3, -0.2, yaw),
                                    matrix @ velocity, (0.3, 0.4, -0.2)), 2.0, thrust=thrust,
                        rate=50, integrator=method)
    assert other.position - shift == pytest.approx(one.position @ matrix.T, abs=1e-10)
    assert other.velocity == pytest.approx(one.velocity @ matrix.T, abs=1e-10)
    assert other.angular_velocity == pytest.approx(one.angular_velocity, abs=1e-10)


@pytest.mark.parametrize('method', METHODS)
def test_boat_at_rest_stays_at_rest(method):
    boat = box_boat()
    draft = 2000.0 / (1025.0 * 4.0 * 2.0)
    assert isinstance(boat, Boat)
    _, states = simulate(boat, State((0.0, 0.0, 0.5 - draft)), 30.0, rate=50, integrator=method)
    assert abs(states.velocity).max() < 1e-12
    assert states.position == pytest.approx(np.tile((0.0, 0.0, 0.5 - draft), (1501, 1)),
                                            abs=1e-12)
