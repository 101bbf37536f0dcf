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
Transforms as tf2 wants them, and the frames that go with them.

The wheels of ROS have no tf2_msgs: a stand-in with its one field takes the place of TFMessage.
"""

from importlib.util import find_spec
import math
import os
import sys
from types import SimpleNamespace

from boat_buoyancy.physics import load_scene
from boat_buoyancy.ros import transforms
from boat_buoyancy.ros.complaints import Refused
from boat_buoyancy.ros.initial_pose import read_place
from boat_buoyancy.ros.messages import Outputs
from boat_buoyancy.ros.session import Session
from boat_buoyancy.ros.topics import NodeTopics
from geometry_msgs.msg import PoseWithCovarianceStamped
import pytest
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from ros_probe import BoatProcess, nanoseconds, Probe, run_and_end

TF = {'publish_tf': True, 'start.position': [3.0, -2.0],
      'start.orientation': [0.0, 0.0, math.pi / 2], 'imu.rate': 0.0}


class StandIn:
    """Stands for tf2_msgs/TFMessage."""

    def __init__(self, transforms=()):
        """Keep them."""
        self.transforms = list(transforms)


class Recorder:
    """Stands for a node; keeps what is published, by topic, and how."""

    def __init__(self):
        """Begin with nothing."""
        self.sent, self.profiles = {}, {}

    def create_publisher(self, kind, topic, profile):
        """Return a publisher that somebody listens to."""
        self.profiles[topic] = profile
        return SimpleNamespace(get_subscription_count=lambda: 1,
                               publish=self.sent.setdefault(topic, []).append)

    def get_fully_qualified_name(self):
        """Return the name of the node."""
        return '/boat_buoyancy'


@pytest.fixture
def publish(monkeypatch):
    """Return a function that publishes the first instant of a scene and returns the recorder."""
    monkeypatch.setitem(sys.modules, 'tf2_msgs.msg', SimpleNamespace(TFMessage=StandIn))

    def published(values):
        scene, recorder = load_scene(values), Recorder()
        topics = NodeTopics(recorder)
        outputs = Outputs(topics, scene, more=transforms.topics_of(topics, scene, 7 * 10 ** 9))
        outputs.publish(Session(scene, 5_250_000_000))
        return recorder
    return published


def test_the_transform_is_the_pose_with_its_stamp(publish):
    sent = publish(TF).sent
    (message,), (pose,) = sent['/tf'], sent['pose']
    transform, = message.transforms
    assert (transform.header.frame_id, transform.child_frame_id) == ('odom', 'base_link')
    assert transform.header.stamp == pose.header.stamp
    assert nanoseconds(transform.header.stamp) == 5_250_000_000
    moved, turned = transform.transform.translation, transform.transform.rotation
    assert (moved.x, moved.y, moved.z) == (3.0, -2.0, pose.pose.position.z)
    # A quarter turn to the left.
    assert (turned.x, turned.y, turned.z, turned.w) == pytest.approx(
        (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)))


def test_a_map_is_where_the_world_is_and_said_once_for_late_listeners(publish):
    recorder = publish({**TF, 'map_frame': 'map'})
    (message,), profile = recorder.sent['/tf_static'], recorder.profiles['/tf_static']
    transform, = message.transforms
    assert (transform.header.frame_id, transform.child_frame_id) == ('map', 'odom')
    assert transform.transform.rotation.w == 1.0 and transform.transform.translation.x == 0.0
    assert profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    assert recorder.profiles['/tf'].durability == DurabilityPolicy.VOLATILE
    assert recorder.profiles['/tf'].reliability == ReliabilityPolicy.RELIABLE
    assert '/tf_static' not in publish(TF).sent


def test_without_publish_tf_there_is_no_transform(publish):
    assert not {'/tf', '/tf_static'} & set(publish({'map_frame': 'map'}).profiles)


def test_a_prefix_comes_before_the_frame_of_the_boat_everywhere(publish):
    sent = publish({**TF, 'frame_prefix': 'red/'}).sent
    assert sent['/tf'][0].transforms[0].child_frame_id == 'red/base_link'
    assert sent['odom'][0].child_frame_id == sent['twist'][0].header.frame_id == 'red/base_link'
    assert sent['odom'][0].header.frame_id == 'odom'


@pytest.mark.parametrize('namespace, expected', [
    ('/', ''), ('/red', 'red/'), ('/fleet/red', 'fleet/red/')])
def test_a_namespace_gives_the_prefix(namespace, expected):
    assert transforms.prefix(namespace) == expected


def placed_in(frame):
    """Return a place 4 m ahead in a frame."""
    message = PoseWithCovarianceStamped()
    message.header.frame_id = frame
    message.pose.pose.position.x = 4.0
    return message


def test_a_place_is_taken_in_the_map_where_that_is_the_same_place():
    assert read_place(placed_in('map'), load_scene({'map_frame': 'map'}))[0] == 4.0
    assert read_place(placed_in('map'), load_scene({'world_frame': 'map'}))[0] == 4.0
    assert read_place(placed_in('odom'), load_scene({'map_frame': 'map'}))[0] == 4.0
    for frame, values, said in (
            ('map', {}, "empty or 'odom', got 'map'"),
            ('odom', {'world_frame': 'map'}, "empty or 'map', got 'odom'"),
            ('earth', {'map_frame': 'map'}, "empty or 'odom' or 'map', got 'earth'")):
        with pytest.raises(Refused, match=said):
            read_place(placed_in(frame), load_scene(values))


@pytest.mark.parametrize('values, said', [
    ({'world_frame': 'map', 'map_frame': 'map'},
     "map_frame: expected another frame than world_frame, got 'map' for both"),
    ({'map_frame': 'base_link'},
     "map_frame: expected another frame than body_frame, got 'base_link' for both"),
    ({'world_frame': 'a/b', 'frame_prefix': 'a/', 'body_frame': 'b'},
     "body_frame: expected another frame than world_frame, got 'a/b' for both")])
def test_two_frames_of_one_name_are_refused(values, said):
    with pytest.raises(ValueError, match=said):
        load_scene(values)


@pytest.mark.skipif(find_spec('tf2_msgs') is not None, reason='tf2_msgs is installed')
def test_without_tf2_msgs_a_node_that_needs_it_is_one_line_and_exit_2():
    (status, lines), = run_and_end([['--ros-args', '-p', 'publish_tf:=true']])
    assert status == 2
    line, = lines
    assert line.startswith("buoyancy_node: publish_tf: needs tf2_msgs (No module named 'tf2_msgs'")
    assert 'apt install ros-jazzy-tf2-msgs, or set publish_tf to false' in line


# Enough to create a publisher of; to send one nobody has to listen.
MODULE = """
from std_msgs.msg import Empty


class TFMessage(Empty):
    def __init__(self, transforms=()):
        super().__init__()
"""


@pytest.mark.skipif(find_spec('tf2_msgs') is not None, reason='tf2_msgs is installed')
@pytest.mark.parametrize('given, prefix', [({}, None), ({'frame_prefix': 'one/'}, 'one/')])
def test_with_publish_tf_the_namespace_is_the_prefix_unless_another_is_given(
        tmp_path, given, prefix):
    (tmp_path / 'tf2_msgs').mkdir()
    (tmp_path / 'tf2_msgs' / 'msg.py').write_text(MODULE)
    path = os.pathsep.join(filter(None, (str(tmp_path), os.environ.get('PYTHONPATH'))))
    with BoatProcess({'publish_tf': True, **given}, environment={'PYTHONPATH': path}) as boat, \
            Probe(boat.namespace) as probe:
        odometry = probe.listen_to_boat()[2]
        probe.until(lambda: odometry)
        expected = boat.namespace.strip('/') + '/' if prefix is None else prefix
        assert odometry[0].child_frame_id == f'{expected}base_link'
        value = probe.get_parameters(['frame_prefix'])['frame_prefix']
        assert value.string_value == expected
