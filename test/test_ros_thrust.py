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

"""Thrust from other nodes: what it does, how long it acts, and what is refused."""

from itertools import cycle
import math
import time

from boat_buoyancy.ros.thrust import ThrustLatch
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped, WrenchStamped
import numpy as np
import pytest
from ros_probe import BEST_EFFORT, BoatProcess, by_stamp, nanoseconds, Probe, wrench, yaw_of


# One probe's worth of drag only, so that surge is one line of algebra.
MASS, RETENTION = 2000.0, 0.8
GLIDER = {'damping.probe': 0.0, 'damping.linear_retention': [RETENTION], 'status_period': 0.0}
RATE = 100.0


def quarter_turn():
    """Return the orientation of a boat heading along world y."""
    return (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))


def test_a_latch_holds_until_the_time_out_and_0_holds_for_ever():
    latch = ThrustLatch(0.5)
    assert latch.wrench(0.0, quarter_turn) is None and latch.age(0.0) is None
    latch.hold((1.0, 2.0, 3.0, 4.0, 5.0, 6.0), False, 10.0)
    assert latch.wrench(10.5, quarter_turn) == (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert latch.wrench(10.51, quarter_turn) is None
    latch.timeout = 0.0
    assert latch.wrench(1e9, quarter_turn) is not None
    latch.clear()
    assert latch.wrench(1e9, quarter_turn) is None


def test_a_wrench_in_world_axes_is_turned_by_the_attitude_of_the_moment():
    latch = ThrustLatch(0.5)
    latch.hold((0.0, 7.0, 0.0, 0.0, 3.0, 0.0), True, 0.0)
    np.testing.assert_allclose(latch.wrench(0.1, quarter_turn), (7.0, 0.0, 0.0, 3.0, 0.0, 0.0),
                               atol=1e-12)
    np.testing.assert_allclose(latch.wrench(0.1, lambda: (0.0, 0.0, 0.0, 1.0)),
                               (0.0, 7.0, 0.0, 0.0, 3.0, 0.0), atol=1e-12)


@pytest.fixture(scope='module')
def glider():
    """Start a boat without probe damping."""
    with BoatProcess(GLIDER) as process:
        yield process


@pytest.fixture(scope='module')
def listener(glider):
    """Look at it with one probe."""
    with Probe(glider.namespace) as one:
        one.thrust = one.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
        one.poses, one.twists, one.odometry, one.depths = one.listen_to_boat()
        one.diagnostics = one.listen(DiagnosticArray, '/diagnostics')
        one.until(lambda: one.poses and one.twists)
        yield one


@pytest.fixture
def probe(listener):
    """Return the probe once the boat is back at its start with no thrust."""
    listener.trigger('reset')
    listener.spin(0.05)
    for messages in (listener.poses, listener.twists, listener.odometry, listener.depths):
        messages.clear()
    listener.until(lambda: listener.poses and listener.twists)
    return listener


def speeds(messages):
    """Return stamps s from the first, and surge speeds, of TwistStamped messages."""
    stamps = np.array([nanoseconds(message.header.stamp) for message in messages])
    return (stamps - stamps[0]) / 1e9, np.array([m.twist.linear.x for m in messages])


def test_twist_is_in_body_axes_at_90_degrees_of_yaw(probe):
    place = probe.publisher(PoseWithCovarianceStamped, 'initialpose')
    message = PoseWithCovarianceStamped()
    message.header.frame_id = 'odom'
    message.pose.pose.orientation.z = message.pose.pose.orientation.w = math.sqrt(0.5)
    place.publish(message)
    probe.until(lambda: abs(yaw_of(probe.poses[-1].pose) - math.pi / 2) < 1e-6)
    probe.until(lambda: probe.twists[-1].twist.linear.x > 0.1,
                doing=lambda: probe.thrust.publish(wrench((2000.0, 0.0, 0.0))))
    # Ahead is +x of the boat and +y of the world.
    assert abs(probe.twists[-1].twist.linear.y) < 1e-9
    probe.spin(0.1)
    poses = by_stamp(probe.odometry)
    stamps = sorted(poses)[-2:]
    before, after = (poses[stamp].pose.pose.position for stamp in stamps)
    assert after.y - before.y > 0.0009 and abs(after.x - before.x) < 1e-9
    speed = (after.y - before.y) / ((stamps[1] - stamps[0]) / 1e9)
    middle = np.mean([poses[stamp].twist.twist.linear.x for stamp in stamps])
    # The mean of both ends is the middle to h^2 d a / 8 = 3e-6 m/s.
    assert speed == pytest.approx(middle, abs=1e-5)


def test_a_wrench_in_the_world_frame_keeps_its_direction_while_the_boat_turns(probe):
    push = wrench((0.0, 2000.0, 0.0), frame='odom')
    place = probe.publisher(PoseWithCovarianceStamped, 'initialpose')
    message = PoseWithCovarianceStamped()
    message.pose.pose.orientation.z = message.pose.pose.orientation.w = math.sqrt(0.5)
    place.publish(message)
    probe.until(lambda: abs(yaw_of(probe.poses[-1].pose) - math.pi / 2) < 1e-6)
    probe.until(lambda: probe.twists[-1].twist.linear.x > 0.05,
                doing=lambda: probe.thrust.publish(push))
    assert abs(probe.twists[-1].twist.linear.y) < 1e-9


def test_a_wrench_in_the_body_frame_acts_along_the_boat(probe):
    probe.until(lambda: probe.twists[-1].twist.linear.y > 0.05, doing=lambda: probe.thrust.publish(
        wrench((0.0, 2000.0, 0.0), frame='base_link')))


def test_thrust_falls_to_zero_half_a_second_after_the_last_wrench(probe):
    probe.thrust.publish(wrench((2000.0, 0.0, 0.0)))
    probe.until(lambda: probe.twists[-1].twist.linear.x > 0.0)
    probe.spin(1.0)
    time_s, speed = speeds(probe.twists)
    pushed = np.flatnonzero(np.diff(speed) > 0)
    # One wrench pushes for the time-out: 50 periods, give or take what the message was late.
    assert 49 <= len(pushed) <= 52
    assert pushed[-1] - pushed[0] == len(pushed) - 1
    # What is left is the drag of the retention.
    after = speed[pushed[-1] + 2:]
    np.testing.assert_allclose(after[1:] / after[:-1], RETENTION ** (1 / RATE), rtol=1e-4)


def test_in_slow_motion_thrust_lasts_its_time_out_on_the_slow_clock():
    with BoatProcess({**GLIDER, 'publish_clock': True, 'time_factor': 0.2}) as boat, \
            Probe(boat.namespace) as one:
        thrust = one.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
        twists = one.listen_to_boat()[1]
        one.until(lambda: twists)
        thrust.publish(wrench((2000.0, 0.0, 0.0)))
        one.until(lambda: twists[-1].twist.linear.x > 0.0)
        one.spin(3.5)
    _, speed = speeds(twists)
    # Half a second of it is two and a half on the wall.
    assert 49 <= np.count_nonzero(np.diff(speed) > 0) <= 52


def test_a_refused_wrench_leaves_the_last_good_one_its_time_out(glider, probe):
    # The boat may still glide from before: felt is what makes it faster, by 1 cm/s a period.
    probe.until(lambda: probe.twists and probe.thrust.get_subscription_count())
    before = probe.twists[-1].twist.linear.x
    probe.thrust.publish(wrench((2000.0, 0.0, 0.0)))
    probe.until(lambda: probe.twists[-1].twist.linear.x > before + 0.005)
    bad = [wrench((math.nan, 0.0, 0.0)), wrench((math.inf, 0.0, 0.0)),
           wrench((-2000.0, 0.0, 0.0), frame='map'), wrench((1e308, 0.0, 0.0))]
    start, next_bad = time.monotonic(), cycle(bad)
    probe.until(lambda: time.monotonic() > start + 1.0,
                doing=lambda: probe.thrust.publish(next(next_bad)))
    _, speed = speeds(probe.twists)
    pushed = np.flatnonzero(np.diff(speed) > 0)
    assert 49 <= len(pushed) <= 52
    assert np.isfinite(speed).all() and speed.min() >= 0.0
    assert "expected frame_id empty or 'base_link' or 'odom', got 'map'" in glider.log
    assert 'expected finite numbers, got [' in glider.log
    # Throttled: dozens refused, a line for each reason; but every one is counted.
    assert glider.log.count("got 'map'") == 1

    def counted():
        values = {item.key: item.value for array in probe.diagnostics
                  for status in array.status for item in status.values}
        return int(values.get('refused, thrust: not finite', 0)) > 10
    probe.until(counted)


def test_speed_under_constant_thrust_follows_the_exponential():
    with BoatProcess({**GLIDER, 'publish_clock': True, 'time_factor': 5.0,
                      'thrust.timeout': 0.0}) as boat, Probe(boat.namespace) as one:
        thrust = one.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
        twists = one.listen_to_boat()[1]
        one.until(lambda: twists)
        one.until(lambda: len(twists) > 1 and twists[-1].twist.linear.x > 0,
                  doing=lambda: thrust.publish(wrench((500.0, 0.0, 0.0))))
        start = next(i for i, m in enumerate(twists) if m.twist.linear.x > 0) - 1
        one.until(lambda: nanoseconds(twists[-1].header.stamp)
                  > nanoseconds(twists[start].header.stamp) + 10e9)
        time_s, speed = speeds(twists[start:])
    rate = -math.log(RETENTION)
    expected = 500.0 / (MASS * rate) * (1.0 - np.exp(-rate * time_s))
    assert time_s[-1] > 10.0
    np.testing.assert_allclose(speed[1:], expected[1:], rtol=0.02)
