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
A run written down: the body frame's motion, the depths of its probes and the water under it.

Also as CSV: the columns of the table are named here.
"""

from dataclasses import dataclass, fields, replace
from functools import cached_property
import os
from pathlib import Path

import numpy as np

from .. import checks
from ..boat.state import body_frame, from_rows
from ..rotation import rotation_matrix, to_roll_pitch_yaw, to_world
from ..sea.waves import Water

COLUMNS = ('time', 'x', 'y', 'z', 'qx', 'qy', 'qz', 'qw', 'vx', 'vy', 'vz', 'wx', 'wy', 'wz')
LAST_COLUMNS = ('roll', 'pitch', 'yaw', 'elevation')


@dataclass(frozen=True, eq=False)
class Trajectory:
    """
    A run at its start and after every period, n rows: what a node would publish.

    ``time`` (n,) s; of the body frame, not the centre of mass, ``position`` (n, 3) m and
    ``orientation`` (n, 4) x, y, z, w in the world, ``body_velocity`` (n, 3) m/s and
    ``angular_velocity`` (n, 3) rad/s in body axes; ``probe_depths`` (n, probes) m under water;
    ``sea``, the water that it was on.
    """

    time: np.ndarray
    position: np.ndarray
    orientation: np.ndarray
    body_velocity: np.ndarray
    angular_velocity: np.ndarray
    probe_depths: np.ndarray
    sea: Water

    @classmethod
    def of(cls, boat, sea, time, rows, depths):
        """Return the trajectory of a `Boat` on a sea, from the rows (n, 13) of its motion."""
        return cls(time, *body_frame(boat, from_rows(rows)), depths, sea)

    @cached_property
    def elevation(self) -> np.ndarray:
        """Return (n,) m, the height of the water at the boat."""
        x, y, _ = self.position.T
        # In pieces: a thousand waves at a million times do not fit into memory at once.
        pieces = np.array_split(np.arange(len(self.time)), len(self.time) // 1000 + 1)
        return np.concatenate([self.sea.elevation(x[piece], y[piece], self.time[piece])
                               for piece in pieces])

    @cached_property
    def velocity(self) -> np.ndarray:
        """Return (n, 3) m/s of the body origin in world axes."""
        turned = rotation_matrix(tuple(self.orientation.T))
        return np.stack(to_world(turned, tuple(self.body_velocity.T)), axis=-1)

    @cached_property
    def roll_pitch_yaw(self) -> np.ndarray:
        """Return (n, 3) rad: turns about world x, then y, then z (REP-103)."""
        return np.stack(to_roll_pitch_yaw(tuple(self.orientation.T)), axis=-1)

    @property
    def roll(self) -> np.ndarray:
        """Return (n,) rad, starboard down."""
        return self.roll_pitch_yaw[:, 0]

    @property
    def pitch(self) -> np.ndarray:
        """Return (n,) rad, bow down."""
        return self.roll_pitch_yaw[:, 1]

    @property
    def yaw(self) -> np.ndarray:
        """Return (n,) rad, the heading counter-clockwise from world x."""
        return self.roll_pitch_yaw[:, 2]

    def every(self, number: int) -> 'Trajectory':
        """Return the trajectory with each ``number``-th row only, from the first on."""
        number = checks.count('every', number, at_least=1)
        return replace(self, **{field.name: getattr(self, field.name)[::number]
                                for field in fields(self) if field.name != 'sea'})

    def to_csv(self, path: str | os.PathLike) -> None:
        """Write one row per period as CSV, every number with all its digits."""
        depths = [f'depth_{i}' for i in range(self.probe_depths.shape[1])]
        table = np.column_stack([self.time, self.position, self.orientation, self.body_velocity,
                                 self.angular_velocity, self.probe_depths, self.roll_pitch_yaw,
                                 self.elevation])
        with Path(path).open('w', encoding='utf-8', newline='') as file:
            file.write(','.join([*COLUMNS, *depths, *LAST_COLUMNS]) + '\n')
            file.writelines(','.join(map(repr, row.tolist())) + '\n' for row in table)
