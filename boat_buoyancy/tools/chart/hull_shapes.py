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

"""Hulls of a known shape: their surface, as fine as is wanted, and springs as in games."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...physics.boat.closed_mesh import welded
from ...physics.boat.hull import Hull
from ...physics.boat.surface import box_surface, Surface


@dataclass(frozen=True)
class Shape:
    """
    A hull symmetric to port and starboard, its keel on z = 0 and amidships at x = 0.

    Main arguments: ``name``; ``length``, ``beam``, ``draft`` and ``depth`` m; ``center`` m, the
    height of the centre of mass above the keel.
    Other arguments: ``waterline`` (x / half length) -> half breadth / half beam at and above the
    draft; ``section`` (z / draft, 0 to 1) -> half breadth / that of the waterline; ``meshes``
    (along, up) of a curved hull, as of `surface`, the finest for the hull itself.
    """

    name: str
    length: float
    beam: float
    draft: float
    depth: float
    center: float
    waterline: Callable
    section: Callable
    meshes: tuple = ((1, 1),)

    def half_breadth(self, x, z):
        """Return the half breadth in m at ``x`` and the height ``z`` m above the keel."""
        return (0.5 * self.beam * self.waterline(2.0 * x / self.length)
                * self.section(np.minimum(z / self.draft, 1.0)))

    @cached_property
    def surfaces(self):
        """Return the `Surface`s to choose from, the hull itself the last; a box has 12 panels."""
        if self.waterline is self.section:
            return (box_surface((self.length, self.beam, self.depth),
                                (0.0, 0.0, self.depth / 2.0)),)
        return tuple(self.surface(*mesh) for mesh in self.meshes)

    def surface(self, along, up):
        """
        Return the closed `Surface`, of ``along`` x ``up`` panels on each side of the wet hull.

        The waterline is among their edges; above it there are walls.
        """
        x = 0.5 * self.length * np.linspace(-1.0, 1.0, along + 1)
        # Finer towards the keel, where a curved section turns most.
        z = np.append(self.draft * np.linspace(0.0, 1.0, up + 1) ** 2, self.depth)
        across = np.array([-1.0, 1.0])
        breadth = self.half_breadth(x[:, None], z[None, :])

        def points(x, share, breadth, z):
            return np.stack(np.broadcast_arrays(x, share * breadth, z), axis=-1)

        port = points(x[:, None], 1.0, breadth, z)
        starboard = points(x[:, None], -1.0, breadth, z)
        keel = points(x[:, None], across, breadth[:, :1], z[0])
        deck = points(x[:, None], across, breadth[:, -1:], z[-1])
        stern = points(x[0], across[:, None], breadth[0], z)
        bow = points(x[-1], across[:, None], breadth[-1], z)
        triangles = np.concatenate([
            _triangles(grid, turned) for grid, turned in (
                (port, True), (starboard, False), (keel, True), (deck, False),
                (stern, True), (bow, False))])
        # Where a keel or a stem is sharp both sides have the same triangles, with nothing between.
        triangles = triangles[(triangles[:, :, 1] != 0.0).any(axis=1)]
        return Surface(*welded(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(
            -1, 3)))

    def springs(self, count, budget):
        """
        Return the `Hull` of ``count`` x ``count`` springs, as is usual in games.

        Spread over the rectangle around the hull, its corners among them, all at the keel, as high
        as the hull and with equal parts of its ``budget`` N.
        """
        places = np.linspace(-0.5, 0.5, count)
        x, y = (grid.ravel() for grid in np.meshgrid(self.length * places, self.beam * places))
        return Hull(np.stack([x, y, np.zeros_like(x)], axis=1),
                    np.full(x.size, budget / x.size), self.depth, 'spring')


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


BOX = Shape('box', 20.0, 6.0, 1.5, 3.0, 1.8, waterline=_ones, section=_ones)
# Wigley (1942), the mathematical hull of parabolic waterlines and sections; walls above.
WIGLEY = Shape('Wigley hull', 20.0, 4.0, 1.25, 2.5, 1.4,
               waterline=lambda x: 1.0 - x * x, section=lambda z: z * (2.0 - z),
               meshes=((4, 2), (6, 3), (8, 4), (12, 6), (16, 8), (24, 12), (96, 48)))
# A runabout of 20 degrees deadrise, chine on the waterline, walls above.
V_HULL = Shape('V hull', 8.0, 3.0, 0.55, 1.2, 0.8, waterline=_ones, section=lambda z: z)
SHAPES = (BOX, WIGLEY, V_HULL)
