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

"""The scenes that ship: each floats, and each step of the idea adds what it says it adds."""

import json
from pathlib import Path
import re

from boat_buoyancy.physics import load_scene, State
from boat_buoyancy.physics.boat.state import body_frame, center_of_mass_state
from boat_buoyancy.physics.hydrostatics.natural_modes import modes
from boat_buoyancy.physics.hydrostatics.rest import draft, rest_state
from boat_buoyancy.physics.rotation import from_roll_pitch_yaw, to_roll_pitch_yaw
from boat_buoyancy.physics.scene import parameter_file
from boat_buoyancy.physics.scene.parameters import PARAMETERS
import numpy as np
import pytest

CONFIG = Path(__file__).parents[1] / 'config'
NAMES = sorted(path.stem for path in CONFIG.glob('*.yaml'))
# One scene is there to be looked at in its own waves.
CALM = [name for name in NAMES if name != 'waves']
STEPS = ['v0_single_probe', 'v1_four_probes', 'v2_budget', 'v3_probe_damping', 'v4_tuned']
RETENTION = {f'damping.{name}_retention'
             for name in ('linear', 'angular', 'air_linear', 'air_angular')}
# Mass over density, waterplane and floatiness, by hand.
DRAFTS = {'default': 2000 / (1025 * 4 * 2), 'v0_single_probe': 1 / (12.0 * 0.4),
          'v1_four_probes': 1 / (12.0 * 0.4), 'v2_budget': 1 / (1.2 * 4.0),
          'v3_probe_damping': 1 / (1.2 * 4.0), 'v4_tuned': 1 / (1.3 * 3.0), 'barge': 1.5,
          'wam_v': 180 / (1025 * 2 * 4.9 * 0.335), 'otter': 80 / (1025 * 0.75)}


def scene_of(name):
    return load_scene(CONFIG / f'{name}.yaml')


def run(sim, seconds, thrust=None, every=5):
    """Return heights and angles (n, 3) after every so many periods."""
    heights, angles = [], []
    for _ in range(round(seconds * sim.rate / every)):
        for _ in range(every):
            sim.step(thrust)
        state = sim.state
        heights.append(state.position[2])
        angles.append(to_roll_pitch_yaw(state.orientation))
    return np.array(heights), np.array(angles)


def placed(scene, *, roll=0.0, pitch=0.0, lift=0.0):
    """Return a simulation with the boat heeled, trimmed or lifted from its rest."""
    orientation = np.array(from_roll_pitch_yaw(roll, pitch, 0.0))
    return scene.simulation(state=State(scene.start.position + [0.0, 0.0, lift], orientation))


def swing(angles):
    """Return the greatest of the last tenth over the greatest of the first tenth."""
    part = len(angles) // 10
    return np.abs(angles[-part:]).max() / np.abs(angles[:part]).max()


def test_the_steps_of_the_idea_and_the_boats_that_are_named_ship():
    assert {*STEPS, 'default', 'barge', 'wam_v', 'waves'} <= set(NAMES)


def test_every_line_of_the_default_file_has_its_unit_and_what_raising_it_changes():
    text = (CONFIG / 'default.yaml').read_text(encoding='utf-8')
    lines = text.splitlines()
    for parameter in parameter_file.parse(text):
        row, = (i for i, line in enumerate(lines)
                if re.match(rf'\s+{parameter.rpartition(".")[2]}: \S', line)
                and belongs(lines, i, parameter))
        above = []
        while lines[row - 1 - len(above)].lstrip().startswith('#'):
            above.insert(0, lines[row - 1 - len(above)].strip().removeprefix('# '))
        known = PARAMETERS[parameter]
        unit = f'[{known.unit}] ' if known.unit else ''
        # In the default file the lines left out stand between.
        assert f'{unit}{known.description}' in ' '.join(above)


def test_the_other_scenes_say_where_that_is_and_why_their_values_are_what_they_are():
    described = [parameter.description for parameter in PARAMETERS.values()]
    for name in set(NAMES) - {'default'}:
        text = (CONFIG / f'{name}.yaml').read_text(encoding='utf-8')
        words = ' '.join(line.strip().removeprefix('# ') for line in text.splitlines())
        assert '# config/default.yaml says what each parameter means.\n/**:\n' in text
        assert not any(description in words for description in described)
        # Its head, and something beside a value, too.
        assert len(re.findall(r'(?m)^# ', text)) >= 3 and re.search(r'(?m)^ +# ', text), name


def belongs(lines, row, parameter):
    """Return True when the line stands in the group of the parameter."""
    group = parameter.rpartition('.')[0]
    opened = [line.strip() for line in lines[:row] if re.fullmatch(r'    [a-z]+:', line)]
    if not lines[row].startswith('      '):
        return not group
    return bool(opened) and opened[-1] == f'{group}:'


def test_no_line_is_longer_than_the_code_allows():
    for name in NAMES:
        lines = (CONFIG / f'{name}.yaml').read_text(encoding='utf-8').splitlines()
        assert max(map(len, lines)) <= 99, name


def test_numbers_have_a_decimal_point_as_ros_wants_them():
    for name in NAMES:
        for parameter, value in parameter_file.read(CONFIG / f'{name}.yaml').items():
            kind = PARAMETERS[parameter].kind
            items = value if isinstance(value, list) else [value]
            if kind.startswith('float'):
                assert all(type(item) is float for item in items), (name, parameter)


@pytest.mark.parametrize('name', CALM)
def test_it_floats_at_its_draft_and_upright_for_a_minute(name):
    scene = scene_of(name)
    sim = scene.simulation()
    if name in DRAFTS:
        assert draft(scene.boat, sim.state) == pytest.approx(DRAFTS[name], rel=1e-9)
    heights, angles = run(sim, 60.0, every=20)
    np.testing.assert_allclose(heights, scene.start.position[2], atol=1e-9)
    # The rigid inflatable lies level to the millimetre that its centre of mass is given to.
    np.testing.assert_allclose(angles - angles[0], 0.0, atol=1e-9)
    np.testing.assert_allclose(angles, 0.0, atol=1e-4 if name == 'rib' else 1e-8)


def test_the_wigley_hull_floats_at_its_draft():
    boat = scene_of('wigley').boat
    assert draft(boat, rest_state(boat)) == pytest.approx(1.25, abs=5e-4)


@pytest.mark.parametrize('name', CALM)
def test_it_comes_through_half_a_minute_of_waves_after_a_drop(name):
    scene = load_scene({**scene_of(name).given, 'sea.sea_state': 2})
    heights, angles = run(placed(scene, lift=0.5), 30.0)
    assert np.abs(heights).max() < 3.0
    # Nothing takes the roll of the first three in waves of their own period.
    if name not in STEPS[:3]:
        assert np.abs(angles[:, :2]).max() < np.radians(45.0)


def test_nothing_is_wrong_with_any_scene_but_what_steps_0_and_3_are_about():
    for name in NAMES:
        warnings = scene_of(name).simulation().warnings
        if name == 'v0_single_probe':
            assert len(warnings) == 2
            assert all(sentence.startswith('Nothing rights the boat in') for sentence in warnings)
        elif name == 'v3_probe_damping':
            sentence, = warnings
            assert sentence.startswith('damping.probe holds the boat back')
        else:
            assert warnings == (), name


def test_the_steps_start_from_the_values_of_the_idea():
    for name in STEPS[2:]:
        values = scene_of(name).values
        assert 1.1 <= values['probes.floatiness'] <= 1.3
        assert 2.0 <= values['probes.stiffness'] <= 10.0
        assert all(0.9 <= part <= 0.98 for part in values['damping.linear_retention'])
        assert all(0.8 <= part <= 0.95 for part in values['damping.angular_retention'])
        assert len(values['probes.positions']) == 12
        assert values['probes.weights'] == (1.0,) * 4
        mass = values['boat.mass']
        assert all(mass <= moment <= 5.0 * mass for moment in values['boat.inertia'][:3])


@pytest.mark.parametrize('before, after, changed', [
    (0, 1, {'probes.positions', 'probes.weights'}),
    (1, 2, {'probes.floatiness', 'probes.stiffness'} | RETENTION),
    (2, 3, {'damping.probe'}),
    (3, 4, {'boat.center_of_mass', 'boat.inertia', 'probes.floatiness', 'probes.stiffness',
            'damping.linear_retention', 'damping.angular_retention', 'damping.probe'})])
def test_each_step_changes_what_its_head_says_and_nothing_else(before, after, changed):
    old, new = (scene_of(STEPS[step]).values for step in (before, after))
    assert {name for name in new if new[name] != old[name]} == changed
    text = (CONFIG / f'{STEPS[after]}.yaml').read_text(encoding='utf-8')
    head = ' '.join(text.partition('/**:')[0].replace('#', '').split())
    told = re.search(rf'Against v{before}: (.*)\. config/default.yaml says', head)[1]
    patterns = [name.replace('.', r'\.').replace('*', '.*')
                for name in re.split('[,;] ', re.sub(', whose [a-z ]+', '', told))]
    # Weights are as many as probes.
    assert all(any(re.fullmatch(pattern, name) for pattern in patterns)
               for name in changed - {'probes.weights'})
    assert all(any(re.fullmatch(pattern, name) for name in changed) for pattern in patterns)


def test_step_0_bobs_for_ever_and_is_not_righted():
    scene = scene_of(STEPS[0])
    heights, angles = run(placed(scene, roll=0.5, lift=0.1), 60.0)
    assert swing(heights - scene.start.position[2]) == pytest.approx(1.0, rel=1e-3)
    np.testing.assert_allclose(angles[:, 0], 0.5, atol=1e-12)


def test_step_1_floats_as_deep_and_rights_itself_and_swings_for_ever():
    scene = scene_of(STEPS[1])
    assert scene.start.position[2] == pytest.approx(scene_of(STEPS[0]).start.position[2])
    _, angles = run(placed(scene, roll=0.1), 60.0)
    assert angles[:, 0].min() == pytest.approx(-0.1, rel=1e-2)
    assert swing(angles[:, 0]) == pytest.approx(1.0, rel=1e-2)


def test_step_2_rises_with_a_fifth_of_gravity_where_step_1_shoots_up():
    def rise(step):
        """Return the acceleration over g of the first period, let go 3 m down."""
        sim = placed(scene_of(STEPS[step]), lift=-3.0)
        sim.step()
        return sim.state.velocity[2] * sim.rate / 9.81

    assert rise(2) == pytest.approx(0.2, rel=2e-3)
    assert rise(1) == pytest.approx(11.0, rel=1e-9)


def test_step_2_comes_to_rest():
    heights, angles = run(placed(scene_of(STEPS[2]), roll=0.1, lift=0.1), 60.0)
    # The linear retention of 0.95 a second halves the energy's root each 27 s.
    assert swing(heights - scene_of(STEPS[2]).start.position[2]) < 0.95 ** (54.0 / 2) * 1.05
    assert swing(angles[:, 0]) < 0.9 ** (54.0 / 2) * 1.05


def test_step_3_ends_heave_and_roll_within_a_few_swings_and_follows_the_current():
    def after_ten_seconds(step):
        scene = scene_of(STEPS[step])
        heights, angles = run(placed(scene, roll=0.1, lift=0.1), 10.0)
        return (np.abs(heights[-20:] - scene.start.position[2]).max(),
                np.abs(angles[-20:, 0]).max())

    for still, swinging in zip(after_ten_seconds(3), after_ten_seconds(2)):
        assert still < 0.003 and swinging > 0.03

    def carried(step):
        values = parameter_file.read(CONFIG / f'{STEPS[step]}.yaml')
        sim = load_scene({**values, 'sea.current': [1.0, 0.0]}).simulation()
        run(sim, 2.0)
        return sim.state.velocity[0]

    # 1 - exp(-t (c / m - ln 0.95)), c the damping of all probes.
    assert carried(2) == pytest.approx(1.0 - np.exp(2.0 * np.log(0.95)), rel=1e-3)
    assert carried(3) == pytest.approx(1.0 - np.exp(2.0 * np.log(0.95) - 8.0), rel=1e-2)


def test_step_3_stays_upright_in_a_sea_that_rolls_step_2_over():
    def greatest_roll(step):
        values = parameter_file.read(CONFIG / f'{STEPS[step]}.yaml')
        sim = load_scene({**values, 'sea.sea_state': 2, 'sea.direction': 1.57}).simulation()
        return np.abs(run(sim, 60.0)[1][:, 0]).max()

    assert greatest_roll(2) > np.radians(120.0)
    assert greatest_roll(3) < np.radians(45.0)


def test_step_4_rights_itself_from_beyond_90_degrees():
    def comes_back(step):
        _, angles = run(placed(scene_of(STEPS[step]), roll=np.radians(95.0)), 20.0)
        return np.abs(angles[-1, 0]) < 0.1

    assert not comes_back(3)
    assert comes_back(4)


def test_step_4_fills_its_probes_less_often():
    def full(step):
        """Return the part of the time that some probe is full."""
        values = parameter_file.read(CONFIG / f'{STEPS[step]}.yaml')
        scene = load_scene({**values, 'sea.sea_state': 2})
        sim, count = scene.simulation(), 0
        for _ in range(3000):
            sim.step()
            count += (sim.probe_depths >= scene.boat.hull.height).any()
        return count / 3000

    assert full(4) < full(3)


def test_step_4_ends_a_roll_in_half_the_time():
    def decay(step):
        """Return the rate in 1/s at which the swings of a small roll shrink."""
        _, angles = run(placed(scene_of(STEPS[step]), roll=0.02), 4.0, every=1)
        roll = angles[:, 0]
        tops = 1 + np.flatnonzero(np.diff(np.sign(np.diff(roll))))
        return np.log(np.abs(roll[tops[0]] / roll[tops[1]])) / (tops[1] - tops[0]) * 100.0

    def expected(inertia, drag, lift, below, kept):
        """Return the same of roll and sway by hand, the weight ``below`` the probes by so much."""
        mass, weight = 1000.0, 9810.0
        matrix = [[0.0, 1.0, 0.0],
                  [-weight * (lift * 0.25 + below) / inertia,
                   -drag * (0.25 + below ** 2) / inertia + np.log(kept[1]),
                   drag * below / inertia],
                  [0.0, drag * below / mass, -drag / mass + np.log(kept[0])]]
        values = np.linalg.eigvals(matrix)
        return -values[values.imag > 0.0].real[0]

    # Tops are found to a hundredth of a second, within a second or more.
    assert decay(3) == pytest.approx(expected(1250.0, 4000.0, 4.8, 0.0, (0.95, 0.9)), rel=0.01)
    assert decay(4) == pytest.approx(expected(1000.0, 6000.0, 3.9, 0.1, (0.9, 0.8)), rel=0.01)
    assert decay(3) / decay(4) == pytest.approx(0.5, abs=0.05)


def test_step_4_glides_ahead_and_holds_sideways():
    scene = scene_of(STEPS[4])

    def kept(velocity):
        """Return the velocity after a second."""
        sim = scene.simulation(state=State(scene.start.position, velocity=velocity))
        run(sim, 1.0)
        return sim.state.velocity

    # Retention and probe damping; pulling 0.1 m above the centre of mass it trims the boat a bit.
    assert kept([0.1, 0.0, 0.0])[0] == pytest.approx(0.1 * 0.98 * np.exp(-0.1), rel=0.01)
    assert abs(kept([0.0, 0.1, 0.0])[1]) < 0.01


def test_step_4_pitches_more_slowly():
    def zero_crossings(step):
        """Return how often a pitch passes level in ten seconds."""
        values = parameter_file.read(CONFIG / f'{STEPS[step]}.yaml')
        scene = load_scene({**values, 'damping.probe': 0.0})
        _, angles = run(placed(scene, pitch=0.02), 10.0)
        return np.count_nonzero(np.diff(np.sign(angles[:, 1])))

    # The probes' stiffness a metre ahead and astern, and with the ballast 0.1 m below them the
    # weight as a pendulum.
    weight = 1000.0 * 9.81
    before = np.sqrt(weight * 1.2 * 4.0 / 1250.0)
    after = np.sqrt(weight * (1.3 * 3.0 + 0.1) / 2000.0)
    assert zero_crossings(3) == pytest.approx(10.0 * before / np.pi, abs=1.0)
    assert zero_crossings(4) == pytest.approx(10.0 * after / np.pi, abs=1.0)


def test_the_barge_is_20_by_6_by_3_m_with_its_weight_1_8_m_up():
    boat = scene_of('barge').boat
    assert boat.mass == 1025.0 * 20 * 6 * 1.5
    assert boat.center_of_mass[2] - boat.hull.positions[0, 2] == pytest.approx(1.8, rel=1e-15)
    assert boat.hull.max_force.sum() == pytest.approx(1025 * 9.81 * 20 * 6 * 3, rel=1e-14)
    assert len(boat.hull.positions) >= 8


def test_the_barge_rolls_at_the_period_of_its_metacentric_height_and_the_water_it_takes_along():
    still = {name: [1.0] for name in RETENTION} | {
        'damping.probe': 0.0, 'damping.linear': [0.0] * 6}
    scene = load_scene({**parameter_file.read(CONFIG / 'barge.yaml'), **still})
    _, angles = run(placed(scene, roll=0.02), 40.0, every=1)
    roll = angles[:, 0]
    down = np.flatnonzero((roll[:-1] > 0.0) & (roll[1:] <= 0.0))
    crossing = (down + roll[down] / (roll[down] - roll[down + 1])) / 100.0
    inertia = scene.boat.mass / 12.0 * (6.0 ** 2 + 3.0 ** 2) + scene.values['added_mass'][3]
    expected = 2 * np.pi * np.sqrt(inertia / (scene.boat.mass * 9.81 * 0.95))
    assert np.diff(crossing).mean() == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize('name, table', [
    ('barge', 'test/data/bem_barge.json'),
    ('wigley', 'boat_buoyancy/tools/chart/responses/wigley.json')])
def test_added_mass_and_damping_are_those_of_the_boundary_element_method(name, table):
    known = json.loads((CONFIG.parent / table).read_text())
    damping = np.array(known['radiation_damping'])
    damping[3] += known['viscous_roll']
    values = scene_of(name).values
    # Five digits.
    assert values['added_mass'] == pytest.approx(known['added_mass'], rel=5e-5)
    assert values['damping.linear'] == pytest.approx(damping.tolist(), rel=5e-5)
    assert values['wave_force'] == 'froude_krylov'


def test_otter_has_its_published_added_mass_moved_to_the_centre_of_mass():
    boat, origin = scene_of('otter').boat, np.diag([5.5, 82.5, 55.0, 3.336, 17.21, 25.67])
    # Velocity of the origin by that of the centre of mass: v - w x r, for each of the six.
    H = np.eye(6)
    H[:3, 3:] = -np.cross(np.eye(3), boat.center_of_mass).T
    assert boat.added_mass == pytest.approx(np.diag(H.T @ origin @ H), rel=5e-4)


def test_otter_heaves_and_rolls_in_the_time_that_was_published():
    # sqrt(G / M) there: 7.47 and 6.2 rad/s.
    found = modes(scene_of('otter').boat)
    assert found['heave'].period == pytest.approx(0.84, abs=0.005)
    assert found['roll'].period == pytest.approx(1.01, abs=0.005)


def test_wam_v_reaches_its_published_speed_under_500_n():
    sim = scene_of('wam_v').simulation()
    run(sim, 40.0, thrust=[500.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    _, _, velocity, _ = body_frame(sim.boat, sim.state)
    # 100 u + 150 u^2 = 500.
    assert velocity[0] == pytest.approx((-100 + np.sqrt(100 ** 2 + 4 * 150 * 500)) / 300, rel=1e-6)
    assert velocity[0] == pytest.approx(1.5226, abs=5e-5)


def test_wam_v_yaws_as_its_measured_drag_says():
    sim = scene_of('wam_v').simulation()
    run(sim, 30.0, thrust=[0.0, 0.0, 0.0, 0.0, 0.0, 400.0])
    # 800 r + 800 r^2 = 400.
    assert sim.state.angular_velocity[2] == pytest.approx((np.sqrt(3.0) - 1.0) / 2.0, rel=1e-3)


def test_wam_v_has_the_inertia_and_hulls_it_was_published_with():
    boat = scene_of('wam_v').boat
    assert boat.mass == 180.0
    np.testing.assert_array_equal(boat.inertia, np.diag([120.0, 393.0, 446.0]))
    full = 1025.0 * 2 * np.pi * 0.213 ** 2 * 4.9 / 180.0
    assert boat.floatiness == pytest.approx(full, rel=2e-3)
    np.testing.assert_allclose(boat.hull.height, 2 * 0.213, rtol=1e-3)


def test_a_boat_put_in_place_keeps_its_body_frame():
    scene = scene_of('wam_v')
    state = center_of_mass_state(scene.boat, [1.0, 2.0, 0.0], from_roll_pitch_yaw(0.0, 0.0, 1.0))
    np.testing.assert_allclose(body_frame(scene.boat, state)[0], [1.0, 2.0, 0.0], atol=1e-12)
