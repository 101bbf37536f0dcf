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
The part of a closed surface under water, exactly: its volume, its centre and its waterplane.

Surfaces are triangles (n, 3, 3) m, counter-clockwise seen from outside; the water is at z = 0.  A
flat face in the plane of the water counts as wet.
"""

import numpy as np


def submerged(triangles):
    """
    Return the volume in m^3 and its first moment (3,) m^4 of a body below z = 0.

    ``triangles`` (n, 3, 3) m.  The centre of buoyancy is moment / volume.

    The divergence theorem with fields that vanish at z = 0, where the cut face would be: the
    volume is the surface integral of z n_z, the moments those of x z n_z, y z n_z, z^2/2 n_z.
    """
    corners = wet_part(np.asarray(triangles, float))
    area, total = signed_areas(corners), corners[:, :, 2].sum(axis=1)
    moment = [(area * (c.sum(axis=1) * total + (c * corners[:, :, 2]).sum(axis=1))).sum() / 12.0
              for c in np.moveaxis(corners, 2, 0)]
    return float((area * total).sum()) / 3.0, np.array(moment) * [1.0, 1.0, 0.5]


def waterplane(triangles):
    """
    Return the area m^2, first moment (2,) m^3 and second moment (2, 2) m^4 of a body's waterplane.

    ``triangles`` (n, 3, 3) m.  The moments are integrals of x, y and of x x, x y, y y over the cut
    at z = 0, about the origin: it has the outline of the wet part seen from above, so they are
    those of the wet triangles' shadows, each with the sign of its downward side.
    """
    return plane_moments(wet_part(np.asarray(triangles, float))[:, ::-1, :2])


def plane_moments(triangles):
    """
    Return the area m^2, first moment (2,) m^3 and second moment (2, 2) m^4 of plane triangles.

    ``triangles`` (n, 3, 2) m; clockwise ones count as holes.
    """
    area, total = signed_areas(triangles), triangles.sum(axis=1)
    second = (np.einsum('i,ikp,ikq->pq', area, triangles, triangles)
              + np.einsum('i,ip,iq->pq', area, total, total)) / 12.0
    return float(area.sum()), area @ total / 3.0, second


def level_for(triangles, volume):
    """
    Return the height in m of the water at which a body displaces ``volume`` m^3.

    ``triangles`` (n, 3, 3) m in a frame whose z points up.  The lowest corner where the volume is
    not above 0, the highest where it is all of the body's or more.

    Newton's method on dV/dz = area of the waterplane, kept between two bounds that are halved
    where it would not converge: at flat faces the area jumps.
    """
    triangles = np.asarray(triangles, float)
    low, high = float(triangles[:, :, 2].min()), float(triangles[:, :, 2].max())
    if volume <= 0.0:
        return low
    if volume >= _displaced(triangles, high)[0]:
        return high
    finest = 4.0 * np.finfo(float).eps * max(abs(low), abs(high))
    level, step = 0.5 * (low + high), np.inf
    while True:
        wet, area = _displaced(triangles, level)
        low, high = (low, level) if wet > volume else (level, high)
        newton = (volume - wet) / area if area > 0.0 else np.inf
        if abs(newton) <= 0.5 * abs(step) and low <= level + newton <= high:
            step = newton
        else:
            step = 0.5 * (low + high) - level
        level += step
        if abs(step) <= finest:
            return level


def wet_part(triangles):
    """Return the parts (m, 3, 3) of triangles (n, 3, 3) below z = 0, as triangles again."""
    wet = triangles[:, :, 2] <= 0.0
    count = wet.sum(axis=1)
    one, two = count == 1, count == 2
    apex, second, third = _turned(triangles[one], np.argmax(wet[one], axis=1))
    small = np.stack([apex, _crossing(apex, second), _crossing(apex, third)], axis=1)
    # Two wet corners leave a quadrilateral: the dry one is cut off.
    dry, second, third = _turned(triangles[two], np.argmin(wet[two], axis=1))
    start, end = _crossing(dry, second), _crossing(dry, third)
    return np.concatenate([
        triangles[count == 3], small,
        np.stack([start, second, third], axis=1), np.stack([start, third, end], axis=1)])


def _displaced(triangles, level):
    """Return the volume in m^3 below a water at ``level`` m and the area in m^2 of its plane."""
    corners = wet_part(triangles - [0.0, 0.0, level])
    area = signed_areas(corners)
    return float((area * corners[:, :, 2].sum(axis=1)).sum()) / 3.0, -float(area.sum())


def signed_areas(triangles):
    """Return (n,) m^2, the areas of triangles (n, 3, 2 or 3) seen from above, below negative."""
    x, y = triangles[:, :, 0], triangles[:, :, 1]
    return 0.5 * ((x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0])
                  - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0]))


def _turned(triangles, first):
    """Return the three corners (n, 3) in their order, beginning with corner ``first`` (n,)."""
    rows = np.arange(len(triangles))
    return tuple(triangles[rows, (first + i) % 3] for i in range(3))


def _crossing(a, b):
    """Return where the edges a-b (n, 3) cross z = 0; one end of each is above it."""
    part = a[:, 2:] / (a[:, 2:] - b[:, 2:])
    crossing = a + part * (b - a)
    crossing[:, 2] = 0.0
    return crossing
