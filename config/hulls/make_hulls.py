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
Make the hulls beside this file: `python3 config/hulls/make_hulls.py`.

Their body origin is amidships on the keel, x ahead, y to port, z up; one unit is a metre.  They
are coarse on purpose: every triangle costs time in every step.
"""

from pathlib import Path

import numpy as np


def wigley(length=20.0, beam=4.0, draft=1.25, depth=2.5):
    """
    Return the triangles (n, 3, 3) of Wigley's mathematical hull (1942), walls above the draft.

    Half breadth = beam / 2 (1 - (2 x / length)^2) (1 - (1 - z / draft)^2).
    """
    x = 0.5 * length * np.linspace(-1.0, 0.0, 10)
    z = np.append(draft * np.linspace(0.0, 1.0, 8), depth)
    section = 1.0 - np.clip(1.0 - z / draft, 0.0, None) ** 2
    y = 0.5 * beam * np.outer(1.0 - (2.0 * x / length) ** 2, section)
    aft = symmetric_body(np.stack(np.broadcast_arrays(x[:, None], y, z), axis=-1))
    return np.concatenate([aft, aft[:, ::-1] * [-1.0, 1.0, 1.0]])


def rigid_inflatable(length=4.85, beam=1.95, tube=0.45, deadrise=24.0):
    """
    Return the triangles (n, 3, 3) of a rigid inflatable boat: V bottom, tubes, deck and transom.

    Length, beam and diameter of the tubes in m and deadrise in degrees are those of a tender that
    S. Dashew sketched ("Ultimate dinghy revisited: is a big RIB the answer?", setsail.com; 360 to
    410 kg rigged, without people).  How its bow rounds off and rises is made up here.
    """
    radius = 0.5 * tube
    x = 0.5 * length * np.append(np.linspace(-1.0, 0.0, 4)[:-1],
                                 np.sin(np.linspace(0.0, 0.5 * np.pi, 9)))
    forward = np.clip(2.0 * x / length, 0.0, 1.0)
    out = 0.5 * beam * np.sqrt(1.0 - forward ** 2.5)
    # Sections of a tube are ellipses, which get thinner towards the stem.
    wide = np.minimum(radius, 0.5 * out)
    high = np.sqrt(radius * wide)
    # From the chine, 30 degrees inboard of the lowest point, round the outside to the deck.
    turn = np.radians(np.linspace(-120.0, 180.0, 11))
    y = (out - wide)[:, None] + np.outer(wide, np.cos(turn))
    z = np.outer(high, np.sin(turn))
    # The bottom gets steeper towards the bow, and the tubes rise there.
    keel = z[:, 0] - y[:, 0] * np.tan(np.radians(deadrise * (1.0 + forward ** 2)))
    y, z = np.pad(y, ((0, 0), (1, 1))), np.column_stack([keel, z, z[:, -1]])
    z += 0.25 * forward[:, None] ** 2 - keel[0]
    return symmetric_body(np.stack(np.broadcast_arrays(x[:, None], y, z), axis=-1))


def symmetric_body(port):
    """
    Return the triangles (n, 3, 3) of a body from the port side (i, j, 3) of its sections.

    Sections from aft, their points from the keel to the deck.  The first is closed as a fan from
    its last point but one; the last is open, unless it is a point.
    """
    starboard = port * [1.0, -1.0, 1.0]
    deck = np.stack([port[:, -1], starboard[:, -1]], axis=1)
    side = np.concatenate([_panels(port), _fan(port[0])])
    # What lies in the middle plane would be a wall inside.
    side = side[(side[:, :, 1] != 0.0).any(axis=1)]
    triangles = np.concatenate([side, side[:, ::-1] * [1.0, -1.0, 1.0], _panels(deck)])
    # Where sections end in a point or on the middle line, panels have no area.
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return triangles[np.linalg.norm(normal, axis=1) > 1e-12]


def _panels(grid):
    """Return the triangles of a grid of points (i, j, 3), seen from where j runs to the left."""
    a, b, c, d = (corner.reshape(-1, 3) for corner in (
        grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]))
    return np.concatenate([np.stack([a, c, b], axis=1), np.stack([a, d, c], axis=1)])


def _fan(section):
    """Return the triangles of a section, seen from aft, from its last point but one."""
    hub = section[-2]
    points = np.concatenate([section[-1:], section[:-2]])
    return np.stack([np.broadcast_to(hub, points[1:].shape), points[1:], points[:-1]], axis=1)


def stl(triangles):
    """Return triangles (n, 3, 3) as the bytes of a binary STL file."""
    record = np.dtype([('normal', '<f4', 3), ('corners', '<f4', (3, 3)), ('more', '<u2')])
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    records = np.zeros(len(triangles), record)
    records['normal'] = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    records['corners'] = triangles
    return bytes(80) + len(triangles).to_bytes(4, 'little') + records.tobytes()


HULLS = {'wigley.stl': wigley, 'rib.stl': rigid_inflatable}

if __name__ == '__main__':
    for name, make in HULLS.items():
        Path(__file__).with_name(name).write_bytes(stl(make()))
