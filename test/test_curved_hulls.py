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

"""The chart's hulls of known shape: clipped exactly, and on probes."""

from dataclasses import replace
import math

from boat_buoyancy.physics.boat.clipping import submerged
from boat_buoyancy.physics.boat.records import readable
from boat_buoyancy.physics.forces.load import load_at
from boat_buoyancy.physics.hydrostatics.rest import rest_state
from boat_buoyancy.physics.sea.waves import Sea
from boat_buoyancy.tools.chart import hull_accuracy
from boat_buoyancy.tools.chart.hull_shapes import BOX, nodes, SHAPES, V_HULL, WIGLEY
from boats import undamped
import numpy as np
import pytest

DENSITY, GRAVITY = 1025.0, 9.81


def metacentric_height(shape):
    """Return GM in m by the integrals of the shape's formula: KB + I/V - KG."""
    beam, draft = shape.beam, shape.draft
    center, radius = {
        'box': (draft / 2, beam**2 / (12 * draft)),
        'Wigley hull': (5 * draft / 8, 3 * beam**2 / (35 * draft)),
        'V hull': (2 * draft / 3, beam**2 / (6 * draft))}[shape.name]
    return center + radius - shape.center


@pytest.fixture(scope='module')
def exact():
    """Return draft, GM and righting arms of each shape by clipping its surface."""
    return {shape.name: hull_accuracy.hydrostatics_of_surface(shape) for shape in SHAPES}


def on_probes(shape, *case):
    volume = hull_accuracy.design_volume(shape)
    return hull_accuracy.hydrostatics_of_probes(
        hull_accuracy.probe_boat(shape, volume, *case))


@pytest.mark.parametrize('shape, block', [(BOX, 1.0), (WIGLEY, 4 / 9), (V_HULL, 1 / 2)])
def test_volume_is_that_of_the_formula(shape, block):
    volume = block * shape.length * shape.beam * shape.draft

    def error(panels):
        surface = shape.surface(2 * panels, panels) - [0.0, 0.0, shape.draft]
        return abs(submerged(surface)[0] / volume - 1.0)

    if shape is WIGLEY:
        # Flat panels on a curved hull: second order, and small enough.
        assert error(48) < 5e-4
        assert error(24) / error(48) == pytest.approx(4.0, rel=0.05)
    else:
        assert error(48) < 1e-12


@pytest.mark.parametrize('shape', SHAPES, ids=lambda shape: shape.name)
def test_surface_is_closed(shape):
    triangles = shape.surface(24, 12)
    # The vector areas of a closed surface cancel, and it has the same volume from anywhere.
    area = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    assert np.abs(area.sum(axis=0)).max() < 1e-12 * np.abs(area).sum()
    deep = submerged(triangles - [0.0, 0.0, 100.0])[0]
    aside = submerged(triangles - [37.0, -5.0, 50.0])[0]
    assert deep == pytest.approx(aside, rel=1e-10)


@pytest.mark.parametrize('shape', SHAPES, ids=lambda shape: shape.name)
def test_clipped_hull_has_the_draft_and_metacentric_height_of_the_formula(shape, exact):
    draft, height, _ = exact[shape.name]
    assert draft == pytest.approx(shape.draft, rel=1e-9)
    assert height == pytest.approx(metacentric_height(shape), rel=2e-4)


def test_clipped_box_has_the_published_righting_arms(exact):
    arms = exact['box'][2][1::2]
    np.testing.assert_allclose(arms, [0.1704, 0.3702, 0.6078, 0.6287, 0.5171], atol=5e-5)


def test_righting_arm_of_the_v_hull_is_that_of_its_cross_section(exact):
    # A prism: the same by cutting its section, a polygon, with the waterline.
    heel = hull_accuracy.HEELS[4]
    half, chine, depth, center = (V_HULL.beam / 2, V_HULL.draft, V_HULL.depth, V_HULL.center)
    section = np.array([[0.0, 0.0], [half, chine], [half, depth], [-half, depth],
                        [-half, chine]]) - [0.0, center]
    c, s = math.cos(heel), math.sin(heel)
    turned = section @ np.array([[c, s], [-s, c]])

    def wet(level):
        points = []
        for a, b in zip(turned, np.roll(turned, -1, axis=0)):
            if a[1] <= level:
                points.append(a)
            if (a[1] <= level) != (b[1] <= level):
                points.append(a + (level - a[1]) / (b[1] - a[1]) * (b - a))
        y, z = np.array(points).T
        y2, z2 = np.roll(y, -1), np.roll(z, -1)
        cross = y * z2 - y2 * z
        return cross.sum() / 2, ((y + y2) * cross).sum() / 6

    low, high = turned[:, 1].min(), turned[:, 1].max()
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if wet(middle)[0] < half * chine else (low, middle)
    area, moment = wet(low)
    assert exact['V hull'][2][4] == pytest.approx(-moment / area, rel=1e-9)


def test_columns_at_gauss_points_are_exact_for_a_box_up_to_its_deck_edge(exact):
    draft, height, arms = on_probes(BOX, 2)
    small = np.degrees(hull_accuracy.HEELS) < 26.0
    assert draft == pytest.approx(exact['box'][0], rel=1e-12)
    assert height == pytest.approx(exact['box'][1], rel=1e-8)
    np.testing.assert_allclose(arms[small], exact['box'][2][small], rtol=1e-10)


@pytest.mark.parametrize('placement, law, height', [
    ('corner', 'spring', 6.0 - 1.8), ('gauss', 'spring', 2.0 - 1.8),
    ('midpoint', 'column', 0.75 + 1.5 - 1.8)])
def test_other_probes_miss_the_metacentric_height_by_what_is_known(placement, law, height):
    # Springs act at the bottom: GM = y^2 / draft - KG, of the corners or of +-B / (2 sqrt(3)).
    # Four midpoints see +-B / 4: three quarters of BM = B^2 / (12 draft) = 2.
    assert on_probes(BOX, 2, placement, law)[1] == pytest.approx(height, rel=1e-8)
    known = {'corner': 342.0, 'gauss': -79.0, 'midpoint': -52.6}[placement]
    assert 100 * (height / 0.95 - 1) == pytest.approx(known, abs=0.5)


@pytest.mark.parametrize('shape', [WIGLEY, V_HULL], ids=lambda shape: shape.name)
def test_six_by_six_columns_give_a_curved_hull_within_a_few_percent(shape, exact):
    draft, height, arms = exact[shape.name]
    small = np.degrees(hull_accuracy.HEELS) < 26.0

    def error(count):
        found = on_probes(shape, count)[2]
        return np.sqrt(np.mean((found - arms)[small]**2)) / arms[small].max()

    found = on_probes(shape, 6)
    assert found[0] == pytest.approx(draft, rel=0.05)
    assert found[1] == pytest.approx(height, rel=0.05)
    assert error(6) < 0.05
    # And they tend to the hull itself, computed in quite another way, as fast as Gauss rules come
    # to a function with kinks: at least as 1 / n.
    assert error(12) < error(6) / 2 and error(24) < error(12) / 2


def test_columns_sink_a_v_hull_by_what_their_gauss_points_miss_of_its_keel():
    # draft sum w / 2 - T sum w |y| / 2 = T / 2, with sum w |y| in place of 1.
    places, weights = nodes(6, 'gauss')
    missed = weights @ np.abs(places) - 1.0
    assert on_probes(V_HULL, 6)[0] == pytest.approx(V_HULL.draft * (1.0 + missed / 2), rel=1e-9)


def test_fine_columns_feel_the_mean_of_a_wave_over_the_waterplane():
    # The mean of a cos(k x) over a length L is a sin(k L / 2) / (k L / 2).
    volume = hull_accuracy.design_volume(BOX)
    boat = hull_accuracy.probe_boat(BOX, volume, hull_accuracy.FINE)
    boat = replace(boat, damping=undamped())
    rest = rest_state(boat)
    for wavelength in (10.0, 20.0, 40.0):
        period = 2 * math.pi / math.sqrt(GRAVITY * 2 * math.pi / wavelength)
        sea = Sea([[0.1, period, 0.0, 0.3]])
        load = load_at(*boat.plain_records, readable(sea.record), sea.table.tolist(),
                       tuple(rest.position), tuple(rest.orientation), 0.0,
                       [0.0] * len(boat.hull.share))
        reach = math.pi / wavelength * BOX.length
        mean = 0.1 * math.cos(0.3) * math.sin(reach) / reach
        assert load.force[2] == pytest.approx(
            DENSITY * GRAVITY * BOX.length * BOX.beam * mean, rel=1e-9, abs=1e-4)


def test_places_and_weights_integrate_a_constant():
    for placement in ('gauss', 'midpoint', 'corner'):
        for count in (2, 5):
            places, weights = nodes(count, placement)
            assert weights.sum() == pytest.approx(2.0)
            assert np.abs(places).max() <= 1.0
    with pytest.raises(ValueError, match="placement: expected one of gauss.*got 'even'"):
        nodes(3, 'even')
