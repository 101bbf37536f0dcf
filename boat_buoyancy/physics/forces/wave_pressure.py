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
Wave pressure: the water's pressure on the wetted surface in waves that die out with depth.

rho g (-z + sum a D cos theta) at the corners, D = cosh(k (h + z)) / cosh(kh) below z = 0 and 1
above (Froude and Krylov, up to the surface), linear over each triangle: force -integral(p n) dA.
In still water that is Archimedes' lift, to round-off, and where waves are long its slope pushes.
"""

import math

from .pressure import corner_places, DEPTH, HEAD, wet_part, X, Y, Z
from ..compiled import compiled, FUSED
from ..rotation import to_body
from ..sea.waves import BOTTOM, FREQUENCY, KX, KY, PHASE, RISE, START
from ..trigonometry import decay, sine_cosine
from ..vectors import add, add_scaled, cross, dot, scale, ZERO


@compiled
def wave_pressure(boat, hull, sea, waves, R, position, t, weight):
    """Return force N and torque N m of the water's pressure, as `pressure` does."""
    corner_places(boat, hull, R, position)
    add_heads(waves, sea.waves, position, hull.places, boat.corners, t, weight)
    first, second, third = hull.triangles[0], hull.triangles[1], hull.triangles[2]
    force, torque = ZERO, ZERO
    for i in range(boat.triangles):
        count, a, b, c, d = wet_part(hull.places, first[i], second[i], third[i])
        if count > 0:
            push, turn = pressed(a, b, c)
            force, torque = add(force, push), add(torque, turn)
        if count > 1:
            push, turn = pressed(a, c, d)
            force, torque = add(force, push), add(torque, turn)
    force, torque = scale(boat.specific_weight, force), scale(boat.specific_weight, torque)
    return within_bounds(boat, R, force, torque)


@compiled(arithmetic=FUSED)
def add_heads(waves, number, origin, places, points, t, weight):
    """Add the waves to depth and head of the first ``points`` corners, as `add_elevation` does."""
    x, y, z, depth, head = places[X], places[Y], places[Z], places[DEPTH], places[HEAD]
    for i in range(points):
        head[i] = depth[i]
    for j in range(number):
        amplitude = waves[START][j] + weight * waves[RISE][j]
        kx, ky, frequency = waves[KX][j], waves[KY][j], waves[FREQUENCY][j]
        k = math.sqrt(kx * kx + ky * ky)
        here = kx * origin[0] + ky * origin[1] - frequency * t + waves[PHASE][j]
        q = waves[BOTTOM][j]
        least = math.sqrt(q) + 1e-300
        for i in range(points):
            _, cosine = sine_cosine(kx * x[i] + ky * y[i] + here)
            # D = (E + q / E) / (1 + q), E = e^(kz), q = e^(-2kh); no corner is below the bottom.
            down = max(decay(k * min(origin[2] + z[i], 0.0)), least)
            depth[i] += amplitude * cosine
            head[i] += amplitude * cosine * (down + q / down) / (1.0 + q)


@compiled
def pressed(a, b, c):
    """
    Return force and torque, world axes, over rho g, of the head on a wet triangle.

    -S mean(p), S the area vector outwards, and -(sum r_i (p_i + sum p) / 12) x S.
    """
    ab = (b[X] - a[X], b[Y] - a[Y], b[Z] - a[Z])
    ac = (c[X] - a[X], c[Y] - a[Y], c[Z] - a[Z])
    inwards = scale(-0.5, cross(ab, ac))
    total = a[HEAD] + b[HEAD] + c[HEAD]
    lever = add_scaled(add_scaled(scale((total + a[HEAD]) / 12.0, (a[X], a[Y], a[Z])),
                                  (total + b[HEAD]) / 12.0, (b[X], b[Y], b[Z])),
                       (total + c[HEAD]) / 12.0, (c[X], c[Y], c[Z]))
    return scale(total / 3.0, inwards), cross(lever, inwards)


@compiled
def within_bounds(boat, R, force, torque):
    """
    Return force and torque, body axes, of those in world axes.

    What the speed bound counts on: never more than a slope of one would push the whole hull,
    half of it along and half up, and never from beyond its farthest corner.
    """
    size = math.sqrt(dot(force, force))
    force = scale(min(math.sqrt(2.0) * boat.max_lift / (size + 1e-300), 1.0), force)
    lever, longest = math.sqrt(dot(torque, torque)), math.sqrt(dot(force, force)) * boat.reach
    return to_body(R, force), to_body(R, scale(min(longest / (lever + 1e-300), 1.0), torque))
