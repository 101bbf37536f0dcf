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

"""Boats lie where their energy is least: a second way to their rest, without forces."""

from pathlib import Path

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.boat.clipping import submerged
from boat_buoyancy.physics.hydrostatics.metacentric_height import metacentric_heights
from boat_buoyancy.physics.hydrostatics.rest import draft, rest_attitude, rest_state
from boat_buoyancy.physics.hydrostatics.righting_arm import righting_arms
from boat_buoyancy.physics.hydrostatics.stiffness import still_load
import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

pytestmark = pytest.mark.plain

HULLS = Path(__file__).parents[1] / 'config' / 'hulls'
BARGE = {'boat.mass': 184500.0, 'hull.size': [20.0, 6.0, 3.0]}
RIB = {'boat.mass': 500.0, 'hull.shape': 'mesh', 'hull.mesh': str(HULLS / 'rib.stl'),
       'hull.model': 'panels'}
CASES = {'columns': (BARGE, (0.8, 0.25, 0.3)),
         'panels': ({**BARGE, 'hull.model': 'panels'}, (0.8, 0.25, 0.3)),
         'mesh': (RIB, (-0.2, 0.12, 0.5))}
# A minimum of energy E with stiffness K is flat to sqrt(2 eps E / K) < 1e-7 rad or m here.
FLAT = 1e-6


def boat_of(kind, mirror=(1.0, 1.0)):
    """Return the boat of a case, mirrored along and across where ``mirror`` says -1."""
    values, (x, y, z) = CASES[kind]
    return load_scene({**values, 'boat.center_of_mass': [x * mirror[0], y * mirror[1], z]}).boat


def of_least_energy(boat):
    """
    Return height m of the centre of mass, roll and pitch rad at which a boat has least energy.

    m g z of the boat, and of the water that it pushes aside up to the surface -rho g z for each
    of its volume: rho g times the volume's moment, by exact clipping.
    """
    corners = boat.hull.surface.facets - boat.center_of_mass
    length = boat.size

    def energy(place):
        height, roll, pitch = place * [length, 1.0, 1.0]
        turned = Rotation.from_euler('ZYX', [0.0, pitch, roll]).apply(corners.reshape(-1, 3))
        _, moment = submerged(turned.reshape(corners.shape) + [0.0, 0.0, height])
        water = boat.hull.specific_weight * moment[2]
        return (boat.weight * height - water) / (boat.weight * length)

    options = {'xatol': 1e-9, 'fatol': 0.0, 'maxfev': 5000, 'maxiter': 5000, 'adaptive': True}
    found = np.zeros(3)
    for _ in range(3):
        # Nelder and Mead's simplex wants new starts; it takes no derivatives, and so no forces.
        simplex = found + 0.05 * np.vstack([np.zeros(3), np.eye(3)])
        found = minimize(energy, found, method='Nelder-Mead',
                         options={**options, 'initial_simplex': simplex}).x
    return found * [length, 1.0, 1.0]


@pytest.mark.parametrize('kind', CASES)
def test_a_boat_loaded_off_centre_lies_where_its_energy_is_least(kind):
    boat = boat_of(kind)
    found = [rest_state(boat).position[2], *rest_attitude(boat)]
    np.testing.assert_allclose(found, of_least_energy(boat), atol=FLAT)
    assert min(map(abs, rest_attitude(boat))) > 0.01


@pytest.mark.parametrize('kind', ['columns', 'panels'])
def test_the_barge_loaded_off_centre_has_the_published_list(kind):
    boat = boat_of(kind)
    roll, _ = np.degrees(rest_attitude(boat))
    # 13.7 degrees, to the digit given.
    assert roll == pytest.approx(-13.7, abs=0.05)
    # Its lowest corner, from the attitude: a plane through the box's middle line at the draft.
    state = rest_state(boat)
    turn = Rotation.from_quat(state.orientation)
    corner = turn.apply(np.array([10.0, 3.0, -1.5]) - boat.center_of_mass)
    assert draft(boat, state) == pytest.approx(-(state.position[2] + corner[2]), abs=1e-12)


@pytest.mark.parametrize('kind', CASES)
def test_a_boat_at_rest_is_pushed_nowhere(kind):
    boat = boat_of(kind)
    load, _ = still_load(boat, rest_state(boat))
    # Turned to within 1e-13 rad of rest.
    turn = Rotation.from_quat(rest_state(boat).orientation)
    assert np.abs(load.force).max() < 1e-11 * boat.weight
    assert np.abs(turn.apply(load.torque)[:2]).max() < 1e-11 * boat.weight * boat.size


@pytest.mark.parametrize('kind', CASES)
def test_a_mirrored_boat_has_the_mirrored_rest(kind):
    roll, pitch = rest_attitude(boat_of(kind))
    height = rest_state(boat_of(kind)).position[2]
    across = boat_of(kind, (1.0, -1.0))
    np.testing.assert_allclose(rest_attitude(across), [-roll, pitch], atol=1e-12)
    assert rest_state(across).position[2] == pytest.approx(height, abs=1e-12)
    if kind != 'mesh':
        # Bow and stern of the box alike.
        along = boat_of(kind, (-1.0, 1.0))
        np.testing.assert_allclose(rest_attitude(along), [roll, -pitch], atol=1e-12)
        assert metacentric_heights(along) == pytest.approx(metacentric_heights(across), rel=1e-9)


@pytest.mark.parametrize('kind', CASES)
def test_gm_at_that_rest_is_the_slope_of_the_righting_arm_there(kind):
    boat = boat_of(kind)
    roll, pitch = rest_attitude(boat)
    step = 1e-5
    high, low = righting_arms(boat, [roll + step, roll - step])
    # GZ turns about, and has its torque about, the boat's own axis, which is trimmed by the pitch;
    # GM those about a level one: a factor cos(pitch) each.
    slope = (high - low) / (2.0 * step) / np.cos(pitch) ** 2
    assert slope == pytest.approx(metacentric_heights(boat)[0], rel=1e-6)
