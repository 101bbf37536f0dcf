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

"""Boats at rest in still water, against closed forms and a second, independent force."""

import re

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.boat.boat import Boat
from boat_buoyancy.physics.boat.columns import box_hull
from boat_buoyancy.physics.boat.hull import Hull, probe_hull
from boat_buoyancy.physics.boat.shapes import box_shaped, mesh_shaped
from boat_buoyancy.physics.boat.state import body_frame, State
from boat_buoyancy.physics.boat.surface import box_surface, joined
from boat_buoyancy.physics.hydrostatics.metacentric_height import metacentric_heights
from boat_buoyancy.physics.hydrostatics.rest import (
    draft, floating_state, floats, rest_attitude, rest_state)
from boat_buoyancy.physics.hydrostatics.righting_arm import righting_arms, wall_sided_heel
from boat_buoyancy.physics.hydrostatics.stiffness import still_load
from boat_buoyancy.physics.hydrostatics.warnings import flotation_warnings
from boat_buoyancy.physics.rotation import from_roll_pitch_yaw, rotation_matrix, to_world
from boat_buoyancy.physics.sea.waves import Sea
from boats import (asymmetric_boat, last_state, LAWS, reference_boat, righting_arm, simulate,
                   undamped)
import numpy as np
import pytest
from scipy.optimize import brentq
import textbook

pytestmark = pytest.mark.plain

FRESH, SALT, GRAVITY = 1000.0, 1025.0, 9.81
# Length, beam, depth, draft and height of the centre of mass above the bottom, m.
BARGE = 20.0, 6.0, 3.0, 1.5, 1.8
ROLL_ARM = 1.0 / np.sqrt(3.0)


def box(size, mass, *, density=FRESH, keel_to_mass=None, probes=(2, 2), law='column'):
    """Return a solid box; its body origin is its centre of mass."""
    length, beam, depth = size
    hull = box_hull(size, -(depth / 2 if keel_to_mass is None else keel_to_mass), probes,
                    specific_weight=density * GRAVITY, law=law)
    inertia = mass / 12 * np.array([beam**2 + depth**2, length**2 + depth**2,
                                    length**2 + beam**2])
    return Boat(mass, hull, inertia, undamped())


def barge(probes=(2, 2), law='column'):
    """Return the 20 m barge."""
    length, beam, depth, draft_, keel_to_mass = BARGE
    return box((length, beam, depth), SALT * length * beam * draft_, density=SALT,
               keel_to_mass=keel_to_mass, probes=probes, law=law)


def barge_of(places, law):
    """Return the barge on probes of equal weight at ``places``, rows of x and y."""
    whole = barge()
    count = len(places)
    positions = np.column_stack([places, np.full(count, -BARGE[4])])
    hull = Hull(positions, np.full(count, whole.hull.max_force.sum() / count),
                np.full(count, BARGE[2]), law)
    return Boat(whole.mass, hull, whole.inertia, undamped())


def midpoints(count):
    """Return ``count`` x ``count`` centres of equal parts of the barge's waterplane."""
    part = (2 * np.arange(count) + 1 - count) / count
    return [[x * BARGE[0] / 2, y * BARGE[1] / 2] for x in part for y in part]


def four_probes(*, weights=(1, 1, 1, 1), floatiness=1.2, stiffness=2.0, z=0.0, law='spring',
                damping=None, center_of_mass=(0.0, 0.0, 0.0)):
    """Return 1000 kg on four probes, first port then starboard, first ahead then aft."""
    positions = [[x, y, z] for x in (1.0, -1.0) for y in (ROLL_ARM, -ROLL_ARM)]
    hull = probe_hull(positions, weights, weight=1000.0 * GRAVITY, floatiness=floatiness,
                      stiffness=stiffness, law=law)
    return Boat(1000.0, hull, [500.0, 700.0, 900.0], damping or undamped(), center_of_mass)


def net_force(boat, state):
    """Return the vertical force in N on a still boat by the textbook's own sums."""
    force, _ = textbook.wrench(boat, Sea(), 0.0, state.position, state.orientation,
                               np.zeros(3), np.zeros(3))
    return force[2]


def settled(boat, state):
    """Return roll and pitch in degrees after two minutes."""
    state = last_state(boat, state, 120.0, rate=50.0)
    return np.degrees([state.roll, state.pitch])


def farthest_tilt(boat, state):
    """Return the largest angle in degrees between mast and vertical in a minute."""
    x, y, _, _ = simulate(boat, state, 60.0, rate=50.0)[1].orientation.T
    return np.degrees(np.arccos(1.0 - 2.0 * (x * x + y * y))).max()


# Where the boat rests.

@pytest.mark.parametrize('law', LAWS)
def test_a_boat_at_rest_carries_its_weight_to_round_off_at_any_attitude(law):
    random = np.random.default_rng(5)
    for floatiness in (1.05, 1.5, 4.0, 50.0):
        boat = asymmetric_boat(law, floatiness=floatiness)
        for roll, pitch, yaw in random.uniform(-np.pi, np.pi, (25, 3)):
            state = floating_state(boat, roll, pitch, yaw)
            assert abs(net_force(boat, state)) < 1e-12 * boat.weight


def test_a_spring_boat_floats_where_the_spring_carries_the_weight():
    boat = reference_boat(floatiness=3.7)
    assert draft(boat, rest_state(boat)) == pytest.approx(0.5, abs=1e-15)


def test_a_soft_boat_floats_at_the_logarithm_of_its_floatiness():
    for floatiness in (1.001, 1.2, 3.0):
        boat = reference_boat(floatiness=floatiness, law='soft')
        height = floatiness / 2.0
        assert draft(boat, rest_state(boat)) == pytest.approx(
            height * np.log(floatiness / (floatiness - 1.0)), rel=1e-12)


def test_a_heeled_boat_floats_where_a_bracketing_solver_puts_it():
    boat = asymmetric_boat('spring')
    attitude = (0.4, -0.3, 1.0)
    orientation = np.array(from_roll_pitch_yaw(*attitude))
    height = brentq(lambda z: net_force(boat, State([0.0, 0.0, z], orientation)), -5.0, 5.0,
                    xtol=1e-15, rtol=1e-14)
    assert floating_state(boat, *attitude).position[2] == pytest.approx(height, abs=1e-13)


def test_rest_is_asked_for_by_the_place_of_the_body_origin():
    boat = asymmetric_boat()
    position, orientation, velocity, spin = body_frame(
        boat, floating_state(boat, 0.3, -0.2, 0.7, x=12.0, y=-5.0))
    np.testing.assert_allclose(position[:2], [12.0, -5.0], atol=1e-14)
    np.testing.assert_allclose(orientation, from_roll_pitch_yaw(0.3, -0.2, 0.7), atol=1e-15)
    assert not velocity.any() and not spin.any()


def test_a_fleet_rests_where_its_boats_rest_one_by_one():
    boat = asymmetric_boat('column')
    angles = np.random.default_rng(1).uniform(-3.0, 3.0, (3, 4))
    fleet = floating_state(boat, *angles, x=1.0)
    for i in range(4):
        single = floating_state(boat, *angles[:, i], x=1.0)
        np.testing.assert_allclose(fleet.position[i], single.position, atol=1e-15)
        np.testing.assert_array_equal(fleet.orientation[i], single.orientation)


def test_on_a_plateau_the_highest_place_that_carries_the_weight_is_taken():
    # The lower four carry the weight when full, 0.5 m under water; the upper four are dry until
    # the boat is 2 m deeper.  Odd weights make their sum a little more or less than the weight.
    random = np.random.default_rng(8)
    positions = [[x, y, z] for z in (-1.0, 1.0) for x in (1.0, -1.0) for y in (0.5, -0.5)]
    for mass, *weights in random.uniform(0.5, 2.0, (50, 5)):
        hull = probe_hull(positions, weights * 2, weight=mass * GRAVITY, floatiness=2.0,
                          stiffness=2.0, law='spring')
        boat = Boat(mass, hull, [1.0] * 3)
        assert draft(boat, floating_state(boat)) == pytest.approx(0.5, abs=1e-12)


@pytest.mark.parametrize('law', LAWS)
def test_without_reserve_there_is_no_draft_and_every_probe_starts_full(law):
    for floatiness in (0.3, 0.999, 1.0):
        boat = four_probes(floatiness=floatiness, law=law)
        assert not floats(boat)
        _, depths = still_load(boat, rest_state(boat))
        np.testing.assert_allclose(depths, 0.5, atol=1e-15)
        _, depths = still_load(boat, floating_state(boat, roll=0.3))
        assert depths.min() == pytest.approx(0.5, abs=1e-15)


def test_a_boat_of_floatiness_just_above_1_has_its_draft_just_above_full():
    boat = four_probes(floatiness=1.0 + 1e-9)
    assert draft(boat, rest_state(boat)) == pytest.approx(0.5 / (1.0 + 1e-9), abs=1e-15)


# Boxes, by Archimedes.

def test_a_half_sunk_metre_cube_lifts_5027_625_newtons():
    cube = box((1.0, 1.0, 1.0), 1.0, density=SALT)
    load, _ = still_load(cube, State([0.0, 0.0, 0.0]))
    assert load.force[2] + cube.weight == pytest.approx(5027.625, rel=1e-14)


def test_a_half_sunk_10_by_4_by_2_box_lifts_402210_newtons():
    big = box((10.0, 4.0, 2.0), 1.0, density=SALT)
    load, _ = still_load(big, State([0.0, 0.0, 0.0]))
    assert load.force[2] + big.weight == pytest.approx(402210.0, rel=1e-14)


def test_the_small_barge_has_the_draft_and_the_metacentric_heights_of_the_formula():
    small = box((4.0, 2.0, 1.0), 2000.0)
    assert draft(small, rest_state(small)) == pytest.approx(0.25, abs=1e-15)
    # KB + BM - KG, BM = beam^2 / (12 draft) across and length^2 / (12 draft) along.
    np.testing.assert_allclose(metacentric_heights(small), [
        0.125 + 4.0 / 3.0 - 0.5, 0.125 + 16.0 / 3.0 - 0.5], rtol=1e-13)
    assert metacentric_heights(small)[0] == pytest.approx(0.9583, abs=5e-5)


def test_the_solid_cube_has_negative_metacentric_height_and_does_not_stay_upright():
    cube = box((1.0, 1.0, 1.0), 500.0)
    np.testing.assert_allclose(metacentric_heights(cube), -1.0 / 12.0, rtol=1e-12)
    assert sum('cannot float upright' in line for line in flotation_warnings(cube)) == 2
    rolled = floating_state(cube, roll=1e-3)
    assert farthest_tilt(cube, rolled) > 20.0


def test_the_20_metre_barge_has_gm_0_95():
    assert metacentric_heights(barge())[0] == pytest.approx(0.95, rel=1e-13)


def test_the_barge_rights_itself_as_the_wall_sided_formula_says_until_the_deck_dips():
    length, beam, depth, draft_, keel_to_mass = BARGE
    radius = beam**2 / (12.0 * draft_)
    height = draft_ / 2 + radius - keel_to_mass
    edge = wall_sided_heel(beam, depth, draft_)
    assert np.degrees(edge) == pytest.approx(26.57, abs=5e-3)
    heel = np.linspace(0.0, edge, 40)
    exact = np.sin(heel) * (height + 0.5 * radius * np.tan(heel)**2)
    for probes in ((2, 2), (1, 2), (3, 4), (8, 8)):
        np.testing.assert_allclose(righting_arms(barge(probes), heel), exact, atol=1e-12)
        np.testing.assert_allclose(righting_arms(barge(probes), -heel), -exact, atol=1e-12)
    np.testing.assert_allclose(righting_arms(barge(), np.radians([10.0, 20.0])),
                               [0.1704, 0.3702], atol=5e-5)


def test_past_the_deck_edge_columns_err_by_what_is_known_and_more_columns_by_less():
    heel = np.radians([30.0, 40.0, 50.0])
    exact = np.array([0.6078, 0.6287, 0.5171])
    assert righting_arms(barge((2, 2)), heel)[1] == pytest.approx(1.063, abs=5e-4)
    error = [np.abs(righting_arms(barge(probes), heel) - exact).max()
             for probes in ((4, 4), (8, 8))]
    np.testing.assert_allclose(error, [0.0545, 0.0124], atol=1e-4)


def test_the_bilge_ends_the_exact_range_of_a_box_of_little_draft():
    assert wall_sided_heel(2.0, 1.0, 0.25) == pytest.approx(np.arctan(0.25))
    assert wall_sided_heel(2.0, 1.0, 0.75) == pytest.approx(np.arctan(0.25))
    # Beyond it a triangle is under water, of width w on the bottom: its centre is w / 3 from the
    # bilge and a third of its height up.
    small, length, beam, draft_, keel_to_mass = box((4.0, 2.0, 1.0), 2000.0), 4.0, 2.0, 0.25, 0.5
    heel = np.radians([15.0, 18.0, 22.0])
    width = np.sqrt(2.0 * beam * draft_ / np.tan(heel))
    exact = (np.cos(heel) * (beam / 2 - width / 3)
             + np.sin(heel) * (width * np.tan(heel) / 3 - keel_to_mass))
    surface = box_surface((length, beam, 1.0), (0.0, 0.0, 0.5)).facets
    clipped = [righting_arm(surface, keel_to_mass, length * beam * draft_, angle)
               for angle in heel]
    np.testing.assert_allclose(clipped, exact, atol=1e-10)
    # Four columns are still wet at their ends, and go on as walls do.
    walls = np.sin(heel) * (small_gm(small) + 0.5 * beam**2 / (12 * draft_) * np.tan(heel)**2)
    np.testing.assert_allclose(righting_arms(small, heel), walls, atol=1e-12)
    assert (walls > exact).all()


def small_gm(boat):
    """Return the transverse metacentric height in m."""
    return metacentric_heights(boat)[0]


def test_midpoint_columns_miss_gm_by_one_over_their_number_squared():
    error = [small_gm(barge_of(midpoints(n), 'column')) - 0.95 for n in (2, 4, 8, 16)]
    # Each misses beam^2 / 12 / draft / n^2 of the waterplane's second moment.
    np.testing.assert_allclose(error, [-2.0 / n**2 for n in (2, 4, 8, 16)], rtol=1e-10)


# Righting arms and stiffness.

@pytest.mark.parametrize('law', LAWS)
def test_gm_is_the_slope_of_the_righting_arm(law):
    boat = four_probes(law=law, floatiness=2.5, z=-0.2)
    arms = righting_arms(boat, [1e-5, -1e-5])
    assert (arms[0] - arms[1]) / 2e-5 == pytest.approx(small_gm(boat), abs=1e-9)


def test_roll_stiffness_is_3597_newton_metres_and_gm_that_over_the_weight():
    boat = four_probes(z=-0.3, floatiness=3.0, stiffness=4905.0 * 4 / (3.0 * 9810.0))
    assert small_gm(boat) * boat.weight == pytest.approx(3597.0, rel=1e-12)


@pytest.mark.parametrize('above, rights', [(0.66, True), (0.66667, False), (0.6733, False)])
def test_springs_capsize_from_two_thirds_of_a_metre_above_the_probes(above, rights):
    # sum k y^2 = 19620 / 3 against the weight, 9810, times the height.
    boat = four_probes(z=-above, floatiness=3.0, stiffness=4905.0 * 4 / (3.0 * 9810.0))
    assert (small_gm(boat) > 0.0) == rights
    assert any('cannot float upright' in line for line in flotation_warnings(boat)) != rights
    if abs(above - 2.0 / 3.0) > 1e-3:
        # A swing stays within its start of 1e-3 rad; what falls over goes far beyond it.
        tilt = farthest_tilt(boat, floating_state(boat, roll=1e-3))
        assert (tilt < np.degrees(1.001e-3)) == rights and (tilt > 5.0) != rights


def test_pitch_stiffness_is_that_of_a_boat_free_to_rise():
    boat = asymmetric_boat('column')
    roll, pitch = rest_attitude(boat)
    slope = []
    for angle in (1e-5, -1e-5):
        state = floating_state(boat, roll, pitch + angle)
        slope.append(-to_world(rotation_matrix(tuple(state.orientation)),
                               still_load(boat, state)[0].torque)[1])
    assert (slope[0] - slope[1]) / 2e-5 / boat.weight == pytest.approx(
        metacentric_heights(boat)[1], abs=1e-7)


def test_what_sinks_has_no_righting_arm():
    assert np.isnan(righting_arms(four_probes(floatiness=0.9), [0.0, 0.5])).all()
    assert metacentric_heights(four_probes(floatiness=0.9)) == (None, None)


def test_an_upside_down_box_rights_as_the_upright_box_of_its_mirror():
    # Turned over, its keel is its deck: a box whose centre of mass is as far from that.
    upright = box((4.0, 2.0, 1.0), 3000.0, keel_to_mass=0.6)
    mirror = box((4.0, 2.0, 1.0), 3000.0, keel_to_mass=0.4)
    heel = np.radians([5.0, 15.0, 40.0, 70.0])
    np.testing.assert_allclose(righting_arms(mirror, np.pi + heel),
                               righting_arms(upright, heel), atol=1e-12)


# Sentences.

def test_a_sound_boat_gets_no_sentence():
    assert flotation_warnings(box((4.0, 2.0, 1.0), 2000.0)) == ()
    assert flotation_warnings(four_probes()) == ()


@pytest.mark.parametrize('floatiness, start', [
    (0.9, 'The boat sinks: its floatiness is 0.9'),
    (1.0, 'The boat neither floats nor sinks: its floatiness is 1')])
def test_a_boat_without_reserve_is_told_so_in_one_sentence(floatiness, start):
    sentence, = flotation_warnings(four_probes(floatiness=floatiness))
    assert sentence.startswith(start) and 'raise probes.floatiness above 1' in sentence


def test_a_light_probe_that_is_full_cannot_trim_and_the_boat_capsizes():
    boat = four_probes(weights=(2, 1, 1, 1), floatiness=1.2)
    sentences = flotation_warnings(boat)
    assert any(line.startswith('A probe is full at rest') for line in sentences)
    assert any('the boat turns over and rests' in line for line in sentences)
    assert farthest_tilt(boat, floating_state(boat)) > 60.0


def test_weights_trim_a_boat_of_more_reserve_to_where_the_sentence_says():
    damping = undamped(angular_retention=[0.3], linear_retention=[0.3])
    boat = four_probes(weights=(2, 1, 1, 1), floatiness=3.0, damping=damping)
    sentence, = flotation_warnings(boat)
    told = re.search(r'the boat rests at roll (\S+) and pitch (\S+) degrees', sentence).groups()
    np.testing.assert_allclose(settled(boat, floating_state(boat)),
                               [float(told[0]), float(told[1])], atol=0.006)


def test_a_probe_of_no_weight_is_never_called_full():
    boat = reference_boat(positions=[[1, 1, 0], [1, -1, 0], [-1, 1, 0], [-1, -1, 0], [0, 0, -9]],
                          weights=[1, 1, 1, 1, 0])
    assert flotation_warnings(boat) == ()


def test_a_boat_that_turns_over_is_told_so():
    sentences = flotation_warnings(four_probes(weights=(2, 1, 1, 1), law='soft'))
    assert 'the boat turns over and rests at' in sentences[0]


def test_a_load_off_the_middle_is_told_by_side_and_distance():
    aft = flotation_warnings(four_probes(center_of_mass=(0.1, 0.0, 0.0), floatiness=3.0))
    assert 'its lift acts 0.1 m aft of its centre of mass' in aft[0]
    side = flotation_warnings(four_probes(center_of_mass=(0.0, -0.02, 0.0), floatiness=3.0))
    assert 'its lift acts 0.02 m to port of its centre of mass' in side[0]


def test_a_mirrored_boat_is_told_of_the_mirrored_list():
    said = [flotation_warnings(four_probes(floatiness=3.0, center_of_mass=(x, y, 0.0)))[0]
            for x in (0.1, -0.1) for y in (0.02, -0.02)]
    roll, pitch = np.transpose([
        [float(angle) for angle in re.search(
            r'the boat rests at roll (\S+) and pitch (\S+) degrees', one).groups()]
        for one in said])
    assert (roll == -roll[1] * np.array([1, -1, 1, -1])).all() and roll[1] > 0.0
    assert (pitch == pitch[0] * np.array([1, 1, -1, -1])).all() and pitch[0] > 0.0
    for sentence, sides, places in zip(
            said, ('port and bow', 'starboard and bow', 'port and stern', 'starboard and stern'),
            ('0.1 m aft and 0.02 m to starboard', '0.1 m aft and 0.02 m to port',
             '0.1 m ahead and 0.02 m to starboard', '0.1 m ahead and 0.02 m to port')):
        assert f'({sides} down)' in sentence and f'its lift acts {places}' in sentence


def test_columns_of_a_shape_that_lie_under_water_are_no_full_probes():
    # A bulb beneath a box, as a mesh would have it.
    bulb = joined([box_surface((4.0, 2.0, 1.0)), box_surface((1.0, 4.0, 0.4), (0.0, 0.0, -1.0))])
    hull = mesh_shaped(bulb, (2, 2), 5.0, specific_weight=SALT * GRAVITY)
    boat = Boat(5.0 * SALT, hull, 5.0 * SALT * bulb.unit_inertia)
    full = still_load(boat, rest_state(boat))[1] >= hull.height
    assert full.any() and not full.all() and flotation_warnings(boat) == ()


def test_a_hull_that_sinks_is_told_to_become_larger_and_probes_to_lift_more():
    sentence, = flotation_warnings(Boat(9000.0, box_shaped(
        (4.0, 2.0, 1.0), -0.5, (2, 2), specific_weight=SALT * GRAVITY), [1000.0] * 3))
    assert 'make the hull larger' in sentence and 'probes.floatiness' not in sentence


def test_a_box_of_columns_started_on_its_side_stays_there_and_is_told_that_the_hull_would_not():
    for heel, told in ((0.1, False), (0.3, False), (1.22, True), (1.48, True), (1.75, True)):
        scene = load_scene({'start.orientation': [heel, 0.0, 0.0],
                            # Damped until it rests: on its edge a column fills at once.
                            'damping.angular_retention': [0.05],
                            'damping.linear_retention': [0.2]})
        said = 'would let it rest between 90 and 95 degrees, where the hull does not'
        assert any(said in sentence for sentence in scene.warnings) == told
        # The hull rights itself, or turns upside down.
        run = scene.simulation().run(60.0)
        assert (abs(np.degrees(run.roll[-1]) - 90.0) < 3.0) == told
        panels = load_scene({**scene.given, 'hull.model': 'panels'})
        assert not panels.warnings


def test_a_probe_lifted_out_by_the_load_is_named():
    boat = four_probes(center_of_mass=(0.95, 0.3, 0.0), floatiness=6.0)
    assert any(line.startswith('A probe is out of the water at rest (probe 3')
               for line in flotation_warnings(boat))


def test_a_single_probe_at_the_centre_of_mass_rights_nothing():
    boat = reference_boat(positions=[[0.0, 0.0, 0.0]])
    assert [line.split(':')[0] for line in flotation_warnings(boat)] == [
        'Nothing rights the boat in roll', 'Nothing rights the boat in pitch']


def test_a_boat_between_its_probes_is_told_that_nothing_holds_its_height():
    positions = [[x, y, z] for z in (0.0, 2.0) for x in (1.0, -1.0) for y in (0.5, -0.5)]
    hull = probe_hull(positions, [1.0] * 8, weight=9810.0, floatiness=2.0, stiffness=2.0,
                      law='spring')
    sentences = flotation_warnings(Boat(1000.0, hull, [500.0] * 3))
    assert any(line.startswith('No probe is at the waterline at rest') for line in sentences)
