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

"""Thrust, waves and poses from other nodes: what they do, and what is refused."""

from itertools import cycle
import math
import time

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.waves import Sea
from boat_buoyancy.ros.session import Session
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped, WrenchStamped
import numpy as np
import pytest
from rclpy.qos import QoSProfile
from ros_probe import BEST_EFFORT, BoatProcess, by_stamp, LATCHED, nanoseconds, Probe, wrench
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Float64MultiArray


# One probe's worth of drag only, so that surge is one line of algebra.
MASS, RETENTION = 2000.0, 0.8
GLIDER = {'damping.probe': 0.0, 'damping.linear_retention': [RETENTION], 'status_period': 0.0}
RATE = 100.0


def yaw_of(pose):
    """Return the heading of a Pose in rad."""
    q = pose.orientation
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


@pytest.fixture(scope='module')
def glider():
    """Start a boat without probe damping."""
    with BoatProcess(GLIDER) as process:
        yield process


@pytest.fixture(scope='module')
def probe(glider):
    """Look at it with one probe."""
    with Probe(glider.namespace) as one:
        one.thrust = one.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
        one.poses, one.twists, one.odometry, one.depths = one.listen_to_boat()
        one.waves = one.listen(Float64MultiArray, 'waves', LATCHED)
        one.diagnostics = one.listen(DiagnosticArray, '/diagnostics')
        one.until(lambda: one.poses and one.twists and one.waves)
        yield one


@pytest.fixture(autouse=True)
def fresh(probe):
    """Put the boat back to its start with no thrust before every test."""
    probe.trigger('reset')
    probe.spin(0.05)
    for messages in (probe.poses, probe.twists, probe.odometry, probe.depths):
        messages.clear()
    probe.until(lambda: probe.poses and probe.twists)


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


def test_a_refused_wrench_leaves_the_last_good_one_its_time_out(glider, probe):
    probe.thrust.publish(wrench((2000.0, 0.0, 0.0)))
    probe.until(lambda: probe.twists[-1].twist.linear.x > 0.0)
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
    # Throttled: hundreds refused, a line for each reason.
    assert glider.log.count("got 'map'") == 1


def test_speed_under_constant_thrust_follows_the_exponential(probe):
    with BoatProcess({**GLIDER, 'publish_clock': True, 'time_factor': 5.0,
                      'thrust.timeout': 0.0}) as boat, Probe(boat.namespace) as one:
        thrust = one.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
        twists = one.listen_to_boat()[1]
        one.until(lambda: twists)
        thrust.publish(wrench((500.0, 0.0, 0.0)))
        one.until(lambda: len(twists) > 1 and twists[-1].twist.linear.x > 0)
        start = next(i for i, m in enumerate(twists) if m.twist.linear.x > 0) - 1
        one.until(lambda: nanoseconds(twists[-1].header.stamp)
                  > nanoseconds(twists[start].header.stamp) + 10e9)
        time_s, speed = speeds(twists[start:])
    rate = -math.log(RETENTION)
    expected = 500.0 / (MASS * rate) * (1.0 - np.exp(-rate * time_s))
    assert time_s[-1] > 10.0
    np.testing.assert_allclose(speed[1:], expected[1:], rtol=0.02)


def test_waves_lift_the_boat_and_the_sea_in_force_is_shown(probe):
    waves = probe.publisher(Float64MultiArray, 'wave_parameters')
    level = probe.poses[-1].pose.position.z
    rows = [0.3, 3.0, 0.5, 0.25]
    waves.publish(Float64MultiArray(data=rows))
    probe.until(lambda: probe.waves[-1].data.tolist() == rows)
    probe.until(lambda: max(m.pose.position.z for m in probe.poses) > level + 0.15)
    probe.until(lambda: min(m.pose.position.z for m in probe.poses) < level - 0.15)
    waves.publish(Float64MultiArray(data=[]))
    probe.until(lambda: len(probe.waves[-1].data) == 0)


@pytest.mark.parametrize('rows, said', [
    ([0.1, 4.0, 0.0], 'four numbers a row, got 3 numbers'),
    ([0.1, 4.0, 0.0, 0.0, math.nan, 4.0, 0.0, 0.0], 'row 2 is [nan, 4.0, 0.0, 0.0]'),
    ([-0.1, 4.0, 0.0, 0.0], 'expected an amplitude of 0 to'),
    ([0.1, 0.0, 0.0, 0.0], 'expected a period of'),
    ([0.1, 4.0, 0.0, 0.0] * 1001, 'expected at most 1000 rows, got 1001'),
])
def test_bad_waves_are_refused_whole_and_the_sea_stays(glider, probe, rows, said):
    waves = probe.publisher(Float64MultiArray, 'wave_parameters')
    good = [0.05, 4.0, 0.0, 0.0]
    waves.publish(Float64MultiArray(data=good))
    probe.until(lambda: probe.waves[-1].data.tolist() == good)
    count = len(probe.waves)
    waves.publish(Float64MultiArray(data=rows))
    # The throttle lets a reason through once in five seconds.
    probe.until(lambda: said in glider.log, timeout=8.0,
                doing=lambda: waves.publish(Float64MultiArray(data=rows)))
    assert 'amplitude m, period s, direction rad, phase rad' in glider.log
    assert len(probe.waves) == count
    waves.publish(Float64MultiArray(data=[]))
    probe.until(lambda: len(probe.waves[-1].data) == 0)


def test_what_was_refused_is_counted_by_reason_in_the_diagnostics(probe):
    probe.diagnostics.clear()
    probe.thrust.publish(wrench((math.nan, 0.0, 0.0)))

    def counted():
        values = {item.key: item.value for array in probe.diagnostics
                  for status in array.status for item in status.values}
        return int(values.get('refused, thrust: not finite', 0)) > 0
    probe.until(counted)


def test_a_latched_publisher_that_came_first_is_heard():
    rows = [0.2, 5.0, 1.0, 0.5]
    with Probe('/latched_first') as one:
        publisher = one.node.create_publisher(Float64MultiArray, 'wave_parameters', LATCHED)
        publisher.publish(Float64MultiArray(data=rows))
        one.spin(0.2)
        with BoatProcess({'status_period': 0.0}, namespace='/latched_first') as boat:
            waves = one.listen(Float64MultiArray, 'waves', LATCHED)
            one.until(lambda: waves and waves[-1].data.tolist() == rows)
            # Later ones come by both subscriptions and count once.
            for phase in (0.1, 0.2, 0.3):
                publisher.publish(Float64MultiArray(data=[*rows[:3], phase]))
            one.until(lambda: waves[-1].data.tolist() == [*rows[:3], 0.3])
            one.spin(0.3)
            assert boat.log.count('waves: 1 in force') == 4
            assert 'incompatible' not in boat.log


def test_an_ordinary_publisher_is_heard_without_a_warning(glider, probe):
    publisher = probe.publisher(Float64MultiArray, 'wave_parameters', QoSProfile(depth=1))
    publisher.publish(Float64MultiArray(data=[0.01, 7.0, 0.0, 0.0]))
    probe.until(lambda: probe.waves[-1].data.tolist() == [0.01, 7.0, 0.0, 0.0])
    assert 'incompatible' not in glider.log
    publisher.publish(Float64MultiArray(data=[]))
    probe.until(lambda: len(probe.waves[-1].data) == 0)


def test_two_nodes_started_apart_see_the_same_water_at_the_same_stamp():
    rows = [0.3, 4.0, 0.3, 1.0, 0.1, 2.5, -1.0, 0.2]
    sea = {'sea.waves': rows, 'boat.mass': 2000.0, 'status_period': 0.0}
    with BoatProcess(sea) as first, Probe(first.namespace) as probe:
        poses, _, _, _ = probe.listen_to_boat()
        clouds = probe.listen(PointCloud2, 'probes')
        probe.until(lambda: poses)
        probe.spin(5.0)
        with BoatProcess(sea) as second:
            others = probe.listen(PointCloud2, f'{second.namespace}/probes')
            probe.until(lambda: len(others) > 100)
    water = Sea(rows)
    for messages in (clouds, others):
        for stamp, message in list(by_stamp(messages).items())[-50:]:
            x, y, z, depth, _ = np.frombuffer(message.data.tobytes(), '<f4').reshape(-1, 5).T
            # The surface over each probe is that of one sea of all stamps.
            expected = water.elevation(x.astype(float), y.astype(float), stamp / 1e9)
            np.testing.assert_allclose(z + depth, expected, atol=2e-6)


def test_initialpose_puts_the_boat_there_floating_at_its_draft(probe):
    place = probe.publisher(PoseWithCovarianceStamped, 'initialpose')
    message = PoseWithCovarianceStamped()
    message.header.frame_id = 'odom'
    position, orientation = message.pose.pose.position, message.pose.pose.orientation
    position.x, position.y, position.z = 12.0, -7.0, 99.0
    orientation.z, orientation.w = math.sin(0.4), math.cos(0.4)
    place.publish(message)
    probe.until(lambda: probe.poses[-1].pose.position.x == 12.0)
    pose = probe.poses[-1].pose
    assert pose.position.y == -7.0 and yaw_of(pose) == pytest.approx(0.8, abs=1e-9)
    assert pose.position.z == pytest.approx(0.5 - 2000.0 / 8200.0, abs=1e-9)


@pytest.mark.parametrize('spoil, said', [
    (lambda m: setattr(m.header, 'frame_id', 'map'), "'odom', got 'map'"),
    (lambda m: setattr(m.pose.pose.position, 'x', math.nan), 'expected finite numbers'),
    (lambda m: setattr(m.pose.pose.orientation, 'w', 0.0), 'expected a unit quaternion')])
def test_a_bad_initialpose_is_refused(glider, probe, spoil, said):
    place = probe.publisher(PoseWithCovarianceStamped, 'initialpose')
    message = PoseWithCovarianceStamped()
    message.pose.pose.position.x, message.pose.pose.orientation.w = 50.0, 1.0
    spoil(message)
    place.publish(message)
    glider.wait_for_log(said)
    probe.spin(0.1)
    assert abs(probe.poses[-1].pose.position.x) < 1.0


def test_the_sea_and_the_boat_agree_with_a_sea_of_all_time():
    # A sea of absolute stamps loses nothing to the size of the numbers.
    stamp = 1_795_415_697_933_873_175
    sea = Sea([[0.3, 4.0, 0.3, 1.0]])
    session = Session(load_scene({'sea.waves': [0.3, 4.0, 0.3, 1.0]}))
    session.rebase(stamp)
    periods, rest = divmod(stamp, 4_000_000_000)
    expected = sea.elevation(1.0, 2.0, rest / 1e9)
    assert session.simulation.sea.elevation(1.0, 2.0, 0.0) == pytest.approx(expected, abs=1e-12)
