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

"""How a boat answers a push in still water: its speed ahead, and how fast it turns."""

from dataclasses import dataclass
import math

import numpy as np

from ..physics.hydrostatics.natural_modes import Equilibrium
from ..physics.hydrostatics.rest import rest_state
from ..physics.hydrostatics.stiffness import still_load

# Without thrusters a boat is pushed by this many N for each kg of its mass.
PUSH = 1.0
HALVINGS = 200
# N or N m that stand for a thruster without limits.
UNLIMITED = 1e12


@dataclass(frozen=True)
class Axis:
    """
    Motion along or about one axis, M u' = F - c u - q |u| u, from rest in still water.

    ``inertia`` kg or kg m^2, ``linear`` c and ``quadratic`` q, each at the boat's rest; what the
    axes do to each other is left out.
    """

    inertia: float
    linear: float
    quadratic: float

    def drag(self, speed):
        """Return the drag in N or N m at a speed of at least 0."""
        return self.linear * speed + self.quadratic * speed * speed

    def steady_speed(self, push):
        """Return the speed at which drag holds a push of at least 0; infinite without drag."""
        root = math.sqrt(self.linear ** 2 + 4.0 * self.quadratic * push)
        return 2.0 * push / (self.linear + root) if self.linear + root > 0.0 else math.inf

    def time_to(self, distance, push):
        """
        Return the time in s from rest over a distance in m or rad under a push; infinite for none.

        In closed form, u = V (1 - e) / (1 + p e), e = exp(-D t / M), D^2 = c^2 + 4 q F,
        p = (D - c) / (D + c) and V the steady speed.
        """
        if not push > 0.0:
            return math.inf
        D, V = math.sqrt(self.linear ** 2 + 4.0 * self.quadratic * push), self.steady_speed(push)
        if math.isinf(V):
            return math.sqrt(2.0 * distance * self.inertia / push)
        p, rate = (D - self.linear) / (D + self.linear), D / self.inertia

        def covered(time):
            gone = -math.expm1(-rate * time)
            # log((1 + p e) / (1 + p)) (1 + p) / p, which goes over into -(1 - e) as p does into 0.
            lost = math.log1p(-p * gone / (1.0 + p)) * (1.0 + p) / p if p > 1e-9 else -gone
            return V * (time + lost / rate)

        low, high = 0.0, 1.0
        while covered(high) < distance:
            high *= 2.0
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if covered(middle) < distance else (low, middle)
        return high


def axes(boat):
    """Return the `Axis` of surge and of yaw of a `Boat` at its rest."""
    rest, damping = Equilibrium.of(boat), boat.damping
    wetness = still_load(boat, rest_state(boat))[0].wetness
    air = damping.wind[0], damping.wind[1] * abs(damping.wind_arm) ** 3
    return [Axis(float(rest.mass[i, i]), float(rest.damping[i, i]),
                 float(wetness * damping.quadratic[i] + drag)) for i, drag in zip((0, 5), air)]


def steady_course_speed(boat):
    """
    Return the speed ahead in m/s up to which a boat runs straight by itself; infinite for any.

    The moment of Munk turns a hull away from its course, drag holds it: U^2 = Y N / (m_x (m_y -
    m_x)), Y and N the linear drag in sway and yaw, m_x and m_y the mass ahead and abeam with the
    added mass (Fossen, Handbook of Marine Craft Hydrodynamics, 2011, 6.3 and 7.2).
    """
    rest = Equilibrium.of(boat)
    ahead, abeam = rest.mass[0, 0], rest.mass[1, 1]
    if not abeam > ahead:
        return math.inf
    return math.sqrt(rest.damping[1, 1] * rest.damping[5, 5] / (ahead * (abeam - ahead)))


def handling(scene, push=None):
    """
    Return how the boat of a `Scene` answers a push ahead and one to turn, {name: number or None}.

    ``push`` N; without one all that its thrusters give, or 1 N for each kg.  It is turned by all
    that its thrusters give against each other, or by half the push at half its beam from the
    centre line, ahead on one side and astern on the other.
    """
    surge, yaw = axes(scene.boat)
    ahead, torque = _greatest(scene.thrusters)
    if push is not None or not 0.0 < ahead < UNLIMITED:
        ahead = PUSH * scene.boat.mass if push is None else push
    if push is not None or not 0.0 < torque < UNLIMITED:
        torque = ahead * _half_beam(scene.boat)
    found = {'steady_course_up_to_m_per_s': steady_course_speed(scene.boat),
             'push_n': ahead, 'speed_ahead_m_per_s': surge.steady_speed(ahead),
             'push_for_1_m_per_s_n': surge.drag(1.0), 'turning_torque_n_m': torque,
             'time_to_turn_90_deg_s': yaw.time_to(0.5 * math.pi, torque)}
    return {name: value if math.isfinite(value) else None for name, value in found.items()}


def _greatest(thrusters):
    """Return the most that thrusters push ahead in N, and turn to port in N m."""
    ahead = torque = 0.0
    for thruster in thrusters:
        ends = [thruster.wrench(limit, 0.0) for limit in (thruster.least, thruster.greatest)]
        ahead += max(0.0, *(force[0] for force, _ in ends))
        torque += max(0.0, *(turn[2] for _, turn in ends))
    return ahead, torque


def _half_beam(boat):
    """Return half the beam in m, of the hull or of the places of its probes."""
    places = boat.hull.positions if boat.hull.surface is None else boat.hull.surface.extent
    return 0.5 * float(np.ptp(places[:, 1]))
