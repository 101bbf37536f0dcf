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

"""Thrusters driven by other nodes: a topic for the thrust and one for the angle of each."""

from std_msgs.msg import Float64

from . import qos
from .complaints import check_finite
from .thrust import read_thrust


class ThrusterInput:
    """
    The subscriptions `thrusters/<name>/thrust` and `thrusters/<name>/pos`.

    Main arguments: ``node``; ``thruster`` a `Thruster`; ``session``, whose thruster it is;
    ``command`` as of `Reports`.
    """

    def __init__(self, node, thruster, session, command):
        """Listen."""
        self._thruster, self._session = thruster, session
        self._topic = f'thrusters/{thruster.name}'
        for part, act in (('thrust', self._on_thrust), ('pos', self._on_angle)):
            topic = f'{self._topic}/{part}'
            node.create_subscription(Float64, topic, command(topic, act), qos.THRUST)

    def _on_thrust(self, message):
        thrust = read_thrust(f'{self._topic}/thrust', message, self._thruster,
                             self._session.scene)
        self._session.thrusters.hold(self._thruster.name, thrust, self._session.age)

    def _on_angle(self, message):
        check_finite(f'{self._topic}/pos', [message.data])
        self._session.thrusters.angles[self._thruster.name] = message.data
