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

"""All boats that running nodes float, offered to a page as a `Loop` is."""

from concurrent.futures import Future
from threading import Event, Thread
import time

from rcl_interfaces.msg import ParameterEvent
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_profile_parameter_events

from .live_boat import PUSH_LASTS
from .remote_boat import RemoteBoat
from .scene_text import scene_text
from ...physics.scene.parameters import NODE_NAME
from ...ros import network, startup

LOOK = 1.0  # s between looks at who is there


class Remote:
    """
    The boats on the network, one of them in the middle of the page.

    Main arguments: ``arguments`` of ROS, as ``-r __ns:=/red`` for the boat to look at first.
    Public: ``wanted``, the namespace of that one, '/' for any; the rest as of a `Loop`.
    """

    def __init__(self, arguments):
        """Listen; ValueError for arguments that ROS does not take."""
        network.never_wait()
        self._context = Context()
        try:
            with startup.quiet_stderr():
                self._context.init(['buoyancy_view', '--ros-args', *arguments])
        except Exception as error:
            raise ValueError(f'--ros: {error}') from None
        self._node = Node('buoyancy_view', context=self._context)
        self.wanted = self._node.get_namespace()
        self._boats, self._present, self._chosen = {}, set(), None
        # The boat that is pushed, and until when.
        self._pushed = None
        self._began, self.ended = {}, Future()
        self._node.create_timer(LOOK, self._look)
        self._node.create_timer(0.1, self._let_go)
        self._node.create_subscription(ParameterEvent, '/parameter_events', self._changed,
                                       qos_profile_parameter_events)
        self._executor, self._ready = SingleThreadedExecutor(
            context=self._context), Event()
        self._executor.add_node(self._node)
        self._thread = Thread(target=self._spin, name='ros', daemon=True)
        self._thread.start()

    def _spin(self):
        try:
            self._executor.spin()
        except ExternalShutdownException:
            pass
        except BaseException as error:
            self.ended.set_exception(error)

    @property
    def troubles(self):
        """Return the sentences of what is wrong with the boats, a set."""
        return {boat.trouble for boat in self._boats.values()} - {None}

    def stop(self):
        """Leave the network, and no boat that is still pushed."""
        self._release()
        self._executor.shutdown()
        self._thread.join(2.0)
        self._node.destroy_node()
        self._context.try_shutdown()

    def wait(self, seconds):
        """Return True once there is a boat to show, False after ``seconds`` without one."""
        return self._ready.wait(seconds)

    def _look(self):
        """Notice who came and who went."""
        present = {namespace for name, namespace in self._node.get_node_names_and_namespaces()
                   if name == NODE_NAME}
        for namespace in sorted(present - self._present):
            if namespace not in self._boats:
                self._boats = {**self._boats, namespace: RemoteBoat(self._node, namespace)}
            self._boats[namespace].met()
        for namespace in self._present - present:
            boat = self._boats[namespace]
            boat.gone()
        self._present = present
        for boat in self._boats.values():
            if boat.scene is None and boat.namespace in present:
                boat.look()
        shown = [name for name, boat in self._boats.items() if boat.scene is not None]
        # Who names a boat waits for it.
        wanted = shown if self.wanted == '/' else [name for name in shown if name == self.wanted]
        if self._chosen is None and wanted:
            self._chosen = wanted[0]
            self._ready.set()

    def _changed(self, event):
        for boat in self._boats.values():
            if boat.path == event.node:
                boat.look()

    def _let_go(self):
        """End a push: a node whose thrust.timeout is 0 would hold it for ever."""
        if self._pushed is not None and time.monotonic() > self._pushed[1]:
            self._release()

    def _release(self):
        pushed, self._pushed = self._pushed, None
        if pushed is not None:
            pushed[0].push(0.0, 0.0)

    # What a page shows.

    @property
    def _boat(self):
        return self._boats[self._chosen]

    name = property(lambda self: self._chosen)
    scenes = property(lambda self: {name: name for name in sorted(self._boats)})
    begun = property(lambda self: (self._chosen, self._boat.begun))
    history = property(lambda self: self._boat.history)
    paused = property(lambda self: self._boat.paused)
    fault = property(lambda self: self._boat.trouble)
    speed = property(lambda self: self._boat.speed)

    @property
    def scene(self):
        """Return the `Scene` of the boat in the middle."""
        scene = self._boat.scene
        self._began.setdefault(self._chosen, scene.given)
        return scene

    @property
    def snapshots(self):
        """Return {name: `Snapshot`} of all boats that are there, the one in the middle first."""
        boats = [self._boat, *(boat for boat in self._boats.values() if boat is not self._boat)]
        shown = {boat.namespace.strip('/') or 'boat': boat.snapshot() for boat in boats
                 if boat.trouble is None}
        return {name: snapshot for name, snapshot in shown.items() if snapshot is not None}

    def text(self):
        """Return the parameters of the node as the text of a parameter file."""
        return scene_text(self._boat.path, self.scene.given, self._began[self._chosen])

    # What a page asks for.

    def tune(self, values):
        """Set parameters of the node."""
        self._boat.tune(values)

    def switch(self, namespace):
        """Look at another boat."""
        if self._boats[namespace].scene is None:
            raise ValueError(f'{namespace}: nothing has come of its parameters yet')
        self._release()
        self._chosen = namespace

    def push(self, ahead, turn):
        """Push for `PUSH_LASTS` s."""
        boat = self._boat
        boat.push(ahead, turn)
        self._pushed = boat, time.monotonic() + PUSH_LASTS

    def lift(self, height):
        """Refuse: a node has no way to be asked."""
        raise ValueError('lift and drop: a running node is not lifted; start it with '
                         'start.position: x, y, z')

    def heel(self, angle):
        """Refuse: a node has no way to be asked."""
        raise ValueError('heel and let go: a running node is not heeled; start it with '
                         'start.orientation')

    def reset(self):
        """Put the boat back to its start."""
        self._boat.trigger('reset')

    def step(self):
        """Advance one period while paused."""
        self._boat.trigger('step')

    def pause(self, paused):
        """Stop or go on."""
        self._boat.pause(paused)

    def set_pace(self, pace):
        """Refuse: the pace of a node is given at its start."""
        raise ValueError('pace: a running node keeps its own; start it with time_factor')
