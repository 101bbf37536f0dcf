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
What other nodes send, checked before anything acts on it.

Nothing here raises but `Refused`, whatever a message contains.
"""

from collections import Counter, deque
import math

from rclpy.serialization import deserialize_message
from std_msgs.msg import Float64MultiArray

from ..physics.quaternion import rotation_matrix, to_body
from ..physics.waves import checked_waves, MAX_COMPONENTS

# No thruster lifts a thousand times its boat: what asks for that is a fault.
MAX_THRUST = 1000.0  # boat weights
# Twice as many rows as are allowed, so that somewhat too many are answered with their number.
MAX_WAVE_BYTES = 2 * MAX_COMPONENTS * 4 * 8
MAX_PLACE = 1e9  # m, as start.position


class Refused(ValueError):
    """A message that is not acted on: ``kind`` to count it by, the sentence to show."""

    def __init__(self, kind, sentence):
        """Keep both."""
        super().__init__(sentence)
        self.kind = kind


def _check_finite(name, values):
    if not all(map(math.isfinite, values)):
        raise Refused('not finite', f'{name}: expected finite numbers, got {list(values)}')


def _check_frame(name, frame, *expected):
    if frame and frame not in expected:
        shown = frame if len(frame) <= 40 else frame[:40] + '...'
        raise Refused('unknown frame', f'{name}: expected frame_id empty or '
                      f'{" or ".join(map(repr, expected))}, got {shown!r}')


def read_wrench(message, scene):
    """
    Return the six numbers of a WrenchStamped, and True when they are in world axes.

    ``scene`` names the frames, and its boat's weight bounds what can be meant.
    """
    _check_frame('thrust', message.header.frame_id, scene.body_frame, scene.world_frame)
    force, torque = message.wrench.force, message.wrench.torque
    values = (force.x, force.y, force.z, torque.x, torque.y, torque.z)
    _check_finite('thrust', values)
    limit = MAX_THRUST * scene.boat.weight
    if max(map(abs, values)) > limit:
        raise Refused('too large', f'thrust: expected at most {limit:.3g} N and N m, '
                      f'{MAX_THRUST:g} times the weight of this boat, got {list(values)}')
    return values, message.header.frame_id == scene.world_frame


def unpack_waves(raw):
    """
    Return the numbers of a serialised Float64MultiArray.

    It is taken as bytes because unpacking ten million numbers takes longer than many steps.
    """
    if len(raw) > MAX_WAVE_BYTES:
        raise Refused('too long', f'wave_parameters: expected at most {MAX_COMPONENTS} rows '
                      f'of four, got a message of {len(raw)} bytes')
    return deserialize_message(raw, Float64MultiArray).data


def read_waves(values):
    """Return rows of waves (W, 4) of the numbers of a message; no numbers are flat water."""
    try:
        return checked_waves(values)
    except ValueError as error:
        kind = ('wrong length' if len(values) % 4 else
                'too many rows' if len(values) > 4 * MAX_COMPONENTS else
                'out of range' if all(map(math.isfinite, values)) else 'not finite')
        raise Refused(kind, str(error).replace('sea.waves', 'wave_parameters', 1)) from None


def read_place(message, scene):
    """Return x, y m and yaw rad of a PoseWithCovarianceStamped in the world frame."""
    _check_frame('initialpose', message.header.frame_id, scene.world_frame)
    place, turned = message.pose.pose.position, message.pose.pose.orientation
    _check_finite('initialpose', (place.x, place.y, turned.x, turned.y, turned.z, turned.w))
    if max(abs(place.x), abs(place.y)) > MAX_PLACE:
        raise Refused('too large', f'initialpose: expected x and y of at most {MAX_PLACE:g} m, '
                      f'got {place.x:g}, {place.y:g}')
    x, y, z, w = turned.x, turned.y, turned.z, turned.w
    if not 0.9 < x * x + y * y + z * z + w * w < 1.1:
        raise Refused('no orientation', 'initialpose: expected a unit quaternion, '
                      f'got {[x, y, z, w]}')
    return place.x, place.y, math.atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)


class ThrustLatch:
    """
    The last good wrench, until it is too old.

    ``timeout`` s counts from reception on the steady clock, whatever the header says; 0 = hold.
    """

    def __init__(self, timeout):
        """Hold no wrench."""
        self.timeout = timeout
        self.clear()

    def clear(self):
        """Forget the wrench."""
        self._wrench, self._in_world, self._received = None, False, None

    def hold(self, wrench, in_world, now):
        """Hold six numbers, in world axes or body axes, received at ``now`` s."""
        self._wrench, self._in_world, self._received = wrench, in_world, now

    def age(self, now):
        """Return the s since the last good wrench, None without one."""
        return None if self._received is None else now - self._received

    def expired(self, now):
        """Return True when there is a wrench, and it is too old to act."""
        return self._wrench is not None and 0.0 < self.timeout < now - self._received

    def wrench(self, now, orientation):
        """
        Return the wrench that acts at ``now`` s, in body axes, or None.

        ``orientation`` () -> the boat's quaternion, asked for only when it is needed: a wrench
        in world axes keeps its direction while the boat turns under it.
        """
        if self._wrench is None or self.expired(now):
            return None
        if not self._in_world:
            return self._wrench
        rotation = rotation_matrix(orientation())
        return (*to_body(rotation, self._wrench[:3]), *to_body(rotation, self._wrench[3:]))


class Duplicates:
    """
    Tells the copies of a message apart that arrives by two subscriptions.

    A latched publisher matches both the volatile and the latched subscription; an ordinary one
    only the first, and what was latched before we came arrives by the second alone.
    """

    WINDOW = 1.0  # s
    KEPT = 64

    def __init__(self):
        """Wait for nothing."""
        self._awaited = {}

    def is_copy(self, subscription, content, now):
        """
        Return True when another subscription has brought the same ``content`` just before.

        ``subscription`` any key; ``content`` bytes; ``now`` s.
        """
        for other, awaited in self._awaited.items():
            if other == subscription:
                continue
            while awaited and now - awaited[0][0] > self.WINDOW:
                awaited.popleft()
            for item in awaited:
                if item[1] == content:
                    awaited.remove(item)
                    return True
        own = self._awaited.setdefault(subscription, deque(maxlen=self.KEPT))
        own.append((now, content))
        return False


class Complaints:
    """
    Counts refused messages by reason, and lets through one sentence per reason and period.

    ``say`` is called with the sentence.
    """

    PERIOD = 5.0  # s

    def __init__(self, say):
        """Count from zero."""
        self._say, self._last, self._unsaid = say, {}, Counter()
        self.counts = Counter()

    def add(self, topic, refused, now):
        """Count a `Refused` message and say so, unless the same was said just before."""
        key = f'{topic}: {refused.kind}'
        self.counts[key] += 1
        if now - self._last.get(key, -math.inf) < self.PERIOD:
            self._unsaid[key] += 1
            return
        more = self._unsaid.pop(key, 0)
        self._last[key] = now
        self._say(f'{refused}' + (f' ({more} more like it before)' if more else ''))
