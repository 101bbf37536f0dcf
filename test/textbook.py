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

from functools import lru_cache

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

UP = np.array([0.0, 0.0, 1.0])


def cross(a, b):
    """Return a x b; a fifth of what NumPy's takes."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                     a[0] * b[1] - a[1] * b[0]])


@lru_cache(maxsize=None)
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


def water_below(sea, x, y, depth, time):
    """
    Return what linear waves do down to a depth: height, its worth at the depth, slope, motions.

    The slope is the mean over the depth; orbital velocity and acceleration, of water that the
    current carries along, are horizontal at half the depth and vertical at it.  No depth is below
    the bottom.
    """
    height, felt, slope, velocity, acceleration = 0.0, 0.0, np.zeros(2), np.zeros(3), np.zeros(3)
    nodes, weights = np.polynomial.legendre.leggauss(20)
    for amplitude, period, direction, phase in sea.waves:
        frequency = 2 * np.pi / period
        ahead = np.array([np.cos(direction), np.sin(direction), 0.0])
        along = ahead[:2] @ sea.current
        k = dispersion(frequency, sea.depth, sea.gravity, along)
        s, down = frequency - k * along, min(depth, sea.depth or depth)

        def dying(profile, d):
            if not sea.depth:
                return np.exp(-k * d)
            return profile(k * (sea.depth - d)) / profile(k * sea.depth)

        theta = k * (x * ahead[0] + y * ahead[1]) - frequency * time + phase
        cosine, sine = amplitude * np.cos(theta), amplitude * np.sin(theta)
        height += cosine
        felt += cosine * dying(np.cosh, down)
        mean = 0.5 * weights @ dying(np.cosh, down * (1.0 + nodes) / 2.0)
        slope = slope - k * sine * mean * ahead[:2]
        shallow = np.tanh(k * sea.depth) if sea.depth else 1.0
        level = s / shallow * dying(np.cosh, down / 2.0) * ahead
        upright = s * dying(np.sinh, down) * UP
        velocity = velocity + cosine * level + sine * upright
        acceleration = acceleration + s * (sine * level - cosine * upright)
    return height, felt, slope, velocity, acceleration


def as_twist(boat, motions):
    """
    Return the motion (6,) about the centre of mass that water at the probes (n, 3) amounts to.

    In body axes: the mean over the waterplane, and its first moments over the second ones.
    """
    share = boat.hull.max_force / boat.hull.max_force.sum()
    places = (boat.hull.positions - boat.center_of_mass) * [1.0, 1.0, 0.0]
    middle = share @ places
    x, y, _ = (places - middle).T
    u, v, w = np.transpose(motions)
    turning = np.array([share @ (y * w) / (share @ y**2), -(share @ (x * w)) / (share @ x**2),
                        share @ (x * v - y * u) / (share @ (x**2 + y**2))])
    return np.concatenate([share @ motions - cross(turning, middle), turning])


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
    return load(boat, sea, time, position, orientation, velocity, spin, thrust)[:2]


def load(boat, sea, time, position, orientation, velocity, spin, thrust=(0.0,) * 6):
    """Return what `wrench` does, and how far the boat is in the water, 0 to 1."""
    hull, damping = boat.hull, boat.damping
    turn = Rotation.from_quat(orientation).as_matrix()
    spin_world = turn @ spin
    weights = hull.max_force / hull.max_force.sum()
    force = np.array([0.0, 0.0, -boat.mass * boat.gravity])
    torque = np.zeros(3)
    wetness, mean_water, turning, flows, pushes = 0.0, np.zeros(3), np.zeros(3), [], []
    immersion = boat.immersion if len(boat.immersion) else [None] * len(weights)
    for place, weight, most, height, deep in zip(
            hull.positions, weights, hull.max_force, hull.height, immersion):
        arm = turn @ (place - boat.center_of_mass)
        probe = position + arm
        surface, flow = water(sea, probe[0], probe[1], time)
        wet, share, along = lift_of_probe(hull.law, height, surface - probe[2], turn[2, 2])
        lift = most * share * UP
        if deep is not None:
            surface, felt, slope, orbital, faster = water_below(sea, *probe[:2], deep, time)
            flow = orbital + [*sea.current, 0.0]
            flows.append(turn.T @ orbital)
            pushes.append(turn.T @ faster)
            _, share, along = lift_of_probe(hull.law, height, felt - probe[2], turn[2, 2])
            lift = most * share * np.array([*-slope, 1.0])
        ramp = np.clip(wet / (0.1 * height), 0.0, 1.0)
        drag = -turn @ (damping.probe * weight * ramp * (
            turn.T @ (velocity + cross(spin_world, arm) - flow)))
        force = force + lift + drag
        torque = torque + cross(arm + along * turn[:, 2], lift) + cross(arm, drag)
        wetness += weight * ramp
        mean_water = mean_water + weight * flow
    torque = turn.T @ torque

    taken_along = wetness * boat.added_mass
    if flows:
        carried = as_twist(boat, np.array(flows))
        mean_water, turning = turn @ carried[:3] + [*sea.current, 0.0], carried[3:]
        push = taken_along * as_twist(boat, np.array(pushes))
        force, torque = force + turn @ push[:3], torque + push[3:]
    slip, turns = turn.T @ (velocity - mean_water), spin - turning
    water_rates = -np.log(np.concatenate([damping.linear_retention, damping.angular_retention]))
    air_rates = -np.log(np.concatenate([damping.air_linear_retention,
                                        damping.air_angular_retention]))
    masses = (wetness * water_rates[:3] * (boat.mass + boat.added_mass[:3])
              + (1.0 - wetness) * air_rates[:3] * boat.mass)
    wide = boat.inertia + np.diag(boat.added_mass[3:])
    retained = (wetness * angular_retention(wide, water_rates[3:])
                + (1.0 - wetness) * angular_retention(boat.inertia, air_rates[3:]))
    motion = np.concatenate([slip, turns])
    drag = wetness * (damping.linear + damping.quadratic * np.abs(motion)) * motion
    force = force - turn @ (masses * slip + drag[:3])
    torque = torque - retained @ turns - drag[3:]

    surge, sway, yaw = damping.wind
    ahead = np.array([yaw / sway if yaw else 0.0, 0.0, 0.0])
    slip = turn.T @ (velocity - [*sea.wind, 0.0]) + cross(spin, ahead)
    drag = np.array([surge, sway, 0.0]) * np.abs(slip) * slip
    force, torque = force - turn @ drag, torque - cross(ahead, drag)

    push, twist = np.array(thrust[:3], float), np.array(thrust[3:], float)
    return (force + turn @ push, torque + twist + cross(-boat.center_of_mass, push), wetness)


def solve(boat, sea, state, times, thrust=(0.0,) * 6, *, tolerance=1e-12, max_step=np.inf):
    """
    Return position, orientation, velocity, angular velocity at ``times``, rows of 13.

    With added mass of a boat whose wetness stays what it is.
    """
    current = np.array([*sea.current, 0.0])

    def rates(time, values):
        orientation = values[3:7] / np.linalg.norm(values[3:7])
        velocity, spin = values[7:10], values[10:13]
        force, torque, wetness = load(boat, sea, time, values[:3], orientation, velocity, spin,
                                      thrust)
        added = wetness * boat.added_mass
        M, J = boat.mass + added[:3], boat.inertia + np.diag(added[3:])
        turn = Rotation.from_quat(orientation).as_matrix()
        # The momentum of boat and water turns with the boat, relative to the current (Kirchhoff).
        relative = turn.T @ (velocity - current)
        gaining = turn @ ((turn.T @ force - cross(spin, M * relative)) / M + cross(spin, relative))
        torque = torque + cross(M * relative, relative)
        x, y, z, w = values[3:7]
        p, q, r = spin
        turning = 0.5 * np.array([w * p + y * r - z * q, w * q + z * p - x * r,
                                  w * r + x * q - y * p, -x * p - y * q - z * r])
        return np.concatenate([velocity, turning, gaining,
                               np.linalg.solve(J, torque - cross(spin, J @ spin))])

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
