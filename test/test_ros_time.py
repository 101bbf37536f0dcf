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

"""Time: the steady clock, a clock of its own, a /clock from elsewhere, and stops."""

import signal
import time

from boat_buoyancy.physics.sea.waves import Sea
import numpy as np
import pytest
from ros_probe import BoatProcess, by_stamp, nanoseconds, Probe
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import PointCloud2


PERIOD = 10_000_000  # ns, at 100 Hz
WAVES = [0.2, 4.0, 0.3, 1.0]


def stamps_of(messages):
    """Return the stamps of messages in ns."""
    return np.array([nanoseconds(message.header.stamp) for message in messages])


def check_water(clouds, rows, last=20):
    """Check that probes lie under the surface of one sea of all stamps."""
    for stamp, message in list(by_stamp(clouds).items())[-last:]:
        x, y, z, depth, _ = np.frombuffer(message.data.tobytes(), '<f4').reshape(-1, 5).T
        expected = Sea(rows).elevation(x.astype(float), y.astype(float), stamp / 1e9)
        np.testing.assert_allclose(z + depth, expected, atol=2e-6)


def test_publish_clock_makes_it_the_source_of_time_from_0_on():
    with Probe('/own_clock') as one:
        clock, poses = one.listen(Clock, '/clock'), one.listen_to_boat()[0]
        with BoatProcess({'publish_clock': True, 'status_period': 0.0},
                         namespace='/own_clock') as boat:
            one.until(lambda: len(poses) > 50 and len(clock) > 50)
            assert boat.alive
            one.set_paused(True)
            one.spin(0.2)
            still = nanoseconds(clock[-1].clock)
            # Who comes while time stands still learns it, too.
            clock.clear()
            one.until(lambda: clock, timeout=3.0)
            assert nanoseconds(clock[-1].clock) == still
            one.set_paused(False)
            one.until(lambda: nanoseconds(clock[-1].clock) > still + 20 * PERIOD)
    stamps = stamps_of(poses)
    assert 0 <= stamps[0] < 10_000_000_000
    # No leap over the pause: the time is the boat's own.
    assert set(np.diff(stamps)) <= {PERIOD, 0}


@pytest.mark.parametrize('factor, lowest, highest', [(5.0, 4.8, 5.2), (0.5, 0.48, 0.52),
                                                     (0.0, 2.0, 1e9)])
def test_time_factor_sets_the_pace(factor, lowest, highest):
    with BoatProcess({'publish_clock': True, 'time_factor': factor,
                      'status_period': 0.0}) as boat, Probe(boat.namespace) as one:
        poses = one.listen_to_boat()[0]
        one.until(lambda: len(poses) > 20)
        began, first = time.monotonic(), stamps_of(poses)[-1]
        one.spin(2.0)
        pace = (stamps_of(poses)[-1] - first) / 1e9 / (time.monotonic() - began)
        assert lowest < pace < highest
        assert boat.end(signal.SIGINT) == 0


def test_time_factor_without_a_clock_is_warned_of():
    with BoatProcess({'time_factor': 2.0}) as boat:
        boat.wait_for_log('publish_clock is false')


def test_an_external_clock_drives_the_steps_pauses_and_jumps_back():
    with Probe('/external') as one:
        publisher = one.node.create_publisher(Clock, '/clock', 10)
        clouds = one.listen(PointCloud2, 'probes')
        poses = one.listen_to_boat()[0]
        state = {'time': 100 * 10 ** 9}

        def tick(periods=1):
            state['time'] += periods * PERIOD
            message = Clock()
            message.clock.sec, message.clock.nanosec = divmod(state['time'], 10 ** 9)
            publisher.publish(message)

        with BoatProcess({'use_sim_time': True, 'status_period': 0.0, 'sea.waves': WAVES,
                          'sea.transition': 1.0}, namespace='/external') as boat:
            boat.wait_for_log('nothing has come on /clock')
            assert poses == []
            # Steps come with the clock, five for a tick of five periods.
            one.until(lambda: len(poses) > 100, doing=lambda: tick(5))
            boat.wait_for_log('/clock is there')
            stamps = stamps_of(poses)
            assert stamps[0] > 100 * 10 ** 9 and set(np.diff(stamps)) == {PERIOD}
            check_water(clouds, WAVES)
            # It stands still: nothing moves, and that is said.
            boat.wait_for_log('/clock stands still')
            one.spin(0.1)
            count = len(poses)
            one.spin(0.3)
            assert len(poses) == count
            # It goes on, and the boat with it.
            one.until(lambda: len(poses) > count + 50, doing=lambda: tick(5))
            boat.wait_for_log('/clock goes on')
            # It jumps back: stamps follow, the boat stays where it is.
            one.spin(0.2)
            before = poses[-1].pose.position
            count = len(poses)
            state['time'] = 20 * 10 ** 9
            one.until(lambda: len(poses) > count + 50, doing=lambda: tick(5))
            boat.wait_for_log('jumped back')
            stamps = stamps_of(poses[count:])
            assert stamps[0] < 21 * 10 ** 9 and set(np.diff(stamps)) == {PERIOD}
            after = poses[count].pose.position
            assert abs(after.z - before.z) < 0.02
            # When the fade is over, the water is that of the new stamps.
            one.until(lambda: stamps_of(poses)[-1] > stamps[0] + 1.5e9, doing=lambda: tick(5))
            clouds.clear()
            one.until(lambda: len(clouds) > 30, doing=lambda: tick(5))
            check_water(clouds, WAVES)
            # Far ahead in one go: given up, said, and the stamps keep up.
            state['time'] += 60 * 10 ** 9
            one.until(lambda: stamps_of(poses)[-1] > 80 * 10 ** 9, doing=lambda: tick(5))
            boat.wait_for_log('fell behind')


# Its wall clock goes back by an hour and a bit at a signal.
STEPPED = """
import signal, sys, time
real, ahead = time.time_ns, [0]
time.time_ns = lambda: real() + ahead[0]
signal.signal(signal.SIGUSR1, lambda *_: ahead.append(ahead.pop() - 3_600_250_000_000))
from boat_buoyancy.ros.node import main
sys.exit(main())
"""


def test_stamps_and_sea_follow_a_wall_clock_that_steps_back_and_no_step_is_dropped():
    with BoatProcess({'status_period': 0.0, 'sea.waves': WAVES, 'sea.transition': 0.5},
                     script=STEPPED) as boat, Probe(boat.namespace) as one:
        poses, clouds = one.listen_to_boat()[0], one.listen(PointCloud2, 'probes')
        one.until(lambda: len(poses) > 50 and clouds)
        began, first = time.monotonic(), len(poses)
        boat.process.send_signal(signal.SIGUSR1)
        one.spin(3.0)
        count, lasted = len(poses) - first, time.monotonic() - began
        line = boat.wait_for_log('the wall clock was stepped by -3600.250 s')
        assert boat.log.count('stepped') == 1 and '[WARN]' in line
        stamps = stamps_of(poses)
        assert (stamps % PERIOD == 0).all()
        back, = np.flatnonzero(np.diff(stamps) < 0)
        assert set(np.diff(stamps[:back + 1])) == set(np.diff(stamps[back + 1:])) == {PERIOD}
        assert abs(time.time_ns() - 3_600_250_000_000 - stamps[-1]) < 0.1e9
        # The boat is shown once more with its new stamp.
        assert count == pytest.approx(lasted * 100 + 1, abs=5)
        assert 'fell behind' not in boat.log
        clouds.clear()
        one.until(lambda: len(clouds) > 30)
        check_water(clouds, WAVES)


def test_a_process_that_was_stopped_goes_on_from_the_present_and_says_so():
    with BoatProcess({'status_period': 0.0, 'sea.waves': WAVES, 'sea.transition': 0.5}) as boat, \
            Probe(boat.namespace) as one:
        poses, clouds = one.listen_to_boat()[0], one.listen(PointCloud2, 'probes')
        one.until(lambda: len(poses) > 50 and clouds)
        boat.process.send_signal(signal.SIGSTOP)
        # A second of it would be caught up with.
        one.spin(2.5)
        boat.process.send_signal(signal.SIGCONT)
        poses.clear()
        one.until(lambda: len(poses) > 200)
        line = boat.wait_for_log('fell behind')
        dropped = int(line.split('fell behind: ')[1].split()[0])
        assert 230 <= dropped <= 270
        # The rate is held again, stamps are wall time, and the water is that of the stamps.
        stamps = stamps_of(poses)
        assert set(np.diff(stamps[-150:])) == {PERIOD}
        assert abs(time.time_ns() - stamps[-1]) < 0.5e9
        clouds.clear()
        one.until(lambda: len(clouds) > 30)
        check_water(clouds, WAVES)


def test_a_short_hitch_loses_no_step():
    with BoatProcess({'status_period': 0.0}) as boat, Probe(boat.namespace) as one:
        poses = one.listen_to_boat()[0]
        one.until(lambda: len(poses) > 50)
        boat.process.send_signal(signal.SIGSTOP)
        one.spin(0.4)
        boat.process.send_signal(signal.SIGCONT)
        count = len(poses)
        one.until(lambda: len(poses) > count + 100)
        assert set(np.diff(stamps_of(poses))) == {PERIOD}
        assert 'fell behind' not in boat.log
