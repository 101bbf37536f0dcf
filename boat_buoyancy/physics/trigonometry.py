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
Sine, cosine and decay for the step: to round-off, and so that loops over waves become vector code.

Argument reduction by Cody and Waite (Software Manual for the Elementary Functions, 1980) and the
polynomials of Cephes, without a branch.
"""

from .compiled import compiled, FUSED

PER_QUADRANT = 0.6366197723675814  # 2 / pi
# Half pi in three parts, the first two short enough for exact products with whole numbers to 2^20.
HALF_PI_1, HALF_PI_2, HALF_PI_3 = (
    1.5707963267341256, 6.0771005063039660e-11, 2.0222662487959506e-21)
EIGHTH_TURN = 0.7853981633974483  # pi / 4
# Added and taken away again it leaves the nearest whole number, for numbers below 2^51.
ROUND = 1.5 * 2.0 ** 52


@compiled
def whole(x):
    """Return the whole number nearest to x, for |x| below 2^51."""
    return (x + ROUND) - ROUND


@compiled(arithmetic=FUSED)
def sine_cosine_of_eighth(r):
    """Return sine and cosine of an angle r of at most an eighth of a turn either way."""
    z = r * r
    zz = z * z
    s = ((-1.66666666666666307295e-1 + z * 8.33333333332211858878e-3)
         + zz * (-1.98412698295895385996e-4 + z * 2.75573136213857245213e-6)
         + zz * zz * (-2.50507477628578072866e-8 + z * 1.58962301576546568060e-10))
    c = ((4.16666666666665929218e-2 + z * -1.38888888888730564116e-3)
         + zz * (2.48015872888517045348e-5 + z * -2.75573141792967388112e-7)
         + zz * zz * (2.08757008419747316778e-9 + z * -1.13585353646876817300e-11))
    return r + r * z * s, 1.0 - 0.5 * z + zz * c


@compiled(arithmetic=FUSED)
def sine_cosine(angle):
    """Return sine and cosine of an angle in rad, within +-1 whatever the angle."""
    q = whole(angle * PER_QUADRANT)
    r = ((angle - q * HALF_PI_1) - q * HALF_PI_2) - q * HALF_PI_3
    # Beyond 2^51 quadrants an angle has no phase left; here it gets one.
    s, c = sine_cosine_of_eighth(min(max(r, -0.8), 0.8))
    # Odd quadrants swap sine and cosine; the signs follow the circle.
    quadrant = q - 4.0 * whole(0.25 * q - 0.375)
    odd = (quadrant - 2.0) * (quadrant - 2.0) == 1.0
    sine, cosine = c if odd else s, s if odd else c
    return (-sine if quadrant > 1.5 else sine,
            -cosine if 0.5 < quadrant < 2.5 else cosine)


@compiled(arithmetic=FUSED)
def decay(x):
    """Return e^x of x <= 0, to 1e-11 of it down to e^-20: (e^(x / 64))^64, by its series."""
    r = max(x, -40.0) * (1.0 / 64.0)
    z = r * r
    zz = z * z
    e = ((1.0 + r) + z * (1.0 / 2.0 + r * (1.0 / 6.0)) + zz * (
        (1.0 / 24.0 + r * (1.0 / 120.0)) + z * (1.0 / 720.0 + r * (1.0 / 5040.0)) + zz * (
            (1.0 / 40320.0 + r * (1.0 / 362880.0)) + z * (1.0 / 3628800.0))))
    e *= e
    e *= e
    e *= e
    e *= e
    e *= e
    return e * e
