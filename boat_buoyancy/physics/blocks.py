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
States as the step carries them: components, and a fleet in blocks.

A block is as many boats as hide the cost of a NumPy call, and few enough that what a step writes
stays in the cache (measured by ``buoyancy_chart --speed``).
"""

import numpy as np

from .boat import State
from .motion import Motion
from .quaternion import normalise, rotation_matrix, to_body, to_world

MOST_BOATS = 4000
# Doubles in the largest array of a step, the angle of every wave at every probe: one megabyte.
MOST_ANGLES = 2 ** 17


def block_size(probes, waves):
    """Return how many boats of so many probes are stepped together in a sea of so many waves."""
    # Each wave has two angles, one for its cosine and one for its sine.
    return max(1, min(MOST_BOATS, MOST_ANGLES // (2 * probes * max(waves, 1))))


def from_state(backend, state, size):
    """Return the motions of a checked `State`, one for a single boat, one a block for a fleet."""
    arrays = (state.position, state.orientation, state.velocity, state.angular_velocity)
    if not state.batch_shape:
        return [_motion(backend, *(tuple(values.tolist()) for values in arrays))]
    columns = [np.ascontiguousarray(values.reshape(-1, values.shape[-1]).T) for values in arrays]
    return [_motion(backend, *parts) for parts in _cut(columns, size)]


def to_state(backend, motions, batch_shape):
    """Return the `State` of motions, with their velocity in world axes."""
    def stacked(parts):
        columns = np.concatenate([backend.column(part) for part in parts], axis=1)
        return columns.T.reshape(*batch_shape, -1)

    return State(
        stacked([motion.position for motion in motions]),
        stacked([motion.orientation for motion in motions]),
        stacked([to_world(rotation_matrix(motion.orientation), motion.velocity)
                 for motion in motions]),
        stacked([motion.angular_velocity for motion in motions]))


def recut(motions, size):
    """Return the motions of a fleet in blocks of another size, to the bit the same."""
    columns = [np.concatenate([np.stack(part) for part in parts], axis=1)
               for parts in zip(*motions)]
    return [Motion(*parts) for parts in _cut(columns, size)]


def of_blocks(wrench, size):
    """Yield the part of a wrench, six numbers or arrays (B,), for each block of a fleet."""
    start = 0
    while True:
        yield tuple(c[start:start + size] if isinstance(c, np.ndarray) else c for c in wrench)
        start += size


def _cut(columns, size):
    """Yield each block of arrays (k, B) as tuples of components."""
    for start in range(0, columns[0].shape[1], size):
        yield [tuple(values[:, start:start + size]) for values in columns]


def _motion(backend, position, orientation, velocity, angular_velocity):
    orientation = normalise(backend, orientation)
    return Motion(position, orientation, to_body(rotation_matrix(orientation), velocity),
                  angular_velocity)
