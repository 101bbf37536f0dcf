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
First guesses of added mass and radiation damping, from strips of the hull across its length.

Each strip moves the water of an endless body of its section.  Hulls that float side by side have
strips of their own, and what they do to each other is left out.
"""

from typing import NamedTuple

import numpy as np

from .moving_water import critical_damping, resting_facets
from .rest import rest_state
from ..boat.cuts import chords, cuts
from ..rotation import rotation_matrix

STATIONS = 400
# Damping ratios of the waves that a boat makes, surge to yaw, as a boundary element method has
# them of a box, a barge and a Wigley hull; see `critical_damping`.
RADIATION_RATIOS = (0.03, 0.1, 0.17, 0.02, 0.12, 0.03)


class Strips(NamedTuple):
    """Strips of a hull at rest, all (n,) m: see `strips`."""

    x: np.ndarray
    y: np.ndarray
    beam: np.ndarray
    draft: np.ndarray
    length: np.ndarray


def strips(facets):
    """
    Return the `Strips` of a hull that floats in water at z = 0.

    ``facets`` (n, 3, 3) m, a closed surface.  Each is a piece of the waterplane across x: the
    place ``x``, ``y`` of its middle, its ``beam`` across, its ``length`` along x, and the
    ``draft`` under its middle.
    """
    outline = cuts(facets, 2, [0.0])
    ends = outline[1][:, 0]
    length = np.ptp(ends) / STATIONS
    stations = ends.min() + length * (np.arange(STATIONS) + 0.5)
    station, low, high = chords(outline, np.zeros(STATIONS, int), stations)
    y, draft = 0.5 * (low + high), np.zeros(len(station))
    strip, bottom, _ = chords(cuts(facets, 0, stations), station, y)
    np.maximum.at(draft, strip, -bottom)
    return Strips(stations[station], y, high - low, draft, np.full(len(station), length))


def added_mass_of(strips, volume, density):
    """
    Return the added mass (6,) of `Strips` about the origin, kg and kg m^2.

    ``volume`` m^3 that all of them displace; ``density`` kg/m^3 of the water.

    Heave and pitch: half a cylinder as wide as the strip, rho pi/8 b^2 on each metre; roll: half
    a flat plate, rho pi/128 b^4 (Newman, Marine Hydrodynamics, 1977, table 4.3).  Sway and yaw:
    half an ellipse, rho pi/2 T^2, as slender-body theory has it (there, chapter 7).  Surge:
    2.7 rho V^(5/3) / L^2 of each hull (Soeding 1982, as in Fossen, Handbook of Marine Craft
    Hydrodynamics and Motion Control).
    """
    x, y, beam, draft, step = strips
    length = np.ptp(x) + step[0]
    hulls = max(1, round(step.sum() / length))
    surge = hulls * 2.7 * density * (volume / hulls) ** (5.0 / 3.0) / length ** 2
    sway = density * np.pi / 2.0 * draft ** 2 * step
    heave = density * np.pi / 8.0 * beam ** 2 * step
    roll = density * np.pi / 128.0 * beam ** 4 * step
    # A hull beside the middle heaves as the boat rolls, and surges as it yaws.
    return np.array([surge, sway.sum(), heave.sum(), roll.sum() + heave @ y ** 2, heave @ x ** 2,
                     sway @ x ** 2 + surge * np.average(y ** 2, weights=step)])


def first_guess(boat, roll_ratio=0.0):
    """
    Return added mass and damping of a `Boat` at rest by its strips, (6,) each.

    kg and kg m^2, N/(m/s) and N m/(rad/s); body axes, about the centre of mass.  ValueError as of
    `resting_facets`.

    Damping is that of the waves that it makes, by `RADIATION_RATIOS`, and ``roll_ratio`` of
    critical for what friction and eddies take of roll.
    """
    found, weight = strips(resting_facets(boat)), boat.hull.specific_weight
    level = added_mass_of(found, boat.weight / weight, weight / boat.gravity)
    rotation = np.array(rotation_matrix(rest_state(boat).orientation.tolist()))
    added = np.square(np.kron(np.eye(2), rotation)).T @ level
    critical = critical_damping(boat, added)
    damping = critical * RADIATION_RATIOS
    # A hull beside the middle makes its waves of heave as the boat rolls.
    damping[3] += damping[2] * np.average(
        found.y ** 2, weights=found.beam ** 2) + roll_ratio * critical[3]
    return added, damping
