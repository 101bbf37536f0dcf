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

"""Columns made from a surface, against the surface itself clipped exactly."""

from boat_buoyancy.physics.boat.boat import Boat
from boat_buoyancy.physics.boat.clipping import level_for, submerged, waterplane
from boat_buoyancy.physics.boat.columns import box_hull, columns_of
from boat_buoyancy.physics.boat.cuts import chords, components, cuts
from boat_buoyancy.physics.boat.hull import Hull
from boat_buoyancy.physics.boat.surface import box_surface, joined, Surface
from boat_buoyancy.physics.hydrostatics.metacentric_height import metacentric_heights
from boat_buoyancy.physics.hydrostatics.righting_arm import righting_arms
from boat_buoyancy.tools.chart.hull_shapes import V_HULL, WIGLEY
from boats import righting_arm
import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

pytestmark = pytest.mark.plain

DENSITY, GRAVITY = 1025.0, 9.81
HEELS = np.radians([5.0, 10.0, 15.0, 20.0, 25.0, 30.0])
SIZE = (20.0, 6.0, 3.0)


def welded(triangles):
    """Return the `Surface` of triangles (n, 3, 3), equal corners in one."""
    corners, numbers = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    return Surface(corners, numbers.reshape(-1, 3))


def moved(surface, turn=np.eye(3), shift=(0.0, 0.0, 0.0)):
    """Return a surface turned by (3, 3) and moved by (3,) m; a reflection keeps it outward."""
    order = -1 if np.linalg.det(turn) < 0.0 else 1
    return Surface(surface.corners @ np.transpose(turn) + shift, surface.triangles[:, ::order])


def ring():
    """Return the `Surface` of a ring of 2 m that lies flat, its tube 0.5 m thick."""
    i, j = (grid.ravel() for grid in np.meshgrid(np.arange(24), np.arange(12), indexing='ij'))
    around, along = 2.0 * np.pi * i / 24, 2.0 * np.pi * j / 12
    out = 2.0 + 0.5 * np.cos(along)
    corners = np.stack([out * np.cos(around), out * np.sin(around), 0.5 * np.sin(along)], axis=1)
    a, b, c, d = (12 * ((i + ahead) % 24) + (j + up) % 12
                  for ahead, up in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return Surface(corners, np.concatenate([np.stack(t, axis=1) for t in ((a, b, c), (a, c, d))]))


def bridge():
    """Return two hulls of 4 x 1 x 1 m, 2 m apart, with a deck of 0.5 m on top, in one shell."""
    section = [[-2, 0], [-1, 0], [-1, 1], [1, 1], [1, 0], [2, 0], [2, 1.5], [-2, 1.5]]
    corners = [[x, *place] for x in (-2.0, 2.0) for place in section]
    cap = np.array([[0, 1, 2], [0, 2, 7], [2, 3, 7], [3, 6, 7], [3, 4, 5], [3, 5, 6]])
    i, j = np.arange(8), np.roll(np.arange(8), -1)
    return Surface(corners, np.concatenate([
        cap[:, ::-1], cap + 8, np.stack([j + 8, i + 8, i], axis=1),
        np.stack([j, j + 8, i], axis=1)]))


def cavity():
    """Return a box with a smaller one cut out of its middle."""
    inner = box_surface((1.0, 0.5, 0.25))
    return joined([box_surface((2.0, 1.0, 0.5)),
                   Surface(inner.corners, inner.triangles[:, ::-1])])


def convex(points):
    """Return the `Surface` of the convex hull of points (n, 3)."""
    hull = ConvexHull(points)
    facets = points[hull.simplices]
    normal = np.cross(facets[:, 1] - facets[:, 0], facets[:, 2] - facets[:, 0])
    inward = np.sum(normal * hull.equations[:, :3], axis=1) < 0.0
    return welded(np.where(inward[:, None, None], facets[:, ::-1], facets))


BODIES = {
    'box': box_surface((2.0, 1.0, 0.5)), 'ring': ring(), 'bridge': bridge(), 'cavity': cavity(),
    'overlap': joined([box_surface((2.0, 1.0, 0.5)), box_surface((1.0, 2.0, 0.5),
                                                                 (0.0, 0.3, 0.2))]),
    'far apart': joined([box_surface((2.0, 1.0, 0.5)), box_surface((1.0, 1.0, 0.5),
                                                                   (5.0, 0.3, 9.0))]),
    'blob': convex(np.random.default_rng(0).normal(size=(30, 3))),
    'Wigley hull': WIGLEY.surface(12, 6), 'V hull': V_HULL.surface(4, 4)}


def boat_of(surface, probes, volume, center):
    """Return a `Boat` on columns of a surface, of the weight that it displaces."""
    positions, areas, heights = columns_of(surface, probes, volume)
    hull = Hull(positions, DENSITY * GRAVITY * areas * heights, heights, 'column')
    return Boat(DENSITY * volume, hull, [1.0, 1.0, 1.0], center_of_mass=(0.0, 0.0, center),
                gravity=GRAVITY)


def exact_metacentric_heights(surface, volume, center):
    """Return GM in m, transverse and longitudinal: KB + I / V - KG."""
    level = level_for(surface.facets, volume)
    wet, moment = submerged(surface.facets - [0.0, 0.0, level])
    area, first, second = waterplane(surface.facets - [0.0, 0.0, level])
    radii = (np.diag(second) - first ** 2 / area) / wet
    return radii[::-1] + level + moment[2] / wet - center


# Along, across; the error of GZ to 30 degrees, rms in % of the greatest arm, and of GM in %, of
# the recipe that leaves the depths' scatter as it is (physics.md, section 4).  To make GM exact
# may change GZ by as much.
@pytest.mark.parametrize('shape, hulls, probes, arm, height', [
    (WIGLEY, 1, (4, 4), 12.7, 1.9), (WIGLEY, 1, (8, 6), 3.2, 0.7), (WIGLEY, 1, (10, 8), 2.3, 0.3),
    (V_HULL, 1, (4, 4), 5.9, 0.0), (V_HULL, 1, (8, 6), 2.8, 0.0), (WIGLEY, 2, (4, 4), 0.5, 0.1)])
def test_columns_have_draft_and_gm_of_the_surface_and_its_righting_arms_within_what_is_known(
        shape, hulls, probes, arm, height):
    one = shape.surfaces[-1]
    surface = one if hulls == 1 else joined([moved(one, shift=(0.0, y, 0.0)) for y in (-3, 3)])
    volume = submerged(surface.facets - [0.0, 0.0, shape.draft])[0]
    boat = boat_of(surface, probes, volume, shape.center)
    assert len(boat.hull.positions) == hulls * np.prod(probes)
    # Triangles are not the same fore and aft: the boats lie 1e-5 rad from level at most.
    np.testing.assert_allclose(metacentric_heights(boat), exact_metacentric_heights(
        surface, volume, shape.center), rtol=1e-7)
    exact = [righting_arm(surface.facets, shape.center, volume, heel) for heel in HEELS]
    error = righting_arms(boat, HEELS) - exact
    assert np.sqrt(np.mean(error ** 2)) < (arm + height) / 100.0 * np.max(exact)


def test_four_columns_of_a_box_are_those_of_the_box_hull():
    hull = box_hull(SIZE, -1.2, (2, 2), specific_weight=1.0)
    positions, areas, heights = columns_of(box_surface(SIZE, (0.0, 0.0, 0.3)), (2, 2), 180.0)
    np.testing.assert_allclose(positions, hull.positions, atol=1e-12)
    np.testing.assert_allclose(areas * heights, hull.max_force, rtol=1e-12)
    np.testing.assert_allclose(heights, hull.height, rtol=1e-12)


def test_eight_columns_of_two_boxes_are_those_of_each():
    twin = joined([box_surface(SIZE, (0.0, y, 0.3)) for y in (-4.0, 4.0)])
    hull = box_hull(SIZE, -1.2, (2, 2), specific_weight=1.0)
    positions, areas, heights = columns_of(twin, (2, 2), 360.0)
    np.testing.assert_allclose(positions, np.concatenate([
        hull.positions + [0.0, y, 0.0] for y in (-4.0, 4.0)]), atol=1e-12)
    np.testing.assert_allclose(areas * heights, np.tile(hull.max_force, 2), rtol=1e-12)


@pytest.mark.parametrize('across', [2, 3])
@pytest.mark.parametrize('name', BODIES)
def test_a_mirrored_surface_has_mirrored_columns(name, across):
    for turn in (np.diag([1.0, -1.0, 1.0]), np.diag([-1.0, 1.0, 1.0])):
        surface = BODIES[name]
        one, other = (np.column_stack(columns_of(body, (3, across), 0.3 * surface.volume))
                      for body in (surface, moved(surface, turn)))
        one[:, :3] = one[:, :3] @ turn
        one, other = (rows[np.lexsort(rows.round(6).T)] for rows in (one, other))
        np.testing.assert_allclose(one, other, atol=1e-9 * np.ptp(surface.extent))


@pytest.mark.parametrize('name', BODIES)
def test_columns_of_any_body_at_any_attitude_have_its_displaced_and_its_whole_volume(name):
    random = np.random.default_rng(5)
    for _ in range(20):
        # Every third along the axes, where rays meet edges and planes meet faces.
        turn = Rotation.random(random_state=random).as_matrix() if random.integers(3) else (
            Rotation.from_euler('xyz', random.integers(4, size=3) * np.pi / 2).as_matrix().round())
        size = 10.0 ** random.uniform(-1.0, 2.0)
        surface = moved(BODIES[name], size * turn, size * random.normal(size=3))
        volume = random.choice([0.01, 0.1, 0.3, 0.5, 0.77, 0.95, 0.999]) * surface.volume
        probes = tuple(random.integers(1, 7, 2).tolist())
        positions, areas, heights = columns_of(surface, probes, volume)
        assert np.isfinite(positions).all() and (areas > 0.0).all() and (heights > 0.0).all()
        assert areas @ heights == pytest.approx(surface.volume, rel=1e-9)
        wet = np.clip(level_for(surface.facets, volume) - positions[:, 2], 0.0, heights)
        assert areas @ wet == pytest.approx(volume, rel=1e-9)


@pytest.mark.parametrize('part', [1.0, 1.7])
def test_columns_of_a_boat_that_sinks_have_its_whole_volume(part):
    surface = BODIES['ring']
    _, areas, heights = columns_of(surface, (4, 4), part * surface.volume)
    assert areas @ heights == pytest.approx(surface.volume, rel=1e-12)


def test_the_hulls_of_one_shell_are_told_apart_and_the_deck_between_has_columns_of_its_own():
    positions, areas, heights = columns_of(bridge(), (2, 2), 4.0)
    hulls = heights > 1.0
    # Each hull's four columns at its Gauss points, from its bottom up to the deck's top.
    x, y = np.meshgrid([-2 / np.sqrt(3), 2 / np.sqrt(3)], [
        side + offset for side in (-1.5, 1.5) for offset in (-0.5 / np.sqrt(3), 0.5 / np.sqrt(3))])
    expected = np.stack([x.ravel(), y.ravel(), 0.0 * x.ravel()], axis=1)
    found = positions[hulls]
    np.testing.assert_allclose(found[np.lexsort(found.round(6).T)],
                               expected[np.lexsort(expected.round(6).T)], atol=1e-12)
    np.testing.assert_allclose(heights[hulls], 1.5, rtol=1e-12)
    np.testing.assert_allclose(areas[hulls], 1.0, rtol=1e-12)
    np.testing.assert_allclose(positions[~hulls, 1:], [[0.0, 1.0]], atol=1e-12)
    assert areas[~hulls] == pytest.approx(8.0) and heights[~hulls] == pytest.approx(0.5)


def test_flare_has_columns_beside_the_waterplane():
    # A wedge of 90 degrees, 1 m high and 0.5 m in the water: as broad beside it as on it.
    wedge = Surface([[x, y, z] for x in (-2, 2) for y, z in ((0, 0), (1, 1), (-1, 1))],
                    [[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [0, 3, 5], [0, 5, 2], [1, 2, 5],
                     [1, 5, 4]])
    positions, areas, heights = columns_of(wedge, (2, 4), 1.0)
    flare = positions[:, 2] > 0.5
    np.testing.assert_allclose(np.abs(positions[flare, 1]), 0.75, rtol=1e-12)
    assert areas[~flare].sum() == pytest.approx(4.0) and areas[flare].sum() == pytest.approx(4.0)
    # From the wall at 0.75 m of half breadth up to the deck.
    np.testing.assert_allclose(heights[flare], 0.25, rtol=1e-12)


# Cuts and chords.

def test_a_line_through_corners_and_edges_is_inside_where_the_body_is():
    facets = convex(np.concatenate([np.eye(3), -np.eye(3)])).facets
    # Through both tips; along an edge of the outline; beside it.
    line, low, high = chords(cuts(facets, 0, [0.0, 0.25]), [0, 0, 1, 1], [0.0, 0.5, 0.75, 0.8])
    np.testing.assert_array_equal(line[:2], [0, 1])
    np.testing.assert_allclose(np.stack([low, high])[:, :2], [[-1.0, -0.5], [1.0, 0.5]])
    assert (high[2:] - low[2:] == 0.0).all()


def test_one_line_through_two_tubes_of_a_ring_has_two_chords():
    flat = moved(ring(), Rotation.from_euler('x', np.pi / 2).as_matrix())
    line, low, high = chords(cuts(flat.facets, 0, [0.0]), [0], [0.0])
    np.testing.assert_array_equal(line, [0, 0])
    np.testing.assert_allclose(low, [-2.5, 1.5])
    np.testing.assert_allclose(high, [-1.5, 2.5])


@pytest.mark.parametrize('axis', [0, 1, 2])
@pytest.mark.parametrize('name', ['ring', 'bridge', 'blob', 'cavity'])
def test_chords_integrate_to_the_volume(name, axis):
    surface = moved(BODIES[name], Rotation.from_euler('xyz', [0.3, 0.2, 0.1]).as_matrix())
    low, high = np.roll(surface.extent, -axis, axis=1).T[:2]
    low, high = np.array([low, high])
    count = 80
    (x, y), cell = ([a + (b - a) * (np.arange(count) + 0.5) / count for a, b in (low, high)],
                    np.prod(np.ptp([low, high], axis=1)) / count ** 2)
    plane, place = (grid.ravel() for grid in np.meshgrid(np.arange(count), y, indexing='ij'))
    _, bottom, top = chords(cuts(surface.facets, axis, x), plane, place)
    # The midpoint rule on a function with a kink or a jump along an outline.
    assert (top - bottom).sum() * cell == pytest.approx(surface.volume, rel=0.02)


def test_parts_are_found_however_long_their_chain():
    random = np.random.default_rng(1)
    chain = random.permutation(1000)
    pairs = np.concatenate([np.stack([chain[:600], np.roll(chain[:600], 1)], axis=1),
                            np.stack([chain[600:-1], chain[601:]], axis=1)])
    mixed = random.permutation(len(pairs))
    number = np.empty(len(pairs), int)
    number[mixed] = components(pairs[mixed])
    assert len(set(number[:600])) == len(set(number[600:])) == 1 and number[0] != number[-1]
