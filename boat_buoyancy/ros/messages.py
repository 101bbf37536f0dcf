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
What the node publishes every period: messages built once and refilled.

All of one period carry one stamp and come from one state.  Nothing is filled or sent on a topic
that nobody listens to: with volatile topics nobody misses it.
"""

from array import array

from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.msg import Odometry
import numpy as np
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Float64MultiArray, MultiArrayDimension

from .pacing import NANOSECONDS
from ..physics.quaternion import cross, rotation_matrix, to_world

RELIABLE = QoSProfile(depth=10)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Frame:
    """
    One instant of a boat, as the messages want it: Python floats of the body frame.

    ``stamp`` ns; ``position``, ``orientation`` in the world, ``velocity`` and
    ``angular_velocity`` in body axes; ``depths`` (n,) and ``simulation`` for what is asked more
    rarely.
    """

    def __init__(self, session):
        """Take the present state of a `Session`."""
        simulation = session.simulation
        self.stamp = session.stamp
        self.simulation, self.sea = simulation, simulation.sea
        motion, offset = simulation.motion, session.center_of_mass
        x, y, z = to_world(rotation_matrix(motion.orientation), offset)
        (px, py, pz), (vx, vy, vz) = motion.position, motion.velocity
        swing = cross(motion.angular_velocity, offset)
        self.position = (px - x, py - y, pz - z)
        self.orientation = motion.orientation
        self.velocity = (vx - swing[0], vy - swing[1], vz - swing[2])
        self.angular_velocity = motion.angular_velocity
        self.depths = simulation.probe_depths

    def to_world(self, place):
        """Return a place of the body frame, three floats in m, in the world."""
        turned = to_world(rotation_matrix(self.orientation), place)
        return tuple(a + b for a, b in zip(self.position, turned))


def set_stamp(stamp, nanoseconds):
    """Write ns into a builtin_interfaces Time."""
    stamp.sec, stamp.nanosec = divmod(nanoseconds, NANOSECONDS)


def set_vector(vector, values):
    """Write three floats into a Point or Vector3."""
    vector.x, vector.y, vector.z = values


def set_quaternion(quaternion, values):
    """Write four floats into a Quaternion."""
    quaternion.x, quaternion.y, quaternion.z, quaternion.w = values


def set_pose(pose, frame):
    """Write where the body frame is into a Pose."""
    set_vector(pose.position, frame.position)
    set_quaternion(pose.orientation, frame.orientation)


def set_twist(twist, frame):
    """Write how the body frame moves, in body axes, into a Twist."""
    set_vector(twist.linear, frame.velocity)
    set_vector(twist.angular, frame.angular_velocity)


class Outputs:
    """
    The publishers of every period.

    Main arguments: ``node``; ``scene``, for the frames.  ``publish`` sends one `Frame`.
    """

    def __init__(self, node, scene):
        """Create the publishers and their messages."""
        world, body = scene.world_frame, scene.body_frame
        pose, twist, odometry = PoseStamped(), TwistStamped(), Odometry()
        depths = Float64MultiArray()
        pose.header.frame_id = odometry.header.frame_id = world
        twist.header.frame_id = odometry.child_frame_id = body

        def fill_pose(frame):
            set_stamp(pose.header.stamp, frame.stamp)
            set_pose(pose.pose, frame)

        def fill_twist(frame):
            set_stamp(twist.header.stamp, frame.stamp)
            set_twist(twist.twist, frame)

        def fill_odometry(frame):
            set_stamp(odometry.header.stamp, frame.stamp)
            set_pose(odometry.pose.pose, frame)
            set_twist(odometry.twist.twist, frame)

        def fill_depths(frame):
            depths.data = array('d', frame.depths.tobytes())

        cloud = ProbeCloud(world)
        self._topics = [
            (node.create_publisher(type(message), name, RELIABLE), message, fill)
            for name, message, fill in (
                ('pose', pose, fill_pose), ('twist', twist, fill_twist),
                ('odom', odometry, fill_odometry), ('probe_depth', depths, fill_depths),
                ('probes', cloud.message, cloud.fill))]

    def publish(self, session):
        """Send the present state of a `Session` to those who listen."""
        frame = None
        for publisher, message, fill in self._topics:
            if publisher.get_subscription_count():
                frame = frame or Frame(session)
                fill(frame)
                publisher.publish(message)


class ProbeCloud:
    """The probes as a PointCloud2 in the world frame: x, y, z, depth and force of each."""

    FIELDS = ('x', 'y', 'z', 'depth', 'force')

    def __init__(self, world_frame):
        """Build the message once."""
        fields = [PointField(name=name, offset=4 * i, datatype=PointField.FLOAT32, count=1)
                  for i, name in enumerate(self.FIELDS)]
        self.message = PointCloud2(fields=fields, height=1, point_step=4 * len(fields),
                                   is_bigendian=False, is_dense=True)
        self.message.header.frame_id = world_frame

    def fill(self, frame):
        """Write the probes of a `Frame`."""
        points = np.column_stack([probe_places(frame), frame.depths,
                                  frame.simulation.probe_forces]).astype('<f4')
        message = self.message
        set_stamp(message.header.stamp, frame.stamp)
        message.width = len(points)
        message.row_step = message.point_step * len(points)
        message.data = array('B', points.tobytes())


def probe_places(frame):
    """Return the probes (n, 3) m in the world frame."""
    rotation = np.reshape(rotation_matrix(frame.orientation), (3, 3))
    return frame.simulation.boat.hull.positions @ rotation.T + frame.position


class WavesOutput:
    """The sea in force, rows of four as they were given, for all who listen and will listen."""

    def __init__(self, node):
        """Create the publisher."""
        self._publisher = node.create_publisher(Float64MultiArray, 'waves', LATCHED)

    def publish(self, sea):
        """Send the rows of a `Sea`."""
        message = Float64MultiArray()
        rows = len(sea.waves)
        message.layout.dim = [MultiArrayDimension(label='waves', size=rows, stride=4 * rows),
                              MultiArrayDimension(label='amplitude, period, direction, phase',
                                                  size=4, stride=4)]
        message.data = array('d', sea.waves.tobytes())
        self._publisher.publish(message)


class ClockOutput:
    """The source of /clock."""

    def __init__(self, node):
        """Create the publisher."""
        self._publisher = node.create_publisher(Clock, '/clock', RELIABLE)
        self._message = Clock()

    def publish(self, stamp):
        """Send a time in ns."""
        set_stamp(self._message.clock, stamp)
        self._publisher.publish(self._message)
