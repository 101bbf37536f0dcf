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

"""The tables of topics and services are those of the running node."""

from importlib.util import find_spec

import pytest
from readme import table
from ros_probe import BoatProcess, NAME, Probe


# Which the wheels of ROS do not have.
HAS_TF = find_spec('tf2_msgs') is not None
# What every node of rclpy has.
RCLPY = {'/parameter_events', '/rosout'}


@pytest.fixture(scope='module')
def graph():
    """Return topics in and out, and services, of a node with everything switched on."""
    everything = {'publish_clock': True, 'publish_tf': HAS_TF, 'map_frame': 'map',
                  'thrusters.names': ['left'], 'thrusters.positions': [-1.8, 0.0, -0.4]}
    with BoatProcess(everything) as boat, Probe(boat.namespace) as probe:
        boat.wait_for_log('draft')

        def ask():
            node = (NAME, boat.namespace)
            try:
                found = (dict(probe.node.get_subscriber_names_and_types_by_node(*node)),
                         dict(probe.node.get_publisher_names_and_types_by_node(*node)),
                         dict(probe.node.get_service_names_and_types_by_node(*node)))
            except RuntimeError:  # not discovered yet
                return None
            complete = f'{boat.namespace}/{NAME}/step' in found[2] and '/clock' in found[1]
            return (boat.namespace, *found) if complete else None

        yield probe.until(ask)


def readable(namespace, names_and_types, prefix):
    """Return {name as the tables have it: type}."""
    return {name.removeprefix(namespace + prefix).replace('/left/', '/<name>/'): types[0]
            for name, types in names_and_types.items() if name not in RCLPY}


def test_the_topic_table_is_what_the_node_has(graph):
    namespace, heard, published, _ = graph
    rows = [row for row in table('Topics') if HAS_TF or not row[1].startswith('tf2_msgs/')]
    assert {row[0]: row[1] for row in rows if row[2] == 'in'} == readable(namespace, heard, '/')
    assert {row[0]: row[1] for row in rows if row[2].startswith('out')} == readable(
        namespace, published, '/')


def test_the_service_table_is_what_the_node_has(graph):
    namespace, _, _, services = graph
    own = {name.replace(f'{namespace}/{NAME}', '~'): types[0] for name, types in services.items()
           if types[0].startswith('std_srvs/')}
    assert {row[0]: row[1] for row in table('Services')} == own
