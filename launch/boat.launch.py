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
Start one boat.

    ros2 launch boat_buoyancy boat.launch.py scene:=barge namespace:=barge x:=5.0 rviz:=true

`ros2 launch boat_buoyancy boat.launch.py --show-args` lists the arguments.
"""

import os

from ament_index_python.packages import get_package_share_directory, PackageNotFoundError
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

PACKAGE = 'boat_buoyancy'

ARGUMENTS = {
    'scene': ('default', 'A scene of this package (default, barge, ...) or the path of a '
                         'parameter file.'),
    'namespace': ('', 'Namespace of the boat: two boats need two.'),
    'x': ('', 'Where the boat starts along world x, in m; with x or y it floats at its draft. '
              "Empty: the scene's start."),
    'y': ('', 'Where the boat starts along world y, in m; with x alone 0.'),
    'yaw': ('', "Heading at the start in rad, counter-clockwise from x; level. Empty: the scene's "
                'start.'),
    'sea_state': ('', 'WMO sea state 0 to 9, the same water for all that ask for the same. '
                      "For scenes without a sea of their own. Empty: the scene's sea."),
    'publish_clock': ('', 'true: this boat is the source of /clock, from 0 on.'),
    'time_factor': ('', 'Simulated over wall time, with publish_clock; 0.0 = as fast as it can.'),
    'use_sim_time': ('', 'true: steps follow a /clock from elsewhere.'),
    'publish_tf': ('', 'true: the boat is on /tf, in a namespace as NAMESPACE/base_link; needs '
                       'tf2_msgs.'),
    'rviz': ('false', 'true: show the boat in RViz.'),
}


def scene_file(name):
    """Return the path of a scene: a file as it is, or a scene of this package by its name."""
    if os.path.isfile(name):
        return name
    folder = os.path.join(get_package_share_directory(PACKAGE), 'config')
    path = os.path.join(folder, name + '.yaml')
    if not os.path.isfile(path):
        shipped = sorted(file[:-5] for file in os.listdir(folder) if file.endswith('.yaml'))
        raise RuntimeError(f'scene: expected the path of a parameter file or one of '
                           f'{", ".join(shipped)}, got {name!r}')
    return path


def number(given, name):
    """Return an argument as a number; 0.0 when it is empty."""
    try:
        return float(given[name] or 0.0)
    except ValueError:
        raise RuntimeError(f'{name}: expected a number, got {given[name]!r}') from None


def whole(given, name):
    """Return an argument as a whole number."""
    try:
        return int(given[name])
    except ValueError:
        raise RuntimeError(f'{name}: expected a whole number, got {given[name]!r}') from None


def switch(given, name):
    """Return an argument that is true or false."""
    values = {'true': True, '1': True, 'false': False, '0': False}
    if given[name].lower() not in values:
        raise RuntimeError(f'{name}: expected true or false, got {given[name]!r}')
    return values[given[name].lower()]


def overrides(given):
    """Return the parameters that arguments set; those left empty are the scene's."""
    parameters = {name: switch(given, name)
                  for name in ('publish_clock', 'use_sim_time', 'publish_tf') if given[name]}
    if given['time_factor']:
        parameters['time_factor'] = number(given, 'time_factor')
    if given['sea_state']:
        parameters['sea.sea_state'] = whole(given, 'sea_state')
    if given['x'] or given['y']:
        parameters['start.position'] = [number(given, 'x'), number(given, 'y')]
    if given['yaw']:
        parameters['start.orientation'] = [0.0, 0.0, number(given, 'yaw')]
    return parameters


def nodes(context):
    """Return the boat, and RViz if it is asked for."""
    given = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    parameters = overrides(given)
    boat = Node(
        package=PACKAGE, executable='buoyancy_node', namespace=given['namespace'],
        output='screen', emulate_tty=True, parameters=[scene_file(given['scene']), parameters])
    simulated = parameters.get('publish_clock') or parameters.get('use_sim_time') or False
    if not switch(given, 'rviz'):
        return [boat]
    try:
        # Before the boat starts: launch leaves behind what runs when an action fails.
        get_package_share_directory('rviz2')
    except PackageNotFoundError:
        raise RuntimeError('rviz: expected rviz2 to be installed, as by apt install '
                           'ros-jazzy-rviz2; it is not') from None
    return [boat, Node(
        package='rviz2', executable='rviz2', namespace=given['namespace'], output='screen',
        arguments=['-d', os.path.join(
            get_package_share_directory(PACKAGE), 'config', 'boat.rviz')],
        parameters=[{'use_sim_time': simulated}])]


def generate_launch_description():
    """Return the arguments and what they start."""
    return LaunchDescription([
        *(DeclareLaunchArgument(name, default_value=default, description=description)
          for name, (default, description) in ARGUMENTS.items()),
        OpaqueFunction(function=nodes)])
