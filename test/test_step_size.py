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

"""
The largest stable steps are those of the closed forms, and of the shipped code when it runs.

u = omega h; zeta the damping ratio, 1 is critical.
"""

from boat_buoyancy.physics.boat.boat import Boat, Damping
from boat_buoyancy.physics.boat.hull import Hull, LAWS
from boat_buoyancy.physics.boat.state import State
from boat_buoyancy.physics.hydrostatics.natural_modes import (
    highest_damping_rate, highest_frequency, modes)
from boat_buoyancy.physics.rotation import from_roll_pitch_yaw
from boat_buoyancy.physics.sea.waves import Sea
from boat_buoyancy.physics.step_size import limits
from boat_buoyancy.physics.step_size.balance import at_rest, without_damping
from boat_buoyancy.physics.step_size.limits import (
    combined_step, is_stable, max_stable_steps, step_jacobian, step_limit)
from boat_buoyancy.physics.step_size.plan import plan
from boat_buoyancy.physics.stepping.simulation import Simulation, SimulationError
from boat_buoyancy.tools.chart.stability_map import bobbing_boat
from boats import asymmetric_boat, HEAVE, INTEGRATORS, reference_boat, SQUARE, undamped
import numpy as np
import pytest
from random_boats import draw

# Roll is the fastest of the reference boat: omega^2 = 19620 / 500.
ROLL = np.sqrt(19620.0 / 500.0)
# The stability limits of undamped oscillation, as u; None without limit, 0 never stable.
OSCILLATION = {'leapfrog': 2.0, 'implicit': None, 'rk4': 2.0 * np.sqrt(2.0),
               'symplectic_euler': 2.0, 'euler': 0.0}
# Of pure damping, as rate times h: rk4 is where 1 + z + z^2/2 + z^3/6 + z^4/24 is 1 again.
DAMPING = {'leapfrog': None, 'implicit': None, 'rk4': 2.785293563, 'symplectic_euler': 2.0,
           'euler': 2.0}


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


def approximately(value):
    """Return a limit to compare with: to the precision that it is searched with and its own."""
    return value if value is None else pytest.approx(value, rel=1e-5)


def growth(boat, integrator, h):
    """Return the spectral radius of one step in heave alone."""
    heave = np.ix_([0, 5], [0, 5])
    return np.abs(np.linalg.eigvals(step_jacobian(at_rest(boat), integrator, h)[heave])).max()


def swings_wider(boat, integrator, h, steps):
    """Return whether a nudge in heave, roll and pitch grows a thousandfold when it is run."""
    balance, nudge = at_rest(boat), 1e-7
    start = State(balance.state.position + [0.0, 0.0, nudge * balance.shallow],
                  np.array(from_roll_pitch_yaw(nudge, nudge, 0.0)))
    simulation = Simulation(balance.boat, Sea(), start, rate=1.0 / h, integrator=integrator)
    try:
        run = simulation.run(steps * h)
    except SimulationError:
        return True
    heave = (run.position[:, 2] - balance.state.position[2]) / balance.shallow
    size = np.sqrt(heave ** 2 + run.roll ** 2 + run.pitch ** 2)
    return bool(size.max() > 1e3 * nudge)


@pytest.mark.plain
def test_the_limits_of_an_undamped_boat_are_those_of_the_textbook():
    for integrator, limit in max_stable_steps(reference_boat()).items():
        u = OSCILLATION[integrator]
        assert limit == approximately(u and u / ROLL)


@pytest.mark.plain
def test_the_limits_of_pure_drag_are_those_of_the_textbook():
    # -d u with d = 3 1/s on every axis, in water and in air.
    keep = [np.exp(-3.0)]
    boat = reference_boat(damping=Damping(keep, keep, keep, keep))
    for integrator, limit in DAMPING.items():
        assert step_limit(boat, integrator).damping == approximately(limit and limit / 3.0)


def test_the_limit_of_pure_drag_is_that_of_water_or_of_air_whichever_drags_more():
    for damping in (undamped(angular_retention=[1.0, np.exp(-3.0), 1.0]),
                    undamped(air_linear_retention=[1.0, 1.0, np.exp(-3.0)]),
                    undamped(linear=[3.0 * 1000.0, 0.0, 0.0, 0.0, 0.0, 0.0])):
        boat = reference_boat(damping=damping)
        assert step_limit(boat, 'rk4').damping == approximately(DAMPING['rk4'] / 3.0)


def test_the_limit_of_probe_damping_is_that_of_the_axis_that_it_damps_most():
    for axis in range(3):
        probe = np.where(np.arange(3) == axis, 3000.0, 1000.0)
        boat = reference_boat(damping=undamped(probe=probe), positions=[[0.0, 0.0, 0.0]])
        assert step_limit(boat, 'rk4').damping == approximately(DAMPING['rk4'] / 3.0)
    # Surge, a metre to the side: yaw of 900 kg m^2 is damped more.
    boat = reference_boat(damping=undamped(probe=[3000.0, 0.0, 0.0]))
    assert step_limit(boat, 'rk4').damping == approximately(DAMPING['rk4'] / (3000.0 / 900.0))


@pytest.mark.parametrize('integrator, ratio, limit', [
    # 2 / sqrt(1 - zeta^2); never from critical damping on.
    ('leapfrog', 0.6, 2.5), ('leapfrog', 1.1, None),
    # 2 zeta below critical damping, 2 / (zeta + sqrt(zeta^2 - 1)) above.
    ('euler', 0.5, 1.0), ('euler', 1.25, 1.0),
    # u^2 + 4 zeta u = 4.
    ('symplectic_euler', 0.75, 1.0),
    # Far above critical damping the drag's own.
    ('rk4', 1.25, 2.785293563 / 2.0), ('implicit', 0.5, None), ('implicit', 3.0, None)])
def test_damping_shifts_the_limit_as_the_closed_form_says(integrator, ratio, limit):
    assert combined_step(bobbing_boat(ratio), integrator) == approximately(limit)


@pytest.mark.parametrize('drag', [0.9, 1.1, 1.9])
def test_the_plain_game_loop_is_stable_until_its_drag_turns_the_velocity_round(drag):
    # d h < 1, not 2: by then 1 - d h is negative and every spring pushes the wrong way.
    d = drag / 0.3
    boat = bobbing_boat(retention=np.exp(-d))
    assert combined_step(boat, 'symplectic_euler') == approximately(1.0 / d)
    assert is_stable(at_rest(boat), 'symplectic_euler', 0.3) == (drag < 1.0)


@pytest.mark.parametrize('drag, published', [
    (0.9, '0.99913'), (1.0, '1.00000'), (1.1, '1.00071'), (1.5, '1.00262'), (1.9, '1.00372'),
    (2.1, '1.0955'), (3.0, '1.98955')])
def test_the_plain_game_loop_grows_by_its_drag_as_published(drag, published):
    boat = bobbing_boat(retention=np.exp(-drag / 0.0886))
    last_digit = 10.0 ** -len(published.partition('.')[2])
    assert growth(boat, 'symplectic_euler', 0.0886) == pytest.approx(
        float(published), abs=0.5 * last_digit)


def test_without_a_spring_the_plain_game_loop_multiplies_the_speed_by_one_minus_drag():
    for drag in (0.9, 1.1, 3.0):
        boat = reference_boat(damping=undamped(air_linear_retention=[np.exp(-drag * 50.0)]))
        simulation = Simulation(
            boat, Sea(), State(position=(0.0, 0.0, 1e6), velocity=(1.0, 0.0, 0.0)), rate=50.0,
            integrator='symplectic_euler')
        simulation.step()
        assert simulation.state.velocity[0] == pytest.approx(1.0 - drag, abs=1e-12)


def test_an_undamped_heave_grows_by_euler_as_the_root_of_1_and_u_squared():
    for u in (0.01, 0.1, 1.0):
        assert growth(bobbing_boat(), 'euler', u) == pytest.approx(np.hypot(1.0, u), rel=1e-9)


@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_the_shipped_step_swings_wider_just_past_its_limit_and_not_just_below(integrator):
    # What grows slowest past its limit is euler: by 1 % of (2 zeta)^2 / 2 a step.
    steps = 30000 if integrator == 'euler' else 1500
    seen = 0
    for seed in range(12):
        boat = upright_boat(seed, LAWS[seed % 3])
        limit = combined_step(boat, integrator)
        if limit is None:
            # As far as it has none, a step of many radians is as good as a short one.
            for u in (0.1, 1.0, 3.0, 30.0):
                assert not swings_wider(boat, integrator, u / highest_frequency(boat), 300)
        else:
            seen += 1
            assert not swings_wider(boat, integrator, 0.99 * limit, steps)
            assert swings_wider(boat, integrator, 1.01 * limit, steps)
    assert (seen > 0) == (integrator != 'implicit')


@pytest.mark.parametrize('height, width', [(-0.3, 1.0), (0.0, 1.0), (2.0, 0.3)])
def test_implicit_stays_at_rest_at_any_step_hung_below_its_probes_too(height, width):
    boat = reference_boat(positions=SQUARE * width + [0.0, 0.0, height])
    assert combined_step(boat, 'implicit') is None
    for h in (0.01, 0.1, 1.0, 10.0):
        assert not swings_wider(boat, 'implicit', h, 200)


@pytest.mark.plain
def test_limits_of_random_boats_are_those_of_their_fastest_mode():
    # Drawn with any inertia, hull and law; thin ones, capsizing ones and sinking ones among them.
    for seed in range(32):
        boat = draw(seed).boat
        free = at_rest(without_damping(boat))
        found = [mode.angular_frequency for mode in modes(free.boat).values()
                 if mode.angular_frequency] if boat.floatiness > 1.0 else []
        for integrator, u in OSCILLATION.items():
            if u and found:
                assert is_stable(free, integrator, 0.99 * u / max(found))
                assert not is_stable(free, integrator, 1.01 * u / max(found))
        for h in (1e-3, 1.0, 1e3):
            assert is_stable(at_rest(boat), 'implicit', h)
        if highest_frequency(boat) > 0.0:
            # Crank-Nicolson: whatever the damping.
            assert is_stable(at_rest(boat), 'leapfrog', 0.5 / highest_frequency(boat))


def test_a_boat_that_falls_over_by_itself_gives_no_step_limit_for_it():
    boat = reference_boat(positions=SQUARE * [1.0, 1.0 / np.sqrt(3.0), 0.0] - [0.0, 0.0, 0.7])
    assert at_rest(boat).falling == pytest.approx(np.sqrt((6867.0 - 6540.0) / 500.0), rel=1e-6)
    for integrator, limit in max_stable_steps(boat).items():
        u = OSCILLATION[integrator]
        assert limit == approximately(u and u / HEAVE)


def test_a_boat_that_sinks_swings_as_a_pendulum_under_its_lift():
    # 0.7 of the weight, 0.3 m above the centre of mass, all the way down.
    boat = reference_boat(floatiness=0.7, positions=SQUARE + [0.0, 0.0, 0.3])
    swing = np.sqrt(0.7 * 9810.0 * 0.3 / 500.0)
    assert combined_step(boat, 'leapfrog') == approximately(2.0 / swing)
    # On a level with it nothing swings, and nothing limits any step.
    flat = reference_boat(floatiness=0.7)
    assert set(max_stable_steps(flat).values()) == {None}


def test_a_single_probe_limits_by_its_heave_alone():
    boat = reference_boat(positions=[[0.0, 0.0, 0.0]])
    assert combined_step(boat, 'leapfrog') == approximately(2.0 / HEAVE)
    assert combined_step(boat, 'implicit') is None


def test_a_boat_that_lists_is_looked_at_as_it_lies():
    # Where it is not at rest, products of inertia would make it flutter.
    boat = without_damping(asymmetric_boat())
    fastest = max(mode.angular_frequency for mode in modes(boat).values())
    assert abs(at_rest(boat).state.roll) > 0.01
    assert combined_step(boat, 'leapfrog') == approximately(2.0 / fastest)
    assert combined_step(boat, 'implicit') is None


@pytest.mark.parametrize('law', ['spring', 'column'])
def test_probes_that_are_just_full_or_just_dry_at_rest_are_no_reason_to_refuse(law):
    # The two lower probes carry the weight when they are full, with the upper two in the surface.
    positions = SQUARE + np.outer(SQUARE[:, 0] * SQUARE[:, 1], [0.0, 0.0, -0.25])
    boat = Boat(1000.0, Hull(positions, [4905.0] * 4, [0.5] * 4, law), [500.0, 700.0, 900.0],
                undamped())
    assert combined_step(boat, 'implicit') is None
    # Between what all four in the water give, and two of them.
    assert 2.0 / highest_frequency(boat) * 0.999 < combined_step(boat, 'leapfrog')
    for integrator in INTEGRATORS:
        assert plan(boat, integrator=integrator, rate=20.0).integrator == integrator


@pytest.mark.plain
def test_a_hull_of_many_probes_is_stepped_as_one_of_few(monkeypatch):
    # So many that the step is compiled for it, where Numba is installed.
    places = np.linspace(-1.0, 1.0, 15)
    positions = np.stack([*np.meshgrid(places, places), np.zeros((15, 15))], axis=-1)
    balance = at_rest(reference_boat(positions=positions.reshape(-1, 3)))
    # Either's round-off, over a displacement of 6e-6.
    compiled = step_jacobian(balance, 'leapfrog', 0.1)
    monkeypatch.setattr(limits, 'MANY_PIECES', 1000)
    assert compiled == pytest.approx(step_jacobian(balance, 'leapfrog', 0.1), abs=1e-9)


def test_substeps_are_chosen_by_the_rule_and_are_stable():
    for seed in range(8):
        boat = upright_boat(seed)
        omega, damping = highest_frequency(boat), highest_damping_rate(boat)
        for rate in (10.0, 60.0):
            calm = np.ceil(omega / rate / 0.5)
            assert plan(boat, integrator='leapfrog', rate=rate).substeps == calm
            assert plan(boat, integrator='implicit', rate=rate).substeps == 1
            for integrator in ('rk4', 'symplectic_euler', 'euler'):
                chosen = plan(boat, integrator=integrator, rate=rate).substeps
                assert chosen >= max(calm, np.ceil(damping / rate / 2.0))
                if integrator != 'euler':
                    assert 1.0 / (rate * chosen) < combined_step(boat, integrator)


def test_stiffness_and_damping_together_can_ask_for_more_substeps_than_either():
    # u^2 + 4 zeta u = 4 with zeta = 2 is u = .472; the rules alone give u = .5.
    boat = bobbing_boat(2.0)
    assert plan(boat, integrator='symplectic_euler', rate=2.0).substeps == 2
    assert plan(boat, integrator='rk4', rate=2.0).substeps == 1


def test_a_boat_beyond_64_substeps_is_stepped_by_implicit_and_told_so():
    stiff = reference_boat(floatiness=4.0, positions=SQUARE, inertia=[0.05, 0.05, 0.06])
    chosen = plan(stiff, integrator='leapfrog', rate=5.0)
    assert (chosen.integrator, chosen.substeps) == ('implicit', 1)
    needed = int(np.ceil(np.sqrt(19620.0 / 0.05) / 5.0 / 0.5))
    assert f'leapfrog would need {needed} substeps at 5 Hz' in chosen.warnings[0]
    assert 'implicit with one step' in chosen.warnings[0]


@pytest.mark.plain
@pytest.mark.parametrize('integrator, limit', [
    ('leapfrog', 0.3193), ('symplectic_euler', 0.3193), ('rk4', 0.4515)])
def test_substeps_that_break_a_limit_are_refused_with_the_limit_and_what_to_do(
        integrator, limit):
    boat = reference_boat()
    with pytest.raises(ValueError) as refused:
        plan(boat, integrator=integrator, rate=2.0, substeps=1)
    assert str(refused.value).startswith('substeps: 1 at 2 Hz is a step of 0.5 s')
    assert f'unstable from {limit} s on' in str(refused.value)
    assert 'give 7 substeps or more' in str(refused.value)
    assert '\n' not in str(refused.value)
    allowed = plan(boat, integrator=integrator, rate=2.0, substeps=1, allow_unstable=True)
    assert (allowed.integrator, allowed.substeps) == (integrator, 1)
    assert 'too long' in allowed.warnings[0]


def test_the_plain_game_loop_refuses_a_drag_that_turns_the_velocity_round():
    # Only in air: d = 12 1/s, so 1 - d h is below 0 from h = 1/12 s on.
    boat = reference_boat(damping=undamped(air_linear_retention=[np.exp(-12.0)]))
    with pytest.raises(ValueError, match='unstable from 0.08333 s on'):
        plan(boat, integrator='symplectic_euler', rate=10.0, substeps=1)
    assert plan(boat, integrator='symplectic_euler', rate=10.0).substeps == 2
    assert plan(boat, integrator='leapfrog', rate=10.0, substeps=1).substeps == 1


def test_a_drag_in_air_that_explodes_is_refused_by_rk4_and_euler():
    # 2.785 / 30 and 2 / 30 are less than a step of 0.1 s, which water alone would allow.
    boat = reference_boat(damping=undamped(air_linear_retention=[np.exp(-30.0)]))
    for integrator, limit in (('rk4', '0.09284'), ('euler', '0.06667')):
        with pytest.raises(ValueError, match=f'unstable from {limit} s on'):
            plan(boat, integrator=integrator, rate=10.0, substeps=1)


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
    sentence, = plan(reference_boat(damping=undamped(probe=10.0 * critical))).warnings
    assert sentence.startswith('Probe damping is 10 times critical in heave')
    assert f'at most {critical:.4g} N s/m' in sentence
    assert plan(reference_boat(damping=undamped(probe=critical))).warnings == ()


@pytest.mark.parametrize('options, expected', [
    ({'integrator': 'verlet'}, "integrator: expected one of leapfrog, .*got 'verlet'"),
    ({'rate': 0.0}, 'rate: expected a finite number above 0, got 0.0'),
    ({'substeps': -1}, 'substeps: expected an integer of at least 0, got -1'),
    ({'substeps': 2.5}, 'substeps: expected an integer of at least 0, got 2.5')])
def test_a_plan_says_what_is_wrong_with_its_input(options, expected):
    with pytest.raises(ValueError, match=expected):
        plan(reference_boat(), **options)
