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

"""The node's outputs, as another process receives them."""

import math

from boat_buoyancy.physics import load_scene
from boat_buoyancy.ros.figures import heading_and_speed, status_line
from boat_buoyancy.ros.messages import Frame
from boat_buoyancy.ros.session import Session
from diagnostic_msgs.msg import DiagnosticArray
import numpy as np
import pytest
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from ros_probe import BoatProcess, by_stamp, LATCHED, nanoseconds, Probe
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Float64MultiArray
from visualization_msgs.msg import Marker, MarkerArray


PERIOD = 10_000_000  # ns, at 100 Hz


@pytest.fixture(scope='module')
def boat():
    """Start the default boat once."""
    with BoatProcess({'status_period': 0.5}) as process:
        yield process


@pytest.fixture(scope='module')
def probe(boat):
    """Look at it with one probe."""
    with Probe(boat.namespace) as one:
        yield one


@pytest.fixture(scope='module')
def second_of_messages(probe):
    """Return pose, twist, odom and probe_depth of one second and more."""
    lists = probe.listen_to_boat()
    probe.until(lambda: all(len(messages) > 120 for messages in lists))
    return [list(messages) for messages in lists]


def test_it_rests_at_the_draft_of_the_box(second_of_messages):
    # 2000 kg over 4 m x 2 m of water of 1025 kg/m^3; the body origin is half a metre above the
    # bottom, where the probes are.
    draft = 2000.0 / (1025.0 * 4.0 * 2.0)
    poses, twists, _, depths = second_of_messages
    assert poses[-1].pose.position.z == pytest.approx(0.5 - draft, abs=1e-9)
    assert list(depths[-1].data) == pytest.approx([draft] * 4, abs=1e-9)
    assert twists[-1].twist.linear.z == pytest.approx(0.0, abs=1e-9)


def test_all_outputs_of_a_period_share_one_stamp_and_state(second_of_messages):
    poses, twists, odometry, _ = map(by_stamp, (*second_of_messages[:3], []))
    common = sorted(set(poses) & set(twists) & set(odometry))
    assert len(common) > 100
    for stamp in common:
        assert odometry[stamp].pose.pose == poses[stamp].pose
        assert odometry[stamp].twist.twist == twists[stamp].twist
    # The only stamps that are not in all three are at the ends, where subscriptions came and went.
    for messages in (poses, twists, odometry):
        assert {s for s in messages if common[0] <= s <= common[-1]} == set(common)


def test_stamps_are_one_period_apart_without_a_gap(second_of_messages):
    stamps = [nanoseconds(message.header.stamp) for message in second_of_messages[0]]
    assert set(np.diff(stamps)) == {PERIOD}


def test_frames_are_named_as_the_parameters_say(second_of_messages):
    poses, twists, odometry, _ = second_of_messages
    assert poses[0].header.frame_id == odometry[0].header.frame_id == 'odom'
    assert twists[0].header.frame_id == odometry[0].child_frame_id == 'base_link'


@pytest.mark.usefixtures('second_of_messages')
def test_outputs_are_reliable_and_volatile_and_waves_are_latched(boat, probe):
    for topic in ('pose', 'twist', 'odom', 'probe_depth', 'probes', 'markers'):
        info, = probe.node.get_publishers_info_by_topic(f'{boat.namespace}/{topic}')
        assert info.qos_profile.reliability == ReliabilityPolicy.RELIABLE, topic
        assert info.qos_profile.durability == DurabilityPolicy.VOLATILE, topic
    info, = probe.node.get_publishers_info_by_topic(f'{boat.namespace}/waves')
    assert info.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    info, = probe.node.get_subscriptions_info_by_topic(f'{boat.namespace}/thrust')
    assert info.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT


def test_who_comes_late_still_hears_the_sea_in_force(probe):
    waves = probe.listen(Float64MultiArray, 'waves', LATCHED)
    probe.until(lambda: waves)
    assert list(waves[0].data) == []


@pytest.mark.usefixtures('second_of_messages')
def test_probes_are_a_cloud_with_place_depth_and_force(probe):
    clouds, poses = probe.listen(PointCloud2, 'probes'), probe.received['pose']
    probe.until(lambda: set(by_stamp(clouds)) & set(by_stamp(poses)))
    cloud = clouds[-1]
    assert [field.name for field in cloud.fields] == ['x', 'y', 'z', 'depth', 'force']
    assert (cloud.height, cloud.width, cloud.header.frame_id) == (1, 4, 'odom')
    rows = np.frombuffer(cloud.data.tobytes(), '<f4').reshape(4, 5)
    draft = 2000.0 / 8200.0
    np.testing.assert_allclose(np.abs(rows[:, :2]), [[2 / 3 ** 0.5, 1 / 3 ** 0.5]] * 4, rtol=1e-6)
    np.testing.assert_allclose(rows[:, 2], -draft, rtol=1e-5)
    np.testing.assert_allclose(rows[:, 3], draft, rtol=1e-5)
    np.testing.assert_allclose(rows[:, 4], 2000.0 * 9.81 / 4, rtol=1e-5)


def test_markers_show_hull_probes_forces_and_water(probe):
    arrays = probe.listen(MarkerArray, 'markers')
    probe.until(lambda: len(arrays) >= 3)
    kinds = {}
    for marker in arrays[-1].markers:
        kinds.setdefault(marker.ns, []).append(marker)
    assert {name: len(markers) for name, markers in kinds.items()} == {
        'hull': 1, 'probes': 1, 'forces': 1, 'water': 1}
    hull, probes, forces, water = arrays[-1].markers
    assert hull.type == Marker.TRIANGLE_LIST and len(hull.points) == 3 * 12
    corners = np.array([[p.x, p.y, p.z] for p in hull.points])
    np.testing.assert_array_equal(corners.max(axis=0), [2.0, 1.0, 0.5])
    np.testing.assert_array_equal(corners.min(axis=0), [-2.0, -1.0, -0.5])
    assert len(probes.points) == len(probes.colors) == 4
    assert len(water.points) % 3 == 0 and len({p.z for p in water.points}) == 1
    # A line starts at its probe and goes straight up, a quarter of the length for its share.
    assert forces.type == Marker.LINE_LIST and forces.points[::2] == probes.points
    for place, tip in zip(forces.points[::2], forces.points[1::2]):
        assert (tip.x, tip.y) == (place.x, place.y)
        assert tip.z - place.z == pytest.approx(0.25 * 20 ** 0.5)
    # Ten times a second, not a hundred.
    stamps = [nanoseconds(array.markers[0].header.stamp) for array in arrays]
    assert min(np.diff(stamps)) >= 5 * PERIOD


def test_two_thousand_probes_are_shown_without_losing_a_step():
    with BoatProcess({'hull.probes': [50, 40], 'rate': 20.0, 'status_period': 0.0}) as boat, \
            Probe(boat.namespace) as one:
        arrays = one.listen(MarkerArray, 'markers')
        boat.wait_for_log('draft')
        one.until(lambda: len(arrays) >= 3)
        assert len(arrays[-1].markers) == 4
        assert len(arrays[-1].markers[2].points) == 2 * 2000
        # What takes longer than a second makes it fall behind.
        assert 'fell behind' not in boat.log


def test_diagnostics_say_how_the_steps_are_doing(boat, probe):
    arrays = probe.listen(DiagnosticArray, '/diagnostics')

    def found():
        for array in arrays:
            for status in array.status:
                if status.hardware_id == f'{boat.namespace}/boat_buoyancy':
                    return status
        return None

    status = probe.until(found)
    values = {item.key: item.value for item in status.values}
    assert values['integrator'] == 'leapfrog' and values['substeps'] == '1'
    assert values['steps dropped'] == '0' and values['thrust age (s)'] == 'none'
    assert float(values['rate held (Hz)']) == pytest.approx(100.0, rel=0.1)
    assert float(values['worst step (ms)']) > 0.0


def test_the_log_says_what_was_loaded_and_how_it_goes(boat):
    scene = load_scene({})
    line = boat.wait_for_log('draft')
    assert f'{scene.boat.mass:g} kg' in line and 'leapfrog' in line and 'draft 0.244 m' in line
    status = boat.wait_for_log('real-time factor')
    assert 'z 0.256 m' in status and 'roll 0.0 pitch 0.0 deg' in status
    for said in (line, status):
        assert 'heading 0.0 deg, 0.00 m/s ahead' in said


def test_heading_and_speed_ahead_are_those_of_the_body():
    scene = load_scene({'start.orientation': [0.0, 0.0, math.pi / 2],
                        'start.velocity': [1.5, 0.7, 0.0]})
    frame = Frame(Session(scene))
    # Counter-clockwise from x; what it drifts to port is no way ahead.
    assert heading_and_speed(frame) == 'heading 90.0 deg, 1.50 m/s ahead'
    line = status_line(frame, 12.34, 1.0, False)
    assert line.startswith('t 12.3 s, x 0.00 y 0.00 z 0.256 m, roll 0.0 pitch 0.0 deg, heading 90')
