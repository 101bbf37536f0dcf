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

"""How far a simulated motion is from the true one, in metres, and what it cost."""

from dataclasses import dataclass
import math
import time

import numpy as np

from . import reference_solution
from ...physics.boat.boat import Boat
from ...physics.boat.state import center_of_mass_state, State
from ...physics.stepping.integrators import INTEGRATORS
from ...physics.stepping.simulation import Simulation, SimulationError

# How often the motion is compared, at most: ten times in the shortest period that matters.
SAMPLE_RATE = 40.0
# One timing lasts about this long, in s; so many steps in one call that they alone count.
SLICE, SUBSTEPS, MOST_PERIODS = 0.02, 100, 50


@dataclass(frozen=True)
class Run:
    """
    One boat on one sea from one start ``State``, for ``duration`` s.

    ``length`` m turns an angle into a distance: by default `boat_length`.
    """

    name: str
    boat: Boat
    sea: object
    start: State
    duration: float
    length: float = None

    def __post_init__(self):
        """Take the boat's own length where none is given."""
        if self.length is None:
            object.__setattr__(self, 'length', boat_length(self.boat))

    def solve(self, **options):
        """Return the `reference_solution.Reference` of this run."""
        return reference_solution.solve(self.boat, self.sea, self.start, self.duration, **options)

    def simulation(self, integrator, rate, substeps=1):
        """Return a `Simulation` of this run, however unstable."""
        return Simulation(self.boat, self.sea, self.start, rate=rate, integrator=integrator,
                          substeps=substeps)


@dataclass(frozen=True)
class Error:
    """
    Root mean square over time, in m.

    ``position`` of the centre of mass, ``rotation`` angle times the boat's length.
    """

    position: float
    rotation: float

    @property
    def total(self):
        """Return both in one, in m."""
        return math.hypot(self.position, self.rotation)


NOT_FINITE = Error(math.inf, math.inf)


def boat_length(boat):
    """
    Return the distance in m from the centre of mass to the farthest end of a probe.

    Or the largest radius of gyration where that is more.
    """
    offsets = boat.probe_offsets
    ends = np.concatenate([offsets, offsets + np.outer(boat.hull.height, [0.0, 0.0, 1.0])])
    gyration = math.sqrt(boat.principal[0][2] / boat.mass)
    return max(float(np.linalg.norm(ends, axis=1).max()), gyration)


def rotation_angle(first, second):
    """Return the angle in rad (...,) between orientations (..., 4), exact for small angles."""
    scalar = np.abs((first * second).sum(axis=-1))
    vector = (second[..., 3:] * first[..., :3] - first[..., 3:] * second[..., :3]
              + np.cross(first[..., :3], second[..., :3]))
    return 2.0 * np.arctan2(np.linalg.norm(vector, axis=-1), scalar)


def difference(states, truth, length):
    """Return the `Error` between two `State`s of shape (n,); ``length`` m per rad."""
    away = np.linalg.norm(states.position - truth.position, axis=-1)
    angle = length * rotation_angle(states.orientation, truth.orientation)
    return Error(float(np.sqrt(np.mean(away ** 2))), float(np.sqrt(np.mean(angle ** 2))))


def apart(run, first, second):
    """Return the `Error` between two `Reference`s of a run."""
    times = np.linspace(0.0, run.duration, int(run.duration * SAMPLE_RATE) + 1)[1:]
    return difference(first.at(times), second.at(times), run.length)


def reference_error(run, solution):
    """Return the `Error` of a reference, as its distance from a second one ten times finer."""
    return apart(run, solution, run.solve(tolerance=1e-13))


def simulated(run, integrator, rate, substeps=1):
    """
    Return times (n,) s and the `State` (n,) of a run at those published instants.

    None when the motion leaves what numbers can hold.
    """
    stride = max(1, int(rate / SAMPLE_RATE))
    periods = int(run.duration * rate * (1.0 + 1e-12))
    try:
        done = run.simulation(integrator, rate, substeps).run(periods / rate).every(stride)
    except SimulationError:
        return None
    return done.time[1:], center_of_mass_state(
        run.boat, done.position, done.orientation, done.body_velocity, done.angular_velocity)[1:]


def measure(run, solution, integrator, rate, substeps=1):
    """Return the `Error` of an integrator at ``rate`` Hz, compared with a `Reference`."""
    motion = simulated(run, integrator, rate, substeps)
    if motion is None:
        return NOT_FINITE
    times, states = motion
    with np.errstate(all='ignore'):
        error = difference(states, solution.at(times), run.length)
    return error if math.isfinite(error.total) else NOT_FINITE


def force_evaluations(integrator, rate, substeps=1):
    """Return how often an integrator computes the force per simulated second."""
    return INTEGRATORS[integrator].evaluations * rate * substeps


def step_seconds(runs, integrators, *, step=0.001, repeats=5):
    """
    Return the CPU time in s of one step alone, a dict by (key, integrator).

    ``runs`` is a dict of `Run`s.  The best of interleaved repetitions: whatever else the machine
    does can only add.
    """
    simulations = {(key, integrator): run.simulation(integrator, 1.0 / (SUBSTEPS * step), SUBSTEPS)
                   for key, run in runs.items() for integrator in integrators}
    periods = {key: min(MOST_PERIODS, max(1, int(SLICE / (SUBSTEPS * _seconds(simulation, 1)))))
               for key, simulation in simulations.items()}
    best = dict.fromkeys(simulations, math.inf)
    for _ in range(repeats):
        for key, simulation in simulations.items():
            best[key] = min(best[key], _seconds(simulation, periods[key]))
    return best


def _seconds(simulation, periods):
    """Return the CPU time in s of one of the steps of some periods from the start."""
    simulation.reset()
    began = time.process_time()
    simulation.run(periods / simulation.rate)
    return (time.process_time() - began) / (periods * simulation.substeps)
