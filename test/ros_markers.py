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
Draw a picture of the boat from its published `markers`, and of nothing else.

    python test/ros_markers.py [--out doc/markers.png] [--scene config/barge.yaml]
"""

import argparse
import os
from pathlib import Path

os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
os.environ.setdefault('ROS_DOMAIN_ID', str(1 + os.getpid() % 101))
os.environ.setdefault('MPLBACKEND', 'Agg')

from matplotlib import pyplot  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection  # noqa: E402
import numpy as np  # noqa: E402
from ros_probe import BoatProcess, Probe, ROOT  # noqa: E402
from visualization_msgs.msg import Marker, MarkerArray  # noqa: E402

FACES = np.array([[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4],
                  [1, 3, 7, 5]])
WAVES = [0.35, 4.5, 0.4, 0.0, 0.12, 2.8, -0.6, 1.0]


def markers_of(arguments, seconds):
    """Return the markers of a boat after a while in waves."""
    with BoatProcess({'sea.waves': WAVES, 'sea.transition': 0.0, 'status_period': 0.0},
                     arguments=arguments) as boat, Probe(boat.namespace) as one:
        arrays = one.listen(MarkerArray, 'markers')
        one.until(lambda: len(arrays) > 10 * seconds, timeout=seconds + 10.0)
        return arrays[-1].markers


def rotation(q):
    """Return (3, 3) of a Quaternion message."""
    x, y, z, w = q.x, q.y, q.z, q.w
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def points_of(marker):
    """Return (n, 3) of the points of a marker."""
    return np.array([(point.x, point.y, point.z) for point in marker.points])


def color_of(color):
    """Return r, g, b, a."""
    return color.r, color.g, color.b, color.a


def draw(axes, marker, middle, reach):
    """Draw one marker as RViz would; of the water, what is within reach."""
    if marker.type == Marker.CUBE:
        corners = np.array(np.meshgrid([-0.5, 0.5], [-0.5, 0.5], [-0.5, 0.5],
                                       indexing='ij')).reshape(3, -1).T
        corners = corners * [marker.scale.x, marker.scale.y, marker.scale.z]
        place = marker.pose.position
        corners = corners @ rotation(marker.pose.orientation).T + [place.x, place.y, place.z]
        axes.add_collection3d(Poly3DCollection(
            corners[FACES], facecolors=color_of(marker.color), edgecolors='0.3', linewidths=0.8))
    elif marker.type == Marker.SPHERE_LIST:
        axes.scatter(*points_of(marker).T, s=90, c=[color_of(c) for c in marker.colors],
                     edgecolors='k', depthshade=False)
    elif marker.type == Marker.LINE_LIST:
        axes.add_collection3d(Line3DCollection(
            points_of(marker).reshape(-1, 2, 3), colors=[color_of(marker.color)],
            linewidths=3.0))
    elif marker.type == Marker.TRIANGLE_LIST:
        triangles = points_of(marker).reshape(-1, 3, 3)
        near = (np.abs(triangles[:, :, :2] - middle) <= reach).all(axis=(1, 2))
        axes.add_collection3d(Poly3DCollection(
            triangles[near], facecolors=color_of(marker.color), edgecolors='white',
            linewidths=0.3))


def main():
    """Run a boat and draw what it shows."""
    parser = argparse.ArgumentParser(description=__doc__.strip().split('\n')[0])
    parser.add_argument('--out', type=Path, default=ROOT / 'doc' / 'markers.png')
    parser.add_argument('--scene', default=str(ROOT / 'config' / 'default.yaml'))
    parser.add_argument('--seconds', type=float, default=4.0)
    given = parser.parse_args()
    markers = markers_of(['--params-file', given.scene], given.seconds)
    figure = pyplot.figure(figsize=(9, 6))
    axes = figure.add_subplot(projection='3d', computed_zorder=False)
    hull = next(marker for marker in markers if marker.ns == 'hull')
    middle = np.array([hull.pose.position.x, hull.pose.position.y])
    reach = 1.3 * max(hull.scale.x, hull.scale.y)
    for marker in sorted(markers, key=lambda one: one.ns != 'water'):
        draw(axes, marker, middle, reach)
    (left, near), (right, far) = middle - reach, middle + reach
    axes.set(xlim=(left, right), ylim=(near, far), zlim=(-0.35 * reach, 0.35 * reach),
             xlabel='x (m)', ylabel='y (m)', zlabel='z (m)')
    axes.set_box_aspect((2, 2, 0.7), zoom=1.15)
    axes.view_init(18, -62)
    figure.suptitle('The topic markers: hull, probes (orange: little lift, blue: full), lift, '
                    'water', y=0.85)
    figure.savefig(given.out, dpi=110, bbox_inches='tight')


if __name__ == '__main__':
    main()
