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
What the node publishes every period: messages serialised once, then written over.

All of one period carry one stamp and come from one state.  Nothing is filled or sent on a topic
that nobody listens to: with volatile topics nobody misses it.
"""

from array import array
import sys

from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.msg import Odometry
import numpy as np
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Float64MultiArray, MultiArrayDimension

from .pacing import NANOSECONDS
from .template import Template
from ..physics.quaternion import cross, rotation_matrix, to_world

RELIABLE = QoSProfile(depth=10)
CLOUD_FIELDS = ('x', 'y', 'z', 'depth', 'force')
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Frame:
    """
    One instant of a boat, as the messages want it: Python floats of the body frame.

    ``stamp`` s and ns; ``position``, ``orientation`` in the world, ``velocity`` and
    ``angular_velocity`` in body axes; ``depths`` (n,) and ``simulation`` for what is asked more
    rarely.
    """

    def __init__(self, session):
        """Take the present state of a `Session`."""
        simulation = session.simulation
        self.stamp = divmod(session.stamp, NANOSECONDS)
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


class Outputs:
    """
    The publishers of every period.

    Main arguments: ``node``; ``scene``, for the frames and the number of probes.  ``publish``
    sends the present state.
    """

    def __init__(self, node, scene):
        """Create the publishers and their messages."""
        world, body = scene.world_frame, scene.body_frame
        count = len(scene.boat.hull.positions)
        self._topics = [
            (node.create_publisher(kind, name, RELIABLE), *made)
            for name, kind, made in (
                ('pose', PoseStamped, _pose(world)), ('twist', TwistStamped, _twist(body)),
                ('odom', Odometry, _odometry(world, body)),
                ('probe_depth', Float64MultiArray, _depths(count)),
                ('probes', PointCloud2, _cloud(world, count)))]

    def publish(self, session):
        """Send the present state of a `Session` to those who listen."""
        frame = None
        for publisher, template, fill in self._topics:
            if publisher.get_subscription_count():
                frame = frame or Frame(session)
                fill(frame)
                publisher.publish(template.content())


def stamp_of(template, stamp):
    """Return the function that writes seconds and nanoseconds into a stamp of a template."""
    def put(seconds, nanoseconds):
        stamp.sec, stamp.nanosec = seconds, nanoseconds
    return template.numbers('iI', put)


def pose_of(template, pose):
    """Return the function that writes x, y, z and a quaternion into a Pose of a template."""
    def put(x, y, z, *turned):
        set_vector(pose.position, (x, y, z))
        set_quaternion(pose.orientation, turned)
    return template.numbers('ddddddd', put)


def _twist_of(template, twist):
    def put(x, y, z, *spin):
        set_vector(twist.linear, (x, y, z))
        set_vector(twist.angular, spin)
    return template.numbers('dddddd', put)


def _pose(world):
    message = PoseStamped()
    message.header.frame_id = world
    template = Template(message)
    stamp, pose = stamp_of(template, message.header.stamp), pose_of(template, message.pose)

    def fill(frame):
        stamp(*frame.stamp)
        pose(*frame.position, *frame.orientation)
    return template, fill


def _twist(body):
    message = TwistStamped()
    message.header.frame_id = body
    template = Template(message)
    stamp, twist = stamp_of(template, message.header.stamp), _twist_of(template, message.twist)

    def fill(frame):
        stamp(*frame.stamp)
        twist(*frame.velocity, *frame.angular_velocity)
    return template, fill


def _odometry(world, body):
    message = Odometry(child_frame_id=body)
    message.header.frame_id = world
    template = Template(message)
    stamp = stamp_of(template, message.header.stamp)
    pose = pose_of(template, message.pose.pose)
    twist = _twist_of(template, message.twist.twist)

    def fill(frame):
        stamp(*frame.stamp)
        pose(*frame.position, *frame.orientation)
        twist(*frame.velocity, *frame.angular_velocity)
    return template, fill


def _depths(count):
    message = Float64MultiArray(data=[0.0] * count)

    def put(depths):
        message.data = array('d', depths)
    template = Template(message)
    depths = template.block((count,), put)
    return template, lambda frame: depths(frame.depths)


def _cloud(world, count):
    """Return the probes in the world frame: x, y, z, depth and force of each."""
    size = 4 * len(CLOUD_FIELDS)
    message = PointCloud2(
        fields=[PointField(name=name, offset=4 * i, datatype=PointField.FLOAT32, count=1)
                for i, name in enumerate(CLOUD_FIELDS)],
        height=1, width=count, point_step=size, row_step=size * count,
        data=array('B', bytes(size * count)), is_bigendian=sys.byteorder == 'big', is_dense=True)
    message.header.frame_id = world

    def put(points):
        message.data = array('B', points.tobytes())
    template = Template(message)
    stamp = stamp_of(template, message.header.stamp)
    points = template.block((count, len(CLOUD_FIELDS)), put, np.float32)

    def fill(frame):
        stamp(*frame.stamp)
        points(np.column_stack([probe_places(frame), frame.depths,
                                frame.simulation.probe_forces]))
    return template, fill


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
        message = Clock()
        self._template = Template(message)
        self._write = stamp_of(self._template, message.clock)

    def publish(self, stamp):
        """Send a time in ns."""
        self._write(*divmod(stamp, NANOSECONDS))
        self._publisher.publish(self._template.content())
