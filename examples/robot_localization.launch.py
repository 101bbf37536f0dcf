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
Start robot_localization on a boat: estimates on odometry/filtered, by imu, fix and odom.

    ros2 launch robot_localization.launch.py

The boat beside it is started with -p fix.latitude:=-33.724223 -p fix.longitude:=150.679736, the
datum in robot_localization.yaml, and with the noise that is proposed there.
robot_localization has to be installed: apt install ros-jazzy-robot-localization.
"""

from pathlib import Path

from launch import LaunchDescription
from launch_ros.actions import Node

PARAMETERS = str(Path(__file__).with_name('robot_localization.yaml'))


def generate_launch_description():
    """Return the filter and what turns fixes into positions for it."""
    return LaunchDescription([
        Node(package='robot_localization', executable='ekf_node', name='ekf',
             parameters=[PARAMETERS]),
        Node(package='robot_localization', executable='navsat_transform_node',
             name='navsat_transform', parameters=[PARAMETERS], remappings=[('gps/fix', 'fix')])])
