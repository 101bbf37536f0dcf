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

"""What changes of a boat: where it is and how it moves."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import rotation

PARTS = ('position', 'orientation', 'velocity', 'angular_velocity')


class Motion(NamedTuple):
    """
    A state as the step carries it, tuples of floats, of the centre of mass.

    ``position`` (3) m in world axes and ``orientation`` (4), body to world; ``body_velocity`` (3)
    m/s and ``angular_velocity`` (3) rad/s in body axes.
    """

    position: tuple
    orientation: tuple
    body_velocity: tuple
    angular_velocity: tuple


@dataclass(frozen=True, eq=False)
class State:
    """
    Where a boat is and how it moves: of its centre of mass.

    ``position`` (..., 3) m and ``velocity`` (..., 3) m/s in world axes, ``orientation`` (..., 4)
    unit quaternion x, y, z, w, body to world, ``angular_velocity`` (..., 3) rad/s in body axes.
    Leading dimensions are a fleet.
    """

    position: ArrayLike = (0.0, 0.0, 0.0)
    orientation: ArrayLike = (0.0, 0.0, 0.0, 1.0)
    velocity: ArrayLike = (0.0, 0.0, 0.0)
    angular_velocity: ArrayLike = (0.0, 0.0, 0.0)

    def __post_init__(self):
        """Store read-only float arrays of one batch shape."""
        batches = []
        for name, length in zip(PARTS, (3, 4, 3, 3)):
            values = np.array(getattr(self, name), float)
            if values.ndim < 1 or values.shape[-1] != length:
                raise ValueError(f'state.{name}: expected shape (..., {length}), '
                                 f'got {values.shape}')
            batches.append((name, values, length))
        batch = np.broadcast_shapes(*(values.shape[:-1] for _, values, _ in batches))
        for name, values, length in batches:
            values = np.broadcast_to(values, (*batch, length)).copy()
            values.setflags(write=False)
            object.__setattr__(self, name, values)

    @property
    def batch_shape(self) -> tuple[int, ...]:
        """Return the leading dimensions, () for one boat."""
        return self.position.shape[:-1]

    def __getitem__(self, index: int | slice | np.ndarray) -> 'State':
        """Return the state of one boat of a fleet, or of some."""
        return State(*(getattr(self, name)[index] for name in PARTS))

    @property
    def roll(self) -> np.ndarray:
        """Return (...) rad about body x, starboard down, see `roll_pitch_yaw`."""
        return self.roll_pitch_yaw[0]

    @property
    def pitch(self) -> np.ndarray:
        """Return (...) rad, bow down, within +-pi/2, see `roll_pitch_yaw`."""
        return self.roll_pitch_yaw[1]

    @property
    def yaw(self) -> np.ndarray:
        """Return (...) rad, the heading counter-clockwise from world x, see `roll_pitch_yaw`."""
        return self.roll_pitch_yaw[2]

    @property
    def roll_pitch_yaw(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return three (...) rad: turns about world x, then y, then z (REP-103)."""
        return rotation.to_roll_pitch_yaw(_components(self.orientation))

    @property
    def body_velocity(self) -> np.ndarray:
        """Return ``velocity`` (..., 3) m/s in body axes."""
        turned = rotation.rotation_matrix(_components(self.orientation))
        return np.stack(rotation.to_body(turned, _components(self.velocity)), axis=-1)


def to_rows(state):
    """Return a `State` as rows (..., 13) for the step: a `Motion` each, unit quaternions."""
    length = np.sqrt((state.orientation ** 2).sum(axis=-1, keepdims=True))
    return np.concatenate([state.position, state.orientation / length, state.body_velocity,
                           state.angular_velocity], axis=-1)


def from_rows(rows):
    """Return the `State` of rows (..., 13)."""
    orientation = rows[..., 3:7]
    turned = rotation.rotation_matrix(_components(orientation))
    velocity = np.stack(rotation.to_world(turned, _components(rows[..., 7:10])), axis=-1)
    return State(rows[..., :3], orientation, velocity, rows[..., 10:])


def body_frame(boat, state):
    """
    Return the pose and twist of the body frame, not of the centre of mass.

    Returns position (..., 3) m of the body origin in world axes, orientation (..., 4), velocity
    (..., 3) m/s of the body origin in body axes and angular velocity (..., 3) rad/s in body axes.
    """
    turned = rotation.rotation_matrix(_components(state.orientation))
    offset = np.stack(rotation.to_world(turned, tuple(boat.center_of_mass)), axis=-1)
    return (state.position - offset, state.orientation,
            state.body_velocity - np.cross(state.angular_velocity, boat.center_of_mass),
            state.angular_velocity)


def center_of_mass_state(boat, position, orientation, velocity=(0.0, 0.0, 0.0),
                         angular_velocity=(0.0, 0.0, 0.0)):
    """Return the State of a body frame's pose and twist, the inverse of `body_frame`."""
    turned = rotation.rotation_matrix(_components(orientation))
    offset = np.stack(rotation.to_world(turned, tuple(boat.center_of_mass)), axis=-1)
    moved = np.asarray(velocity, float) + np.cross(angular_velocity, boat.center_of_mass)
    return State(position + offset, orientation,
                 np.stack(rotation.to_world(turned, _components(moved)), axis=-1),
                 angular_velocity)


def _components(vectors):
    """Return the components of vectors (..., k), each (...)."""
    return tuple(np.moveaxis(np.asarray(vectors, float), -1, 0))
