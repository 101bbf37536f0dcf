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
Thrusters: each pushes the boat along its axis, where it is, as long as it is in the water.

What they give acts over a whole period as the thrust of a step: the step itself knows none.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
import math

from .. import checks
from ..rotation import rotation_matrix, to_world
from ..vectors import add, cross, scale, subtract, ZERO


@dataclass(frozen=True)
class Thruster:
    """
    One thruster of a boat.

    Main arguments: ``name``; ``position`` (3) m in the body frame, where it pushes.
    Other arguments: ``direction`` (3) in body axes, of any length but 0, where it pushes the boat
    at an angle of 0; ``least`` and ``greatest`` N that it gives, 0 between them; ``lag`` s, the
    time constant of its thrust.  ValueError says what is wrong.
    """

    name: str
    position: tuple
    direction: tuple = (1.0, 0.0, 0.0)
    least: float = -math.inf
    greatest: float = math.inf
    lag: float = 0.0

    def __post_init__(self):
        """Store vectors as tuples, the direction of length 1."""
        about = f'thruster {self.name}'
        position, direction = (tuple(checks.vector(f'{about}: {part}', getattr(self, part), 3)
                                     .tolist()) for part in ('position', 'direction'))
        length = math.hypot(*direction)
        if length == 0.0:
            raise ValueError(f'{about}: expected a direction of some length, got {direction}')
        if not self.least <= 0.0 <= self.greatest:
            raise ValueError(f'{about}: expected limits with 0 between them, which it gives '
                             f'without a command, got {self.least:g} and {self.greatest:g} N')
        checks.number(f'{about}: lag', self.lag, at_least=0.0)
        object.__setattr__(self, 'position', position)
        object.__setattr__(self, 'direction', scale(1.0 / length, direction))

    def limited(self, command: float) -> float:
        """Return a command in N cut to the limits."""
        return min(max(command, self.least), self.greatest)

    def driven(self, force: float, command: float, duration: float) -> tuple[float, float]:
        """
        Return the mean thrust over ``duration`` s and the thrust after it, in N.

        ``force`` N at the start; ``command`` N, held meanwhile and cut to the limits.  Exact for
        lag T' = command - T: T+ = command + (T - command) e, e = exp(-duration / lag), and the
        mean is command + (T - command) (1 - e) lag / duration.
        """
        command = self.limited(command)
        if self.lag == 0.0:
            return command, command
        gone = -math.expm1(-duration / self.lag)
        return (command + (force - command) * gone * self.lag / duration,
                force + (command - force) * gone)

    def wrench(self, force: float, angle: float = 0.0) -> tuple[tuple, tuple]:
        """
        Return force N and torque N m at the body origin, body axes, of a thrust in N.

        ``angle`` rad turns it about body z; above 0 pushes to port.
        """
        x, y, z = scale(force, self.direction)
        cosine, sine = math.cos(angle), math.sin(angle)
        push = (cosine * x - sine * y, sine * x + cosine * y, z)
        return push, cross(self.position, push)


class Propulsion:
    """
    The thrusters of a boat at work: what each of them gives now.

    Main arguments: ``thrusters``, each a `Thruster`.  Public: ``thrusters`` {name: `Thruster`};
    ``forces`` {name: N}, at the end of the last period, in the water or out of it.
    """

    def __init__(self, thrusters: Iterable[Thruster]):
        """Stand still."""
        self.thrusters = {thruster.name: thruster for thruster in thrusters}
        self.stop()

    def stop(self) -> None:
        """Stand still at once."""
        self.forces = dict.fromkeys(self.thrusters, 0.0)

    def wrench(self, simulation, commands: Mapping, angles: Mapping | None = None) -> tuple:
        """
        Return the thrust (6) of the next period, for `Simulation.step`, and go on by that period.

        Main arguments: ``simulation`` a `Simulation`, asked for place, water and period;
        ``commands`` {name: N}, held over the period, 0 where left out.
        Other arguments: ``angles`` {name: rad} about body z, positive to port, 0 where left out.
        A thruster that is out of the water at the start of the period turns and gives nothing.
        ValueError for a name that no thruster has and for a number that is not finite.
        """
        angles = angles or {}
        for values in (commands, angles):
            for name, value in values.items():
                self._check(name, value)
        given, force, torque = {}, ZERO, ZERO
        for name, thruster in self.thrusters.items():
            given[name], self.forces[name] = thruster.driven(
                self.forces[name], commands.get(name, 0.0), 1.0 / simulation.rate)
        if any(given.values()):
            places = [thruster.position for thruster in self.thrusters.values()]
            for (name, thruster), deep in zip(self.thrusters.items(), depths(places, simulation)):
                if deep > 0.0:
                    push, turn = thruster.wrench(given[name], angles.get(name, 0.0))
                    force, torque = add(force, push), add(torque, turn)
        return (*force, *torque)

    def _check(self, name, value):
        if name not in self.thrusters:
            raise ValueError(f'thruster: expected one of {", ".join(self.thrusters) or "none"}, '
                             f'got {name!r}')
        checks.number(f'thruster {name}', value)


def depths(places, simulation):
    """Return how deep (n) m places (n, 3) m of the body frame are under a `Simulation`'s water."""
    motion, sea = simulation.motion, simulation.sea
    R, center = rotation_matrix(motion.orientation), simulation.boat.center_of_mass.tolist()
    x, y, z = zip(*(add(motion.position, to_world(R, subtract(place, center)))
                    for place in places))
    return [-height for height in z] if sea.is_flat else (
        sea.elevation(x, y, simulation.time) - z).tolist()
