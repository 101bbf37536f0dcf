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

"""A boat with added mass moves as Kirchhoff says, in the air as if it had none."""

from dataclasses import replace
import json
from pathlib import Path

from boat_buoyancy.physics import load_scene, Sea, Simulation, State
from boat_buoyancy.physics.boat.boat import Boat
from boat_buoyancy.physics.boat.hull import Hull
from boat_buoyancy.physics.boat.shapes import mesh_shaped
from boat_buoyancy.physics.hydrostatics.natural_modes import modes
from boat_buoyancy.physics.hydrostatics.rest import rest_state
from boat_buoyancy.physics.step_size.limits import max_stable_steps
from boats import (
    all_damping, asymmetric_boat, crossings, DRAFT, fleet_of, GRAVITY, INTEGRATORS, MASS,
    random_states, reference_boat, run, same, simulate, STIFFNESS, turned, undamped)
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from test_panels import sphere

BARGE = json.loads((Path(__file__).parent / 'data' / 'bem_barge.json').read_text())
ADDED = np.array([300.0, 900.0, 1500.0, 250.0, 900.0, 400.0])
TENSOR = [500.0, 700.0, 900.0, 60.0, -40.0, 30.0]


# Free motion: under water, where the lift is the weight and acts at the centre of mass.

def free_boat(inertia=TENSOR, added=ADDED, mass=MASS):
    hull = Hull([[0.0, 0.0, 0.0]], [mass * GRAVITY], [1.0])
    return Boat(mass, hull, inertia, undamped(), added_mass=added)


def under_water(velocity, spin, orientation=(0.0, 0.0, 0.0, 1.0)):
    return State((0.0, 0.0, -1000.0), orientation, velocity, spin)


TUMBLING = under_water((1.0, -0.6, 0.4), (0.3, -0.5, 0.7), turned(0.3, -0.2, 0.5))


def kirchhoff(boat, state, times, current=(0.0, 0.0, 0.0)):
    """
    Return position and velocity in world axes, angular velocity and orientation at ``times``.

    M v' = M v x w, J w' = J w x w + M v x v, v relative to the current (Lamb, Hydrodynamics,
    124), by SciPy's eighth order.
    """
    M, J = boat.mass + boat.added_mass[:3], boat.inertia + np.diag(boat.added_mass[3:])
    inverse, current = np.linalg.inv(J), np.array(current)

    def rates(_, values):
        q, v, w = values[3:7], values[7:10], values[10:]
        turning = 0.5 * np.append(q[3] * w + np.cross(q[:3], w), -q[:3] @ w)
        return np.concatenate([
            Rotation.from_quat(q).apply(v) + current, turning, np.cross(M * v, w) / M,
            inverse @ (np.cross(J @ w, w) + np.cross(M * v, v))])

    relative = Rotation.from_quat(state.orientation).inv().apply(state.velocity - current)
    rows = solve_ivp(rates, (0.0, times[-1]), np.concatenate(
        [state.position, state.orientation, relative, state.angular_velocity]), method='DOP853',
        t_eval=times, rtol=1e-12, atol=1e-12).y.T
    world = Rotation.from_quat(rows[:, 3:7]).apply(rows[:, 7:10]) + current
    return np.concatenate([rows[:, :3], world, rows[:, 10:], rows[:, 3:7]], axis=1)


def numbers(state):
    return np.concatenate([state.position, state.velocity, state.angular_velocity,
                           state.orientation], axis=-1)


@pytest.mark.parametrize('current', [(0.0, 0.0), (1.1, -0.7)])
@pytest.mark.parametrize(('integrator', 'order', 'rates'), [
    ('leapfrog', 2, (50, 100)), ('rk4', 4, (20, 40)), ('implicit', 1, (400, 800)),
    ('symplectic_euler', 1, (800, 1600)), ('euler', 1, (800, 1600))])
def test_a_free_body_moves_by_kirchhoffs_equations_to_the_order_of_the_integrator(
        integrator, order, rates, current):
    boat, errors = free_boat(), []
    exact = kirchhoff(boat, TUMBLING, [3.0], (*current, 0.0))[0]
    for rate in rates:
        _, states = simulate(boat, TUMBLING, 3.0, sea=Sea(current=current), rate=rate,
                             integrator=integrator)
        errors.append(np.linalg.norm(numbers(states[-1]) - exact))
    # Without force implicit is leapfrog's drift with the energy put right: of second order.
    order = 2 if integrator == 'implicit' else order
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.15)
    assert errors[-1] < 0.05


def momenta(boat, states, current=(0.0, 0.0, 0.0)):
    """Return energy (n,), and momentum and its moment about the origin (n, 3), world axes."""
    M, J = boat.mass + boat.added_mass[:3], boat.inertia + np.diag(boat.added_mass[3:])
    turn = Rotation.from_quat(states.orientation)
    v, w = turn.apply(states.velocity - current, inverse=True), states.angular_velocity
    momentum = turn.apply(M * v)
    return (0.5 * (v ** 2 @ M + np.einsum('ij,ni,nj->n', J, w, w)), momentum,
            np.cross(states.position, momentum) + turn.apply(w @ J))


def barge_under_water():
    """Return the barge, deep under water without weight, and how it goes: 1 m/s, 0.1 rad/s."""
    boat = free_boat(BARGE['inertia'], BARGE['added_mass'], BARGE['mass'])
    return boat, State((0.0, 0.0, -1000.0), velocity=(1.0, 0.3, -0.2),
                       angular_velocity=(0.1, -0.05, 0.08))


def test_leapfrog_keeps_momentum_to_round_off_and_energy_without_drift():
    boat, begin = barge_under_water()
    swings = []
    for rate in (10, 20):
        _, states = simulate(boat, begin, 500.0, rate=rate)
        energy, momentum, moment = momenta(boat, states)
        # A unit or two in the last place of each number a step.
        round_off = 4.0 * np.finfo(float).eps * len(momentum) * np.linalg.norm(momentum[0])
        assert abs(momentum - momentum[0]).max() < round_off
        away = np.linalg.norm(states.position, axis=1).max()
        assert abs(moment - moment[0]).max() < round_off * away
        off = abs(energy / energy[0] - 1.0)
        half = len(off) // 2
        # A drift would double it.
        assert off[half:].max() < 1.5 * off[:half].max()
        swings.append(off.max())
    assert swings[0] < 9e-5
    assert np.log2(swings[0] / swings[1]) == pytest.approx(2.0, abs=0.2)


@pytest.mark.parametrize('current', [(0.0, 0.0), (1.1, -0.7)])
def test_implicit_keeps_the_energy_of_a_free_body_to_round_off(current):
    boat = free_boat()
    _, states = simulate(boat, TUMBLING, 50.0, sea=Sea(current=current), rate=20,
                         integrator='implicit')
    energy, *_ = momenta(boat, states, (*current, 0.0))
    assert abs(energy / energy[0] - 1.0).max() < 1e-12


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_next_to_no_added_mass_is_none(integrator):
    # The equations with added mass and those without are two: they must meet.
    boat, states = asymmetric_boat(), random_states((20,), 4)
    ends = []
    for added in (0.0, 1e-200):
        fleet = fleet_of([replace(boat, added_mass=[added] * 6)] * 20, [Sea()] * 20, states,
                         rate=400.0, integrator=integrator)
        for _ in range(100):
            fleet.step()
        assert not fleet.failed.any()
        ends.append(numbers(fleet.state))
    if integrator in ('leapfrog', 'implicit'):
        # One goes straight between kicks, the other by halves; a turn alone is the same.
        np.testing.assert_allclose(ends[0], ends[1], atol=1e-9)
    else:
        np.testing.assert_allclose(ends[0], ends[1], atol=1e-11)


# Stability.

@pytest.mark.parametrize(('part', 'grows'), [(0.97, False), (1.03, True)])
def test_leapfrog_is_stable_up_to_two_over_the_frequency_with_added_mass(part, grows):
    # Heave of 1000 kg and 1500 kg of water on 19620 N/m, pushed by a millimetre.
    boat = replace(reference_boat(), added_mass=ADDED)
    omega = np.sqrt(STIFFNESS / (MASS + ADDED[2]))
    _, states = simulate(boat, State((0.0, 0.0, -DRAFT + 1e-3)), 200.0 * part * 2.0 / omega,
                         rate=omega / (2.0 * part))
    most = abs(states.position[:, 2] + DRAFT).max()
    # Below, the swing is that of the energy of its own spring, weaker by 1 - part^2; above, the
    # angle is imaginary: cosh(w h) = 2 part^2 - 1, e^0.49 a step.
    assert (most > 1.0) if grows else (most < 1e-3 / np.sqrt(1.0 - part ** 2))


def test_the_largest_stable_step_of_the_barge_is_that_of_its_heave_with_added_mass():
    values = {'boat.mass': BARGE['mass'], 'boat.center_of_mass': [0.0, 0.0, 0.3],
              'boat.inertia': BARGE['inertia'], 'hull.size': [20.0, 6.0, 3.0],
              'hull.bottom': -1.5, 'damping.probe': 0.0}
    stiffness = 1025.0 * GRAVITY * 20.0 * 6.0
    for added, known in ((np.zeros(6), 0.78), (np.array(BARGE['added_mass']), 1.20)):
        exact = 2.0 / np.sqrt(stiffness / (BARGE['mass'] + added[2]))
        boat = load_scene({**values, 'added_mass': added.tolist()}).boat
        boat = boat.with_damping(undamped())
        assert max_stable_steps(boat)['leapfrog'] == pytest.approx(exact, rel=1e-4)
        assert exact == pytest.approx(known, abs=0.005)


# In and out of the water.

def drop_energy(boat, states, wetness):
    """Return the energy in J of a boat on one spring, with the added mass of its wetness."""
    depth, height = np.maximum(-states.position[:, 2], 0.0), states.position[:, 2]
    moving = 0.5 * (MASS + np.outer(wetness, ADDED[:3]).reshape(*wetness.shape, 3))
    return ((moving * states.velocity ** 2).sum(axis=1) + MASS * GRAVITY * height
            + 0.5 * STIFFNESS * depth ** 2)


def thrown(boat, begin, rate, seconds, sea=None, integrator='leapfrog'):
    """Return states (steps + 1, boats) and wetness of the same boat from many starts."""
    size, = begin.batch_shape
    fleet = fleet_of([boat] * size, [sea or Sea()] * size, begin, rate=rate,
                     integrator=integrator)
    states, wetness = [fleet.state], [fleet.wetness]
    for _ in range(round(seconds * rate)):
        fleet.step()
        states.append(fleet.state)
        wetness.append(fleet.wetness)
    assert not fleet.failed.any()
    return states, np.array(wetness)


def dropped(count=150, speed=(0.0, 0.0)):
    """Return starts from 0 to 1 m over the water, and from 1 to 1.7 m under it."""
    height = np.concatenate([np.linspace(0.01, 1.0, count), np.linspace(-1.7, -1.0, count)])
    return State(np.outer(height, (0.0, 0.0, 1.0)), velocity=np.tile((*speed, 0.0), (
        2 * count, 1)))


def one_spring(**changes):
    return replace(reference_boat(positions=[[0.0, 0.0, 0.0]]), added_mass=ADDED, **changes)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_in_the_air_it_falls_with_g(integrator):
    begin = State((0.0, 0.0, 10.0), turned(0.4, -0.3, 0.2), velocity=(0.5, -0.2, 0.0))
    time, states = simulate(one_spring(), begin, 1.2, rate=100, integrator=integrator)
    exact = begin.velocity - np.outer(time, (0.0, 0.0, GRAVITY))
    assert abs(states.velocity - exact).max() < 1e-12


def test_the_energy_grows_by_no_more_than_the_cube_of_the_step_through_entry_and_exit():
    # Leapfrog keeps E - (w h)^2 k x^2 / 8, so that E grows by at most (w h)^3 / 4 of itself in a
    # step, w that of the boat without the water, its fastest; E above that of rest.
    boat, begin, rises = one_spring(), dropped(), []
    omega = np.sqrt(STIFFNESS / MASS)
    for rate in (100, 200):
        states, wetness = thrown(boat, begin, rate, 2.5)
        energy = np.array([drop_energy(boat, state, wet) for state, wet in zip(states, wetness)])
        energy += 0.5 * MASS * GRAVITY * DRAFT
        assert (wetness.min(axis=0) == 0.0).sum() >= 260 and (wetness.max(axis=0) == 1.0).all()
        # Out of the water with a speed, and in again.
        assert ((np.diff(wetness, axis=0) < 0.0).any(axis=0)).sum() >= 150
        rises.append(np.diff(energy, axis=0).max())
        assert rises[-1] <= (omega / rate) ** 3 / 4.0 * energy.max()
    assert rises[0] <= 3e-5 * MASS * GRAVITY * 1.0
    # It is that large, and vanishes as the cube.
    assert rises[0] / rises[1] == pytest.approx(8.0, rel=0.15)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_what_comes_in_keeps_its_momentum_in_the_current_and_what_comes_out_its_velocity(
        integrator):
    # As much on every axis, or Munk's moment would turn it.
    current, boat = np.array([0.7, -0.3]), replace(one_spring(), added_mass=[1200.0] * 6)
    states, wetness = thrown(boat, dropped(50, speed=(2.0, 1.5)), 100, 2.5, Sea(current=current),
                             integrator)
    along = np.array([state.velocity[:, :2] for state in states])
    momentum = (MASS + wetness[..., None] * 1200.0) * (along - current)
    rising, falling = np.diff(wetness, axis=0) > 0.0, np.diff(wetness, axis=0) < 0.0
    assert rising.any(axis=0).all() and falling.any(axis=0).sum() >= 50
    assert abs(np.diff(momentum, axis=0)[~falling]).max() < 1e-12 * momentum.max()
    assert abs(np.diff(along, axis=0)[~rising]).max() < 1e-14


# In a current.

@pytest.mark.parametrize('wave_force', ['hydrostatic', 'froude_krylov'])
def test_a_boat_that_drifts_with_the_current_in_still_water_feels_nothing(wave_force):
    for heading in np.linspace(-3.0, 3.0, 9):
        c, s = np.cos(heading), np.sin(heading)
        sim = load_scene({
            'added_mass': ADDED.tolist(), 'wave_force': wave_force,
            'damping.linear': [100.0] * 6, 'damping.quadratic': [200.0] * 6,
            'damping.linear_retention': [0.9], 'damping.probe': 500.0,
            'sea.current': [1.3, -0.8], 'start.velocity': (
                1.3 * c - 0.8 * s, -0.8 * c - 1.3 * s, 0.0),
            'start.orientation': [0.0, 0.0, heading]}).simulation()
        # Of forces of the order of the weight.
        assert np.abs(sim.acceleration()).max() < 1e-13 * GRAVITY
        sim.run(5.0)
        assert sim.state.velocity == pytest.approx([1.3, -0.8, 0.0], abs=1e-11)
        assert sim.state.angular_velocity == pytest.approx([0.0] * 3, abs=1e-11)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_the_motion_in_a_current_is_that_in_still_water_seen_from_the_bank(integrator):
    current, rate, count = np.array([1.3, -0.8, 0.0]), 100.0, 30
    boat = replace(asymmetric_boat(damping=all_damping()), added_mass=ADDED,
                   immersion=[0.2, 0.3, 0.25, 0.35, 0.4])
    begin = random_states((count,), 8)
    carried = State(begin.position, begin.orientation, begin.velocity + current,
                    begin.angular_velocity)
    ends = []
    for start, sea in ((begin, Sea()), (carried, Sea(current=current[:2]))):
        states, wetness = thrown(boat, start, rate, 2.0, sea, integrator)
        assert (wetness.min(axis=0) < 1.0).any() and (wetness.max(axis=0) == 1.0).any()
        ends.append(states[-1])
    still, moved = ends
    np.testing.assert_allclose(moved.position, still.position + 2.0 * current, atol=1e-10)
    np.testing.assert_allclose(moved.velocity, still.velocity + current, atol=1e-10)
    np.testing.assert_allclose(moved.orientation, still.orientation, atol=1e-10)
    np.testing.assert_allclose(moved.angular_velocity, still.angular_velocity, atol=1e-10)


def test_a_slender_body_askew_is_turned_broadside_by_munks_moment():
    # A prolate spheroid of 4 to 1, Lamb's k1 = 0.082, k2 = 0.860, k' = 0.608: Munk's moment is
    # rho U^2 / 2 V (k2 - k1) sin 2a, and turns the bow away from where it goes.
    displaced, speed, angle = 1000.0, 2.0, 0.1
    yaw = displaced / 5.0 * (2.0 ** 2 + 0.5 ** 2)
    boat = free_boat([displaced / 5.0 * 2.0 * 0.5 ** 2, yaw, yaw], [
        0.082 * displaced, 0.860 * displaced, 0.860 * displaced, 0.0, 0.608 * yaw, 0.608 * yaw],
        displaced)
    # Bow to port of the way.
    begin = under_water((speed, 0.0, 0.0), (0.0, 0.0, 0.0), turned(yaw=angle))
    sim = Simulation(boat, Sea(), begin, rate=50.0)
    moment = 0.5 * displaced * speed ** 2 * (0.860 - 0.082) * np.sin(2.0 * angle)
    assert sim.acceleration()[1] == pytest.approx([0.0, 0.0, moment / (1.608 * yaw)], rel=1e-12)
    states = run(sim, 20.0)[1]
    assert (np.diff(states.yaw[:100]) > 0.0).all() and states.yaw.max() > np.pi / 2.0


# Natural periods.

@pytest.mark.parametrize(('values', 'table', 'known'), [
    ({}, [4938.29, 833.855, 4948.83], {'heave': (0.99, 1.85), 'roll': (1.31, 1.85),
                                       'pitch': (1.06, 1.76)}),
    ({'boat.mass': BARGE['mass'], 'boat.center_of_mass': [0.0, 0.0, 0.3],
      'boat.inertia': BARGE['inertia'], 'hull.size': [20.0, 6.0, 3.0], 'hull.bottom': -1.5},
     BARGE['added_mass'][2:5], {'heave': (2.46, 3.77), 'roll': (3.99, 4.95),
                                'pitch': (2.55, 3.77)})], ids=['box', 'barge'])
def test_natural_periods_are_the_published_ones_without_and_with_added_mass(values, table, known):
    # Roll of the barge as its GM of 0.95 m has it; the table's own stiffness is 2 % short.
    for column, added in enumerate(([0.0] * 3, table)):
        found = modes(load_scene({**values, 'added_mass': [0.0, 0.0, *added, 0.0]}).boat)
        for name, periods in known.items():
            assert found[name].period == pytest.approx(periods[column], abs=0.011), name


def test_the_damping_ratio_is_of_critical_with_added_mass():
    values = {'added_mass': [330.0, 690.0, 4940.0, 834.0, 4950.0, 1010.0],
              'damping.linear': [800.0, 2160.0, 8540.0, 0.0, 0.0, 0.0]}
    stiffness = 1025.0 * GRAVITY * 4.0 * 2.0
    assert modes(load_scene(values).boat)['heave'].damping_ratio == pytest.approx(
        8540.0 / (2.0 * np.sqrt(stiffness * (2000.0 + 4940.0))), rel=1e-9)


SPHERES = {
    # Kramer et al., Energies 14 (2021) 269: diameter 0.3 m, in a tank; K N/m.
    'Kramer': (0.15, 7.056, 998.2, 9.82, -0.0348, 692.9, 0.634, 0.44 * 7.056),
    # IEA OES task 10: radius 5 m.
    'IEA OES-10': (5.0, 261.8e3, 1000.0, 9.81, -2.0, 7.695e5, 3.665, 0.44 * 261.8e3)}


@pytest.mark.parametrize('name', SPHERES)
def test_a_sphere_let_go_swings_with_the_period_of_its_mass_and_added_mass(name):
    radius, mass, density, gravity, center, stiffness, dry, added = SPHERES[name]
    surface = sphere(radius, 4)
    hull = mesh_shaped(surface, (4, 4), mass / density, specific_weight=density * gravity)
    boat = Boat(mass, replace(hull, panels=surface), [0.3 * mass * radius ** 2] * 3, undamped(),
                (0.0, 0.0, center), gravity)
    # The sphere of flat faces is smaller by about the square of an edge over the radius.
    smaller = (surface.longest_edge / radius) ** 2 / 4.0
    assert density * gravity * np.pi * radius ** 2 == pytest.approx(stiffness, rel=2e-3)
    for more in (0.0, added):
        heavy = replace(boat, added_mass=[0.0, 0.0, more, 0.0, 0.0, 0.0])
        period = 2.0 * np.pi * np.sqrt((mass + more) / stiffness)
        if not more:
            assert period == pytest.approx(dry, abs=0.001)
        mode = modes(heavy)['heave']
        assert mode.period == pytest.approx(period, rel=smaller)
        # By a thousandth of the radius out of balance: the waterplane is even in it.
        rest = rest_state(heavy)
        time, states = simulate(heavy, State(rest.position + [0.0, 0.0, 1e-3 * radius]),
                                3.3 * period, rate=100.0 / period)
        up = crossings(time, states.position[:, 2] - rest.position[2], states.velocity[:, 2],
                       rising=True)
        # Leapfrog turns too fast by (w h)^2 / 24.
        assert np.diff(up) == pytest.approx(mode.period, rel=3e-4)


# And where there is none.

@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_zeros_and_hydrostatic_lift_are_the_same_to_the_bit_as_nothing_given(integrator):
    base = {'sea.waves': [0.1, 3.0, 0.4, 0.0], 'sea.current': [0.3, -0.1], 'rate': 50.0,
            'integrator': integrator, 'substeps': 2, 'start.position': [0.0, 0.0, 0.5],
            'start.orientation': [0.3, -0.2, 0.5]}
    ends = []
    for given in ({}, {'added_mass': [0.0] * 6, 'wave_force': 'hydrostatic'}):
        sim = load_scene({**base, **given}).simulation()
        sim.run(4.0, (300.0, 0.0, 0.0, 0.0, 0.0, 50.0))
        ends.append(sim.state)
    assert same(*ends)
