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
Drive the two thrusters of a catamaran by cmd_vel, as Nav2 sends it.

    python3 cmd_vel_to_thrusters.py --ros-args -r __ns:=/wamv

Force and torque are proportional to what is missing of the speed and of the turn asked for, by
what odom says of them; so some of both stays missing. Without cmd_vel for half a second it falls
silent, and the boat's own thrust.timeout ends the thrust.
"""

import time

from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
import rclpy
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
        self._gains = {name: self.declare_parameter(name, default).value
                       for name, default in DEFAULTS.items()}
        self._asked, self._until = (0.0, 0.0), 0.0
        self._thrusters = [self.create_publisher(Float64, f'thrusters/{side}/thrust', 1)
                           for side in ('left', 'right')]
        self.create_subscription(Twist, 'cmd_vel', self._on_command, 1)
        self.create_subscription(Odometry, 'odom', self._on_odometry, 1)

    def _on_command(self, message):
        self._asked = message.linear.x, message.angular.z
        self._until = time.monotonic() + self._gains['patience']

    def _on_odometry(self, message):
        if time.monotonic() < self._until:
            twist = message.twist.twist
            held = twist.linear.x, twist.angular.z
            for publisher, thrust in zip(self._thrusters,
                                         thrusts(self._asked, held, self._gains)):
                publisher.publish(Float64(data=thrust))


def main():
    """Run until a signal."""
    rclpy.init()
    try:
        rclpy.spin(CmdVelToThrusters())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == '__main__':
    main()
