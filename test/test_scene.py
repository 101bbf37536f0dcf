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

"""Scenes: what is derived from parameters, and what wrong ones are told."""

import math
from pathlib import Path
import pickle
from time import perf_counter

from boat_buoyancy.physics import load_fleet, load_scene, Scene, State
from boat_buoyancy.physics.boat.state import body_frame
from boat_buoyancy.physics.hydrostatics import rest
from boat_buoyancy.physics.scene import scene as scenes
from boat_buoyancy.physics.scene.parameters import PARAMETERS
from boat_buoyancy.physics.scene.scene import scene_from_values
from boat_buoyancy.physics.sea import spectra
from boat_buoyancy.physics.sea.steepness import steepness
from hypothesis import example, given, HealthCheck, settings, strategies as st
import numpy as np
import pytest
from textbook import dispersion

SQUARE = [[1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0]]
TILTED = (0.2, -0.1, 0.7)


def refusal(parameters):
    with pytest.raises(ValueError) as raised:
        load_scene(parameters)
    message = str(raised.value)
    assert '\n' not in message
    return message


def displaced_weight(scene):
    """Return the lift over the weight at the start, from the probe depths alone."""
    hull, depth = scene.boat.hull, scene.simulation().probe_depths
    if hull.law == 'column':
        # Along a heeled column.
        roll, pitch, _ = scene.values['start.orientation']
        depth = depth / (math.cos(roll) * math.cos(pitch))
    share = np.clip(depth / hull.height, 0.0, 1.0)
    return float(np.sum(hull.max_force * share) / scene.boat.weight)


# The default boat.

def test_the_default_boat_floats_at_the_draft_of_archimedes():
    sim = load_scene({}).simulation()
    np.testing.assert_allclose(sim.probe_depths, 2000.0 / (1025.0 * 4.0 * 2.0), rtol=1e-12)


def test_the_default_boat_stays_at_rest():
    scene = load_scene({})
    sim = scene.simulation()
    for _ in range(500):
        sim.step()
    np.testing.assert_allclose(sim.state.position, scene.start.position, atol=1e-12)
    assert scene.warnings == sim.warnings == ()


def test_a_scene_is_made_again_by_its_own_values():
    for parameters in ({}, {'probes.positions': SQUARE, 'boat.mass': 700.0},
                       {'sea.sea_state': 4, 'start.orientation': TILTED, 'probes.law': 'soft'},
                       {'hull.size': [3.0, 1.0, 1.0], 'sea.waves': [0.1, 3.0, 0.0, 1.0]}):
        scene = load_scene(parameters)
        again = load_scene(scene.values)
        assert again.values == scene.values
        assert None not in scene.values.values()
        for field in ('position', 'orientation', 'velocity', 'angular_velocity'):
            assert np.array_equal(getattr(again.start, field), getattr(scene.start, field))
        assert np.array_equal(again.sea.waves, scene.sea.waves)
        assert np.array_equal(again.boat.inertia, scene.boat.inertia)
        assert np.array_equal(again.boat.damping.probe, scene.boat.damping.probe)
        assert np.array_equal(again.boat.hull.max_force, scene.boat.hull.max_force)


def test_values_hold_the_parameters_in_force_and_no_others():
    box = load_scene({}).values
    probes = load_scene({'probes.positions': SQUARE, 'thrusters.names': ['main'],
                         'thrusters.positions': [0.0, 0.0, 0.0]}).values
    thrusters = {name for name in PARAMETERS if name.startswith('thrusters.')}
    assert set(PARAMETERS) - set(box) == {
        'probes.positions', 'probes.weights', 'probes.floatiness', 'probes.stiffness',
        'hull.spacing', 'hull.mesh', 'hull.scale'} | thrusters
    assert set(PARAMETERS) - set(probes) == {name for name in PARAMETERS
                                             if name.startswith('hull.')}


def test_given_holds_what_was_given():
    assert load_scene({'boat.mass': 5, 'rate': None}).given == {'boat.mass': 5.0}


# Forms of the argument.

def test_nested_and_dotted_names_make_the_same_scene():
    nested = {'boat': {'mass': 500.0}, 'probes': {'positions': SQUARE}, 'rate': 50.0}
    dotted = {'boat.mass': 500.0, 'probes.positions': np.ravel(SQUARE), 'rate': 50.0}
    assert load_scene(nested).values == load_scene(dotted).values
    assert load_scene(nested).values == scene_from_values(dotted).values


def test_a_name_given_twice_is_refused():
    assert refusal({'boat': {'mass': 500.0}, 'boat.mass': 500.0}) == 'boat.mass: given twice'


def test_a_file_and_its_path_as_text_make_the_same_scene(tmp_path):
    path = tmp_path / 'scene.yaml'
    path.write_text('/**:\n  ros__parameters:\n    boat:\n      mass: 1.0e+3\n    rate: 50\n'
                    '    use_sim_time: true\n    qos_overrides: {a: 1}\n')
    assert load_scene(path).values == load_scene(str(path)).values == load_scene(
        {'boat.mass': 1000.0, 'rate': 50.0}).values


def test_an_error_in_a_file_names_the_file(tmp_path):
    path = tmp_path / 'scene.yaml'
    path.write_text('/**:\n  ros__parameters:\n    boat.mass: .nan\n')
    assert refusal(path).startswith(f'{path}: boat.mass: expected a finite number')


@pytest.mark.parametrize('text, reason', [
    (None, 'cannot be read: No such file or directory; expected a parameter file'),
    ('/**:\n  ros__parameters:\n    boat: [1.0\n', 'expected YAML, got an error: '),
    ('/**:\n  ros__parameters:\n    rate: "100.0"\n', 'rate: expected a finite number'),
    ('/**:\n  ros__parameters:\n    rate: 1e2\n', 'got 1e2 (line 3): write 100.0'),
    ('/**:\n  ros__parameters:\n    hull.size: [4, 2.0, 1.0]\n', 'write [4.0, 2.0, 1.0]'),
    ('/**:\n  ros__parameters:\n    hull.size: []\n', 'hull.size: expected 3 numbers, got 0'),
    ('/**:\n  ros__parameters:\n    probes.positions: []\n', 'at least one probe, got 0'),
    ('/**:\n  ros__parameters:\n    sea.waves: [[1.0, 2.0, 0.0, 0.0]]\n',
     'sea.waves: expected one flat list'),
    ('boat:\n  ros__parameters:\n    rate: 5.0\n', '"boat_buoyancy:", under it "ros__par'),
    ('/**:\n  ros__parameters:\n    rate: 50.0\nadded_mass: [1.0]\n',
     'added_mass: expected parameters under "ros__parameters:", got one beside'),
    ('/**:\n  rate: 5.0\n', '/**: expected "ros__parameters:" and nothing else under it'),
    ('/a/boat_buoyancy:\n  ros__parameters: {}\n/b/boat_buoyancy:\n  ros__parameters: {}\n',
     'expected the parameters of one boat, got /a/boat_buoyancy, /b/boat_buoyancy'),
    ('', 'got an empty file'),
    (b'\xff\xfe\x00', 'cannot be read: it is not UTF-8 text')])
def test_a_bad_file_gets_one_line(text, reason, tmp_path):
    path = tmp_path / 'scene.yaml'
    if text is not None:
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
    message = refusal(path)
    assert message.startswith(f'{path}: ') and reason in message


def test_a_folder_is_no_parameter_file(tmp_path):
    assert refusal(tmp_path) == (
        f'{tmp_path}: cannot be read: Is a directory; expected a parameter file')


@pytest.mark.parametrize('source', [None, 5, [1.0], b'path'])
def test_something_else_than_a_path_or_dict_is_refused(source):
    assert refusal(source).startswith('scene: expected the path of a parameter file or a dict')


def test_an_empty_list_of_waves_in_a_file_is_flat_water(tmp_path):
    # As `ros2 param dump` writes it.
    path = tmp_path / 'scene.yaml'
    path.write_text('/boat_buoyancy:\n  ros__parameters:\n    sea:\n      waves: []\n')
    assert load_scene(path).sea.is_flat


# Hulls and inertia.

def test_a_solid_box_has_the_inertia_of_the_textbook():
    scene = load_scene({'hull.size': [5.0, 2.0, 1.5], 'boat.mass': 1200.0})
    np.testing.assert_allclose(np.diag(scene.boat.inertia), [
        100.0 * (4.0 + 2.25), 100.0 * (25.0 + 2.25), 100.0 * (25.0 + 4.0)], rtol=1e-14)


def test_probes_estimate_the_inertia_as_mass_times_their_mean_square_distance():
    positions = np.array([[1.0, 0.0, 0.0], [-1.0, 2.0, 0.0], [0.0, -2.0, 3.0]])
    com = np.array([0.1, 0.2, 0.3])
    scene = load_scene({'probes.positions': positions, 'boat.center_of_mass': com,
                        'boat.mass': 30.0})
    expected = 10.0 * sum(np.sum((row - com) ** 2) for row in positions)
    np.testing.assert_allclose(scene.boat.inertia, expected * np.eye(3), rtol=1e-14)


def test_one_probe_at_the_centre_of_mass_has_the_inertia_of_a_ball():
    scene = load_scene({'probes.positions': [0.0, 0.0, 0.0], 'boat.mass': 50.0})
    np.testing.assert_allclose(scene.boat.inertia, 0.4 * 50.0 * 0.1 ** 2 * np.eye(3), rtol=1e-14)


def test_six_numbers_of_inertia_are_a_full_tensor():
    scene = load_scene({'boat.inertia': [4.0, 5.0, 6.0, 0.1, -0.2, 0.3]})
    np.testing.assert_array_equal(scene.boat.inertia, [
        [4.0, 0.1, -0.2], [0.1, 5.0, 0.3], [-0.2, 0.3, 6.0]])


def test_floatiness_of_a_box_is_depth_over_draft():
    boat = load_scene({'hull.size': [20.0, 6.0, 3.0], 'boat.mass': 1025.0 * 20 * 6 * 1.5}).boat
    assert boat.floatiness == pytest.approx(2.0, rel=1e-14)


def test_weights_share_the_budget_and_more_probes_do_not_add_to_it():
    few = load_scene({'probes.positions': [0.0, 0.0, 0.0]}).boat
    many = load_scene({'probes.positions': SQUARE, 'probes.weights': [1, 2, 3, 4]}).boat
    assert few.hull.max_force.sum() == pytest.approx(1.2 * few.weight, rel=1e-14)
    assert many.hull.max_force.sum() == pytest.approx(1.2 * many.weight, rel=1e-14)
    np.testing.assert_allclose(many.hull.share, [0.1, 0.2, 0.3, 0.4], rtol=1e-14)


def test_a_bottom_that_is_not_given_lies_half_the_depth_below_the_origin():
    assert (load_scene({'hull.size': [4.0, 2.0, 3.0]}).boat.hull.positions[:, 2] == -1.5).all()
    assert (load_scene({'hull.bottom': 0.25}).boat.hull.positions[:, 2] == 0.25).all()


def test_the_law_is_spring_for_probes_and_column_for_a_shape_unless_given():
    assert load_scene({}).boat.hull.law == 'column'
    assert load_scene({'probes.positions': SQUARE}).boat.hull.law == 'spring'
    assert load_scene({'probes.law': 'soft'}).boat.hull.law == 'soft'
    assert load_scene({'probes.positions': SQUARE, 'probes.law': 'column'}).boat.hull.law == (
        'column')


def test_gravity_is_that_of_boat_and_waves():
    scene = load_scene({'gravity': 1.62, 'sea.waves': [0.1, 8.0, 0.0, 0.0], 'sea.depth': 0.0})
    assert scene.boat.gravity == scene.sea.gravity == 1.62
    np.testing.assert_allclose(scene.sea.wave_vector[0, 0], (2 * np.pi / 8.0) ** 2 / 1.62)


# Damping.

@pytest.mark.parametrize('parameters', [
    {}, {'boat.mass': 5000.0}, {'probes.positions': SQUARE},
    {'probes.positions': SQUARE, 'probes.floatiness': 3.0, 'probes.law': 'soft'}])
def test_probes_damp_heave_at_0_3_of_critical_unless_given(parameters):
    still = dict.fromkeys(('damping.linear_retention', 'damping.air_linear_retention'), [1.0])
    scene = load_scene({**parameters, **still, 'rate': 500.0})
    rest = scene.start.position[2]
    # Small, so that a soft spring is straight.
    sim = scene.simulation(state=State(scene.start.position + [0.0, 0.0, 1e-4]))
    heights = []
    for _ in range(1500):
        sim.step()
        heights.append(sim.state.position[2] - rest)
    low, high = min(heights), max(heights[np.argmin(heights):])
    # Each half swing of a damped oscillator shrinks by exp(-pi zeta / sqrt(1 - zeta^2)).
    expected = math.exp(-math.pi * 0.3 / math.sqrt(1.0 - 0.09))
    assert high / -low == pytest.approx(expected, rel=2e-3)
    assert -low / 1e-4 == pytest.approx(expected, rel=2e-3)


def test_drag_that_counts_twice_is_warned_of():
    drag = {'damping.linear': [1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
            'damping.quadratic': [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]}
    for more, said in (
            ({'damping.linear_retention': [0.9, 0.9, 0.5]},
             'surge, sway: damping.linear and damping.quadratic on top of '
             'damping.linear_retention,'),
            ({'damping.angular_retention': [0.9]},
             'yaw: damping.linear on top of damping.angular_retention,'),
            ({'damping.probe': [10.0, 0.0, 900.0]},
             'surge, yaw: damping.linear on top of damping.probe,')):
        sentence, = load_scene({**drag, **more}).warnings
        assert sentence.startswith(f'Drag counts twice in {said}')
    # Heave alone is damped once, as are roll and pitch by it.
    for more in ({}, {'damping.probe': [0.0, 0.0, 900.0]}, {'damping.probe': 0.0},
                 {'damping.linear_retention': [1.0, 1.0, 0.5], 'damping.angular_retention': [
                     0.5, 0.5, 1.0]}):
        assert not any('twice' in said for said in load_scene({**drag, **more}).warnings)


def test_a_boat_that_is_given_drag_has_no_other_made_up_in_water():
    for drag in ({'damping.linear': [1.0] * 6}, {'damping.quadratic': [0.0] * 5 + [1.0]}):
        damping = load_scene(drag).boat.damping
        assert not damping.probe.any() and not damping.rates[0].any()
        assert damping.rates[1].all()
        assert load_scene({**drag, 'damping.probe': 7.0}).values['damping.probe'] == (7.0,)
        kept = load_scene({**drag, 'damping.linear_retention': [0.9]}).boat.damping.rates[0]
        np.testing.assert_allclose(kept, [-math.log(0.9)] * 3 + [0.0] * 3)


def test_drag_that_is_given_later_makes_the_boat_that_it_makes_from_the_start():
    steps = [{}, {'damping.linear': [1.0] * 6},
             {'damping.linear': [1.0] * 6, 'damping.linear_retention': [0.8]},
             {'damping.probe': 5.0, 'damping.quadratic': [2.0] * 6}, {'damping.probe': 5.0},
             {'damping.linear': [0.0] * 6}, {}]
    scene = None
    for values in steps:
        scene = scene_from_values(values, scene)
        fresh = load_scene(values)
        assert scene.values == fresh.values and scene.warnings == fresh.warnings
        assert scene.boat.record.tobytes() == fresh.boat.record.tobytes()


def test_the_default_boat_glides_and_one_that_its_probes_hold_back_is_told():
    def speed(values, force):
        run = load_scene(values).simulation().run(60.0, [force, 0.0, 0.0, 0.0, 0.0, 0.0])
        return run.body_velocity[-1, 0]

    # c = 0.01 2 sqrt(K m) over rho g L B, and -m ln 0.95.
    drag = 0.02 * math.sqrt(1025.0 * 9.81 * 8.0 * 2000.0) - 2000.0 * math.log(0.95)
    assert speed({}, 800.0) == pytest.approx(800.0 / drag, rel=1e-3)
    # A push of 1 N/kg against the probes alone.
    held = {'damping.probe': 5000.0, 'damping.linear_retention': [1.0]}
    sentence, = load_scene(held).warnings
    assert f'no faster than {speed(held, 2000.0):.2g} m/s' in sentence
    assert 'damping.probe: [0.0, 0.0, 5000.0]' in sentence
    assert load_scene({'damping.probe': [0.0, 0.0, 5000.0]}).warnings == ()
    # m / c = 0.5 m/s is where it begins.
    assert load_scene({'damping.probe': 4001.0}).warnings
    assert load_scene({'damping.probe': 3999.0}).warnings == ()


def test_what_nothing_looks_at_is_said_and_not_ignored():
    corners = {'probes.positions': [1.0, 1.0, 0.0, 1.0, -1.0, 0.0, -1.0, 1.0, 0.0,
                                    -1.0, -1.0, 0.0]}
    for values, name in (({**corners, 'water_density': 1000.0}, 'water_density'),
                         ({'sea.waves': [0.1, 4.0, 0.0, 0.0], 'sea.direction': 1.0},
                          'sea.direction'), ({'sea.seed': 7}, 'sea.seed'),
                         ({'sea.spreading': 10.0}, 'sea.spreading')):
        sentence, = load_scene(values).warnings
        assert sentence.startswith(f'{name} has no effect: ')
    assert load_scene({'sea.sea_state': 5, 'sea.seed': 7, 'sea.direction': 1.0,
                       'water_density': 1000.0}).warnings == ()


def test_substeps_out_of_range_are_refused_wherever_they_are_given():
    for asked in (100000, -1, 2.5):
        with pytest.raises(ValueError, match='substeps: expected'):
            load_scene({}).simulation(substeps=asked)


# The start.

def test_the_start_is_level_and_at_rest_at_the_origin():
    start = load_scene({}).start
    assert (start.position[:2] == 0.0).all() and (start.orientation == [0, 0, 0, 1]).all()
    assert not start.velocity.any() and not start.angular_velocity.any()


@pytest.mark.parametrize('parameters', [
    {}, {'probes.positions': SQUARE}, {'probes.positions': SQUARE, 'probes.weights': [4, 3, 4, 4]},
    {'start.orientation': TILTED}, {'probes.positions': SQUARE, 'start.orientation': TILTED}])
def test_without_z_the_boat_starts_where_its_lift_is_its_weight(parameters):
    scene = load_scene({**parameters, 'start.position': [3.0, -4.0]})
    assert displaced_weight(scene) == pytest.approx(1.0, rel=1e-9)
    position, *_ = body_frame(scene.boat, scene.start)
    np.testing.assert_allclose(position[:2], [3.0, -4.0], atol=1e-12)


def test_start_values_are_those_of_the_body_frame():
    scene = load_scene({
        'boat.center_of_mass': [0.5, 0.2, -0.3], 'start.position': [1.0, 2.0, 3.0],
        'start.orientation': TILTED, 'start.velocity': [1.0, -2.0, 0.5],
        'start.angular_velocity': [0.1, 0.2, -0.3]})
    position, _, velocity, angular_velocity = body_frame(scene.boat, scene.start)
    np.testing.assert_allclose(position, [1.0, 2.0, 3.0], atol=1e-12)
    np.testing.assert_allclose(velocity, [1.0, -2.0, 0.5], atol=1e-12)
    np.testing.assert_allclose(angular_velocity, [0.1, 0.2, -0.3], atol=1e-12)
    # Roll, pitch, yaw about fixed axes, one after the other.
    x, y, z, w = scene.start.orientation
    nose = [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)]
    roll, pitch, yaw = TILTED
    np.testing.assert_allclose(nose, [math.cos(yaw) * math.cos(pitch),
                                      math.sin(yaw) * math.cos(pitch), -math.sin(pitch)])


@pytest.mark.parametrize('floatiness', [1.0, 0.5])
def test_a_boat_that_does_not_float_starts_full_and_says_so(floatiness):
    scene = load_scene({'probes.positions': SQUARE, 'probes.floatiness': floatiness})
    np.testing.assert_allclose(scene.simulation().probe_depths, 0.25, rtol=1e-12)
    assert len(scene.warnings) == 1 and 'floatiness' in scene.warnings[0]


def test_a_boat_that_does_not_rest_level_starts_as_it_lies_and_says_so():
    scene = load_scene({'boat.center_of_mass': [0.3, 0.0, 0.0]})
    run = scene.simulation().run(5.0)
    assert 0.05 < run.pitch[0] < 0.1 and abs(run.pitch - run.pitch[0]).max() < 1e-9
    assert len(scene.warnings) == 1 and 'The boat does not lie level' in scene.warnings[0]


# The sea.

def test_the_three_kinds_of_sea():
    rows = load_scene({'sea.waves': [0.5, 6.0, 0.1, 0.2]}).sea
    np.testing.assert_array_equal(rows.waves, [[0.5, 6.0, 0.1, 0.2]])
    state = load_scene({'sea.sea_state': 5, 'sea.components': 30, 'sea.direction': 1.0}).sea
    assert len(state.waves) == 30 and (state.waves[:, 2] == 1.0).all()
    assert 4 * np.sqrt(np.sum(state.waves[:, 0] ** 2 / 2)) == pytest.approx(3.25, rel=1e-12)
    given = load_scene({'sea.significant_height': 3.25, 'sea.peak_period': 8.978184435701246,
                        'sea.components': 30, 'sea.direction': 1.0}).sea
    np.testing.assert_allclose(given.waves, state.waves, rtol=1e-12)


def test_no_waves_and_sea_state_0_are_flat_water():
    for parameters in ({}, {'sea.sea_state': 0}, {'sea.waves': []},
                       {'sea.significant_height': 0.0, 'sea.peak_period': 0.0}):
        assert load_scene(parameters).sea.is_flat


def test_depth_and_current_reach_the_sea():
    sea = load_scene({'sea.depth': 10.0, 'sea.current': [0.0, -0.25],
                      'sea.waves': [0.1, 8.0, 0.0, 0.0]}).sea
    assert 2 * np.pi / sea.wave_vector[0, 0] == pytest.approx(70.8984, abs=1e-4)
    np.testing.assert_array_equal(sea.velocity(0.0, 0.0, 2.0)[1], -0.25)


@pytest.mark.parametrize('parameters', [
    {'sea.waves': [0.1, 5.0, 0.0, 0.0], 'sea.sea_state': 3},
    {'sea.waves': [0.1, 5.0, 0.0, 0.0], 'sea.significant_height': 1.0, 'sea.peak_period': 5.0},
    {'sea.sea_state': 3, 'sea.significant_height': 1.0, 'sea.peak_period': 5.0}])
def test_two_kinds_of_waves_at_once_are_refused(parameters):
    assert refusal(parameters).startswith('sea: expected one kind of waves, got sea.')


def test_height_and_period_go_together():
    assert refusal({'sea.significant_height': 1.0}).startswith(
        'sea.peak_period: expected a number above 0 because sea.significant_height is 1')
    # A period alone is the first of two sets while the node runs.
    alone = load_scene({'sea.peak_period': 5.0})
    assert alone.sea.is_flat and 'sea.peak_period has no effect' in alone.warnings[0]


def test_angles_that_look_like_degrees_are_warned_of():
    for parameters in ({'sea.sea_state': 5, 'sea.direction': 90.0},
                       {'sea.waves': [0.1, 5.0, -45.0, 0.0]},
                       {'start.orientation': [0.0, 0.0, 90.0]}):
        (warning,) = load_scene(parameters).warnings
        assert 'looks like degrees' in warning
    assert load_scene({'sea.sea_state': 5, 'sea.direction': 2 * math.pi}).warnings == ()


def test_waves_steeper_than_water_can_be_are_warned_of():
    # Two seconds make 6.245 m of wave, which breaks at a height of a seventh of it.
    assert load_scene({'sea.waves': [0.445, 2.0, 0.0, 0.0]}).warnings == ()
    (warning,) = load_scene({'sea.waves': [0.447, 2.0, 0.0, 0.0]}).warnings
    assert 'steeper than water can be: row 1' in warning


def test_a_sea_steeper_than_seas_are_is_warned_of():
    # Tz = 0.778 Tp = 3.89 s: a significant height of a tenth of 23.6 m.
    for height, said in ((2.33, 0), (2.39, 1)):
        warnings = load_scene({'sea.significant_height': height, 'sea.peak_period': 5.0,
                               'hull.probes': [4, 4]}).warnings
        assert sum('steeper than any sea is' in sentence for sentence in warnings) == said


@pytest.mark.parametrize('components', [1, 5, 100])
def test_a_fully_grown_sea_is_as_steep_in_any_state(components):
    # Hs = 0.21 U^2/g, Tp = 2 pi U / (0.879 g), Tz = 0.778 Tp: 2 pi Hs / (g Tz^2).
    expected = 0.21 * 0.879 ** 2 / (2 * math.pi * 0.778 ** 2)
    for state in (1, 4, 9):
        sea = load_scene({'sea.sea_state': state, 'sea.components': components}).sea
        if components > 1:
            assert steepness(sea) == pytest.approx(expected, rel=2e-3)
        else:
            # A single wave has a height of 2 a, and a is Hs / sqrt(8).
            assert steepness(sea) == pytest.approx(expected / math.sqrt(2.0), rel=2e-3)


@pytest.mark.parametrize('scale', [1.0, 1e-200])
def test_the_steepness_is_height_over_length_in_any_depth_and_current(scale):
    for depth, current in ((0.0, 0.0), (0.0, 1.0), (3.0, 0.0), (3.0, -0.5)):
        length = 2 * math.pi / dispersion(2 * math.pi / 3.0, depth, 9.81, current)
        sea = load_scene({'sea.waves': [0.2 * scale, 3.0, 0.0, 0.0, 0.0, 9.0, 0.0, 0.0],
                          'sea.depth': depth, 'sea.current': [current, 0.0]}).sea
        assert steepness(sea) == pytest.approx(scale * 0.4 / length, rel=1e-9)
        both = load_scene({'sea.waves': [0.2 * scale, 3.0, 0.0, 0.0, 0.2 * scale, 3.0, 0.0, 0.5],
                           'sea.depth': depth, 'sea.current': [current, 0.0]}).sea
        assert steepness(both) == pytest.approx(scale * 0.8 / length, rel=1e-9)
    assert steepness(load_scene({}).sea) == 0.0


# Waves and current.

def test_a_wave_of_the_scene_that_cannot_run_against_its_current_is_refused():
    said = refusal({'sea.waves': [0.1, 5.0, 0.0, 0.0, 0.1, 2.0, 3.0, 0.5],
                    'sea.current': [1.0, 0.0]})
    assert said.startswith('sea.waves: row 2 is [0.1, 2.0, 3.0, 0.5], which cannot run against '
                           '0.99 m/s of sea.current: [1.0, 0.0]; expected a period of at least ')


def test_the_waves_of_an_irregular_sea_that_the_current_stops_are_left_out_and_told_of():
    sea = {'sea.significant_height': 2.0, 'sea.peak_period': 5.0, 'sea.components': 200}
    # On U against them there are no waves beyond g / (4 U), here 1.6 of the peak's frequency.
    against = 9.81 / (4.0 * 1.6 * 2.0 * math.pi / 5.0)
    scene = load_scene({**sea, 'sea.current': [-against, 0.0]})
    assert scene.sea.waves[:, 1].min() == pytest.approx(5.0 / 1.6, rel=0.02)
    edges = np.geomspace(0.3, 100.0, 100001)
    energy = np.append(0.0, np.cumsum(0.5 * (spectra.jonswap(edges[1:]) + spectra.jonswap(
        edges[:-1])) * np.diff(edges)))
    part = 1.0 - np.interp(1.6, edges, energy) / energy[-1]
    assert 1.0 - len(scene.sea.waves) / 200 == pytest.approx(part, abs=1.0 / 200)
    assert scene.sea.significant_height == pytest.approx(2.0 * math.sqrt(1.0 - part), rel=0.005)
    said, = (sentence for sentence in scene.warnings if 'sea.current stops' in sentence)
    left_out = 200 - len(scene.sea.waves)
    assert said.startswith(f'sea.current stops {left_out} of the 200 waves of the irregular sea, '
                           f'{left_out / 200:.0%} of its energy: ')
    # What is left is as it is without the current, and all of it is there where it goes along.
    whole = load_scene(sea).sea.waves
    assert (scene.sea.waves[:, None] == whole).all(axis=2).any(axis=1).all()
    for current in ([against, 0.0], [0.0, against]):
        other = load_scene({**sea, 'sea.current': current})
        assert np.array_equal(other.sea.waves, whole)
        assert not any('sea.current' in sentence for sentence in other.warnings)


def test_a_current_that_stops_the_peak_of_an_irregular_sea_is_refused():
    said = refusal({'sea.sea_state': 3, 'sea.current': [-3.0, 0.0]})
    assert said.startswith('sea.current: [-3.0, 0.0] m/s stops 16 of the 16 waves of the '
                           'irregular sea, which have 100% of its energy; expected')
    # As parts of a spread sea run across it, it stops less of that.
    sea = {'sea.sea_state': 3, 'sea.current': [-1.2, 0.0], 'sea.components': 200}
    spread = load_scene({**sea, 'sea.spreading': 2.0}).sea
    assert len(spread.waves) > len(load_scene(sea).sea.waves)


# Together wrong.

@pytest.mark.parametrize('parameters, reason', [
    ({'hull.size': [4.0, 2.0, 1.0], 'probes.positions': SQUARE},
     'hull and probes: expected one of them, got hull.size and probes.positions'),
    ({'hull.shape': 'box', 'probes.floatiness': 1.3},
     'hull and probes: expected one of them, got hull.shape and probes.floatiness'),
    ({'probes.floatiness': 1.3}, 'probes.positions: expected x, y, z of every probe because'),
    ({'probes.positions': []}, 'probes.positions: expected x, y, z of every probe, at least one'),
    ({'probes.positions': [1.0, 2.0]}, 'probes.positions: expected x, y, z of every probe'),
    ({'probes.positions': SQUARE, 'probes.weights': [1.0, 1.0]},
     'probes.weights: expected 4 numbers, one for every probe, got 2: [1.0, 1.0]'),
    ({'probes.positions': SQUARE, 'probes.weights': [0.0] * 4}, 'probes.weights: expected a sum'),
    ({'probes.positions': SQUARE, 'probes.floatiness': 0.0},
     'probes.floatiness: expected a finite number of at least 1e-06'),
    ({'boat.mass': 0.0}, 'boat.mass: expected'), ({'boat.mass': -5.0}, 'boat.mass: expected'),
    ({'boat.inertia': [1.0, 1.0, 3.0]}, 'boat.inertia: expected no principal moment above'),
    ({'boat.inertia': [1.0, 1.0, 1.0, 2.0, 0.0, 0.0]}, 'boat.inertia: expected a positive'),
    ({'sea.waves': [1.0, 0.0, 0.0, 0.0]}, 'sea.waves: row 1 is [1.0, 0.0, 0.0, 0.0], expected'),
    ({'sea.waves': [1.0, 5.0, 0.0]}, 'sea.waves: expected rows of [amplitude m, period s'),
    ({'sea.waves': [0.1, 5.0, 0.0, 0.0] * 1001}, 'sea.waves: expected at most 1000 rows'),
    ({'sea.sea_state': 10}, 'sea.sea_state: expected an integer of 0 to 9, got 10'),
    ({'integrator': 'magic'}, 'integrator: expected one of leapfrog, implicit, rk4, symplectic_'),
    ({'hull.shape': 'ball'}, "hull.shape: expected one of box, twin, mesh, got 'ball'"),
    ({'body_frame': 'odom'}, "body_frame: expected another frame than world_frame, got 'odom'"),
    ({'boat': 5.0}, 'boat: no such parameter')])
def test_wrong_parameters_get_one_line_that_says_what_is_expected(parameters, reason):
    assert refusal(parameters).startswith(reason)


@pytest.mark.parametrize('parameters', [
    {'sea.waves': ['x'] * 4000}, {'sea.current': [0.0] * 4000}, {'hull.probes': [2] * 4000},
    {'probes.positions': [0.5] * 4000}, {'probes.positions': SQUARE, 'probes.weights': [1] * 4000},
    {'thrusters.names': ['a'], 'thrusters.positions': [0.5] * 4000}, {'boat.mass': [1.0] * 4000},
    {'thrusters.names': ['a'] * 4000}, {'integrator': 'rk4' * 4000}])
def test_what_was_given_is_shown_by_how_it_begins_when_it_is_long(parameters):
    said = refusal(parameters)
    assert 'got ' in said and len(said) < 400


# The simulation.

def test_a_simulation_is_run_as_the_scene_asks():
    scene = load_scene({'rate': 40.0, 'integrator': 'rk4', 'substeps': 3})
    sim = scene.simulation()
    assert (sim.rate, sim.integrator, sim.substeps) == (40.0, 'rk4', 3)
    assert (scene.rate, scene.integrator, scene.substeps) == (40.0, 'rk4', 3)


def test_keywords_replace_what_the_scene_asks():
    sim = load_scene({'rate': 40.0}).simulation(rate=200.0, integrator='implicit', substeps=2)
    assert (sim.rate, sim.integrator, sim.substeps) == (200.0, 'implicit', 2)


def test_substeps_past_the_limit_are_refused_unless_allowed():
    stiff = load_scene({'probes.positions': SQUARE, 'probes.stiffness': 5000.0})
    assert stiff.simulation().substeps > 1
    with pytest.raises(ValueError, match='substeps: '):
        stiff.simulation(substeps=1)
    assert stiff.simulation(substeps=1, allow_unstable=True).substeps == 1


def test_the_warnings_of_boat_and_steps_meet_in_the_simulation():
    scene = load_scene({'boat.center_of_mass': [0.3, 0.0, 0.0]})
    sim = scene.simulation(integrator='euler')
    assert set(scene.warnings) < set(sim.warnings)
    assert any('euler' in sentence for sentence in sim.warnings)


@pytest.mark.parametrize('keywords', [{'rate': 0.0}, {'rate': math.nan}, {'integrator': 'x'},
                                      {'substeps': -1}, {'substeps': 1.5}])
def test_wrong_keywords_are_refused(keywords):
    with pytest.raises(ValueError, match=f'^{next(iter(keywords))}: expected'):
        load_scene({}).simulation(**keywords)


# Fleets.

DEFAULT = Path(__file__).parents[1] / 'config' / 'default.yaml'


@pytest.mark.filterwarnings('ignore:this fleet is stepped by plain Python')
def test_each_scene_of_a_fleet_moves_as_it_does_alone_to_the_bit():
    sources = [DEFAULT, str(DEFAULT), {}, load_scene({'boat.mass': 1500.0, 'sea.sea_state': 2}),
               {'probes.positions': SQUARE, 'probes.stiffness': 5000.0, 'probes.law': 'soft'},
               {'start.position': [1.0, 2.0, 3.0], 'sea.waves': [0.2, 3.0, 0.0, 0.0],
                'damping.quadratic': [50.0] * 6}]
    fleet = load_fleet(sources)
    alone = [(source if isinstance(source, Scene) else load_scene(source)).simulation()
             for source in sources]
    assert {sim.substeps for sim in alone} != {1}
    for _ in range(30):
        fleet.step([100.0, 0.0, 0.0, 0.0, 0.0, 20.0])
        for sim in alone:
            sim.step([100.0, 0.0, 0.0, 0.0, 0.0, 20.0])
    for i, sim in enumerate(alone):
        for part in ('position', 'orientation', 'velocity', 'angular_velocity'):
            assert getattr(fleet.state[i], part).tolist() == getattr(sim.state, part).tolist()
    assert fleet.time == 0.3 and not fleet.failed.any()


@pytest.mark.parametrize('sources, reason', [
    ([], 'fleet: expected at least one scene, got none'),
    ([{}, {'rate': 50.0}], 'fleet: expected scenes of one rate, got 50.0 and 100.0'),
    ([{'integrator': 'rk4'}, {}],
     'fleet: expected scenes of one integrator, got leapfrog and rk4'),
    ([{}, {'hull.probes': [3, 2]}, {'probes.positions': SQUARE}],
     'fleet: expected boats of equally many probes, got boats of 4 and 6 probes'),
    ([{}, {'boat.mass': -1.0}], 'fleet: scene 1: boat.mass: expected a finite number'),
    ([{}, {}, 'no_such.yaml'], 'fleet: scene 2: no_such.yaml: cannot be read: No such file'),
    ([{}, 5], 'fleet: scene 1: scene: expected the path of a parameter file')])
def test_what_makes_no_fleet_is_refused_in_one_line(sources, reason):
    with pytest.raises(ValueError) as raised:
        load_fleet(sources)
    assert str(raised.value).startswith(reason) and '\n' not in str(raised.value)


@pytest.mark.filterwarnings('ignore:this fleet is stepped by plain Python')
def test_a_scene_that_stands_many_times_is_loaded_once(monkeypatch):
    loaded = []
    monkeypatch.setattr(scenes, 'load_scene', lambda source: loaded.append(source) or (
        load_scene(source)))
    fleet = load_fleet([{'boat.mass': 900.0}] * 1000)
    assert len(fleet) == 1000 and len(loaded) == 1


@pytest.mark.filterwarnings('ignore:this fleet is stepped by plain Python')
def test_a_thousand_different_scenes_load_within_half_a_minute():
    masses = np.linspace(1000.0, 3000.0, 100)
    load_fleet([{}])
    start = perf_counter()
    fleet = load_fleet({'boat.mass': mass, 'sea.sea_state': 2, 'sea.seed': i}
                       for i, mass in enumerate(masses.tolist()))
    # A tenth of them in a tenth of the time.
    assert perf_counter() - start < 3.0
    assert [boat.mass for boat in fleet.boats] == masses.tolist()


# Anything at all.

def numbers_of(parameter):
    low = -1e6 if parameter.at_least is None else parameter.at_least
    low = low if parameter.above is None else 1e-9
    high = 1e6 if parameter.at_most is None else parameter.at_most
    edges = st.sampled_from([low, high, 0.0, 1.0, math.nan, math.inf])
    return edges | st.floats(low, high) | st.floats()


def values_of(parameter):
    if parameter.kind == 'float':
        return numbers_of(parameter)
    if parameter.kind == 'int':
        return st.integers(0, 12) | st.sampled_from([parameter.at_least, parameter.at_most])
    if parameter.kind == 'bool':
        return st.booleans()
    if parameter.kind == 'string':
        return st.sampled_from([*parameter.choices, 'map', '', ' '])
    if parameter.kind == 'string_array':
        return st.lists(st.sampled_from(['left', 'right', 'a b']), max_size=2)
    if parameter.kind == 'int_array':
        return st.lists(st.integers(0, 5), min_size=2, max_size=2)
    sizes = st.sampled_from(parameter.lengths or (3, 4, 6, 8, 12))
    return sizes.flatmap(lambda size: st.lists(numbers_of(parameter), min_size=size,
                                               max_size=size))


PARAMETER_SETS = st.lists(st.sampled_from(list(PARAMETERS.values())), max_size=6,
                          unique_by=lambda parameter: parameter.name).flatmap(
    lambda some: st.fixed_dictionaries({p.name: values_of(p) for p in some}))


@pytest.mark.filterwarnings('error')
@settings(max_examples=300, suppress_health_check=[HealthCheck.too_slow])
@given(PARAMETER_SETS)
@example({'probes.positions': [0.0] * 3, 'probes.floatiness': 1.0 + 1e-15})
@example({'sea.significant_height': 2e-309, 'sea.peak_period': 1000.0})
def test_any_parameters_give_a_scene_that_starts_or_one_line(parameters):
    try:
        scene = load_scene(parameters)
    except ValueError as error:
        assert '\n' not in str(error) and ': ' in str(error)
        return
    assert isinstance(scene, Scene)
    for field in ('position', 'orientation', 'velocity', 'angular_velocity'):
        assert np.isfinite(getattr(scene.start, field)).all()
    try:
        sim = scene.simulation()
    except ValueError as error:
        assert str(error).startswith('substeps: ')
        return
    assert np.isfinite(sim.probe_depths).all()


def test_a_scene_that_has_run_can_be_sent_to_another_process():
    scene = load_scene({'sea.sea_state': 2})
    scene.simulation().step()
    one, other = scene.simulation(), pickle.loads(pickle.dumps(scene)).simulation()
    one.run(1.0), other.run(1.0)
    assert (one.state.position == other.state.position).all()


def test_a_fleet_says_once_what_its_scenes_warn_of_and_of_which():
    sinks = {'probes.positions': [0.0, 0.0, 0.0], 'probes.floatiness': 0.5}
    said, = load_fleet([{'probes.positions': [0.0, 0.0, -0.2]}, sinks, dict(sinks)]).warnings[-1:]
    assert said.startswith('scene 1: The boat sinks')


CHANGES = {
    'boat.mass': 2100.0, 'boat.inertia': [900.0, 3000.0, 3500.0], 'damping.probe': 10.0,
    'damping.linear_retention': [0.8], 'damping.angular_retention': [0.7, 0.8, 0.9],
    'damping.air_linear_retention': [0.9], 'damping.air_angular_retention': [0.9],
    'damping.linear': [10.0] * 6, 'damping.quadratic': [5.0] * 6,
    'sea.waves': [0.1, 4.0, 0.0, 0.0], 'sea.sea_state': 3, 'sea.current': [0.5, 0.0],
    'wind.velocity': [3.0, 4.0], 'wind.drag': [2.0, 5.0, -1.0],
    'sea.spreading': 10.0, 'sea.depth': 5.0, 'sea.transition': 1.0, 'thrust.timeout': 2.0,
    'gravity': 3.7, 'start.position': [1.0, 2.0], 'hull.size': [5.0, 2.0, 1.0], 'rate': 50.0,
    'hull.bottom': -0.4, 'water_density': 1000.0}


def described(scene):
    """Return all that a scene says of itself, to the bit."""
    return [scene.values, scene.warnings, scene.plan(), scene.thrust_timeout, scene.rate,
            scene.boat.record.tobytes(), scene.boat.probe_records.tobytes(),
            scene.sea.record.tobytes(), scene.sea.table.tobytes(),
            *(getattr(scene.start, part).tobytes() for part in (
                'position', 'orientation', 'velocity', 'angular_velocity'))]


@pytest.mark.parametrize('name', CHANGES)
@pytest.mark.parametrize('first', [{}, {'damping.probe': 500.0, 'boat.center_of_mass': [
    0.1, 0.0, 0.2]}])
def test_what_is_taken_over_from_a_scene_before_makes_the_scene_that_is_made_anew(first, name):
    before, values = load_scene(first), {**first, name: CHANGES[name]}
    assert described(scene_from_values(values, before)) == described(load_scene(values))
    # And back, and to what was derived, given.
    assert described(scene_from_values(first, load_scene(values))) == described(before)
    again = scene_from_values(before.values, before)
    assert described(again) == described(load_scene(before.values))


def test_a_change_works_out_anew_only_what_depends_on_it():
    before = load_scene({'sea.sea_state': 3})

    def changed(**values):
        return scene_from_values({**before.given, **{
            name.replace('__', '.'): value for name, value in values.items()}}, before)
    later = changed(thrust__timeout=2.0)
    assert (later.boat, later.sea, later.start) == (before.boat, before.sea, before.start)
    later = changed(sea__current=[0.5, 0.0])
    assert later.boat is before.boat and later.sea is not before.sea
    # Another damping leaves how the boat lies, and what there is to say of it.
    misses = rest._floating_height.cache_info().misses
    later = changed(damping__linear=[10.0] * 6)
    later.simulation()
    assert later.boat.damping.linear[0] == 10.0 and later.boat.hull is before.boat.hull
    assert later.flotation is before.flotation and later.start is before.start
    assert rest._floating_height.cache_info().misses == misses
    # All that is derived, given as it was derived, changes nothing.
    later = scene_from_values(before.values, before)
    assert (later.boat, later.sea, later.start) == (before.boat, before.sea, before.start)


def test_drag_that_leaves_a_boat_bobbing_is_warned_of():
    surge = {'damping.quadratic': [50.0, 50.0, 0.0, 0.0, 0.0, 20.0]}
    sentence, = load_scene(surge).warnings
    assert sentence.startswith('Nothing damps heave, roll, pitch: ')
    for more in ({'damping.probe': [0.0, 0.0, 900.0]}, {'damping.probe': 0.0},
                 {'damping.linear': [0.0, 0.0, 500.0, 300.0, 900.0, 0.0]}):
        assert load_scene({**surge, **more}).warnings == ()


def test_waves_break_sooner_in_shallow_water():
    # 0.3 m high, 10 s: in deep water 156 m long; in 0.5 m of water they break at 0.4 m.
    for height, breaks in ((0.3, False), (0.5, True)):
        warnings = load_scene({'sea.waves': [0.5 * height, 10.0, 0.0, 0.0],
                               'sea.depth': 0.5}).warnings
        assert any('steeper than water can be' in said for said in warnings) == breaks
