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

Stamps lie on a grid, the multiples of 1/rate, so that those of several boats are the same.
`StepCounter` compares steps done with the grid of a clock; `Timeline` turns steps into stamps.
Both are exact for any rate: they count in integers and fractions.
"""

from dataclasses import dataclass, replace
from fractions import Fraction

NANOSECONDS = 10 ** 9

# Steps missed in a hitch up to this long are run afterwards; after a longer one the boat does not
# race through the past, it goes on from the present.
CATCH_UP = 1.0  # s


class Grid:
    """The multiples of 1/rate, in whole ns rounded down; ``rate`` in Hz."""

    def __init__(self, rate):
        """Keep the period as a fraction."""
        rate = Fraction(rate)
        # Whole numbers from here on: a Fraction costs more than a step's share of the loop.
        self._steps, self._span = rate.numerator, rate.denominator * NANOSECONDS

    def stamp(self, period):
        """Return when a period begins, in ns."""
        return period * self._span // self._steps

    def period(self, now):
        """Return the number of the period that ``now`` ns is in: the last that has begun."""
        return -(-(now + 1) * self._steps // self._span) - 1


class StepCounter:
    """
    Steps due on a clock that only goes forward: one with each period of its grid that begins.

    Main arguments: ``rate`` steps per second of that clock; ``now`` ns, in the period of step 0.
    Other arguments: ``catch_up`` s, the longest hitch whose steps are run late and not dropped.
    """

    def __init__(self, rate, now, *, catch_up=CATCH_UP):
        """Start counting at ``now``."""
        self._grid = Grid(rate)
        self._limit = max(1, int(Fraction(rate) * Fraction(catch_up)))
        self.restart(now)

    def restart(self, now):
        """Forget what was missed: the step of the period that ``now`` ns is in is done."""
        self._done = self._grid.period(now)

    def due(self, now):
        """Return how many steps are due at ``now`` ns; negative when ahead of the clock."""
        return self._grid.period(now) - self._done

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

    def done_at(self):
        """Return when the last step that was done was due, in ns."""
        return self._grid.stamp(self._done)

    def next_at(self):
        """Return when the next step is due, in ns."""
        return self._grid.stamp(self._done + 1)


@dataclass(frozen=True)
class Timeline:
    """The stamps of steps: that of step n is the beginning of period ``offset`` + n of a grid."""

    grid: Grid
    offset: int = 0

    def stamp(self, step):
        """Return the stamp of a step in ns."""
        return self.grid.stamp(self.offset + step)

    def skipped(self, periods):
        """Return the timeline in which the steps to come are so many periods later."""
        return replace(self, offset=self.offset + periods)

    def rebased(self, start, step):
        """Return the timeline in which ``step`` is that of the period ``start`` ns is in."""
        return replace(self, offset=self.grid.period(start) - step)
