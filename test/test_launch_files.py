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
What the launch files start, seen by stand-ins for launch and launch_ros.

Neither can be had without a ROS installation. The stand-ins keep what they are given, so that
what is handed to the node can be checked: it has to be a scene that runs.
"""

import importlib.util
from pathlib import Path
import sys
from types import ModuleType, SimpleNamespace

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.scene import parameter_file
from boat_buoyancy.physics.scene.parameters import PARAMETERS
from boat_buoyancy.physics.scene.scene import scene_from_values
import pytest
import yaml

ROOT = Path(__file__).parents[1]
SCENES = sorted(path.stem for path in (ROOT / 'config').glob('*.yaml'))


class Kept:
    """Stands for any class of launch: keeps its arguments."""

    def __init__(self, *arguments, **options):
        """Keep them."""
        self.arguments, self.options = arguments, options


class LaunchConfiguration(Kept):
    """Looks an argument up in the context, a dict."""

    def perform(self, context):
        """Return its value."""
        return context[self.arguments[0]]


STAND_INS = {
    'ament_index_python': {},
    'ament_index_python.packages': {'get_package_share_directory': lambda package: str(ROOT),
                                    'PackageNotFoundError': LookupError},
    'launch': {'LaunchDescription': Kept},
    'launch.actions': dict.fromkeys(('DeclareLaunchArgument', 'GroupAction', 'OpaqueFunction',
                                     'IncludeLaunchDescription'), Kept),
    'launch.launch_description_sources': {'PythonLaunchDescriptionSource': Kept},
    'launch.substitutions': {'LaunchConfiguration': LaunchConfiguration},
    'launch_ros': {},
    'launch_ros.actions': dict.fromkeys(('Node', 'SetParameter', 'SetParametersFromFile',
                                         'SetRemap'), Kept)}


@pytest.fixture
def load(monkeypatch):
    """Return a function that loads a launch file by its name."""
    for name, content in STAND_INS.items():
        module = ModuleType(name)
        vars(module).update(content)
        monkeypatch.setitem(sys.modules, name, module)

    def loaded(name):
        spec = importlib.util.spec_from_file_location(name, ROOT / 'launch' / f'{name}.launch.py')
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module
    return loaded


@pytest.fixture
def start(load):
    """Return a function that gives the boat and RViz as started with arguments."""
    boat = load('boat')

    def started(**given):
        defaults = {name: default for name, (default, _) in boat.ARGUMENTS.items()}
        assert set(given) <= set(defaults)
        return [SimpleNamespace(**node.options) for node in boat.nodes({**defaults, **given})]
    return started


def scene_of(node):
    """Return the `Scene` that the node will read."""
    file, overrides = node.parameters
    section, = yaml.safe_load(Path(file).read_text()).values()

    def flat(group, prefix=''):
        for name, value in group.items():
            if isinstance(value, dict):
                yield from flat(value, f'{prefix}{name}.')
            else:
                yield prefix + name, value
    values = dict(flat(section['ros__parameters'] or {}))
    values.update(overrides)
    values.pop('use_sim_time', None)
    return scene_from_values(values, folder=Path(file).parent)


@pytest.mark.parametrize('scene', SCENES)
def test_every_shipped_scene_starts_by_its_name(start, scene):
    boat, = start(scene=scene)
    assert (boat.package, boat.executable) == ('boat_buoyancy', 'buoyancy_node')
    assert scene_of(boat).given == load_scene(ROOT / 'config' / f'{scene}.yaml').given


@pytest.mark.parametrize('scene', SCENES)
def test_a_sea_state_goes_with_every_scene_that_has_no_sea_of_its_own(start, scene):
    boat, = start(scene=scene, sea_state='3')
    if load_scene(ROOT / 'config' / f'{scene}.yaml').sea.is_flat:
        assert len(scene_of(boat).sea.waves) == 16
    else:
        with pytest.raises(ValueError, match='expected one kind of waves'):
            scene_of(boat)


def test_arguments_reach_the_scene(start):
    boat, = start(x='3.0', yaw='1.5', sea_state='4', publish_clock='true', time_factor='2',
                  namespace='red', publish_tf='true')
    scene = scene_of(boat)
    assert boat.namespace == 'red'
    assert scene.values['start.position'] == (3.0, 0.0)
    assert scene.values['start.orientation'] == (0.0, 0.0, 1.5)
    assert (scene.values['publish_clock'], scene.values['time_factor']) == (True, 2.0)
    assert scene.values['publish_tf'] is True
    assert len(scene.sea.waves) == 16


@pytest.mark.parametrize('given, said', [
    ({'scene': 'rowing'}, 'scene: expected the path of a parameter file or one of barge, .*got'),
    ({'x': 'east'}, "x: expected a number, got 'east'"),
    ({'sea_state': '3.5'}, "sea_state: expected a whole number, got '3.5'"),
    ({'publish_clock': 'yes'}, "publish_clock: expected true or false, got 'yes'")])
def test_a_wrong_argument_is_one_line(start, given, said):
    with pytest.raises(RuntimeError, match=said):
        start(**given)


def test_rviz_follows_the_clock_of_the_boat_and_only_comes_when_asked_for(start):
    _, rviz = start(publish_clock='true', rviz='true')
    assert rviz.parameters == [{'use_sim_time': True}]
    assert Path(rviz.arguments[1]).is_file()
    assert len(start(rviz='false')) == 1


def test_rviz_that_is_not_installed_is_one_line_before_anything_starts(load, monkeypatch):
    def missing(package):
        if package == 'rviz2':
            raise LookupError(package)
        return str(ROOT)
    boat = load('boat')
    monkeypatch.setattr(boat, 'get_package_share_directory', missing)
    given = {name: default for name, (default, _) in boat.ARGUMENTS.items()}
    with pytest.raises(RuntimeError, match='rviz: expected rviz2 to be installed'):
        boat.nodes({**given, 'rviz': 'true'})


def test_two_boats_are_apart_and_in_one_sea(load, start):
    groups = [action for action in load('two_boats').generate_launch_description().arguments[0]
              if action.arguments and isinstance(action.arguments[0], list)]
    boats = []
    for group in groups:
        *remaps, include = group.arguments[0]
        assert [remap.arguments for remap in remaps] == [
            ('wave_parameters', '/wave_parameters'), ('wind', '/wind')]
        assert Path(include.arguments[0].arguments[0]).name == 'boat.launch.py'
        given = dict(include.options['launch_arguments'])
        given['sea_state'] = given['sea_state'].perform({'sea_state': '3'})
        boats.append(start(**given)[0])
    scenes = [scene_of(boat) for boat in boats]
    assert len({boat.namespace for boat in boats}) == len(boats) == 2
    assert scenes[0].sea.waves.tolist() == scenes[1].sea.waves.tolist() != []
    watch, = (action for action in load('two_boats').generate_launch_description().arguments[0]
              if action.options.get('executable') == 'same_sea')
    assert watch.options['arguments'] == [f'/{boat.namespace}/boat_buoyancy' for boat in boats]
    apart = scenes[1].start.position - scenes[0].start.position
    assert abs(apart[1]) > 5.0


def test_the_boat_of_vrx_has_its_topics_and_all_arguments_of_one_boat(load, start):
    *arguments, group = load('vrx').generate_launch_description().arguments[0]
    defaults = {argument.arguments[0]: argument.options['default_value'] for argument in arguments}
    assert defaults == {'scene': 'wam_v', 'namespace': 'wamv'}
    *remaps, parameters, prefix, include = group.arguments[0]
    assert {remap.arguments for remap in remaps} == {
        ('imu', 'sensors/imu/imu/data'), ('fix', 'sensors/gps/gps/fix'),
        ('odom', 'sensors/position/ground_truth_odometry')}
    assert Path(include.arguments[0].arguments[0]).name == 'boat.launch.py'
    # With no arguments of its own, what is declared and given here reaches it.
    assert 'launch_arguments' not in include.options
    boat, = start(**defaults, sea_state='1')
    more = parameter_file.read(parameters.arguments[0])
    assert prefix.options['function']({'namespace': ''}) == []
    for namespace, expected in (('/one/two', 'one/two/'), ('wamv', 'wamv/')):
        before, = prefix.options['function']({'namespace': namespace})
        assert before.arguments == ('frame_prefix', expected)
    more.update([before.arguments])
    scene = load_scene({**more, **scene_of(boat).given})
    assert [thruster.name for thruster in scene.thrusters] == ['left', 'right']
    assert (scene.world_frame, scene.body_frame) == ('map', 'wamv/base_link')
    # The sea of 5 cm has waves shorter than the hulls, and says so.
    assert all('too far apart for the waves' in said for said in scene.warnings)
    assert len(scene.sea.waves) == 16
    assert set(more) <= set(PARAMETERS) - set(load_scene(ROOT / 'config' / 'wam_v.yaml').given)


@pytest.mark.parametrize('name', ['scene', 'namespace', 'x', 'y', 'yaw', 'publish_clock',
                                  'time_factor'])
def test_two_boats_refuse_what_cannot_be_for_both(load, name):
    check = load('two_boats').check
    check(SimpleNamespace(launch_configurations={'sea_state': '3', 'rviz': 'true'}))
    with pytest.raises(RuntimeError, match=f'^{name}: expected none, .* got .1.;'):
        check(SimpleNamespace(launch_configurations={name: '1'}))


def test_two_boats_take_every_argument_of_one_or_refuse_it(load):
    one, two = load('boat'), load('two_boats')
    passed_on = {'sea_state', 'use_sim_time', 'publish_tf', 'rviz'}
    assert {*one.ARGUMENTS} == {*two.NOT_SHARED, *two.SET_FOR_EACH} | passed_on
    # Not set for a boat, so that the included file sees what the command line gave.
    *_, include = two.boat('red', 'default', '0.0').arguments[0]
    given = dict(include.options['launch_arguments'])
    assert not {'use_sim_time', 'publish_tf', 'rviz'} & given.keys()
