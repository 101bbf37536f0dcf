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

"""Steps, stamps and clocks, without ROS."""

from fractions import Fraction

from boat_buoyancy.ros import clocks
from boat_buoyancy.ros.pacing import CATCH_UP, Grid, NANOSECONDS, StepCounter, Timeline
import pytest


START = 1_795_415_697_933_873_175  # ns, a wall clock


@pytest.mark.parametrize('rate', [50.0, 60.0, 100.0, 999.0, 30.3])
def test_a_year_of_steps_is_counted_without_drift(rate):
    counter = StepCounter(rate, START)
    year = 365 * 24 * 3600
    steps = int(Fraction(rate) * year)
    counter.advance(steps)
    # Every due time is a multiple of the exact period, rounded down.
    first = START * Fraction(rate) // NANOSECONDS
    assert counter.next_at() == (first + steps + 1) * NANOSECONDS // Fraction(rate)
    assert counter.due(counter.next_at() - 1) == 0
    assert counter.due(counter.next_at()) == 1


def test_a_hitch_is_caught_up_and_a_long_stop_is_given_up():
    counter = StepCounter(100.0, 0)
    assert counter.drop(int(0.9 * NANOSECONDS)) == 0
    assert counter.due(int(0.9 * NANOSECONDS)) == 90
    assert CATCH_UP == 1.0
    assert counter.drop(5 * NANOSECONDS) == 499
    assert counter.due(5 * NANOSECONDS) == 1


def test_steps_ahead_of_the_clock_wait_for_it():
    counter = StepCounter(100.0, 0)
    counter.advance(5)
    assert counter.due(0) == -5
    assert counter.due(60_000_000) == 1


def test_a_slow_rate_is_never_dropped_before_it_is_due():
    counter = StepCounter(0.1, 0)
    assert counter.drop(9 * NANOSECONDS) == 0 and counter.due(9 * NANOSECONDS) == 0
    assert counter.drop(10 * NANOSECONDS) == 0 and counter.due(10 * NANOSECONDS) == 1


@pytest.mark.parametrize('rate', [0.1, 30.3, 60.0, 100.0, 999.0])
def test_stamps_are_multiples_of_the_period_to_the_nanosecond(rate):
    timeline = Timeline(Grid(rate)).rebased(START, 5)
    period = NANOSECONDS / Fraction(rate)
    assert START - period < timeline.stamp(5) <= START
    count = 10 ** 9
    for step in (5, count, count + 1, count + 1000):
        multiple = round(timeline.stamp(step) / period)
        assert 0 <= multiple * period - timeline.stamp(step) < 1
        # What lies in a period, its first and its last ns too, belongs to it.
        for now in (timeline.stamp(step), timeline.stamp(step + 1) - 1):
            assert timeline.rebased(now, step) == timeline


@pytest.mark.parametrize('rate', [30.3, 60.0, 999.0])
def test_who_follows_the_stamps_of_another_steps_once_for_each(rate):
    others = Timeline(Grid(rate)).rebased(START, 0)
    counter = StepCounter(rate, others.stamp(0))
    for step in range(1, 1000):
        assert counter.due(others.stamp(step)) == 1
        counter.advance()


def test_skipping_and_rebasing_move_what_comes_and_not_the_period():
    timeline = Timeline(Grid(60.0))
    assert timeline.skipped(6).stamp(0) == NANOSECONDS // 10
    assert timeline.rebased(NANOSECONDS, 100).stamp(100) == NANOSECONDS
    assert timeline.rebased(NANOSECONDS, 100).stamp(160) == 2 * NANOSECONDS


class Clocks:
    """A steady clock and a wall clock that a test moves, in ns."""

    def __init__(self):
        """Begin at some time."""
        self.steady, self.ahead, self.lost = 10 ** 12, START - 10 ** 12, 0

    def monotonic_ns(self):
        """Return the steady time."""
        return self.steady

    def wall(self):
        """Return the wall time; what is lost passes while it is read, once."""
        self.steady, self.lost = self.steady + self.lost, 0
        return self.steady + self.ahead


@pytest.fixture
def hands(monkeypatch):
    """Put hands of the test in place of those of the drives."""
    hands = Clocks()
    monkeypatch.setattr(clocks, 'time', hands)
    return hands


def run(driven, hands, seconds):
    """Run what is due at 1 kHz for a while; return how many steps, and where stamps moved to."""
    steps, moves = 0, []
    for _ in range(round(seconds * 1000)):
        turn = driven.turn()
        assert not turn.dropped
        moves += [] if turn.moved_to is None else [turn.moved_to]
        for _ in range(turn.due):
            driven.ran()
        steps += turn.due
        hands.steady += 1_000_000
    return steps, moves


@pytest.mark.parametrize('step', [3600.0, -3600.25, 0.004, 86400.0 * 3650])
def test_stamps_follow_a_wall_clock_that_steps_within_a_second_and_it_is_said_once(hands, step):
    said = []
    driven = clocks.WallDrive(100.0, hands.wall, said.append)
    steps, (start,) = run(driven, hands, 3.0)
    assert start == START and steps in (299, 300) and not said
    hands.ahead += round(step * 1e9)
    steps, (moved_to,) = run(driven, hands, 3.0)
    # Where the wall clock is, on the grid, within the second that lies between two looks.
    assert moved_to % 10_000_000 == 0
    assert 0 <= moved_to - (START + 3_000_000_000 + round(step * 1e9)) + 10_000_000 < 1_020_000_000
    # No step is lost, none is run twice.
    assert steps in (299, 300, 301)
    assert said == [f'the wall clock was stepped by {step:+.3f} s: stamps and sea follow']
    assert run(driven, hands, 3.0)[1] == [] and len(said) == 1


def test_what_stops_the_process_between_two_readings_is_no_step_of_the_clock(hands):
    said = []
    driven = clocks.WallDrive(100.0, hands.wall, said.append)
    run(driven, hands, 1.5)
    hands.lost = 50_000_000
    steps, moves = run(driven, hands, 1.5)
    assert not moves and not said and steps in (154, 155, 156)
