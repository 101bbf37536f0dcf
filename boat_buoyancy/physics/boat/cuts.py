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
Plane cuts through a closed surface, and chords: what of a line in such a plane is inside it.

Everything is decided by which side a corner is on, a corner in the plane or on the line counting
as behind it: of a closed surface every cut is closed and every line leaves as often as it enters,
also through edges and corners.
"""

import numpy as np


def cuts(triangles, axis, places):
    """
    Return the cuts of a closed surface by planes across an axis.

    ``triangles`` (n, 3, 3) m, counter-clockwise seen from outside; ``axis`` 0, 1 or 2;
    ``places`` (p,) m along it.  Three arrays, a row for each edge of a cut: the number of its
    plane (k,), rising; its start and its end (k, 2) m, in the plane's own axes: y, z for x; z, x
    for y; x, y for z.  The inside is on its right.
    """
    ahead = triangles[None, :, :, axis] > np.asarray(places, float)[:, None, None]
    count = ahead.sum(axis=2)
    plane, number = np.nonzero((count > 0) & (count < 3))
    facets, ahead, place = triangles[number], ahead[plane, number], np.take(places, plane)
    rows = np.arange(len(facets))

    def point(crosses, turn):
        # From behind to ahead in both triangles of an edge, so that they agree to the bit.
        first = np.argmax(crosses, axis=1)
        behind, beyond = (facets[rows, (first + i) % 3] for i in turn)
        part = (place - behind[:, axis]) / (beyond[:, axis] - behind[:, axis])
        return (behind + part[:, None] * (beyond - behind))[:, [(axis + 1) % 3, (axis + 2) % 3]]

    following = np.roll(ahead, -1, axis=1)
    return plane, point(~ahead & following, (0, 1)), point(ahead & ~following, (1, 0))


def chords(cut, plane, places):
    """
    Return what is inside a cut along lines across its first axis.

    ``cut`` as from `cuts`; ``plane`` (m,) and ``places`` (m,) m, the plane of each line and where
    on its first axis.  The number of its line (c,), rising, the lower and the upper end (c,) m of
    each chord on the second axis.  Where shells overlap, so do chords.
    """
    owner, start, end = cut
    after = [ends[None, :, 0] > np.asarray(places)[:, None] for ends in (start, end)]
    line, edge = np.nonzero((owner == np.asarray(plane)[:, None]) & (after[0] != after[1]))
    a, b, place = start[edge], end[edge], np.take(places, line)
    height = a[:, 1] + (place - a[:, 0]) / (b[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1])
    order = np.lexsort([height, line])
    line, height, enters = line[order], height[order], after[0][line, edge][order]
    return line[enters], height[enters], height[~enters]


def components(groups):
    """
    Return the number (m,) of the connected part to which each group of joined nodes belongs.

    ``groups`` (m, k), the numbers of the nodes that each one joins; parts are numbered in the
    order of their lowest nodes.
    """
    root = np.arange(groups.max(initial=-1) + 1)
    while True:
        roots = root[groups]
        lower = root.copy()
        np.minimum.at(lower, roots, roots.min(axis=1, keepdims=True))
        lower = lower[lower]
        if np.array_equal(lower, root):
            return np.unique(root[groups[:, 0]], return_inverse=True)[1]
        root = lower
