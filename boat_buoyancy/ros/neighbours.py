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

"""What other nodes do on the topics of ours that cannot be meant: rivals, other types."""

from collections import deque
import inspect
import time


class Rivals:
    """
    Tells from the numbers of messages whether more than one publisher sends on a topic.

    A publisher counts its messages, and no message says whose it is: a number that is not above
    the last one is of another count.  What the messages ask for does not matter: one controller
    may go to and fro, and two that agree are two.  The graph alone does not tell, as it shows
    those that are silent, and for a while the dead.
    """

    # s; s apart; and how many.  Of a hand-over, in which both send for a moment, there are fewer.
    WINDOW, APART, RETURNS = 20.0, 0.5, 4

    def __init__(self):
        """Have heard nothing."""
        self._last, self._returns = 0, deque(maxlen=self.RETURNS)

    def heard(self, number, now):
        """Take the number of a message that came at ``now`` s."""
        # The first of a publisher, number 1, is of one that comes, perhaps in place of another.
        if 1 < number <= self._last and not (
                self._returns and now - self._returns[-1] < self.APART):
            self._returns.append(now)
        self._last = number

    def fight(self, now):
        """Return whether two or more have sent of late."""
        if len(self._returns) < self.RETURNS:
            return False
        first, last = self._returns[0], self._returns[-1]
        # Over when there was none for longer than it took to notice.
        return first > now - self.WINDOW and now - last < last - first + 1.0


class Neighbours:
    """
    A look at the graph around a node, once in a while.

    Main arguments: ``node``.
    """

    def __init__(self, node):
        """Watch no topic."""
        self._node, self._rivals = node, {}

    def watched(self, topic, callback):
        """
        Return a callback for a topic whose publishers are watched.

        ``callback`` (message) returns whether it acted on it: who sends what is refused does not
        push the boat.  Middleware that does not number messages (Cyclone DDS) tells no rivals.
        """
        rivals = self._rivals[topic] = Rivals()

        def numbered(*given):
            # EventsExecutor of Jazzy hands both over as one.
            message, information = given[0] if len(given) == 1 else given
            number = information['publication_sequence_number']
            if callback(message) and number is not None:
                rivals.heard(number, time.monotonic())
        # By this rclpy knows that it takes both.
        numbered.__signature__ = inspect.signature(lambda message, information: None)
        return numbered

    def look(self, now):
        """Return {what is wrong in some words: the sentence for it}; ``now`` s, steady clock."""
        return {**self._fights(now), **self._other_types(), **self._twins()}

    def _fights(self, now):
        found = {}
        for name, rivals in self._rivals.items():
            if not rivals.fight(now):
                continue
            topic = self._node.resolve_topic_name(name)
            publishers = self._node.get_publishers_info_by_topic(topic)
            # Else one that is started again and again.
            if len(publishers) > 1:
                found[f'several nodes send {name}'] = (
                    f'more than one of {len(publishers)} publishers sends on {topic} '
                    f'({", ".join(sorted(map(_name, publishers)))}): the latest message acts, so '
                    'they fight over the boat; let only one of them send')
        return found

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


def _name(info):
    """Return the full name of the node of an endpoint."""
    return f'{info.node_namespace.rstrip("/")}/{info.node_name}'


def _type(kind):
    """Return the name of a message class as the graph has it."""
    package, folder, *_ = kind.__module__.split('.')
    return f'{package}/{folder}/{kind.__name__}'
