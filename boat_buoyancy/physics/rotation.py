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
Free rotation of a rigid body over one step, by exact rotations about its principal axes.

Dullweber, Leimkuhler, McLachlan, Symplectic splitting methods for rigid body molecular dynamics,
J. Chem. Phys. 107 (1997): the five rotations R1(h/2) R2(h/2) R3(h) R2(h/2) R1(h/2), each turning
by h L_a / I_a and turning the body-frame angular momentum back, keep its length to round-off and
let the energy oscillate as h^2 without drift.
"""

from functools import partial

import numpy as np

from .quaternion import conjugate, multiply, normalise, rotation_matrix, to_body, to_world


def _turn(sin, cos, half, a, b, c, w, mb, mc):
    """
    Turn about the axis a by twice ``half``.

    a, b, c, w is the quaternion, mb and mc the momentum about the other two axes; the same six
    are returned after the turn.
    """
    s, k = sin(half), cos(half)
    sine, cosine = 2.0 * s * k, 1.0 - 2.0 * s * s
    return (a * k + w * s, b * k + c * s, c * k - b * s, w * k - a * s,
            cosine * mb + sine * mc, cosine * mc - sine * mb)


def _five_turns(backend, orientation, momentum, h, moments):
    """Return orientation and momentum after the five rotations about axes 1, 2 and 3."""
    (a, b, c, w), (ma, mb, mc) = orientation, momentum
    about_a, about_b, about_c = (0.25 * h / moments[0], 0.25 * h / moments[1],
                                 0.5 * h / moments[2])
    sin, cos = backend.sin, backend.cos
    a, b, c, w, mb, mc = _turn(sin, cos, about_a * ma, a, b, c, w, mb, mc)
    b, c, a, w, mc, ma = _turn(sin, cos, about_b * mb, b, c, a, w, mc, ma)
    c, a, b, w, ma, mb = _turn(sin, cos, about_c * mc, c, a, b, w, ma, mb)
    b, c, a, w, mc, ma = _turn(sin, cos, about_b * mb, b, c, a, w, mc, ma)
    a, b, c, w, mb, mc = _turn(sin, cos, about_a * ma, a, b, c, w, mb, mc)
    return (a, b, c, w), (ma, mb, mc)


def _rotate_principal(backend, orientation, angular_velocity, h, *, moments, order, back, sign):
    """
    Rotate a body whose principal axes are its body axes, taken in ``order``.

    ``moments`` are in that order and ``back`` undoes it; ``sign`` is -1 for an order of odd
    parity, where turning the third axis round makes the three right-handed again.
    """
    i, j, k = order
    first, second, third = moments
    (a, b, c, w), (x, y, z) = _five_turns(
        backend, (orientation[i], orientation[j], sign * orientation[k], orientation[3]),
        (first * angular_velocity[i], second * angular_velocity[j],
         sign * third * angular_velocity[k]), h, moments)
    turned, spin = (a, b, sign * c), (x / first, y / second, sign * z / third)
    i, j, k = back
    return (normalise(backend, (turned[i], turned[j], turned[k], w)),
            (spin[i], spin[j], spin[k]))


def _rotate_turned(backend, orientation, angular_velocity, h, *, moments, axes, matrix):
    """Rotate a body whose principal axes, the quaternion ``axes``, are not its body axes."""
    q, w = _rotate_principal(backend, multiply(orientation, axes),
                             to_body(matrix, angular_velocity), h,
                             moments=moments, order=(0, 1, 2), back=(0, 1, 2), sign=1.0)
    return multiply(q, conjugate(axes)), to_world(matrix, w)


def _rotate_sphere(backend, orientation, angular_velocity, h):
    """Rotate a body with three equal moments: one rotation about a fixed axis."""
    x, y, z = angular_velocity
    speed = backend.sqrt(x * x + y * y + z * z)
    half = 0.5 * h * speed
    # The tiny number keeps a body at rest from 0 / 0 and changes no other.
    scale = backend.sin(half) / (speed + 1e-300)
    q = multiply(orientation, (x * scale, y * scale, z * scale, backend.cos(half)))
    return normalise(backend, q), angular_velocity


def free_rotation(boat):
    """
    Return the function (backend, orientation, angular_velocity, h) -> the same two after h s.

    ``angular_velocity`` is in body axes.  Chosen once per boat from its inertia.
    """
    moments, axes = boat.principal
    if moments[2] - moments[0] <= 1e-12 * moments[2] and not (
            boat.inertia - np.diag(np.diag(boat.inertia))).any():
        return _rotate_sphere
    # Principal axes along the body axes: columns of the identity in some order.
    if np.array_equal(np.sort(axes.ravel()), [0] * 6 + [1] * 3):
        order = tuple(int(axis) for axis in np.argmax(axes, axis=0))
        return partial(_rotate_principal, order=order, moments=tuple(moments.tolist()),
                       back=tuple(np.argsort(order).tolist()),
                       sign=float(np.linalg.det(axes)))
    quaternion = _quaternion_of(axes)
    return partial(_rotate_turned, moments=tuple(moments.tolist()), axes=quaternion,
                   matrix=rotation_matrix(quaternion))


def _quaternion_of(matrix):
    """Return the unit quaternion of a rotation matrix (3, 3)."""
    # The quaternion is the eigenvector of largest eigenvalue of this symmetric matrix
    # (Bar-Itzhack 2000), which needs no case by case and is exact to round-off.
    a, b, c, d, e, f, g, h, i = matrix.ravel()
    _, vectors = np.linalg.eigh(np.array([
        [a - e - i, d + b, g + c, h - f],
        [d + b, e - a - i, h + f, c - g],
        [g + c, h + f, i - a - e, d - b],
        [h - f, c - g, d - b, a + e + i]]))
    return tuple(vectors[:, -1].tolist())
