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

"""What pushes the boat of a running node, as it is asked for."""

from functools import partial

from geometry_msgs.msg import WrenchStamped
from std_msgs.msg import Float64

from .snapshot import pushes_of
from ...ros import qos
from ...ros.complaints import check_finite
from ...ros.thrust import read_thrust, read_wrench, ThrusterLatches, ThrustLatch


class RemoteThrust:
    """
    The commands to one boat, as its node hears them: refused and timed out as there.

    Main arguments: ``node`` of ours; ``prefix`` of the boat's topics; ``clock`` () -> s, the time
    that the boat lives by.
    """

    def __init__(self, node, prefix, clock):
        """Listen for wrenches; `take` says which thrusters there are."""
        self._node, self._prefix, self._clock = node, prefix, clock
        self._scene, self._wrench, self._subscriptions = None, ThrustLatch(0.0), []
        self._thrusters = ThrusterLatches((), 0.0)
        self._listen(WrenchStamped, 'thrust', self._take_wrench)

    def _listen(self, kind, topic, take):
        def heed(message):
            try:
                take(message)
            except Exception:
                pass  # the node refuses it, too, and says why
        return self._node.create_subscription(kind, f'{self._prefix}/{topic}', heed, qos.THRUST)

    def take(self, scene):
        """Go on with the `Scene` that the node has now."""
        before, self._scene = self._scene, scene
        self._wrench.timeout = scene.thrust_timeout
        if before is None or before.thrusters != scene.thrusters:
            for subscription in self._subscriptions:
                self._node.destroy_subscription(subscription)
            self._thrusters = ThrusterLatches(
                [thruster.name for thruster in scene.thrusters], 0.0)
            self._subscriptions = [
                self._listen(Float64, f'thrusters/{thruster.name}/{part}',
                             partial(take, thruster))
                for thruster in scene.thrusters
                for part, take in (('thrust', self._take_thrust), ('pos', self._take_angle))]
        self._thrusters.set_timeout(scene.thrust_timeout)

    def _take_wrench(self, message):
        if self._scene is not None:
            self._wrench.hold(*read_wrench(message, self._scene), self._clock())

    def _take_thrust(self, thruster, message):
        thrust = read_thrust(thruster.name, message, thruster, self._scene)
        self._thrusters.hold(thruster.name, thrust, self._clock())

    def _take_angle(self, thruster, message):
        check_finite(thruster.name, [message.data])
        self._thrusters.angles[thruster.name] = message.data

    def clear(self):
        """Forget all commands, as a reset does."""
        self._wrench.clear()
        self._thrusters.clear()

    def pushes(self, orientation):
        """Return the pushes of a `Snapshot`; ``orientation`` (4) of the boat."""
        now, thrusters, latches = self._clock(), self._scene.thrusters, self._thrusters
        commands = latches.commands(now)
        forces = {thruster.name: thruster.limited(commands.get(thruster.name, 0.0))
                  for thruster in thrusters}
        return pushes_of(thrusters, forces, latches.angles,
                         self._wrench.wrench(now, lambda: orientation))
