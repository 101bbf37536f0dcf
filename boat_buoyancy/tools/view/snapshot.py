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

"""A boat and its water at one moment, as they are drawn."""

from dataclasses import dataclass

import numpy as np

from ...physics.boat.boat import Boat
from ...physics.boat.hull import LAWS
from ...physics.forces.probe_laws import arm, wetting
from ...physics.rotation import rotation_matrix
from ...physics.sea.waves import Water


@dataclass(frozen=True, eq=False)
class Snapshot:
    """
    A boat and its water at one moment; nothing in it changes any more.

    ``boat``; ``water``, whose clock says ``time`` s; ``stamp`` s; ``position`` (3,) m of the body
    frame in the world and ``orientation`` (4,), body to world; ``depths`` (n,) m and ``lift``
    (n,) N of the probes; ``pushes``, pairs of a place (3,) m and a force (3,) N, body frame.
    """

    boat: Boat
    water: Water
    time: float
    stamp: float
    position: np.ndarray
    orientation: np.ndarray
    depths: np.ndarray
    lift: np.ndarray
    pushes: tuple = ()

    @property
    def turn(self):
        """Return the matrix (3, 3) from body to world axes."""
        return np.reshape(rotation_matrix(tuple(self.orientation.tolist())), (3, 3))

    @property
    def wetness(self):
        """Return (n,), 0 to 1, how far each probe is in the water."""
        return np.array([wet for wet, _ in self._wetting()])

    @property
    def center_of_buoyancy(self):
        """
        Return where the lift acts, (3,) m in the body frame; None where there is none.

        With panels, where the columns of the probes would lift.
        """
        total = self.lift.sum()
        if not total > 0.0:
            return None
        hull, law, upright = self.boat.hull, LAWS.index(self.boat.hull.law), self.turn[2, 2]
        above = [arm(law, height, wet, upright)
                 for height, (wet, _) in zip(hull.height, self._wetting())]
        places = hull.positions + np.multiply.outer(above, [0.0, 0.0, 1.0])
        return self.lift @ places / total

    def _wetting(self):
        hull, upright = self.boat.hull, self.turn[2, 2]
        law = LAWS.index(hull.law)
        return [wetting(law, height, depth, upright)
                for height, depth in zip(hull.height.tolist(), self.depths.tolist())]


def pushes_of(thrusters, forces, angles, wrench):
    """
    Return the ``pushes`` of a `Snapshot`.

    ``thrusters``, each a `Thruster`; ``forces`` {name: N}; ``angles`` {name: rad}, 0 where left
    out; ``wrench`` (6) N and N m at the body origin, body axes, or None.
    """
    pushes = [(thruster.position,
               thruster.wrench(forces[thruster.name], angles.get(thruster.name, 0.0))[0])
              for thruster in thrusters]
    if wrench is not None and any(wrench):
        pushes.append(((0.0, 0.0, 0.0), tuple(wrench[:3])))
    return tuple(pushes)
