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

"""The damping matrix of points that damp by axis, and what is solved with it, against NumPy."""

from types import SimpleNamespace

from boat_buoyancy.physics import Boat, Sea, Simulation, State
from boat_buoyancy.physics.forces.added_mass import mass_in_force
from boat_buoyancy.physics.forces.damping import damping_wrench, no_damping, with_body, with_point
from boat_buoyancy.physics.hydrostatics.natural_modes import damping_matrix
from boat_buoyancy.physics.stepping.equations_of_motion import damped_accelerations
from boat_buoyancy.physics.stepping.implicit import solve_implicit
from boats import box_boat, undamped
import numpy as np
import pytest
from random_boats import inertia
from scipy.linalg import expm

pytestmark = pytest.mark.plain

INERTIA = np.array([[600.0, 60.0, -40.0], [60.0, 800.0, 30.0], [-40.0, 30.0, 1000.0]])
ADDED = (300.0, 900.0, 1500.0, 250.0, 900.0, 400.0)
BOAT = SimpleNamespace(mass=1000.0, inertia=(600.0, 800.0, 1000.0, 60.0, -40.0, 30.0),
                       added_mass=ADDED)
# Three quarters in the water.
LOAD = SimpleNamespace(wetness=0.75)
MASS = np.block([[1000.0 * np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), INERTIA]]) + (
    0.75 * np.diag(ADDED))


def skew(r):
    """Return [r x]."""
    x, y, z = r
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def points(seed):
    """Return the damping matrix of five points and a body, and (6, 6) of the same by NumPy."""
    random = np.random.default_rng(seed)
    damping, matrix = no_damping(), np.zeros((6, 6))
    for r, c in zip(random.normal(size=(5, 3)), random.uniform(0.0, 3000.0, (5, 3))):
        damping = with_point(damping, tuple(c.tolist()), tuple(r.tolist()))
        # v + w x r of a velocity (v, w).
        at_point = np.hstack([np.eye(3), -skew(r)])
        matrix += at_point.T @ np.diag(c) @ at_point
    damping = with_body(damping, (10.0, 20.0, 30.0), (1.0, 2.0, 3.0, 0.1, 0.2, 0.3))
    matrix[:3, :3] += np.diag([10.0, 20.0, 30.0])
    matrix[3:, 3:] += [[1.0, 0.1, 0.2], [0.1, 2.0, 0.3], [0.2, 0.3, 3.0]]
    return damping, matrix


def halves(six):
    """Return two tuples of three floats."""
    return tuple(six[:3].tolist()), tuple(six[3:].tolist())


@pytest.mark.parametrize('seed', range(5))
def test_points_that_damp_by_axis_add_up_to_their_matrix(seed):
    damping, matrix = points(seed)
    np.testing.assert_allclose(damping_matrix(damping), matrix, rtol=1e-13, atol=1e-10)
    velocity = np.random.default_rng(seed + 10).normal(size=6)
    np.testing.assert_allclose(np.concatenate(damping_wrench(damping, *halves(velocity))),
                               matrix @ velocity, rtol=1e-13, atol=1e-10)


@pytest.mark.parametrize('seed', range(5))
def test_a_step_solves_with_the_whole_matrix(seed):
    damping, matrix = points(seed)
    random, s = np.random.default_rng(seed + 20), 0.3
    pushed = random.normal(size=6) * 1e4
    np.testing.assert_allclose(
        np.concatenate(damped_accelerations(BOAT, LOAD, damping, s, *halves(pushed))),
        np.linalg.solve(MASS + s * matrix, pushed), rtol=1e-11, atol=1e-11)

    # Springs k_i at points p_i along a direction up: K+ = sum k_i g_i g_i^T, g_i = (up, p_i x up).
    up = random.normal(size=3)
    up /= np.linalg.norm(up)
    k, p = random.uniform(1e3, 1e4, 4), random.normal(size=(4, 3))
    g = np.hstack([np.broadcast_to(up, (4, 3)), np.cross(p, up)])
    sprung = (k[:, None] * g).T @ g
    turning = sprung[3:, 3:]
    accelerations = solve_implicit(
        *mass_in_force(BOAT, LOAD.wetness), damping, tuple(up.tolist()), float(k.sum()),
        tuple((k @ g[:, 3:]).tolist()), tuple(turning[i, j] for i, j in (
            (0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))), s, *halves(pushed))
    np.testing.assert_allclose(
        np.concatenate(accelerations),
        np.linalg.solve(MASS + s * matrix + s * s * sprung, pushed), rtol=1e-11, atol=1e-11)


def turning(tensor, kept):
    """Return a boat high in the air that keeps so much (3,) of its rotation after a second."""
    return Boat(1000.0, box_boat().hull, tensor, undamped(air_angular_retention=kept))


@pytest.mark.parametrize('seed', range(20))
def test_what_a_boat_turns_about_an_axis_decays_at_the_rate_of_that_axis(seed):
    random = np.random.default_rng(seed)
    tensor, kept = inertia(random, 1000.0), random.uniform(0.05, 1.0, 3)
    boat = turning(tensor, kept)
    C, rates = boat.retention_damping[1, 3:, 3:], -np.log(kept)
    # w' = -I^-1 C w, of turns so slow that nothing gyroscopic is left.
    after = expm(-np.linalg.solve(boat.inertia, C))
    np.testing.assert_allclose(np.diag(after), kept, rtol=1e-9)
    # One that decays faster is never stirred, and the slowest turns on as it is.
    rising = np.argsort(rates)
    assert np.abs(np.tril(after[np.ix_(rising, rising)], -1)).max() < 1e-9

    # The rates lie between the least and the greatest, and no torque feeds energy in.
    small = 1e-12 * np.abs(C).max()
    assert np.abs(C - C.T).max() < small
    assert np.linalg.eigvalsh(C - rates.min() * boat.inertia).min() > -small
    assert np.linalg.eigvalsh(rates.max() * boat.inertia - C).min() > -small


@pytest.mark.parametrize('kept', [[0.5], [0.5, 1.0, 1.0], [1.0, 1.0, 0.5], [0.9, 0.5, 0.7]])
def test_a_boat_with_products_of_inertia_keeps_what_its_retention_says(kept):
    boat = turning([800.0, 2800.0, 3300.0, 100.0, -200.0, 150.0], kept)
    for axis, part in enumerate(np.broadcast_to(kept, 3)):
        spin = 1e-6 * np.eye(3)[axis]
        sim = Simulation(boat, Sea(), State((0.0, 0.0, 1e3), angular_velocity=spin), rate=100.0)
        # Crank-Nicolson in kicks of h / 2: off by d^3 h^2 / 48, less than 1e-6 of it.
        assert sim.run(1.0).angular_velocity[-1, axis] == pytest.approx(1e-6 * part, rel=1e-6)


def test_equal_rates_keep_their_part_of_the_angular_momentum_at_any_speed():
    boat = turning([800.0, 2800.0, 3300.0, 100.0, -200.0, 150.0], [0.5])
    state = State((0.0, 0.0, 1e3), angular_velocity=(1.0, -2.0, 3.0))
    sim = Simulation(boat, Sea(), state, rate=100.0)
    momentum = [np.linalg.norm(boat.inertia @ spin)
                for spin in sim.run(1.0).angular_velocity[[0, -1]]]
    assert momentum[1] == pytest.approx(0.5 * momentum[0], rel=1e-6)
