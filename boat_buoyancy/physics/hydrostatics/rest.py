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
Where a boat lies at rest in still water.

Computed with the forces of the simulation itself, so that it says what the simulation will do.
"""

from functools import lru_cache
import math

import numpy as np

from .stiffness import hydrostatic_stiffness, still_load
from ..boat.clipping import level_for
from ..boat.hull import LAWS
from ..boat.state import center_of_mass_state, State
from ..compiled import compile_now, compiled
from ..forces.probe_laws import wetting
from ..rotation import from_roll_pitch_yaw, product, rotation_matrix, to_roll_pitch_yaw, to_world

# Lifts that differ by less than this part of the weight are one lift: a plateau of full and dry
# probes that carries exactly the weight must not be lost to round-off.
LIFT_TOLERANCE = 1e-12
# A soft probe at this many heights is full to the last digit.
DEEP_HEIGHTS = 40.0
# From so many probes and triangles on, compiling costs less than plain Python does.
MANY_PIECES = 200
# Halvings of a bracket at most; in most cases the last digit comes sooner.
HALVINGS = 100
# A lever below this part of the boat's size is round-off and lists no boat.
NEGLIGIBLE = 1e-9
# Turns in rad towards rest: at most this much at a time, at rest when no longer than that.
LONGEST_TURN, SHORTEST_TURN = 0.2, 1e-13
MAX_TURNS = 200
# The cosine between mast and vertical below which a boat has turned over.
TURNED_OVER = 0.5


def floats(boat):
    """Return True when the buoyancy budget exceeds the weight: only then there is a draft."""
    return boat.floatiness > 1.0 + LIFT_TOLERANCE


def rest_state(boat, yaw=0.0, x=0.0, y=0.0):
    """
    Return the `State` at which a boat lies in still water, with its list and its trim.

    ``yaw`` rad and ``x``, ``y`` m, the body origin in the world; numbers.  Found from level, the
    way the boat would go: level itself where that is a balance, even one that the least push
    ends.  Level, too, where there is no draft, and where no balance is found.
    """
    roll, pitch = rest_attitude(boat) or (0.0, 0.0)
    return floating_state(boat, roll, pitch, yaw, x, y)


def rest_attitude(boat):
    """Return roll and pitch in rad at which a boat lies at rest, or None where it finds none."""
    # Damping has no part in it: worked out once for all boats that differ in nothing else.
    return _rest_attitude(boat.lying)


@lru_cache(maxsize=64)
def _rest_attitude(boat):
    if not floats(boat):
        return 0.0, 0.0
    if boat.hull.panels is not None and boat is not boat.on_surface:
        return rest_attitude(boat.on_surface)
    orientation, before, longest = (0.0, 0.0, 0.0, 1.0), np.zeros(2), LONGEST_TURN
    for turns in range(MAX_TURNS):
        state = State(np.array([0.0, 0.0, _floating_height(boat, orientation)]), orientation)
        torque = np.array(to_world(rotation_matrix(orientation),
                                   still_load(boat, state)[0].torque)[:2])
        if turns == 0 and np.hypot(*torque) <= NEGLIGIBLE * boat.weight * boat.size:
            return 0.0, 0.0
        turn = _towards_balance(boat, state, torque)
        if turn @ before < 0.0:
            # There and back again, over a kink of the righting arm.
            longest *= 0.5
        turn *= min(1.0, longest / (np.hypot(*turn) + 1e-300))
        if np.hypot(*turn) <= SHORTEST_TURN:
            roll, pitch, _ = to_roll_pitch_yaw(orientation)
            return float(roll), float(pitch)
        orientation, before = _turned(orientation, turn), turn
    return None


def turns_over(boat):
    """Return True for a boat whose mast at rest leans by more than 60 degrees."""
    return rotation_matrix(tuple(rest_state(boat).orientation))[2][2] < TURNED_OVER


def floating_state(boat, roll=0.0, pitch=0.0, yaw=0.0, x=0.0, y=0.0):
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
    heights = [solve(boat.lying, tuple(turned)) for turned in orientation.reshape(-1, 4).tolist()]
    placed = center_of_mass_state(boat, np.stack([x, y, np.zeros_like(x)], axis=-1), orientation)
    position = placed.position.copy()
    position[..., 2] = np.reshape(heights, roll.shape)
    return State(position, orientation)


def under_water(boat):
    """Return a level `State` with all of a boat far under water."""
    return State([0.0, 0.0, -_reach(boat)])


def in_air(boat):
    """Return a level `State` with all of a boat out of the water."""
    return State([0.0, 0.0, _reach(boat)])


def draft(boat, state):
    """Return the depth in m of a boat's lowest point in still water, of its surface or probes."""
    if boat.hull.surface is None:
        return float(still_load(boat, state)[1].max())
    rotation = rotation_matrix(state.orientation.tolist())
    corners = boat.hull.surface.corners - boat.center_of_mass
    return float(-(to_world(rotation, corners.T)[2].min() + state.position[2]))


def _towards_balance(boat, state, torque):
    """
    Return the turn (2,) in rad about world x and y on which the torque (2,) N m there vanishes.

    By Newton's method, free to rise and sink; with the sizes of the stiffness where it is
    negative, so that a boat always goes the way that it is pushed.
    """
    K = hydrostatic_stiffness(boat, state)
    free = K[1:, 1:] - np.outer(K[1:, 0], K[0, 1:]) / K[0, 0] if K[0, 0] > 0.0 else K[1:, 1:]
    values, vectors = np.linalg.eigh(free)
    values = np.maximum(np.abs(values), NEGLIGIBLE * boat.weight * boat.size)
    return vectors @ ((vectors.T @ torque) / values)


def _turned(orientation, turn):
    """Return an orientation turned by a vector (2,) in rad about world x and y."""
    angle = math.hypot(*turn)
    s = math.sin(0.5 * angle) / (angle + 1e-300)
    return product((float(s * turn[0]), float(s * turn[1]), 0.0, math.cos(0.5 * angle)),
                   orientation)


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
    if hull.panels is not None:
        facets = (hull.panels.facets - boat.center_of_mass) @ np.array(
            rotation_matrix(orientation)).T
        return -level_for(facets, boat.weight / hull.specific_weight)
    reach = _reach(boat)
    above, upright = _above(boat, orientation)
    few = len(above) < MANY_PIECES
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
    """Return the height in m of the centre of mass at which no part of the hull is above water."""
    if boat.hull.panels is not None:
        corners = boat.hull.panels.corners - boat.center_of_mass
        return -float(to_world(rotation_matrix(orientation), corners.T)[2].max())
    return float(np.min(-_above(boat, orientation)[0] - boat.hull.height))


def _above(boat, orientation):
    """Return how far (n,) m the probes are above the centre of mass, and body z . world z."""
    rotation = rotation_matrix(orientation)
    return to_world(rotation, tuple(boat.probe_offsets.T))[2], rotation[2][2]


def _reach(boat):
    """Return a depth in m at which every probe and panel is full to the last digit."""
    return max(boat.size, float(np.max(np.linalg.norm(boat.probe_offsets, axis=1)
                                       + DEEP_HEIGHTS * boat.hull.height)))
