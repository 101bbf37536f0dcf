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

"""Recordings as another reader finds them: MCAP's own, which shares no code with the writer."""

import math
from pathlib import Path

from boat_buoyancy.physics import load_scene
from boat_buoyancy.tools import recording, simulate
import numpy as np
import programs
import pytest

pytest.importorskip('rosbags')
make_reader = pytest.importorskip('mcap.reader').make_reader
read_ros2_messages = pytest.importorskip('mcap_ros2.reader').read_ros2_messages

SCENE = """/**:
  ros__parameters:
    boat.center_of_mass: [0.1, 0.05, -0.1]
    start.orientation: [0.1, -0.05, 0.4]
    sea.waves: [0.3, 4.0, 0.6, 0.0]
    frame_prefix: red/
    map_frame: map
    publish_tf: true
    imu.rate: 25.0
    fix.rate: 10.0
    fix.latitude: 54.0
    fix.longitude: 10.0
"""
ROS = ('rclpy', 'builtin_interfaces', 'geometry_msgs', 'nav_msgs', 'sensor_msgs', 'std_msgs',
       'tf2_msgs', 'visualization_msgs')
THRUST = ['--thrust', '300', '-20', '0', '0', '10', '100']


@pytest.fixture(scope='module')
def recorded(tmp_path_factory):
    """Return the table of a run of 2 s at 50 Hz, {name: column}, and its recording."""
    folder = tmp_path_factory.mktemp('recorded')
    (folder / 'scene.yaml').write_text(SCENE)
    words = [str(folder / 'scene.yaml'), '--duration', '2', '--rate', '50', *THRUST]
    assert simulate.main([*words, '--csv', str(folder / 'run.csv'),
                          '--mcap', str(folder / 'run.mcap')]) == 0
    table = np.genfromtxt(folder / 'run.csv', delimiter=',', names=True)
    return table, folder / 'run.mcap', words


def messages(path, topic):
    """Return the messages of a topic, read back."""
    return list(read_ros2_messages(str(path), topics=[topic]))


def numbers(part, names):
    """Return the numbers of some fields."""
    return [getattr(part, name) for name in names]


def assert_are(rows, table, names):
    """Assert that rows of numbers are columns of the table but for a few roundings."""
    np.testing.assert_allclose(rows, np.stack([table[name] for name in names.split()], axis=1),
                               rtol=0.0, atol=1e-14)


def test_every_number_is_that_of_the_table(recorded):
    table, path, _ = recorded
    assert len(table) == 101
    poses = [read.ros_msg.pose for read in messages(path, '/pose')]
    assert_are([numbers(pose.position, 'xyz') for pose in poses], table, 'x y z')
    assert_are([numbers(pose.orientation, 'xyzw') for pose in poses], table, 'qx qy qz qw')
    twists = [read.ros_msg.twist for read in messages(path, '/twist')]
    assert_are([numbers(twist.linear, 'xyz') for twist in twists], table, 'vx vy vz')
    assert_are([numbers(twist.angular, 'xyz') for twist in twists], table, 'wx wy wz')
    assert_are([read.ros_msg.data for read in messages(path, '/probe_depth')], table,
               'depth_0 depth_1 depth_2 depth_3')
    for read, pose, twist in zip(messages(path, '/odom'), poses, twists):
        assert str(read.ros_msg.pose.pose) == str(pose)
        assert str(read.ros_msg.twist.twist) == str(twist)


def test_stamps_and_log_times_are_the_simulated_time(recorded):
    table, path, _ = recorded
    for topic in ('/pose', '/twist', '/odom', '/probes', '/probe_depth', '/tf'):
        read = messages(path, topic)
        assert [one.log_time_ns for one in read] == [20_000_000 * i for i in range(101)]
        if topic not in ('/probe_depth', '/tf'):
            stamps = [one.ros_msg.header.stamp for one in read]
            assert [stamp.sec * 10 ** 9 + stamp.nanosec for stamp in stamps] == [
                one.log_time_ns for one in read]
    assert table['time'][-1] == 2.0


def test_frames_are_those_of_the_scene_and_transforms_those_of_the_pose(recorded):
    _, path, _ = recorded
    (moving, *_), (fixed,) = messages(path, '/tf'), messages(path, '/tf_static')
    pose, twist, odometry = (messages(path, topic)[0].ros_msg
                             for topic in ('/pose', '/twist', '/odom'))
    assert (pose.header.frame_id, twist.header.frame_id) == ('odom', 'red/base_link')
    assert (odometry.header.frame_id, odometry.child_frame_id) == ('odom', 'red/base_link')
    transform, = moving.ros_msg.transforms
    assert (transform.header.frame_id, transform.child_frame_id) == ('odom', 'red/base_link')
    assert numbers(transform.transform.translation, 'xyz') == numbers(pose.pose.position, 'xyz')
    assert numbers(transform.transform.rotation, 'xyzw') == numbers(
        pose.pose.orientation, 'xyzw')
    same, = fixed.ros_msg.transforms
    assert (same.header.frame_id, same.child_frame_id) == ('map', 'odom')
    assert numbers(same.transform.rotation, 'xyzw') == [0.0, 0.0, 0.0, 1.0]
    # Who listens when it was played already has to know, too.
    assert 'durability: transient_local' in fixed.channel.metadata['offered_qos_profiles']


def test_sensors_measure_at_their_rates_where_the_boat_is(recorded):
    table, path, _ = recorded
    imu, fix = messages(path, '/imu'), messages(path, '/fix')
    assert [read.log_time_ns for read in imu] == [40_000_000 * i for i in range(51)]
    assert [read.log_time_ns for read in fix] == [100_000_000 * i for i in range(21)]
    assert_are([numbers(read.ros_msg.angular_velocity, 'xyz') for read in imu], table[::2],
               'wx wy wz')
    # A degree of a meridian at 54 degrees is 111.28 km long, one of the parallel 65.58 km.
    for read, row in zip(fix, table[::5]):
        assert (read.ros_msg.latitude - 54.0) * 111_280 == pytest.approx(row['y'], abs=1e-4)
        assert (read.ros_msg.longitude - 10.0) * 65_580 == pytest.approx(row['x'], abs=1e-4)


def test_the_sea_is_there_once_for_all_who_listen(recorded):
    _, path, _ = recorded
    waves, = messages(path, '/waves')
    assert waves.log_time_ns == 0 and list(waves.ros_msg.data) == [0.3, 4.0, 0.6, 0.0]
    assert [(part.size, part.stride) for part in waves.ros_msg.layout.dim] == [(1, 4), (4, 4)]
    assert 'durability: transient_local' in waves.channel.metadata['offered_qos_profiles']


def test_markers_draw_the_boat_on_its_water_ten_times_a_second(recorded):
    table, path, _ = recorded
    read = messages(path, '/markers')
    assert [one.log_time_ns for one in read] == [100_000_000 * i for i in range(21)]
    frequency = 2.0 * math.pi / 4.0
    k = frequency ** 2 / 9.81
    for one, row in zip(read, table[::5]):
        hull, probes, forces, water = one.ros_msg.markers
        assert {marker.header.frame_id for marker in one.ros_msg.markers} == {'odom'}
        assert numbers(hull.pose.position, 'xyz') == pytest.approx([row[i] for i in 'xyz'])
        assert len(hull.points) == 3 * 12 and len(forces.points) == 2 * len(probes.points)
        x, y, z = np.array([numbers(point, 'xyz') for point in water.points]).T
        assert np.ptp(x) > 10.0 and np.ptp(y) > 10.0
        np.testing.assert_allclose(z, 0.3 * np.cos(
            k * (x * math.cos(0.6) + y * math.sin(0.6)) - frequency * row['time']), atol=1e-9)
        # Each probe is as deep under that water as the table says.
        for i, point in enumerate(probes.points):
            above = k * (point.x * math.cos(0.6) + point.y * math.sin(0.6))
            surface = 0.3 * math.cos(above - frequency * row['time'])
            assert surface - point.z == pytest.approx(row[f'depth_{i}'], abs=1e-9)


@pytest.mark.parametrize('rate', [24.0, 125.0, 1000.0])
def test_markers_keep_their_ten_a_second_at_any_rate(tmp_path, rate):
    scene = load_scene({'rate': rate})
    recording.record(tmp_path / 'run.mcap', scene, scene.simulation(), 1.0, [0.0] * 6)
    times = [one.log_time_ns / 1e9 for one in messages(tmp_path / 'run.mcap', '/markers')]
    # Each with the first message at or after its tenth of a second.
    assert times == pytest.approx([math.ceil(rate * i / 10 - 1e-9) / rate for i in range(11)],
                                  abs=1e-8)


def test_it_is_what_ros2_bag_and_foxglove_take(recorded):
    _, path, _ = recorded
    with path.open('rb') as file:
        reader = make_reader(file)
        assert reader.get_header().profile == 'ros2'
        summary = reader.get_summary()
        # Without it rosbag2 takes the profiles for those of an older version.
        assert [record.name for record in reader.iter_metadata()] == ['rosbag2']
    assert {schema.encoding for schema in summary.schemas.values()} == {'ros2msg'}
    assert {channel.message_encoding for channel in summary.channels.values()} == {'cdr'}
    kinds = {channel.topic: summary.schemas[channel.schema_id].name
             for channel in summary.channels.values()}
    assert kinds == {
        '/pose': 'geometry_msgs/msg/PoseStamped', '/twist': 'geometry_msgs/msg/TwistStamped',
        '/odom': 'nav_msgs/msg/Odometry', '/probe_depth': 'std_msgs/msg/Float64MultiArray',
        '/probes': 'sensor_msgs/msg/PointCloud2', '/imu': 'sensor_msgs/msg/Imu',
        '/fix': 'sensor_msgs/msg/NavSatFix', '/waves': 'std_msgs/msg/Float64MultiArray',
        '/markers': 'visualization_msgs/msg/MarkerArray', '/tf': 'tf2_msgs/msg/TFMessage',
        '/tf_static': 'tf2_msgs/msg/TFMessage'}


def test_recording_does_not_change_the_run_and_needs_no_ros(recorded, tmp_path):
    _, path, words = recorded
    done = programs.without(ROS, 'boat_buoyancy.tools.simulate', [
        *words, '--csv', str(tmp_path / 'run.csv'), '--mcap', str(tmp_path / 'run.mcap')])
    assert done.returncode == 0, done.stderr
    assert f'wrote    {tmp_path / "run.mcap"}\n' in done.stdout
    assert (tmp_path / 'run.mcap').read_bytes() == path.read_bytes()
    assert simulate.main([*words, '--csv', str(tmp_path / 'alone.csv')]) == 0
    assert (tmp_path / 'alone.csv').read_bytes() == (tmp_path / 'run.csv').read_bytes()
    assert sorted(each.name for each in tmp_path.iterdir()) == [
        'alone.csv', 'run.csv', 'run.mcap']


@pytest.mark.parametrize('broken', [KeyboardInterrupt(), RuntimeError()])
def test_a_run_that_is_broken_off_leaves_nothing(tmp_path, broken):
    def thrust(time, _):
        if math.isclose(time, 0.5):
            raise broken
        return [0.0] * 6

    scene = load_scene({})
    with pytest.raises(type(broken)):
        recording.record(tmp_path / 'run.mcap', scene, scene.simulation(), 1.0, thrust)
    assert list(tmp_path.iterdir()) == []


def test_another_ending_gets_one_line(recorded, capsys):
    _, _, words = recorded
    assert "--mcap: expected a file name that ends in .mcap, got 'run.bag'" in programs.refused(
        simulate.main, 'buoyancy_simulate', [*words, '--mcap', 'run.bag'], capsys)


def test_without_the_extra_one_line_says_what_to_install():
    scene = str(Path(__file__).parents[1] / 'config' / 'default.yaml')
    done = programs.without(('rosbags',), 'boat_buoyancy.tools.simulate', [
        scene, '--duration', '0.1', '--mcap', 'run.mcap'])
    assert done.returncode == 2 and done.stdout == '' and done.stderr.count('\n') == 1
    assert done.stderr == ('buoyancy_simulate: --mcap needs rosbags (No module named '
                           '\'rosbags\'): ./install.sh bag, or pip install "boat_buoyancy[bag]"\n')
