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

"""Thrust: a wrench as it comes, and how long the last one acts; of thrusters the same."""

from .complaints import check_finite, check_frame, Refused
from ..physics.rotation import rotation_matrix, to_body

# No thruster lifts a thousand times its boat: what asks for that is a fault.
MAX_THRUST = 1000.0  # boat weights


def read_wrench(message, scene):
    """
    Return the six numbers of a WrenchStamped, and True when they are in world axes.

    ``scene`` names the frames, and its boat's weight bounds what can be meant.  Raises nothing
    but `Refused`, whatever the message contains.
    """
    check_frame('thrust', message.header.frame_id, scene.body_frame, scene.world_frame)
    force, torque = message.wrench.force, message.wrench.torque
    values = (force.x, force.y, force.z, torque.x, torque.y, torque.z)
    check_finite('thrust', values)
    limit = MAX_THRUST * scene.boat.weight
    if max(map(abs, values)) > limit:
        raise Refused('too large', f'thrust: expected at most {limit:.3g} N and N m, '
                      f'{MAX_THRUST:g} times the weight of this boat, got {list(values)}')
    return values, message.header.frame_id == scene.world_frame


def read_thrust(topic, message, thruster, scene):
    """Return the thrust in N of a Float64 for a `Thruster` of a ``scene``, or raise `Refused`."""
    thrust = message.data
    check_finite(topic, [thrust])
    limit = MAX_THRUST * scene.boat.weight
    if abs(thruster.limited(thrust)) > limit:
        raise Refused('too large', f'{topic}: expected at most {limit:.3g} N, '
                      f'{MAX_THRUST:g} times the weight of this boat, got {thrust:g}')
    return thrust


class ThrustLatch:
    """
    The last good wrench, until it is too old.

    ``timeout`` s counts from reception, whatever the header says, on the clock that the boat lives
    by: half a second of slow motion is longer than that.  0 = hold.  One thread may ask while
    another one holds or clears.
    """

    def __init__(self, timeout):
        """Hold no wrench."""
        self.timeout = timeout
        self.clear()

    def clear(self):
        """Forget the wrench."""
        self._held = None

    def hold(self, wrench, in_world, now):
        """Hold six numbers, in world axes or body axes, received at ``now`` s."""
        self._held = wrench, in_world, now

    def age(self, now):
        """Return the s since the last good wrench, None without one."""
        held = self._held
        return None if held is None else now - held[2]

    def expired(self, now):
        """Return True when there is a wrench, and it is too old to act."""
        age = self.age(now)
        return age is not None and 0.0 < self.timeout < age

    def wrench(self, now, orientation):
        """
        Return the wrench that acts at ``now`` s, in body axes, or None.

        ``orientation`` () -> the boat's quaternion, asked for only when it is needed: a wrench
        in world axes keeps its direction while the boat turns under it.
        """
        held = self._held
        if held is None or self.expired(now):
            return None
        wrench, in_world, _ = held
        if not in_world:
            return wrench
        rotation = rotation_matrix(orientation())
        return (*to_body(rotation, wrench[:3]), *to_body(rotation, wrench[3:]))


class ThrusterLatches:
    """
    What is asked of each thruster: a thrust, until that is too old, and an angle.

    Main arguments: ``names``; ``timeout`` s, as of `ThrustLatch`.  Public: ``angles``
    {name: rad}, held for ever: a thruster that gives nothing stays turned.
    """

    def __init__(self, names, timeout):
        """Ask nothing."""
        self._latches = {name: ThrustLatch(timeout) for name in names}
        self.angles = {}

    def set_timeout(self, timeout):
        """Let another time-out in s count from now on."""
        for latch in self._latches.values():
            latch.timeout = timeout

    def clear(self):
        """Forget everything."""
        self.angles = {}
        for latch in self._latches.values():
            latch.clear()

    def hold(self, name, thrust, now):
        """Ask a thrust in N of a thruster, received at ``now`` s."""
        self._latches[name].hold(thrust, False, now)

    def commands(self, now):
        """Return {name: N} of the thrusts that are asked for at ``now`` s."""
        asked = {name: latch.wrench(now, None) for name, latch in self._latches.items()}
        return {name: thrust for name, thrust in asked.items() if thrust is not None}
