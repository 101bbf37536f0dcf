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
Small symmetric positive definite systems in components, for one boat and fleets alike.

LDL^T without pivoting (Golub and Van Loan, Matrix Computations, 4.1), of 3 x 3 matrices and of
6 x 6 ones in 3 x 3 blocks.  Symmetric matrices are six components xx, yy, zz, xy, xz, yz.
"""


def factor_ldl_3(xx, yy, zz, xy, xz, yz):
    """Return the factors of a symmetric positive definite 3 x 3 matrix for `solve_ldl_3`."""
    ly, lz = xy / xx, xz / xx
    dy = yy - ly * xy
    cross = yz - lz * xy
    lyz = cross / dy
    return xx, dy, zz - lz * xz - lyz * cross, ly, lz, lyz


def solve_ldl_3(factors, x, y, z):
    """Return the solution (3) for a right side x, y, z."""
    dx, dy, dz, ly, lz, lyz = factors
    y = y - ly * x
    z = (z - lz * x - lyz * y) / dz
    y = y / dy - lyz * z
    return x / dx - ly * y - lz * z, y, z


def factor_blocks(force, coupling, torque):
    """
    Return the factors of the 6 x 6 matrix [[force, coupling^T], [coupling, torque]].

    ``force`` and ``torque`` are symmetric (6), ``coupling`` is (9), row by row: what a velocity
    contributes to the torque.
    """
    factors = factor_ldl_3(*force)
    rows = coupling[:3], coupling[3:6], coupling[6:]
    solved = [solve_ldl_3(factors, *row) for row in rows]

    def left(i, j):
        (a, b, c), (x, y, z) = rows[i], solved[j]
        return a * x + b * y + c * z

    xx, yy, zz, xy, xz, yz = torque
    return factors, coupling, solved, factor_ldl_3(
        xx - left(0, 0), yy - left(1, 1), zz - left(2, 2),
        xy - left(0, 1), xz - left(0, 2), yz - left(1, 2))


def solve_blocks(factors, force, torque):
    """Return the two halves (3), (3) of the solution for the right side (force, torque)."""
    upper, (a, b, c, d, e, f, g, h, i), (p, q, r), lower = factors
    x, y, z = solve_ldl_3(upper, *force)
    tx, ty, tz = torque
    wx, wy, wz = solve_ldl_3(lower, tx - (a * x + b * y + c * z), ty - (d * x + e * y + f * z),
                             tz - (g * x + h * y + i * z))
    return (x - (p[0] * wx + q[0] * wy + r[0] * wz), y - (p[1] * wx + q[1] * wy + r[1] * wz),
            z - (p[2] * wx + q[2] * wy + r[2] * wz)), (wx, wy, wz)


def symmetric_product(matrix, vector):
    """Return A v of a symmetric 3 x 3 matrix xx, yy, zz, xy, xz, yz."""
    xx, yy, zz, xy, xz, yz = matrix
    x, y, z = vector
    return (xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z)
