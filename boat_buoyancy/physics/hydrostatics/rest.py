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
Where a boat rests in still water.

Computed with the forces of the simulation itself, so that it says what the simulation will do.
"""

from functools import lru_cache

import numpy as np

from ..boat.hull import LAWS
from ..boat.records import readable
from ..boat.state import center_of_mass_state, State
from ..compiled import compile_now, compiled
from ..forces.load import load_at
from ..forces.probe_laws import wetting
from ..rotation import from_roll_pitch_yaw, rotation_matrix, to_world
from ..sea.waves import Sea

STILL_WATER = readable(Sea().record), Sea().table.tolist()
# Lifts that differ by less than this part of the weight are one lift: a plateau of full and dry
# probes that carries exactly the weight must not be lost to round-off.
LIFT_TOLERANCE = 1e-12
# A soft probe at this many heights is full to the last digit.
DEEP_HEIGHTS = 40.0
# From so many probes on, compiling costs less than plain Python does.
MANY_PROBES = 200
# Halvings of a bracket at most; in most cases the last digit comes sooner.
HALVINGS = 100


def floats(boat):
    """Return True when the buoyancy budget exceeds the weight: only then there is a draft."""
    return boat.floatiness > 1.0 + LIFT_TOLERANCE


def rest_state(boat, roll=0.0, pitch=0.0, yaw=0.0, x=0.0, y=0.0):
    """
    Return the State of a boat without motion that carries its own weight at the attitude given.

    Main arguments: ``roll``, ``pitch`` and ``yaw`` rad, as in a parameter file.
    Other arguments: ``x`` and ``y`` m, the body origin in the world.  Arrays give many states.

    Only the height is solved for: torques need not vanish.  Where a range of heights carries the
    weight, the highest is taken.  A boat that does not float (see `floats`) is put where its
    shallowest probe is at its height under water, so that every probe is full.
    """
    roll, pitch, yaw, x, y = np.broadcast_arrays(
        *(np.asarray(value, float) for value in (roll, pitch, yaw, x, y)))
    orientation = np.stack(from_roll_pitch_yaw(roll, pitch, yaw), axis=-1)
    solve = _floating_height if floats(boat) else _sunk_height
    # Damping has no part in it: worked out once for all boats that differ in nothing else.
    heights = [solve(boat.lying, tuple(turned)) for turned in orientation.reshape(-1, 4).tolist()]
    placed = center_of_mass_state(boat, np.stack([x, y, np.zeros_like(x)], axis=-1), orientation)
    position = placed.position.copy()
    position[..., 2] = np.reshape(heights, roll.shape)
    return State(position, orientation)


def still_load(boat, state):
    """Return the `Load` on a boat at one `State` in still water, and its probes' depths (n,) m."""
    depths = [0.0] * len(boat.hull.share)
    load = load_at(*boat.plain_records, *STILL_WATER, state.position.tolist(),
                   state.orientation.tolist(), 0.0, depths)
    return load, np.array(depths)


def draft(boat, state):
    """Return the depth in m of the deepest probe of a boat in still water."""
    return float(still_load(boat, state)[1].max())


def level_torque(boat):
    """Return the torque (2,) N m about x and y that turns a boat away from level at rest."""
    return np.array(still_load(boat, rest_state(boat))[0].torque[:2])


@compiled
def highest_carrying(law, max_force, heights, above, upright, weight, reach):
    """
    Return the greatest height in m at which the probes carry a weight in N, by halving.

    ``max_force``, ``heights`` and ``above`` of the probes, the last in m over the centre of mass
    in the world; ``upright`` as in `probe_laws`.  Lift never grows with height.
    """
    low, high = -reach, reach
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        lift = 0.0
        for i in range(len(max_force)):
            lift += max_force[i] * wetting(law, heights[i], -(middle + above[i]), upright)[1]
        if lift >= weight:
            low = middle
        else:
            high = middle
    return low


@lru_cache(maxsize=256)
def _floating_height(boat, orientation):
    """Return the height in m of the centre of mass, to round-off."""
    hull = boat.hull
    reach = float(np.max(np.linalg.norm(boat.probe_offsets, axis=1)
                         + DEEP_HEIGHTS * hull.height))
    above, upright = _above(boat, orientation)
    few = len(above) < MANY_PROBES
    law = LAWS.index(hull.law)
    probes = [values.tolist() if few else np.array(values)
              for values in (hull.max_force, hull.height, above)]
    solve = highest_carrying if few else compile_now(
        highest_carrying, law, *probes, upright, boat.weight, reach)
    # Carrying a little less than the weight, and once more as little.
    once, twice = (solve(law, *probes, upright,
                         boat.weight * (1.0 - part * LIFT_TOLERANCE), reach) for part in (1, 2))
    return once + (once - twice)


def _sunk_height(boat, orientation):
    """Return the height in m of the centre of mass at which no probe is above its height."""
    return float(np.min(-_above(boat, orientation)[0] - boat.hull.height))


def _above(boat, orientation):
    """Return how far (n,) m the probes are above the centre of mass, and body z . world z."""
    rotation = rotation_matrix(orientation)
    return to_world(rotation, tuple(boat.probe_offsets.T))[2], rotation[2][2]
