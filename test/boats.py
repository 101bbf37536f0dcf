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
The boats that the tests compare with answers from elsewhere, and how they are run.

The reference boat has 1000 kg on four probes of 4905 N/m, so it floats 0.5 m deep and heaves at
sqrt(19620 / 1000) = 4.42944692 rad/s.
"""

from dataclasses import replace
import math
import warnings

from boat_buoyancy.physics.boat.boat import Boat, Damping
from boat_buoyancy.physics.boat.clipping import level_for, submerged
from boat_buoyancy.physics.boat.columns import box_hull
from boat_buoyancy.physics.boat.hull import Hull
from boat_buoyancy.physics.boat.state import center_of_mass_state, PARTS, State
from boat_buoyancy.physics.rotation import from_roll_pitch_yaw
from boat_buoyancy.physics.sea.waves import Sea
from boat_buoyancy.physics.stepping.fleet import Fleet
from boat_buoyancy.physics.stepping.simulation import Simulation
import numpy as np

GRAVITY = 9.81
MASS = 1000.0
STIFFNESS = 19620.0
DRAFT = MASS * GRAVITY / STIFFNESS
HEAVE = np.sqrt(STIFFNESS / MASS)
INTEGRATORS = ('leapfrog', 'implicit', 'rk4', 'symplectic_euler', 'euler')
LAWS = ('spring', 'soft', 'column')
SQUARE = np.array([[1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0]])


def same(one, other):
    """Return whether two `State`s are the same to the bit."""
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in PARTS)


def undamped(**changes):
    """Return a `Damping` that takes nothing away but what is given."""
    keep = {name: [1.0] for name in ('linear_retention', 'angular_retention',
                                     'air_linear_retention', 'air_angular_retention')}
    return Damping(**{**keep, **changes})


def reference_boat(*, floatiness=4.0, positions=SQUARE, weights=(1.0,), law='spring',
                   inertia=(500.0, 700.0, 900.0), damping=None, center_of_mass=(0.0,) * 3):
    """Return the reference boat; its probes are full ``floatiness`` / 2 m under water."""
    positions = np.asarray(positions, float)
    weights = np.broadcast_to(np.asarray(weights, float), (len(positions),))
    budget = MASS * GRAVITY * floatiness
    hull = Hull(positions, budget * weights / weights.sum(),
                np.full(len(positions), budget / STIFFNESS), law)
    return Boat(MASS, hull, inertia, damping or undamped(), center_of_mass)


def asymmetric_boat(law='spring', *, floatiness=3.0, damping=None):
    """Return a boat without any symmetry: full inertia tensor, odd weights and probes."""
    positions = np.array([[1.3, 0.9, -0.2], [1.1, -0.8, -0.3], [-1.2, 0.7, -0.25],
                          [-0.9, -1.0, -0.35], [0.1, 0.2, -0.4]])
    return reference_boat(
        floatiness=floatiness, positions=positions, weights=[1.0, 1.2, 0.9, 1.1, 0.8], law=law,
        inertia=[600.0, 800.0, 1000.0, 60.0, -40.0, 30.0], damping=damping or all_damping(),
        center_of_mass=(0.05, -0.03, 0.1))


def all_damping():
    """Return a `Damping` with every kind of drag, different on every axis."""
    return Damping(
        linear_retention=[0.9, 0.8, 0.7], angular_retention=[0.85, 0.8, 0.75],
        air_linear_retention=[0.99, 0.98, 0.97], air_angular_retention=[0.995, 0.985, 0.975],
        probe=[500.0, 600.0, 800.0], linear=[50.0, 60.0, 70.0, 80.0, 90.0, 100.0],
        quadratic=[40.0, 50.0, 60.0, 70.0, 80.0, 90.0])


def box_boat(damping=None):
    """Return the 4 x 2 x 1 m box of 2000 kg in sea water, four columns at the Gauss points."""
    hull = box_hull((4.0, 2.0, 1.0), -0.5, (2, 2), specific_weight=1025.0 * GRAVITY)
    inertia = 2000.0 / 12.0 * np.array([2.0**2 + 1.0**2, 4.0**2 + 1.0**2, 4.0**2 + 2.0**2])
    return Boat(2000.0, hull, inertia, damping or Damping())


def wind_sea():
    """Return a sea of four waves from several sides over a current."""
    return Sea([[0.15, 5.0, 0.3, 0.2], [0.10, 3.7, -1.0, 1.0], [0.08, 2.9, 2.5, 2.0],
                [0.05, 2.1, 0.9, 3.0]], current=[0.3, -0.2])


def windy():
    """Return a `Damping` with drag in the air on top of `all_damping`."""
    return replace(all_damping(), wind=[7.0, 11.0, -9.0])


def in_waves(boat):
    """Return a boat that takes water along, in waves that die out with depth."""
    return replace(boat, added_mass=[300.0, 900.0, 1200.0, 250.0, 700.0, 500.0],
                   immersion=np.linspace(0.1, 0.6, len(boat.hull.share)))


def random_states(shape, seed, *, height=0.5, tilt=0.5, speed=0.5):
    """Return a `State` of many boats thrown about, seeded."""
    random = np.random.default_rng(seed)
    angles = random.uniform(-tilt, tilt, (*shape, 3))
    orientation = np.stack(from_roll_pitch_yaw(*np.moveaxis(angles, -1, 0)), axis=-1)
    position = random.uniform(-1.0, 1.0, (*shape, 3)) * [2.0, 2.0, height]
    return State(position, orientation, random.normal(size=(*shape, 3)) * speed,
                 random.normal(size=(*shape, 3)) * speed)


def turned(roll=0.0, pitch=0.0, yaw=0.0):
    """Return the quaternion of roll, pitch, yaw in rad as a tuple."""
    return from_roll_pitch_yaw(roll, pitch, yaw)


def fleet_of(boats, seas, state, **options):
    """Return a `Fleet`, which in plain Python does not say that it is slow."""
    with warnings.catch_warnings():
        warnings.simplefilter('ignore', RuntimeWarning)
        return Fleet(boats, seas, state, **options)


def start(boat, state, *, sea=None, **options):
    """Return a `Simulation` of one state, or a `Fleet` of the same boat for states (B,)."""
    sea = sea or Sea()
    if not state.batch_shape:
        return Simulation(boat, sea, state, **options)
    size, = state.batch_shape
    return fleet_of([boat] * size, [sea] * size, state, **options)


def run(moving, seconds, thrust=None):
    """
    Move for a while and return time (n + 1,) and the states as one `State` of n + 1 rows.

    ``moving`` is a `Simulation` or a `Fleet`; ``thrust`` as in its step.
    """
    count = round(seconds * moving.rate)
    time = np.arange(count + 1) / moving.rate
    if isinstance(moving, Simulation):
        done = moving.run(count / moving.rate, thrust)
        return time, center_of_mass_state(moving.boat, done.position, done.orientation,
                                          done.body_velocity, done.angular_velocity)
    states = [moving.state]
    for _ in range(count):
        moving.step(thrust)
        states.append(moving.state)
    return time, State(*(np.stack([getattr(state, name) for state in states]) for name in PARTS))


def simulate(boat, state, seconds, *, sea=None, thrust=None, **options):
    """Return time and the states of a run; ``options`` as of `Simulation` or `Fleet`."""
    return run(start(boat, state, sea=sea, **options), seconds, thrust)


def last_state(boat, state, seconds, *, sea=None, thrust=None, **options):
    """Return the state at the end of a run."""
    moving = start(boat, state, sea=sea, **options)
    count = round(seconds * moving.rate)
    if isinstance(moving, Simulation):
        moving.run(count / moving.rate, thrust)
    else:
        for _ in range(count):
            moving.step(thrust)
    return moving.state


def crossings(time, value, rate, *, rising):
    """
    Return the times at which a sampled function passes zero in one direction.

    ``rate`` is its derivative at the samples: between samples a cubic through both is followed
    to its root, so that the answer is exact to the fourth order of the sampling step.
    """
    sign = 1.0 if rising else -1.0
    found = []
    for i in np.flatnonzero((sign * value[:-1] < 0) & (sign * value[1:] >= 0)):
        h = time[i + 1] - time[i]
        a, b, c, d = value[i], h * rate[i], value[i + 1], h * rate[i + 1]
        roots = np.roots([2 * a + b - 2 * c + d, -3 * a - 2 * b + 3 * c - d, b, a])
        inside = [root.real for root in roots
                  if abs(root.imag) < 1e-9 and -1e-9 < root.real < 1.0 + 1e-9]
        found.append(time[i] + h * inside[0])
    return np.array(found)


def righting_arm(triangles, center, volume, heel):
    """
    Return the righting arm in m of a surface (n, 3, 3) m that displaces ``volume`` m^3, trim 0.

    ``center`` m, the centre of mass above the origin; ``heel`` rad.
    """
    c, s = math.cos(heel), math.sin(heel)
    turned = (triangles - [0.0, 0.0, center]) @ np.array(
        [[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])
    wet, moment = submerged(turned - [0.0, 0.0, level_for(turned, volume)])
    return -moment[1] / wet
