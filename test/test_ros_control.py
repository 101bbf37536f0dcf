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

"""Reset, pause, single steps, faults of the motion, and who else is there."""

import math
import re
import subprocess
import sys

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import WrenchStamped
import numpy as np
import pytest
from ros_probe import (BEST_EFFORT, BoatProcess, LATCHED, NAME, nanoseconds, Probe, ROOT,
                       wrench)
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


@pytest.mark.parametrize('arguments, code, said', [
    (['config/barge.yaml'], 2, 'expected arguments after --ros-args only, .* got config/barge'),
    (['--params-file', 'config/barge.yaml'], 2, 'expected arguments after --ros-args only'),
    (['--help'], 0, 'usage: buoyancy_node')])
def test_arguments_that_nothing_looks_at_are_refused_in_one_line(arguments, code, said):
    ended = subprocess.run([sys.executable, '-m', 'boat_buoyancy.ros.node', *arguments], cwd=ROOT,
                           capture_output=True, text=True, timeout=30.0)
    assert ended.returncode == code
    assert re.search(said, ended.stdout + ended.stderr)
    assert code == 0 or len(ended.stderr.splitlines()) == 1


def test_waves_that_no_water_could_have_are_warned_of():
    with BoatProcess({'status_period': 0.0}) as boat, Probe(boat.namespace) as probe:
        waves = probe.publisher(Float64MultiArray, 'wave_parameters')
        waves.publish(Float64MultiArray(data=[5.0, 2.0, 0.0, 0.0]))
        boat.wait_for_log('The waves are steeper than water can be')
