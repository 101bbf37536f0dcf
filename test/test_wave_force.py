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

"""What waves do below their surface: they die out, push along their slope and carry along."""

from dataclasses import replace
from math import cosh, exp, expm1, sinh

from boat_buoyancy.physics import Sea, State
from boat_buoyancy.physics.boat.columns import box_hull
from boat_buoyancy.physics.boat.records import hull_view, readable
from boat_buoyancy.physics.boat.surface import box_surface
from boat_buoyancy.physics.forces.load import load_at
from boat_buoyancy.physics.forces.wave_force import (
    about_boat, add_to_twist, ALONG, PRESSURE, SLOPE, Twist, UP, wave_decay)
from boats import asymmetric_boat, box_boat, in_waves, random_states, undamped, wind_sea
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_panels import cylinder, panelled, sphere
import textbook

pytestmark = pytest.mark.plain

RHO, GRAVITY = 1025.0, 9.81


def water_load(boat, state, sea, time=0.0):
    """Return force N and torque N m of a boat at rest at one `State`, world axes, no weight."""
    hull = hull_view(boat, plain=True)
    if boat.follows_waves:
        hull = hull._replace(decay=wave_decay(boat.immersion, sea.table).tolist())
    load = load_at(boat.plain_records[0], hull, readable(sea.record), sea.table.tolist(),
                   state.position.tolist(), state.orientation.tolist(), time)
    turn = Rotation.from_quat(state.orientation)
    return (turn.apply(load.force) + [0.0, 0.0, boat.weight], turn.apply(load.torque), load)


# How a wave dies out.

@pytest.mark.parametrize('depth', [0.0, 0.3, 2.0, 8.0, 40.0])
def test_waves_die_out_with_depth_as_the_linear_theory_has_it(depth):
    # Periods from ripples that end at once to tides, down to below the bottom.
    periods, down = np.array([0.7, 2.0, 5.0, 12.0, 60.0]), [0.0, 1e-9, 0.2, 1.0, 5.0, 30.0, 80.0]
    sea = Sea([[0.01, period, 0.4, 0.0] for period in periods], depth=depth)
    found = wave_decay(down, sea.table)
    for j, k in enumerate(np.hypot(*sea.wave_vector.T)):
        for i, d in enumerate(down):
            if depth:
                kh, kd = k * depth, k * min(d, depth)
                # sinh(a) - sinh(b) = 2 cosh((a + b) / 2) sinh((a - b) / 2)
                exact = [cosh(kh - kd) / cosh(kh),
                         2.0 * cosh(kh - kd / 2.0) * sinh(kd / 2.0) / (kd * cosh(kh)) if d else 1,
                         cosh(kh - kd / 2.0) / cosh(kh), sinh(kh - kd) / sinh(kh)]
            else:
                kd = k * d
                exact = [exp(-kd), -expm1(-kd) / kd if d else 1, exp(-kd / 2.0), exp(-kd)]
            np.testing.assert_allclose(found[i, [PRESSURE, SLOPE, ALONG, UP], j], exact, rtol=0.0,
                                       atol=1e-11)


def test_columns_feel_what_the_textbook_says_at_any_attitude_and_speed():
    # Probe by probe in world axes, with cosh and quadrature over the depth; no weight.
    for law in ('column', 'spring'):
        for depth in (0.0, 1.5):
            sea = Sea(wind_sea().waves, current=[0.3, -0.2], depth=depth)
            boat = in_waves(asymmetric_boat(law, damping=undamped(
                probe=[500.0, 600.0, 800.0], linear=[50.0, 60.0, 70.0, 80.0, 90.0, 100.0],
                linear_retention=[0.9, 0.8, 0.7], angular_retention=[0.85, 0.8, 0.75])))
            states = random_states((15,), 7)
            for i in range(15):
                state = State(states.position[i], states.orientation[i])
                force, torque, load = water_load(boat, state, sea, 0.7)
                exact, turned, wetness = textbook.load(
                    boat, sea, 0.7, state.position, state.orientation, np.zeros(3), np.zeros(3))
                turn = Rotation.from_quat(state.orientation)
                assert load.wetness == pytest.approx(wetness, abs=1e-12)
                np.testing.assert_allclose(force - [0.0, 0.0, boat.weight], exact,
                                           atol=1e-9 * boat.weight)
                np.testing.assert_allclose(torque, turn.apply(turned), atol=1e-9 * boat.weight)


def test_water_that_turns_as_a_rigid_body_turns_the_boat_as_much():
    # The middle of the waterplane is not the centre of mass, and that is not over the origin.
    boat = replace(box_boat(), center_of_mass=(0.4, -0.3, 0.2), immersion=[0.2] * 4)
    record, probes, *_ = boat.plain_records
    linear, angular = np.array([0.3, -0.4, 0.5]), np.array([0.2, -0.1, 0.7])
    twist = Twist((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    for probe in probes:
        velocity = linear + np.cross(angular, [probe.x, probe.y, 0.0])
        twist = add_to_twist(record, twist, probe, tuple(velocity.tolist()))
    twist = about_boat(record, twist)
    np.testing.assert_allclose(twist.linear, linear, atol=1e-15)
    np.testing.assert_allclose(twist.angular, angular, atol=1e-15)


# Pressure.

def followed(boat, depth=0.25):
    """Return a boat that feels the waves down to its probes, and takes no water along."""
    return replace(boat, immersion=[depth] * len(boat.hull.share))


def gradient_force(sea, place, time=0.0):
    """Return the acceleration (3,) m/s^2 of the water at a place, by linear waves."""
    total = np.zeros(3)
    for a, period, direction, phase in sea.waves:
        s = 2.0 * np.pi / period
        k = textbook.dispersion(s, sea.depth, GRAVITY)
        ahead = np.array([np.cos(direction), np.sin(direction), 0.0])
        theta = k * (place[:2] @ ahead[:2]) - s * time + phase
        if sea.depth:
            c, w = (f(k * (sea.depth + place[2])) / np.cosh(k * sea.depth)
                    for f in (np.cosh, np.sinh))
        else:
            c = w = np.exp(k * place[2])
        total += GRAVITY * k * a * (c * np.sin(theta) * ahead - w * np.cos(theta) * textbook.UP)
    return total


@pytest.mark.parametrize('depth', [0.0, 6.0])
@pytest.mark.parametrize('radius', [0.3, 1.2])
def test_a_sphere_under_water_is_pushed_as_the_water_at_its_centre_whatever_its_radius(
        radius, depth):
    # The gradient of a harmonic pressure is harmonic: its mean over a ball is that of the middle.
    sea = Sea([[0.02, 2.5, 0.3, 0.5], [0.03, 3.5, -1.2, 2.0]], depth=depth)
    volume, center = 4.0 / 3.0 * np.pi * radius ** 3, np.array([0.4, -0.7, -1.4])
    ways = set()
    for time in np.arange(0.0, 3.5, 0.5):
        exact = RHO * volume * gradient_force(sea, center, time)
        ways.add(exact[2] > 0.0)
        errors = []
        for halvings in (2, 3, 4):
            surface = sphere(radius, halvings)
            boat = followed(panelled(box_boat(undamped()), surface, RHO * GRAVITY))
            force, *_ = water_load(boat, State(center), sea, time)
            lift = RHO * GRAVITY * surface.volume * textbook.UP
            errors.append(np.linalg.norm(force - lift - exact))
        # A mesh of edge e lies e^2 / 8 R inside of the ball, on the mean.
        smaller = 3.0 / 8.0 * (surface.longest_edge / radius) ** 2
        assert errors[-1] < smaller * np.linalg.norm(exact)
        assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx([2.0, 2.0], abs=0.25)
    # Up and down.
    assert ways == {False, True}


def test_in_still_water_it_is_archimedes_to_round_off_at_any_attitude():
    for surface in (box_surface((4.0, 2.0, 1.0)), sphere(0.9, 3), cylinder(0.6, 3.0, 12)):
        hydrostatic = panelled(box_boat(undamped()), surface)
        for i, turn in enumerate(Rotation.random(20, random_state=2)):
            state = State([1.0, -2.0, 0.1 * (i % 5 - 2)], turn.as_quat())
            was, is_now = (water_load(boat, state, Sea()) for boat in (
                hydrostatic, followed(hydrostatic)))
            size = RHO * GRAVITY * surface.volume
            np.testing.assert_allclose(is_now[0], was[0], atol=1e-13 * size)
            np.testing.assert_allclose(is_now[1], was[1], atol=1e-12 * size)


@pytest.mark.parametrize('depth', [0.0, 3.0])
def test_columns_and_panels_feel_the_same_in_small_long_waves(depth):
    # A box 4 m long, 0.25 m deep in the water, in waves so small that what is linear is all.
    small, draft = 1e-5, 0.25
    sea = Sea([[small, 7.0, 0.6, 1.0]], depth=depth)
    k = np.hypot(*sea.wave_vector[0])
    hull = box_hull((4.0, 2.0, 1.0), -0.5, (6, 4), specific_weight=RHO * GRAVITY)
    columns = followed(replace(box_boat(undamped()), hull=hull), draft)
    panels = panelled(columns, box_surface((4.0, 2.0, 1.0)).refined(0.2), RHO * GRAVITY)
    state = State([0.0, 0.0, 0.5 - draft])
    felt = [np.concatenate([np.subtract(water_load(boat, state, sea, 0.3)[part],
                                        water_load(boat, state, Sea(depth=depth))[part])
                            for part in (0, 1)]) for boat in (columns, panels)]
    # Over those of the water on the waterplane: its squares are L^2 / 12 and B^2 / 12.
    size = RHO * GRAVITY * 8.0 * small * np.array([
        k * draft, k * draft, 1.0, k / 3.0, k * 4.0 / 3.0, k * draft])
    # Panels are flat over an edge e, (k e)^2 / 8; the slope of a column pushes at half its depth,
    # that of a wave which dies out k d^2 / 12 higher.
    higher = k * draft ** 3 / 12.0 * RHO * GRAVITY * 8.0 * small * k * np.array([0, 0, 0, 1, 1, 0])
    assert (abs(felt[0] - felt[1]) <= (k * 0.2) ** 2 / 8.0 * size + higher).all()
    assert (abs(felt[0][:5]) > 0.05 * size[:5]).all()
