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

"""Work that may take a while, one thing after the other, the newest of each kind only."""

from threading import Condition, Thread


class Worker:
    """
    A thread that does what it is given in the order it came.

    What is given under the key of something that still waits replaces it, but for the key None: a
    slider that is dragged asks for more values than can be worked out.
    """

    def __init__(self, said):
        """Report errors to ``said``, called with an exception."""
        self._said, self._waiting, self._changed = said, {}, Condition()
        Thread(target=self._run, name='worker', daemon=True).start()

    def give(self, key, function, *arguments):
        """Let a function be called soon."""
        with self._changed:
            key = object() if key is None else key
            self._waiting.pop(key, None)
            self._waiting[key] = function, arguments
            self._changed.notify()

    def _run(self):
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._waiting)
                key = next(iter(self._waiting))
                function, arguments = self._waiting.pop(key)
            try:
                function(*arguments)
            except Exception as error:
                self._said(error)
