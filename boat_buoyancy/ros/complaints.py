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

"""Messages that are refused: the checks they share, counted by reason, and said now and then."""

from collections import Counter
import math
import time


class Refused(ValueError):
    """A message that is not acted on: ``kind`` to count it by, the sentence to show."""

    def __init__(self, kind, sentence):
        """Keep both."""
        super().__init__(sentence)
        self.kind = kind


def check_finite(name, values):
    """Raise `Refused` unless all numbers of a message are finite."""
    if not all(map(math.isfinite, values)):
        raise Refused('not finite', f'{name}: expected finite numbers, got {list(values)}')


def check_frame(name, frame, *expected):
    """Raise `Refused` unless a message's frame id is empty or one of those expected."""
    if frame and frame not in expected:
        shown = frame if len(frame) <= 40 else frame[:40] + '...'
        raise Refused('unknown frame', f'{name}: expected frame_id empty or '
                      f'{" or ".join(map(repr, expected))}, got {shown!r}')


class Throttle:
    """
    Lets through one sentence per subject and period.

    ``say`` is called with the sentence.
    """

    PERIOD = 5.0  # s

    def __init__(self, say):
        """Have said nothing."""
        self._say, self._last, self._unsaid = say, {}, Counter()

    def say(self, subject, sentence, now):
        """Say a sentence at ``now`` s, unless one on the same subject was said just before."""
        if now - self._last.get(subject, -math.inf) < self.PERIOD:
            self._unsaid[subject] += 1
            return
        more = self._unsaid.pop(subject, 0)
        self._last[subject] = now
        self._say(sentence + (f' ({more} more like it before)' if more else ''))


class Complaints:
    """
    Counts refused messages by reason, and says a sentence per reason now and then.

    ``say`` is called with the sentence.  Public: ``counts`` by topic and reason, and ``last``,
    the sentence for the last that was refused.
    """

    def __init__(self, say):
        """Count from zero."""
        self._throttle = Throttle(say)
        self.counts, self.last = Counter(), ''

    @property
    def total(self):
        """Return how many messages were refused."""
        return sum(self.counts.values())

    def guarded(self, topic, act):
        """
        Return a callback that never raises: what ``act`` (message) refuses is counted.

        It returns whether a message was acted on.
        """
        def callback(message):
            try:
                act(message)
                return True
            except Refused as refused:
                self.add(topic, refused, time.monotonic())
            except Exception as error:  # whatever a message contains, the node stays
                self.add(topic, Refused('not understood', f'{topic}: {error!r}'),
                         time.monotonic())
            return False
        return callback

    def add(self, topic, refused, now):
        """Count a `Refused` message and say so, unless the same was said just before."""
        key = f'{topic}: {refused.kind}'
        self.counts[key] += 1
        self.last = str(refused)
        self._throttle.say(key, self.last, now)
