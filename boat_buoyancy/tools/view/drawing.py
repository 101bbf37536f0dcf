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

"""A boat and its water as nodes of the page's scene."""

from collections import deque

import numpy as np

from .shapes import (hull_mesh, length_of, lift_arrows, probe_colors, push_arrows, WaterPatch)

# The track: a point so often in s, so many of them.
TRACK_PERIOD, TRACK_POINTS = 0.5, 240
# A boat that is farther from its track than so many lengths was put there.
FAR = 2.0
# Lines on the water are so far above it, over the boat's length.
ABOVE = 0.008
WATER, GRID, HULL = (40, 120, 190), (235, 245, 252), (250, 248, 240)
LIFT, PUSH, TRACK = (150, 0, 0), (0, 158, 115), (255, 255, 255)
WEIGHT_MIDDLE, LIFT_MIDDLE = (20, 20, 20), (204, 121, 167)


class Drawing:
    """
    One boat of a page, with the water around it if asked for.

    Main arguments: ``scene`` of the page; ``name`` of the boat's node, under that of the world;
    ``boat``, what is drawn.
    Other arguments: ``water``, False for boats beside the first.
    """

    def __init__(self, scene, name, boat, water=True):
        """Add the nodes."""
        self.boat, self._length = boat, length_of(boat)
        length = self._length
        self._track, self._tracked = deque(maxlen=TRACK_POINTS), -np.inf
        self._root = scene.add_frame(name, show_axes=False)
        # Turned with the boat; and what only goes with it.
        self._body = scene.add_frame(f'{name}/body', axes_length=0.6 * length,
                                     axes_radius=0.008 * length)
        self._upright = scene.add_frame(f'{name}/upright', show_axes=False)
        corners, triangles = hull_mesh(boat)
        scene.add_mesh_simple(f'{name}/body/hull', corners, triangles, color=HULL, opacity=0.3,
                              flat_shading=True, side='double')
        count = len(boat.hull.positions)
        self._probes = scene.add_point_cloud(
            f'{name}/body/probes', boat.hull.positions, np.zeros((count, 3), np.uint8),
            point_size=0.05 * length, point_shape='circle', point_shading='flat',
            precision='float32')
        self._thrusters = scene.add_point_cloud(
            f'{name}/body/thrusters', np.zeros((0, 3)), PUSH, point_size=0.04 * length,
            point_shape='diamond', point_shading='flat', precision='float32')
        self._lift = self._arrows(scene, f'{name}/upright/lift', LIFT, 0.006)
        self._push = self._arrows(scene, f'{name}/body/push', PUSH, 0.012)
        scene.add_icosphere(f'{name}/body/weight', 0.03 * length, color=WEIGHT_MIDDLE,
                            position=boat.center_of_mass)
        self._lift_middle = scene.add_icosphere(f'{name}/body/buoyancy', 0.03 * length,
                                                color=LIFT_MIDDLE)
        self._line = scene.add_line_segments(f'{name}/track', np.zeros((0, 2, 3)), TRACK,
                                             thickness=0.02 * length)
        self._patch = WaterPatch(length) if water else None
        if water:
            self._water = scene.add_mesh_simple(
                f'{name}/water', self._patch.flat, self._patch.triangles, color=WATER,
                opacity=0.75, side='double', cast_shadow=False)
            # Their height shows the waves, and their distance how large everything is.
            self._grid = scene.add_line_segments(f'{name}/grid', np.zeros((0, 2, 3)), GRID,
                                                 thickness=0.008 * length)

    def _arrows(self, scene, name, color, thickness):
        thickness *= self._length
        return scene.add_arrows(name, np.zeros((0, 2, 3)), color, shaft_radius=thickness,
                                head_radius=2.2 * thickness, head_length=5.0 * thickness)

    def show(self, snapshot):
        """Show a `Snapshot`."""
        x, y, z, w = snapshot.orientation
        self._body.position = self._upright.position = snapshot.position
        self._body.wxyz = (w, x, y, z)
        self._probes.colors = probe_colors(snapshot.wetness)
        self._lift.points = lift_arrows(snapshot, self._length)
        self._push.points = arrows = push_arrows(snapshot, self._length)
        self._thrusters.points = arrows[:, 0].astype(np.float32)
        middle = snapshot.center_of_buoyancy
        self._lift_middle.visible = middle is not None
        if middle is not None:
            self._lift_middle.position = middle
        if self._patch is not None:
            middle, self._water.vertices, self._grid.points = self._patch.around(snapshot)
            self._water.position = middle
            self._grid.position = middle + [0.0, 0.0, ABOVE * self._length]
        self._follow(snapshot)

    def _follow(self, snapshot):
        """Go on with the track, which lies on the water; after a jump begin anew."""
        place = snapshot.position[:2]
        if self._track and np.linalg.norm(place - self._track[-1]) > FAR * self._length:
            self._track.clear()
        if not self._track or not 0.0 <= snapshot.stamp - self._tracked < TRACK_PERIOD:
            self._track.append(place)
            self._tracked = snapshot.stamp
        x, y = np.array([*self._track, place]).T
        height = snapshot.water.elevation(x, y, snapshot.time) + 2.0 * ABOVE * self._length
        points = np.stack([x, y, height], axis=-1)
        self._line.points = np.stack([points[:-1], points[1:]], axis=1)

    def is_of(self, boat, water):
        """Return True where another moment of a boat, with water or without, can be shown."""
        return (boat.hull.surface is self.boat.hull.surface and water == bool(self._patch)
                and np.array_equal(boat.hull.positions, self.boat.hull.positions)
                and np.array_equal(boat.hull.height, self.boat.hull.height)
                and np.array_equal(boat.center_of_mass, self.boat.center_of_mass))

    def remove(self):
        """Take the boat away, with all that is drawn of it."""
        self._root.remove()
