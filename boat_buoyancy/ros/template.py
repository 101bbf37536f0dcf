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

Between two messages of a topic only numbers differ, and turning the fields of a Python message
into those of C costs rclpy as much again as sending it (see ``doc/ros_speed.md``).
"""

import struct

import numpy as np
from rclpy.serialization import serialize_message

FIRST_MARK = 1_000_003


class Template:
    """
    A message as bytes, with places for numbers.

    ROS itself serialises: where a number lies is found by looking for one that was put there.
    Fields of the message that no place was made for stay as they are now.
    """

    def __init__(self, message):
        """Take a message whose strings and lists have their final lengths."""
        self._message = message
        # Whole numbers that a float holds exactly, each put into the message once.
        self._unused = FIRST_MARK
        self._bytes = bytearray(serialize_message(message))

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
        offset, target = self._find(place.pack(*marks)), self._bytes

        def write(*numbers):
            place.pack_into(target, offset, *numbers)
        return write

    def block(self, shape, put, dtype=float):
        """
        Return a function that writes an array to where ``put`` puts one of ``shape``.

        The numbers have to stand side by side in the message, in the array's order.
        """
        marks = self._take(np.prod(shape, dtype=int)).astype(dtype).reshape(shape)
        put(marks)
        offset, target = self._find(marks.tobytes()), self._bytes
        end = offset + marks.nbytes

        def write(values):
            target[offset:end] = np.asarray(values, dtype).tobytes()
        return write

    def content(self):
        """Return the bytes to publish."""
        return bytes(self._bytes)

    def _take(self, count):
        first, self._unused = self._unused, self._unused + count
        return np.arange(first, self._unused)

    def _find(self, wanted):
        """Return where ``wanted`` bytes lie in the message as it is now; they lie there once."""
        content = serialize_message(self._message)
        if len(content) != len(self._bytes) or content.count(wanted) != 1:
            raise RuntimeError(f'{type(self._message).__name__}: expected {len(wanted)} bytes '
                               f'once in a message of {len(self._bytes)} bytes, found them '
                               f'{content.count(wanted)} times in {len(content)}')
        return content.index(wanted)
