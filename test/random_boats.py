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

"""Boats, seas, starts and thrusts drawn at random over ranges that break ordinary methods."""

from dataclasses import replace
from typing import NamedTuple

from boat_buoyancy.physics.boat.boat import Boat, Damping
from boat_buoyancy.physics.boat.hull import LAWS, probe_hull
from boat_buoyancy.physics.boat.state import State
from boat_buoyancy.physics.sea.wave_rows import stopped
from boat_buoyancy.physics.sea.waves import Sea
from boats import GRAVITY
import numpy as np
from scipy.spatial.transform import Rotation

# Starts of every draw, one boat of a fleet each.
STARTS = ('afloat', 'dropped from 100 m', 'pushed 1000 m down', 'upside down', 'on its side',
          'spinning at 100 rad/s', 'thrown at 100 m/s', 'all of it at once')
# exp(-700) is about the smallest retention that a double can hold.
GREATEST_RATE = 700.0


class Draw(NamedTuple):
    """A boat, the sea, the fleet's start, thrust (B, 6) in body axes and the step in s."""

    boat: Boat
    sea: Sea
    state: State
    thrust: np.ndarray
    step: float


def log_uniform(random, low, high, size=None):
    """Return numbers whose logarithm is uniform."""
    return np.exp(random.uniform(np.log(low), np.log(high), size))


def draw(seed, *, drag=True):
    """
    Return a `Draw`.

    Step 1 ms to 1 s; stiffness up to 1e4 times that of a draft of half the size; probe damping up
    to 1e4 times critical, on each axis its own; drag of 1e-2 to 1e4 1/s in water and at least
    1e-2 in air; thrust up to ten times the weight and waves, each in half the draws.
    ``drag=False`` leaves out the drag.
    """
    random = np.random.default_rng(seed)
    mass, size = log_uniform(random, 1.0, 1e5), log_uniform(random, 0.3, 20.0)
    weight = mass * GRAVITY
    count = int(random.integers(1, 9))
    positions = random.uniform(-0.5, 0.5, (count, 3)) * size * [1.0, 0.6, 0.4]
    weights = random.uniform(0.1, 1.0, count)
    floatiness = log_uniform(random, 0.5, 10.0)
    stiffness = log_uniform(random, 0.5, 1e4) / size
    hull = probe_hull(positions, weights, weight=weight, floatiness=floatiness,
                      stiffness=stiffness, law=LAWS[random.integers(3)])
    critical = 2.0 * mass * np.sqrt(GRAVITY * stiffness * floatiness)
    damping = Damping(
        **{name: np.exp(-log_uniform(random, 1e-2, GREATEST_RATE, 3) * drag) for name in (
            'linear_retention', 'angular_retention',
            'air_linear_retention', 'air_angular_retention')},
        probe=critical * log_uniform(random, 1e-2, 1e4, 3) * random.integers(0, 2, 3))
    if drag and random.random() < 0.5:
        scale = mass * np.array([1.0, 1.0, 1.0, *[size ** 2] * 3])
        damping = Damping(
            damping.linear_retention, damping.angular_retention, damping.air_linear_retention,
            damping.air_angular_retention, damping.probe,
            linear=scale * log_uniform(random, 1e-2, 1e4, 6) * random.integers(0, 2, 6),
            quadratic=scale * log_uniform(random, 1e-2, 1e2, 6) * random.integers(0, 2, 6))
    boat = Boat(mass, hull, inertia(random, mass * size ** 2), damping,
                random.uniform(-0.3, 0.3, 3) * size * [0.3, 0.2, 1.0])
    rough = random.random() < 0.5
    rows = waves(random) if rough else np.zeros((0, 4))
    water = (random.normal(size=2) * 2.0 * (random.random() < 0.3),
             float(random.choice([0.0, 5.0])))
    sea = Sea(rows[~stopped(rows, *water, GRAVITY)], *water)
    push = random.normal(size=(len(STARTS), 6)) * weight * [1.0, 1.0, 1.0, *[size] * 3]
    thrust = push * log_uniform(random, 1e-2, 10.0) * (random.random() < 0.5)
    return Draw(boat, sea, starts(random), thrust, log_uniform(random, 1e-3, 1.0))


def blown(drawn, seed):
    """Return a `Draw` with drag in the air as strong as that in water, in wind up to a storm."""
    random, boat = np.random.default_rng([seed, 1]), drawn.boat
    surge, sway = boat.mass * log_uniform(random, 1e-3, 1e2, 2)
    wind = [surge, sway, sway * boat.size * random.uniform(-2.0, 2.0)]
    return drawn._replace(
        boat=boat.with_damping(replace(boat.damping, wind=wind)),
        sea=drawn.sea.with_wind(random.normal(size=2) * log_uniform(random, 0.1, 50.0)))


def afloat_in_waves(drawn, seed):
    """
    Return a `Draw` with added mass of up to 100 times the mass, and the wave force of two halves.

    Half of the boats feel the waves down to some depth (Froude and Krylov), half are lifted by
    the surface.
    """
    random, boat = np.random.default_rng([seed, 2]), drawn.boat
    size = boat.size
    added = boat.mass * log_uniform(random, 1e-2, 1e2, 6) * [1.0, 1.0, 1.0, *[size ** 2] * 3]
    immersion = log_uniform(random, 1e-2, 1.0, len(boat.hull.share)) * size
    return drawn._replace(boat=replace(
        boat, added_mass=added * random.integers(0, 2, 6),
        immersion=immersion if random.random() < 0.5 else ()))


def inertia(random, scale):
    """Return a tensor that a rigid body can have, flat, long or round, turned anyhow."""
    a, b, c = scale * log_uniform(random, 1e-3, 0.3, 3)
    turn = Rotation.random(random_state=int(random.integers(2 ** 31))).as_matrix()
    if random.random() < 0.3:
        turn = np.eye(3)
    tensor = turn @ np.diag([b + c, a + c, a + b]) @ turn.T
    return 0.5 * (tensor + tensor.T)


def waves(random):
    """Return rows of one to four waves up to 2 m, 1 to 12 s, from anywhere."""
    count = int(random.integers(1, 5))
    return np.stack([log_uniform(random, 0.01, 2.0, count), random.uniform(1.0, 12.0, count),
                     random.uniform(-np.pi, np.pi, count), random.uniform(0.0, 6.0, count)], 1)


def starts(random):
    """Return the `State` of a fleet, one boat for each of `STARTS`."""
    count = len(STARTS)
    position, velocity, spin = np.zeros((3, count, 3))
    orientation = Rotation.from_euler('xyz', random.normal(size=(count, 3)) * 0.3).as_quat()
    position[1, 2], position[2, 2], position[7, 2] = 100.0, -1000.0, 100.0
    orientation[3] = Rotation.from_euler('x', np.pi).as_quat()
    orientation[4] = Rotation.from_euler('x', np.pi / 2).as_quat()
    orientation[7] = Rotation.random(random_state=int(random.integers(2 ** 31))).as_quat()
    for row in (5, 7):
        axis = random.normal(size=3)
        spin[row] = 100.0 * axis / np.linalg.norm(axis)
    for row in (6, 7):
        way = random.normal(size=3)
        velocity[row] = 100.0 * way / np.linalg.norm(way)
    return State(position, orientation, velocity, spin)
