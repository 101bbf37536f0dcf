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

"""Small vectors as tuples, and the symmetric 3 x 3 matrices of rigid bodies as six numbers."""

from .compiled import compiled

ZERO = (0.0, 0.0, 0.0)


@compiled
def three(a):
    """Return the first three of some numbers as a vector."""
    return (a[0], a[1], a[2])


@compiled
def six(a):
    """Return the first six of some numbers as a symmetric matrix xx, yy, zz, xy, xz, yz."""
    return (a[0], a[1], a[2], a[3], a[4], a[5])


@compiled
def add(a, b):
    """Return a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@compiled
def subtract(a, b):
    """Return a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@compiled
def scale(s, a):
    """Return s a."""
    return (s * a[0], s * a[1], s * a[2])


@compiled
def add_scaled(a, s, b):
    """Return a + s b."""
    return (a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2])


@compiled
def dot(a, b):
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def cross(a, b):
    """Return a x b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@compiled
def multiply(a, b):
    """Return a b, component by component."""
    return (a[0] * b[0], a[1] * b[1], a[2] * b[2])


@compiled
def divide(a, b):
    """Return a / b, component by component."""
    return (a[0] / b[0], a[1] / b[1], a[2] / b[2])


@compiled
def diagonal(a):
    """Return the symmetric matrix with a on its diagonal."""
    return (a[0], a[1], a[2], 0.0, 0.0, 0.0)


@compiled
def scale_matrix(s, a):
    """Return s A of a symmetric matrix."""
    return (s * a[0], s * a[1], s * a[2], s * a[3], s * a[4], s * a[5])


@compiled
def add_scaled_matrix(a, s, b):
    """Return A + s B of symmetric matrices."""
    return (a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2],
            a[3] + s * b[3], a[4] + s * b[4], a[5] + s * b[5])


@compiled
def outer(a):
    """Return the symmetric matrix a a^T."""
    return (a[0] * a[0], a[1] * a[1], a[2] * a[2], a[0] * a[1], a[0] * a[2], a[1] * a[2])


@compiled
def times(matrix, v):
    """Return the product of a symmetric matrix and a vector."""
    xx, yy, zz, xy, xz, yz = matrix
    return (xx * v[0] + xy * v[1] + xz * v[2],
            xy * v[0] + yy * v[1] + yz * v[2],
            xz * v[0] + yz * v[1] + zz * v[2])


@compiled
def factor(matrix):
    """
    Return L and 1 / D of a symmetric positive definite A = L D L^T, for `solve_factored`.

    Without pivoting (Golub and Van Loan, Matrix Computations, 4.1): backward stable however far
    apart the eigenvalues are, which Cramer's rule is not.
    """
    xx, yy, zz, xy, xz, yz = matrix
    ix = 1.0 / xx
    ly, lz = xy * ix, xz * ix
    iy = 1.0 / (yy - ly * xy)
    rest = yz - lz * xy
    lyz = rest * iy
    return ix, iy, 1.0 / (zz - lz * xz - lyz * rest), ly, lz, lyz


@compiled
def solve_factored(factors, v):
    """Return x of A x = v."""
    ix, iy, iz, ly, lz, lyz = factors
    y = v[1] - ly * v[0]
    z = (v[2] - lz * v[0] - lyz * y) * iz
    y = y * iy - lyz * z
    return (v[0] * ix - ly * y - lz * z, y, z)
