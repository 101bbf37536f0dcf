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
Start two boats, red and blue, in one sea.

    ros2 launch boat_buoyancy two_boats.launch.py sea_state:=2

Each boat has a namespace, so that topics are /red/pose and /blue/pose; both listen to one
/wave_parameters and one /wind. The sea is a function of the stamp time: both see the same water,
and `same_sea` warns when they do not.
`use_sim_time`, `publish_tf` and `rviz` are those of `boat.launch.py`, for each of the two.
"""

import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import (DeclareLaunchArgument, GroupAction, IncludeLaunchDescription,
                            OpaqueFunction)
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, SetRemap

LAUNCH = os.path.join(get_package_share_directory('boat_buoyancy'), 'launch')

# Arguments of one boat that must not reach both from the command line, and those set below.
NOT_SHARED = {'x': '0.0', 'yaw': '0.0', 'publish_clock': '', 'time_factor': ''}
SET_FOR_EACH = ('namespace', 'scene', 'y')


def check(context):
    """Raise RuntimeError for an argument that cannot be for both boats."""
    for name in (*NOT_SHARED, *SET_FOR_EACH):
        if name in context.launch_configurations:
            raise RuntimeError(f'{name}: expected none, as it cannot be for both boats, got '
                               f'{context.launch_configurations[name]!r}; to change it for one, '
                               'copy two_boats.launch.py')


def boat(namespace, scene, y):
    """Return one boat at y m, listening to the waves and the wind of all."""
    return GroupAction([
        SetRemap('wave_parameters', '/wave_parameters'),
        SetRemap('wind', '/wind'),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(os.path.join(LAUNCH, 'boat.launch.py')),
            launch_arguments={**NOT_SHARED, 'namespace': namespace, 'scene': scene, 'y': y,
                              'sea_state': LaunchConfiguration('sea_state')}.items())])


def generate_launch_description():
    """Return the sea as an argument, and both boats."""
    return LaunchDescription([
        DeclareLaunchArgument('sea_state', default_value='3',
                              description='WMO sea state of both, 0 to 9; 0 = flat water.'),
        OpaqueFunction(function=check),
        boat('red', 'v4_tuned', '0.0'),
        boat('blue', 'default', '10.0'),
        Node(package='boat_buoyancy', executable='same_sea', output='screen',
             arguments=['/red/boat_buoyancy', '/blue/boat_buoyancy'])])
