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

"""Parameters of the node: at the start, while it runs, and written down again."""

import math
from pathlib import Path

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.scene.parameters import PARAMETERS
from diagnostic_msgs.msg import DiagnosticArray
import numpy as np
import pytest
from rcl_interfaces.msg import ParameterType
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter, parameter_value_to_python
from ros_probe import BoatProcess, LATCHED, NAME, Probe, ROOT, run_and_end
from std_msgs.msg import Float64MultiArray
import yaml


TYPES = {
    'float': ParameterType.PARAMETER_DOUBLE, 'int': ParameterType.PARAMETER_INTEGER,
    'bool': ParameterType.PARAMETER_BOOL, 'string': ParameterType.PARAMETER_STRING,
    'float_array': ParameterType.PARAMETER_DOUBLE_ARRAY,
    'int_array': ParameterType.PARAMETER_INTEGER_ARRAY,
    'string_array': ParameterType.PARAMETER_STRING_ARRAY}


def parameter_file(folder, text):
    """Write the lines under ros__parameters of a file and return its path."""
    path = Path(folder) / 'scene.yaml'
    lines = ''.join(f'    {line}\n' for line in text.splitlines())
    path.write_text(f'/**:\n  ros__parameters:\n{lines}')
    return path


BAD_FILES = [
    ('boat: {mass: 0.0}', 'boat.mass: expected'),
    ('boat: {mass: -5.0}', 'boat.mass: expected'),
    ('boat: {mass: .nan}', 'boat.mass: expected a finite number'),
    ('boat: {mass: .inf}', 'boat.mass: expected a finite number'),
    ('boat: {mass: 1e3}', 'got 1e3 (line 3): write 1000.0'),
    ('start: {orientation: [0, 0, 0.2]}', 'write [0.0, 0.0, 0.2]'),
    ('boat: {mass: heavy}', "got 'heavy'"),
    ('boat: {mas: 5.0}', 'boat.mas: no such parameter, did you mean boat.mass?'),
    ('boat: {inertia: [1.0, 2.0]}', 'boat.inertia: expected 3 or 6 numbers, got 2'),
    ('probes: {positions: []}', 'probes.positions: expected x, y, z of every probe'),
    ('probes: {positions: [0.0, 0.0, 0.0], floatiness: 0.0}', 'probes.floatiness: expected'),
    ('hull: {shape: box}\nprobes: {positions: [0.0, 0.0, 0.0]}', 'expected one of them'),
    ('sea: {waves: [0.1, 0.0, 0.0, 0.0]}', 'expected a period'),
    ('sea: {waves: [[0.1, 4.0, 0.0, 0.0]]}', 'sea.waves: expected one flat list'),
    ('integrator: rk5', 'integrator: expected one of leapfrog'),
    ('substeps: 1.5', 'substeps: expected an integer'),
    ('rate: [1.0', 'expected YAML'),
    ('boat: {mass: 1.0}\nboat: {mass: 2.0}', 'given twice'),
    ('publish_clock: true\nuse_sim_time: true', 'publish_clock: expected false'),
    ('use_sim_time: 5', "'use_sim_time' to '5'")]
BAD_ARGUMENTS = [
    (['--params-file', '/nowhere/scene.yaml'], 'cannot be read'),
    (['-p', 'boat.mass'], 'boat.mass'),
    (['-p', 'sea.depht:=3.0'], 'sea.depht: no such parameter, did you mean sea.depth?'),
    (['-p', 'sea.waves:=[0.1, 4, 0, 0]'], 'write all numbers of a list with a decimal point'),
    (['-p', 'hull.shape:=mesh', '-p', 'hull.mesh:=5'],
     'hull.mesh: expected the path of a file, got 5'),
    (['-p', 'sea.depht:=[]'], 'sea.depht: no such parameter, did you mean sea.depth?'),
    (['--no-such-option'], '--no-such-option')]


def test_a_bad_file_or_command_line_is_one_line_and_exit_2(tmp_path):
    commands, expected = [], [said for _, said in BAD_FILES + BAD_ARGUMENTS]
    for i, (text, _) in enumerate(BAD_FILES):
        (tmp_path / str(i)).mkdir()
        commands.append(['--params-file', str(parameter_file(tmp_path / str(i), text))])
    commands += [arguments for arguments, _ in BAD_ARGUMENTS]
    ends = run_and_end([['--ros-args', *arguments] for arguments in commands])
    for (status, lines), said, arguments in zip(ends, expected, commands):
        assert (status, len(lines)) == (2, 1), (arguments, lines)
        assert said in lines[0]


def test_integers_are_taken_for_doubles_and_an_empty_list_for_none(tmp_path):
    path = parameter_file(tmp_path, 'rate: 50\nboat: {mass: 1640}\nsea: {waves: []}\n'
                          'damping: {linear_retention: [1]}')
    with BoatProcess(arguments=['--params-file', str(path)]) as boat:
        line = boat.wait_for_log('draft')
        # 1640 kg over 8 m^2 of 1025 kg/m^3.
        assert 'draft 0.200 m' in line and '50 Hz' in line and 'flat water' in line


def test_a_file_for_another_node_is_warned_of(tmp_path):
    path = tmp_path / 'scene.yaml'
    path.write_text('my_boat:\n  ros__parameters:\n    boat:\n      mass: 1640.0\n')
    with BoatProcess(arguments=['--params-file', str(path)]) as boat:
        assert 'the defaults are in force' in boat.wait_for_log('scene.yaml')


@pytest.fixture(scope='module')
def boat():
    """Start one boat to set parameters of."""
    with BoatProcess({'sea.waves': [0.02, 4.0, 0.0, 0.0], 'damping.linear_retention': [0.9],
                      'sea.transition': 0.1, 'status_period': 0.0}) as process:
        yield process


@pytest.fixture(scope='module')
def probe(boat):
    """Look at it with one probe."""
    with Probe(boat.namespace) as one:
        one.poses, one.twists, _, one.depths = one.listen_to_boat()
        one.waves = one.listen(Float64MultiArray, 'waves', LATCHED)
        one.until(lambda: one.poses and one.waves)
        yield one


def test_every_parameter_is_described_with_unit_and_range(probe):
    names = [name for name in probe.list_parameters() if name in PARAMETERS]
    # Those of probes one by one do not exist beside a box, nor those of a twin, a mesh and no
    # thrusters.
    assert set(PARAMETERS) - set(names) == {
        'probes.positions', 'probes.weights', 'probes.floatiness', 'probes.stiffness',
        'hull.spacing', 'hull.mesh', 'hull.scale'} | {
        name for name in PARAMETERS if name.startswith('thrusters.')}
    described = probe.describe(names)
    for name in names:
        parameter, descriptor = PARAMETERS[name], described[name]
        assert descriptor.type == TYPES[parameter.kind], name
        assert parameter.unit in descriptor.description
        assert descriptor.read_only == parameter.read_only
        if parameter.kind == 'float':
            bounds, = descriptor.floating_point_range
            assert (bounds.from_value, bounds.to_value) == parameter.limits


def test_a_heavier_boat_lies_deeper(probe):
    result, = probe.set_parameters({'boat.mass': 4100})
    assert result.successful, result.reason
    draft = 4100.0 / 8200.0
    probe.set_atomically({'sea.waves': []})
    probe.until(lambda: abs(probe.depths[-1].data[0] - draft) < 2e-3)
    values = probe.get_parameters(['boat.mass', 'boat.inertia'])
    assert values['boat.mass'].double_value == 4100.0
    # The solid box's inertia went with it.
    assert values['boat.inertia'].double_array_value[0] == pytest.approx(4100.0 / 12.0 * 5.0)
    assert probe.set_parameters({'boat.mass': 2000.0})[0].successful


@pytest.mark.parametrize('values, said', [
    ({'boat.mass': -1.0}, 'boat.mass: expected a finite number of at least'),
    ({'boat.mass': math.nan}, 'boat.mass: expected a finite number'),
    ({'boat.mass': 'heavy'}, "got 'heavy'"),
    ({'boat.inertia': [1.0, 1.0, 9.0]}, 'no body has that inertia'),
    ({'sea.waves': [0.1, 4.0, 0.0]}, 'four numbers a row'),
    ({'rate': 50.0}, 'rate: cannot change while the node runs; start it again with the new value'),
    ({'integrator': 'rk4'}, 'integrator: cannot change while the node runs; start it again'),
    ({'hull.size': None}, 'hull.size: cannot change'),
    ({'rate': 'fast'}, 'rate: cannot change'),
    ({'no.such': 1.0}, 'no.such: no such parameter'),
    ({'probes.floatiness': 2.0}, 'probes.positions: expected'),
    ({'use_sim_time': True}, 'use_sim_time: cannot change'),
    # As `ros2 param set` sends lists that ROS has no type for.
    ({'sea.waves': '[0.1, 4, 0, 0]'}, "type '[0.1, 4.0, 0.0, 0.0]'"),
    ({'sea.waves': '[[1, 4, 0, 0], [0.1, 3, 1, 0]]'},
     "type '[1.0, 4.0, 0.0, 0.0, 0.1, 3.0, 1.0, 0.0]'"),
    ({'wind.drag': [1.0, 0.0, 2.0]}, 'wind.drag: expected a yaw of at most'),
    ({'wind.velocity': [1.0]}, 'wind.velocity: expected 2 numbers'),
    ({'sea.current': 'strong'}, "sea.current: expected a list of numbers, got 'strong'"),
])
def test_a_bad_set_is_refused_with_the_reason_and_changes_nothing(probe, values, said):
    names = list(probe.list_parameters())
    before = probe.get_parameters(names)
    result, = probe.set_parameters(values)
    assert not result.successful and said in result.reason
    assert probe.get_parameters(names) == before


def test_a_set_of_several_is_all_or_nothing(probe):
    before = probe.get_parameters(['boat.mass', 'sea.current'])
    result = probe.set_atomically({'boat.mass': 1500.0, 'sea.current': [1.0]})
    assert not result.successful and 'sea.current' in result.reason
    assert probe.get_parameters(['boat.mass', 'sea.current']) == before
    assert probe.set_atomically({'boat.mass': 1500.0, 'sea.current': [0.5, 0.0]}).successful
    probe.until(lambda: probe.twists[-1].twist.linear.x > 0.1)
    probe.set_atomically({'boat.mass': 2000.0, 'sea.current': [0.0, 0.0]})


def test_a_sea_state_replaces_rows_and_rows_a_sea_state(probe):
    assert probe.set_parameters({'sea.sea_state': 3})[0].successful
    probe.until(lambda: len(probe.waves[-1].data) == 4 * 16)
    values = probe.get_parameters(['sea.waves', 'sea.sea_state'])
    assert len(values['sea.waves'].double_array_value) == 0
    height = 4 * math.sqrt(sum(a * a for a in probe.waves[-1].data[::4]) / 2)
    assert height == pytest.approx(0.875)
    rows = [0.02, 4.0, 0.0, 0.0]
    assert probe.set_parameters({'sea.waves': rows})[0].successful
    probe.until(lambda: probe.waves[-1].data.tolist() == rows)
    assert probe.get_parameters(['sea.sea_state'])['sea.sea_state'].integer_value == 0


def test_what_cannot_run_against_the_current_is_refused_and_the_boat_goes_on(probe):
    rows = [0.02, 4.0, 0.0, 0.0]
    ask = probe.publisher(Float64MultiArray, 'wave_parameters')
    for message in (None, [0.02, 5.0, 0.1, 0.0]):
        if message:
            # Waves that came by message count as those of parameters do.
            assert probe.set_parameters({'sea.waves': []})[0].successful
            ask.publish(Float64MultiArray(data=message))
            rows = message
        probe.until(lambda: probe.waves[-1].data.tolist() == rows)
        result = probe.set_atomically({'sea.current': [-3.0, 0.0], 'boat.mass': 2100.0})
        assert not result.successful
        assert result.reason.startswith(f'sea.waves: row 1 is {rows}, which cannot run against ')
        assert 'expected a period of at least ' in result.reason
        values = probe.get_parameters(['sea.current', 'boat.mass'])
        assert values['sea.current'].double_array_value.tolist() == [0.0, 0.0]
        assert values['boat.mass'].double_value == 2000.0
        count = len(probe.poses)
        probe.until(lambda: len(probe.poses) > count + 20)
        assert probe.waves[-1].data.tolist() == rows
    probe.set_atomically({'sea.waves': [0.02, 4.0, 0.0, 0.0]})


def test_a_sea_is_spread_about_its_direction_while_it_runs(probe):
    assert probe.set_atomically({'sea.sea_state': 2, 'sea.spreading': 10.0}).successful
    probe.until(lambda: len(set(probe.waves[-1].data[2::4])) == 16)
    assert probe.set_parameters({'sea.spreading': 0.0})[0].successful
    probe.until(lambda: set(probe.waves[-1].data[2::4]) == {0.0})
    probe.set_atomically({'sea.waves': [0.02, 4.0, 0.0, 0.0]})


def test_a_deleted_parameter_goes_back_to_what_the_node_was_given(probe):
    names = ['damping.linear_retention', 'sea.waves', 'sea.sea_state', 'boat.mass', 'boat.inertia']
    before = probe.get_parameters(names)
    assert before['damping.linear_retention'].double_array_value.tolist() == [0.9]
    for values in ({'damping.linear_retention': [0.5]}, {'boat.mass': 2100.0},
                   {'boat.inertia': [900.0, 3000.0, 3500.0]}, {'sea.sea_state': 3},
                   {'sea.waves': [0.1, 3.0, 0.0, 0.0]}):
        assert probe.set_parameters(values)[0].successful
        assert probe.get_parameters(names) != before
        assert probe.set_parameters(dict.fromkeys(values))[0].successful
        assert probe.get_parameters(names) == before, values


def test_drag_set_on_a_boat_that_floats_is_all_its_drag_until_it_is_deleted(probe):
    names = ['damping.probe', 'damping.angular_retention', 'damping.linear_retention']

    def damping():
        got = probe.get_parameters(names)
        return [got[name].double_array_value.tolist() for name in names]
    before = damping()
    assert before[0][2] == pytest.approx(30.0 * before[0][0]) and before[1:] == [[0.9], [0.9]]
    assert probe.set_parameters({'damping.linear': [10.0] * 6})[0].successful
    # What was given stays.
    assert damping() == [[0.0, 0.0, 0.0], [1.0], [0.9]]
    for given, taken in ((3000.0, [3000.0]), ([1.0, 2.0, 3.0], [1.0, 2.0, 3.0])):
        assert probe.set_parameters({'damping.probe': given})[0].successful
        assert damping()[0] == taken
    assert all(result.successful for result in probe.set_parameters(
        {'damping.linear': None, 'damping.probe': None}))
    assert damping() == before


def dropped(probe):
    """Return how many steps the node says in its next diagnostics that it has dropped."""
    status = []
    listener = probe.node.create_subscription(
        DiagnosticArray, '/diagnostics', lambda message: status.extend(
            one for one in message.status if one.hardware_id.startswith(
                probe.node.get_namespace())), 10)
    probe.until(lambda: status)
    probe.node.destroy_subscription(listener)
    return next(int(item.value) for item in status[-1].values if item.key == 'steps dropped')


@pytest.mark.parametrize(('name', 'value'), [
    ('thrust.timeout', lambda i: 0.5 + 1e-3 * i), ('wind.velocity', lambda i: [1e-2 * i, 0.0]),
    ('wind.drag', lambda i: [0.1 * i, 0.0, 0.0]), ('sea.current', lambda i: [1e-4 * i, 0.0]),
    ('damping.linear', lambda i: [1.0 * i] * 6), ('boat.mass', lambda i: 2000.0 + i)])
def test_five_hundred_queued_sets_drop_no_step(probe, name, value):
    before = dropped(probe)
    client = probe.node.create_client(SetParameters, f'{NAME}/set_parameters')
    probe.until(client.service_is_ready)
    answers = [client.call_async(SetParameters.Request(parameters=[
        Parameter(name, value=value(i)).to_parameter_msg()])) for i in range(500)]
    # Services keep the last ten that wait, so not all of them arrive.
    probe.until(lambda: answers[-1].done(), timeout=30.0)
    assert answers[-1].result().results[0].successful
    assert dropped(probe) == before
    assert probe.set_parameters({name: None})[0].successful


def test_what_it_dumps_can_be_loaded_while_it_runs_and_drops_no_step(probe):
    # With those that cannot change, and those of every node.
    names = sorted(probe.list_parameters())
    assert {'rate', 'world_frame', 'hull.probes', 'use_sim_time'} < set(names)
    before, steps = probe.get_parameters(names), dropped(probe)
    results = probe.set_parameters(
        {name: parameter_value_to_python(value) for name, value in before.items()
         if name != 'sea.waves'})
    assert not [result.reason for result in results if not result.successful]
    assert probe.get_parameters(names) == before and dropped(probe) == steps
    # Some in one set with one that changes.
    assert probe.set_atomically({'rate': 100, 'boat.mass': 2100.0, 'integrator': 'leapfrog'}
                                ).successful
    assert probe.get_parameters(['boat.mass'])['boat.mass'].double_value == 2100.0
    # Given now, and taken back for the tests to come.
    live = [name for name in names if name in PARAMETERS and not PARAMETERS[name].read_only]
    assert all(result.successful for result in probe.set_parameters(dict.fromkeys(live)))


def test_the_boat_keeps_its_stamps_and_its_way_through_a_set(probe):
    # The sea of the test before fades out first.
    probe.spin(0.5)
    probe.trigger('reset')
    probe.spin(0.3)
    del probe.poses[:-1]
    probe.set_parameters({'damping.probe': 3000.0})
    probe.spin(0.3)
    stamps = [m.header.stamp.sec * 10 ** 9 + m.header.stamp.nanosec for m in probe.poses]
    assert set(np.diff(stamps)) == {10_000_000}
    # Neither place nor speed jumps: 5 cm of heave at 1 Hz bend the path by less than this.
    z = np.array([m.pose.position.z for m in probe.poses])
    assert np.abs(np.diff(z, 2)).max() < 0.05 * (2 * math.pi) ** 2 * 0.01 ** 2


def test_probes_get_other_stiffness_weights_and_drag_while_they_float():
    positions = [1.0, 1.0, 0.0, 1.0, -1.0, 0.0, -1.0, 1.0, 0.0, -1.0, -1.0, 0.0]
    with BoatProcess({'probes.positions': positions, 'status_period': 0.0}) as process, \
            Probe(process.namespace) as one:
        depths = one.listen_to_boat()[3]
        one.until(lambda: depths)
        # F_max = 1.2 m g, so the depth that carries m g is 1 / (1.2 stiffness).
        assert depths[-1].data[0] == pytest.approx(1 / 4.8, abs=1e-9)
        assert one.set_parameters({'probes.stiffness': 8})[0].successful
        one.until(lambda: abs(depths[-1].data[0] - 1 / 9.6) < 1e-4)
        assert one.set_parameters({'probes.weights': [3.0, 3.0, 2.0, 2.0]})[0].successful
        # The bow is lifted more, so it lies less deep.
        one.until(lambda: depths[-1].data[0] < depths[-1].data[2] - 0.01)
        result, = one.set_parameters({'probes.weights': [1.0, 1.0]})
        assert not result.successful and 'expected 4 numbers' in result.reason
        result, = one.set_parameters({'substeps': 3})
        assert not result.successful and 'cannot change' in result.reason


def test_what_is_dumped_starts_the_same_boat_again(probe, tmp_path):
    names = probe.list_parameters()
    dumped = {}
    for name, value in probe.get_parameters(sorted(names)).items():
        value = parameter_value_to_python(value)
        tree = dumped
        *folders, last = name.split('.')
        for folder in folders:
            tree = tree.setdefault(folder, {})
        tree[last] = value if isinstance(value, (bool, int, float, str)) else list(value)
    path = tmp_path / 'dump.yaml'
    path.write_text(yaml.dump({f'/{NAME}': {'ros__parameters': dumped}},
                              default_flow_style=False))
    scene = load_scene(path)
    with BoatProcess(namespace='/', arguments=['--params-file', str(path)]) as again:
        again.wait_for_log('draft')
        with Probe('/') as one:
            same = one.get_parameters(sorted(names))
    assert same == probe.get_parameters(sorted(names))
    assert same['sea.waves'].type == ParameterType.PARAMETER_DOUBLE_ARRAY
    for name, value in same.items():
        if name in scene.values:
            ours = scene.values[name]
            value = parameter_value_to_python(value)
            assert value == ours if isinstance(ours, (bool, int, float, str)) else (
                tuple(value) == tuple(ours)), name


def test_every_scene_that_ships_starts_in_the_node_as_in_the_library():
    paths = sorted((ROOT / 'config').glob('*.yaml'))
    ends = run_and_end([['--ros-args', '--params-file', str(path)] for path in paths],
                       seconds=0.3)
    assert len(paths) > 5
    for path, (status, lines) in zip(paths, ends):
        assert status == 0, path
        assert f'{load_scene(path).boat.mass:g} kg' in lines[0] and ' Hz, ' in lines[0], path
        assert not [line for line in lines if 'ERROR' in line], path
