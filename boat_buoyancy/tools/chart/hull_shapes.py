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

"""Hulls of a known shape: their surface, to be clipped exactly, and the probes put under them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...physics.boat.hull import Hull

PLACEMENTS = ('gauss', 'midpoint', 'corner')


@dataclass(frozen=True)
class Shape:
    """
    A hull symmetric to port and starboard, its keel on z = 0 and amidships at x = 0.

    Main arguments: ``name``; ``length``, ``beam``, ``draft`` and ``depth`` m; ``center`` m, the
    height of the centre of mass above the keel.
    Other arguments: ``waterline`` (x / half length) -> half breadth / half beam at and above the
    draft; ``section`` (z / draft, 0 to 1) -> half breadth / that of the waterline; ``bottom``,
    the inverse of ``section``: (y / half breadth) -> height / draft.
    """

    name: str
    length: float
    beam: float
    draft: float
    depth: float
    center: float
    waterline: Callable
    section: Callable
    bottom: Callable

    def half_breadth(self, x, z):
        """Return the half breadth in m at ``x`` and the height ``z`` m above the keel."""
        return (0.5 * self.beam * self.waterline(2.0 * x / self.length)
                * self.section(np.minimum(z / self.draft, 1.0)))

    def surface(self, along=96, up=48):
        """
        Return the closed surface as triangles (n, 3, 3) m, counter-clockwise from outside.

        Of ``along`` x ``up`` panels a side, the waterline among their edges.
        """
        x = 0.5 * self.length * np.linspace(-1.0, 1.0, along + 1)
        # Finer towards the keel, where a curved section turns most.
        z = np.concatenate([self.draft * np.linspace(0.0, 1.0, up + 1) ** 2,
                            np.linspace(self.draft, self.depth, 9)[1:]])
        across = np.linspace(-1.0, 1.0, 3)
        breadth = self.half_breadth(x[:, None], z[None, :])

        def points(x, share, breadth, z):
            return np.stack(np.broadcast_arrays(x, share * breadth, z), axis=-1)

        port = points(x[:, None], 1.0, breadth, z)
        starboard = points(x[:, None], -1.0, breadth, z)
        keel = points(x[:, None], across, breadth[:, :1], z[0])
        deck = points(x[:, None], across, breadth[:, -1:], z[-1])
        stern = points(x[0], across[:, None], breadth[0], z)
        bow = points(x[-1], across[:, None], breadth[-1], z)
        return np.concatenate([
            _triangles(grid, turned) for grid, turned in (
                (port, True), (starboard, False), (keel, True), (deck, False),
                (stern, True), (bow, False))])

    def hull(self, count, placement='gauss', law='column', *, specific_weight):
        """
        Return the `Hull` of ``count`` x ``count`` probes; the body origin is on the keel.

        Over the waterplane, each at its local bottom, carrying its part of the waterplane and
        reaching up to the deck.  Those of ``corner`` spread over the rectangle around the hull,
        all at the keel and with equal parts of its volume, as is usual in games.
        """
        places, weights = nodes(count, placement)
        if placement == 'corner':
            x, y = (0.5 * size * places for size in (self.length, self.beam))
            positions = np.stack([np.repeat(x, count), np.tile(y, count), np.zeros(count ** 2)],
                                 axis=1)
            _, volumes = self._columns(*nodes(64, 'gauss'))
            return Hull(positions, np.full(count ** 2, specific_weight * volumes.sum()
                                           / count ** 2), self.depth, law)
        positions, volumes = self._columns(places, weights)
        return Hull(positions, specific_weight * volumes, self.depth - positions[:, 2], law)

    def _columns(self, places, weights):
        """Return positions (n, 3) m and volumes (n,) m^3 of columns over the waterplane."""
        x = 0.5 * self.length * places
        breadth = self.half_breadth(x, self.draft)
        z = self.draft * np.tile(self.bottom(np.abs(places)), len(places))
        area = np.outer(weights * 0.5 * self.length * breadth, weights).ravel()
        positions = np.stack([np.repeat(x, len(places)), np.outer(breadth, places).ravel(), z],
                             axis=1)
        return positions, area * (self.depth - z)


def nodes(count, placement):
    """
    Return ``count`` places in -1 to 1 and their weights, which add up to 2.

    Gauss-Legendre points; the midpoints of equal intervals; or evenly spread with one on each
    end.
    """
    if placement == 'gauss':
        return np.polynomial.legendre.leggauss(count)
    if placement == 'midpoint':
        places = (2.0 * np.arange(count) + 1.0) / count - 1.0
    elif placement == 'corner':
        places = np.linspace(-1.0, 1.0, count)
    else:
        raise ValueError(f'placement: expected one of {", ".join(PLACEMENTS)}, '
                         f'got {placement!r}')
    return places, np.full(count, 2.0 / count)


def _triangles(grid, turned):
    """Return the triangles (n, 3, 3) of a grid of points (i, j, 3), without those of no area."""
    a, b, c, d = (corner.reshape(-1, 3) for corner in (
        grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]))
    triangles = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    if turned:
        triangles = triangles[:, ::-1]
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return triangles[(normal != 0.0).any(axis=1)]


def _ones(values):
    return np.ones_like(values)


BOX = Shape('box', 20.0, 6.0, 1.5, 3.0, 1.8, waterline=_ones, section=_ones,
            bottom=np.zeros_like)
# Wigley (1942), the mathematical hull of parabolic waterlines and sections; walls above.
WIGLEY = Shape('Wigley hull', 20.0, 4.0, 1.25, 2.5, 1.4,
               waterline=lambda x: 1.0 - x * x, section=lambda z: z * (2.0 - z),
               bottom=lambda y: 1.0 - np.sqrt(1.0 - y))
# A runabout of 20 degrees deadrise, chine on the waterline, walls above.
V_HULL = Shape('V hull', 8.0, 3.0, 0.55, 1.2, 0.8, waterline=_ones, section=lambda z: z,
               bottom=lambda y: y)
SHAPES = (BOX, WIGLEY, V_HULL)
