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

"""What is drawn of a hull: its corners, their outline, and a mark on its bow."""

import numpy as np

from ..physics.boat.cuts import components


def hull_shells(boat):
    """Return the corners (n, 3) m in the body frame of each part whose outline is drawn."""
    surface = boat.hull.surface
    if surface is None:
        return [hull_corners(boat)]
    shell = components(surface.triangles)
    return [surface.corners[np.unique(surface.triangles[shell == number])]
            for number in range(shell.max() + 1)]


def hull_corners(boat):
    """
    Return points (n, 3) m in the body frame whose outline is drawn for a hull without a surface.

    The probes, columns put out to the corners of a box, and the same a probe's height further up.
    """
    bottom, height = boat.hull.positions, boat.hull.height[:, None]
    middle = bottom.mean(axis=0)
    if boat.hull.law == 'column':
        # Columns stand in the middle of what they carry: a uniform density of this radius of
        # gyration reaches sqrt(3) times as far.
        reach = np.sqrt(3.0 * boat.hull.share @ (bottom - middle)[:, :2]**2)
        signs = np.array([(1, 1), (1, -1), (-1, -1), (-1, 1)])
        bottom = np.column_stack([middle[:2] + signs * reach, np.full(4, bottom[:, 2].min())])
        height = np.full((4, 1), boat.hull.height.max())
    # Half the height of a single probe, or of probes in a row, makes a body of it.
    room = np.where(np.ptp(bottom, axis=0)[:2] < 1e-9, height.max() / 2, 0.0)
    bottom = np.concatenate([bottom + [a * room[0], b * room[1], 0.0]
                             for a in (-1, 1) for b in (-1, 1)])
    return np.concatenate([bottom, bottom + [0.0, 0.0, 1.0] * np.tile(height, (4, 1))])


def outline(points):
    """Return the convex outline of points (n, 2) in order (Andrew's monotone chain)."""
    ordered = sorted(set(map(tuple, points.tolist())))

    def chain(rest):
        line = []
        for x, y in rest:
            while len(line) > 1 and ((line[-1][0] - line[-2][0]) * (y - line[-2][1])
                                     <= (line[-1][1] - line[-2][1]) * (x - line[-2][0])):
                line.pop()
            line.append((x, y))
        return line[:-1]

    return np.array(chain(ordered) + chain(ordered[::-1]))


def bow_mark(corners):
    """Return a triangle (3, 3) m on deck in the body frame that points ahead."""
    (back, right, _), (front, left, deck) = corners.min(axis=0), corners.max(axis=0)
    middle, length, width = (left + right) / 2, 0.22 * (front - back), 0.15 * (left - right)
    tip = front - 0.03 * (front - back)
    return np.array([(tip, middle, deck), (tip - length, middle + width, deck),
                     (tip - length, middle - width, deck)])
