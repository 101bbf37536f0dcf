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
Sensors on board: an IMU and a satellite receiver, as REP-145 and NavSatFix have them.

What they measure is computed from the forces and the motion of the moment, and only when somebody
listens.  White noise is added on request; the covariances say how much.
"""

from fractions import Fraction
import zlib

import numpy as np

from .geodesy import geodetic
from .messages import set_stamp, set_vector
from .pacing import NANOSECONDS
from ..physics.rotation import normalise, product
from ..physics.vectors import add, add_scaled, cross, subtract


class Sensor:
    """
    A topic with a rate of its own: what `ImuSensor` and `FixSensor` share.

    Main arguments: ``topics`` as `NodeTopics`; ``scene``; ``kind`` of message; ``topic``, also
    the group of its parameters; ``stream``, what makes its noise another than that of other
    sensors; the node's name and namespace make it another than that of other boats.  Public:
    ``publisher``.
    """

    def __init__(self, topics, scene, kind, topic, stream):
        """Create the publisher and its message."""
        values = scene.values
        self._message = topics.make(f'sensor_msgs/msg/{kind}')
        self.publisher = topics.publisher(topic, self._message)
        # Its axes are the boat's: no transform is needed to use what it measures.
        self._message.header.frame_id = scene.body_frame
        self._place = values[f'{topic}.position']
        boat = zlib.crc32(topics.name.encode())
        self._random = np.random.default_rng([values[f'{topic}.seed'], stream, boat])
        rate = Fraction(values[f'{topic}.rate'])
        self._always = rate >= Fraction(scene.rate)
        self._ticks, self._span = rate.numerator, rate.denominator * NANOSECONDS
        self._period = int(NANOSECONDS / scene.rate)
        self._published = None

    def is_due(self, stamp):
        """
        Return True when a multiple of 1/rate lies in the period that ends at ``stamp`` ns.

        On the clock of the stamps: sensors of several boats measure together.  A boat that is
        paused, and shown again where it was put, measures nothing new.
        """
        if stamp == self._published:
            return False
        if self._always:
            return True
        # Stamps are cut to whole ns: a multiple of 1/rate may be less than 1 ns ahead.
        end = stamp + 1
        return end * self._ticks // self._span > (end - self._period) * self._ticks // self._span

    def publish(self, frame):
        """Send what is felt in a `Frame`."""
        self._published = frame.stamp
        set_stamp(self._message.header.stamp, frame.stamp)
        self._fill(self._message, frame)
        self.publisher.publish(self._message)

    def _noise(self, deviation):
        """Return three numbers of white noise."""
        return (deviation * self._random.standard_normal(3)).tolist() if deviation else (0.0,) * 3


class ImuSensor(Sensor):
    """The topic `imu`: attitude in the world, angular velocity and specific force on board."""

    def __init__(self, topics, scene):
        """Create the publisher."""
        super().__init__(topics, scene, 'Imu', 'imu', 0)
        self._arm = subtract(self._place, tuple(scene.boat.center_of_mass.tolist()))
        self._deviations = [scene.values[f'imu.{name}_noise']
                            for name in ('orientation', 'gyroscope', 'accelerometer')]
        message = self._message
        for covariance, deviation in zip(
                (message.orientation_covariance, message.angular_velocity_covariance,
                 message.linear_acceleration_covariance), self._deviations):
            covariance[::4] = deviation ** 2

    def _fill(self, message, frame):
        orientation, gyroscope, accelerometer = map(self._noise, self._deviations)
        x, y, z = orientation
        turned = normalise(product(frame.orientation, (0.5 * x, 0.5 * y, 0.5 * z, 1.0)))
        (message.orientation.x, message.orientation.y, message.orientation.z,
         message.orientation.w) = turned
        set_vector(message.angular_velocity, add(frame.angular_velocity, gyroscope))
        set_vector(message.linear_acceleration,
                   add(specific_force(frame, self._arm), accelerometer))


def specific_force(frame, arm):
    """
    Return what an accelerometer feels in a `Frame`, (3) m/s^2, body axes.

    a + w' x r + w x (w x r) + g up: acceleration of its place less that of free fall; ``arm`` r
    (3) m, body axes, from the centre of mass.
    """
    simulation, spin = frame.simulation, frame.angular_velocity
    linear, angular = simulation.acceleration(frame.wrench)
    there = add(add(linear, cross(angular, arm)), cross(spin, cross(spin, arm)))
    return add_scaled(there, simulation.boat.gravity, frame.up)


class FixSensor(Sensor):
    """The topic `fix`: latitude, longitude and altitude of the antenna on the ellipsoid WGS84."""

    def __init__(self, topics, scene):
        """Create the publisher."""
        super().__init__(topics, scene, 'NavSatFix', 'fix', 1)
        self._datum = [scene.values[f'fix.{name}']
                       for name in ('latitude', 'longitude', 'altitude')]
        self._horizontal, self._vertical = scene.values['fix.noise']
        message = self._message
        status = message.status
        status.status, status.service = status.STATUS_FIX, status.SERVICE_GPS
        message.position_covariance[::4] = np.square(
            [self._horizontal, self._horizontal, self._vertical])
        message.position_covariance_type = message.COVARIANCE_TYPE_DIAGONAL_KNOWN

    def _fill(self, message, frame):
        east, north, up = frame.to_world(self._place)
        if self._horizontal or self._vertical:
            east, north, up = add((east, north, up), (
                *self._noise(self._horizontal)[:2], self._noise(self._vertical)[2]))
        message.latitude, message.longitude, message.altitude = geodetic(
            *self._datum, east, north, up)


def sensors_of(topics, scene):
    """Return the sensors that a scene has."""
    return [kind(topics, scene) for kind, topic in ((ImuSensor, 'imu'), (FixSensor, 'fix'))
            if scene.values[f'{topic}.rate'] > 0.0]
