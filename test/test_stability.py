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

"""Periods, damping ratios and step limits are what the shipped code does when it runs."""

from boat_buoyancy.physics.boat import Boat, Damping, State
from boat_buoyancy.physics.hull import box_hull, Hull, LAWS
from boat_buoyancy.physics.hydrostatics import rest_state
from boat_buoyancy.physics.quaternion import from_roll_pitch_yaw, to_roll_pitch_yaw
from boat_buoyancy.physics.simulation import Simulation, SimulationError
from boat_buoyancy.physics.stability import (damping_warnings, equilibrium_stiffness,
                                             highest_damping_rate, highest_frequency,
                                             max_stable_steps, modes, plan, step_limit)
from boat_buoyancy.physics.waves import Sea
from boats import (asymmetric_boat, box_boat, crossings, HEAVE, METHODS, reference_boat, run,
                   simulate, SQUARE, undamped)
import numpy as np
import pytest
from textbook import wrench

RELATIVE = 1e-2


def upright_boat(seed, law='spring'):
    """Return a random boat that floats level and upright; even seeds hang below their probes."""
    random = np.random.default_rng(seed)
    mass, size = 10.0 ** random.uniform(1, 4), 10.0 ** random.uniform(-0.3, 1)
    x, y = random.uniform(0.4, 0.6) * size, random.uniform(0.2, 0.5) * size
    z = random.uniform(0.1, 0.6) * size * (1 if seed % 2 == 0 else -0.05)
    floatiness, height = random.uniform(1.5, 4.0), size * random.uniform(0.05, 0.2)
    positions = SQUARE * [x, y, 0.0] + [0.0, 0.0, z]
    hull = Hull(positions, [0.25 * floatiness * mass * 9.81] * 4, [height] * 4, law)
    rate = np.exp(-random.uniform(0.02, 0.5, (2, 3)))
    heave = np.sqrt(9.81 * floatiness / height)
    damping = Damping(rate[0], rate[1], probe=mass * heave * random.choice([0.2, 1.0, 8.0]))
    return Boat(mass, hull, mass * size**2 * np.array([0.06, 0.1, 0.14]), damping)


def step_matrix(boat, integrator, h):
    """
    Return the Jacobian (9, 9) of one step of the shipped code about rest.

    By central differences of heave, roll, pitch and the six velocities: one fleet, one step.
    """
    # Small enough that a long drift, too, stays where the water is a spring.
    size = 1e-6 / np.array([1.0] * 3 + [max(1.0, h)] * 6)
    nudges = np.vstack([np.diag(size), -np.diag(size)])
    rest = rest_state(boat)
    orientation = np.stack(from_roll_pitch_yaw(nudges[:, 1], nudges[:, 2], 0.0), axis=-1)
    position = np.zeros((18, 3))
    position[:, 2] = rest.position[2] + nudges[:, 0]
    simulation = Simulation(boat, Sea(), State(position, orientation, nudges[:, 3:6],
                                               nudges[:, 6:]), rate=1.0 / h,
                            integrator=integrator)
    simulation.step()
    state = simulation.state
    roll, pitch, _ = to_roll_pitch_yaw(tuple(state.orientation.T))
    after = np.column_stack([state.position[:, 2], roll, pitch, state.velocity,
                             state.angular_velocity])
    return (after[:9] - after[9:]).T / (2.0 * size)


def measured_growth(boat, integrator, h):
    """Return by how much one step of the shipped code multiplies what grows fastest."""
    return np.abs(np.linalg.eigvals(step_matrix(boat, integrator, h))).max()


def measured_limit(boat, integrator, near):
    """Return by bisection between near/3 and 3 near the step at which the code turns unstable."""
    stable, unstable = near / 3.0, 3.0 * near
    assert measured_growth(boat, integrator, stable) < 1.0 + 1e-7
    assert measured_growth(boat, integrator, unstable) > 1.0 + 1e-7
    while unstable - stable > 1e-3 * stable:
        middle = 0.5 * (stable + unstable)
        if measured_growth(boat, integrator, middle) > 1.0 + 1e-7:
            unstable = middle
        else:
            stable = middle
    return stable


def stays_at_rest(boat, integrator, h, *, steps=500):
    """Return whether heave, roll and pitch of a millionth, one boat each, stay that small."""
    rest, size = rest_state(boat), 1e-6
    orientation = np.stack(from_roll_pitch_yaw(
        np.array([0.0, size, 0.0]), np.array([0.0, 0.0, size]), 0.0), axis=-1)
    start = State(rest.position + np.array([[0.0, 0.0, size], [0.0] * 3, [0.0] * 3]), orientation)
    simulation = Simulation(boat, Sea(), start, rate=1.0 / h, integrator=integrator)
    for _ in range(steps):
        try:
            simulation.step()
        except SimulationError:
            return False
        if np.abs(simulation.state.velocity[:, 2]).max() > 1e-4 * HEAVE or np.abs(
                simulation.state.angular_velocity).max() > 1e-4 * HEAVE:
            return False
    return True


@pytest.mark.parametrize('integrator', METHODS)
@pytest.mark.parametrize('seed', range(12))
def test_the_shipped_code_turns_unstable_where_predicted(integrator, seed):
    boat = upright_boat(seed, LAWS[seed % 3])
    predicted = max_stable_steps(boat)[integrator]
    if predicted is None:
        for angle in (0.1, 1.0, 3.0, 10.0, 30.0):
            h = angle / highest_frequency(boat)
            assert measured_growth(boat, integrator, h) < 1.0 + 1e-7
    else:
        assert measured_limit(boat, integrator, predicted) == pytest.approx(
            predicted, rel=RELATIVE)


@pytest.mark.parametrize('height', [-0.3, 0.0, 1.0])
@pytest.mark.parametrize('integrator', ['leapfrog', 'rk4', 'symplectic_euler'])
def test_an_undamped_boat_starts_to_shake_within_a_hundredth_of_its_limit(integrator, height):
    boat = reference_boat(positions=SQUARE + [0.0, 0.0, height])
    limit = max_stable_steps(boat)[integrator]
    assert stays_at_rest(boat, integrator, 0.99 * limit)
    assert not stays_at_rest(boat, integrator, 1.01 * limit)


@pytest.mark.parametrize('height, width', [(-0.3, 1.0), (0.0, 1.0), (1.0, 1.0), (2.0, 0.3)])
def test_implicit_stays_at_rest_at_any_step_hung_below_its_probes_too(height, width):
    boat = reference_boat(positions=SQUARE * width + [0.0, 0.0, height])
    assert max_stable_steps(boat)['implicit'] is None
    for h in (0.01, 0.1, 1.0, 10.0):
        assert stays_at_rest(boat, 'implicit', h, steps=200)


def test_the_limits_of_an_undamped_boat_are_those_of_the_textbook():
    # Roll is the fastest of the reference boat: omega^2 = 19620 / 500.
    fastest = np.sqrt(19620.0 / 500.0)
    limits = max_stable_steps(reference_boat())
    assert limits['leapfrog'] == pytest.approx(2.0 / fastest, rel=1e-5)
    assert limits['symplectic_euler'] == pytest.approx(2.0 / fastest, rel=1e-5)
    assert limits['rk4'] == pytest.approx(2.0 * np.sqrt(2.0) / fastest, rel=1e-5)
    assert limits['implicit'] is None
    assert limits['euler'] == 0.0


def test_a_pure_drag_limits_each_method_as_in_the_textbook():
    # -d u with d = 3 1/s on every axis, in water and in air.
    keep = [np.exp(-3.0)]
    boat = reference_boat(damping=Damping(keep, keep, keep, keep))
    assert step_limit(boat, 'leapfrog').damping is None
    assert step_limit(boat, 'implicit').damping is None
    assert step_limit(boat, 'rk4').damping == pytest.approx(2.785293563 / 3.0, rel=1e-5)
    assert step_limit(boat, 'euler').damping == pytest.approx(2.0 / 3.0, rel=1e-5)


def test_explicit_euler_needs_steps_below_two_zeta_over_omega():
    boat = reference_boat(damping=undamped(probe=1771.776))
    # Heave alone: damping ratio 0.2; |1 + h g| = 1 at h = 2 zeta / omega.
    assert modes(boat)['heave'].damping_ratio == pytest.approx(0.2, rel=1e-5)
    heave_limit = 2.0 * 0.2 / HEAVE
    assert max_stable_steps(boat)['euler'] <= heave_limit * (1.0 + 1e-9)
    assert stays_at_rest(boat, 'euler', 0.9 * max_stable_steps(boat)['euler'])


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('boat_of', [asymmetric_boat, lambda law: upright_boat(4, law)])
def test_the_stiffness_at_rest_is_the_slope_of_the_force(law, boat_of):
    boat = boat_of(law)
    rest, size = rest_state(boat), 1e-6
    measured = np.zeros((6, 6))
    for column in range(6):
        force = []
        for sign in (1.0, -1.0):
            nudge = sign * size * np.eye(6)[column]
            orientation = np.array(from_roll_pitch_yaw(*nudge[3:]))
            push, twist = wrench(boat, Sea(), 0.0, rest.position + nudge[:3], orientation,
                                 np.zeros(3), np.zeros(3))
            force.append(np.concatenate([push, twist]))
        measured[:, column] = (force[1] - force[0]) / (2.0 * size)
    expected = equilibrium_stiffness(boat)
    # The symmetric part in heave, roll and pitch: a list that is not in equilibrium adds more.
    block = measured[2:5, 2:5]
    assert expected[2:5, 2:5] == pytest.approx(0.5 * (block + block.T), rel=1e-5, abs=0.5)
    assert not expected[:2].any() and not expected[5].any()


def test_roll_of_the_reference_case_takes_its_published_period():
    arm = 1.0 / np.sqrt(3.0)
    boat = reference_boat(positions=SQUARE * [1.0, arm, 0.0] + [0.0, 0.0, -0.3])
    assert equilibrium_stiffness(boat)[3, 3] == pytest.approx(3597.0, rel=1e-9)
    assert modes(boat)['roll'].period == pytest.approx(2.34258119, rel=1e-8)
    assert modes(boat)['heave'].period == pytest.approx(1.41850335, rel=1e-8)


def test_a_boat_that_capsizes_has_no_roll_period_and_gives_no_step_limit_for_it():
    arm = 1.0 / np.sqrt(3.0)
    boat = reference_boat(positions=SQUARE * [1.0, arm, 0.0] + [0.0, 0.0, -0.7])
    roll = modes(boat)['roll']
    assert (roll.angular_frequency, roll.period, roll.damping_ratio) == (None, None, None)
    assert modes(boat)['heave'].period == pytest.approx(1.41850335, rel=1e-8)
    pitch = np.sqrt((19620.0 - 9810.0 * 0.7) / 700.0)
    assert modes(boat)['pitch'].angular_frequency == pytest.approx(pitch, rel=1e-9)
    assert max_stable_steps(boat)['leapfrog'] == pytest.approx(2.0 / HEAVE, rel=1e-5)


def test_the_barge_heaves_as_published():
    hull = box_hull((4.0, 2.0, 1.0), -0.5, (2, 2), specific_weight=1000.0 * 9.81)
    inertia = 2000.0 / 12.0 * np.array([5.0, 17.0, 20.0])
    assert modes(Boat(2000.0, hull, inertia, undamped()))['heave'].period == pytest.approx(
        1.0030, abs=5e-5)


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
    alone = modes(reference_boat())
    assert set(found) == set(alone) == {'heave', 'roll', 'pitch'}
    assert found['heave'].angular_frequency == pytest.approx(HEAVE, rel=0.01)


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


@pytest.mark.parametrize('rate', [10.0, 30.0, 60.0, 100.0])
@pytest.mark.parametrize('seed', range(8))
def test_substeps_are_chosen_by_the_rule_and_are_stable(seed, rate):
    boat = upright_boat(seed)
    omega, damping = highest_frequency(boat), highest_damping_rate(boat)
    calm = np.ceil(omega / rate / 0.5)
    assert plan(boat, integrator='leapfrog', rate=rate).substeps == calm
    assert plan(boat, integrator='implicit', rate=rate).substeps == 1
    for method in ('rk4', 'symplectic_euler'):
        chosen = plan(boat, integrator=method, rate=rate).substeps
        assert chosen >= max(calm, np.ceil(damping / rate / 2.0))
        assert measured_growth(boat, method, 1.0 / (rate * chosen)) < 1.0 + 1e-7
    assert plan(boat, integrator='euler', rate=rate).substeps >= max(
        calm, np.ceil(damping / rate / 2.0))


def test_a_boat_beyond_64_substeps_is_stepped_by_implicit_and_told_so():
    stiff = reference_boat(floatiness=4.0, positions=SQUARE, inertia=[0.05, 0.05, 0.06])
    chosen = plan(stiff, integrator='leapfrog', rate=5.0)
    assert (chosen.integrator, chosen.substeps) == ('implicit', 1)
    needed = int(np.ceil(np.sqrt(19620.0 / 0.05) / 5.0 / 0.5))
    assert f'leapfrog would need {needed} substeps at 5 Hz' in chosen.warnings[0]
    assert 'implicit with one step' in chosen.warnings[0]


def test_substeps_that_break_a_limit_are_refused_with_the_limit_and_what_to_do():
    boat = reference_boat()
    for method, limit in (('leapfrog', 0.3193), ('symplectic_euler', 0.3193), ('rk4', 0.4515)):
        with pytest.raises(ValueError) as refused:
            plan(boat, integrator=method, rate=2.0, substeps=1)
        assert str(refused.value).startswith('substeps: 1 at 2 Hz is a step of 0.5 s')
        assert f'unstable from {limit} s on' in str(refused.value)
        assert 'give 7 substeps or more' in str(refused.value)
        assert '\n' not in str(refused.value)
        allowed = plan(boat, integrator=method, rate=2.0, substeps=1, allow_unstable=True)
        assert (allowed.integrator, allowed.substeps) == (method, 1)
        assert 'too long' in allowed.warnings[0]


def test_the_plain_game_loop_refuses_a_drag_that_turns_the_velocity_round():
    # Only in air: d = 12 1/s, so 1 - d h is below 0 from h = 1/12 s on.
    boat = reference_boat(damping=undamped(air_linear_retention=[np.exp(-12.0)]))
    with pytest.raises(ValueError, match='unstable from 0.08333 s on'):
        plan(boat, integrator='symplectic_euler', rate=10.0, substeps=1)
    assert plan(boat, integrator='symplectic_euler', rate=10.0).substeps == 2
    assert plan(boat, integrator='leapfrog', rate=10.0, substeps=1).substeps == 1


def test_euler_always_warns_and_is_not_refused_for_its_oscillation():
    for options in ({}, {'substeps': 1}):
        chosen = plan(reference_boat(), integrator='euler', rate=60.0, **options)
        assert chosen.integrator == 'euler'
        assert any('study only' in sentence for sentence in chosen.warnings)


def test_a_shallow_boat_is_told_that_it_will_rattle():
    hull = Hull(SQUARE, [9810.0] * 4, [0.016] * 4)
    boat = Boat(1000.0, hull, [1000.0, 1000.0, 1800.0], undamped())
    sentence, = plan(boat, rate=60.0, substeps=1).warnings
    assert sentence.startswith(
        'At 60 Hz this boat will rattle at rest: draft 4 mm, omega h = 0.83')
    assert 'substeps: 2' in sentence and 'implicit' in sentence
    assert plan(boat, rate=60.0).warnings == ()
    assert plan(boat, rate=60.0, substeps=1, integrator='implicit').warnings == ()


def test_probe_damping_far_above_critical_is_told():
    critical = 2.0 * 1000.0 * HEAVE
    sentence, = damping_warnings(reference_boat(damping=undamped(probe=10.0 * critical)))
    assert sentence.startswith('Probe damping is 10 times critical in heave')
    assert f'at most {critical:.4g} N s/m' in sentence
    assert damping_warnings(reference_boat(damping=undamped(probe=critical))) == ()


@pytest.mark.parametrize('options, expected', [
    ({'integrator': 'verlet'}, "integrator: expected one of leapfrog, .*got 'verlet'"),
    ({'rate': 0.0}, 'rate: expected a finite number above 0, got 0.0'),
    ({'substeps': -1}, 'substeps: expected an integer of at least 0, got -1'),
    ({'substeps': 2.5}, 'substeps: expected an integer of at least 0, got 2.5')])
def test_a_plan_says_what_is_wrong_with_its_input(options, expected):
    with pytest.raises(ValueError, match=expected):
        plan(reference_boat(), **options)


@pytest.mark.parametrize('drag, growth', [
    (0.9, 0.99913), (1.0, 1.0), (1.1, 1.00071), (1.5, 1.00262), (1.9, 1.00372), (2.1, 1.0955),
    (3.0, 1.98955)])
def test_the_plain_loop_grows_by_its_drag_as_published(drag, growth):
    # omega h = .0886: the reference boat at 50 Hz.
    boat = reference_boat(damping=undamped(linear_retention=[np.exp(-drag * 50.0)]))
    # Small enough that it meets no kink, long enough that only what grows fastest is left.
    start = State((0.0, 0.0, -0.5 + 1e-9), velocity=(0.0, 0.0, 1e-7))
    simulation = Simulation(boat, Sea(), start, rate=50.0, integrator='symplectic_euler')
    steps = {2.1: 100, 3.0: 18}.get(drag, 400)
    _, states = run(simulation, steps / 50.0)
    size = np.hypot(states.position[:, 2] + 0.5, states.velocity[:, 2] / HEAVE)
    measured = (size[-1] / size[-11]) ** 0.1
    assert measured == pytest.approx(growth, abs=5e-4)
    assert measured == pytest.approx(game_loop_growth(HEAVE / 50.0, drag), rel=1e-4)


def game_loop_growth(angle, drag):
    """Return the spectral radius of v += a h; v *= 1 - drag; x += v h in closed form."""
    kept = 1.0 - drag
    trace = 1.0 + kept - kept * angle**2
    return max(abs((trace + sign * np.emath.sqrt(trace**2 - 4.0 * kept)) / 2.0)
               for sign in (1.0, -1.0))


@pytest.mark.parametrize('drag', [0.9, 1.0, 1.1, 1.5, 1.9, 2.1, 3.0])
def test_without_a_spring_the_plain_loop_multiplies_the_speed_by_one_minus_drag(drag):
    boat = reference_boat(damping=undamped(air_linear_retention=[np.exp(-drag * 50.0)]))
    simulation = Simulation(boat, Sea(), State(position=(0.0, 0.0, 1e6), velocity=(1.0, 0, 0)),
                            rate=50.0, integrator='symplectic_euler')
    simulation.step()
    assert simulation.state.velocity[0] == pytest.approx(1.0 - drag, abs=1e-12)
