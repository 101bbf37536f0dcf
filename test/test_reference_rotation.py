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

from boat_buoyancy.physics.boat import Boat, State
from boat_buoyancy.physics.simulation import Simulation
from boat_buoyancy.physics.waves import Sea
from boats import crossings, last_state, reference_boat, simulate, undamped
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from scipy.special import ellipj, ellipk

MOMENTS = np.array([1.0, 2.0, 3.0])
SPIN = np.array([1.0, 0.0, 1.2])
METHODS = ('leapfrog', 'implicit', 'rk4')
ROUND = 2 * np.pi


def in_the_air(spin, orientation=(0.0, 0.0, 0.0, 1.0)):
    """Return a state high above the water, where nothing turns the boat."""
    return State((0.0, 0.0, 1e6), orientation, (0.0, 0.0, 0.0), spin)


def top(inertia=MOMENTS):
    return reference_boat(inertia=inertia, damping=undamped())


def euler_solution(time):
    """
    Return the body rates of the freely turning body that starts at SPIN.

    Jacobi elliptic functions, Landau and Lifshitz, Mechanics, paragraph 37, for M^2 > 2 E I2: the
    body turns about its third axis, whose rate keeps its sign.
    """
    i1, i2, i3 = MOMENTS
    twice_energy, momentum = MOMENTS @ SPIN**2, np.sum((MOMENTS * SPIN)**2)
    assert momentum > twice_energy * i2
    rate = np.sqrt((i3 - i2) * (momentum - twice_energy * i1) / (i1 * i2 * i3))
    modulus = ((i2 - i1) * (twice_energy * i3 - momentum)
               / ((i3 - i2) * (momentum - twice_energy * i1)))
    sn, cn, dn, _ = ellipj(rate * time, modulus)
    return np.stack([
        np.sqrt((twice_energy * i3 - momentum) / (i1 * (i3 - i1))) * cn,
        np.sqrt((twice_energy * i3 - momentum) / (i2 * (i3 - i2))) * sn,
        np.sqrt((momentum - twice_energy * i1) / (i3 * (i3 - i1))) * dn], axis=-1), (
            4 * ellipk(modulus) / rate)


def test_elliptic_functions_give_the_published_rates():
    rates, period = euler_solution(5.0)
    assert period == pytest.approx(5.58617892, abs=5e-9)
    assert rates == pytest.approx((0.7704195, -0.63753728, 1.14215384), abs=5e-9)


@pytest.mark.parametrize(('method', 'rate', 'error'), [
    ('leapfrog', 1000, 1e-6), ('implicit', 1000, 1e-6), ('rk4', 100, 1e-8)])
def test_free_body_turns_as_euler_solved_it(method, rate, error):
    time, states = simulate(top(), in_the_air(SPIN), 6.0, rate=rate, integrator=method)
    exact, period = euler_solution(time)
    assert states.angular_velocity == pytest.approx(exact, abs=error)
    # w_y passes zero upwards once a period.
    y_rate = (3.0 - 1.0) / 2.0 * states.angular_velocity[:, 2] * states.angular_velocity[:, 0]
    passing = crossings(time, states.angular_velocity[:, 1], y_rate, rising=True)
    falling = crossings(time, states.angular_velocity[:, 1], y_rate, rising=False)
    assert abs(abs(passing - falling)[0]) * 2 == pytest.approx(period, abs=2 * error)


@pytest.mark.parametrize(('method', 'rate', 'error'), [
    ('leapfrog', 2000, 2e-5), ('implicit', 2000, 2e-5), ('rk4', 400, 1e-6)])
def test_body_thrown_about_its_middle_axis_flips(method, rate, error):
    time, states = simulate(top(), in_the_air(ROUND * np.array([0.01, 1.0, 0.01])), 10.0,
                            rate=rate, integrator=method)
    spin = states.angular_velocity
    y_rate = (3.0 - 1.0) / 2.0 * spin[:, 2] * spin[:, 0]
    flips = np.sort(np.concatenate([
        crossings(time, spin[:, 1], y_rate, rising=up) for up in (True, False)]))
    assert len(flips) == 3
    assert np.diff(flips) == pytest.approx(3.11193545, abs=error)


@pytest.mark.parametrize('method', METHODS)
def test_orientation_keeps_angular_momentum_where_it_points(method):
    # Body rates say nothing of the attitude: in world axes the angular momentum stands still.
    _, states = simulate(top(), in_the_air(SPIN), 6.0, rate=500, integrator=method)
    world = Rotation.from_quat(states.orientation).apply(MOMENTS * states.angular_velocity)
    assert world == pytest.approx(np.tile(MOMENTS * SPIN, (len(world), 1)), abs=1e-5)


@pytest.mark.parametrize('inertia', [
    [1.0, 2.0, 3.0], [3.0, 1.0, 2.5], [2.0, 2.0, 2.0], [1.0, 1.0, 1.5], [1.5, 1.0, 1.5],
    [2.0, 2.5, 3.0, 0.3, -0.2, 0.4], [3.0, 2.2, 2.9, -0.5, 0.3, 0.1],
    [2.0, 2.0, 2.0, 0.3, 0.3, 0.3]])
@pytest.mark.parametrize('method', METHODS)
def test_free_rotation_of_any_body_follows_eulers_equations(inertia, method):
    boat, spin = top(inertia), np.array([0.8, -0.5, 1.1])
    tensor, inverse = boat.inertia, np.linalg.inv(boat.inertia)

    def rates(time, values):
        q, w = values[:4], values[4:]
        turning = 0.5 * (np.append(q[3] * w + np.cross(q[:3], w), -q[:3] @ w))
        return np.concatenate([turning, inverse @ -np.cross(w, tensor @ w)])

    start = np.array([0.1, 0.2, -0.3, 0.9]) / np.linalg.norm([0.1, 0.2, -0.3, 0.9])
    exact = solve_ivp(rates, (0.0, 3.0), [*start, *spin], method='DOP853', rtol=1e-12,
                      atol=1e-12).y[:, -1]
    state = last_state(boat, in_the_air(spin, start), 3.0, rate=500, integrator=method)
    assert state.angular_velocity == pytest.approx(exact[4:], abs=5e-6)
    assert abs(state.orientation @ exact[:4]) == pytest.approx(1.0, abs=1e-11)


@pytest.mark.parametrize('method', METHODS)
def test_sphere_turns_at_a_constant_rate(method):
    state = last_state(top([2.0, 2.0, 2.0]), in_the_air((0.3, -0.4, 1.2)), 10.0, rate=100,
                       integrator=method)
    exact = Rotation.from_rotvec(10.0 * np.array([0.3, -0.4, 1.2])).as_quat()
    assert abs(state.orientation @ exact) == pytest.approx(1.0, abs=1e-12)
    assert state.angular_velocity == pytest.approx((0.3, -0.4, 1.2), abs=1e-12)


def spun(axes, revolutions, method='leapfrog', *, seconds=20):
    """Return relative energy and angular momentum over time, (steps, B), at 60 Hz."""
    axes = np.asarray(axes, float)
    spin = ROUND * revolutions * axes / np.linalg.norm(axes, axis=1, keepdims=True)
    simulation = Simulation(top(), Sea(), in_the_air(spin), rate=60, integrator=method)
    rates = []
    for _ in range(60 * seconds):
        simulation.step()
        rates.append(simulation.state.angular_velocity)
    rates = np.array(rates)
    return ((MOMENTS * rates**2).sum(axis=-1) / (MOMENTS * spin**2).sum(axis=-1),
            np.linalg.norm(MOMENTS * rates, axis=-1) / np.linalg.norm(MOMENTS * spin, axis=-1))


@pytest.mark.parametrize(('revolutions', 'worst'), [(1.0, 8e-5), (5.0, 2e-3), (20.0, 0.22)])
def test_splitting_bounds_the_energy_of_a_body_thrown_about_its_middle_axis(revolutions, worst):
    energy, momentum = spun([(0.01, 1.0, 0.01), (0.1, 1.0, 0.0), (0.0, 1.0, 0.1)], revolutions)
    assert abs(momentum - 1).max() < 1e-12
    assert abs(energy - 1).max() < worst


@pytest.mark.parametrize(('revolutions', 'worst'), [(1.0, 1.1e-4), (5.0, 2.75e-3)])
def test_splitting_bounds_the_energy_of_any_throw_by_the_square_of_the_step(revolutions, worst):
    energy, momentum = spun(np.random.default_rng(1).normal(size=(100, 3)), revolutions)
    assert abs(momentum - 1).max() < 1e-12
    assert abs(energy - 1).max() < worst
    # No drift: the second half swings about what the first half swings about.
    first, last = np.split(energy, 2)
    assert last.mean(axis=0) == pytest.approx(first.mean(axis=0), abs=0.1 * worst)


def test_implicit_keeps_the_energy_of_free_rotation():
    # And lets the angular momentum swing by h^2 instead.
    energy, momentum = spun(np.random.default_rng(2).normal(size=(40, 3)), 1.0, 'implicit')
    assert abs(energy - 1).max() < 1e-12
    assert 1e-6 < abs(momentum - 1).max() < 6e-5


@pytest.mark.parametrize('method', METHODS)
def test_quaternion_stays_of_unit_length(method):
    _, states = simulate(top(), in_the_air(5 * SPIN), 20.0, rate=100, integrator=method)
    assert (states.orientation**2).sum(axis=1) == pytest.approx(1.0, abs=1e-14)


def test_axis_of_a_full_tensor_is_the_axis_of_the_turned_body():
    # A body turned inside its frame: the same motion, seen from turned axes.
    turn = Rotation.from_rotvec([0.3, -0.7, 0.2])
    matrix = turn.as_matrix()
    tensor = matrix @ np.diag(MOMENTS) @ matrix.T
    plain, turned_boat = top(), top((tensor + tensor.T) / 2)
    for method in METHODS:
        a = last_state(plain, in_the_air(SPIN), 2.0, rate=100, integrator=method)
        b = last_state(turned_boat, in_the_air(turn.apply(SPIN), turn.inv().as_quat()), 2.0,
                       rate=100, integrator=method)
        assert b.angular_velocity @ matrix == pytest.approx(a.angular_velocity, abs=1e-12)
        assert abs((Rotation.from_quat(b.orientation) * turn).as_quat() @ a.orientation) == (
            pytest.approx(1.0, abs=1e-12))


def test_inertia_of_a_boat_is_the_mass_matrix_of_its_rotation():
    boat = top([2.0, 2.5, 3.0, 0.3, -0.2, 0.4])
    moments, axes = boat.principal
    assert isinstance(boat, Boat)
    assert axes @ np.diag(moments) @ axes.T == pytest.approx(boat.inertia, abs=1e-14)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert (np.diff(moments) >= 0).all()
