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
Which step is due, and which stamp it has: two counts, no running sums.

`StepCounter` compares steps done with time gone by; `Timeline` turns steps into stamps.  Both
are exact for any rate: they count in integers and fractions.
"""

from dataclasses import dataclass, replace
from fractions import Fraction

NANOSECONDS = 10 ** 9

# Steps missed in a hitch up to this long are run afterwards; after a longer one the boat does not
# race through the past, it goes on from the present.
CATCH_UP = 1.0  # s


class StepCounter:
    """
    Steps due on a clock that only goes forward.

    Main arguments: ``rate`` steps per second of that clock; ``now`` ns, when step 0 is done.
    Other arguments: ``catch_up`` s, the longest hitch whose steps are run late and not dropped.
    """

    def __init__(self, rate, now, *, catch_up=CATCH_UP):
        """Start counting at ``now``."""
        rate = Fraction(rate)
        # Whole numbers from here on: a Fraction costs more than a step's share of the loop.
        self._steps, self._span = rate.numerator, rate.denominator * NANOSECONDS
        self._limit = max(1, int(rate * Fraction(catch_up)))
        self.restart(now)

    def restart(self, now):
        """Forget what was missed: step 0 is done at ``now`` ns."""
        self._start, self._done = now, 0

    def due(self, now):
        """Return how many steps are due at ``now`` ns; negative when ahead of the clock."""
        return (now - self._start) * self._steps // self._span - self._done

    def advance(self, steps=1):
        """Count steps as done, run or given up."""
        self._done += steps

    def drop(self, now):
        """Give up all but one step if more are due than can be caught up; return how many."""
        due = self.due(now)
        if due <= self._limit:
            return 0
        self.advance(due - 1)
        return due - 1

    def next_at(self):
        """Return when the next step is due, in ns."""
        return self._start - -(self._done + 1) * self._span // self._steps


@dataclass(frozen=True)
class Timeline:
    """
    The stamps of steps: ``start`` ns is that of step ``first``, every other follows from it.

    ``rate`` is in steps per second; a `Fraction` keeps 1/rate exact.
    """

    rate: Fraction
    start: int
    first: int = 0

    def stamp(self, step):
        """Return the stamp of a step in ns."""
        rate = self.rate
        return self.start + (
            (step - self.first) * NANOSECONDS * rate.denominator // rate.numerator)

    def skipped(self, periods):
        """Return the timeline in which the steps to come are so many periods later."""
        return replace(self, first=self.first - periods)

    def rebased(self, start, step):
        """Return the timeline in which ``step`` has the stamp ``start`` ns."""
        return replace(self, start=start, first=step)
