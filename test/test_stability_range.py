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

"""From how far a boat comes back to its rest, how far a box's arm is exact, and what is wet."""

from boat_buoyancy.physics.boat.boat import Boat
from boat_buoyancy.physics.boat.shapes import box_shaped
from boat_buoyancy.physics.boat.state import State
from boat_buoyancy.physics.hydrostatics.rest import rest_attitude, rest_state
from boat_buoyancy.physics.hydrostatics.righting_arm import (
    stability_range, surface_righting_arms, wall_sided_heel)
from boat_buoyancy.physics.hydrostatics.wetted_surface import wetted_surface
from boat_buoyancy.physics.rotation import from_roll_pitch_yaw, rotation_matrix, to_world
from boat_buoyancy.physics.sea.waves import Sea
import numpy as np
import pytest
from scipy.optimize import brentq

pytestmark = pytest.mark.plain

DENSITY, GRAVITY = 1025.0, 9.81


def box(center_of_mass, beam=2.0):
    """Return a box on panels, 4 m long and 1 m deep; its body origin is its middle."""
    hull = box_shaped((4.0, beam, 1.0), -0.5, (2, 2), specific_weight=DENSITY * GRAVITY)
    return Boat(2050.0, hull.panelled(Sea()), [1000.0, 3000.0, 3000.0],
                center_of_mass=center_of_mass)


@pytest.mark.parametrize('height, end', [
    # Turned over, a box is the same box: what rights it by an angle capsizes it from 180 less it.
    (0.0, 90.0),
    # A heavy keel brings it back from upside down.
    (-2.0, 180.0)])
def test_a_box_comes_back_from_as_far_as_its_symmetry_says(height, end):
    np.testing.assert_allclose(np.degrees(stability_range(box((0.0, 0.0, height)))), [-end, end],
                               atol=0.01)


def test_the_range_of_a_box_with_a_list_ends_where_its_surface_has_no_arm():
    listing = box((0.05, 0.08, 0.1))
    low, high = stability_range(listing)
    rest = rest_attitude(listing)[0]
    ends = [brentq(lambda heel: surface_righting_arms(listing, [heel])[0], *bracket, xtol=1e-10)
            for bracket in ((-1.7, rest - 0.3), (rest + 0.3, 1.7))]
    # Found to 1e-4 rad.
    np.testing.assert_allclose([low, high], ends, atol=1e-4)
    assert -high < low < rest < -0.05
    mirrored = stability_range(box((-0.05, -0.08, 0.1)))
    np.testing.assert_allclose(mirrored, [-high, -low], atol=1e-9)


@pytest.mark.parametrize('below, rights', [(0.083, False), (0.084, True), (0.0, False)])
def test_a_box_that_is_unstable_upright_comes_back_from_nowhere(below, rights):
    # GM = KB + BM - KG = 1/4 + 1/6 - 1/2 + below; the first lolls to 3.6 degrees, where
    # GM + BM / 2 tan^2 = 0, and has righting arms from there on.
    narrow = box((0.0, 0.0, -below), beam=1.0)
    assert (stability_range(narrow)[1] > 0.0) == rights
    assert rights or stability_range(narrow) == (0.0, 0.0)


@pytest.mark.parametrize('trim', [0.0, 0.02, -0.05])
def test_a_trimmed_box_is_wall_sided_until_a_corner_dips_or_rises(trim):
    length, beam, depth, draft = 20.0, 6.0, 3.0, 1.3
    heel = wall_sided_heel(beam, depth, draft, length, trim)
    corners = np.array([[x, y, z - draft] for x in (-length / 2, length / 2)
                        for y in (-beam / 2, beam / 2) for z in (0.0, depth)])
    height = to_world(rotation_matrix(from_roll_pitch_yaw(heel, trim, 0.0)), corners.T)[2]
    assert np.abs(height).min() < 1e-12
    assert (height[::2] < 1e-12).all() and (height[1::2] > -1e-12).all()
    assert wall_sided_heel(beam, depth, draft, length, 0.2) == 0.0


def test_the_wetted_surface_of_a_box_is_its_bottom_and_its_sides_to_the_water():
    level = box((0.0, 0.0, 0.0))
    assert wetted_surface(level, rest_state(level)) == pytest.approx(8.0 + 12.0 * 0.25, rel=1e-12)
    # With a list and a trim its sides and ends are wet to the same mean.
    listing = box((0.05, 0.08, 0.0))
    assert np.abs(rest_attitude(listing)).min() > 0.005
    assert wetted_surface(listing, rest_state(listing)) == pytest.approx(11.0, rel=1e-12)
    assert wetted_surface(level, State([0.0, 0.0, -5.0])) == pytest.approx(28.0, rel=1e-12)
