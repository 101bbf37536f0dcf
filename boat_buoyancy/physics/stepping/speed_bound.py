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
The bound on a boat's speed that holds for the implicit integrator at any step.

In the norm |u|_M = sqrt(u^T M u), M = diag(m, m, m, I), with drag of at least d > 0 on linear and
angular velocity everywhere, lift that is capped, and water that moves at W at most, a step h
from u to u+ obeys

    |u+| <= (a + sqrt(a^2 + 4 (1 + h d) h P)) / (2 (1 + h d)),  a = |u| + h F,

because M + h C + h^2 K+ >= (1 + h d) M.  F bounds the force in the norm of M^-1, P the power that
moving water and air can feed in through drag.  The bound is of speed, not of error.

With added mass M is that in force, and u is relative to the current, which then counts as moving
air does: drift and a change of wetness never raise |u|_M.  The turn of the water and its
acceleration are bounded by the waves' own over how wide the probes stand.

A drag -c (v - w) feeds in at most c w^2 / 4.  That in the air has c = X |u_a| <= X (|v| + W), or
Y at l ahead, where |v_P| <= |v| + |l w_z| <= |u|_M sqrt(1/m + l^2/I_min) (Cauchy and Schwarz).
"""

from dataclasses import astuple, dataclass
import math

import numpy as np

from ..boat.records import waterplane
from ..rotation import rotation_matrix, to_body


# A `SpeedBound` as the guard reads it in the step.
BOUND = np.dtype([(name, 'f8') for name in (
    'force', 'torque', 'mass', 'least_moment', 'drag', 'power', 'power_rate', 'carried')])


@dataclass(frozen=True)
class SpeedBound:
    """
    What bounds the speed of a boat on a sea; make one with `SpeedBound.of`.

    ``force`` N and ``torque`` N m, the most that lift, weight and linear drag of moving water
    exert; ``mass`` kg and ``least_moment`` kg m^2; ``drag`` 1/s, the least rate d; ``power`` W,
    P at rest, and ``power_rate`` W per unit of |u|_M, what drag quadratic in speed adds;
    ``carried``, sqrt(m) times the current that |u|_M is relative to.
    """

    force: float
    torque: float
    mass: float
    least_moment: float
    drag: float
    power: float
    power_rate: float
    carried: float

    @classmethod
    def of(cls, boat, sea):
        """Return the bound of a `Boat` on a `Sea`."""
        hull, damping, water = boat.hull, boat.damping, sea.fastest_water
        if hull.panels is not None:
            torque = hull.max_lift * float(boat.record['reach'])
        else:
            reach = np.linalg.norm(boat.probe_offsets, axis=1)
            if hull.law == 'column':
                # The force acts somewhere between the bottom of the column and its top.
                top = boat.probe_offsets + hull.height[:, None] * [0.0, 0.0, 1.0]
                reach = np.maximum(reach, np.linalg.norm(top, axis=1))
            torque = float(hull.max_force @ reach)
        rates, added, moments = damping.rates, boat.added_mass, boat.principal[0]
        drag, least_moment = float(rates.min()), float(moments[0])
        heaviest, widest = boat.mass + added[:3].max(), moments[2] + added[3:].max()
        force, turning, wind = hull.max_lift, 0.0, math.hypot(*sea.wind)
        if boat.follows_waves:
            # Along the slope as much as up, at most.
            force, torque = math.sqrt(2.0) * force, math.sqrt(2.0) * torque
            per_speed, offset = _turning_per_speed(boat)
            faster = sea.fastest_acceleration * (1.0 + per_speed * offset)
            turning, water = per_speed * water, water * (1.0 + per_speed * offset)
            # |s A a| in the norm of M^-1 is at most sqrt(A) |a|.
            force += math.sqrt(boat.mass * added[:3].max()) * faster
            torque += drag * widest * turning + math.sqrt(
                least_moment * added[3:].max()) * per_speed * sea.fastest_acceleration
        carried = 0.0
        if added.any():
            current, change = sea.fastest_current
            carried, wind = math.sqrt(boat.mass) * current, wind + current
            force += math.sqrt(boat.mass * heaviest) * change
        quarter, turned = 0.25 * water ** 2, 0.25 * turning ** 2
        linear, spin = damping.linear[:3].max(), damping.linear[3:].max()
        quadratic, quadratic_spin = damping.quadratic[:3].max(), damping.quadratic[3:].max()
        air, air_speed = damping.wind[:2].max(), math.sqrt(
            1.0 / boat.mass + damping.wind_arm ** 2 / least_moment)
        gust = 0.25 * wind ** 2 * air
        return cls(*map(float, (
            force + boat.weight + drag * heaviest * water, torque, boat.mass, least_moment, drag,
            quarter * (damping.probe.max() + heaviest * (rates[:, :3].max() - drag) + linear
                       + quadratic * water)
            + turned * (widest * (rates[:, 3:].max() - drag) + spin + quadratic_spin * turning)
            + gust * wind,
            quarter * quadratic / math.sqrt(boat.mass)
            + turned * quadratic_spin / math.sqrt(least_moment) + gust * air_speed,
            carried)))

    @property
    def record(self):
        """Return the bound as a record of `BOUND`."""
        return np.array(astuple(self), BOUND)

    def forcing(self, force=0.0, torque=0.0):
        """
        Return F for thrust of ``force`` N and ``torque`` N m about the centre of mass.

        Both are magnitudes, numbers or arrays.
        """
        force, torque = self.force + force, self.torque + torque
        return (force * force / self.mass + torque * torque / self.least_moment) ** 0.5

    def after(self, norm, h, force=0.0, torque=0.0):
        """Return the most that |u|_M can be after a step of ``h`` s from ``norm``."""
        damped = 1.0 + h * self.drag
        a = norm + h * self.forcing(force, torque)
        power = self.power + self.power_rate * norm
        return (a + (a * a + 4.0 * damped * h * power) ** 0.5) / (2.0 * damped)

    def limit(self, force=0.0, torque=0.0):
        """Return the |u|_M that is never passed from below; infinite without drag in air."""
        forcing = self.forcing(force, torque) + self.power_rate
        if not self.drag > 0:
            return math.inf
        root = (forcing * forcing + 4.0 * self.drag * self.power) ** 0.5
        return (forcing + root) / (2.0 * self.drag)


def _turning_per_speed(boat):
    """
    Return 1/m, the turn of the water over its speed at most, and how far off its middle is in m.

    See `forces.wave_force.add_to_twist`.
    """
    middle, away, per_square = waterplane(boat)
    along, across = boat.waterplane_parts @ np.abs(away)
    return (float(np.linalg.norm(per_square * [across, along, along + across])),
            float(np.linalg.norm(middle)))


def speed_norm(boat, state, wetness=0.0, current=(0.0, 0.0)):
    """
    Return |u|_M (...,) of a `State`, sqrt of twice the kinetic energy.

    Of a boat with added mass at a ``wetness`` (...,), relative to the ``current`` (2,) m/s.
    """
    stream = np.append(current, 0.0) * boat.added_mass.any()
    moving = np.stack(to_body(rotation_matrix(np.moveaxis(state.orientation, -1, 0)),
                              np.moveaxis(state.velocity - stream, -1, 0)), axis=-1)
    u = np.concatenate([moving, state.angular_velocity], axis=-1)
    squared = np.einsum('...i,ij,...j->...', u, boat.mass_matrix, u)
    return np.sqrt(squared + wetness * (u * u @ boat.added_mass))
