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
The boat on its water for RViz: hull, probes, forces and a patch of the surface.

All in the world frame, so that no transform is needed to see them.
"""

from geometry_msgs.msg import Point
import numpy as np
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from .messages import probe_places, RELIABLE, set_pose, set_stamp, set_vector

PERIOD = 0.1  # s
DRY, WET = np.array([0.95, 0.55, 0.10]), np.array([0.10, 0.30, 0.85])
# Cells along one side of the patch of water, and its side over the length of the boat.
CELLS, SPREAD = 16, 3.0
# Length of the arrow of a probe that carries its share of the weight, over the boat's length.
ARROW = 0.25


class Markers:
    """
    The publisher of `markers`.

    Main arguments: ``node``; ``scene``, for the frame and the hull.
    """

    def __init__(self, node, scene):
        """Build the messages once."""
        self._publisher = node.create_publisher(MarkerArray, 'markers', RELIABLE)
        positions = scene.boat.hull.positions
        # The hull as drawn: a shape's own box, or the probes' with the height of one above them.
        size = scene.values.get('hull.size')
        low, high = positions.min(axis=0), positions.max(axis=0)
        if size is None:
            height = float(scene.boat.hull.height.max())
            low, high = low - 0.05 * height, high + [0.05 * height, 0.05 * height, height]
        else:
            low = np.array([-size[0] / 2, -size[1] / 2, positions[0, 2]])
            high = low + size
        self._middle, extent = tuple(((low + high) / 2).tolist()), high - low
        self._length = float(np.linalg.norm(extent[:2])) or 1.0
        grid = np.linspace(-0.5, 0.5, CELLS + 1) * SPREAD * self._length
        self._cell = grid[1] - grid[0]
        self._grid = np.stack(np.meshgrid(grid, grid, indexing='ij'), axis=-1)
        self._corners = _triangles(CELLS)

        frame = scene.world_frame
        self._hull = _marker(frame, 'hull', 0, Marker.CUBE, extent, (0.85, 0.85, 0.8, 0.6))
        self._probes = _marker(frame, 'probes', 0, Marker.SPHERE_LIST,
                               np.full(3, 0.04 * self._length), (1.0, 1.0, 1.0, 1.0))
        self._probes.points = [Point() for _ in positions]
        self._probes.colors = [ColorRGBA(a=1.0) for _ in positions]
        self._arrows = [
            _marker(frame, 'forces', i, Marker.ARROW,
                    np.array([0.015, 0.03, 0.03]) * self._length, (0.8, 0.1, 0.1, 0.9))
            for i in range(len(positions))]
        for arrow in self._arrows:
            arrow.points = [Point(), Point()]
        self._water = _marker(frame, 'water', 0, Marker.TRIANGLE_LIST, np.ones(3),
                              (0.15, 0.45, 0.75, 0.5))
        self._water.points = [Point() for _ in self._corners]
        self._message = MarkerArray(
            markers=[self._hull, self._probes, *self._arrows, self._water])

    @property
    def wanted(self):
        """Return True when somebody listens."""
        return self._publisher.get_subscription_count() > 0

    def publish(self, frame):
        """Send the boat and its water as in a `Frame`."""
        for marker in self._message.markers:
            set_stamp(marker.header.stamp, frame.stamp)
        places, forces = probe_places(frame), frame.simulation.probe_forces
        set_pose(self._hull.pose, frame)
        set_vector(self._hull.pose.position, frame.to_world(self._middle))
        self._fill_probes(places, forces / frame.simulation.boat.hull.max_force.clip(1e-300))
        scale = ARROW * self._length * len(places) / frame.simulation.boat.weight
        for arrow, place, force in zip(self._arrows, places, forces):
            _fill(arrow.points, [place, place + [0.0, 0.0, scale * force]])
        self._fill_water(frame)
        self._publisher.publish(self._message)

    def _fill_probes(self, places, shares):
        _fill(self._probes.points, places)
        for color, (r, g, b) in zip(self._probes.colors,
                                    (DRY + shares[:, None] * (WET - DRY)).tolist()):
            color.r, color.g, color.b = r, g, b

    def _fill_water(self, frame):
        # The patch goes with the boat in whole cells, so that its corners stay on the water.
        middle = np.round(np.array(frame.position[:2]) / self._cell) * self._cell
        x, y = np.moveaxis(self._grid + middle, -1, 0)
        height = frame.sea.elevation(x, y, frame.simulation.time)
        points = np.stack([x, y, height], axis=-1).reshape(-1, 3)
        _fill(self._water.points, points[self._corners])


def _marker(frame, namespace, number, kind, scale, color):
    marker = Marker(ns=namespace, id=number, type=kind, action=Marker.ADD)
    marker.header.frame_id = frame
    marker.pose.orientation.w = 1.0
    marker.scale.x, marker.scale.y, marker.scale.z = (max(float(s), 1e-3) for s in scale)
    marker.color.r, marker.color.g, marker.color.b, marker.color.a = color
    return marker


def _fill(points, places):
    for point, (x, y, z) in zip(points, np.asarray(places).tolist()):
        point.x, point.y, point.z = x, y, z


def _triangles(cells):
    """Return the corners, three to a triangle, of a square of (cells + 1)^2 points."""
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    right, up = first + cells + 1, first + 1
    return np.stack([first, right, up, right, right + 1, up], axis=1).ravel()
