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
A run as the node would publish it, in an MCAP file: for Foxglove and ``ros2 bag play``.

The node's own code fills the messages; their definitions, and how they are written, come from
rosbags (extra ``bag``), so that no ROS is needed.
"""

from array import array
from contextlib import contextmanager
from dataclasses import dataclass, replace
import os
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace

import numpy as np

from ..physics import Simulation
from ..physics.scene.parameters import NODE_NAME
from ..ros import transforms
from ..ros.markers import Markers
from ..ros.messages import Outputs, WavesOutput
from ..ros.pacing import Grid, NANOSECONDS
from ..ros.sensors import sensors_of

ENDINGS = ('.mcap',)


def record(path, scene, simulation, duration, thrust, progress=None):
    """
    Return the `Trajectory` of `Simulation.run`, and write what a node would publish to a file.

    Main arguments: ``path`` of the file; ``scene`` and a ``simulation`` of it, perhaps at another
    rate; ``duration`` s; ``thrust`` (6,) or a function, as of `Simulation.run`.
    Other arguments: ``progress`` as there.
    A message for the start and after every period, stamped with the simulated time.  A run that
    fails or is interrupted leaves no file.
    """
    scene = replace(scene, rate=simulation.rate)
    moment = Moment(simulation, Grid(simulation.rate),
                    tuple(scene.boat.center_of_mass.tolist()))
    with written(path, lambda: moment.stamp) as topics:
        outputs = Outputs(topics, scene, sensors_of(topics, scene),
                          transforms.topics_of(topics, scene, moment.stamp))
        markers = Markers(topics, scene)
        WavesOutput(topics).publish(simulation.sea)

        def publish():
            outputs.publish(moment)
            markers.look(moment, moment.stamp / NANOSECONDS)

        def push(time, state):
            publish()
            moment.wrench = thrust(time, state) if callable(thrust) else thrust
            return moment.wrench

        run = simulation.run(duration, push, progress=progress)
        publish()
    return run


@dataclass
class Moment:
    """
    The present of a run, with what `Outputs` asks of a `Session`.

    ``grid`` of the stamps; ``center_of_mass`` (3) m in the body frame; ``wrench`` (6,), the
    thrust of the last period, None before the first.
    """

    simulation: Simulation
    grid: Grid
    center_of_mass: tuple
    wrench: object = None

    @property
    def stamp(self):
        """Return the simulated time in ns."""
        return self.grid.stamp(self.simulation.steps)


@contextmanager
def written(path, now):
    """
    Give `Topics` that are written to an MCAP file, which is there when all went well.

    ``now`` () -> ns, the time of what is published.
    """
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
    path = Path(path)
    # A bag is a folder; of this one nothing is wanted but the file in it.
    with TemporaryDirectory(dir=path.parent) as folder:
        bag = Writer(Path(folder) / path.stem, version=9, storage_plugin=StoragePlugin.MCAP)
        bag.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        with bag:
            yield Topics(bag, now)
        os.replace(bag.path / f'{path.stem}.mcap', path)


class Topics:
    """What `NodeTopics` are to a node, to a bag: ``name``, ``make``, ``publisher``."""

    name = f'/{NODE_NAME}'

    def __init__(self, bag, now):
        """Write into a bag of rosbags, at a time () -> ns."""
        from rosbags.typesys import get_typestore, Stores
        self._bag, self._now, self._store = bag, now, get_typestore(Stores.ROS2_JAZZY)

    def make(self, kind):
        """Return an empty message of a kind, as 'geometry_msgs/msg/PoseStamped'."""
        _, fields = self._store.fielddefs[kind]
        return self._store.types[kind](**{
            name: self._empty(*described) for name, described in fields})

    def _empty(self, node, what):
        """Return the empty value of a field, as rosbags describes it."""
        from rosbags.interfaces import Nodetype
        if node == Nodetype.NAME:
            return self.make(what)
        if node == Nodetype.BASE:
            return '' if what[0] == 'string' else np.zeros((), what[0]).item()
        (part, kind), count = what
        if part == Nodetype.NAME or kind[0] == 'string':
            return []
        return np.zeros(count if node == Nodetype.ARRAY else 0, kind[0])

    def publisher(self, topic, message):
        """Return what writes such messages."""
        topic, kind = f'/{topic.lstrip("/")}', message.__msgtype__
        connection = self._bag.add_connection(
            topic, kind, typestore=self._store,
            offered_qos_profiles=[quality(topic)])

        def publish(message):
            # rosbags writes arrays of NumPy only.
            if isinstance(getattr(message, 'data', None), array):
                message.data = np.array(message.data)
            self._bag.write(
                connection, self._now(), self._store.serialize_cdr(message, kind))

        return SimpleNamespace(get_subscription_count=lambda: 1, publish=publish)


def quality(topic):
    """Return how messages of a topic travel when they are played: as the node's, all reliable."""
    from rosbags.interfaces import (Qos, QosDurability, QosHistory, QosLiveliness,
                                    QosReliability, QosTime)
    depth, durability = {
        '/tf': (100, QosDurability.VOLATILE), '/tf_static': (1, QosDurability.TRANSIENT_LOCAL),
        '/waves': (1, QosDurability.TRANSIENT_LOCAL),
    }.get(topic, (10, QosDurability.VOLATILE))
    unset = QosTime(0, 0)
    return Qos(QosHistory.KEEP_LAST, depth, QosReliability.RELIABLE, durability, unset, unset,
               QosLiveliness.SYSTEM_DEFAULT, unset, False)
