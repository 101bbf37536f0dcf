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

"""A boat that a running node floats, seen through its topics and parameters."""

from functools import partial
from threading import Event
import time

from geometry_msgs.msg import WrenchStamped
from nav_msgs.msg import Odometry
import numpy as np
from rcl_interfaces.srv import GetParameters, SetParametersAtomically
from rclpy.parameter import Parameter, parameter_value_to_python
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Float64MultiArray
from std_srvs.srv import SetBool, Trigger

from .history import History
from .loop import MEASURED, Speed
from .remote_thrust import RemoteThrust
from .snapshot import Snapshot
from ...physics.rotation import to_roll_pitch_yaw
from ...physics.scene.parameter_values import checked
from ...physics.scene.parameters import NODE_NAME, PARAMETERS
from ...physics.scene.scene import scene_from_values
from ...ros import qos
from ...ros.messages import CLOUD_FIELDS
from ...ros.parameters import ros_parameter

PATIENCE = 5.0  # s for an answer of the node


class RemoteBoat:
    """
    One boat.

    Main arguments: ``node`` of ours, which somebody spins; ``namespace`` of the boat's node.
    Public: ``scene``, made of its parameters, None before they came; ``trouble``, a sentence while
    something is wrong with it, else None; ``history``; ``paused`` by us; ``begun``, how often its
    node was met.
    """

    def __init__(self, node, namespace):
        """Listen."""
        self._node, self.namespace = node, namespace
        self.path = f'{namespace.rstrip("/")}/{NODE_NAME}'
        self.scene = self.trouble = self._wrong = self._odometry = self._waves = self._sea = None
        self.history, self.paused, self.begun = History(), False, 0
        self._probes = np.zeros((0, len(CLOUD_FIELDS)))
        self._since, self._speed, self._age = None, Speed(), 0.0
        prefix = namespace.rstrip('/')
        for kind, topic, take, profile in (
                (Odometry, 'odom', self._take_odometry, qos.OUTPUT),
                (PointCloud2, 'probes', self._take_probes, qos.OUTPUT),
                (Float64MultiArray, 'waves', self._take_waves, qos.SEA_IN_FORCE)):
            node.create_subscription(kind, f'{prefix}/{topic}', partial(self._try, topic, take),
                                     profile)
        self._pushed = RemoteThrust(node, prefix, lambda: self._age)
        self._thrust = node.create_publisher(WrenchStamped, f'{prefix}/thrust', qos.THRUST)
        self._clients = {name: node.create_client(kind, f'{self.path}/{name}')
                         for name, kind in (('get_parameters', GetParameters),
                                            ('set_parameters_atomically', SetParametersAtomically),
                                            ('reset', Trigger), ('step', Trigger),
                                            ('set_paused', SetBool))}

    # What it tells.

    def met(self):
        """Ask a node that came, or came back, for all that is to be known of it."""
        self.trouble = self._wrong = None
        self.begun += 1
        self._pushed.clear()
        self.look()

    def gone(self):
        """Take note that the node went away."""
        self.trouble = f'{self.path} is gone; it is shown again when it comes back'
        self._wrong = None

    def _try(self, what, take, news):
        """Take news of ``what``; where that fails, say so until it goes well again."""
        try:
            take(news)
        except Exception as error:
            self.trouble, self._wrong = f'{self.path}: {what}: {error}', what
        else:
            if self._wrong == what:
                self.trouble = self._wrong = None

    def look(self):
        """Ask for the parameters, without waiting for them."""
        request = GetParameters.Request(names=list(PARAMETERS))
        future = self._clients['get_parameters'].call_async(request)
        future.add_done_callback(partial(self._try, 'parameters', self._take_parameters))

    def _take_parameters(self, done):
        values = {name: parameter_value_to_python(value)
                  for name, value in zip(PARAMETERS, done.result().values)}
        scene = scene_from_values({
            name: value for name, value in values.items() if value is not None}, self.scene)
        self._sea = _sea_of(scene, self._waves)
        self._pushed.take(scene)
        self.scene = scene

    def _take_odometry(self, message):
        before, self._odometry = self._odometry, message
        stamp, now = _seconds(message), time.monotonic()
        # The time that the boat has lived, whatever becomes of its stamps.
        self._age += max(0.0, stamp - _seconds(before)) if before else 0.0
        pose = message.pose.pose
        velocity = message.twist.twist.linear
        if self._since is None or stamp < self._since[1]:
            self._since = now, stamp
        elif now - self._since[0] >= MEASURED:
            (since, first), self._since = self._since, (now, stamp)
            self._speed = Speed(held=(stamp - first) / (now - since))
        if self.history.is_due(stamp):
            turn = pose.orientation
            self.history.add(stamp, (pose.position.x, pose.position.y, pose.position.z),
                             to_roll_pitch_yaw((turn.x, turn.y, turn.z, turn.w)),
                             (velocity.x, velocity.y, velocity.z))

    def _take_probes(self, message):
        self._probes = np.frombuffer(bytes(message.data), np.float32).reshape(
            message.width, len(CLOUD_FIELDS)).astype(float)

    def _take_waves(self, message):
        waves = np.reshape(message.data, (-1, 4))
        if self.scene is not None:
            self._sea = _sea_of(self.scene, waves)
        self._waves = waves

    @property
    def speed(self):
        """Return the `Speed` held in the last second; a step's cost is the node's own affair."""
        silent = self._since is None or time.monotonic() - self._since[0] > 2.0 * MEASURED
        return Speed() if silent else self._speed

    def snapshot(self):
        """Return the `Snapshot` of what came last; None before enough has come."""
        scene, message, probes = self.scene, self._odometry, self._probes
        if scene is None or message is None or len(probes) != len(scene.boat.hull.share):
            return None
        pose, stamp = message.pose.pose, _seconds(message)
        place, turn = pose.position, pose.orientation
        orientation = (turn.x, turn.y, turn.z, turn.w)
        return Snapshot(
            scene.boat, self._sea, stamp, stamp, np.array([place.x, place.y, place.z]),
            np.array(orientation), probes[:, 3], probes[:, 4], self._pushed.pushes(orientation))

    # What it is asked.

    def _answer(self, name, request):
        """Return what a service of the node answers; ValueError where it does not."""
        done, future = Event(), self._clients[name].call_async(request)
        future.add_done_callback(lambda _: done.set())
        if not done.wait(PATIENCE):
            self._clients[name].remove_pending_request(future)
            raise ValueError(f'{self.path} does not answer within {PATIENCE:g} s')
        return future.result()

    def tune(self, values):
        """Set parameters {name: value}, None to go back; ValueError with the node's sentence."""
        asked = [Parameter(name) if value is None else ros_parameter(name, checked(name, value))
                 for name, value in values.items()]
        result = self._answer('set_parameters_atomically', SetParametersAtomically.Request(
            parameters=[one.to_parameter_msg() for one in asked])).result
        if not result.successful:
            raise ValueError(result.reason)
        self.look()

    def push(self, ahead, turn):
        """Send a wrench, N and N m at the body origin."""
        message = WrenchStamped()
        message.wrench.force.x, message.wrench.torque.z = float(ahead), float(turn)
        self._thrust.publish(message)

    def trigger(self, name):
        """Call ``reset`` or ``step``; ValueError with what the node says against it."""
        answer = self._answer(name, Trigger.Request())
        if not answer.success:
            raise ValueError(answer.message)
        if name == 'reset':
            self._pushed.clear()

    def pause(self, paused):
        """Stop or go on."""
        self._answer('set_paused', SetBool.Request(data=paused))
        self.paused = paused


def _sea_of(scene, waves):
    """Return the sea of a scene with the waves (n, 4) that its node says are in force."""
    sea = scene.sea
    if waves is None or np.array_equal(waves, sea.waves):
        return sea
    return type(sea)(waves, sea.current, sea.depth, sea.gravity, sea.wind)


def _seconds(message):
    return message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec
