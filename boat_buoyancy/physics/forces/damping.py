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

At each probe, which damps heave above all (`probe_damping`; left out, `scene.build` gives 0.3 of
critical), and of the whole body.  Given as a matrix C and not as numbers, so that every integrator
can treat it its own way: the wrench is -C (u - u_water).  `load` sums it over the probes.
"""

from typing import NamedTuple

from ..compiled import compiled
from ..vectors import (add, add_scaled, add_scaled_matrix, cross, diagonal, multiply, scale,
                       scale_matrix, six, subtract, three, times)

# Damping comes in over this part of a probe's height: a jump at entry would leave every
# integrator at first order.
RAMP = 0.1


class DampingMatrix(NamedTuple):
    """
    A symmetric 6 x 6 damping matrix about the centre of mass, body axes, as what is not zero.

    force = -linear v - w x S, torque = -S x v - angular w: ``linear`` (3) N/(m/s), ``coupling``
    (3) S in N m/(m/s), ``angular`` (6) N m/(rad/s).  Damping points are to velocity what mass
    points are to acceleration: S = sum c r, angular = sum c (r.r 1 - r r^T).  ``sway_yaw`` e
    N m/(m/s) is for a point ahead that damps sway alone: force -e w_z in y, torque -e v_y in z.
    """

    linear: tuple
    coupling: tuple
    angular: tuple
    sway_yaw: float


@compiled
def no_damping():
    """Return the matrix of nothing, to add to."""
    return DampingMatrix((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0), 0.0)


@compiled
def ramped(wet):
    """Return s, 0 to 1, how far damping has come in at a probe of which a part is wet."""
    return min(wet / RAMP, 1.0)


@compiled
def probe_damping(boat, probe, s):
    """Return c_i = c w_i / sum w, times s: N s/m of one probe, whose force is -c_i (v_i - w_i)."""
    return boat.probe_damping * probe.share * s


@compiled
def with_point(damping, c, r):
    """Return the damping matrix with a point added at r that gives -c (v + w x r)."""
    x, y, z = r
    return DampingMatrix(
        add(damping.linear, (c, c, c)), add_scaled(damping.coupling, c, r),
        add_scaled_matrix(damping.angular, c, (y * y + z * z, x * x + z * z, x * x + y * y,
                                               -x * y, -x * z, -y * z)), damping.sway_yaw)


@compiled
def with_body(damping, drag, spin_drag):
    """Return the damping matrix with drag (3) and spin drag (6) of the whole body added."""
    return DampingMatrix(add(damping.linear, drag), damping.coupling,
                         add_scaled_matrix(damping.angular, 1.0, spin_drag), damping.sway_yaw)


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
    drag = add(multiply(damping.linear, v), cross(w, damping.coupling))
    spin_drag = add(cross(damping.coupling, v), times(damping.angular, w))
    return (add(drag, (0.0, damping.sway_yaw * w[2], 0.0)),
            add(spin_drag, (0.0, 0.0, damping.sway_yaw * v[1])))
