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
Hold a heading in waves: ``.venv/bin/python examples/heading_hold.py``, beside a running boat.

Odometry of the boat comes in, as often as it steps; a push ahead and a torque go out, each time.
"""

from math import atan2, remainder, tau

from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
import rclpy
from rclpy.signals import SignalHandlerOptions

HEADING = 0.5  # rad, counter-clockwise from world x
AHEAD, TURN, DAMPING = 500.0, 2000.0, 4000.0  # N, N m for each rad off, and for each rad/s of turn


def steer(odometry):
    """Answer where the boat is with a push."""
    q = odometry.pose.pose.orientation
    heading = atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
    message = WrenchStamped()
    message.wrench.force.x = AHEAD
    message.wrench.torque.z = (TURN * remainder(HEADING - heading, tau)
                               - DAMPING * odometry.twist.twist.angular.z)
    thrust.publish(message)


try:
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node('heading_hold')
    thrust = node.create_publisher(WrenchStamped, 'thrust', 1)
    node.create_subscription(Odometry, 'odom', steer, 1)
    while True:
        rclpy.spin_once(node, timeout_sec=0.1)
except KeyboardInterrupt:
    pass  # without thrust for half a second, the boat stops pushing
