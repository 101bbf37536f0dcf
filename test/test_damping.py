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
    """The damping matrix of points that damp by axis, and what is solved with it, against NumPy."""

from types import SimpleNamespace

from boat_buoyancy.physics.forces.damping import damping_wrench, no_damping, with_body, with_point
from boat_buoyancy.physics.hydrostatics.natural_modes import damping_matrix
from boat_buoyancy.physics.stepping.equations_of_motion import damped_accelerations
from boat_buoyancy.physics.stepping.implicit import solve_implicit
import numpy as np
import pytest

pytestmark = pytest.mark.plain

INERTIA = np.array([[600.0, 60.0, -40.0], [60.0, 800.0, 30.0], [-40.0, 30.0, 1000.0]])
MASS = np.block([[1000.0 * np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), INERTIA]])
BOAT = SimpleNamespace(mass=1000.0, inertia=(600.0, 800.0, 1000.0, 60.0, -40.0, 30.0))


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
    wrench = random.normal(size=6) * 1e4
    np.testing.assert_allclose(
        np.concatenate(damped_accelerations(BOAT, damping, s, *halves(wrench))),
        np.linalg.solve(MASS + s * matrix, wrench), rtol=1e-11, atol=1e-11)

    # Springs k_i at points p_i along a direction up: K+ = sum k_i g_i g_i^T, g_i = (up, p_i x up).
    up = random.normal(size=3)
    up /= np.linalg.norm(up)
    k, p = random.uniform(1e3, 1e4, 4), random.normal(size=(4, 3))
    g = np.hstack([np.broadcast_to(up, (4, 3)), np.cross(p, up)])
    sprung = (k[:, None] * g).T @ g
    turning = sprung[3:, 3:]
    accelerations = solve_implicit(
        BOAT, damping, tuple(up.tolist()), float(k.sum()),
        tuple((k @ g[:, 3:]).tolist()), tuple(turning[i, j] for i, j in (
            (0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))), s, *halves(wrench))
    np.testing.assert_allclose(
        np.concatenate(accelerations),
        np.linalg.solve(MASS + s * matrix + s * s * sprung, wrench), rtol=1e-11, atol=1e-11)
