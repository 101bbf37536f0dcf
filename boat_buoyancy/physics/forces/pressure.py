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
Pressure: the water's lift on the wetted surface of a hull, triangle by triangle, at any heel.

Water weighs on what is under it and bears what is over it: a triangle whose area seen from above
is a (above 0 where it faces up) at depths d lifts by -rho g integral(d) da.  Over a closed surface
that is the weight of the water that the hull takes the place of, through its centre (Archimedes):
exact in still water for any mesh; in waves the surface is taken as flat over each triangle.
"""

import math

from ..compiled import compiled
from ..rotation import to_body, to_world
from ..sea.waves import add_elevation
from ..vectors import add, add_scaled, add_scaled_matrix, outer, scale, scale_matrix

# The rows of `HullView.places`, and what a corner is read as.
X, Y, Z, DEPTH, HEAD = range(5)


@compiled
def pressure(boat, hull, sea, waves, R, position, t, weight):
    """
    Return force N and torque N m of the water's pressure about the centre of mass, body axes.

    Of a boat at ``position`` turned by ``R``; ``weight`` as of `surface`.  Writes
    ``hull.places``.
    """
    place_corners(boat, hull, sea, waves, R, position, t, weight)
    first, second, third = hull.triangles[0], hull.triangles[1], hull.triangles[2]
    volume = along = across = 0.0
    for i in range(boat.triangles):
        count, a, b, c, d = wet_part(hull.places, first[i], second[i], third[i])
        if count > 0:
            v, x, y = column_over(a, b, c)
            volume, along, across = volume + v, along + x, across + y
        if count > 1:
            v, x, y = column_over(a, c, d)
            volume, along, across = volume + v, along + x, across + y
    per_volume = boat.specific_weight
    return capped(boat, R, per_volume * volume, per_volume * across, -per_volume * along)


@compiled
def place_corners(boat, hull, sea, waves, R, position, t, weight):
    """Write where the corners are in the world, from the centre of mass, and how deep."""
    corner_places(boat, hull, R, position)
    add_elevation(waves, sea.waves, position, hull.places[X], hull.places[Y], boat.corners, t,
                  weight, hull.places[DEPTH])


@compiled
def corner_places(boat, hull, R, position):
    """Write where the corners are, and how deep below the mean water."""
    cx, cy, cz = hull.corners[0], hull.corners[1], hull.corners[2]
    x, y, z, depth = hull.places[X], hull.places[Y], hull.places[Z], hull.places[DEPTH]
    for i in range(boat.corners):
        x[i], y[i], z[i] = to_world(R, (cx[i], cy[i], cz[i]))
        depth[i] = -(position[2] + z[i])


@compiled
def corner(places, i):
    """Return x, y, z from the centre of mass, depth and head, m, of a corner."""
    return (places[X][i], places[Y][i], places[Z][i], places[DEPTH][i], places[HEAD][i])


@compiled
def wet_part(places, i, j, k):
    """Return how many triangles the wet part of a triangle is, and its corners a, b, c, d."""
    a, b, c = corner(places, i), corner(places, j), corner(places, k)
    wet = int(a[DEPTH] > 0.0) + int(b[DEPTH] > 0.0) + int(c[DEPTH] > 0.0)
    if wet == 3:
        return 1, a, b, c, c
    if wet == 0:
        return 0, a, b, c, c
    # Turned until the first corner is the only wet one or, of two, the only dry one.
    lone = wet == 1
    if (b[DEPTH] > 0.0) == lone:
        a, b, c = b, c, a
    elif (c[DEPTH] > 0.0) == lone:
        a, b, c = c, a, b
    ab, ac = waterline(a, b), waterline(a, c)
    if lone:
        return 1, a, ab, ac, ac
    return 2, ab, b, c, ac


@compiled
def waterline(a, b):
    """Return where the edge from a to b meets the water."""
    s = a[DEPTH] / (a[DEPTH] - b[DEPTH])
    return (a[X] + s * (b[X] - a[X]), a[Y] + s * (b[Y] - a[Y]), a[Z] + s * (b[Z] - a[Z]), 0.0,
            0.0)


@compiled
def covered_area(a, b, c):
    """Return the area in m^2 of a triangle seen from below, below 0 where it faces up."""
    return 0.5 * ((c[X] - a[X]) * (b[Y] - a[Y]) - (b[X] - a[X]) * (c[Y] - a[Y]))


@compiled
def column_over(a, b, c):
    """
    Return the volume over a wet triangle up to the water, and its moments along x and y.

    integral(d) = A / 3 sum d_i, integral(x d) = A / 12 sum x_i (d_i + sum d).
    """
    total = a[DEPTH] + b[DEPTH] + c[DEPTH]
    p, q, r = total + a[DEPTH], total + b[DEPTH], total + c[DEPTH]
    twelfth = covered_area(a, b, c) / 12.0
    return (4.0 * twelfth * total, twelfth * (a[X] * p + b[X] * q + c[X] * r),
            twelfth * (a[Y] * p + b[Y] * q + c[Y] * r))


@compiled
def capped(boat, R, lift, roll, pitch):
    """
    Return force and torque, body axes, of a lift N and its torque N m about world x and y.

    Never more lift than that of the whole hull, never from beyond its farthest corner: what the
    speed bound counts on, where waves too short for the triangles would say otherwise.
    """
    allowed = min(max(lift, 0.0), boat.max_lift)
    part = allowed / lift if lift > 0.0 else 0.0
    lever, longest = part * math.sqrt(roll * roll + pitch * pitch), allowed * boat.reach
    if lever > longest:
        part *= longest / lever
    return scale(allowed, R[2]), to_body(R, (part * roll, part * pitch, 0.0))


@compiled
def pressure_stiffness(boat, hull, R):
    """
    Return K+, the positive part of the stiffness of pressure, as `lift_stiffness` has it.

    K+ = rho g integral(g g^T) dA over the waterplane, g = (up, p x up).
    """
    area, along, across, xx, yy, xy, swing = waterplane_sums(boat, hull)
    if not area > 0.0:
        area = along = across = xx = yy = xy = 0.0
    # About the middle of the waterplane; in waves the triangles may leave less than nothing.
    x, y = along / (area + 1e-300), across / (area + 1e-300)
    xx, yy, xy = max(xx - along * x, 0.0), max(yy - across * y, 0.0), xy - along * y
    xy = min(max(xy, -math.sqrt(xx * yy)), math.sqrt(xx * yy))
    ahead, port, up = R
    # p x up of a place x ahead, y port is y ahead - x port.
    around = add_scaled(scale(y, ahead), -x, port)
    torque = scale_matrix(area, outer(around))
    torque = add_scaled_matrix(torque, yy + xy, outer(ahead))
    torque = add_scaled_matrix(torque, xx + xy, outer(port))
    torque = add_scaled_matrix(torque, -xy, outer(add(ahead, port)))
    swing = max(swing, 0.0)
    torque = add_scaled_matrix(torque, swing, (1.0, 1.0, 1.0, 0.0, 0.0, 0.0))
    torque = add_scaled_matrix(torque, -swing, outer(up))
    per_volume = boat.specific_weight
    return per_volume * area, scale(per_volume * area, around), scale_matrix(per_volume, torque)


@compiled
def waterplane_sums(boat, hull):
    """
    Return a waterplane's area, its moments x, y, xx, yy, xy, and the moment z of the wet volume.

    From the centre of mass in world axes, in powers of m, at the places that `pressure` wrote.
    The waterplane has the outline of the wet triangles, so they have its moments, seen from below.
    """
    first, second, third = hull.triangles[0], hull.triangles[1], hull.triangles[2]
    sums = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for i in range(boat.triangles):
        count, a, b, c, d = wet_part(hull.places, first[i], second[i], third[i])
        if count > 0:
            sums = add_outline(sums, a, b, c)
        if count > 1:
            sums = add_outline(sums, a, c, d)
    return sums


@compiled
def add_outline(sums, a, b, c):
    """
    Return the sums of `waterplane_sums` with a triangle added.

    integral(x y) = A / 12 (sum x_i y_i + sum x sum y); the volume over the triangle lies at half
    its depth over it: integral((z + d / 2) d).
    """
    area = covered_area(a, b, c)
    twelfth = area / 12.0
    x, y = a[X] + b[X] + c[X], a[Y] + b[Y] + c[Y]
    z, d = a[Z] + b[Z] + c[Z], a[DEPTH] + b[DEPTH] + c[DEPTH]
    return (
        sums[0] + area, sums[1] + 4.0 * twelfth * x, sums[2] + 4.0 * twelfth * y,
        sums[3] + twelfth * (a[X] * a[X] + b[X] * b[X] + c[X] * c[X] + x * x),
        sums[4] + twelfth * (a[Y] * a[Y] + b[Y] * b[Y] + c[Y] * c[Y] + y * y),
        sums[5] + twelfth * (a[X] * a[Y] + b[X] * b[Y] + c[X] * c[Y] + x * y),
        sums[6] + twelfth * (
            a[Z] * a[DEPTH] + b[Z] * b[DEPTH] + c[Z] * c[DEPTH] + z * d + 0.5 * (
                a[DEPTH] * a[DEPTH] + b[DEPTH] * b[DEPTH] + c[DEPTH] * c[DEPTH] + d * d)))
