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
Damping: what takes speed away, all of it relative to the water, in heave as in the other five.

At each probe, on each body axis its own (`probe_damping`; left out, `scene.build` gives 0.3 of
critical in heave and hardly any along the water), and of the whole body.  Given as a matrix C and
not as numbers, so that every integrator can treat it its own way: the wrench is -C (u - u_water).
`load` sums it over the probes.
"""

from typing import NamedTuple

from ..compiled import compiled
from ..vectors import (add, add_scaled, add_scaled_matrix, diagonal, multiply, scale, scale_matrix,
                       six, subtract, three, times)

# Damping comes in over this part of a probe's height: a jump at entry would leave every
# integrator at first order.
RAMP = 0.1


class DampingMatrix(NamedTuple):
    """
    A symmetric 6 x 6 damping matrix about the centre of mass, body axes, as what is not zero.

    force = -linear v - B^T w, torque = -B v - angular w: ``linear`` (3) N/(m/s); ``coupling`` (6)
    N m/(m/s), B without its diagonal, xy, xz, yx, yz, zx, zy: of the torque about the first axis
    per speed along the second; ``angular`` (6) N m/(rad/s).  Points at r that damp by c on each
    body axis add up to linear = sum c, B = sum [r x] diag(c), angular = sum [r x] diag(c) [r x]^T.
    """

    linear: tuple
    coupling: tuple
    angular: tuple


@compiled
def no_damping():
    """Return the matrix of nothing, to add to."""
    zero = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return DampingMatrix((0.0, 0.0, 0.0), zero, zero)


@compiled
def ramped(wet):
    """Return s, 0 to 1, how far damping has come in at a probe of which a part is wet."""
    return min(wet / RAMP, 1.0)


@compiled
def probe_damping(boat, probe, s):
    """Return c_i = c w_i / sum w, times s: (3) N s/m of a probe, with force -c_i (v_i - w_i)."""
    return scale(s, scale(probe.share, three(boat.probe_damping)))


@compiled
def with_point(damping, c, r):
    """Return the damping matrix with a point added at r that gives -c (v + w x r), c (3)."""
    (x, y, z), (a, b, c), (xy, xz, yx, yz, zx, zy) = r, c, damping.coupling
    ay, az, bx, bz, cx, cy = a * y, a * z, b * x, b * z, c * x, c * y
    return DampingMatrix(
        add(damping.linear, (a, b, c)), (xy - bz, xz + cy, yx + az, yz - cx, zx - ay, zy + bx),
        add_scaled_matrix(damping.angular, 1.0, (
            cy * y + bz * z, cx * x + az * z, bx * x + ay * y, -cx * y, -bx * z, -ay * z)))


@compiled
def with_body(damping, drag, spin_drag):
    """Return the damping matrix with drag (3) and spin drag (6) of the whole body added."""
    return DampingMatrix(add(damping.linear, drag), damping.coupling,
                         add_scaled_matrix(damping.angular, 1.0, spin_drag))


@compiled
def retention(boat, wetness):
    """
    Return the damping that retention stands for, force (3) and torque (6), at a wetness 0 to 1.

    r of the velocity kept after one second is a rate d = -ln r: force -m d_i v_i, torque
    -I^1/2 diag(d) I^1/2 w; of water times the wetness, of air times the rest.
    """
    air, air_spin = three(boat.air_retention), six(boat.air_spin_retention)
    water, water_spin = three(boat.water_retention), six(boat.water_spin_retention)
    return (add_scaled(scale(1.0 - wetness, air), wetness, water),
            add_scaled_matrix(scale_matrix(1.0 - wetness, air_spin), wetness, water_spin))


@compiled
def body_damping(boat, wetness):
    """Return retention and linear drag, D v and D w, force (3) and torque (6), at a wetness."""
    force, torque = retention(boat, wetness)
    spin = diagonal((boat.linear[3], boat.linear[4], boat.linear[5]))
    return (add_scaled(force, wetness, three(boat.linear)),
            add_scaled_matrix(torque, wetness, spin))


@compiled
def with_quadratic_drag(boat, load, body_velocity, angular_velocity):
    """
    Return damping matrix, force and torque with quadratic drag at a speed, linear in velocity.

    -q |u| u on each body axis, times the wetness, speeds relative to the water.
    """
    q = boat.quadratic
    s, u = load.wetness, subtract(body_velocity, load.water)
    w = subtract(angular_velocity, load.turning)
    drag = (s * q[0] * abs(u[0]), s * q[1] * abs(u[1]), s * q[2] * abs(u[2]))
    spin_drag = (s * q[3] * abs(w[0]), s * q[4] * abs(w[1]), s * q[5] * abs(w[2]))
    return (with_body(load.damping, drag, diagonal(spin_drag)),
            add(load.force, multiply(drag, load.water)),
            add(load.torque, multiply(spin_drag, load.turning)))


@compiled
def damping_wrench(damping, body_velocity, angular_velocity):
    """Return C u: the force and torque that damping takes at a velocity, body axes."""
    v, w = body_velocity, angular_velocity
    return (add(multiply(damping.linear, v), coupled_force(damping.coupling, w)),
            add(coupled_torque(damping.coupling, v), times(damping.angular, w)))


@compiled
def coupled_force(coupling, w):
    """Return B^T w, see `DampingMatrix`."""
    xy, xz, yx, yz, zx, zy = coupling
    return (yx * w[1] + zx * w[2], xy * w[0] + zy * w[2], xz * w[0] + yz * w[1])


@compiled
def coupled_torque(coupling, v):
    """Return B v, see `DampingMatrix`."""
    xy, xz, yx, yz, zx, zy = coupling
    return (xy * v[1] + xz * v[2], yx * v[0] + yz * v[2], zx * v[0] + zy * v[1])
