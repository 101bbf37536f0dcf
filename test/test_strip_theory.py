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

"""Added mass by strips is that of the textbook, and periods with it are those of K and M."""

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.boat.surface import box_surface, joined
from boat_buoyancy.physics.hydrostatics.moving_water import (
    critical_damping, modes_with, resting_facets)
from boat_buoyancy.physics.hydrostatics.rest import rest_attitude
from boat_buoyancy.physics.hydrostatics.strip_theory import (
    added_mass_of, first_guess, STATIONS, strips)
from boat_buoyancy.tools.chart.hull_shapes import WIGLEY
import numpy as np
import pytest

pytestmark = pytest.mark.plain

DENSITY = 1025.0
LENGTH, BEAM, DRAFT = 20.0, 6.0, 1.5
# Midpoints of N strips miss the integral of x^2 over a length by 1 / N^2.
MIDPOINTS = 2.0 / STATIONS ** 2


def box(y=0.0):
    return box_surface((LENGTH, BEAM, 3.0), (0.0, y, 0.0))


def test_added_mass_of_a_box_is_that_of_the_textbook():
    got = added_mass_of(strips(box().facets), LENGTH * BEAM * DRAFT, DENSITY)
    heave, sway = DENSITY * np.pi / 8.0 * BEAM ** 2, DENSITY * np.pi / 2.0 * DRAFT ** 2
    assert got == pytest.approx([
        2.7 * DENSITY * (LENGTH * BEAM * DRAFT) ** (5 / 3) / LENGTH ** 2, sway * LENGTH,
        heave * LENGTH, DENSITY * np.pi / 128.0 * BEAM ** 4 * LENGTH, heave * LENGTH ** 3 / 12.0,
        sway * LENGTH ** 3 / 12.0], rel=MIDPOINTS)


def test_added_mass_of_a_wigley_hull_is_that_of_its_parabola():
    # b = B (1 - u^2), u = 2 x / L: the integrals of b^2, b^4 and b^2 x^2 over the length.
    count, length, beam = 96, WIGLEY.length, WIGLEY.beam
    surface = WIGLEY.surface(count, 24)
    *_, heave, roll, pitch, _ = added_mass_of(
        strips(surface.facets - [0.0, 0.0, WIGLEY.draft]), 1.0, DENSITY)
    expected = DENSITY * np.pi * np.array([
        beam ** 2 * length / 15.0, beam ** 4 * length / 315.0,
        beam ** 2 * (length / 2.0) ** 3 * 2.0 / 105.0])
    # A polygon's beam is too small by at most B / count^2, of a mean of 2/3 B; to the fourth.
    assert [heave, roll, pitch] == pytest.approx(expected, rel=4 * 1.5 / count ** 2 + MIDPOINTS)
    assert (np.array([heave, roll, pitch]) < expected).all()


def test_hulls_side_by_side_add_what_each_has_and_heave_as_the_boat_rolls():
    arm = 5.0
    one = added_mass_of(strips(box().facets), 180.0, DENSITY)
    two = added_mass_of(strips(joined([box(arm), box(-arm)]).facets), 360.0, DENSITY)
    surge, _, heave, _, _, _ = one
    assert two == pytest.approx(
        2.0 * (one + [0.0, 0.0, 0.0, heave * arm ** 2, 0.0, surge * arm ** 2]), rel=1e-9)


def test_periods_with_added_mass_are_those_of_stiffness_over_mass():
    boat = load_scene({'hull.size': [20.0, 6.0, 3.0], 'hull.bottom': -1.5, 'boat.mass': 184500.0,
                       'boat.center_of_mass': [0.0, 0.0, 0.3]}).boat
    added = np.array([3e4, 16e4, 25e4, 38e4, 75e5, 40e5])
    # rho g L B, and rho g V GM with the metacentric heights of a box: B^2 / 12 T, L^2 / 12 T.
    weight, lever = 184500.0 * 9.81, 0.75 - 1.8
    stiffness = [1025.0 * 9.81 * 120.0, weight * (2.0 + lever), weight * (400.0 / 18.0 + lever)]
    expected = 2 * np.pi * np.sqrt((np.diag(boat.mass_matrix) + added)[2:5] / stiffness)
    ratios = np.array([0.0, 0.0, 0.17, 0.07, 0.12, 0.0])
    found = modes_with(boat, added, ratios * critical_damping(boat, added)).values()
    assert [mode.period for mode in found] == pytest.approx(expected, rel=1e-9)
    assert [mode.damping_ratio for mode in found] == pytest.approx(ratios[2:5], rel=1e-9)


def test_roll_of_a_catamaran_makes_the_waves_of_its_hulls_heave():
    # Thin hulls far apart: as one turns with roll it heaves, and little else.
    boat = load_scene({'hull.shape': 'twin', 'hull.size': [5.0, 0.1, 0.5], 'hull.spacing': 4.0,
                       'boat.mass': 100.0}).boat
    added, damping = first_guess(boat)
    assert added[3] == pytest.approx(added[2] * 2.0 ** 2, rel=(0.1 / 2.0) ** 2)
    wave = damping[3] - 0.02 * critical_damping(boat, added)[3]
    assert wave == pytest.approx(damping[2] * 2.0 ** 2, rel=1e-9)


def test_a_boat_with_a_trim_has_its_added_mass_along_its_own_axes():
    boat = load_scene({'boat.center_of_mass': [0.3, 0.0, 0.0]}).boat
    _, pitch = rest_attitude(boat)
    assert pitch > 0.05
    level = added_mass_of(strips(resting_facets(boat)), boat.mass / DENSITY, DENSITY)
    c, s = np.cos(pitch) ** 2, np.sin(pitch) ** 2
    surge, sway, heave, roll, pitching, yaw = level
    assert first_guess(boat)[0] == pytest.approx(
        [c * surge + s * heave, sway, s * surge + c * heave, c * roll + s * yaw, pitching,
         s * roll + c * yaw], rel=1e-9)
