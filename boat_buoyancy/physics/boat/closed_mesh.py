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

"""What makes triangles a closed, outward surface: shared corners, paired edges, nested shells."""

import numpy as np

from .cuts import chords, components, cuts

# How many places of a shell are looked at to see whether it lies inside another.
SAMPLES = 8


def welded(corners, triangles, near=0.0):
    """
    Return corners (n, 3) and triangles (m, 3) with equal corners in one, and no others than used.

    With ``near`` m, corners on the same point of a grid so fine count as equal.  Triangles of two
    equal corners and those given twice are left out.
    """
    corners = corners[triangles].reshape(-1, 3)
    _, first, number = np.unique(np.round(corners / near) if near else corners, axis=0,
                                 return_index=True, return_inverse=True)
    triangles = number.reshape(-1, 3)
    triangles = triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]
    # Those given twice begin with the same corner when each begins with its lowest.
    turn = (np.argmin(triangles, axis=1)[:, None] + np.arange(3)) % 3
    triangles = np.take_along_axis(triangles, turn, axis=1)
    _, kept = np.unique(triangles, axis=0, return_index=True)
    triangles = triangles[np.sort(kept)]
    used, triangles = np.unique(triangles, return_inverse=True)
    return corners[first[used]], triangles.reshape(-1, 3)


def edge_counts(triangles):
    """Return how many edges belong to one triangle only, and how many to more than two."""
    _, count = np.unique(_edges(triangles), return_counts=True)
    return int((count == 1).sum()), int((count > 2).sum())


def filled(triangles):
    """
    Return triangles with each hole of three or four edges closed.

    As they are where some corner has more than two open edges.
    """
    edges = _edges(triangles)
    _, first, count = np.unique(edges, return_index=True, return_counts=True)
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    beside, given = {}, set()
    for a, b in ends[first[count == 1]].tolist():
        given.add((a, b))
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    if any(len(corners) != 2 for corners in beside.values()):
        return triangles
    found = []
    while beside:
        start, (here, _) = beside.popitem()
        hole = [start]
        while here != start:
            one, other = beside.pop(here)
            hole, here = [*hole, here], other if one == hole[-1] else one
        if (hole[0], hole[1]) in given:
            # Along an edge neighbours run in opposite directions.
            hole.reverse()
        found += [[hole[0], *hole[i:i + 2]] for i in range(1, len(hole) - 1) if len(hole) < 5]
    return np.concatenate([triangles, np.reshape(found, (-1, 3)).astype(np.int64)])


def oriented(triangles):
    """
    Return triangles of a closed mesh so that neighbours agree, their shells, how many were turned.

    ``triangles`` (m, 3), every edge in two of them; their shells (m,) are numbered.  In each shell
    the fewer triangles are turned.  None where no turning helps: a surface of one side, as Klein's
    bottle.

    Every triangle stands for two nodes, as given (2 i) and turned (2 i + 1); neighbours that run
    along their edge in opposite directions agree as they are, others when one is turned.
    """
    order = np.argsort(_edges(triangles), kind='stable').reshape(-1, 2)
    forward = (triangles < np.roll(triangles, -1, axis=1)).ravel()
    (one, other), alike = order.T // 3, (forward[order[:, 0]] == forward[order[:, 1]]).astype(int)
    part = components(np.concatenate([
        np.stack([2 * one, 2 * other + alike], axis=1),
        np.stack([2 * one + 1, 2 * other + 1 - alike], axis=1)]))
    given, turned = np.empty((2, len(triangles)), int)
    given[one], turned[one] = part.reshape(2, -1)
    given[other], turned[other] = np.where(alike, part.reshape(2, -1)[::-1], part.reshape(2, -1))
    if (given == turned).any():
        return None
    _, shell = np.unique(np.minimum(given, turned), return_inverse=True)
    wrong = given > turned
    wrong ^= (np.bincount(shell, wrong) > 0.5 * np.bincount(shell))[shell]
    return np.where(wrong[:, None], triangles[:, ::-1], triangles), shell, int(wrong.sum())


def volumes_of_shells(corners, triangles, shell):
    """Return the volume (s,) m^3 of each shell, negative where it faces inward."""
    a, b, c = np.moveaxis((corners - corners.mean(axis=0))[triangles], 1, 0)
    return np.bincount(shell, np.einsum('ij,ij->i', a, np.cross(b, c))) / 6.0


def containing(corners, triangles, shell, number):
    """
    Yield the number of each shell that shell ``number`` lies in, and how much of it: 0 to 1.

    That share is of a few places on it, a hair inside its own skin, so that shells that just touch
    are not in one another.
    """
    facets = corners[triangles]
    mine = facets[shell == number][::max(1, (shell == number).sum() // SAMPLES)][:SAMPLES]
    normal = np.cross(mine[:, 1] - mine[:, 0], mine[:, 2] - mine[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), np.finfo(float).tiny)[:, None]
    places = mine.mean(axis=1) - 1e-6 * np.ptp(corners, axis=0).max() * normal
    low, high = np.full((2, shell.max() + 1, 3), [[[np.inf]], [[-np.inf]]])
    np.minimum.at(low, shell, facets.min(axis=1))
    np.maximum.at(high, shell, facets.max(axis=1))
    around = ((low <= places.max(axis=0)) & (places.min(axis=0) <= high)).all(axis=1)
    around[number] = False
    for other in np.flatnonzero(around):
        line, *ends = chords(cuts(facets[shell == other], 0, places[:, 0]),
                             np.arange(len(places)), places[:, 1])
        ends, z = np.sort(ends, axis=0), places[line, 2]
        within = np.bincount(line, (ends[0] < z) & (z < ends[1]), minlength=len(places)) > 0
        if within.any():
            yield other, float(within.mean())


def _edges(triangles):
    """Return (3 m,) one number for each edge of each triangle, the same from either side."""
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)])
    return (ends.min(axis=0) * (triangles.max(initial=0) + 1) + ends.max(axis=0)).ravel()
