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

"""The progress line of programs that take minutes."""

from time import monotonic

# Time in s from one line in a file to the next.
PERIOD = 10.0


class Progress:
    """
    One line on standard error that is written over, where there is somebody to see it.

    Main arguments: ``stream``.
    Other arguments: nothing is shown in the first ``after`` s, nor sooner than ``every`` s after
    the last text.
    """

    def __init__(self, stream, *, after=0.0, every=0.0):
        """Show nothing so far."""
        self._stream, self._width, self._next = stream, 0, 0.0
        self._every, self._from = every, monotonic() + after

    def __call__(self, text):
        """Show a text in place of the last; in a file, a line now and then."""
        if monotonic() < self._from:
            return
        self._from = monotonic() + self._every
        if self._stream.isatty():
            self._stream.write(f'\r{text.ljust(self._width)}')
            self._width = len(text)
        elif monotonic() >= self._next:
            self._next = monotonic() + PERIOD
            self._stream.write(f'{text}\n')
        self._stream.flush()

    def clear(self):
        """Leave an empty line behind."""
        if self._stream.isatty() and self._width:
            self._stream.write(f'\r{" " * self._width}\r')
            self._stream.flush()
            self._width = 0
