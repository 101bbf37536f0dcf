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

"""The boundary element method, through this package's own panels, against published answers."""

import json
from pathlib import Path

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.boat.boat import Boat
from boat_buoyancy.physics.boat.shapes import mesh_shaped
from boat_buoyancy.physics.boat.surface import Surface
from boat_buoyancy.physics.hydrostatics.strip_theory import first_guess
from boat_buoyancy.tools import hydrodynamics
from boat_buoyancy.tools.boundary_elements import at_natural_periods, Hulls
import numpy as np
import pytest
import yaml

pytestmark = pytest.mark.bem

ROOT = Path(__file__).parents[1]
DENSITY, GRAVITY = 1000.0, 9.81
# Hulme, J. Fluid Mech. 121 (1982): a floating hemisphere of radius a in waves of wave number K.
# Ka; added mass in heave and in surge over its displacement; damping in surge over that and omega.
HULME = [(0.5, 0.5861, 0.6439, 0.0987), (1.0, 0.4284, 0.5740, 0.3535)]


@pytest.fixture(scope='module')
def sphere():
    """Return a sphere of radius 1 m that floats half under, its centre of mass 0.3 m down."""
    import trimesh
    ball = trimesh.creation.icosphere(subdivisions=4)
    surface = Surface(ball.vertices, ball.faces)
    mass = 0.5 * DENSITY * surface.volume
    hull = mesh_shaped(surface, (4, 4), 0.5 * surface.volume, specific_weight=DENSITY * GRAVITY)
    return Boat(mass, hull, [0.4 * mass] * 3, center_of_mass=(0.0, 0.0, -0.3))


@pytest.mark.parametrize('wave_number, heave, surge, damping', HULME)
def test_a_hemisphere_has_the_added_mass_and_damping_that_hulme_published(
        sphere, wave_number, heave, surge, damping):
    omega = np.sqrt(wave_number * GRAVITY)
    added, drag = Hulls(sphere).radiation(2.0 * np.pi / omega)
    # Flat panels with a constant source each: two thousand are within two or three per cent.
    assert added[2, 2] / sphere.mass == pytest.approx(heave, rel=0.03)
    assert added[0, 0] / sphere.mass == pytest.approx(surge, rel=0.03)
    assert added[1, 1] == pytest.approx(added[0, 0], rel=0.01)
    assert drag[0, 0] / sphere.mass / omega == pytest.approx(damping, rel=0.04)
    # It moves no water as it turns about its middle; about a point below, its middle goes along.
    assert np.diag(added)[3:5] == pytest.approx(np.diag(added)[[1, 0]] * 0.3 ** 2, rel=0.02)


def test_the_barge_is_that_of_an_independent_run_of_the_method():
    data = json.loads((ROOT / 'test/data/bem_barge.json').read_text())
    found = at_natural_periods(load_scene(ROOT / 'config' / 'barge.yaml').boat)
    assert found.added_mass == pytest.approx(data['added_mass'], rel=0.03)
    # Roll, 0.1 % of critical, is round-off of the panels; the others are not.
    mine, theirs = (np.delete(values, 3) for values in (
        found.damping, data['radiation_damping']))
    assert mine == pytest.approx(theirs, rel=0.1)


def test_hulls_side_by_side_are_taken_one_by_one():
    one = {'hull.size': [4.0, 0.5, 1.0], 'boat.mass': 500.0,
           'boat.center_of_mass': [0.0, 0.0, -1.0]}
    two = {**one, 'hull.shape': 'twin', 'hull.spacing': 3.0, 'boat.mass': 1000.0}
    single, both = (Hulls(load_scene(values).boat, 500).radiation(1.5)[0]
                    for values in (one, two))
    assert np.diag(both)[[0, 1, 2, 4]] == pytest.approx(
        2.0 * np.diag(single)[[0, 1, 2, 4]], rel=1e-4)
    assert both[3, 3] == pytest.approx(2.0 * (single[3, 3] + single[2, 2] * 1.5 ** 2), rel=1e-4)
    assert both[5, 5] == pytest.approx(2.0 * (single[5, 5] + single[0, 0] * 1.5 ** 2), rel=1e-4)


@pytest.mark.parametrize('name', ['wam_v', 'rib'])
def test_strips_are_as_far_from_it_as_is_said_of_hulls_that_are_not_stored(name):
    boat = load_scene(ROOT / 'config' / f'{name}.yaml').boat
    guess, found = first_guess(boat), at_natural_periods(boat, 600)
    for values, by_strips, trust in (
            (found.added_mass, guess[0], hydrodynamics.ADDED_MASS_TRUST),
            (found.damping, guess[1], hydrodynamics.DAMPING_TRUST)):
        least, most = np.transpose(trust)
        assert ((least <= values / by_strips) & (values / by_strips <= most)).all()


def test_the_program_prints_them_and_how_much_the_panels_matter(capsys):
    assert hydrodynamics.main([str(ROOT / 'config' / 'default.yaml'), '--bem']) == 0
    said = capsys.readouterr().out
    values = yaml.safe_load(said)
    # physics of the default box: heave, roll and pitch in 1.85, 1.85 and 1.76 s.
    for name, period in (('heave', 1.85), ('roll', 1.85), ('pitch', 1.76)):
        row, = (line.split() for line in said.splitlines() if line.startswith(f'# {name} '))
        assert float(row[3]) == pytest.approx(period, rel=0.01)
    assert len(values['added_mass']) == len(values['damping.linear']) == 6
    assert 'mass and added mass changed by at most' in ' '.join(said.replace('#', '').split())
