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

"""Places about a datum are where they are on WGS84, to a thousandth of a millimetre."""

import math

from boat_buoyancy.ros.geodesy import geodetic
import numpy as np
import pytest

# What pymap3d 3.2.0 gives: enu2geodetic(east, north, up, latitude, longitude, altitude).
PYMAP3D = [
    ((-33.724223, 150.679736, 0.0), (3000.0, 4000.0, 1.5),
     (-33.68815580466311, 150.71209111100757, 3.463641467508664)),
    ((-33.724223, 150.679736, 0.0), (-10000.0, 0.0, -2.0),
     (-33.72417587007265, 150.57184058356088, 5.831185044020326)),
    ((-33.724223, 150.679736, 0.0), (7000.0, -7000.0, 0.3),
     (-33.787309517573135, 150.75531812493932, 7.992422157854988)),
    ((59.9, 10.7, 40.0), (3000.0, 4000.0, 1.5),
     (59.93589198158889, 10.753659299888144, 43.457007945565024)),
    ((59.9, 10.7, 40.0), (-10000.0, 0.0, -2.0),
     (59.89987892232978, 10.521329118769161, 45.81956385426997)),
    ((0.0, 179.99, 0.0), (3000.0, 4000.0, 1.5),
     (0.03617476163361005, -179.98305054980176, 3.4682724049763736)),
    ((0.0, 179.99, 0.0), (7000.0, -7000.0, 0.3),
     (-0.06330579599305441, -179.94711795831657, 8.008377139225345)),
    ((89.95, 20.0, 0.0), (3000.0, 4000.0, 1.5),
     (89.96962391607272, 82.15547636244082, 3.4532482736688332)),
    ((89.95, 20.0, 0.0), (-10000.0, 0.0, -2.0),
     (89.89745404943758, -40.81796701289783, 5.812993817784967))]


def earth_centred(latitude, longitude, altitude):
    """Return (3,) m of a place: along the normal of the ellipsoid, from where it is crossed."""
    a, b = 6378137.0, 6356752.314245179
    phi, lam = math.radians(latitude), math.radians(longitude)
    normal = np.array([math.cos(phi) * math.cos(lam), math.cos(phi) * math.sin(lam),
                       math.sin(phi)])
    # The point of x^2 / a^2 + y^2 / a^2 + z^2 / b^2 = 1 with this normal.
    squares = np.array([a * a, a * a, b * b])
    return squares * normal / math.sqrt(normal @ (squares * normal)) + altitude * normal


@pytest.mark.parametrize('datum, place, expected', PYMAP3D)
def test_a_place_within_ten_kilometres_is_where_pymap3d_says(datum, place, expected):
    got = geodetic(*datum, *place)
    assert np.linalg.norm(earth_centred(*got) - earth_centred(*expected)) < 1e-6


def test_a_place_goes_back_to_the_axes_that_it_was_given_in():
    random = np.random.default_rng(5)
    for reach, error in ((1e4, 1e-6), (1e5, 1e-6)):
        for _ in range(200):
            latitude, longitude = random.uniform(-90.0, 90.0), random.uniform(-180.0, 180.0)
            altitude = random.uniform(-100.0, 5000.0)
            place = random.uniform(-1.0, 1.0, 3) * [reach, reach, 100.0]
            phi, lam = math.radians(latitude), math.radians(longitude)
            east = np.array([-math.sin(lam), math.cos(lam), 0.0])
            up = np.array([math.cos(phi) * math.cos(lam), math.cos(phi) * math.sin(lam),
                           math.sin(phi)])
            origin = earth_centred(latitude, longitude, altitude)
            there = origin + np.stack([east, np.cross(up, east), up]).T @ place
            got = geodetic(latitude, longitude, altitude, *place)
            assert np.linalg.norm(earth_centred(*got) - there) < error, (latitude, place)


def test_the_datum_is_the_origin_and_the_poles_are_no_exception():
    assert geodetic(12.0, -34.0, 56.0, 0.0, 0.0, 0.0) == pytest.approx((12.0, -34.0, 56.0))
    for pole in (90.0, -90.0):
        latitude, _, height = geodetic(pole, 0.0, 3.0, 0.0, 0.0, 0.0)
        assert latitude == pytest.approx(pole, abs=1e-9) and height == pytest.approx(3.0)


def test_the_straight_world_leaves_the_ellipsoid_by_the_square_of_the_distance():
    # d^2 / 2R: 7.84 m at 10 km.
    assert geodetic(0.0, 0.0, 0.0, 1e4, 0.0, 0.0)[2] == pytest.approx(
        1e8 / (2.0 * 6378137.0), rel=1e-5)
