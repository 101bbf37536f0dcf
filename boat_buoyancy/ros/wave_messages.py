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
What becomes of a wave message: bytes on `wave_parameters`, rows of waves, the sea on `waves`.

A message is read into rows (W, 4), which `Session.set_waves` makes the sea that the boat floats
on; the sea in force is then published.
"""

from collections import deque
import math
import time

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.qos import DurabilityPolicy
from rclpy.serialization import deserialize_message
from std_msgs.msg import Float64MultiArray

from . import qos
from .complaints import Refused
from ..physics.sea.wave_rows import checked_waves, MAX_COMPONENTS

TOPIC = 'wave_parameters'
# Twice as many rows as are allowed, so that somewhat too many are answered with their number.
MAX_BYTES = 2 * MAX_COMPONENTS * 4 * 8
SEARCH_PERIOD = 0.25  # s between looks for who latches waves


def unpack_waves(raw):
    """
    Return the numbers of a serialised Float64MultiArray; `Refused` when it is far too long.

    It is taken as bytes because unpacking ten million numbers takes longer than many steps.
    """
    if len(raw) > MAX_BYTES:
        raise Refused('too long', f'{TOPIC}: expected at most {MAX_COMPONENTS} rows '
                      f'of four, got a message of {len(raw)} bytes')
    message = deserialize_message(raw, Float64MultiArray)
    check_layout(message.layout, len(message.data))
    return message.data


def check_layout(layout, count):
    """Raise `Refused` unless a layout, if there is one, says rows of four one after the other."""
    expected = (f'{TOPIC}: expected rows of four one after the other, with no layout or sizes '
                f'[{count // 4}, 4], strides [{count}, 4] and offset 0, got ')
    if len(layout.dim) > 2:
        raise Refused('other layout', f'{expected}{len(layout.dim)} dimensions')
    sizes = [dim.size for dim in layout.dim]
    strides = [dim.stride for dim in layout.dim]
    # Strides may be left out. Of a dimension, its own size times those that follow.
    whole = [math.prod(sizes[i:]) for i in range(len(sizes))]
    if layout.data_offset or sizes not in ([], [count], [count // 4, 4]) or any(
            stride not in (0, right) for stride, right in zip(strides, whole)):
        raise Refused('other layout', f'{expected}sizes {sizes}, strides {strides} and offset '
                      f'{layout.data_offset}')


def read_waves(values):
    """Return rows of waves (W, 4) from the numbers of a message, or raise `Refused`."""
    try:
        return checked_waves(values)
    except ValueError as error:
        kind = ('wrong length' if len(values) % 4 else
                'too many rows' if len(values) > 4 * MAX_COMPONENTS else
                'out of range' if all(map(math.isfinite, values)) else 'not finite')
        raise refused(kind, error) from None


def refused(kind, error):
    """Return what a ValueError about waves says, as `Refused` of a message."""
    return Refused(kind, str(error).replace('sea.waves', TOPIC, 1))


class WavesInput:
    """
    The subscriptions to `wave_parameters`.

    Main arguments: ``node``; ``complaints``, which count what is refused; ``take`` (rows), called
    with the waves (W, 4) of every message that is right; its ValueError refuses them.
    """

    def __init__(self, node, complaints, take):
        """Listen."""
        self._node, self._complaints, self._take = node, complaints, take
        self._duplicates, self._next_search = Duplicates(), 0.0
        self._topic = self._subscribe('volatile', qos.REQUEST).topic_name
        self._latched = None

    def look(self, now):
        """
        Subscribe to latched waves as long as somebody latches them; ``now`` s, steady clock.

        A volatile subscription misses what was latched before it came; a latched one, if it
        were always there, would make every ordinary publisher warn that it is not heard.
        """
        if now < self._next_search:
            return
        self._next_search = now + SEARCH_PERIOD
        latched = any(info.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
                      for info in self._node.get_publishers_info_by_topic(self._topic))
        if latched and self._latched is None:
            self._latched = self._subscribe(
                'latched', qos.LATCHED_REQUEST, event_callbacks=SubscriptionEventCallbacks(
                    incompatible_qos=lambda _: None, use_default_callbacks=False))
        elif not latched and self._latched is not None:
            self._node.destroy_subscription(self._latched)
            self._latched = None

    def _subscribe(self, name, profile, **options):
        return self._node.create_subscription(
            Float64MultiArray, TOPIC,
            self._complaints.guarded(TOPIC, lambda raw: self._receive(raw, name)),
            profile, raw=True, **options)

    def _receive(self, raw, subscription):
        # Of a message that is too long to be good, the length has to do.
        content = raw if len(raw) <= MAX_BYTES else len(raw)
        if not self._duplicates.is_copy(subscription, content, time.monotonic()):
            rows = read_waves(unpack_waves(raw))
            try:
                self._take(rows)
            except ValueError as error:
                raise refused('against the current', error) from None


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
