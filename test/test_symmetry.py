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

"""What is symmetric stays so: no drift, no yaw, no heel out of nothing."""

from boat_buoyancy.physics import Damping, Sea, State
from boat_buoyancy.physics.boat.state import PARTS
from boat_buoyancy.physics.rotation import from_roll_pitch_yaw
from boats import (
    box_boat, LAWS, reference_boat, simulate, SQUARE, turned, undamped, wind_sea)
import numpy as np
import pytest

pytestmark = pytest.mark.plain

INTEGRATORS = ('leapfrog', 'implicit', 'rk4')
HEAVE, ROLL, PITCH = range(3)


def released():
    """Return three boats: one pushed down, one rolled, one pitched, the last two off balance."""
    zero, tilt = np.zeros(3), 0.2
    return State([[0.0, 0.0, -0.6], [0.0, 0.0, -0.3], [0.0, 0.0, -0.3]],
                 np.stack(from_roll_pitch_yaw(zero + [0, tilt, 0], zero + [0, 0, tilt], zero), -1))


def worst_strays(boat, seconds, rate, integrator):
    """Return the largest x, y, yaw and angle across the release of each boat, and their ends."""
    worst, ends = np.zeros(3), []
    for kind in (HEAVE, ROLL, PITCH):
        _, states = simulate(boat, released()[kind], seconds, rate=rate, integrator=integrator)
        roll, pitch, yaw = abs(np.array(states.roll_pitch_yaw)).max(axis=1)
        across = {HEAVE: max(roll, pitch), ROLL: pitch, PITCH: roll}[kind]
        worst = np.maximum(worst, [abs(states.position[:, :2]).max(), yaw, across])
        ends.append(states[-1])
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
@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_the_same_hour_for_every_integrator_and_law(integrator, law):
    # Without probe drag: that pushes a tilted boat sideways in earnest, see below.
    damping = undamped(linear_retention=[0.999], angular_retention=[0.999])
    worst, _ = worst_strays(even_boat(law, damping), 3600, 20, integrator)
    assert worst.max() < 1e-9


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_no_drift_out_of_nothing_with_damping(integrator, law):
    worst, _ = worst_strays(even_boat(law, Damping()), 20, 25, integrator)
    assert worst.max() < 1e-12


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_probe_drag_below_the_centre_of_mass_sways_but_never_yaws(integrator):
    # A rolling boat drags its probes sideways: y moves, and that is right. Nothing else does.
    boat = box_boat(Damping(probe=5000.0))
    _, states = simulate(boat, released(), 20.0, rate=25, integrator=integrator)
    (roll, pitch, yaw), (x, y, _) = states.roll_pitch_yaw, np.moveaxis(states.position, -1, 0)
    for stray in (x[:, [HEAVE, ROLL]], y[:, [HEAVE, PITCH]], roll[:, [HEAVE, PITCH]],
                  pitch[:, [HEAVE, ROLL]], yaw):
        assert abs(stray).max() < 1e-12
    assert abs(y[-1, ROLL]) > 1e-3 and abs(x[-1, PITCH]) > 1e-4


def mirrored(state):
    """Return a motion seen in a mirror along the boat: y turns its sign."""
    return State(state.position * [1, -1, 1], state.orientation * [-1, 1, -1, 1],
                 state.velocity * [1, -1, 1], state.angular_velocity * [-1, 1, -1])


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_mirror_image_of_a_motion_is_a_motion(integrator, law):
    boat = reference_boat(law=law, floatiness=2.5, positions=SQUARE - [0.0, 0.0, 0.3],
                          damping=Damping(probe=800.0, quadratic=[50.0] * 6))
    start = State((0.1, 0.2, 0.3), turned(0.3, -0.2, 0.4), (0.5, 0.3, 0.1), (0.3, 0.4, -0.2))
    waves = wind_sea().waves
    sea = Sea(waves, (0.3, -0.2))
    mirror_sea = Sea(waves * [1, 1, -1, 1], (0.3, 0.2))
    thrust = np.array([100.0, 40.0, 30.0, 20.0, -10.0, 50.0])
    _, one = simulate(boat, start, 2.0, sea=sea, thrust=thrust, rate=50, integrator=integrator)
    _, other = simulate(boat, mirrored(start), 2.0, sea=mirror_sea,
                        thrust=thrust * [1, -1, 1, -1, 1, -1], rate=50, integrator=integrator)
    other = mirrored(other)
    for name in PARTS:
        assert getattr(one, name) == pytest.approx(getattr(other, name), abs=1e-10), name


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_motion_does_not_depend_on_where_the_boat_points_or_is(integrator):
    boat = reference_boat(floatiness=2.5, positions=SQUARE - [0.0, 0.0, 0.3],
                          damping=Damping(probe=800.0, linear_retention=[0.9, 0.7, 0.5]))
    yaw, c, s = 1.1, np.cos(1.1), np.sin(1.1)
    matrix = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    velocity = np.array([0.5, 0.3, 0.1])
    thrust, shift = (100.0, 20.0, 0.0, 5.0, 6.0, 40.0), np.array([300.0, -200.0, 0.0])
    _, one = simulate(boat, State((0.0, 0.0, 0.3), turned(0.3, -0.2, 0.0), velocity,
                                  (0.3, 0.4, -0.2)), 2.0, thrust=thrust, rate=50,
                      integrator=integrator)
    _, other = simulate(boat, State(shift + (0.0, 0.0, 0.3), turned(0.3, -0.2, yaw),
                                    matrix @ velocity, (0.3, 0.4, -0.2)), 2.0, thrust=thrust,
                        rate=50, integrator=integrator)
    assert other.position - shift == pytest.approx(one.position @ matrix.T, abs=1e-10)
    assert other.velocity == pytest.approx(one.velocity @ matrix.T, abs=1e-10)
    assert other.angular_velocity == pytest.approx(one.angular_velocity, abs=1e-10)
