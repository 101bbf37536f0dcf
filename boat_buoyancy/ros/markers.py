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

from functools import partial

from geometry_msgs.msg import Point
import numpy as np
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from .messages import pose_of, probe_places, RELIABLE, set_vector, stamp_of
from .template import Template

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

        frame, count = scene.world_frame, len(positions)
        hull = _marker(frame, 'hull', 0, Marker.CUBE, extent, (0.85, 0.85, 0.8, 0.6))
        probes = _marker(frame, 'probes', 0, Marker.SPHERE_LIST,
                         np.full(3, 0.04 * self._length), (1.0, 1.0, 1.0, 1.0), count)
        probes.colors = [ColorRGBA() for _ in positions]
        arrows = [_marker(frame, 'forces', i, Marker.ARROW,
                          np.array([0.015, 0.03, 0.03]) * self._length, (0.8, 0.1, 0.1, 0.9), 2)
                  for i in range(count)]
        water = _marker(frame, 'water', 0, Marker.TRIANGLE_LIST, np.ones(3),
                        (0.15, 0.45, 0.75, 0.5), len(self._corners))
        markers = [hull, probes, *arrows, water]
        self._template = template = Template(MarkerArray(markers=markers))
        self._stamps = [stamp_of(template, marker.header.stamp) for marker in markers]
        self._write_hull = pose_of(template, hull.pose)
        self._write_probes, self._write_water, *self._write_arrows = (
            template.block((len(marker.points), 3), partial(_put_points, marker.points))
            for marker in (probes, water, *arrows))
        self._write_colors = template.block(
            (count, 4), partial(_put_colors, probes.colors), np.float32)

    @property
    def wanted(self):
        """Return True when somebody listens."""
        return self._publisher.get_subscription_count() > 0

    def publish(self, frame):
        """Send the boat and its water as in a `Frame`."""
        for write in self._stamps:
            write(*frame.stamp)
        places, forces = probe_places(frame), frame.simulation.probe_forces
        self._write_hull(*frame.to_world(self._middle), *frame.orientation)
        self._write_probes(places)
        shares = forces / frame.simulation.boat.hull.max_force.clip(1e-300)
        self._write_colors(np.column_stack([DRY + shares[:, None] * (WET - DRY),
                                            np.ones(len(shares))]))
        scale = ARROW * self._length * len(places) / frame.simulation.boat.weight
        for write, place, force in zip(self._write_arrows, places, forces):
            write([place, place + [0.0, 0.0, scale * force]])
        self._write_water(self._surface(frame)[self._corners])
        self._publisher.publish(self._template.content())

    def _surface(self, frame):
        """Return points (n, 3) of the water around the boat."""
        # The patch goes with the boat in whole cells, so that its corners stay on the water.
        middle = np.round(np.array(frame.position[:2]) / self._cell) * self._cell
        x, y = np.moveaxis(self._grid + middle, -1, 0)
        height = frame.sea.elevation(x, y, frame.simulation.time)
        return np.stack([x, y, height], axis=-1).reshape(-1, 3)


def _marker(frame, namespace, number, kind, scale, color, points=0):
    marker = Marker(ns=namespace, id=number, type=kind, action=Marker.ADD,
                    points=[Point() for _ in range(points)])
    marker.header.frame_id = frame
    marker.pose.orientation.w = 1.0
    marker.scale.x, marker.scale.y, marker.scale.z = (max(float(s), 1e-3) for s in scale)
    marker.color.r, marker.color.g, marker.color.b, marker.color.a = color
    return marker


def _put_points(points, places):
    for point, place in zip(points, places.tolist()):
        set_vector(point, place)


def _put_colors(colors, values):
    for color, (r, g, b, a) in zip(colors, values.tolist()):
        color.r, color.g, color.b, color.a = r, g, b, a


def _triangles(cells):
    """Return the corners, three to a triangle, of a square of (cells + 1)^2 points."""
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    right, up = first + cells + 1, first + 1
    return np.stack([first, right, up, right, right + 1, up], axis=1).ravel()
