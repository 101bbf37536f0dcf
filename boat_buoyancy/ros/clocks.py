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
What the steps follow: the wall clock, a clock of their own, or a /clock from elsewhere.

A drive says how many steps are due now.  Time that the machine could not keep up with is given
up, counted, and said.
"""

from dataclasses import dataclass
import time

from .pacing import CATCH_UP, NANOSECONDS, StepCounter


@dataclass(frozen=True)
class Turn:
    """
    What a look at the clock gave.

    ``due`` steps to run now; ``dropped`` steps given up; ``moved_to`` ns, where the clock of the
    stamps jumped or started, else None.
    """

    due: int
    dropped: int = 0
    moved_to: int | None = None


class SteadyDrive:
    """
    Steps paced by the steady clock, whose stamps are a clock of their own.

    Main arguments: ``rate`` Hz; ``time_factor`` simulated over wall time, 0 = as fast as can be;
    ``start`` ns, the stamp of step 0.
    ``skips``: True when what is given up is lost to the boat, as stamps are another clock's; False
    when their own clock goes slower.
    """

    skips = False

    def __init__(self, rate, time_factor, start=0):
        """Start with the first turn."""
        self._free = time_factor == 0.0
        self._counter = StepCounter(rate * (time_factor or 1.0), 0)
        self._moved_to = start

    def turn(self):
        """Return the `Turn` of this moment."""
        if self._moved_to is not None:
            moved_to, self._moved_to = self._moved_to, None
            self._counter.restart(self._now())
            return Turn(0, moved_to=moved_to)
        if self._free:
            return Turn(1)
        now = self._now()
        dropped = self._counter.drop(now)
        return Turn(self._counter.due(now), dropped)

    def wait(self):
        """Return the s until a step is due, at least 0."""
        if self._free:
            return 0.0
        return max(0.0, (self._counter.next_at() - self._now()) / NANOSECONDS)

    def ran(self):
        """Count one step as run."""
        self._counter.advance()

    def resume(self):
        """Return how many steps to skip after a pause."""
        self._counter.restart(self._now())
        return 0

    def _now(self):
        return time.monotonic_ns()


class WallDrive(SteadyDrive):
    """
    Steps at the wall time that their stamps say, paced by the steady clock.

    The two clocks differ by a number, until the wall clock is stepped (by NTP, by hand, or while
    the machine slept); then the stamps follow.

    Main arguments: ``rate`` Hz; ``wall`` () -> ns; ``say``, called with a sentence on each step.
    """

    LOOK_PERIOD = 10 ** 9  # ns between comparisons of the clocks
    TOLERANCE = 2_000_000  # ns; more is a step
    APART = 100_000  # ns; readings of two clocks that are farther apart are no comparison
    skips = True

    def __init__(self, rate, wall, say):
        """Read both clocks."""
        self._wall, self._say = wall, say
        steady, now = self._read()
        self._ahead, self._next_look = now - steady, steady + self.LOOK_PERIOD
        super().__init__(rate, 1.0, now)

    def turn(self):
        """Return the `Turn` of this moment."""
        if self._moved_to is None and time.monotonic_ns() >= self._next_look:
            self._compare()
        return super().turn()

    def resume(self):
        """Return how many steps to skip after a pause."""
        missed = max(0, self._counter.due(self._now()))
        self._counter.advance(missed)
        return missed

    def _compare(self):
        """Follow the wall clock if it was stepped; what is due stays so."""
        steady, wall = self._read()
        self._next_look = steady + self.LOOK_PERIOD
        step = wall - steady - self._ahead
        if abs(step) <= self.TOLERANCE:
            return
        due = self._counter.due(steady + self._ahead)
        self._ahead += step
        self._counter.restart(wall)
        self._counter.advance(-due)
        self._moved_to = self._counter.done_at()
        self._say(f'the wall clock was stepped by {step / NANOSECONDS:+.3f} s: stamps and sea '
                  'follow')

    def _read(self):
        """Return the steady and the wall time of one moment, in ns."""
        while True:
            steady, wall = time.monotonic_ns(), self._wall()
            if time.monotonic_ns() - steady <= self.APART:
                return steady, wall

    def _now(self):
        return time.monotonic_ns() + self._ahead


class ClockDrive:
    """
    Steps driven by a /clock from elsewhere.

    Main arguments: ``rate`` Hz; ``clock`` () -> ns, 0 before the first message; ``say``, called
    with a sentence when the clock is missing, stands still, goes on or jumps back.
    """

    SILENCE = 5.0  # s
    STANDSTILL = 1.0  # s
    skips = True

    def __init__(self, rate, clock, say):
        """Wait for the first message."""
        self._rate, self._clock, self._say = rate, clock, say
        self._counter = None
        self._last, self._changed, self._said = 0, time.monotonic(), False

    def turn(self):
        """Return the `Turn` of this moment."""
        now, wall = self._clock(), time.monotonic()
        if now == self._last:
            self._watch(wall - self._changed)
            return Turn(0 if self._counter is None else self._counter.due(now))
        jumped_back, last = now < self._last, self._last
        if self._said:
            self._said = False
            self._say(f'/clock is there and at {now / NANOSECONDS:.3f} s' if last == 0 else
                      f'/clock goes on at {now / NANOSECONDS:.3f} s')
        self._last, self._changed = now, wall
        if self._counter is None:
            self._counter = StepCounter(self._rate, now)
            return Turn(0, moved_to=now)
        if jumped_back:
            self._say(f'/clock jumped back from {last / NANOSECONDS:.3f} s to '
                      f'{now / NANOSECONDS:.3f} s: the boat goes on from where it is')
            self._counter.restart(now)
            return Turn(0, moved_to=now)
        dropped = self._counter.drop(now)
        return Turn(self._counter.due(now), dropped)

    def wait(self):
        """Return 0 while a step is due, else as long as one likes: /clock will wake the node."""
        due = self._counter is not None and self._counter.due(self._clock()) > 0
        return 0.0 if due else CATCH_UP

    def ran(self):
        """Count one step as run."""
        if self._counter is not None:
            self._counter.advance()

    def resume(self):
        """Return how many steps to skip after a pause."""
        if self._counter is None:
            return 0
        missed = max(0, self._counter.due(self._clock()))
        self._counter.advance(missed)
        return missed

    def _watch(self, silent):
        """Say once that no time comes."""
        if self._said:
            return
        if self._last == 0 and silent > self.SILENCE:
            self._said = True
            self._say('use_sim_time is true and nothing has come on /clock for '
                      f'{self.SILENCE:g} s: nothing moves until it does; start what publishes '
                      '/clock, or set use_sim_time to false')
        elif self._last and silent > self.STANDSTILL:
            self._said = True
            self._say(f'/clock stands still at {self._last / NANOSECONDS:.3f} s: '
                      'the boat waits for it')
