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

"""The columns of a box against exact clipping."""

from boat_buoyancy.physics.boat.boat import Boat
from boat_buoyancy.physics.boat.clipping import submerged
from boat_buoyancy.physics.boat.columns import box_hull
from boat_buoyancy.physics.boat.state import State
from boat_buoyancy.physics.boat.surface import box_surface
from boat_buoyancy.physics.forces.probe_laws import arm, wetting
from boat_buoyancy.physics.hydrostatics.rest import floating_state
from boat_buoyancy.physics.hydrostatics.righting_arm import righting_arms
from boat_buoyancy.physics.hydrostatics.stiffness import still_load
import numpy as np
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

SPECIFIC_WEIGHT = 1025.0 * 9.81
BARGE, KEEL_TO_MASS = (20.0, 6.0, 3.0), 1.8


def boat_of(size, keel_to_mass, mass, probes=(2, 2)):
    """Return a box boat whose body origin is its centre of mass."""
    hull = box_hull(size, -keel_to_mass, probes, specific_weight=SPECIFIC_WEIGHT)
    return Boat(mass, hull, [1.0, 1.0, 1.0])


def surface_of(size, keel_to_mass):
    """Return the triangles of the box about the same origin."""
    return box_surface(size, (0.0, 0.0, size[2] / 2 - keel_to_mass)).facets


def placed(triangles, turn, height):
    """Return triangles in world axes."""
    return turn.apply(triangles.reshape(-1, 3)).reshape(-1, 3, 3) + [0.0, 0.0, height]


def modelled(boat, turn, height):
    """Return volume m^3 and centre of buoyancy (3,) m from the centre of mass, world axes."""
    load, depths = still_load(boat, State([0.0, 0.0, height], turn.as_quat()))
    (record, probes, *_), up = boat.plain_records, turn.as_matrix()[2]
    lifts, places = [], []
    for probe, depth in zip(probes, depths):
        wet, share = wetting(record.law, probe.height, depth, up[2])
        lifts.append(probe.max_force * share)
        places.append([probe.x, probe.y,
                       probe.z + arm(record.law, probe.height, wet, up[2])])
    lift, centre = np.sum(lifts), np.average(places, axis=0, weights=lifts)
    # The points of force are those of the load.
    size = np.abs(places).max()
    np.testing.assert_allclose(np.add(load.force, boat.weight * up), lift * up,
                               atol=1e-13 * (lift + boat.weight))
    np.testing.assert_allclose(load.torque, np.cross(centre, lift * up), atol=1e-12 * size * lift)
    return lift / SPECIFIC_WEIGHT, turn.apply(centre)


def walls_only(random):
    """Return a random box, place and attitude with its whole bottom wet and its deck dry."""
    while True:
        size = np.exp(random.uniform(np.log(0.3), np.log(30.0), 3))
        keel_to_mass = random.uniform(-0.5, 1.5) * size[2]
        roll, pitch = random.uniform(-1.2, 1.2, 2)
        turn = Rotation.from_euler('xyz', [roll, pitch, random.uniform(-3.0, 3.0)])
        corners = turn.apply(surface_of(size, keel_to_mass).reshape(-1, 3))[:, 2]
        inside = surface_of(size, keel_to_mass).reshape(-1, 3)[:, 2] < 0.0 - keel_to_mass + 1e-9
        bottom, deck = corners[inside].max(), corners[~inside].min()
        if bottom < deck:
            # The whole range of heights from the bottom just wet to the deck just dry.
            return size, keel_to_mass, turn, -random.uniform(bottom, deck)


def test_columns_have_the_volume_and_centre_of_a_box_at_any_heel_trim_and_heave_to_1e_12():
    random = np.random.default_rng(11)
    for _ in range(500):
        size, keel_to_mass, turn, height = walls_only(random)
        probes = tuple(random.integers(2, 6, 2).tolist())
        volume, centre = modelled(boat_of(size, keel_to_mass, 1.0, probes), turn, height)
        wet, moment = submerged(placed(surface_of(size, keel_to_mass), turn, height))
        moment = moment - wet * np.array([0.0, 0.0, height])
        assert abs(volume / wet - 1.0) < 1e-12
        assert np.abs(centre - moment / wet).max() < 1e-12 * size.max()


def test_past_a_deck_edge_columns_are_no_longer_the_box():
    size, turn = (4.0, 2.0, 1.0), Rotation.from_euler('x', 0.6)
    volume, _ = modelled(boat_of(size, 0.5, 1.0), turn, -0.3)
    wet, _ = submerged(placed(surface_of(size, 0.5), turn, -0.3))
    assert abs(volume / wet - 1.0) > 1e-3


def test_a_box_floats_where_its_clipped_volume_carries_it():
    random = np.random.default_rng(3)
    for _ in range(50):
        size, keel_to_mass, turn, height = walls_only(random)
        surface = surface_of(size, keel_to_mass)
        mass = 1025.0 * submerged(placed(surface, turn, height))[0]
        roll, pitch, yaw = turn.as_euler('xyz')
        state = floating_state(boat_of(size, keel_to_mass, mass), roll, pitch, yaw)
        assert abs(state.position[2] - height) < 1e-12 * np.max(size)


def clipped_arm(surface, volume, heel):
    """Return GZ in m of the clipped body at one heel in rad, free to rise and sink."""
    turn = Rotation.from_euler('x', heel)
    height = brentq(lambda z: submerged(placed(surface, turn, z))[0] - volume, -20.0, 20.0,
                    xtol=1e-14)
    wet, moment = submerged(placed(surface, turn, height))
    return -moment[1] / wet


def test_more_columns_come_closer_to_the_box_past_its_deck_edge():
    # The wet length has kinks there.  A Gauss rule of n points integrates polynomials up to
    # 2 n - 1, which come as close as 1 / n to a function of bounded slope (Jackson).
    surface, heel = surface_of(BARGE, KEEL_TO_MASS), np.radians(np.arange(27.0, 51.0))
    exact = [clipped_arm(surface, 180.0, angle) for angle in heel]

    def error(count):
        boat = boat_of(BARGE, KEEL_TO_MASS, 1025.0 * 180.0, (1, count))
        return np.sqrt(np.mean((righting_arms(boat, heel) - exact)**2))

    errors = [error(count) for count in (4, 12, 36)]
    assert errors[1] < errors[0] / 3.0 and errors[2] < errors[1] / 3.0
