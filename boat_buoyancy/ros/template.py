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
Messages that are serialised once and then written over.

Between two messages of a topic only numbers differ.  A message filled again, whose fields rclpy
turns into those of C one by one, costs a quarter more to send, a new one three quarters; larger
messages gain more (measured in ``doc/ros_speed.md``).
"""

import struct

import numpy as np
from rclpy.serialization import serialize_message

FIRST_MARK = 1_000_003


class Template:
    """
    A message as bytes, with places for numbers.

    ROS itself serialises, once, before the first number is written: where a number lies is found
    by looking for one that was put there. Fields that no place was made for stay as they are.
    """

    def __init__(self, message):
        """Take a message, for good, whose strings and lists have their final lengths."""
        self._message, self._bytes = message, None
        self._wanted, self._offsets = [], []
        # Whole numbers that a float holds exactly, each put into the message once.
        self._unused = FIRST_MARK

    def numbers(self, form, put):
        """
        Return a function that writes numbers to where ``put`` puts them.

        ``form`` has a letter of `struct` for each number; ``put`` takes the same numbers and sets
        the message's fields to them.
        """
        place = struct.Struct(f'={form}')
        marks = [float(mark) if letter in 'fd' else mark
                 for letter, mark in zip(form, self._take(len(form)).tolist())]
        put(*marks)
        index = self._want(place.pack(*marks))

        def write(*numbers):
            place.pack_into(self._bytes or self._serialised(), self._offsets[index], *numbers)
        return write

    def block(self, shape, put, dtype=float):
        """
        Return a function that writes an array to where ``put`` puts one of ``shape``.

        The numbers, one at least, have to stand side by side in the message, in the array's
        order. The function raises ValueError for an array of another size.
        """
        marks = self._take(np.prod(shape, dtype=int)).astype(dtype).reshape(shape)
        put(marks)
        index = self._want(marks.tobytes())

        def write(values):
            target, offset = self._bytes or self._serialised(), self._offsets[index]
            target[offset:offset + marks.nbytes] = np.asarray(values, dtype).tobytes()
        return write

    def content(self):
        """Return the bytes to publish."""
        return bytes(self._bytes or self._serialised())

    def _take(self, count):
        first, self._unused = self._unused, self._unused + count
        return np.arange(first, self._unused)

    def _want(self, content):
        self._wanted.append(content)
        return len(self._wanted) - 1

    def _serialised(self):
        """Serialise the message, find the marks in it and return its bytes, to be written to."""
        content = serialize_message(self._message)
        for wanted in self._wanted:
            if content.count(wanted) != 1:
                raise RuntimeError(
                    f'{type(self._message).__name__}: expected {len(wanted)} bytes once in a '
                    f'message of {len(content)}, found them {content.count(wanted)} times')
            self._offsets.append(content.index(wanted))
        # A view does not change its size, whatever is written.
        self._bytes = memoryview(bytearray(content))
        return self._bytes
