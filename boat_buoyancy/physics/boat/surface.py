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

"""The surface of a hull: a closed mesh of triangles, and what follows from its form alone."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True, eq=False)
class Surface:
    """
    A closed surface of triangles in body axes.

    ``corners`` (n, 3) m; ``triangles`` (m, 3), the numbers of three corners each,
    counter-clockwise seen from outside.  Several closed shells side by side are one surface.
    """

    corners: ArrayLike
    triangles: ArrayLike

    def __post_init__(self):
        """Store read-only arrays."""
        for name, kind in (('corners', float), ('triangles', np.int64)):
            values = np.array(getattr(self, name), kind).reshape(-1, 3)
            values.setflags(write=False)
            object.__setattr__(self, name, values)

    def __getstate__(self):
        """Leave out what is derived; it is made again when it is asked for."""
        return {'corners': self.corners, 'triangles': self.triangles}

    @cached_property
    def facets(self) -> np.ndarray:
        """Return (m, 3, 3) m, the three corners of each triangle."""
        return self.corners[self.triangles]

    @cached_property
    def area_vectors(self) -> np.ndarray:
        """Return (m, 3) m^2, each triangle's area along its outward normal."""
        a, b, c = np.moveaxis(self.facets, 1, 0)
        return 0.5 * np.cross(b - a, c - a)

    @cached_property
    def area(self) -> float:
        """Return the area in m^2."""
        return float(np.linalg.norm(self.area_vectors, axis=1).sum())

    @cached_property
    def volume(self) -> float:
        """Return the volume in m^3, by the divergence theorem: sum x.A / 3."""
        return float(np.einsum('ij,ij->', self._from_middle[:, 0], self.area_vectors) / 3.0)

    @cached_property
    def center(self) -> np.ndarray:
        """Return (3,) m, the centre of the volume."""
        moment = np.einsum('i,ij->j', self._cones, self._from_middle.sum(axis=1)) / 4.0
        return self._middle + moment / self.volume

    @cached_property
    def unit_inertia(self) -> np.ndarray:
        """
        Return (3, 3) m^2, the inertia of the volume about its centre, for a mass of 1 kg.

        Of cones from a middle point to each triangle (Tonon, J. Math. Stat. 1, 2005): with corners
        a, b, c, integral(x x^T) = V / 20 (sum x_i x_i^T + s s^T), s = a + b + c.
        """
        facets = self._from_middle
        total = facets.sum(axis=1)
        second = (np.einsum('i,ikp,ikq->pq', self._cones, facets, facets)
                  + np.einsum('i,ip,iq->pq', self._cones, total, total)) / (20.0 * self.volume)
        away = self.center - self._middle
        second -= np.outer(away, away)
        second = 0.5 * (second + second.T)
        return np.trace(second) * np.eye(3) - second

    @cached_property
    def longest_edge(self) -> float:
        """Return the length in m of the longest edge."""
        return float(np.sqrt(_squared_edges(self.corners, self.triangles).max()))

    @cached_property
    def extent(self) -> np.ndarray:
        """Return (2, 3) m, the least and the greatest of all corners."""
        return np.stack([self.corners.min(axis=0), self.corners.max(axis=0)])

    def refined(self, longest: float) -> 'Surface':
        """
        Return the same surface with no edge longer than ``longest`` m.

        Every edge that is too long is cut in the middle, in both its triangles, until none is: the
        form stays what it was and the surface stays closed.
        """
        corners, triangles = self.corners, self.triangles
        while (_squared_edges(corners, triangles) > longest ** 2).any():
            corners, triangles = _halved(corners, triangles, longest)
        return self if triangles is self.triangles else Surface(corners, triangles)

    @cached_property
    def _middle(self):
        return self.extent.mean(axis=0)

    @cached_property
    def _from_middle(self):
        return self.facets - self._middle

    @cached_property
    def _cones(self):
        """Return (m,) m^3, the volume of the cone from the middle to each triangle."""
        return np.einsum('ij,ij->i', self._from_middle[:, 0], self.area_vectors) / 3.0


def box_surface(size, center=(0.0, 0.0, 0.0)):
    """
    Return the `Surface` of a box of 12 triangles with its edges along the axes.

    ``size`` (3,) and ``center`` (3,) m.
    """
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5)
                        for z in (-0.5, 0.5)])
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return Surface(corners * size + center,
                   [[face[0], face[i], face[i + 1]] for face in faces for i in (1, 2)])


def joined(surfaces):
    """Return the `Surface` of several, one beside the other."""
    firsts = np.cumsum([0, *(len(surface.corners) for surface in surfaces)])
    return Surface(np.concatenate([surface.corners for surface in surfaces]), np.concatenate(
        [surface.triangles + first for surface, first in zip(surfaces, firsts)]))


def _squared_edges(corners, triangles):
    """Return (m, 3) m^2, the squared length of each triangle's edges, each from its corner on."""
    facets = corners[triangles]
    return ((np.roll(facets, -1, axis=1) - facets) ** 2).sum(axis=2)


def _halved(corners, triangles, longest):
    """Return corners and triangles with each edge longer than ``longest`` m cut in the middle."""
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2)
    long = _squared_edges(corners, triangles) > longest ** 2
    cut, number = np.unique(np.sort(ends[long], axis=1), axis=0, return_inverse=True)
    middle = np.full(triangles.shape, -1)
    middle[long] = len(corners) + number.reshape(-1)
    corners = np.concatenate([corners, corners[cut].mean(axis=1)])
    finer = [triangles[~long.any(axis=1)]]
    for count in (1, 2, 3):
        some = long.sum(axis=1) == count
        # Turned until the first edge is cut and, of two, the last is whole.
        first = np.argmax(long[some] if count != 2 else ~np.roll(long[some], -2, axis=1), axis=1)
        turned = (first[:, None] + np.arange(3)) % 3
        (a, b, c), (ab, bc, ca) = (np.take_along_axis(values[some], turned, axis=1).T
                                   for values in (triangles, middle))
        pieces = {1: ((a, ab, c), (ab, b, c)), 2: ((ab, b, bc), (a, ab, bc), (a, bc, c)),
                  3: ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))}[count]
        finer += [np.stack(piece, axis=1) for piece in pieces]
    return corners, np.concatenate(finer)
