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

"""A recording against the node: the same messages on every topic, as ROS itself reads them."""

from types import SimpleNamespace

from boat_buoyancy.physics import load_scene
from boat_buoyancy.ros.markers import Markers
from boat_buoyancy.ros.messages import Outputs, WavesOutput
from boat_buoyancy.ros.sensors import sensors_of
from boat_buoyancy.ros.session import Session
from boat_buoyancy.ros.topics import NodeTopics
from boat_buoyancy.tools import recording
import pytest
from rclpy.serialization import deserialize_message, serialize_message

pytest.importorskip('rosbags')
make_reader = pytest.importorskip('mcap.reader').make_reader

VALUES = {'boat.center_of_mass': [0.1, 0.05, -0.1], 'start.orientation': [0.1, -0.05, 0.4],
          'sea.waves': [0.3, 4.0, 0.6, 0.0], 'thrust.timeout': 0.0, 'imu.rate': 40.0,
          'imu.position': [0.5, 0.0, 0.3], 'imu.gyroscope_noise': 0.01, 'fix.noise': [1.0, 2.0]}
THRUST = (300.0, -20.0, 0.0, 0.0, 10.0, 100.0)
PERIODS = 200


class Node:
    """Stands for a node; keeps a copy of what is sent, by topic, and the kinds of messages."""

    def __init__(self):
        """Begin with nothing."""
        self.sent, self.kinds = {}, {}

    def get_fully_qualified_name(self):
        """Return the name of a node that was given none."""
        return '/boat_buoyancy'

    def create_publisher(self, kind, topic, profile):
        """Return a publisher that somebody listens to."""
        sent = self.sent.setdefault(f'/{topic}', [])
        self.kinds[f'/{topic}'] = kind
        return SimpleNamespace(
            get_subscription_count=lambda: 1,
            publish=lambda message: sent.append(
                deserialize_message(serialize_message(message), kind)))


def test_it_holds_what_the_node_publishes(tmp_path):
    scene, node = load_scene(VALUES), Node()
    session, topics = Session(scene), NodeTopics(node)
    outputs = Outputs(topics, scene, sensors_of(topics, scene))
    markers = Markers(topics, scene)
    WavesOutput(topics).publish(session.sea)

    def publish():
        outputs.publish(session)
        markers.look(session, session.stamp / 1e9)
    publish()
    session.thrust.hold(THRUST, False, 0.0)
    for _ in range(PERIODS):
        session.step()
        publish()

    path = tmp_path / 'run.mcap'
    recording.record(path, scene, scene.simulation(), PERIODS / scene.rate, THRUST)
    found = {}
    with path.open('rb') as file:
        for _, channel, message in make_reader(file).iter_messages():
            found.setdefault(channel.topic, []).append(
                deserialize_message(message.data, node.kinds[channel.topic]))
    assert set(found) == {'/pose', '/twist', '/odom', '/probe_depth', '/probes', '/imu', '/fix',
                          '/markers', '/waves'}
    assert {topic: len(sent) for topic, sent in found.items()} == {
        topic: len(sent) for topic, sent in node.sent.items()}
    assert len(found['/pose']) == PERIODS + 1 and len(found['/imu']) == 81
    assert len(found['/markers']) == 21 and len(found['/waves']) == 1
    for topic, sent in node.sent.items():
        assert found[topic] == sent, topic
