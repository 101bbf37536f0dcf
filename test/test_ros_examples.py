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

"""The examples do what they say: controllers that drive the boat, and parameters that fit it."""

import ast
import math
from pathlib import Path
import re
import shlex
import signal
import subprocess
import sys
import time

from boat_buoyancy.physics.scene.parameters import PARAMETERS
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist, WrenchStamped
from nav_msgs.msg import Odometry
from programs import loaded
import pytest
from readme import table, TEXT
from ros_probe import BoatProcess, Probe, ROOT
import yaml

EXAMPLES = ROOT / 'examples'
QUIET = {'status_period': 0.0}


class Example:
    """An example in a process of its own."""

    def __init__(self, name, *arguments):
        """Start it."""
        self.process = subprocess.Popen(
            [sys.executable, str(EXAMPLES / name), '--ros-args', *arguments],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
            text=True)

    def __enter__(self):
        """Return itself."""
        return self

    def __exit__(self, *_):
        """End it."""
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate(timeout=10.0)


def constants(name):
    """Return {name: number} of the constants at the top of an example."""
    lines = [node for node in ast.parse((EXAMPLES / name).read_text()).body
             if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant)]
    return {node.targets[0].id: node.value.value for node in lines}


# cmd_vel_to_thrusters.py

def held(gain, asked, linear, quadratic):
    """Return the speed at which a gain of what is missing meets drag: k (a - u) = l u + q u^2."""
    b = gain + linear
    return (-b + math.sqrt(b * b + 4.0 * quadratic * gain * asked)) / (2.0 * quadratic)


def head(name):
    """Return {words of a launch: arguments of the example beside it} of an example's head."""
    text = ast.get_docstring(ast.parse((EXAMPLES / name).read_text())).replace('\\\n', '')
    return {launch: shlex.split(arguments) for launch, arguments in re.findall(
        rf'^ +ros2 launch boat_buoyancy (.*)\n +python3 {name} --ros-args (.*)$', text,
        re.MULTILINE)}


# The namespace and the arguments of the boat that a launch file starts.
LAUNCHED = {
    'boat.launch.py scene:=wam_v namespace:=wamv': lambda: [
        '--params-file', str(ROOT / 'config' / 'wam_v.yaml')],
    'vrx.launch.py': lambda: [
        '--params-file', str(ROOT / 'launch' / 'vrx.yaml'),
        '--params-file', str(ROOT / 'config' / 'wam_v.yaml'), *remappings()]}


@pytest.mark.parametrize('launch', LAUNCHED)
def test_cmd_vel_is_held_as_far_as_its_gain_can_and_stops_when_it_falls_silent(launch):
    heads = head('cmd_vel_to_thrusters.py')
    assert [*heads] == [*LAUNCHED]
    # Numbers without a decimal point are numbers.
    with BoatProcess(QUIET, namespace='/wamv', arguments=LAUNCHED[launch]()) as boat, \
            Probe(boat.namespace) as probe, Example(
                'cmd_vel_to_thrusters.py', *heads[launch], '-p', 'speed_gain:=1000') as example:
        odometry = probe.listen(Odometry, 'sensors/position/ground_truth_odometry'
                                if launch.startswith('vrx') else 'odom')
        command = probe.publisher(Twist, 'cmd_vel')

        def drive(ahead, turn, goal, part):
            """Drive until a part of the twist is within 1 % of what drag leaves of it."""
            message = Twist()
            message.linear.x, message.angular.z = ahead, turn
            probe.until(lambda: odometry and part(odometry[-1].twist.twist) == pytest.approx(
                goal, rel=0.01), doing=lambda: command.publish(message))
        # Drag of the WAM-V: 100 u + 150 u^2 ahead, 800 r + 800 r^2 turning.
        drive(1.0, 0.0, held(1000.0, 1.0, 100.0, 150.0), lambda twist: twist.linear.x)
        drive(0.0, 0.3, held(1500.0, 0.3, 800.0, 800.0), lambda twist: twist.angular.z)
        # Without a command it does not push, though a boat of VRX holds its last thrust.
        probe.until(lambda: abs(odometry[-1].twist.twist.angular.z) < 0.02)
        example.process.send_signal(signal.SIGINT)
        assert example.process.wait(10.0) == 0


def test_cmd_vel_without_odom_is_one_line():
    with Probe('/nobody') as probe, \
            Example('cmd_vel_to_thrusters.py', '-r', '__ns:=/nobody') as example:
        command = probe.publisher(Twist, 'cmd_vel')
        started = time.monotonic()
        probe.until(lambda: time.monotonic() > started + 4.0,
                    doing=lambda: command.publish(Twist()))
        example.process.send_signal(signal.SIGINT)
        _, said = example.process.communicate(timeout=10.0)
        assert said.count('nothing comes on /nobody/odom, so nothing is driven: ') == 1


def test_more_turn_is_more_on_the_right():
    thrusts = loaded('cmd_vel_to_thrusters').thrusts
    gains = {'speed_gain': 1000.0, 'turn_gain': 1500.0, 'arm': 1.0}
    assert thrusts((1.0, 0.2), (0.5, 0.0), gains) == pytest.approx((100.0, 400.0))


# vrx_waypoint.py

def remappings():
    """Return the arguments by which vrx.launch.py gives topics the names of VRX."""
    tree = ast.parse((ROOT / 'launch' / 'vrx.launch.py').read_text())
    topics, = (ast.literal_eval(node.value) for node in tree.body
               if isinstance(node, ast.Assign) and node.targets[0].id == 'TOPICS')
    return [word for ours, theirs in topics.items() for word in ('-r', f'{ours}:={theirs}')]


def test_a_controller_written_for_vrx_brings_the_boat_of_the_launch_file_to_a_place():
    # 30 m to the north-west of a boat that heads east, four times as fast as real time.
    latitude, longitude = -33.724223 + 21.0 / 110_900.0, 150.679736 - 21.0 / 92_700.0
    with BoatProcess({**QUIET, 'publish_clock': True, 'time_factor': 4.0}, namespace='/wamv',
                     arguments=LAUNCHED['vrx.launch.py']()) as boat, Probe('/wamv') as probe:
        odometry = probe.listen(Odometry, 'sensors/position/ground_truth_odometry')
        probe.until(lambda: odometry)
        with Example('vrx_waypoint.py', '-p', f'latitude:={latitude}', '-p',
                     f'longitude:={longitude}') as example:
            probe.until(lambda: example.process.poll() is not None, 30.0)
            assert example.process.returncode == 0
        # Within 2 m, the antenna 0.85 m behind the origin; it glides a little farther.
        place = odometry[-1].pose.pose.position
        assert math.hypot(place.x + 21.0, place.y - 21.0) < 3.5
        assert boat.alive
        # The last thrust was none, and the boat has it.
        sent = []
        probe.node.create_subscription(DiagnosticArray, '/diagnostics', sent.append, 10)
        probe.until(lambda: sent)
        values = {item.key: item.value for item in sent[0].status[0].values}
        assert {values[f'thruster {side} (N)'] for side in ('left', 'right')} == {'0'}


# heading_hold.py

def test_the_controller_holds_a_heading_in_waves_and_ends_with_0():
    # Waves push with at most the probes' 254 N s/m abeam times 0.31 m/s of the water, a metre off
    # the middle: 80 N m, 0.04 rad of the controller's 2000 N m/rad. Roll and pitch add 0.0025.
    wanted, near = constants('heading_hold.py')['HEADING'], 0.05
    with BoatProcess({**QUIET, 'sea.waves': [0.2, 4.0, 0.8, 0.0]}) as boat, \
            Probe(boat.namespace) as probe, \
            Example('heading_hold.py', '-r', f'__ns:={boat.namespace}') as example:
        odometry = probe.listen(Odometry, 'odom')
        thrust = probe.listen(WrenchStamped, 'thrust')

        def off():
            q = odometry[-1].pose.pose.orientation
            return abs(2.0 * math.atan2(q.z, q.w) - wanted)
        # The boat lies half a radian off at first, and turns at once.
        probe.until(lambda: odometry and off() < near and abs(
            odometry[-1].twist.twist.angular.z) < near, 30.0)
        start, heard, worst = time.monotonic(), len(thrust), [0.0]
        probe.until(lambda: time.monotonic() > start + 5.0, doing=lambda: worst.append(off()))
        assert max(worst) < near
        assert len(thrust) - heard >= 50
        example.process.send_signal(signal.SIGINT)
        assert example.process.wait(10.0) == 0
        assert example.process.stderr.read() == ''
        assert boat.alive


def test_the_controller_ends_without_a_boat_as_well():
    with Example('heading_hold.py', '-r', '__ns:=/nobody') as example, Probe('/nobody') as probe:
        probe.until(lambda: probe.node.get_publishers_info_by_topic('/nobody/thrust'))
        example.process.send_signal(signal.SIGINT)
        assert example.process.wait(10.0) == 0


# robot_localization

def test_the_parameters_of_robot_localization_fit_the_boat():
    file = yaml.safe_load((EXAMPLES / 'robot_localization.yaml').read_text())
    nodes = {name: section['ros__parameters'] for name, section in file.items()}
    assert list(nodes) == ['/**/ekf', '/**/navsat_transform']
    ekf, navsat = nodes.values()
    kinds = {'odom': 'nav_msgs/msg/Odometry', 'imu': 'sensor_msgs/msg/Imu'}
    ours = {row[0]: row[1] for row in table('Topics') if row[2] == 'out'}
    for name in ('odom0', 'imu0', 'odom1'):
        assert [type(item) for item in ekf[f'{name}_config']] == [bool] * 15
        # What navsat_transform makes of fixes is the only topic that is not ours.
        assert ekf[name] == 'odometry/gps' or ours[ekf[name]] == kinds[name[:-1]]
    assert ours['fix'] == 'sensor_msgs/msg/NavSatFix'
    assert (ekf['odom_frame'], ekf['base_link_frame']) == (
        PARAMETERS['world_frame'].default, PARAMETERS['body_frame'].default)
    assert ekf['gravitational_acceleration'] == PARAMETERS['gravity'].default
    said = (EXAMPLES / 'robot_localization.launch.py').read_text()
    for name, value in zip(('latitude', 'longitude'), navsat['datum']):
        assert f'fix.{name}:={value}' in said


def test_every_example_is_named_on_a_page_and_installed():
    setup = (ROOT / 'setup.py').read_text()
    for path in filter(Path.is_file, EXAMPLES.iterdir()):
        assert f'examples/{path.name}' in TEXT, path.name
        assert f"glob('examples/*{path.suffix}')" in setup
