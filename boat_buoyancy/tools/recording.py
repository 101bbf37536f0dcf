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

"""A run written down: the body frame's motion and the probes' depths, period by period."""

from dataclasses import dataclass
import math
from time import perf_counter

import numpy as np

from ..physics import checks
from ..physics.boat import body_frame, State
from ..physics.quaternion import to_roll_pitch_yaw

# A row is some 200 bytes in memory: this many are two gigabytes.
MAX_PERIODS = 10_000_000


@dataclass(frozen=True)
class Recording:
    """
    What was seen at time 0 and after every period, n rows.

    ``time`` (n,) s; of the body frame ``position`` (n, 3) m and ``orientation`` (n, 4) in the
    world, ``velocity`` (n, 3) m/s and ``angular_velocity`` (n, 3) rad/s in body axes; ``depths``
    (n, probes) m under water.  ``scene`` is the `Scene`, ``simulation`` the `Simulation` at its
    end, ``thrust`` (6,) what pushed it, ``seconds`` what the stepping took.
    """

    time: np.ndarray
    position: np.ndarray
    orientation: np.ndarray
    velocity: np.ndarray
    angular_velocity: np.ndarray
    depths: np.ndarray
    scene: object
    simulation: object
    thrust: np.ndarray
    seconds: float

    @property
    def roll_pitch_yaw(self):
        """Return (n, 3) rad."""
        return np.stack(to_roll_pitch_yaw(self.orientation.T), axis=-1)

    @property
    def surface(self):
        """Return (n,) m, the height of the water over the body origin."""
        # In pieces: a thousand waves at a million times do not fit into memory at once.
        pieces = np.array_split(np.arange(len(self.time)), len(self.time) // 1000 + 1)
        return np.concatenate([self.scene.sea.elevation(
            self.position[rows, 0], self.position[rows, 1], self.time[rows])
            for rows in pieces])


def periods_of(duration, rate):
    """Return how many periods cover ``duration`` s at ``rate`` Hz; ValueError for no time."""
    duration = checks.number('--duration', duration, above=0.0)
    # 0.3 s at 10 Hz are three periods, whatever round-off says.
    periods = math.ceil(duration * rate * (1.0 - 1e-12))
    if periods > MAX_PERIODS:
        raise ValueError(f'--duration: expected at most {MAX_PERIODS} periods, got {duration:g} s '
                         f'at {rate:g} Hz, {periods} periods')
    return periods


def record(scene, simulation, periods, thrust):
    """Step a simulation of one boat of ``scene`` from where it is and return the `Recording`."""
    thrust = checks.vector('--thrust', thrust, 6)
    parts = ('position', 'orientation', 'velocity', 'angular_velocity')
    rows = {part: np.empty((periods + 1, len(getattr(simulation.state, part)))) for part in parts}
    depths = np.empty((periods + 1, len(simulation.probe_depths)))
    seconds = 0.0
    for row in range(periods + 1):
        if row:
            start = perf_counter()
            simulation.step(thrust)
            seconds += perf_counter() - start
        state = simulation.state
        for part in parts:
            rows[part][row] = getattr(state, part)
        depths[row] = simulation.probe_depths
    return Recording(np.arange(periods + 1) / simulation.rate,
                     *body_frame(scene.boat, State(**rows)), depths, scene, simulation, thrust,
                     seconds)
