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

"""Where each integrator keeps a boat at rest calm, measured by running it, and as predicted."""

from dataclasses import dataclass

import numpy as np

from ...physics import load_scene
from ...physics.boat.boat import Boat, Damping
from ...physics.boat.hull import Hull
from ...physics.boat.state import State
from ...physics.hydrostatics.natural_modes import modes
from ...physics.sea.waves import Sea
from ...physics.step_size.balance import at_rest, drifting
from ...physics.step_size.limits import largest_stable_step, step_jacobian
from ...physics.stepping.simulation import Simulation, SimulationError

# A boat that bobs at 1 rad/s: a step of h s is then omega h = h.
MASS, GRAVITY = 1.0, 9.81
# A nudge that meets no kink of the spring while it grows a thousandfold.
NUDGE, GROWN = 1e-5, 1e3
# Points of a predicted boundary, and to what part of it they are known.
BOUNDARY, DRAWN = 61, 1e-3
# Their places in a `step_jacobian`.
HEAVE, HEAVE_SPEED = 0, 5
RATES = (30.0, 60.0, 100.0)


def bobbing_boat(ratio=0.0, retention=1.0):
    """
    Return a boat with one probe and omega = 1 rad/s, damped in heave alone.

    ``ratio`` of its damping to critical; ``retention``, in water and in air.
    """
    hull = Hull([[0.0, 0.0, 0.0]], [4.0 * MASS * GRAVITY], [4.0 * GRAVITY])
    keep = [1.0, 1.0, retention]
    damping = Damping(keep, [1.0], keep, [1.0],
                      linear=[0.0, 0.0, 2.0 * ratio * MASS, 0.0, 0.0, 0.0])
    return Boat(MASS, hull, [1.0, 1.0, 1.0], damping, gravity=GRAVITY)


def stays_calm(boat, integrator, h, steps):
    """Return whether a small heave does not grow from the first third of a run to the last."""
    simulation = Simulation(boat, Sea(gravity=GRAVITY),
                            State((0.0, 0.0, NUDGE - GRAVITY), velocity=(0.0, 0.0, NUDGE)),
                            rate=1.0 / h, integrator=integrator)
    try:
        run = simulation.run(steps * h)
    except SimulationError:
        return False
    # The boat stays level: what is up in its own axes is up.
    size = np.hypot(run.position[:, 2] + GRAVITY, run.body_velocity[:, 2])
    third = steps // 3
    return bool(size.max() < GROWN * NUDGE
                and size[-third:].max() <= size[:third].max() * (1.0 + 1e-9))


@dataclass(frozen=True)
class StabilityMap:
    """
    Where an integrator stays calm.

    ``angles`` (A,) omega h and ``ratios`` (R,) damping ratios of the grid; ``calm`` (R, A) of
    bool, measured; ``boundary`` (N, 2) rows of damping ratio and the omega h from which it is
    predicted to grow, infinite without limit.
    """

    angles: np.ndarray
    ratios: np.ndarray
    calm: np.ndarray
    boundary: np.ndarray


def measure_map(integrator, angles, ratios, steps):
    """Return the `StabilityMap` of an integrator on a grid."""
    calm = np.zeros((len(ratios), len(angles)), bool)
    for row, ratio in enumerate(ratios):
        boat = bobbing_boat(ratio)
        for column, angle in enumerate(angles):
            # A slow bob needs more steps to show in which direction it goes.
            long_enough = max(steps, round(2.5 * 2.0 * np.pi / angle))
            calm[row, column] = stays_calm(boat, integrator, angle, long_enough)
    fine = np.linspace(0.0, ratios[-1] + (ratios[-1] - ratios[-2]) / 2.0, BOUNDARY)
    return StabilityMap(angles, ratios, calm, np.array([
        (ratio, predicted_angle(bobbing_boat(ratio), integrator)) for ratio in fine]))


def predicted_angle(boat, integrator):
    """Return the predicted omega h from which a `bobbing_boat` shakes, infinite without limit."""
    step = largest_stable_step(at_rest(boat), integrator, precision=DRAWN)
    return np.inf if step is None else step


def loop_growth(angle, drag):
    """
    Return the factor per step by which the plain game loop multiplies a small heave.

    ``angle`` omega h of the spring, 0 for a boat in free flight, whose speed it multiplies;
    ``drag`` drag times dt.  Of one step of the shipped ``symplectic_euler``.
    """
    if angle == 0.0:
        _, air = drifting(bobbing_boat(retention=np.exp(-drag)))
        return abs(step_jacobian(air, 'symplectic_euler', 1.0)[HEAVE_SPEED, HEAVE_SPEED])
    boat = bobbing_boat(retention=np.exp(-drag / angle))
    step = step_jacobian(at_rest(boat), 'symplectic_euler', angle)
    heave = np.ix_([HEAVE, HEAVE_SPEED], [HEAVE, HEAVE_SPEED])
    return float(np.abs(np.linalg.eigvals(step[heave])).max())


def predicted_loop_growth(angle, drag):
    """Return the spectral radius of v += a h; v *= 1 - drag; x += v h in closed form."""
    kept = 1.0 - drag
    trace = 1.0 + kept - kept * angle ** 2
    root = np.emath.sqrt(trace ** 2 - 4.0 * kept)
    free = np.abs(kept)
    return np.where(angle == 0.0, free, np.maximum(np.abs(trace + root), np.abs(trace - root)) / 2)


def scene_points(path):
    """Return (3, 2): omega h at each of RATES, and the damping ratio, of the fastest mode."""
    found = [mode for mode in modes(load_scene(path).boat).values() if mode.period is not None]
    fastest = max(found, key=lambda mode: mode.angular_frequency)
    return np.array([(fastest.angular_frequency / rate, fastest.damping_ratio)
                     for rate in RATES])
