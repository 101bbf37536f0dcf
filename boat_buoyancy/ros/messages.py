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
What the node publishes every period.

One message a topic, made once and filled anew.  All of one period carry one stamp and come from
one state.  Nothing is filled or sent on a topic that nobody listens to: with volatile topics
nobody misses it.
"""

from array import array
import sys

import numpy as np

from .pacing import NANOSECONDS
from ..physics.rotation import rotation_matrix, to_world
from ..physics.vectors import add, cross, subtract

CLOUD_FIELDS = ('x', 'y', 'z', 'depth', 'force')


class Frame:
    """
    One instant of a boat, as the messages want it: Python floats of the body frame.

    ``stamp`` ns; ``position`` and ``orientation`` in the world, ``body_velocity`` and
    ``angular_velocity`` in body axes; ``wrench``, the thrust of the last period or None, and
    ``simulation`` for what is asked more rarely.
    """

    def __init__(self, session):
        """Take the present state of a `Session`."""
        self.stamp, self.simulation = session.stamp, session.simulation
        self.wrench = session.wrench
        motion, offset = self.simulation.motion, session.center_of_mass
        # Floats, all of them: rclpy does not look at types, an integer would go out as garbage.
        self.orientation, self.angular_velocity = motion.orientation, motion.angular_velocity
        self._rotation = rotation_matrix(self.orientation)
        self.position = subtract(motion.position, to_world(self._rotation, offset))
        self.body_velocity = subtract(motion.body_velocity, cross(self.angular_velocity, offset))

    @property
    def up(self):
        """Return the world's z axis, three floats in body axes."""
        return self._rotation[2]

    def to_world(self, place):
        """Return a place of the body frame, three floats in m, in the world."""
        return add(self.position, to_world(self._rotation, place))

    def probe_places(self):
        """Return the probes (n, 3) m in the world."""
        return self.simulation.boat.hull.positions @ np.transpose(self._rotation) + self.position


class Outputs:
    """
    The publishers of every period.

    Main arguments: ``topics`` as `NodeTopics`; ``scene``, for the frames and the number of
    probes; ``sensors``, each a `Sensor`; ``more`` topics, (publisher, message, fill) each.
    ``publish`` sends the present state.
    """

    def __init__(self, topics, scene, sensors=(), more=()):
        """Create the publishers and their messages."""
        self._sensors = sensors
        world, body = scene.world_frame, scene.body_frame
        pose, twist, odometry = map(topics.make, (
            'geometry_msgs/msg/PoseStamped', 'geometry_msgs/msg/TwistStamped',
            'nav_msgs/msg/Odometry'))
        pose.header.frame_id = odometry.header.frame_id = world
        twist.header.frame_id = odometry.child_frame_id = body
        self._topics = [
            (topics.publisher(topic, message), message, fill)
            for topic, message, fill in (
                ('pose', pose, _fill_pose), ('twist', twist, _fill_twist),
                ('odom', odometry, _fill_odometry),
                ('probe_depth', topics.make('std_msgs/msg/Float64MultiArray'), _fill_depths),
                ('probes', _cloud(topics.make, world, len(scene.boat.hull.positions)),
                 _fill_cloud))]
        self._topics += more

    def publish(self, session):
        """Send the present state of a `Session` to those who listen."""
        frame = None
        for publisher, message, fill in self._topics:
            if publisher.get_subscription_count():
                frame = frame or Frame(session)
                fill(message, frame)
                publisher.publish(message)
        stamp = session.stamp if self._sensors else None
        for sensor in self._sensors:
            if sensor.is_due(stamp) and sensor.publisher.get_subscription_count():
                frame = frame or Frame(session)
                sensor.publish(frame)


class ClockOutput:
    """The source of /clock."""

    def __init__(self, topics):
        """Create the publisher."""
        self._message = topics.make('rosgraph_msgs/msg/Clock')
        self._publisher = topics.publisher('/clock', self._message)

    def publish(self, stamp):
        """Send a time in ns."""
        set_stamp(self._message.clock, stamp)
        self._publisher.publish(self._message)


class WavesOutput:
    """The sea in force, rows of four as they were given, for all who listen and will listen."""

    def __init__(self, topics):
        """Create the publisher."""
        self._message = topics.make('std_msgs/msg/Float64MultiArray')
        self._message.layout.dim = [self._row, self._column] = [
            topics.make('std_msgs/msg/MultiArrayDimension') for _ in range(2)]
        self._row.label = 'waves'
        self._column.label, self._column.size, self._column.stride = (
            'amplitude, period, direction, phase', 4, 4)
        self._publisher = topics.publisher('waves', self._message)

    def publish(self, sea):
        """Send the rows of a `Sea`."""
        self._row.size, self._row.stride = len(sea.waves), 4 * len(sea.waves)
        self._message.data = array('d', sea.waves.tobytes())
        self._publisher.publish(self._message)


def set_stamp(stamp, nanoseconds):
    """Write ns into a builtin_interfaces Time."""
    stamp.sec, stamp.nanosec = divmod(nanoseconds, NANOSECONDS)


def set_vector(vector, values):
    """Write three floats into a Point or Vector3."""
    vector.x, vector.y, vector.z = values


def set_pose(pose, position, orientation):
    """Write three and four floats into a Pose."""
    set_vector(pose.position, position)
    turned = pose.orientation
    turned.x, turned.y, turned.z, turned.w = orientation


def _set_twist(twist, frame):
    set_vector(twist.linear, frame.body_velocity)
    set_vector(twist.angular, frame.angular_velocity)


def _fill_pose(message, frame):
    set_stamp(message.header.stamp, frame.stamp)
    set_pose(message.pose, frame.position, frame.orientation)


def _fill_twist(message, frame):
    set_stamp(message.header.stamp, frame.stamp)
    _set_twist(message.twist, frame)


def _fill_odometry(message, frame):
    set_stamp(message.header.stamp, frame.stamp)
    set_pose(message.pose.pose, frame.position, frame.orientation)
    _set_twist(message.twist.twist, frame)


def _fill_depths(message, frame):
    message.data = array('d', frame.simulation.probe_depths.tobytes())


def _cloud(make, world, count):
    """Return the message of the probes in the world frame: x, y, z, depth and force of each."""
    message, fields = make('sensor_msgs/msg/PointCloud2'), []
    for i, name in enumerate(CLOUD_FIELDS):
        field = make('sensor_msgs/msg/PointField')
        field.name, field.offset, field.datatype, field.count = name, 4 * i, field.FLOAT32, 1
        fields.append(field)
    size = 4 * len(CLOUD_FIELDS)
    message.fields, message.height, message.width = fields, 1, count
    message.point_step, message.row_step = size, size * count
    message.is_bigendian, message.is_dense = sys.byteorder == 'big', True
    message.header.frame_id = world
    return message


def _fill_cloud(message, frame):
    set_stamp(message.header.stamp, frame.stamp)
    points = np.column_stack([frame.probe_places(), frame.simulation.probe_depths,
                              frame.simulation.probe_forces])
    message.data = array('B', points.astype(np.float32).tobytes())
