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

"""Boats in balance, about which small motions are looked at: at rest, or drifting."""

from dataclasses import dataclass, replace
from functools import lru_cache
import math

import numpy as np

from ..boat.boat import Boat, Damping
from ..boat.state import State, to_rows
from ..hydrostatics.natural_modes import highest_damping_rate, levelled, RESTORED
from ..hydrostatics.rest import (floating_state, floats, in_air, rest_attitude, rest_state,
                                 turns_over, under_water)
from ..hydrostatics.stiffness import still_load
from ..rotation import product, rotation_matrix, to_world

# Round-off of a number near 1.
EPSILON = float(np.finfo(float).eps)
# What is taken for round-off, in terms of what is expected of it.
MARGIN = 10.0
# A lift or weight that moves nothing, and is still a number above 0.
NEXT_TO_NOTHING = 1e-30


@dataclass(frozen=True, eq=False)
class Balance:
    """
    A boat that stays where it is, about which it moves a little.

    Main arguments: ``boat`` and its ``state``; ``shallow`` m, its draft or the height of its
    lowest probe, whichever is less.
    Other arguments: ``slowest`` and ``fastest`` 1/s, of its oscillations and its damping;
    ``falling`` 1/s, how fast it falls over by itself, 0 where it does not.
    """

    boat: Boat
    state: State
    shallow: float
    slowest: float = 0.0
    fastest: float = 0.0
    falling: float = 0.0

    @property
    def reach(self):
        """Return the distance in m from the centre of mass to the farthest end of the hull."""
        return self.boat.size

    @property
    def small(self):
        """
        Return a small displacement in parts of ``shallow``.

        Its cube is the round-off of a place: that and what its square leaves out of a central
        difference are then equally small.
        """
        return (EPSILON * self.reach / self.shallow) ** (1.0 / 3.0)

    @property
    def round_off(self):
        """Return what is taken for 0 beside a largest number of 1."""
        return MARGIN * self.small ** 2

    @property
    def units(self):
        """Return what (9,) counts as one of heave, roll, pitch and velocities times a step."""
        turn = self.shallow / self.reach
        return np.array([self.shallow, turn, turn, *[self.shallow] * 3, *[turn] * 3])


@lru_cache(maxsize=64)
def at_rest(boat: Boat) -> Balance:
    """
    Return the `Balance` of a boat at rest in still water: afloat, or deep where it sinks.

    One that turns over or finds no rest is ballasted until it lies level, its centre of mass moved
    over the centre of its lift; one that sinks weighs no more than its lift.
    """
    # In still water the facets of the surface are as exact as finer panels.
    boat = boat if boat.hull.panels is None else boat.on_surface or boat
    lies = floats(boat) and rest_attitude(boat) is not None and not turns_over(boat)
    state = rest_state(boat) if lies else floating_state(boat) if floats(boat) else under_water(
        boat)
    load, depths = still_load(boat, state)
    if not lies:
        lift = boat.weight + load.force[2]
        moved = np.array([-load.torque[1], load.torque[0], 0.0]) / lift
        boat = replace(boat, gravity=lift / boat.mass, center_of_mass=boat.center_of_mass + moved)
    balance = Balance(boat, state, min(float(boat.hull.height.min()),
                                       max(map(abs, depths.tolist()))))
    mass = levelled(boat.mass_matrix_at(load.wetness), state)
    squared = np.linalg.eigvals(np.linalg.inv(mass)[RESTORED, RESTORED] @ stiffness(balance)).real
    # What is no more than that neither rights nor upsets the boat.
    nothing = balance.round_off * np.abs(squared).max()
    # An exact 0 is stepped as such, and grows by no round-off.
    lowest = squared[squared != 0.0].min(initial=math.inf)
    frequencies = np.sqrt(squared[squared > nothing])
    fastest = max(frequencies.max(initial=0.0), highest_damping_rate(boat))
    return replace(
        balance, slowest=frequencies.min(initial=fastest), fastest=fastest,
        falling=math.sqrt(nothing - lowest) if lowest <= nothing else 0.0)


def drifting(boat: Boat) -> list[Balance]:
    """Return the `Balance`s of a boat without lift and weight, in water and in air."""
    light = replace(boat, gravity=NEXT_TO_NOTHING, hull=replace(
        boat.hull, max_force=NEXT_TO_NOTHING * boat.hull.max_force, panels=None))
    rate, height = highest_damping_rate(boat), float(boat.hull.height.min())
    return [Balance(light, state, height, rate, rate)
            for state in (under_water(boat), in_air(boat))]


def stiffness(balance):
    """
    Return (3, 3), minus the change of heave force and torques about world x and y with each.

    By central differences, as `limits` looks at a step: where a probe is about to be full or dry
    between what it is on both sides.
    """
    start, columns = to_rows(balance.state), []
    for move in np.diag(balance.small * balance.units)[:3]:
        wrenches = []
        for row in (displaced(start, move), displaced(start, -move)):
            load, _ = still_load(balance.boat, State(row[:3], row[3:7]))
            R = rotation_matrix(row[3:7].tolist())
            wrenches.append([to_world(R, load.force)[2], *to_world(R, load.torque)[:2]])
        columns.append((np.array(wrenches[1]) - wrenches[0]) / (2.0 * move.sum()))
    return np.stack(columns, axis=1)


def displaced(start, move):
    """
    Return a row (13) moved away from ``start`` by heave, roll, pitch and velocities (9,).

    Turned about the level axes x and y of the world, as still water is the same all around.
    """
    row = start.copy()
    heave, roll, pitch = move[:3]
    row[2] += heave
    row[3:7] = product((0.5 * roll, 0.5 * pitch, 0.0, 1.0), tuple(start[3:7]))
    row[7:] += move[3:]
    return row


def displacement(start, row):
    """Return by what (9,) a row is away from ``start``, the inverse of `displaced`."""
    x, y, z, w = start[3:7].tolist()
    roll, pitch, *_ = product(tuple(row[3:7].tolist()), (-x, -y, -z, w))
    return np.array([row[2] - start[2], 2.0 * roll, 2.0 * pitch, *(row[7:] - start[7:])])


def without_damping(boat: Boat) -> Boat:
    """Return a boat of which nothing takes speed away."""
    keep = [1.0]
    return replace(boat, damping=Damping(keep, keep, keep, keep))
