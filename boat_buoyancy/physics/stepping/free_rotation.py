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
Free rotation of a rigid body over one step, by exact turns about its principal axes.

Dullweber, Leimkuhler, McLachlan, Symplectic splitting methods for rigid body molecular dynamics,
J. Chem. Phys. 107 (1997): the five turns R1(h/2) R2(h/2) R3(h) R2(h/2) R1(h/2), each by
h L_a / I_a and turning the body-frame angular momentum back, keep its length to round-off and
let the energy oscillate as h^2 without drift.
"""

import math

from ..compiled import compiled, FUSED
from ..rotation import normalise, product
from ..trigonometry import EIGHTH_TURN, sine_cosine, sine_cosine_of_eighth
from ..vectors import add_scaled, dot, scale

# Moments this close to each other are those of a sphere.
EQUAL = 1e-12


@compiled(arithmetic=FUSED)
def turn(a, b, c, w, mb, mc, half):
    """
    Turn the rotation a, b, c, w about its axis a by 2 half, and the momentum back.

    q <- q (sin half, 0, 0, cos half), with mb and mc the momentum about the other two axes.
    """
    s, k = sine_cosine_of_eighth(half) if abs(half) < EIGHTH_TURN else sine_cosine(half)
    sine, cosine = 2.0 * s * k, 1.0 - 2.0 * s * s
    return (a * k + w * s, b * k + c * s, c * k - b * s, w * k - a * s,
            cosine * mb + sine * mc, cosine * mc - sine * mb)


@compiled
def free_rotation(moments, axes, orientation, angular_velocity, h):
    """
    Return orientation and angular velocity (body axes) after h s without any torque.

    ``moments`` (3) kg m^2, best in rising order, about the three ``axes``, each (3).
    """
    i1, i2, i3 = moments
    if max(i1, i2, i3) - min(i1, i2, i3) <= EQUAL * i3:
        # Three equal moments: one turn about a fixed axis is the motion itself.
        speed = math.sqrt(dot(angular_velocity, angular_velocity))
        s, c = sine_cosine(0.5 * h * speed)
        # The tiny number keeps a body at rest from 0 / 0 and changes no other.
        x, y, z = scale(s / (speed + 1e-300), angular_velocity)
        return normalise(product(orientation, (x, y, z, c))), angular_velocity

    # Along the principal axes, where r is the rotation since the start of the step.
    a1, a2, a3 = axes
    l1, l2, l3 = (i1 * dot(a1, angular_velocity), i2 * dot(a2, angular_velocity),
                  i3 * dot(a3, angular_velocity))
    quarter_1, quarter_2, half_3 = 0.25 * h / i1, 0.25 * h / i2, 0.5 * h / i3
    r1, r2, r3, w, l2, l3 = turn(0.0, 0.0, 0.0, 1.0, l2, l3, quarter_1 * l1)
    r2, r3, r1, w, l3, l1 = turn(r2, r3, r1, w, l3, l1, quarter_2 * l2)
    r3, r1, r2, w, l1, l2 = turn(r3, r1, r2, w, l1, l2, half_3 * l3)
    r2, r3, r1, w, l3, l1 = turn(r2, r3, r1, w, l3, l1, quarter_2 * l2)
    r1, r2, r3, w, l2, l3 = turn(r1, r2, r3, w, l2, l3, quarter_1 * l1)

    x, y, z = add_scaled(add_scaled(scale(r1, a1), r2, a2), r3, a3)
    spin = add_scaled(add_scaled(scale(l1 / i1, a1), l2 / i2, a2), l3 / i3, a3)
    return normalise(product(orientation, (x, y, z, w))), spin
