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

"""Boats come to rest, stay at rest, and tumble freely for minutes without gaining or losing."""

from boat_buoyancy.physics.boat import Boat, State
from boat_buoyancy.physics.hull import Hull
from boat_buoyancy.physics.hydrostatics import rest_state
from boat_buoyancy.physics.simulation import Simulation
from boat_buoyancy.physics.stability import modes, plan
from boat_buoyancy.physics.waves import Sea
from boats import GRAVITY, MASS, SQUARE, undamped
import numpy as np
import pytest

RATE = 60.0
TURN = 2.0 * np.pi


def shallow_boat(draft, ratio=0.2):
    """Return a 4 x 2 x 1 m box of 1000 kg that floats so deep in m, with that damping ratio."""
    heave = np.sqrt(GRAVITY / draft)
    hull = Hull(SQUARE, [MASS * GRAVITY] * 4, [4.0 * draft] * 4)
    inertia = MASS / 12.0 * np.array([5.0, 17.0, 20.0])
    return Boat(MASS, hull, inertia, undamped(probe=2.0 * ratio * MASS * heave))


def chosen_simulation(boat, state, integrator):
    """Return a simulation at 60 Hz with the substeps that are chosen for the boat."""
    chosen = plan(boat, integrator=integrator, rate=RATE)
    assert chosen.integrator == integrator
    return Simulation(boat, Sea(), state, rate=RATE, integrator=integrator,
                      substeps=chosen.substeps)


def turned_by_roll(angle):
    """Return the quaternion of a roll in rad."""
    return (np.sin(angle / 2.0), 0.0, 0.0, np.cos(angle / 2.0))


def fastest(state):
    """Return the largest component of velocity and angular velocity."""
    return max(np.abs(state.velocity).max(), np.abs(state.angular_velocity).max())


def dropped(boat, integrator, *, height=0.05, seconds=60.0):
    """Return the fastest motion left after a drop from ``height`` m above rest."""
    rest = rest_state(boat)
    simulation = chosen_simulation(boat, State(rest.position + [0.0, 0.0, height]), integrator)
    for _ in range(round(seconds * RATE)):
        simulation.step()
    return fastest(simulation.state)


@pytest.mark.parametrize('integrator', ['leapfrog', 'implicit'])
def test_a_boat_of_one_centimetre_draft_settles_in_a_minute(integrator):
    boat = shallow_boat(0.01)
    assert modes(boat)['heave'].damping_ratio == pytest.approx(0.2, rel=1e-9)
    assert dropped(boat, integrator) < 1e-6


def test_a_boat_of_one_millimetre_draft_settles_with_one_step_of_implicit():
    boat = shallow_boat(0.001)
    assert plan(boat, integrator='implicit', rate=RATE).substeps == 1
    assert dropped(boat, 'implicit') < 1e-6


@pytest.mark.parametrize('integrator', ['leapfrog', 'implicit'])
@pytest.mark.parametrize('draft', [0.001, 0.01, 0.1, 1.0])
def test_a_boat_started_at_rest_stays_at_rest(draft, integrator):
    boat = shallow_boat(draft)
    rest = rest_state(boat)
    simulation = chosen_simulation(boat, rest, integrator)
    for _ in range(600):
        simulation.step()
        assert fastest(simulation.state) < 1e-12
    assert simulation.state.position == pytest.approx(rest.position, abs=1e-12)
    assert simulation.state.orientation == pytest.approx(rest.orientation, abs=1e-12)


@pytest.mark.parametrize('integrator', ['leapfrog', 'symplectic_euler'])
def test_a_draft_of_one_millimetre_rattles_for_ever_with_one_step_of(integrator):
    boat = shallow_boat(0.001)
    tilt = turned_by_roll(0.01)
    simulation = Simulation(boat, Sea(), State((0.0, 0.0, 0.05), tilt), rate=RATE,
                            integrator=integrator)
    speeds = []
    for _ in range(3600):
        simulation.step()
        speeds.append(fastest(simulation.state))
    assert 0.1 < max(speeds[-600:]) < 10.0
    with pytest.raises(ValueError, match='substeps: 1 at 60 Hz'):
        plan(boat, integrator=integrator, rate=RATE, substeps=1)


def tumbling(integrator, turns_per_second, seconds=600.0):
    """
    Return three relative errors, one row a period, of torque-free tumbling.

    Of energy, of the size of the angular momentum and of its vector in the world.  I = (1, 2, 3)
    kg m^2 high above the water, spun a little beside the middle axis, the unstable one.
    """
    hull = Hull([[0.0, 0.0, 0.0]], [9.81], [1.0])
    inertia = np.array([1.0, 2.0, 3.0])
    boat = Boat(1.0, hull, inertia, undamped())
    start = State((0.0, 0.0, 1e8),
                  angular_velocity=TURN * turns_per_second * np.array([0.01, 1.0, 0.01]))
    simulation = Simulation(boat, Sea(), start, rate=RATE, integrator=integrator)
    spins, quaternions = [start.angular_velocity], [start.orientation]
    for _ in range(round(seconds * RATE)):
        simulation.step()
        motion = simulation.motion
        spins.append(motion.angular_velocity)
        quaternions.append(motion.orientation)
    spins, quaternions = np.array(spins), np.array(quaternions)
    energy = 0.5 * (spins**2) @ inertia
    momentum = turned(quaternions, spins * inertia)
    size = np.linalg.norm(momentum, axis=1)
    return (energy / energy[0] - 1.0, size / size[0] - 1.0,
            np.linalg.norm(momentum - momentum[0], axis=1) / size[0])


def turned(quaternions, vectors):
    """Return vectors (n, 3) turned by unit quaternions (n, 4)."""
    axis, scalar = quaternions[:, :3], quaternions[:, 3:]
    twice = 2.0 * np.cross(axis, vectors)
    return vectors + scalar * twice + np.cross(axis, twice)


@pytest.mark.parametrize('turns, worst', [(1.0, 8e-5), (5.0, 2e-3), (20.0, 0.22)])
def test_ten_minutes_of_tumbling_keep_momentum_while_energy_only_oscillates(turns, worst):
    energy, _, momentum = tumbling('leapfrog', turns)
    assert momentum.max() < 1e-12
    assert np.abs(energy).max() == pytest.approx(worst, rel=0.15)
    if turns < 20.0:
        # At 20 rev/s a step is a third of a turn and the oscillation itself is slow.
        minute = round(60.0 * RATE)
        assert abs(energy[-minute:].mean() - energy[:minute].mean()) < 0.02 * worst


@pytest.mark.parametrize('turns, worst', [(1.0, 4e-5), (5.0, 1e-3), (20.0, 0.25)])
def test_ten_minutes_of_tumbling_with_implicit_keep_energy_while_momentum_oscillates(turns, worst):
    energy, size, _ = tumbling('implicit', turns)
    assert np.abs(energy).max() < 1e-11
    assert np.abs(size).max() == pytest.approx(worst, rel=0.15)
