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

"""The part of a closed surface under water, exactly: its volume and its centre."""

import numpy as np


def submerged(triangles):
    """
    Return the volume in m^3 and its first moment (3,) m^4 of a body below z = 0.

    ``triangles`` (n, 3, 3) m: corners of the closed surface in world axes, counter-clockwise
    seen from outside.  The centre of buoyancy is moment / volume.

    The divergence theorem with fields that vanish at z = 0, where the cut face would be: the
    volume is the surface integral of z n_z, the moments those of x z n_z, y z n_z, z^2/2 n_z.
    """
    corners = wet_part(np.asarray(triangles, float))
    x, y, z = np.moveaxis(corners, 2, 0)
    area = 0.5 * ((x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0])
                  - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0]))
    total = z.sum(axis=1)
    volume = (area * total).sum() / 3.0
    moment = [(area * (c.sum(axis=1) * total + (c * z).sum(axis=1))).sum() / 12.0
              for c in (x, y, z)]
    return float(volume), np.array(moment) * [1.0, 1.0, 0.5]


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


def box_surface(low, high):
    """Return the triangles (12, 3, 3) of a box with its edges along the axes, from two corners."""
    corners = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1])
                        for z in (low[2], high[2])], float)
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return corners[[[f[0], f[i], f[i + 1]] for f in faces for i in (1, 2)]]


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
