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
A boat as the step reads it: records with named fields, all from the centre of mass, body axes.

Compiled code reads structured arrays, whose names cost nothing; plain Python reads named tuples
of floats, as the fields of NumPy's records cost it a microsecond each.
"""

from collections import namedtuple
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from .hull import LAWS

# Mass kg and weight N; symmetric matrices are xx, yy, zz, xy, xz, yz.  ``moments`` in rising
# order, their axes the unit vectors ``axis_1`` to ``axis_3``.  Damping: ``probe_damping`` N s/m
# over all probes on each axis; retention in water and in air, force N/(m/s) on the diagonal and
# torque N m/(rad/s) as a matrix; ``linear`` and ``quadratic`` as `Damping`; drag in the air of
# surge and sway, and how far m ahead that of sway acts; whether any drag is quadratic.  Of a hull
# of panels how many corners and triangles, rho g in N/m^3, most lift N, and how far m its farthest
# corner is; else 0.
BOAT = np.dtype([
    ('mass', 'f8'), ('weight', 'f8'), ('center_of_mass', 'f8', 3), ('inertia', 'f8', 6),
    ('moments', 'f8', 3), ('axis_1', 'f8', 3), ('axis_2', 'f8', 3), ('axis_3', 'f8', 3),
    ('law', 'i8'), ('probe_damping', 'f8', 3),
    ('water_retention', 'f8', 3), ('water_spin_retention', 'f8', 6),
    ('air_retention', 'f8', 3), ('air_spin_retention', 'f8', 6),
    ('linear', 'f8', 6), ('quadratic', 'f8', 6), ('wind_drag', 'f8', 2), ('wind_arm', 'f8'),
    ('has_quadratic', 'i8'), ('added_mass', 'f8', 6), ('has_added_mass', 'i8'),
    ('wet_axis_1', 'f8', 3), ('wet_axis_2', 'f8', 3), ('wet_axis_3', 'f8', 3),
    ('follows_waves', 'i8'), ('middle', 'f8', 2), ('per_yy', 'f8'), ('per_xx', 'f8'),
    ('per_rr', 'f8'),
    ('corners', 'i8'), ('triangles', 'i8'), ('specific_weight', 'f8'), ('max_lift', 'f8'),
    ('reach', 'f8')])
# Place m, most lift N, depth m at which it is reached, and share of the budget.
PROBE = np.dtype([('x', 'f8'), ('y', 'f8'), ('z', 'f8'), ('max_force', 'f8'), ('height', 'f8'),
                  ('share', 'f8'), ('along', 'f8'), ('across', 'f8'),
                  ('waterplane', 'f8')])

SYMMETRIC = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


class HullView(NamedTuple):
    """
    A hull as the step reads it, and what it writes of it.

    Read: ``probes`` (n,) records of `PROBE`; ``corners``, rows x, y, z in m, and ``triangles``,
    rows of the numbers of their first, second and third corners, of a hull of panels; ``decay``
    (n, 4, W), how waves die out down to the probes, see `forces.wave_force`, or empty.
    Written: ``depths`` (n,) m of the probes; ``places`` of the corners, rows x, y, z from the
    centre of mass in world axes, depth and head of pressure, m.
    """

    probes: object
    corners: object
    triangles: object
    decay: object
    depths: object
    places: object


def boat_record(boat):
    """Return a `Boat` as a record of `BOAT`."""
    water, air = boat.retention_damping
    (moments, axes), (_, wet_axes) = boat.principal, boat.wet_principal
    middle, _, spread = waterplane(boat)
    damping, hull, (corners, triangles) = boat.damping, boat.hull, boat.panel_rows
    reach = np.linalg.norm(corners, axis=0).max(initial=0.0)
    return np.array((
        boat.mass, boat.weight, boat.center_of_mass, symmetric(boat.inertia),
        moments, *axes.T, LAWS.index(hull.law), damping.probe,
        np.diag(water)[:3], symmetric(water[3:, 3:]), np.diag(air)[:3], symmetric(air[3:, 3:]),
        damping.linear, damping.quadratic, damping.wind[:2], damping.wind_arm,
        damping.quadratic.any() or damping.wind.any(), boat.added_mass, boat.added_mass.any(),
        *wet_axes.T, boat.follows_waves, middle, *spread, corners.shape[1], triangles.shape[1],
        hull.specific_weight, hull.max_lift, reach), BOAT)


def waterplane(boat):
    """
    Return what the probes tell of a waterplane, all by their parts of it at rest.

    Its middle (2,) m from the centre of mass, the probes (n, 2) m from there, and 1/m^2, one over
    their mean squares across, along and both; 0 where all stand in a line.
    """
    places, part = boat.probe_offsets[:, :2], boat.waterplane_parts
    middle = part @ places
    away = places - middle
    xx, yy = part @ away ** 2
    squares = np.array([yy, xx, xx + yy])
    real = squares > 1e-12 * (xx + yy)
    return middle, away, np.where(real, 1.0 / np.where(real, squares, 1.0), 0.0)


def probe_records(boat):
    """Return the probes of a `Boat` as records (n,) of `PROBE`."""
    hull = boat.hull
    records = np.empty(len(hull.share), PROBE)
    records['x'], records['y'], records['z'] = boat.probe_offsets.T
    records['max_force'], records['height'], records['share'] = (
        hull.max_force, hull.height, hull.share)
    records['along'], records['across'] = waterplane(boat)[1].T
    records['waterplane'] = boat.waterplane_parts
    return records


def panel_rows(boat):
    """Return corners (3, n) m and triangles (3, m) of the panels of a `Boat`, see `HullView`."""
    panels = boat.hull.panels
    if panels is None:
        return np.zeros((3, 0)), np.zeros((3, 0), np.int64)
    return ((panels.corners - boat.center_of_mass).T.copy(), panels.triangles.T.copy())


def hull_view(boat, plain):
    """
    Return the `HullView` of a `Boat` in still water.

    Arrays, or lists and named tuples for plain Python.
    """
    corners, triangles = boat.panel_rows
    depths, places = np.zeros(len(boat.hull.share)), np.zeros((5, corners.shape[1]))
    still = np.zeros((len(depths), 4, 0))
    if plain:
        return HullView(boat.plain_records[1], *boat.plain_records[2:], still.tolist(),
                        depths.tolist(), places.tolist())
    return HullView(boat.probe_records, corners, triangles, still, depths, places)


def symmetric(matrix):
    """Return the six numbers of a symmetric matrix (3, 3)."""
    return [matrix[place] for place in SYMMETRIC]


def readable(records):
    """Return records (...) as nested lists of named tuples of floats, for plain Python."""
    if not records.dtype.names:
        return tuple(records.tolist()) if records.ndim else records.item()
    if records.ndim:
        return [readable(part) for part in records]
    row = _row(records.dtype.names)
    return row(*(readable(records[name]) for name in row._fields))


@lru_cache(maxsize=None)
def _row(names):
    return namedtuple('Record', names)
