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
Wave force: what a wave does to a hull below the surface (Froude and Krylov).

The pressure of a wave dies out with depth and pushes along its slope; the water's own motion, as a
twist of the whole hull, drags it along and, by the added mass, takes it along as it gets faster.
Linear waves at the hull's depth at rest (Newman, Marine Hydrodynamics, 1977, 6.4 and 6.16).
"""

import math
from typing import NamedTuple

import numpy as np

from .buoyancy import point_of_force
from .probe_laws import wetting
from ..compiled import compiled, REORDERED
from ..rotation import to_body
from ..sea.waves import ALONG_X, ALONG_Y, BOTTOM, FREQUENCY, INTRINSIC, KX, KY, PHASE, RISE, START
from ..trigonometry import sine_cosine
from ..vectors import add, add_scaled, cross, subtract

PRESSURE, SLOPE, ALONG, UP = range(4)
# What is steeper than that breaks: no hull is pushed along by more than its lift.
STEEPEST = 1.0


class WaterMotion(NamedTuple):
    """
    What the waves do at one probe, in world axes.

    ``elevation`` m of the surface; ``felt`` m, the height that the pressure at the probe's depth
    is worth; ``slope`` (2), the mean over the depth; ``velocity`` (3) m/s and ``acceleration``
    (3) m/s^2 of the water, horizontal at half the depth and vertical at the depth.
    """

    elevation: float
    felt: float
    slope: tuple
    velocity: tuple
    acceleration: tuple


@compiled(arithmetic=REORDERED)
def water_motion(waves, decay, number, x, y, t, weight, rate):
    """
    Return the `WaterMotion` at a place and time; arguments as of `sea.waves.surface`.

    felt = sum a P cos theta, slope = -sum a k S sin theta, u = sum a A s / tanh(k h) cos theta,
    w = sum a U s sin theta, s the intrinsic frequency, and their changes for a hull that the
    current carries along; P, S, A, U of ``decay``, see `wave_decay`.
    """
    kx, ky, frequency, phase = waves[KX], waves[KY], waves[FREQUENCY], waves[PHASE]
    start, rise, intrinsic = waves[START], waves[RISE], waves[INTRINSIC]
    along_x, along_y = waves[ALONG_X], waves[ALONG_Y]
    pressure, mean, along, up = decay[PRESSURE], decay[SLOPE], decay[ALONG], decay[UP]
    eta = felt = sx = sy = u = v = w = au = av = aw = 0.0
    for j in range(number):
        theta = kx[j] * x + ky[j] * y - frequency[j] * t + phase[j]
        sine, cosine = sine_cosine(theta)
        amplitude = start[j] + weight * rise[j]
        eta += amplitude * cosine
        felt += amplitude * pressure[j] * cosine
        steep = amplitude * mean[j] * sine
        sx -= kx[j] * steep
        sy -= ky[j] * steep
        moving = amplitude * along[j] * cosine
        u += along_x[j] * moving
        v += along_y[j] * moving
        faster = amplitude * along[j] * intrinsic[j] * sine
        au += along_x[j] * faster
        av += along_y[j] * faster
        rising = amplitude * up[j] * intrinsic[j]
        w += rising * sine + rate * rise[j] * up[j] * cosine
        aw -= intrinsic[j] * rising * cosine
    part = STEEPEST / max(math.sqrt(sx * sx + sy * sy), STEEPEST)
    return WaterMotion(eta, felt, (part * sx, part * sy), (u, v, w), (au, av, aw))


class Twist(NamedTuple):
    """A motion of the water as one of the whole hull: ``linear`` (3) and ``angular`` (3)."""

    linear: tuple
    angular: tuple


@compiled
def add_to_twist(boat, twist, probe, velocity):
    """
    Return a `Twist` with the water's velocity (3) at a probe added, body axes.

    Least squares over the waterplane, s a probe's part of it and x, y from its middle: the mean
    velocity, and sum s y w / sum s y^2, -sum s x w / sum s x^2,
    sum s (x v - y u) / sum s (x^2 + y^2).
    """
    u, v, w = velocity
    along, across = probe.waterplane * probe.along, probe.waterplane * probe.across
    return Twist(add_scaled(twist.linear, probe.waterplane, velocity), add(twist.angular, (
        boat.per_yy * across * w, -boat.per_xx * along * w,
        boat.per_rr * (along * v - across * u))))


@compiled
def about_boat(boat, twist):
    """Return a `Twist` about the middle of the waterplane as one about the centre of mass."""
    middle = (boat.middle[0], boat.middle[1], 0.0)
    return Twist(subtract(twist.linear, cross(twist.angular, middle)), twist.angular)


@compiled
def wave_lift(law, probe, depth, slope, R):
    """
    Return force N and torque N m of one probe about the centre of mass, body axes.

    As `buoyancy`, of the ``depth`` m that it feels, and along the mean ``slope`` (2) of the
    water: F (-d eta/dx, -d eta/dy, 1).
    """
    wet, share = wetting(law, probe.height, depth, R[2][2])
    lift = probe.max_force * share
    force = to_body(R, (-lift * slope[0], -lift * slope[1], lift))
    return force, cross(point_of_force(law, probe, wet, R[2]), force)


def wave_decay(immersion, table):
    """
    Return how waves die out with depth, (n, 4, W), for probes that lie ``immersion`` (n,) m deep.

    Over what they are at the surface, of a wave in water of depth h at a depth d: PRESSURE
    cosh(k(h-d)) / cosh(kh), its mean from 0 to d SLOPE, ALONG cosh(k(h-d/2)) / cosh(kh) and UP
    sinh(k(h-d)) / sinh(kh); e^-kd and the like in deep water.  ``table`` as of `Water`.
    """
    k, bottom = np.hypot(table[KX], table[KY]), table[BOTTOM]
    tiny = np.finfo(float).tiny
    deep = k * np.asarray(immersion, float)[:, None]
    # No probe is below the bottom.
    kd = np.minimum(deep, -0.5 * np.log(np.maximum(bottom, tiny)))
    mean_over = np.maximum(np.where(bottom > 0.0, kd, deep), tiny)
    (down, up), (half_down, half_up) = ((np.exp(-part), bottom * np.exp(part))
                                        for part in (kd, 0.5 * kd))
    whole, least = 1.0 + bottom, np.maximum(1.0 - bottom, tiny)
    mean = (bottom * np.expm1(kd) - np.expm1(-kd)) / (mean_over * whole)
    return np.stack([(down + up) / whole, np.where(kd > tiny, mean, 1.0),
                     (half_down + half_up) / whole, (down - up) / least], axis=1)
