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

"""Buoyancy: each probe lifts straight up, by its law and its part of the budget."""

from .pressure import pressure_stiffness
from .probe_laws import arm, slope, wetting
from ..compiled import compiled
from ..vectors import add_scaled, add_scaled_matrix, cross, dot, outer, scale, ZERO


@compiled
def buoyancy(law, probe, wet, share, up):
    """
    Return force N and torque N m of one probe about the centre of mass, body axes.

    F = F_i share up, acting at p = r + arm z_body: torque p x F.
    """
    lift = scale(probe.max_force * share, up)
    return lift, cross(point_of_force(law, probe, wet, up), lift)


@compiled
def point_of_force(law, probe, wet, up):
    """Return p (3) m, where the lift of a probe acts, from the centre of mass in body axes."""
    return (probe.x, probe.y, probe.z + arm(law, probe.height, wet, up[2]))


@compiled
def lift_stiffness(boat, hull, R):
    """
    Return K+, the positive part of the stiffness of the lift, body axes, of a boat turned by R.

    K+ = sum k_i g_i g_i^T, g_i = (up, p_i x up), over the probes on the slope of their law, k_i
    N/m and p_i the point of force; and, for a boat hung below its points of force, the pendulum
    max(0, sum F_i p_i.up) (1 - up up^T) in the torque.  Returned as k, l, T: force block
    k up up^T, coupling l up^T (torque rows), torque block T (6).  Read from what `load_at` wrote.
    """
    if boat.triangles > 0:
        return pressure_stiffness(boat, hull, R)
    up = R[2]
    k, swing, lever, torque = 0.0, 0.0, ZERO, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for i in range(len(hull.probes)):
        probe, depth = hull.probes[i], hull.depths[i]
        wet, share = wetting(boat.law, probe.height, depth, up[2])
        place = point_of_force(boat.law, probe, wet, up)
        stiffness = probe.max_force * slope(boat.law, probe.height, depth, up[2])
        around = cross(place, up)
        k += stiffness
        lever = add_scaled(lever, stiffness, around)
        torque = add_scaled_matrix(torque, stiffness, outer(around))
        swing += probe.max_force * share * dot(place, up)
    swing = max(swing, 0.0)
    torque = add_scaled_matrix(torque, swing, (1.0, 1.0, 1.0, 0.0, 0.0, 0.0))
    return k, lever, add_scaled_matrix(torque, -swing, outer(up))
