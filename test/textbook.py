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
The same boat written down a second time, probe by probe in world axes, for the tests.

Nothing here is shared with the package but the data of Boat and Sea: rotations are SciPy's, the
time integration is SciPy's adaptive eighth-order DOP853, the forces are plain sums.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

UP = np.array([0.0, 0.0, 1.0])


def cross(a, b):
    """Return a x b; a fifth of what NumPy's takes."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                     a[0] * b[1] - a[1] * b[0]])


def dispersion(angular_frequency, depth, gravity, current=0.0):
    """
    Return the wave number of linear waves on a current along them, by bracketing.

    The least k at which the frequency of still water and that which the current adds make w.
    """
    def excess(k):
        shallow = np.tanh(k * depth) if depth else 1.0
        return np.sqrt(gravity * k * shallow) + current * k - angular_frequency

    high = angular_frequency**2 / gravity * 1e-6
    while excess(high) < 0.0:
        high *= 1.001
    return brentq(excess, 0.0, high, xtol=1e-15, rtol=1e-14)


def water(sea, x, y, time):
    """Return elevation and velocity of the surface at one point, current included."""
    height, velocity = 0.0, np.array([*sea.current, 0.0])
    for amplitude, period, direction, phase in sea.waves:
        frequency = 2 * np.pi / period
        ahead = np.array([np.cos(direction), np.sin(direction), 0.0])
        along = ahead[:2] @ sea.current
        k = dispersion(frequency, sea.depth, sea.gravity, along)
        theta = k * (x * ahead[0] + y * ahead[1]) - frequency * time + phase
        shallow = np.tanh(k * sea.depth) if sea.depth else 1.0
        height += amplitude * np.cos(theta)
        velocity = velocity + amplitude * (frequency - k * along) * (
            np.cos(theta) / shallow * ahead + np.sin(theta) * UP)
    return height, velocity


def lift_of_probe(law, height, depth, up_body):
    """Return wet length, share of the maximum force and how far along body z the force acts."""
    if law == 'column':
        cosine = max(abs(up_body), 0.05)
        if up_body > 0:
            wet = np.clip(depth / cosine, 0.0, height)
            return wet, wet / height, wet / 2
        top = depth - height * up_body
        wet = np.clip(top / cosine, 0.0, height)
        return wet, wet / height, height - wet / 2
    wet = np.clip(depth, 0.0, height)
    if law == 'soft':
        return wet, (1.0 - np.exp(-max(depth, 0.0) / height)), 0.0
    return wet, wet / height, 0.0


def angular_retention(inertia, rates):
    """
    Return C (3, 3), by rates (3,) in 1/s.

    All turn at the least rate; what an axis decays faster than the one before takes as much of
    the inertia that it and those above it have when the others are free to turn.
    """
    inverse, order = np.linalg.inv(inertia), np.argsort(rates)
    damping, before = np.zeros((3, 3)), 0.0
    for place, axis in enumerate(order):
        faster = np.ix_(order[place:], order[place:])
        damping[faster] += (rates[axis] - before) * np.linalg.inv(inverse[faster])
        before = rates[axis]
    return damping


def wrench(boat, sea, time, position, orientation, velocity, spin, thrust=(0.0,) * 6):
    """
    Return the force in world axes and the torque in body axes about the centre of mass.

    ``velocity`` is in world axes, ``spin`` in body axes, ``thrust`` (6,) in body axes at the
    body origin.
    """
    hull, damping = boat.hull, boat.damping
    turn = Rotation.from_quat(orientation).as_matrix()
    spin_world = turn @ spin
    weights = hull.max_force / hull.max_force.sum()
    force = np.array([0.0, 0.0, -boat.mass * boat.gravity])
    torque = np.zeros(3)
    wetness, mean_water = 0.0, np.zeros(3)
    for place, weight, most, height in zip(hull.positions, weights, hull.max_force, hull.height):
        arm = turn @ (place - boat.center_of_mass)
        probe = position + arm
        surface, flow = water(sea, probe[0], probe[1], time)
        wet, share, along = lift_of_probe(hull.law, height, surface - probe[2], turn[2, 2])
        lift = most * share * UP
        ramp = np.clip(wet / (0.1 * height), 0.0, 1.0)
        drag = -turn @ (damping.probe * weight * ramp * (
            turn.T @ (velocity + cross(spin_world, arm) - flow)))
        force = force + lift + drag
        torque = torque + cross(arm + along * turn[:, 2], lift) + cross(arm, drag)
        wetness += weight * ramp
        mean_water = mean_water + weight * flow
    torque = turn.T @ torque

    slip = turn.T @ (velocity - mean_water)
    water_rates = -np.log(np.concatenate([damping.linear_retention, damping.angular_retention]))
    air_rates = -np.log(np.concatenate([damping.air_linear_retention,
                                        damping.air_angular_retention]))
    rates = wetness * water_rates + (1.0 - wetness) * air_rates
    retained = (wetness * angular_retention(boat.inertia, water_rates[3:])
                + (1.0 - wetness) * angular_retention(boat.inertia, air_rates[3:]))
    motion = np.concatenate([slip, spin])
    drag = wetness * (damping.linear + damping.quadratic * np.abs(motion)) * motion
    force = force - turn @ (boat.mass * rates[:3] * slip + drag[:3])
    torque = torque - retained @ spin - drag[3:]

    surge, sway, yaw = damping.wind
    ahead = np.array([yaw / sway if yaw else 0.0, 0.0, 0.0])
    slip = turn.T @ (velocity - [*sea.wind, 0.0]) + cross(spin, ahead)
    drag = np.array([surge, sway, 0.0]) * np.abs(slip) * slip
    force, torque = force - turn @ drag, torque - cross(ahead, drag)

    push, twist = np.array(thrust[:3], float), np.array(thrust[3:], float)
    return force + turn @ push, torque + twist + cross(-boat.center_of_mass, push)


def solve(boat, sea, state, times, thrust=(0.0,) * 6, *, tolerance=1e-12, max_step=np.inf):
    """Return position, orientation, velocity, angular velocity at ``times``, rows of 13."""
    inverse = np.linalg.inv(boat.inertia)

    def rates(time, values):
        orientation = values[3:7] / np.linalg.norm(values[3:7])
        velocity, spin = values[7:10], values[10:13]
        force, torque = wrench(boat, sea, time, values[:3], orientation, velocity, spin, thrust)
        x, y, z, w = values[3:7]
        p, q, r = spin
        turning = 0.5 * np.array([w * p + y * r - z * q, w * q + z * p - x * r,
                                  w * r + x * q - y * p, -x * p - y * q - z * r])
        return np.concatenate([velocity, turning, force / boat.mass,
                               inverse @ (torque - cross(spin, boat.inertia @ spin))])

    start = np.concatenate([state.position, state.orientation, state.velocity,
                            state.angular_velocity])
    answer = solve_ivp(rates, (0.0, times[-1]), start, method='DOP853', t_eval=times,
                       rtol=tolerance, atol=tolerance, max_step=max_step)
    assert answer.success
    values = answer.y.T
    values[:, 3:7] /= np.linalg.norm(values[:, 3:7], axis=1, keepdims=True)
    return values


def energy(boat, state):
    """Return the energy in J of one boat in flat water, 0 at rest at the surface."""
    turn = Rotation.from_quat(state.orientation).as_matrix()
    total = (0.5 * boat.mass * state.velocity @ state.velocity
             + 0.5 * state.angular_velocity @ boat.inertia @ state.angular_velocity
             + boat.mass * boat.gravity * state.position[2])
    for place, most, height in zip(boat.hull.positions, boat.hull.max_force, boat.hull.height):
        depth = -(state.position + turn @ (place - boat.center_of_mass))[2]
        total += most * pressed_down(boat.hull.law, height, depth, turn[2, 2])
    return total


def pressed_down(law, height, depth, up_body):
    """Return the work in m of pushing a probe under, over its maximum force; column upright."""
    if law == 'soft':
        deep = max(depth, 0.0)
        return deep - height * (1.0 - np.exp(-deep / height))
    if law == 'column':
        assert up_body > 0.05
        wet = np.clip(depth / up_body, 0.0, height)
        return (wet * depth - wet**2 * up_body / 2) / height
    wet = np.clip(depth, 0.0, height)
    return (wet * depth - wet**2 / 2) / height
