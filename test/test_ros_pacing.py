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

from boat_buoyancy.ros.pacing import CATCH_UP, NANOSECONDS, StepCounter, Timeline
import pytest


START = 1_795_415_697_933_873_175  # ns, a wall clock


@pytest.mark.parametrize('rate', [50.0, 60.0, 100.0, 999.0, 30.3])
def test_a_year_of_steps_is_counted_without_drift(rate):
    counter = StepCounter(rate, START)
    year = 365 * 24 * 3600
    steps = int(Fraction(rate) * year)
    counter.advance(steps)
    # Every due time is the ceiling of an exact fraction.
    assert counter.next_at() == START + -(-(steps + 1) * NANOSECONDS // Fraction(rate))
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


@pytest.mark.parametrize('rate', [60.0, 100.0, 999.0])
def test_stamps_follow_from_the_count_alone(rate):
    timeline = Timeline(Fraction(rate), START)
    count = 10 ** 9
    assert timeline.stamp(0) == START
    assert timeline.stamp(count) == START + count * NANOSECONDS // Fraction(rate)
    steps = [timeline.stamp(count + i + 1) - timeline.stamp(count + i) for i in range(1000)]
    # No period is off by more than the nanosecond that an integer cannot hold.
    assert max(steps) - min(steps) <= 1


def test_skipping_and_rebasing_move_what_comes_and_not_the_period():
    timeline = Timeline(Fraction(60.0), START)
    assert timeline.skipped(6).stamp(0) == START + NANOSECONDS // 10
    assert timeline.rebased(5, 100).stamp(100) == 5
    assert timeline.rebased(5, 100).stamp(160) == 5 + NANOSECONDS
