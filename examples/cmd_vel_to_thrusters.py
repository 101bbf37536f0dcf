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

r"""
Drive the two thrusters of a catamaran by cmd_vel, as Nav2 sends it.

    ros2 launch boat_buoyancy boat.launch.py scene:=wam_v namespace:=wamv
    python3 cmd_vel_to_thrusters.py --ros-args -r __ns:=/wamv

Beside vrx.launch.py, where odom has another name:

    ros2 launch boat_buoyancy vrx.launch.py
    python3 cmd_vel_to_thrusters.py --ros-args -r __ns:=/wamv \
        -r odom:=sensors/position/ground_truth_odometry

Force and torque are proportional to what is missing of the speed and of the turn asked for, by
what odom says of them; so some of both stays missing. Without cmd_vel for half a second it sends
no thrust for as long, and then falls silent.
"""

import time

from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import ParameterDescriptor
import rclpy
from rclpy._rclpy_pybind11 import RCLError
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float64

# Of config/wam_v.yaml.
DEFAULTS = {
    'speed_gain': 1000.0,  # N for each m/s that is missing
    'turn_gain': 1500.0,   # N m for each rad/s that is missing
    'arm': 1.027135,       # m, of each thruster from the centre line
    'patience': 0.5,       # s without cmd_vel
}
SILENCE = 2.0  # s without odom


def thrusts(asked, held, gains):
    """Return N left and right, for (m/s ahead, rad/s to the left) asked for and held."""
    force = gains['speed_gain'] * (asked[0] - held[0])
    torque = gains['turn_gain'] * (asked[1] - held[1])
    return 0.5 * force - 0.5 * torque / gains['arm'], 0.5 * force + 0.5 * torque / gains['arm']


class CmdVelToThrusters(Node):
    """Listens to cmd_vel and odom, and publishes thrusters/left/thrust and right."""

    def __init__(self):
        """Begin without a command."""
        super().__init__('cmd_vel_to_thrusters')
        number = ParameterDescriptor(dynamic_typing=True)  # with or without a decimal point
        self._gains = {name: float(self.declare_parameter(name, default, number).value)
                       for name, default in DEFAULTS.items()}
        self._asked, self._until, self._heard = (0.0, 0.0), 0.0, time.monotonic()
        self._thrusters = [self.create_publisher(Float64, f'thrusters/{side}/thrust', 1)
                           for side in ('left', 'right')]
        self.create_subscription(Twist, 'cmd_vel', self._on_command, 1)
        self.create_subscription(Odometry, 'odom', self._on_odometry, 1)

    def _on_command(self, message):
        self._asked = message.linear.x, message.angular.z
        now = time.monotonic()
        self._until = now + self._gains['patience']
        if now - self._heard > SILENCE:
            self.get_logger().warning(
                f'nothing comes on {self.resolve_topic_name("odom")}, so nothing is driven: start '
                'a boat that publishes it, or give its name there with -r odom:=NAME', once=True)

    def _on_odometry(self, message):
        now = self._heard = time.monotonic()
        if now > self._until + self._gains['patience']:
            return
        twist = message.twist.twist
        both = (thrusts(self._asked, (twist.linear.x, twist.angular.z), self._gains)
                if now < self._until else (0.0, 0.0))
        for publisher, thrust in zip(self._thrusters, both):
            publisher.publish(Float64(data=thrust))


def main():
    """Run until a signal."""
    rclpy.init()
    try:
        rclpy.spin(CmdVelToThrusters())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except RCLError:
        # The signal came in the middle of a callback: nothing can be sent any more.
        if rclpy.ok():
            raise


if __name__ == '__main__':
    main()
