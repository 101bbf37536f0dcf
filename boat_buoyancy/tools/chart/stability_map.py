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
from pathlib import Path
import sys

import numpy as np

from ...physics import load_scene
from ...physics.boat import Boat, Damping, State
from ...physics.equilibrium import Equilibrium, modes
from ...physics.hull import Hull
from ...physics.simulation import Simulation, SimulationError
from ...physics.step_limits import combined_step
from ...physics.waves import Sea

# A boat that bobs at 1 rad/s: a step of h s is then omega h = h.
MASS, GRAVITY = 1.0, 9.81
# A nudge that meets no kink of the spring while it grows a thousandfold.
NUDGE, GROWN = 1e-5, 1e3
RATES = (30.0, 60.0, 100.0)


def bobbing_boat(ratio=0.0, retention=1.0):
    """Return a boat with one probe, omega = 1 rad/s and that damping ratio in heave alone."""
    hull = Hull([[0.0, 0.0, 0.0]], [4.0 * MASS * GRAVITY], [4.0 * GRAVITY])
    keep = {name: [retention if name == 'linear_retention' else 1.0] for name in (
        'linear_retention', 'angular_retention', 'air_linear_retention',
        'air_angular_retention')}
    heave = [0.0, 0.0, 2.0 * ratio * MASS, 0.0, 0.0, 0.0]
    return Boat(MASS, hull, [1.0, 1.0, 1.0], Damping(linear=heave, **keep), gravity=GRAVITY)


def disturbance(boat, integrator, h, steps):
    """
    Return heave (n,) m and its speed (n,) m/s after a nudge, run with a step of h s.

    n is steps + 1, or less when it has grown a thousandfold or the guard has stopped it.
    """
    simulation = Simulation(boat, Sea(gravity=GRAVITY),
                            State((0.0, 0.0, NUDGE - GRAVITY), velocity=(0.0, 0.0, NUDGE)),
                            rate=1.0 / h, integrator=integrator)
    heave, speed = [], []
    for _ in range(steps + 1):
        motion = simulation.motion
        heave.append(motion.position[2] + GRAVITY)
        # The boat stays level: what is up in its own axes is up.
        speed.append(motion.velocity[2])
        if abs(heave[-1]) + abs(speed[-1]) > GROWN * NUDGE:
            break
        try:
            simulation.step()
        except SimulationError:
            break
    return np.array(heave), np.array(speed)


def stays_calm(boat, integrator, h, steps):
    """Return whether a small heave does not grow from the first third of a run to the last."""
    size = np.hypot(*disturbance(boat, integrator, h, steps))
    if len(size) <= steps:
        return False
    third = steps // 3
    return bool(size[-third:].max() <= size[:third].max() * (1.0 + 1e-9))


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
    fine = np.linspace(0.0, ratios[-1] + (ratios[-1] - ratios[-2]) / 2.0, 81)
    return StabilityMap(angles, ratios, calm, np.array([
        (ratio, predicted_angle(bobbing_boat(ratio), integrator)) for ratio in fine]))


def predicted_angle(boat, integrator):
    """Return the predicted omega h from which a `bobbing_boat` shakes, infinite without limit."""
    step = combined_step(Equilibrium.of(boat), integrator)
    return np.inf if step is None else step


def loop_growth(angle, drag):
    """
    Return the factor per step by which the plain game loop multiplies a small heave.

    ``angle`` omega h of the spring, 0 for a boat in free flight; ``drag`` drag times dt.
    Measured from the first steps of the shipped ``symplectic_euler``: what repeats itself as
    z(n + 2) = a z(n + 1) + b z(n) grows by the larger root of r^2 = a r + b (Prony).
    """
    if angle == 0.0:
        return abs(_speed_kept(drag))
    boat = bobbing_boat(retention=np.exp(-drag / angle))
    heave, _ = disturbance(boat, 'symplectic_euler', angle, 8)
    (a, b), *_ = np.linalg.lstsq(np.stack([heave[1:-1], heave[:-2]], axis=1), heave[2:])
    return float(np.abs(np.roots([1.0, -a, -b])).max())


def _speed_kept(drag):
    """Return by what one step of the plain game loop multiplies a speed in free flight."""
    hull = Hull([[0.0, 0.0, 0.0]], [MASS * GRAVITY], [1.0])
    boat = Boat(MASS, hull, [1.0] * 3, Damping([1.0], [1.0], [np.exp(-drag)], [1.0]))
    simulation = Simulation(boat, Sea(), State((0.0, 0.0, 1e6), velocity=(1.0, 0.0, 0.0)),
                            rate=1.0, integrator='symplectic_euler')
    simulation.step()
    return float(simulation.state.velocity[0])


def predicted_loop_growth(angle, drag):
    """Return the spectral radius of v += a h; v *= 1 - drag; x += v h in closed form."""
    kept = 1.0 - drag
    trace = 1.0 + kept - kept * angle ** 2
    root = np.emath.sqrt(trace ** 2 - 4.0 * kept)
    free = np.abs(kept)
    return np.where(angle == 0.0, free, np.maximum(np.abs(trace + root), np.abs(trace - root)) / 2)


def shipped_scenes():
    """Return the parameter files that come with the package, from its source or as installed."""
    source = Path(__file__).parents[3] / 'config'
    installed = Path(sys.prefix) / 'share' / 'boat_buoyancy' / 'config'
    return sorted((source if source.is_dir() else installed).glob('*.yaml'))


def scene_points(path):
    """Return (3, 2): omega h at each of RATES, and the damping ratio, of the fastest mode."""
    found = [mode for mode in modes(load_scene(path).boat).values() if mode.period is not None]
    fastest = max(found, key=lambda mode: mode.angular_frequency)
    return np.array([(fastest.angular_frequency / rate, fastest.damping_ratio)
                     for rate in RATES])
