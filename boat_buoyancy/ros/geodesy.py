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

"""
Where a place near a datum is on the ellipsoid WGS84.

A world of straight axes touches the ellipsoid at its datum: 10 km away it is 7.8 m above it.
"""

import math

# Semi-major axis in m and flattening (NIMA TR8350.2), and what follows from them.
A, F = 6378137.0, 1.0 / 298.257223563
B = A * (1.0 - F)
ECCENTRICITY_SQUARED = F * (2.0 - F)


def geodetic(latitude, longitude, altitude, east, north, up):
    """
    Return latitude and longitude in degrees and height in m of a place in the world.

    Main arguments: ``latitude`` and ``longitude`` in degrees and ``altitude`` m, the datum;
    ``east``, ``north``, ``up`` m from it, along its axes.
    By way of earth-centred axes, and back by Bowring (1976): to a thousandth of a millimetre
    within 100 km.
    """
    phi, lam = math.radians(latitude), math.radians(longitude)
    sin_phi, cos_phi = math.sin(phi), math.cos(phi)
    # The prime vertical's radius of curvature, a / sqrt(1 - e^2 sin^2 phi).
    N = A / math.sqrt(1.0 - ECCENTRICITY_SQUARED * sin_phi ** 2)
    outward = (N + altitude) * cos_phi - north * sin_phi + up * cos_phi
    x = outward * math.cos(lam) - east * math.sin(lam)
    y = outward * math.sin(lam) + east * math.cos(lam)
    z = ((1.0 - ECCENTRICITY_SQUARED) * N + altitude) * sin_phi + north * cos_phi + up * sin_phi

    p, theta = math.hypot(x, y), math.atan2(z * A, math.hypot(x, y) * B)
    phi = math.atan2(z + ECCENTRICITY_SQUARED * A ** 2 / B * math.sin(theta) ** 3,
                     p - ECCENTRICITY_SQUARED * A * math.cos(theta) ** 3)
    height = p * math.cos(phi) + z * math.sin(phi) - A * math.sqrt(
        1.0 - ECCENTRICITY_SQUARED * math.sin(phi) ** 2)
    return math.degrees(phi), math.degrees(math.atan2(y, x)), height
