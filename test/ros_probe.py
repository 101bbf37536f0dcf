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
What the tests over real DDS share: the node in a process of its own, and a probe that talks to it.

The probe spins only while it waits, in the thread of the test, with a context of its own.
"""

from collections import Counter
from itertools import count
import json
import math
import os
from pathlib import Path
import signal
import subprocess
import sys
import threading
import time

from boat_buoyancy.physics import load_scene
from geometry_msgs.msg import PoseStamped, TwistStamped, WrenchStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.srv import (DescribeParameters, GetParameters, ListParameters, SetParameters,
                                SetParametersAtomically)
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float64MultiArray
from std_srvs.srv import SetBool, Trigger


ROOT = Path(__file__).parents[1]
DEADLINE = 10.0  # s; the first message takes 0.6 s, sometimes 3.6
DEEP = QoSProfile(depth=5000)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
NAME = 'boat_buoyancy'

# Runs the program once for every list of arguments, in one process: that spares its imports.
RUNS = """
import json, signal, sys
from boat_buoyancy.ros import node  # before the clock ticks
from boat_buoyancy.ros.main import main
signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
seconds = float(sys.argv[2])
for arguments in json.loads(sys.argv[1]):
    sys.argv = ['buoyancy_node', *arguments]
    signal.setitimer(signal.ITIMER_REAL, seconds)
    print('status', main(), file=sys.stderr, flush=True)
"""

_namespaces = count()


def new_namespace():
    """Return a namespace that no other test has."""
    return f'/test_{os.getpid()}_{next(_namespaces)}'


def as_argument(value):
    """Return a parameter's value as the command line takes it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (list, tuple)):
        return '[' + ', '.join(as_argument(item) for item in value) + ']'
    return str(value)


def compile_step(parameters):
    """Compile what a node will run: done by the first on a machine, it outlasts the deadline."""
    load_scene({name: parameters[name] for name in ('integrator', 'hull.probes')
                if name in parameters}).simulation()


def run_and_end(commands, seconds=0.0):
    """
    Return (exit status, lines on standard error) of the program for each list of arguments.

    After so many ``seconds`` each gets a SIGINT; 0 = never.
    """
    compile_step({})
    done = subprocess.run(
        [sys.executable, '-c', RUNS, json.dumps(commands), str(seconds)], cwd=ROOT,
        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
        timeout=60.0)
    ends, lines = [], []
    for line in done.stderr.splitlines():
        if line.startswith('status '):
            ends.append((int(line.split()[1]), lines))
            lines = []
        else:
            lines.append(line)
    assert len(ends) == len(commands), done.stderr
    return ends


class BoatProcess:
    """
    The node in a process of its own; its log lines are read as they come.

    ``parameters`` {name: value}; ``arguments`` more of the command line, after --ros-args;
    ``environment`` {name: value} of variables that are other than here; ``script``, Python that
    runs the node in place of its module; ``prefix``, a command that runs the process.
    """

    def __init__(self, parameters=None, *, namespace=None, arguments=(), environment=None,
                 script=None, prefix=()):
        """Start it."""
        compile_step(parameters or {})
        self.namespace = new_namespace() if namespace is None else namespace
        program = ['-m', 'boat_buoyancy.ros.node'] if script is None else ['-c', script]
        command = [*prefix, sys.executable, *program, '--ros-args',
                   '-r', f'__ns:={self.namespace}', *arguments]
        for name, value in (parameters or {}).items():
            command += ['-p', f'{name}:={as_argument(value)}']
        self.process = subprocess.Popen(
            command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE, text=True, env={**os.environ, **(environment or {})})
        self.lines = []
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self.process.stderr:
            self.lines.append(line.rstrip('\n'))

    @property
    def log(self):
        """Return all that it has said on standard error."""
        return '\n'.join(self.lines)

    @property
    def alive(self):
        """Return True while the process runs."""
        return self.process.poll() is None

    def wait_for_log(self, text, timeout=DEADLINE):
        """Return the line that holds ``text``; fail when it does not come."""
        deadline = time.monotonic() + timeout
        while True:
            for line in list(self.lines):
                if text in line:
                    return line
            assert time.monotonic() < deadline, f'no {text!r} in the log:\n{self.log}'
            time.sleep(0.02)

    def end(self, *signals, timeout=DEADLINE):
        """Send signals and return the exit status."""
        for number in signals:
            self.process.send_signal(number)
        status = self.process.wait(timeout)
        self._reader.join(timeout)
        return status

    def close(self):
        """End it whatever state it is in."""
        if self.alive:
            self.process.send_signal(signal.SIGCONT)
            self.process.kill()
        self.process.wait(DEADLINE)
        self._reader.join(DEADLINE)
        self.process.stderr.close()

    def __enter__(self):
        """Return itself."""
        return self

    def __exit__(self, *_):
        """End it."""
        self.close()


class Probe:
    """A node of the tests, in the namespace of the boat it looks at."""

    def __init__(self, namespace, name='probe', parameters=()):
        """Join the graph."""
        self.context = Context()
        self.context.init()
        self.node = Node(name, namespace=namespace, context=self.context,
                         parameter_overrides=list(parameters))
        self._executor = SingleThreadedExecutor(context=self.context)
        self._executor.add_node(self.node)
        self.received = {}

    def close(self):
        """Leave the graph."""
        self._executor.shutdown()
        self.node.destroy_node()
        self.context.try_shutdown()

    def __enter__(self):
        """Return itself."""
        return self

    def __exit__(self, *_):
        """Leave the graph."""
        self.close()

    def listen(self, kind, topic, qos=DEEP):
        """Return the list that messages of a topic are appended to from now on."""
        messages = self.received.setdefault(topic, [])
        self.node.create_subscription(kind, topic, messages.append, qos)
        return messages

    def listen_to_boat(self):
        """Return the lists of pose, twist, odom and probe_depth."""
        return (self.listen(PoseStamped, 'pose'), self.listen(TwistStamped, 'twist'),
                self.listen(Odometry, 'odom'), self.listen(Float64MultiArray, 'probe_depth'))

    def spin(self, seconds):
        """Take what comes for a while."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            self._executor.spin_once(deadline - time.monotonic())

    def until(self, condition, timeout=DEADLINE, *, doing=None):
        """
        Spin until ``condition`` () is true, and return what it gave; fail after ``timeout`` s.

        ``doing`` () is called over and over meanwhile, at 50 Hz.
        """
        deadline, again = time.monotonic() + timeout, 0.0
        while True:
            result = condition()
            if result:
                return result
            now = time.monotonic()
            assert now < deadline, 'it did not come to pass in time'
            if doing is not None and now >= again:
                again = now + 0.02
                doing()
            self._executor.spin_once(0.02)

    def publisher(self, kind, topic, qos=QoSProfile(depth=10)):
        """Return a publisher that the boat listens to."""
        publisher = self.node.create_publisher(kind, topic, qos)
        self.until(lambda: publisher.get_subscription_count() > 0)
        return publisher

    def call(self, kind, service, request=None, timeout=DEADLINE):
        """Return what a service answers."""
        client = self.node.create_client(kind, service)
        self.until(client.service_is_ready, timeout)
        future = client.call_async(kind.Request() if request is None else request)
        self.until(future.done, timeout)
        self.node.destroy_client(client)
        return future.result()

    def trigger(self, service):
        """Call a Trigger service of the boat."""
        return self.call(Trigger, f'{NAME}/{service}')

    def set_paused(self, paused):
        """Pause the boat or let it run."""
        return self.call(SetBool, f'{NAME}/set_paused', SetBool.Request(data=paused))

    def set_parameters(self, values):
        """Set one parameter after the other; return the results."""
        request = SetParameters.Request(parameters=_messages(values))
        return self.call(SetParameters, f'{NAME}/set_parameters', request).results

    def set_atomically(self, values):
        """Set several parameters at once; return the result."""
        request = SetParametersAtomically.Request(parameters=_messages(values))
        return self.call(
            SetParametersAtomically, f'{NAME}/set_parameters_atomically', request).result

    def get_parameters(self, names):
        """Return {name: ParameterValue}."""
        request = GetParameters.Request(names=list(names))
        values = self.call(GetParameters, f'{NAME}/get_parameters', request).values
        return dict(zip(names, values))

    def list_parameters(self):
        """Return the names of all parameters."""
        return self.call(ListParameters, f'{NAME}/list_parameters').result.names

    def describe(self, names):
        """Return {name: ParameterDescriptor}."""
        request = DescribeParameters.Request(names=list(names))
        answer = self.call(DescribeParameters, f'{NAME}/describe_parameters', request)
        return {descriptor.name: descriptor for descriptor in answer.descriptors}


def _messages(values):
    return [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]


def yaw_of(pose):
    """Return the heading of a Pose in rad."""
    q = pose.orientation
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def nanoseconds(stamp):
    """Return a stamp in ns."""
    return stamp.sec * 10 ** 9 + stamp.nanosec


def by_stamp(messages):
    """Return {stamp ns: message}."""
    return {nanoseconds(message.header.stamp): message for message in messages}


def wrench(force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0), frame=''):
    """Return a WrenchStamped."""
    message = WrenchStamped()
    message.header.frame_id = frame
    message.wrench.force.x, message.wrench.force.y, message.wrench.force.z = map(float, force)
    message.wrench.torque.x, message.wrench.torque.y, message.wrench.torque.z = map(float, torque)
    return message


def missing_periods(messages, rate):
    """Return how many periods between the first and the last of stamped messages are missing."""
    periods = Counter(round(nanoseconds(message.header.stamp) * rate / 10 ** 9)
                      for message in messages)
    return max(periods) - min(periods) + 1 - len(periods)
