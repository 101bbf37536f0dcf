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
Drive the WAM-V to a place, as a controller of the Virtual RobotX simulator does it.

    ros2 launch boat_buoyancy vrx.launch.py
    python3 vrx_waypoint.py --ros-args -p latitude:=-33.7240 -p longitude:=150.6800

It knows the topics of VRX and nothing of this package: satellite fixes and an IMU come in, two
thrusts go out. It ends when the boat is there.
"""

import math
import time

from rcl_interfaces.msg import ParameterDescriptor
import rclpy
from rclpy._rclpy_pybind11 import RCLError
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Imu, NavSatFix
from std_msgs.msg import Float64

BOAT = '/wamv'
METRES_PER_DEGREE = 111_320.0
THERE = 2.0  # m
AHEAD = 250.0  # N of each thruster, less within SLOW m of the goal and while turning
SLOW = 10.0  # m
TURN, DAMPING = 150.0, 300.0  # N for each rad off the course, and for each rad/s of turn


def way_to(goal, here):
    """Return m east and north of (latitude, longitude) in degrees, on a plane."""
    return ((goal[1] - here[1]) * METRES_PER_DEGREE * math.cos(math.radians(here[0])),
            (goal[0] - here[0]) * METRES_PER_DEGREE)


def thrusts(east, north, heading, turn):
    """Return N left and right; ``heading`` rad from east to the left, ``turn`` rad/s."""
    off = math.remainder(math.atan2(north, east) - heading, 2.0 * math.pi)
    ahead = AHEAD * max(math.cos(off), 0.0) * min(math.hypot(east, north) / SLOW, 1.0)
    aside = TURN * off - DAMPING * turn
    return ahead - aside, ahead + aside


class Waypoint(Node):
    """Steers with each fix, by the latest word of the IMU."""

    def __init__(self):
        """Wait for the IMU."""
        super().__init__('vrx_waypoint')
        number = ParameterDescriptor(dynamic_typing=True)  # with or without a decimal point
        self._goal = [float(self.declare_parameter(name, default, number).value)
                      for name, default in (('latitude', -33.7240), ('longitude', 150.6800))]
        self.arrived, self._heading, self._turn = False, None, 0.0
        self._thrusters = [self.create_publisher(Float64, f'{BOAT}/thrusters/{side}/thrust', 10)
                           for side in ('left', 'right')]
        self.create_subscription(Imu, f'{BOAT}/sensors/imu/imu/data', self._on_imu,
                                 qos_profile_sensor_data)
        self.create_subscription(NavSatFix, f'{BOAT}/sensors/gps/gps/fix', self._on_fix,
                                 qos_profile_sensor_data)

    def _on_imu(self, message):
        q = message.orientation
        self._heading = math.atan2(2.0 * (q.w * q.z + q.x * q.y),
                                   1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        self._turn = message.angular_velocity.z

    def _on_fix(self, message):
        if self._heading is None:
            return
        east, north = way_to(self._goal, (message.latitude, message.longitude))
        # For good: it may glide on.
        self.arrived = self.arrived or math.hypot(east, north) < THERE
        both = (0.0, 0.0) if self.arrived else thrusts(east, north, self._heading, self._turn)
        for publisher, thrust in zip(self._thrusters, both):
            publisher.publish(Float64(data=thrust))


def main():
    """Run until the boat is there."""
    rclpy.init()
    try:
        node = Waypoint()
        while not node.arrived:
            rclpy.spin_once(node)
        node.get_logger().info('there')
        # What is sent last may still be on its way, and the boat holds what it was sent before.
        end = time.monotonic() + 0.5
        while time.monotonic() < end:
            rclpy.spin_once(node, timeout_sec=0.1)
        rclpy.shutdown()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except RCLError:
        # The signal came in the middle of a callback: nothing can be sent any more.
        if rclpy.ok():
            raise


if __name__ == '__main__':
    main()
