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

All in the world frame, so that no transform is needed to see them.  However many probes there
are, they are one marker, and their forces another: RViz and DDS choke on thousands of markers.
"""

import math

import numpy as np

from .messages import Frame, set_pose, set_stamp, set_vector

PERIOD = 0.1  # s
DRY, WET = np.array([0.95, 0.55, 0.10]), np.array([0.10, 0.30, 0.85])
# Cells along one side of the patch of water, and its side over the length of the boat.
CELLS, SPREAD = 16, 3.0
# Length of the line of a probe that carries its share of the weight, over the boat's length.
LINE = 0.25
HULL = (0.85, 0.85, 0.8, 0.6)
# The most triangles of a hull that are drawn.
MOST_TRIANGLES = 2000


class Markers:
    """
    The publisher of `markers`.

    Main arguments: ``topics`` as `NodeTopics`; ``scene``, for the frame and the hull.
    """

    def __init__(self, topics, scene):
        """Build the message once."""
        self._make, self._last = topics.make, None
        low, high = _corners(scene.boat.hull)
        size, surface = high - low, scene.boat.hull.surface
        self._length = length = float(np.linalg.norm(size[:2])) or 1.0
        grid = np.linspace(-0.5, 0.5, CELLS + 1) * SPREAD * length
        self._cell = grid[1] - grid[0]
        self._grid = np.stack(np.meshgrid(grid, grid, indexing='ij'), axis=-1)

        self._header = topics.make('std_msgs/msg/Header')
        self._header.frame_id = scene.world_frame
        # In body axes, placed as a whole; as a box where it has no surface, or too fine a one.
        if surface is None or len(surface.triangles) > MOST_TRIANGLES:
            self._hull = self._marker('hull', 'CUBE', size, HULL)
            self._middle = tuple(((low + high) / 2).tolist())
        else:
            self._hull = self._marker('hull', 'TRIANGLE_LIST', np.ones(3), HULL)
            self._hull.points, self._middle = self._points(3 * len(surface.triangles)), (0.0,) * 3
            _set_points(self._hull.points, surface.facets.reshape(-1, 3))
        probes = self._marker('probes', 'SPHERE_LIST', np.full(3, 0.04 * length))
        forces = self._marker('forces', 'LINE_LIST', (0.02 * length, 0.0, 0.0),
                              (0.8, 0.1, 0.1, 0.9))
        water = self._marker('water', 'TRIANGLE_LIST', np.ones(3), (0.15, 0.45, 0.75, 0.5))
        # A point that is the corner of several triangles, or a probe and the end of its line, is
        # one object: it is set once.
        count = len(scene.boat.hull.positions)
        self._probes, self._tips = self._points(count), self._points(count)
        self._colors = probes.colors = [topics.make('std_msgs/msg/ColorRGBA')
                                        for _ in range(count)]
        for color in self._colors:
            color.a = 1.0
        self._surface = self._points((CELLS + 1) ** 2)
        probes.points = self._probes
        forces.points = [end for line in zip(self._probes, self._tips) for end in line]
        water.points = [self._surface[i] for i in _triangles(CELLS).tolist()]
        self._message = topics.make('visualization_msgs/msg/MarkerArray')
        self._message.markers = [self._hull, probes, forces, water]
        self._publisher = topics.publisher('markers', self._message)

    def _marker(self, namespace, kind, scale, color=(1.0, 1.0, 1.0, 1.0)):
        marker = self._make('visualization_msgs/msg/Marker')
        marker.header, marker.ns = self._header, namespace
        marker.type, marker.action = getattr(marker, kind), marker.ADD
        marker.pose.orientation.w = 1.0
        set_vector(marker.scale, (max(float(s), 1e-3) for s in scale))
        marker.color.r, marker.color.g, marker.color.b, marker.color.a = color
        return marker

    def _points(self, count):
        return [self._make('geometry_msgs/msg/Point') for _ in range(count)]

    def look(self, session, now):
        """Show the state of a `Session` once a period, if somebody listens; ``now`` s."""
        # A microsecond for what is lost when ten times 0.1 is not 1.
        period = math.floor((now + 1e-6) / PERIOD)
        if period == self._last:
            return
        self._last = period
        if self._publisher.get_subscription_count():
            self._fill(Frame(session))
            self._publisher.publish(self._message)

    def _fill(self, frame):
        boat = frame.simulation.boat
        places, forces = frame.probe_places(), frame.simulation.probe_forces
        set_stamp(self._header.stamp, frame.stamp)
        set_pose(self._hull.pose, frame.to_world(self._middle), frame.orientation)
        _set_points(self._probes, places)
        scale = LINE * self._length * len(places) / boat.weight
        _set_points(self._tips, places + forces[:, None] * [0.0, 0.0, scale])
        shares = forces / boat.hull.max_force.clip(1e-300)
        for color, values in zip(self._colors, (DRY + shares[:, None] * (WET - DRY)).tolist()):
            color.r, color.g, color.b = values
        _set_points(self._surface, self._water(frame))

    def _water(self, frame):
        """Return points (n, 3) of the water around the boat."""
        # The patch goes with the boat in whole cells, so that its corners stay on the water.
        middle = np.round(np.array(frame.position[:2]) / self._cell) * self._cell
        x, y = np.moveaxis(self._grid + middle, -1, 0)
        height = frame.simulation.sea.elevation(x, y, frame.simulation.time)
        return np.stack([x, y, height], axis=-1).reshape(-1, 3)


def _corners(hull):
    """Return the lowest and highest corner (3,) of the hull as drawn, in the body frame."""
    if hull.surface is not None:
        return tuple(hull.surface.extent)
    # Without a shape the box around the probes, with the height of one above them.
    positions, height = hull.positions, float(hull.height.max())
    margin = 0.05 * height
    return (positions.min(axis=0) - margin,
            positions.max(axis=0) + [margin, margin, height])


def _set_points(points, places):
    for point, place in zip(points, places.tolist()):
        set_vector(point, place)


def _triangles(cells):
    """Return the corners, three to a triangle, of a square of (cells + 1)^2 points."""
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    right, up = first + cells + 1, first + 1
    return np.stack([first, right, up, right, right + 1, up], axis=1).ravel()
