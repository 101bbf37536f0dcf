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

"""Start, reset, pause, single steps, another place, faults of the motion, a namesake."""

import math
import re
import subprocess
import sys

from boat_buoyancy.physics import load_scene
from boat_buoyancy.ros.complaints import Refused
from boat_buoyancy.ros.initial_pose import read_place
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseWithCovarianceStamped, WrenchStamped
import numpy as np
import pytest
from ros_probe import (BEST_EFFORT, BoatProcess, LATCHED, NAME, nanoseconds, Probe, ROOT,
                       run_and_end, wrench, yaw_of)
from std_msgs.msg import Float64MultiArray


PERIOD = 10_000_000  # ns, at 100 Hz


@pytest.fixture(scope='module')
def boat():
    """Start one boat that starts with way on and holds its thrust."""
    with BoatProcess({'start.position': [3.0, 4.0], 'thrust.timeout': 0.0,
                      'status_period': 0.0}) as process:
        yield process


@pytest.fixture(scope='module')
def probe(boat):
    """Look at it with one probe."""
    with Probe(boat.namespace) as one:
        one.thrust = one.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
        one.poses, one.twists, _, _ = one.listen_to_boat()
        one.waves = one.listen(Float64MultiArray, 'waves', LATCHED)
        one.until(lambda: one.poses and one.waves and one.twists)
        yield one


def test_reset_restores_state_and_thrust_while_sea_and_time_go_on(probe):
    rows = [0.05, 4.0, 0.0, 0.0]
    waves = probe.publisher(Float64MultiArray, 'wave_parameters')
    waves.publish(Float64MultiArray(data=rows))
    probe.thrust.publish(wrench((3000.0, 0.0, 0.0)))
    probe.until(lambda: probe.poses[-1].pose.position.x > 3.2)
    before = nanoseconds(probe.poses[-1].header.stamp)
    probe.poses.clear()
    answer = probe.trigger('reset')
    assert answer.success
    probe.until(lambda: probe.poses and abs(probe.poses[-1].pose.position.x - 3.0) < 0.05)
    probe.spin(0.5)
    # No thrust any more, though the time-out is to hold: only the small orbits of the wave.
    assert abs(probe.poses[-1].pose.position.x - 3.0) < 0.1
    stamps = np.array([nanoseconds(message.header.stamp) for message in probe.poses])
    assert stamps[0] > before - PERIOD and (np.diff(stamps) >= 0).all()
    assert probe.waves[-1].data.tolist() == rows
    waves.publish(Float64MultiArray(data=[]))


def test_step_is_refused_unless_paused(probe):
    answer = probe.trigger('step')
    assert not answer.success and 'set_paused' in answer.message


def test_a_paused_boat_stands_still_and_steps_one_period_at_a_time(probe):
    assert probe.set_paused(True).success
    probe.spin(0.3)
    probe.poses.clear()
    probe.spin(0.3)
    assert probe.poses == []
    for count in (1, 2, 3):
        assert probe.trigger('step').success
        probe.until(lambda: len(probe.poses) == count)
    stamps = [nanoseconds(message.header.stamp) for message in probe.poses]
    assert np.diff(stamps).tolist() == [PERIOD, PERIOD]
    assert probe.set_paused(False).success
    probe.until(lambda: len(probe.poses) > 20)
    stamps = np.array([nanoseconds(message.header.stamp) for message in probe.poses])
    # Stamps are wall time again: one leap over the pause, a whole number of periods.
    leaps = np.diff(stamps)
    assert (leaps > 0).all() and (leaps % PERIOD == 0).all()
    assert (leaps[2:] > PERIOD).sum() == 1


def test_the_guard_stops_the_motion_and_reset_resumes_it():
    # The plain game loop takes quadratic drag explicitly: at speed it overshoots, ever more.
    with BoatProcess({'integrator': 'symplectic_euler', 'rate': 20.0, 'status_period': 0.0,
                      'damping.quadratic': [2000.0, 0.0, 0.0, 0.0, 0.0, 0.0]}) as boat, \
            Probe(boat.namespace) as one:
        poses, _, _, depths = one.listen_to_boat()
        diagnostics = one.listen(DiagnosticArray, '/diagnostics')
        thrust = one.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
        one.until(lambda: poses and depths)
        one.until(lambda: 'the motion was stopped' in boat.log,
                  doing=lambda: thrust.publish(wrench((4e6, 0.0, 0.0))))

        def level():
            for array in diagnostics[-2:]:
                for status in array.status:
                    if status.hardware_id == f'{boat.namespace}/{NAME}':
                        return status.level
        one.until(lambda: level() == DiagnosticStatus.ERROR)
        for message in poses:
            position = message.pose.position
            assert all(map(math.isfinite, (position.x, position.y, position.z)))
        for message in depths:
            assert all(map(math.isfinite, message.data))
        one.spin(0.2)
        poses.clear()
        one.spin(0.3)
        assert poses == [] and boat.alive
        assert one.trigger('reset').success
        one.until(lambda: len(poses) > 10)
        assert abs(poses[-1].pose.position.x) < 0.1
        assert 'nan' not in boat.log


def test_a_second_node_of_the_same_name_is_warned_of(boat, probe):
    with BoatProcess({'status_period': 0.0}, namespace=boat.namespace) as twin:
        twin.wait_for_log('another node is called')
        boat.wait_for_log('another node is called')


def test_initialpose_puts_the_boat_there_floating_at_its_draft(probe):
    place = probe.publisher(PoseWithCovarianceStamped, 'initialpose')
    message = PoseWithCovarianceStamped()
    message.header.frame_id = 'odom'
    position, orientation = message.pose.pose.position, message.pose.pose.orientation
    position.x, position.y, position.z = 12.0, -7.0, 99.0
    orientation.z, orientation.w = math.sin(0.4), math.cos(0.4)
    assert probe.set_paused(True).success
    probe.poses.clear()
    place.publish(message)
    # A paused boat is shown where it was put.
    probe.until(lambda: probe.poses and probe.poses[-1].pose.position.x == 12.0)
    pose = probe.poses[-1].pose
    assert pose.position.y == -7.0 and yaw_of(pose) == pytest.approx(0.8, abs=1e-9)
    assert pose.position.z == pytest.approx(0.5 - 2000.0 / 8200.0, abs=1e-9)
    assert probe.set_paused(False).success


@pytest.mark.parametrize('field, value, said', [
    ('frame', 'map', "expected frame_id empty or 'odom', got 'map'"),
    ('x', math.nan, 'expected finite numbers'), ('w', 0.0, 'expected a unit quaternion'),
    ('w', math.inf, 'expected finite numbers'), ('x', 1e10, 'expected x and y of at most 1e+09')])
def test_a_bad_initialpose_is_refused(field, value, said):
    message = PoseWithCovarianceStamped()
    message.pose.pose.orientation.w = 1.0
    target = {'frame': message.header, 'x': message.pose.pose.position,
              'w': message.pose.pose.orientation}[field]
    setattr(target, {'frame': 'frame_id'}.get(field, field), value)
    with pytest.raises(Refused, match=re.escape(said)):
        read_place(message, load_scene({}))


def test_arguments_that_nothing_looks_at_are_refused_in_one_line():
    bare, unmarked, helped = run_and_end(
        [['config/barge.yaml'], ['--params-file', 'config/barge.yaml'], ['--help']])
    for status, lines in (bare, unmarked):
        assert (status, len(lines)) == (2, 1)
        assert 'expected arguments after --ros-args only' in lines[0]
    assert bare[1][0].endswith('got config/barge.yaml')
    assert helped == (0, [])


@pytest.mark.parametrize('module', ['rclpy', 'rosgraph_msgs'])
def test_without_ros_the_program_says_in_one_line_what_it_needs(module):
    ended = subprocess.run(
        [sys.executable, '-c', f'import sys; sys.modules[{module!r}] = None; '
         'from boat_buoyancy.ros.main import main; sys.exit(main())'],
        cwd=ROOT, capture_output=True, text=True, timeout=30.0)
    assert ended.returncode == 2
    line, = ended.stderr.splitlines()
    assert line.startswith('buoyancy_node: needs ROS 2 Jazzy') and module in line
    assert './install.sh ros' in line
