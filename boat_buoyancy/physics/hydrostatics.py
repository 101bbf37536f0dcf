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
Hydrostatics: where a boat rests in still water.

Computed with the forces of the simulation itself, so that it says what the simulation will do.
What else a boat at rest does is in `flotation` (metacentric heights, warnings), `righting`
(righting arms) and `equilibrium` (periods).
"""

import numpy as np

from .backend import FLEET
from .boat import center_of_mass_state, State
from .forces import evaluate, System
from .quaternion import from_roll_pitch_yaw, rotation_matrix, to_world
from .waves import Sea

STILL_WATER = Sea()
# Lifts that differ by less than this part of the weight are one lift: a plateau of full and dry
# probes that carries exactly the weight must not be lost to round-off.
LIFT_TOLERANCE = 1e-12
# A soft probe at this many heights is full to the last digit.
DEEP_HEIGHTS = 40.0
# A bracket is cut into so many parts at a time, often enough to come down to the last digit.
PARTS, ROUNDS = 32, 13


def floats(boat):
    """Return True when the buoyancy budget exceeds the weight: only then there is a draft."""
    return boat.floatiness > 1.0 + LIFT_TOLERANCE


def rest_state(boat, roll=0.0, pitch=0.0, yaw=0.0, x=0.0, y=0.0):
    """
    Return the State of a boat without motion that carries its own weight at the attitude given.

    Main arguments: ``roll``, ``pitch`` and ``yaw`` rad, as in a parameter file.
    Other arguments: ``x`` and ``y`` m, the body origin in the world.  Arrays give a fleet.

    Only the height is solved for: torques need not vanish.  Where a range of heights carries the
    weight, the highest is taken.  A boat that does not float (see `floats`) is put where its
    shallowest probe is at its height under water, so that every probe is full.
    """
    roll, pitch, yaw, x, y = np.broadcast_arrays(
        *(np.asarray(value, float) for value in (roll, pitch, yaw, x, y)))
    orientation = from_roll_pitch_yaw(*(angle.ravel() for angle in (roll, pitch, yaw)))
    solve = _floating_height if floats(boat) else _sunk_height
    height = solve(boat, orientation).reshape(roll.shape)
    orientation = np.stack(orientation, axis=-1).reshape(*roll.shape, 4)
    placed = center_of_mass_state(boat, np.stack([x, y, np.zeros_like(x)], axis=-1), orientation)
    position = placed.position.copy()
    position[..., 2] = height
    return State(position, orientation)


def load_at(boat, state):
    """Return the `Load` of a still boat in still water; its arrays are those of a fleet."""
    position = tuple(state.position.reshape(-1, 3).T)
    orientation = tuple(state.orientation.reshape(-1, 4).T)
    return evaluate(System.of(boat, FLEET), STILL_WATER, position, orientation, 0.0)


def draft(boat, state):
    """Return the depth (...) m of the deepest probe of a boat in still water."""
    return np.max(load_at(boat, state).depth, axis=0).reshape(state.batch_shape)[()]


def level_torque(boat):
    """Return the torque (2,) N m about x and y that turns a boat away from level at rest."""
    torque = load_at(boat, rest_state(boat)).torque
    return np.array([torque[0][0], torque[1][0]])


def _floating_height(boat, orientation):
    """Return the height (B,) m of the centre of mass, to round-off."""
    count = len(orientation[0])
    # Every boat twice, carrying a little less than its weight and once more as little.
    less = boat.weight * (1.0 - LIFT_TOLERANCE * np.repeat([1.0, 2.0], count))
    system, part = System.of(boat, FLEET), np.linspace(0.0, 1.0, PARTS + 1)[:, None]
    orientation = tuple(np.tile(component, 2 * len(part)) for component in orientation)
    still = np.zeros(2 * count * len(part))
    reach = np.max(np.linalg.norm(boat.probe_offsets, axis=1) + DEEP_HEIGHTS * boat.hull.height)
    low, high = np.full(2 * count, -reach), np.full(2 * count, reach)
    # Lift never grows with height: this finds the highest place that carries the weight.
    for _ in range(ROUNDS):
        height = low + part * (high - low)
        load = evaluate(system, STILL_WATER, (still, still, height.ravel()), orientation, 0.0)
        lift = (boat.hull.max_force @ load.share).reshape(height.shape)
        carried = np.clip((lift >= less).sum(axis=0), 1, PARTS)
        low, high = (np.take_along_axis(height, index[None], axis=0)[0]
                     for index in (carried - 1, carried))
    once, twice = np.split(low, 2)
    return once + (once - twice)


def _sunk_height(boat, orientation):
    """Return the height (B,) m of the centre of mass at which no probe is above its height."""
    rotation = rotation_matrix(orientation)
    above = np.stack([to_world(rotation, tuple(offset))[2] for offset in boat.probe_offsets])
    return np.min(-above - boat.hull.height[:, None], axis=0)
