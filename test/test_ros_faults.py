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

"""What must not disturb the node: floods, garbage, deaf and dying neighbours."""

from array import array
import math
import os
import random
import signal
import subprocess
import sys
import time

from boat_buoyancy.physics.scene.parameters import PARAMETERS
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import (PoseWithCovarianceStamped, Vector3, Vector3Stamped,
                               WrenchStamped)
import numpy as np
import pytest
from rcl_interfaces.msg import Parameter as ParameterMessage, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from ros_probe import BEST_EFFORT, BoatProcess, NAME, nanoseconds, Probe, wrench
from sensor_msgs.msg import Imu, NavSatFix
from std_msgs.msg import Float64, Float64MultiArray


RATE = 100.0
# All that a boat can have.
BOAT = {'sea.waves': [0.05, 4.0, 0.0, 0.0], 'status_period': 0.0, 'imu.accelerometer_noise': 0.05,
        'imu.orientation_noise': 0.01, 'fix.noise': [0.5, 1.0],
        'thrusters.names': ['left', 'right'],
        'thrusters.positions': [-1.5, 0.8, -0.4, -1.5, -0.8, -0.4], 'thrusters.lag': 0.1,
        'thrusters.limits': [-500.0, 1000.0, -500.0, 1000.0]}


@pytest.fixture(scope='module')
def boat():
    """Start one boat for all that it has to bear."""
    with BoatProcess(BOAT) as process:
        yield process


@pytest.fixture(scope='module')
def probe(boat):
    """Look at it with one probe."""
    with Probe(boat.namespace) as one:
        one.poses, one.twists, _, one.depths = one.listen_to_boat()
        one.imu, one.fix = one.listen(Imu, 'imu'), one.listen(NavSatFix, 'fix')
        one.diagnostics = one.listen(DiagnosticArray, '/diagnostics')
        one.until(lambda: one.poses and one.depths and one.imu and one.fix)
        yield one


class Steady:
    """Checks on leaving that the node is alive, kept its rate, and sent finite numbers only."""

    def __init__(self, boat, probe):
        """Look at one boat through one probe."""
        self._boat, self._probe = boat, probe

    def __enter__(self):
        """Begin to count."""
        self._probe.until(lambda: self._steps() is not None)
        self._before = self._steps()
        probe = self._probe
        for messages in (probe.poses, probe.twists, probe.depths, probe.imu, probe.fix):
            messages.clear()
        return self

    def __exit__(self, kind, *_):
        """Compare."""
        if kind is not None:
            return
        probe, (stamp, steps) = self._probe, self._before
        # Long enough that a hitch that is being caught up does not count.
        probe.until(lambda: self._steps()[0] > stamp + 4.0)
        later, more = self._steps()
        assert self._boat.alive
        assert (more - steps) / (later - stamp) == pytest.approx(RATE, rel=0.05)
        for message in probe.poses:
            place, turned = message.pose.position, message.pose.orientation
            assert all(map(math.isfinite, (place.x, place.y, place.z, turned.x, turned.w)))
        for message in probe.depths:
            assert all(map(math.isfinite, message.data))
        for message in probe.imu:
            felt, turned = message.linear_acceleration, message.orientation
            assert all(map(math.isfinite, (felt.x, felt.y, felt.z, turned.x, turned.w)))
        for message in probe.fix:
            assert all(map(math.isfinite, (message.latitude, message.longitude,
                                           message.altitude)))
        # An IMU message for every pose, a fix for every tenth, but for what is on its way.
        assert len(probe.poses) > 300
        assert len(probe.imu) == pytest.approx(len(probe.poses), abs=10)
        assert 10 * len(probe.fix) == pytest.approx(len(probe.poses), rel=0.15)

    def _steps(self):
        """Return the stamp in s and the steps of the last diagnostics."""
        for message in reversed(self._probe.diagnostics):
            for status in message.status:
                if status.hardware_id == f'{self._boat.namespace}/{NAME}':
                    steps = next(v.value for v in status.values if v.key == 'steps')
                    return nanoseconds(message.header.stamp) / 1e9, int(steps)
        return None


@pytest.fixture
def steady(boat, probe):
    """Watch over a boat while something happens to it."""
    return Steady(boat, probe)


# Sends wrenches, or thrusts for the thruster that is named.
FLOOD = """
import sys, time
from ros_probe import BEST_EFFORT, Probe, wrench
from geometry_msgs.msg import WrenchStamped
from std_msgs.msg import Float64
with Probe(sys.argv[1], 'flood') as one:
    name = sys.argv[3:]
    message = Float64(data=2000.0) if name else wrench((2000.0, 0.0, 0.0))
    topic = f'thrusters/{name[0]}/thrust' if name else 'thrust'
    thrust, sent = one.publisher(type(message), topic, BEST_EFFORT), 0
    start = time.monotonic()
    while (now := time.monotonic() - start) < float(sys.argv[2]):
        while sent < 5000 * now:
            thrust.publish(message)
            sent += 1
        time.sleep(0.0005)
    print(sent / now)
"""


@pytest.mark.parametrize('thruster', [(), ('left',)], ids=['wrenches', 'thrusts'])
@pytest.mark.parametrize('seconds', [3.0, pytest.param(30.0, marks=pytest.mark.long)])
def test_five_thousand_commands_a_second(boat, probe, steady, seconds, thruster):
    with steady:
        flood = subprocess.Popen(
            [sys.executable, '-c', FLOOD, boat.namespace, str(seconds), *thruster],
            cwd=os.path.dirname(__file__), stdout=subprocess.PIPE, text=True)
        probe.until(lambda: flood.poll() is not None, timeout=seconds + 20.0)
        assert float(flood.stdout.read()) > 4000.0
        # A thruster gives half of what a wrench does.
        assert probe.twists[-1].twist.linear.x > (0.07 if thruster else 0.15)
    probe.trigger('reset')


def bad_messages():
    """Yield (topic, message) of every kind that is wrong."""
    nan, inf = math.nan, math.inf
    for force in ((nan, 0.0, 0.0), (0.0, inf, 0.0), (0.0, 0.0, -inf), (1e308, 0.0, 0.0)):
        yield 'thrust', wrench(force)
        yield 'thrust', wrench(torque=force)
    for frame in ('map', 'x' * 10_000, '/odom', '\u00e9'):
        yield 'thrust', wrench((1.0, 0.0, 0.0), frame=frame)
    for rows in ([1.0], [0.1, 4.0, 0.0], [nan] * 4, [0.1, inf, 0.0, 0.0], [1e308] * 4,
                 [0.1, 1e308, 0.0, 0.0], [-0.1, 4.0, 0.0, 0.0], [0.1, 0.0, 0.0, 0.0],
                 [0.1, -4.0, 0.0, 0.0], [0.1, 4.0, 0.0, 0.0] * 1001, [0.1] * 4001,
                 [0.1, 4.0, 0.0, 0.0] * 10_000):
        yield 'wave_parameters', Float64MultiArray(data=rows)
    for x, w, frame in ((nan, 1.0, ''), (1e308, 1.0, ''), (0.0, 0.0, ''), (0.0, inf, ''),
                        (0.0, 1.0, 'map')):
        message = PoseWithCovarianceStamped()
        message.header.frame_id = frame
        message.pose.pose.position.x, message.pose.pose.orientation.w = x, w
        yield 'initialpose', message
    for x, z, frame in ((nan, 0.0, ''), (0.0, inf, ''), (1e308, 0.0, ''), (1.0, 0.1, ''),
                        (1.0, 0.0, 'map')):
        message = Vector3Stamped(vector=Vector3(x=x, z=z))
        message.header.frame_id = frame
        yield 'wind', message
    for value in (nan, inf, -inf):
        for part in ('thrust', 'pos'):
            yield f'thrusters/left/{part}', Float64(data=value)


@pytest.mark.parametrize('count', [2_000, pytest.param(10_000, marks=pytest.mark.long)])
def test_malformed_messages_of_every_kind(boat, probe, steady, count):
    kinds = {'thrust': WrenchStamped, 'wave_parameters': Float64MultiArray,
             'initialpose': PoseWithCovarianceStamped, 'wind': Vector3Stamped,
             'thrusters/left/thrust': Float64, 'thrusters/left/pos': Float64}
    publishers = {topic: probe.publisher(kind, topic, BEST_EFFORT if 'thrust' in topic
                                         else QoSProfile(depth=1000))
                  for topic, kind in kinds.items()}
    bad = list(bad_messages())
    with steady:
        place = probe.poses[-1].pose.position if probe.poses else None
        for i in range(count):
            topic, message = bad[i % len(bad)]
            publishers[topic].publish(message)
            # Each kind is read once at least: some topics keep the last message only.
            if i < len(bad):
                probe.spin(0.05)
            elif i % 20 == 0:
                probe.spin(0.01)
        probe.spin(1.0)
    assert place is None or abs(probe.poses[-1].pose.position.x - place.x) < 1.0
    for reason in ('expected finite numbers', 'expected frame_id', 'four numbers a row',
                   'expected an amplitude', 'expected at most 1000 rows',
                   'times the weight', 'expected a unit quaternion', 'wind: expected a z of 0',
                   'thrusters/left/thrust: expected finite', 'thrusters/left/pos: expected fin'):
        assert reason in boat.log, reason
    # Throttled: a reason is not said more than once in five seconds.
    assert len(boat.lines) < count / 20


def test_ten_million_values(boat, probe, steady):
    publisher = probe.publisher(Float64MultiArray, 'wave_parameters')
    huge = Float64MultiArray()
    huge.data = array('d', bytes(8 * 10_000_000))
    with steady:
        for _ in range(2):
            publisher.publish(huge)
            probe.spin(2.0)
        boat.wait_for_log('got a message of 80000')


def random_value(parameter, chance):
    """Return a value for a parameter, good, bad, or of another type."""
    kind = chance.randrange(8)
    if kind == 0:
        return chance.choice(['text', True, 3, 2.5, [1.0, 2.0], [], [1, 2], ['a'], math.nan,
                              -math.inf, 1e308, -1.0, 0.0])
    default = parameter.default
    if isinstance(default, (bool, str)) or default is None:
        return chance.choice([default if default is not None else 'x', 1.0, [0.1, 4.0, 0.0, 0.0]])
    scale = chance.choice([0.5, 0.9, 1.0, 1.1, 2.0, -1.0, 1e300])

    def scaled(item):
        # An integer has 64 bits on its way.
        return (item * scale if isinstance(item, float)
                else int(max(-2.0 ** 62, min(2.0 ** 62, item * scale))))

    return [scaled(item) for item in default] if isinstance(default, tuple) else scaled(default)


@pytest.mark.parametrize('count', [100, pytest.param(1000, marks=pytest.mark.long)])
def test_random_parameter_sets_while_moving(boat, probe, steady, count):
    chance = random.Random(5)
    names = list(PARAMETERS)
    client = probe.node.create_client(SetParameters, f'{NAME}/set_parameters')
    probe.until(client.service_is_ready)
    answers = []
    with steady:
        for _ in range(count):
            name = chance.choice(names)
            value = random_value(PARAMETERS[name], chance)
            message = ParameterMessage(name=name)
            if value == []:
                message.value = ParameterValue(type=8)
            else:
                message.value = Parameter(name, value=value).get_parameter_value()
            future = client.call_async(SetParameters.Request(parameters=[message]))
            probe.until(future.done)
            answers += future.result().results
    refused = [answer.reason for answer in answers if not answer.successful]
    assert len(answers) == count and 0 < len(refused) < count
    assert all(refused)
    # A type that does not exist must not end it either.
    request = SetParameters.Request(parameters=[
        ParameterMessage(name='boat.mass', value=ParameterValue(type=77))])
    client.call_async(request)
    boat.wait_for_log('a request was not understood')
    probe.set_atomically({'boat.mass': 2000.0, 'sea.waves': [0.05, 4.0, 0.0, 0.0]})
    probe.trigger('reset')


def test_a_publisher_that_is_killed_and_restarted(boat, probe, steady):
    with steady:
        for _ in range(3):
            pusher = subprocess.Popen(
                [sys.executable, '-c', FLOOD, boat.namespace, '30.0'],
                cwd=os.path.dirname(__file__), stdout=subprocess.DEVNULL)
            probe.twists.clear()
            probe.until(lambda: probe.twists and probe.twists[-1].twist.linear.x > 0.15)
            pusher.send_signal(signal.SIGKILL)
            pusher.wait()
            probe.trigger('reset')


DEAF = """
import sys, time
from ros_probe import Probe
with Probe(sys.argv[1], 'deaf') as one:
    one.listen_to_boat()
    print('there', flush=True)
    time.sleep(60.0)
"""


@pytest.fixture
def deaf(boat):
    """Start a subscriber of every topic that never reads."""
    process = subprocess.Popen([sys.executable, '-c', DEAF, boat.namespace],
                               cwd=os.path.dirname(__file__), stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout.readline() == 'there\n'
        yield process
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


def test_a_subscriber_that_never_reads(probe, steady, deaf):
    with steady:
        probe.spin(3.0)


def test_a_subscriber_that_was_stopped_is_borne_when_it_is_gone(probe, steady, deaf):
    # Once in some hundred times it is stopped while it holds a lock of Fast DDS's shared memory,
    # and who writes there waits for as long (doc/troubleshooting.md, where publishing is slow).
    deaf.send_signal(signal.SIGSTOP)
    probe.spin(3.0)
    deaf.kill()
    deaf.wait()
    # What was held up comes first, with the stamp of then.
    probe.diagnostics.clear()
    probe.until(lambda: len(probe.diagnostics) > 1)
    with steady:
        probe.spin(1.0)


def memory_of(process):
    """Return the resident memory of a process in MB."""
    with open(f'/proc/{process.pid}/statm') as file:
        return int(file.read().split()[1]) * os.sysconf('SC_PAGE_SIZE') / 1e6


@pytest.mark.long
def test_ten_minutes_of_everything_neither_grow_nor_lose_a_step():
    chance = random.Random(1)
    seconds = float(os.environ.get('BOAT_BUOYANCY_SOAK', '600'))
    values = {**BOAT, 'sea.waves': [], 'sea.sea_state': 3, 'status_period': 5.0}
    with BoatProcess(values) as boat, Probe(boat.namespace) as one:
        thrust = one.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
        drive = [one.publisher(Float64, f'thrusters/{topic}', BEST_EFFORT)
                 for topic in ('left/thrust', 'right/thrust', 'left/pos')]
        waves = one.publisher(Float64MultiArray, 'wave_parameters')
        lists = *one.listen_to_boat(), one.listen(Imu, 'imu'), one.listen(NavSatFix, 'fix')
        diagnostics = one.listen(DiagnosticArray, '/diagnostics')
        last, missing, dropped, memory = None, 0, 0, []
        start = time.monotonic()

        def push():
            thrust.publish(wrench((chance.uniform(-500, 500), 0.0, 0.0),
                                  (0.0, 0.0, chance.uniform(-100, 100))))
            for publisher, most in zip(drive, (1000.0, 1000.0, 1.0)):
                publisher.publish(Float64(data=chance.uniform(-most, most)))

        while time.monotonic() < start + seconds:
            end = time.monotonic() + 5.0
            one.until(lambda: time.monotonic() > end, timeout=20.0, doing=push)
            waves.publish(Float64MultiArray(data=[
                chance.uniform(0.0, 0.3), chance.uniform(2.0, 8.0), chance.uniform(-3, 3), 0.0]))
            stamps = np.array([nanoseconds(message.header.stamp) for message in lists[0]])
            if last is not None:
                stamps = np.concatenate([[last], stamps])
            missing += int((np.diff(stamps) // 10_000_000 - 1).sum())
            last = int(stamps[-1])
            for message in diagnostics:
                for status in message.status:
                    dropped = int({v.key: v.value for v in status.values}['steps dropped'])
            for messages in (*lists, diagnostics):
                messages.clear()
            memory.append(memory_of(boat.process))
        warm = memory[min(len(memory) // 5, 12):]
        print(f'{seconds:.0f} s: {missing} periods missing, {dropped} dropped by its own count, '
              f'memory {warm[0]:.2f} to {warm[-1]:.2f} MB, most {max(warm):.2f}')
        # No step is lost that is not said.
        assert missing == dropped
        assert max(warm) - warm[0] < 2.0
        assert boat.end(signal.SIGINT) == 0
