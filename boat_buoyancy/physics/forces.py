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
The forces on a boat at one place and time, one function per phenomenon.

All wrenches are in body axes about the centre of mass.  Velocity-dependent forces are given as
a damping matrix and not as numbers, so that every step method can treat them its own way.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from . import laws
from .backend import Backend
from .boat import Boat
from .quaternion import cross, rotation_matrix, to_body
from .rotation import free_rotation

# Damping ramps in over this part of a probe's height: a jump at entry would leave every step
# method at first order.
RAMP = 0.1
# A mean wetness that is 1 but for round-off.
WET = 1.0 - 1e-13
STILL = (0.0, 0.0, 0.0)


class DampingMatrix(NamedTuple):
    """
    A symmetric 6 x 6 damping matrix in body axes, as the components that are not zero.

    ``linear`` (3) is the diagonal of the force block, ``coupling`` (3) the vector S of the force
    w x S and torque S x v, ``angular`` (6) the torque block xx, yy, zz, xy, xz, yz.
    """

    linear: tuple
    coupling: tuple
    angular: tuple


class Load(NamedTuple):
    """
    Everything a kick needs to know of one place and time.

    ``rotation`` (9) body to world; ``depth`` m of each probe and ``share`` of its maximum
    force; ``force`` N and ``torque`` N m: buoyancy, gravity and the pull of moving water;
    ``damping``; ``submersion`` the weighted mean wetness 0 to 1; ``water_velocity`` (3) m/s, the
    probes' mean, body axes.
    """

    rotation: tuple
    depth: np.ndarray
    share: np.ndarray
    force: tuple
    torque: tuple
    damping: DampingMatrix
    submersion: object
    water_velocity: tuple


@dataclass(frozen=True)
class ProbeArrays:
    """
    What the forces multiply: a boat's constants as arrays over its n probes.

    Rows are weights of sums over the probes; those of damping hold 1 / RAMP, so that a fraction
    cut off at ``ramp``, which is RAMP for each probe, is all the ramp they need.
    """

    homogeneous: np.ndarray
    heights: laws.Heights
    ramp: np.ndarray
    lift_rows: np.ndarray
    arm_row: np.ndarray
    above: np.ndarray
    half_height: np.ndarray
    stiffness_rows: np.ndarray
    damping_rows: np.ndarray
    drag_rows: np.ndarray
    wet_rows: np.ndarray
    share: np.ndarray

    @classmethod
    def of(cls, boat, backend):
        """Return the arrays of a `Boat` for one boat or a fleet."""
        hull, share = boat.hull, boat.hull.share
        x, y, z = boat.probe_offsets.T
        one = np.ones(len(share))
        drag = boat.damping.probe * share
        return cls(
            homogeneous=np.stack([x, y, z, one]),
            heights=laws.Heights.of(hull, backend), ramp=backend.per_probe(RAMP * one),
            lift_rows=hull.max_force * np.stack([x, y, z, one, hull.height]),
            arm_row=hull.max_force * hull.height[None, :] / 2.0,
            above=backend.per_probe(z), half_height=backend.per_probe(hull.height / 2.0),
            stiffness_rows=hull.max_force * np.stack([one, x, y, x * x, y * y, x * y]),
            damping_rows=np.stack([share, *(drag * np.stack([
                one, x, y, z, y * y + z * z, x * x + z * z, x * x + y * y,
                -x * y, -x * z, -y * z]))]) / RAMP,
            # By columns in memory: one boat multiplies their transpose.
            drag_rows=np.asfortranarray(drag * np.stack([one, x, y, z]) / RAMP),
            wet_rows=np.asfortranarray(np.stack([share, drag, drag * x, drag * y, drag * z])),
            share=share[None, :])


def buoyancy(system, share, upright):
    """
    Return the lift in N, straight up in the world, and its first moment (3) N m in body axes.

    The torque is moment x up: sum r_i x F_i of parallel forces.  The force of a column acts at
    the middle of its wet part, which upside down hangs from the top end.
    """
    backend, arrays = system.backend, system.arrays
    x, y, z, lift, from_top = backend.components(arrays.lift_rows.dot(share))
    if system.law.has_arm:
        raised, = backend.components(arrays.arm_row.dot(share * share))
        z = z + backend.where(upright > 0.0, raised, from_top - raised)
    return lift, (x, y, z)


def probe_damping(backend, arrays, ramp):
    """
    Return the weighted mean wetness, and the probes' part of the `DampingMatrix`.

    ``ramp`` is each probe's wetness, 0 to RAMP.  Probe i gives -c_i s_i (v + w x r_i).  The
    force block is c times the unit matrix: returns wetness, c, coupling (3), torque block (6).
    """
    submersion, c, sx, sy, sz, xx, yy, zz, xy, xz, yz = backend.components(
        arrays.damping_rows.dot(ramp))
    return submersion, c, (sx, sy, sz), (xx, yy, zz, xy, xz, yz)


def mixed(damping, submersion):
    """
    Return nine components of damping, force block and torque block, at a wetness 0 to 1.

    ``damping`` as `System.body_damping`: retention and linear drag mix between air and water.
    """
    (a, b, c, d, e, f, g, h, i), (aw, bw, cw, dw, ew, fw, gw, hw, iw) = damping
    return (a + submersion * aw, b + submersion * bw, c + submersion * cw,
            d + submersion * dw, e + submersion * ew, f + submersion * fw,
            g + submersion * gw, h + submersion * hw, i + submersion * iw)


def orbital_drag(backend, arrays, ramp, submersion, orbital, rotation):
    """
    Return force, torque and mean velocity that the orbital motion of waves gives the probes.

    ``ramp`` and ``submersion`` as in `probe_damping`; ``orbital`` m/s of each probe in world
    axes.  Sums c_i s_i w_i and c_i s_i r_i x w_i.
    """
    if backend.holds(submersion < WET):
        (x,), (y,), (z,) = backend.over_probes(arrays.share, orbital)
        ((fx, mxx, myx, mzx),
         (fy, mxy, myy, mzy),
         (fz, mxz, myz, mzz)) = backend.over_probes(arrays.drag_rows, ramp * orbital)
    else:
        # As most of the time: no probe on its ramp, and one sum gives all.
        ((x, fx, mxx, myx, mzx),
         (y, fy, mxy, myy, mzy),
         (z, fz, mxz, myz, mzz)) = backend.over_probes(arrays.wet_rows, orbital)
    # First moments of the pull, place in body axes by pull in world axes; the torque needs the
    # pull's components across each lever only.
    a, b, c, d, e, f, g, h, i = rotation
    torque = (c * myx + f * myy + i * myz - b * mzx - e * mzy - h * mzz,
              a * mzx + d * mzy + g * mzz - c * mxx - f * mxy - i * mxz,
              b * mxx + e * mxy + h * mxz - a * myx - d * myy - g * myz)
    return to_body(rotation, (fx, fy, fz)), torque, to_body(rotation, (x, y, z))


@dataclass(frozen=True)
class System:
    """
    A boat made ready for stepping: its constants in the form the hot path uses.

    ``rotate`` is the function of `free_rotation`;
    ``body_damping`` (9), force block and torque block, are damping in air and what water adds,
    ``retention`` its part without linear drag; ``quadratic`` (6) or None.
    """

    backend: Backend
    arrays: ProbeArrays
    law: laws.Law
    rotate: Callable
    mass: float
    weight: float
    inertia: tuple
    body_damping: tuple
    retention: tuple
    quadratic: tuple | None
    boat: Boat

    @classmethod
    def of(cls, boat, backend):
        """Return the system of a `Boat` for one boat or a fleet."""
        water, air = boat.retention_damping
        with_linear = water + np.diag(boat.damping.linear)

        force_block = ((0, 0), (1, 1), (2, 2))
        torque_block = ((3, 3), (4, 4), (5, 5), (3, 4), (3, 5), (4, 5))

        def air_and_more(matrix):
            return tuple(tuple(float(values[i]) for i in force_block + torque_block)
                         for values in (air, matrix - air))

        quadratic = tuple(boat.damping.quadratic.tolist())
        return cls(
            backend=backend, arrays=ProbeArrays.of(boat, backend), law=laws.LAWS[boat.hull.law],
            rotate=free_rotation(boat), mass=boat.mass, weight=boat.weight,
            inertia=tuple(float(boat.mass_matrix[i]) for i in torque_block),
            body_damping=air_and_more(with_linear), retention=air_and_more(water),
            quadratic=quadratic if any(quadratic) else None, boat=boat)


def evaluate(system, sea, position, orientation, time):
    """
    Return the `Load` on a boat.

    Main arguments: ``system`` a `System`; ``sea`` the water; ``position`` (3) m of the centre of
    mass and ``orientation`` (4), components; ``time`` s.
    """
    backend, arrays = system.backend, system.arrays
    rotation = rotation_matrix(orientation)
    ux, uy, uz = up = rotation[6:]
    points = backend.place(arrays.homogeneous, rotation, position, time)
    sea = sea.at(time)
    if sea.is_flat:
        depth = -points[2]
    else:
        surface = sea.surface(points, time)
        depth = surface[0] - points[2]
    fraction, share = system.law.wetting(backend, arrays.heights, depth, uz)
    ramp = np.minimum(fraction, arrays.ramp)

    lift, moment = buoyancy(system, share, uz)
    net = lift - system.weight
    fx, fy, fz = net * ux, net * uy, net * uz
    tx, ty, tz = cross(moment, up)

    submersion, c, coupling, angular = probe_damping(backend, arrays, ramp)
    ax, ay, az, xx, yy, zz, xy, xz, yz = mixed(system.body_damping, submersion)
    qxx, qyy, qzz, qxy, qxz, qyz = angular
    damping = DampingMatrix((ax + c, ay + c, az + c), coupling,
                            (xx + qxx, yy + qyy, zz + qzz, xy + qxy, xz + qxz, yz + qyz))

    water = STILL
    if not sea.is_flat:
        (px, py, pz), (sx, sy, sz), water = orbital_drag(
            backend, arrays, ramp, submersion, surface[1:], rotation)
        wx, wy, wz = water
        fx, fy, fz = fx + px + ax * wx, fy + py + ay * wy, fz + pz + az * wz
        tx, ty, tz = tx + sx, ty + sy, tz + sz
    if sea.drift is not None:
        x, y, z = to_body(rotation, sea.drift)
        lever = cross(coupling, (x, y, z))
        fx, fy, fz = fx + (ax + c) * x, fy + (ay + c) * y, fz + (az + c) * z
        tx, ty, tz = tx + lever[0], ty + lever[1], tz + lever[2]
        water = (water[0] + x, water[1] + y, water[2] + z)
    return Load(rotation, depth, share, (fx, fy, fz), (tx, ty, tz), damping, submersion, water)
