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

"""How a node makes its messages and opens their topics: what sends them needs no ROS itself."""

from importlib import import_module

from . import qos


class NodeTopics:
    """
    The topics of a node.

    ``name`` of the node with its namespace.  What takes one of these, as `Outputs` does, takes
    anything with the same three: a recording has its own.
    """

    def __init__(self, node):
        """Open topics of a node."""
        self._node, self.name = node, node.get_fully_qualified_name()

    @staticmethod
    def make(kind):
        """Return an empty message of a kind, as 'geometry_msgs/msg/PoseStamped'."""
        package, _, word = kind.split('/')
        return getattr(import_module(f'{package}.msg'), word)()

    def publisher(self, topic, message):
        """Return a publisher of such messages."""
        return self._node.create_publisher(
            type(message), topic, qos.PROFILES.get(topic, qos.OUTPUT))
