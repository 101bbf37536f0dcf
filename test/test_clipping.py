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

"""What of a surface is under water, against closed forms and a second, independent way."""

from boat_buoyancy.physics.boat.clipping import level_for, submerged, waterplane
from boat_buoyancy.physics.boat.surface import box_surface, joined, Surface
import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

pytestmark = pytest.mark.plain

BAR = box_surface((3.0, 1.0, 1.0)).facets


def fibonacci(count):
    """Return points (count, 3) spread evenly over the unit ball's surface."""
    index = np.arange(count) + 0.5
    z, angle = 1.0 - 2.0 * index / count, np.pi * (1.0 + np.sqrt(5.0)) * index
    radius = np.sqrt(1.0 - z * z)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=1)


def outward(triangles):
    """Return the triangles of a convex body in counter-clockwise order seen from outside."""
    middle = triangles.mean(axis=(0, 1))
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    inward = np.sum(normal * (triangles.mean(axis=1) - middle), axis=1) < 0.0
    return np.where(inward[:, None, None], triangles[:, ::-1], triangles)


def placed(triangles, turn, height):
    """Return triangles in world axes."""
    return turn.apply(triangles.reshape(-1, 3)).reshape(-1, 3, 3) + [0.0, 0.0, height]


def blob(seed):
    """Return the triangles of a random convex body about the origin."""
    points = np.random.default_rng(seed).normal(size=(40, 3)) + [0.3, -0.2, 0.1]
    return outward(points[ConvexHull(points).simplices])


def test_a_body_under_water_has_its_whole_volume_and_centre_and_one_above_none():
    surface = box_surface((2.0, 3.0, 4.0), (2.0, 3.5, -5.0)).facets
    volume, moment = submerged(surface)
    assert volume == pytest.approx(24.0, rel=1e-14)
    np.testing.assert_allclose(moment / volume, [2.0, 3.5, -5.0], rtol=1e-14)
    volume, moment = submerged(surface + [0.0, 0.0, 10.0])
    assert volume == 0.0 and not moment.any()


def test_a_cube_on_its_edge_sinks_a_triangular_prism():
    for part in (0.1, 0.5, 0.9):
        surface = placed(BAR, Rotation.from_euler('x', np.pi / 4), np.sqrt(0.5) * (1.0 - part))
        volume, moment = submerged(surface)
        depth = np.sqrt(0.5) * part
        assert volume == pytest.approx(3.0 * depth**2, rel=1e-13)
        np.testing.assert_allclose(moment / volume, [0.0, 0.0, -depth / 3.0], atol=1e-14)


def test_a_finely_meshed_ball_has_the_cap_of_a_ball():
    points = 2.0 * fibonacci(20000)
    surface = outward(points[ConvexHull(points).simplices])
    depth = 0.7
    volume, moment = submerged(surface + [0.5, -0.3, 2.0 - depth])
    assert volume == pytest.approx(np.pi * depth**2 * (6.0 - depth) / 3.0, rel=2e-3)
    centre = 2.0 - depth - 3.0 * (4.0 - depth)**2 / (4.0 * (6.0 - depth))
    np.testing.assert_allclose(moment / volume, [0.5, -0.3, centre], atol=2e-3)


def test_the_parts_below_and_above_the_water_make_up_the_whole():
    surface = blob(2)
    above = surface[:, ::-1] * [1.0, 1.0, -1.0]
    whole = ConvexHull(surface.reshape(-1, 3)).volume
    (below, low), (rest, high) = submerged(surface), submerged(above)
    assert 0.1 * whole < below < 0.9 * whole
    assert below + rest == pytest.approx(whole, rel=1e-13)
    deep, moment = submerged(surface - [0.0, 0.0, 50.0])
    assert deep == pytest.approx(whole, rel=1e-13)
    np.testing.assert_allclose(low + high * [1.0, 1.0, -1.0],
                               moment + [0.0, 0.0, 50.0 * whole], atol=1e-11 * whole)


def moments_of_outline(triangles):
    """Return the waterplane's moments of a convex body, by Green's theorem along its outline."""
    ends = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    a, b = ends[(ends[:, 0, 2] < 0.0) != (ends[:, 1, 2] < 0.0)].transpose(1, 0, 2)
    points = (a + (a[:, 2] / (a[:, 2] - b[:, 2]))[:, None] * (b - a))[:, :2]
    outline = points[ConvexHull(points).vertices]
    x, y = outline.T
    next_x, next_y = np.roll(outline, -1, axis=0).T
    cross = x * next_y - next_x * y
    xy = (x * next_y + 2 * x * y + 2 * next_x * next_y + next_x * y) @ cross / 24
    return (cross.sum() / 2, [(x + next_x) @ cross / 6, (y + next_y) @ cross / 6],
            [[(x * x + x * next_x + next_x**2) @ cross / 12, xy],
             [xy, (y * y + y * next_y + next_y**2) @ cross / 12]])


@pytest.mark.parametrize('seed', range(5))
def test_a_waterplane_has_the_area_and_moments_of_its_outline(seed):
    body = blob(seed)
    for found, expected in zip(waterplane(body), moments_of_outline(body)):
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)


def test_the_waterplane_of_two_hulls_is_that_of_two_rectangles():
    # A = 2 L b; about their common centre line 2 (L b^3 / 12 + L b (s / 2)^2).
    twin = joined([box_surface((4.0, 0.5, 1.0), (1.0, y, 0.0)) for y in (-0.8, 0.8)]).facets
    area, first, second = waterplane(twin)
    assert area == pytest.approx(4.0, rel=1e-14)
    np.testing.assert_allclose(first, [4.0, 0.0], atol=1e-14)
    np.testing.assert_allclose(second, np.diag([
        4.0 * (16.0 / 12.0 + 1.0), 2.0 * (4.0 * 0.125 / 12.0 + 2.0 * 0.64)]), atol=1e-13)


def test_a_hole_through_a_hull_is_no_part_of_its_waterplane():
    inner = box_surface((2.0, 1.0, 1.0))
    hollow = joined([box_surface((4.0, 2.0, 3.0)),
                     Surface(inner.corners, inner.triangles[:, ::-1])]).facets
    area, _, second = waterplane(hollow)
    assert area == pytest.approx(8.0 - 2.0, rel=1e-14)
    np.testing.assert_allclose(second, np.diag([8.0 * 16.0 - 2.0 * 4.0, 8.0 * 4.0 - 2.0]) / 12.0,
                               atol=1e-13)


def test_the_volume_grows_with_the_level_by_the_area_of_the_waterplane():
    body, step = blob(7), 1e-5
    up, down = (submerged(body - [0.0, 0.0, z])[0] for z in (step, -step))
    # Cubic between corners: the central difference errs by step^2.
    assert (up - down) / (2 * step) == pytest.approx(waterplane(body)[0], rel=1e-8)


@pytest.mark.parametrize('part', [1e-9, 0.01, 0.3, 0.5, 0.9, 1 - 1e-9])
@pytest.mark.parametrize('seed', range(5))
def test_a_body_displaces_the_volume_at_the_level_for_it(seed, part):
    body = blob(seed) + [3.0, -2.0, 50.0]
    whole = submerged(body - [0.0, 0.0, 100.0])[0]
    level = level_for(body, part * whole)
    assert submerged(body - [0.0, 0.0, level])[0] == pytest.approx(part * whole, abs=1e-13 * whole)
    other = brentq(lambda z: submerged(body - [0.0, 0.0, z])[0] - part * whole, 40.0, 60.0,
                   xtol=1e-13)
    # How far a level may move within the volume's round-off.
    area = waterplane(body - [0.0, 0.0, level])[0]
    assert abs(level - other) < 1e-12 + 1e-13 * whole / area


def test_the_level_of_a_cube_on_its_edge_is_that_of_a_triangle():
    bar = placed(BAR, Rotation.from_euler('x', np.pi / 4), 0.0)
    for depth in (1e-6, 0.1, 0.7):
        assert level_for(bar, 3.0 * depth**2) == pytest.approx(depth - np.sqrt(0.5), abs=1e-14)


def test_flat_faces_where_the_area_jumps_do_not_lose_the_level():
    # Steps of 1, 100 and 0.01 m^2, a gap of a metre, and 1 m^2; levels from adding up prisms.
    areas, bottoms = (1.0, 100.0, 0.01, 1.0), (0.0, 1.0, 1.1, 3.1)
    tops = (1.0, 1.1, 2.1, 4.0)
    tower = joined([box_surface((1.0, area, top - low), (0.0, 0.0, (low + top) / 2))
                    for area, low, top in zip(areas, bottoms, tops)]).facets
    below = 0.0
    for area, low, top in zip(areas, bottoms, tops):
        for part in (1e-12, 1e-3, 0.5, 1 - 1e-12):
            volume = below + part * area * (top - low)
            level = level_for(tower, volume)
            assert level == pytest.approx(low + part * (top - low), abs=1e-13 + 1e-14 / area)
        below += area * (top - low)


def test_no_volume_is_below_the_lowest_corner_and_too_much_below_the_highest():
    assert level_for(BAR, 0.0) == level_for(BAR, -1.0) == -0.5
    assert level_for(BAR, 3.0) == level_for(BAR, 100.0) == 0.5
