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
Measure what the node costs, and write doc/ros_speed.md.

    python benchmarks/ros_node.py [--seconds 10] [--out doc/ros_speed.md]

CPU time is that of the node's process alone; subscribers are in another process.
"""

import argparse
import os
from pathlib import Path
import platform
import random
import subprocess
import sys
import time

os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
os.environ.setdefault('ROS_DOMAIN_ID', str(1 + os.getpid() % 101))

from boat_buoyancy.physics.compiled import kind  # noqa: E402
from diagnostic_msgs.msg import DiagnosticArray  # noqa: E402
from geometry_msgs.msg import TwistStamped, WrenchStamped  # noqa: E402
import numpy as np  # noqa: E402

# What it shares with the tests: a node in a process of its own, and who listens to it.
TEST = Path(__file__).parents[1] / 'test'
sys.path.insert(0, str(TEST))
from ros_probe import BEST_EFFORT, compile_step, new_namespace, Probe, ROOT, wrench  # noqa: E402

OUTPUTS = ('pose', 'twist', 'odom', 'probe_depth')
EVERYTHING = (*OUTPUTS, 'probes', 'markers')
SENSORS = ('imu', 'fix')
THRUSTERS = {'thrusters.names': '[left, right]',
             'thrusters.positions': '[-1.5, 0.8, -0.4, -1.5, -0.8, -0.4]'}
RATES = (50.0, 100.0, 200.0, 500.0, 1000.0)

LISTENER = """
import sys
from ros_probe import Probe
from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, NavSatFix, PointCloud2
from std_msgs.msg import Float64, Float64MultiArray
from visualization_msgs.msg import MarkerArray
kinds = {'pose': PoseStamped, 'twist': TwistStamped, 'odom': Odometry,
         'probe_depth': Float64MultiArray, 'probes': PointCloud2, 'markers': MarkerArray,
         'imu': Imu, 'fix': NavSatFix}
with Probe(sys.argv[1], 'listener') as one:
    for topic in filter(None, sys.argv[2].split(',')):
        one.node.create_subscription(kinds[topic], topic, lambda message: None, 10)
    drive = [one.node.create_publisher(Float64, f'thrusters/{name}/thrust', 1)
             for name in sys.argv[3:]]
    one.node.create_timer(0.05, lambda: [each.publish(Float64(data=100.0)) for each in drive])
    print('there', flush=True)
    one.spin(1e6)
"""

# The node as it is, and the same steps driven in other ways.
SHIPPED = 'from boat_buoyancy.ros.node import main; main()'
SINGLE = """
from boat_buoyancy.ros import node, startup
startup.EventsExecutor = None
node.main()
"""
THREAD = """
import threading, time
import rclpy
from rclpy.executors import SingleThreadedExecutor
from boat_buoyancy.ros.node import BoatNode
rclpy.init()
boat = BoatNode()
def run():
    while True:
        time.sleep(boat.tick())
threading.Thread(target=run, daemon=True).start()
executor = SingleThreadedExecutor()
executor.add_node(boat)
executor.spin()
"""
# What one writes first: a timer, one step per tick, new messages.
PLAIN = """
import rclpy
from geometry_msgs.msg import PoseStamped, TwistStamped, WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from std_msgs.msg import Float64MultiArray
from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.boat.state import body_frame
rclpy.init()
node = Node('boat_buoyancy')
rate = node.declare_parameter('rate', 100.0).value
simulation = load_scene({'rate': rate}).simulation()
kinds = {'pose': PoseStamped, 'twist': TwistStamped, 'odom': Odometry,
         'probe_depth': Float64MultiArray}
out = {topic: node.create_publisher(kind, topic, 10) for topic, kind in kinds.items()}
def fill_pose(pose, position, orientation):
    pose.position.x, pose.position.y, pose.position.z = map(float, position)
    (pose.orientation.x, pose.orientation.y, pose.orientation.z,
     pose.orientation.w) = map(float, orientation)
def fill_twist(twist, velocity, spin):
    twist.linear.x, twist.linear.y, twist.linear.z = map(float, velocity)
    twist.angular.x, twist.angular.y, twist.angular.z = map(float, spin)
def tick():
    simulation.step()
    position, orientation, velocity, spin = body_frame(simulation.boat, simulation.state)
    stamp = node.get_clock().now().to_msg()
    pose, twist, odom = PoseStamped(), TwistStamped(), Odometry()
    for message in (pose, twist, odom):
        message.header.stamp = stamp
    fill_pose(pose.pose, position, orientation)
    fill_pose(odom.pose.pose, position, orientation)
    fill_twist(twist.twist, velocity, spin)
    fill_twist(odom.twist.twist, velocity, spin)
    depth = Float64MultiArray(data=list(map(float, simulation.probe_depths)))
    for topic, message in (('pose', pose), ('twist', twist), ('odom', odom),
                           ('probe_depth', depth)):
        out[topic].publish(message)
node.create_subscription(WrenchStamped, 'thrust', lambda message: None, 1)
node.create_timer(1.0 / rate, tick)
rclpy.spin(node)
"""


# One message a period in two ways, in turn; prints the us of each.
PUBLISH = """
import sys, time
import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from boat_buoyancy.ros.messages import set_pose, set_stamp
rclpy.init()
node, rate = Node('boat_buoyancy'), float(sys.argv[1])
publisher = node.create_publisher(PoseStamped, 'pose', 10)
kept = PoseStamped()
def send(message):
    set_stamp(message.header.stamp, 1_000_000_002)
    set_pose(message.pose, (1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 1.0))
    publisher.publish(message)
ways = (lambda: send(PoseStamped()), lambda: send(kept))
spent, count = [0, 0], int(float(sys.argv[2]) * rate)
while not publisher.get_subscription_count():
    time.sleep(0.1)
start = time.monotonic()
for i in range(2 * count):
    time.sleep(max(0.0, start + i / rate - time.monotonic()))
    began = time.thread_time_ns()
    ways[i % 2]()
    spent[i % 2] += time.thread_time_ns() - began
print(*(ns / count / 1e3 for ns in spent))
"""
LOOPS = {'own loop, EventsExecutor (shipped)': SHIPPED,
         'own loop, SingleThreadedExecutor': SINGLE,
         'own thread, SingleThreadedExecutor': THREAD,
         'timer, new messages, rclpy.spin': PLAIN}


class Running:
    """
    A node and a listener in processes of their own, while one measures.

    With ``driven`` the boat has two thrusters, which the listener drives 20 times a second.
    """

    def __init__(self, code, rate, topics, driven=False):
        """Start both and let them settle."""
        self.namespace = new_namespace()
        own = ['-p', 'status_period:=0.0'] if code is not PLAIN else []
        own += [word for name, value in THRUSTERS.items() if driven
                for word in ('-p', f'{name}:={value}')]
        self._node = subprocess.Popen(
            [sys.executable, '-c', code, '--ros-args', '-r', f'__ns:={self.namespace}',
             '-p', f'rate:={rate}', *own], cwd=ROOT, stderr=subprocess.DEVNULL)
        self._listener = subprocess.Popen(
            [sys.executable, '-c', LISTENER, self.namespace, ','.join(topics),
             *(('left', 'right') if driven else ())], cwd=TEST, stdout=subprocess.PIPE, text=True)
        self._listener.stdout.readline()
        time.sleep(3.0)

    def cpu(self):
        """Return the CPU time in s that the node has taken."""
        # The number that Linux gives to the CPU clock of another process: /proc counts in ticks
        # of 10 ms.
        return time.clock_gettime(~self._node.pid << 3 | 2)

    def __enter__(self):
        """Return itself."""
        return self

    def __exit__(self, *_):
        """End both."""
        for process in (self._node, self._listener):
            process.kill()
            process.wait()
        self._listener.stdout.close()


def load(code, rate, topics, seconds, driven=False):
    """Return the share of a core that a node takes."""
    with Running(code, rate, topics, driven) as running:
        before, began = running.cpu(), time.monotonic()
        time.sleep(seconds)
        return (running.cpu() - before) / (time.monotonic() - began)


def held(rate, seconds):
    """Return the rate held in Hz, steps dropped and the worst step in s, over all outputs."""
    with Running(SHIPPED, rate, OUTPUTS) as running, Probe(running.namespace) as one:
        diagnostics = one.listen(DiagnosticArray, '/diagnostics')
        one.until(lambda: diagnostics)
        del diagnostics[:]
        one.until(lambda: len(diagnostics) > seconds, timeout=2 * seconds + 10)
        values = [{item.key: item.value for item in message.status[0].values}
                  for message in diagnostics]
    times = [message.header.stamp.sec + message.header.stamp.nanosec / 1e9
             for message in diagnostics]
    steps = int(values[-1]['steps']) - int(values[0]['steps'])
    return (steps / (times[-1] - times[0]), int(values[-1]['steps dropped']),
            max(float(value['worst step (ms)']) for value in values) / 1e3)


def latency(rate, count):
    """Return (count,) s from sending a wrench to receiving the first twist that it moved."""
    chance, found = random.Random(0), []
    with Running(SHIPPED, rate, OUTPUTS) as running, Probe(running.namespace) as one:
        thrust = one.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
        got = []
        one.node.create_subscription(
            TwistStamped, 'twist',
            lambda message: got.append((time.monotonic(), message.twist.linear.x)), 10)
        one.until(lambda: got)
        force = 2000.0
        thrust.publish(wrench((force, 0.0, 0.0)))
        one.spin(0.3)
        while len(found) < count:
            # The other way: the first twist whose speed turns is the one that it moved.
            force, sign = -force, -np.sign(force)
            one.spin(chance.uniform(0.05, 0.08))
            del got[:-1]
            sent = time.monotonic()
            thrust.publish(wrench((force, 0.0, 0.0)))

            def turned():
                speeds = [speed for _, speed in got]
                turns = np.flatnonzero(np.diff(speeds) * sign > 0)
                return got[turns[0] + 1][0] if len(turns) else None
            found.append(one.until(turned) - sent)
    return np.array(found)


def publishing(rate, seconds):
    """Return the us of a new message, and of one filled again."""
    namespace = new_namespace()
    listener = subprocess.Popen([sys.executable, '-c', LISTENER, namespace, 'pose'], cwd=TEST,
                                stdout=subprocess.DEVNULL)
    try:
        found = subprocess.run(
            [sys.executable, '-c', PUBLISH, str(rate), str(seconds), '--ros-args', '-r',
             f'__ns:={namespace}'], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True)
    finally:
        listener.kill()
        listener.wait()
    return [float(value) for value in found.stdout.split()]


def table(head, rows):
    """Return lines of a Markdown table."""
    return ['| ' + ' | '.join(head) + ' |', '|' + '---|' * len(head),
            *('| ' + ' | '.join(row) + ' |' for row in rows), '']


def measure(seconds):
    """Yield the lines of the report."""
    with open('/proc/cpuinfo') as file:
        cpu = next((line.split(':')[1].strip() for line in file if 'model name' in line), '?')
    yield from (
        '# What the node costs', '',
        f'Measured by `python benchmarks/ros_node.py --seconds {seconds:g}` on {cpu}, '
        f'{os.cpu_count()} cores, Python {platform.python_version()}, NumPy {np.__version__}, '
        f'the step {kind()}; default scene (4 probes, flat water), one subscribing process, '
        'localhost. Shares are of one core, of the node alone; read ratios, not absolute times.',
        '',
        '## By output, 100 Hz', '')
    rows, none = [], load(SHIPPED, 100.0, (), seconds)
    for topics in ((), *((topic,) for topic in OUTPUTS), OUTPUTS, (*OUTPUTS, 'probes'),
                   EVERYTHING):
        share = load(SHIPPED, 100.0, topics, seconds) if topics else none
        rows.append((', '.join(topics) or 'nobody listens', f'{share:.1%}',
                     f'{share / 100.0 * 1e6:.0f}'))
    yield from table(('subscribed', 'core', 'us per period'), rows)
    yield from ('## With sensors, and two thrusters driven, 100 Hz', '')
    # In turn and twice, the better counts: other work on the machine can only add.
    shares = np.min([[load(SHIPPED, 100.0, EVERYTHING, seconds),
                      load(SHIPPED, 100.0, (*EVERYTHING, *SENSORS), seconds, driven=True)]
                     for _ in range(2)], axis=0)
    yield from table(
        ('subscribed', 'core', 'us per period', 'over the first'),
        [(name, f'{share:.1%}', f'{share / 100.0 * 1e6:.0f}', f'{share / shares[0]:.2f}')
         for name, share in zip((', '.join(EVERYTHING), 'these, imu, fix, and thrusts in'),
                                shares)])
    yield from ('## By executor and loop, all default outputs', '')
    rows = []
    for rate in (100.0, 1000.0):
        # In turn and twice, as above.
        shares = [[load(code, rate, OUTPUTS, seconds) for code in LOOPS.values()]
                  for _ in range(2)]
        best = np.min(shares, axis=0)
        rows += [(f'{rate:g} Hz', name, f'{share:.1%}', f'{share / rate * 1e6:.0f}',
                  f'{share / best[-1]:.2f}') for name, share in zip(LOOPS, best)]
    yield from table(('rate', 'node', 'core', 'us per period', 'over the last'), rows)
    yield from ('## Sending one PoseStamped to one subscriber, us', '')
    yield from table(('rate', 'new message', 'message filled again (shipped)'),
                     [(f'{rate:g} Hz', *(f'{value:.0f}' for value in publishing(rate, seconds)))
                      for rate in (100.0, 1000.0)])
    yield from ('## Rate held, all default outputs', '')
    rows = []
    for rate in RATES:
        achieved, dropped, worst = held(rate, seconds)
        rows.append((f'{rate:g} Hz', f'{achieved:.2f} Hz', str(dropped), f'{worst * 1e3:.1f} ms'))
    yield from table(('asked', 'held', 'steps dropped', 'worst step'), rows)
    yield from ('## Latency, wrench sent to first moved twist received', '')
    rows = []
    for rate in (50.0, 100.0, 200.0, 500.0):
        found = latency(rate, 200)
        middle, most = np.percentile(found, (50, 99))
        rows.append((f'{rate:g} Hz', f'{middle * 1e3:.1f} ms', f'{most * 1e3:.1f} ms',
                     f'{middle * rate:.2f}', f'{most * rate:.2f}'))
    yield from table(('rate', 'median', '99th percentile', 'median, periods',
                      '99th percentile, periods'), rows)


def main():
    """Measure and write."""
    parser = argparse.ArgumentParser(description=__doc__.split('\n\n')[0])
    parser.add_argument('--seconds', type=float, default=10.0)
    parser.add_argument('--out', type=Path, default=ROOT / 'doc' / 'ros_speed.md')
    given = parser.parse_args()
    compile_step({})
    lines = []
    for line in measure(given.seconds):
        print(line, flush=True)
        lines.append(line)
    given.out.write_text('\n'.join(lines))


if __name__ == '__main__':
    main()
