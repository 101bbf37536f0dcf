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

"""Free rotation follows Euler: elliptic functions, flips, and any body."""

from boat_buoyancy.physics import State
from boats import crossings, last_state, reference_boat, simulate, undamped
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from scipy.special import ellipj, ellipk

MOMENTS = np.array([1.0, 2.0, 3.0])
SPIN = np.array([1.0, 0.0, 1.2])
INTEGRATORS = ('leapfrog', 'implicit', 'rk4')
ROUND = 2 * np.pi


def in_the_air(spin, orientation=(0.0, 0.0, 0.0, 1.0)):
    """Return a state high above the water, where nothing turns the boat."""
    return State((0.0, 0.0, 1e6), orientation, (0.0, 0.0, 0.0), spin)


def top(inertia=MOMENTS):
    return reference_boat(positions=[[0.0, 0.0, 0.0]], inertia=inertia, damping=undamped())


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


@pytest.mark.parametrize(('integrator', 'rate', 'error'), [
    ('leapfrog', 1000, 1e-6), ('implicit', 1000, 1e-6), ('rk4', 100, 1e-8)])
def test_free_body_turns_as_euler_solved_it(integrator, rate, error):
    time, states = simulate(top(), in_the_air(SPIN), 6.0, rate=rate, integrator=integrator)
    exact, period = euler_solution(time)
    assert states.angular_velocity == pytest.approx(exact, abs=error)
    # w_y passes zero upwards once a period.
    y_rate = (3.0 - 1.0) / 2.0 * states.angular_velocity[:, 2] * states.angular_velocity[:, 0]
    passing = crossings(time, states.angular_velocity[:, 1], y_rate, rising=True)
    falling = crossings(time, states.angular_velocity[:, 1], y_rate, rising=False)
    assert abs(abs(passing - falling)[0]) * 2 == pytest.approx(period, abs=2 * error)


@pytest.mark.parametrize(('integrator', 'rate', 'error'), [
    ('leapfrog', 2000, 2e-5), ('implicit', 2000, 2e-5), ('rk4', 400, 1e-6)])
def test_body_thrown_about_its_middle_axis_flips(integrator, rate, error):
    time, states = simulate(top(), in_the_air(ROUND * np.array([0.01, 1.0, 0.01])), 10.0,
                            rate=rate, integrator=integrator)
    spin = states.angular_velocity
    y_rate = (3.0 - 1.0) / 2.0 * spin[:, 2] * spin[:, 0]
    flips = np.sort(np.concatenate([
        crossings(time, spin[:, 1], y_rate, rising=up) for up in (True, False)]))
    assert len(flips) == 3
    assert np.diff(flips) == pytest.approx(3.11193545, abs=error)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_orientation_keeps_angular_momentum_where_it_points(integrator):
    # Body rates say nothing of the attitude: in world axes the angular momentum stands still.
    _, states = simulate(top(), in_the_air(SPIN), 6.0, rate=500, integrator=integrator)
    world = Rotation.from_quat(states.orientation).apply(MOMENTS * states.angular_velocity)
    assert world == pytest.approx(np.tile(MOMENTS * SPIN, (len(world), 1)), abs=1e-5)


@pytest.mark.parametrize('inertia', [
    [1.0, 2.0, 3.0], [3.0, 1.0, 2.5], [2.0, 2.0, 2.0], [1.0, 1.0, 1.5], [1.5, 1.0, 1.5],
    [2.0, 2.5, 3.0, 0.3, -0.2, 0.4], [3.0, 2.2, 2.9, -0.5, 0.3, 0.1],
    [2.0, 2.0, 2.0, 0.3, 0.3, 0.3]])
def test_free_rotation_of_any_body_follows_eulers_equations(inertia):
    boat, spin, rate, seconds = top(inertia), np.array([0.8, -0.5, 1.1]), 500, 3.0
    tensor, inverse = boat.inertia, np.linalg.inv(boat.inertia)

    def rates(time, values):
        q, w = values[:4], values[4:]
        turning = 0.5 * (np.append(q[3] * w + np.cross(q[:3], w), -q[:3] @ w))
        return np.concatenate([turning, inverse @ -np.cross(w, tensor @ w)])

    start = np.array([0.1, 0.2, -0.3, 0.9]) / np.linalg.norm([0.1, 0.2, -0.3, 0.9])
    exact = solve_ivp(rates, (0.0, seconds), [*start, *spin], method='DOP853', rtol=1e-12,
                      atol=1e-12).y[:, -1]
    # Second order at least: a twelfth of (w h)^2 of the angle turned.
    speed = np.linalg.norm(spin)
    angle = speed * seconds * (speed / rate)**2 / 12.0
    for integrator in INTEGRATORS:
        state = last_state(boat, in_the_air(spin, start), seconds, rate=rate,
                           integrator=integrator)
        assert state.angular_velocity == pytest.approx(exact[4:], abs=speed * angle)
        # Half the angle, and its square.
        assert 1.0 - abs(state.orientation @ exact[:4]) < 0.5 * (0.5 * angle)**2 + 1e-12


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_sphere_turns_at_a_constant_rate(integrator):
    state = last_state(top([2.0, 2.0, 2.0]), in_the_air((0.3, -0.4, 1.2)), 10.0, rate=100,
                       integrator=integrator)
    exact = Rotation.from_rotvec(10.0 * np.array([0.3, -0.4, 1.2])).as_quat()
    assert abs(state.orientation @ exact) == pytest.approx(1.0, abs=1e-12)
    assert state.angular_velocity == pytest.approx((0.3, -0.4, 1.2), abs=1e-12)


def spun(axes, rate, integrator, *, seconds=20):
    """Return energy and angular momentum in body axes of tops spun at 1 rev/s, over time."""
    spin = ROUND * axes / np.linalg.norm(axes, axis=1, keepdims=True)
    _, states = simulate(top(), in_the_air(spin), seconds, rate=rate, integrator=integrator)
    return 0.5 * states.angular_velocity**2 @ MOMENTS, MOMENTS * states.angular_velocity


def modified_energy(momentum, h):
    """
    Return what the five turns conserve to the fourth order of h in place of the energy.

    For the step exp(A/2) exp(B) exp(A/2) that is A + B + h^2 ({B, {B, A}} / 12 - {A, {A, B}} / 24)
    (Hairer, Lubich, Wanner, Geometric Numerical Integration, III.4), here twice: A about the first
    axis, B about the other two, itself such a step.  T_a = L_a^2 / 2 I_a and
    {f, g} = L . (grad f x grad g) give {T_1, T_2} = L_1 L_2 L_3 / (I_1 I_2) and
    {T_1, L_1 L_2 L_3} = L_1^2 (L_3^2 - L_2^2) / I_1, and so on around.
    """
    i1, i2, i3 = MOMENTS
    x, y, z = np.moveaxis(momentum**2, -1, 0)
    with_1, with_2, with_3 = x * (z - y) / i1, y * (x - z) / i2, z * (y - x) / i3
    inner = -with_3 / (i2 * i3) / 12.0 - with_2 / (i2 * i3) / 24.0
    # {B, A} = (1 / (I_3 I_1) - 1 / (I_1 I_2)) L_1 L_2 L_3.
    between = 1.0 / (i3 * i1) - 1.0 / (i1 * i2)
    outer = (with_2 + with_3) * between / 12.0 + with_1 * between / 24.0
    return 0.5 * momentum**2 @ (1.0 / MOMENTS) + h**2 * (inner + outer)


def test_splitting_swings_the_energy_as_its_modified_energy_says_and_keeps_the_momentum():
    axes = np.random.default_rng(1).normal(size=(10, 3))
    swings, left = [], []
    for rate in (60, 120):
        energy, momentum = spun(axes, rate, 'leapfrog')
        size = np.linalg.norm(momentum, axis=-1)
        assert abs(size / size[0] - 1.0).max() < 1e-12
        modified = modified_energy(momentum, 1.0 / rate)
        swings.append(abs(energy / energy[0] - 1.0).max())
        left.append(abs(modified / modified[0] - 1.0).max())
    # Second order without drift, and what is left of it of the fourth.
    assert np.log2(swings[0] / swings[1]) == pytest.approx(2.0, abs=0.1)
    assert np.log2(left[0] / left[1]) == pytest.approx(4.0, abs=0.2)


def test_implicit_keeps_the_energy_of_free_rotation():
    # And lets the angular momentum swing by h^2 instead.
    swings = []
    for rate in (60, 120):
        energy, momentum = spun(np.random.default_rng(2).normal(size=(10, 3)), rate, 'implicit')
        assert abs(energy / energy[0] - 1.0).max() < 1e-12
        size = np.linalg.norm(momentum, axis=-1)
        swings.append(abs(size / size[0] - 1.0).max())
    assert np.log2(swings[0] / swings[1]) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_quaternion_stays_of_unit_length(integrator):
    _, states = simulate(top(), in_the_air(5 * SPIN), 20.0, rate=100, integrator=integrator)
    assert (states.orientation**2).sum(axis=1) == pytest.approx(1.0, abs=1e-14)


def test_axis_of_a_full_tensor_is_the_axis_of_the_turned_body():
    # A body turned inside its frame: the same motion, seen from turned axes.
    turn = Rotation.from_rotvec([0.3, -0.7, 0.2])
    matrix = turn.as_matrix()
    tensor = matrix @ np.diag(MOMENTS) @ matrix.T
    plain, turned_boat = top(), top((tensor + tensor.T) / 2)
    for integrator in INTEGRATORS:
        a = last_state(plain, in_the_air(SPIN), 2.0, rate=100, integrator=integrator)
        b = last_state(turned_boat, in_the_air(turn.apply(SPIN), turn.inv().as_quat()), 2.0,
                       rate=100, integrator=integrator)
        assert b.angular_velocity @ matrix == pytest.approx(a.angular_velocity, abs=1e-12)
        assert abs((Rotation.from_quat(b.orientation) * turn).as_quat() @ a.orientation) == (
            pytest.approx(1.0, abs=1e-12))


def test_inertia_of_a_boat_is_the_mass_matrix_of_its_rotation():
    boat = top([2.0, 2.5, 3.0, 0.3, -0.2, 0.4])
    moments, axes = boat.principal
    assert axes @ np.diag(moments) @ axes.T == pytest.approx(boat.inertia, abs=1e-14)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert (np.diff(moments) >= 0).all()
