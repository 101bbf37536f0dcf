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
Start the WAM-V with the topics of the Virtual RobotX simulator (VRX).

    ros2 launch boat_buoyancy vrx.launch.py sea_state:=2 rviz:=true

A controller that was written for VRX finds its boat: /wamv/thrusters/left/thrust and pos, the
same of right, /wamv/sensors/imu/imu/data, /wamv/sensors/gps/gps/fix and
/wamv/sensors/position/ground_truth_odometry. There are no cameras, lidars and pingers, and
/wamv/pose is a PoseStamped. Takes the arguments of boat.launch.py.
"""

import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import (DeclareLaunchArgument, GroupAction, IncludeLaunchDescription,
                            OpaqueFunction)
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import SetParameter, SetParametersFromFile, SetRemap

LAUNCH = os.path.join(get_package_share_directory('boat_buoyancy'), 'launch')

# What is another default here than in boat.launch.py.
ARGUMENTS = {
    'scene': ('wam_v', 'A scene with thrusters left and right.'),
    'namespace': ('wamv', 'Namespace of the boat, also what comes before its frame.'),
}

TOPICS = {
    'imu': 'sensors/imu/imu/data',
    'fix': 'sensors/gps/gps/fix',
    'odom': 'sensors/position/ground_truth_odometry',
}


def prefix(context):
    """Set what comes before the frame of the boat, as wamv/base_link."""
    name = LaunchConfiguration('namespace').perform(context).strip('/')
    return [SetParameter('frame_prefix', f'{name}/')] if name else []


def generate_launch_description():
    """Return the boat of boat.launch.py under the names of VRX."""
    return LaunchDescription([
        *(DeclareLaunchArgument(name, default_value=default, description=description)
          for name, (default, description) in ARGUMENTS.items()),
        GroupAction([
            *(SetRemap(ours, theirs) for ours, theirs in TOPICS.items()),
            SetParametersFromFile(os.path.join(LAUNCH, 'vrx.yaml')),
            OpaqueFunction(function=prefix),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(os.path.join(LAUNCH, 'boat.launch.py')))])])
