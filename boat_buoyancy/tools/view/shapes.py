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

"""What is drawn of a boat and its water, as points, without a page."""

import math

import numpy as np

from ..hull_outline import hull_corners

# Cells along one side of the water shown, its side over the length of the boat, and the cells
# between two of the lines that are drawn on it.
CELLS, SPREAD, LINED = 40, 7.0, 5
# Length of the arrow of a probe that carries its share of the weight, over the boat's length, and
# of a push as large as the weight.
LIFT_ARROW, PUSH_ARROW = 0.35, 1.5
# Of a probe that is dry, half and all under water: told apart by colour-blind eyes, too.
WETNESS = np.array([(253, 231, 37), (33, 160, 130), (40, 30, 140)])
# A box: its corners by the signs of x, y, z, and its faces, outwards.
SIGNS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)])
FACES = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7),
                  (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)])


def hull_mesh(boat):
    """Return corners (n, 3) m in the body frame and triangles (m, 3) of a boat's hull."""
    surface = boat.hull.surface
    if surface is not None:
        return surface.corners, surface.triangles
    low, high = _extent(boat)
    return low + SIGNS * (high - low), FACES


def length_of(boat):
    """Return the length in m that everything is drawn in proportion to."""
    low, high = _extent(boat)
    return float(np.linalg.norm((high - low)[:2]))


def _extent(boat):
    corners = hull_corners(boat) if boat.hull.surface is None else boat.hull.surface.corners
    return corners.min(axis=0), corners.max(axis=0)


class WaterPatch:
    """
    The water around a boat: a square of `CELLS` by `CELLS` that goes with it.

    Main arguments: ``length`` m of the boat.  Public: ``cell``, the side of a cell in m, 1, 2 or 5
    times a power of ten; ``flat`` (n, 3) m, the points in calm water from the middle;
    ``triangles`` (m, 3), counter-clockwise seen from above.
    """

    def __init__(self, length):
        """Lay the points out."""
        self.cell = rounded_up(SPREAD * length / CELLS)
        grid = (np.arange(CELLS + 1) - CELLS // 2) * self.cell
        self._x, self._y = (part.ravel() for part in np.meshgrid(grid, grid, indexing='ij'))
        self.flat = np.stack([self._x, self._y, np.zeros_like(self._x)], axis=-1)
        self._numbers = np.arange((CELLS + 1) ** 2).reshape(CELLS + 1, CELLS + 1)
        first = self._numbers[:-1, :-1].ravel()
        right, up = first + CELLS + 1, first + 1
        self.triangles = np.concatenate([np.stack([first, right, up], axis=1),
                                         np.stack([right, right + 1, up], axis=1)])

    def around(self, snapshot):
        """
        Return the middle (3,) m in the world, and from there points (n, 3) m and lines (k, 2, 3).

        The lines lie on the water, along x and y, at multiples of `LINED` cells.
        """
        # In whole cells, so that the points stay where they are on the water.
        cells = np.round(snapshot.position[:2] / self.cell)
        x, y = cells * self.cell
        height = snapshot.water.elevation(self._x + x, self._y + y, snapshot.time)
        points = np.stack([self._x, self._y, height], axis=-1)
        lines = []
        for numbers, place in ((self._numbers, cells[0]), (self._numbers.T, cells[1])):
            # Those that are multiples in the world, wherever the patch is.
            lined = numbers[int((CELLS // 2 - place) % LINED)::LINED]
            lines.append(np.stack([lined[:, :-1], lined[:, 1:]], axis=-1).reshape(-1, 2))
        return np.array([x, y, 0.0]), points, points[np.concatenate(lines)]


def rounded_up(number):
    """Return the least 1, 2 or 5 times a power of ten that is no less than a number."""
    power = 10.0 ** math.floor(math.log10(number))
    return next(factor * power for factor in (1.0, 2.0, 5.0, 10.0)
                if factor * power >= number * (1.0 - 1e-9))


def lift_arrows(snapshot, length):
    """Return (n, 2, 3) m from the middle of the boat: arrows straight up in world axes."""
    tails = snapshot.boat.hull.positions @ snapshot.turn.T
    scale = LIFT_ARROW * length * len(tails) / snapshot.boat.weight
    return np.stack([tails, tails + snapshot.lift[:, None] * [0.0, 0.0, scale]], axis=1)


def push_arrows(snapshot, length):
    """Return (k, 2, 3) m in the body frame: where a push acts, and how much."""
    scale = PUSH_ARROW * length / snapshot.boat.weight
    return np.array([[place, np.add(place, np.multiply(scale, force))]
                     for place, force in snapshot.pushes]).reshape(-1, 2, 3)


def probe_colors(wetness):
    """Return (n, 3) of 0 to 255 for wetness 0 to 1, between those of `WETNESS`."""
    return np.stack([np.interp(wetness, (0.0, 0.5, 1.0), channel) for channel in WETNESS.T],
                    axis=-1).astype(np.uint8)
