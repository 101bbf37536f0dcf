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

"""What other nodes do on the topics of ours that cannot be meant: rival thrust, other types."""

from collections import deque


class Rivals:
    """
    Tells from the wrenches whether more than one publisher pushes the boat.

    Of two that send, each takes back what the other has just asked for: there and back again.
    The graph alone does not tell, as it shows those that are silent, and for a while the dead.
    Messages do not say who sent them.  Public: ``possible``, whether the graph shows more than
    one publisher; until it does nothing is looked at.
    """

    WINDOW, RETURNS = 5.0, 4  # s, and how often in it
    JUMP = 0.1  # of the wrench; less is how a controller moves about

    def __init__(self):
        """Have heard nothing."""
        self.possible = False
        self._last = self._before = (0.0,) * 6
        self._returns = deque(maxlen=self.RETURNS)

    def heard(self, wrench, now):
        """Take a wrench, six numbers, that came at ``now`` s."""
        if not self.possible:
            return
        there, back = _distance(wrench, self._last), _distance(wrench, self._before)
        size = max(map(abs, (*wrench, *self._last)))
        if there > self.JUMP * size and back < 0.5 * there:
            self._returns.append(now)
        self._before, self._last = self._last, wrench

    def fight(self, now):
        """Return whether two or more have sent of late."""
        return (self.possible and len(self._returns) == self.RETURNS
                and self._returns[0] > now - self.WINDOW)


class Neighbours:
    """
    A look at the graph around a node, once in a while.

    Main arguments: ``node``; ``rivals``, the `Rivals` for `thrust`.
    """

    def __init__(self, node, rivals):
        """Keep both."""
        self._node, self._rivals = node, rivals

    def look(self, now):
        """Return {what is wrong in some words: the sentence for it}; ``now`` s, steady clock."""
        return {**self._fights(now), **self._other_types(), **self._twins()}

    def _fights(self, now):
        topic = self._node.resolve_topic_name('thrust')
        publishers = self._node.get_publishers_info_by_topic(topic)
        self._rivals.possible = len(publishers) > 1
        if not self._rivals.fight(now):
            return {}
        names = ', '.join(sorted(map(_name, publishers)))
        return {'several nodes send thrust':
                f'{len(publishers)} publishers send on {topic} ({names}): the latest wrench acts, '
                'so they fight over the boat; let only one of them send'}

    def _other_types(self):
        node, found = self._node, {}
        ours = {end.topic_name: _type(end.msg_type)
                for ends in (node.publishers, node.subscriptions) for end in ends}
        for topic, types in node.get_topic_names_and_types():
            if topic not in ours or types == [ours[topic]]:
                continue
            for info in (*node.get_publishers_info_by_topic(topic),
                         *node.get_subscriptions_info_by_topic(topic)):
                if info.topic_type != ours[topic]:
                    found[f'another type on {topic}'] = (
                        f'{_name(info)} has {info.topic_type} on {topic}, which is '
                        f'{ours[topic]} here: neither hears the other; give it that type, or '
                        'another topic')
        return found

    def _twins(self):
        node = self._node
        own = (node.get_name(), node.get_namespace())
        if node.get_node_names_and_namespaces().count(own) < 2:
            return {}
        return {'another node has this name':
                f'another node is called {node.get_fully_qualified_name()}: both answer its '
                'services and publish its topics. Give one a namespace with '
                '--ros-args -r __ns:=/other (a node that was killed stays in the graph for '
                'about 20 s)'}


def _distance(one, other):
    return max(abs(a - b) for a, b in zip(one, other))


def _name(info):
    """Return the full name of the node of an endpoint."""
    return f'{info.node_namespace.rstrip("/")}/{info.node_name}'


def _type(kind):
    """Return the name of a message class as the graph has it."""
    package, folder, *_ = kind.__module__.split('.')
    return f'{package}/{folder}/{kind.__name__}'
