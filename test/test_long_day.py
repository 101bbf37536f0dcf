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

"""A simulated day in waves leaves nothing behind: no drift, and the waves keep their time."""

from fractions import Fraction

from boat_buoyancy.physics import Damping, Sea, Simulation
from boat_buoyancy.physics.hydrostatics.rest import rest_state
from boats import box_boat
import numpy as np
import pytest

RATE = 100
AMPLITUDE, PERIOD = 0.2, 4.7


def run_day(hours):
    """Return the simulation after so many hours of waves along x, and what each hour showed."""
    boat = box_boat(Damping(probe=0.3 * 2.0 * np.sqrt(1025.0 * 9.81 * 8.0 * 2000.0)))
    simulation = Simulation(boat, Sea([[AMPLITUDE, PERIOD, 0.0, 0.0]]), rest_state(boat),
                            rate=float(RATE))
    rows = []
    for _ in range(hours):
        run = simulation.run(3600.0)
        norm = (run.orientation**2).sum(axis=1) - 1.0
        aside = np.stack([run.position[:, 1], run.orientation[:, 0], run.orientation[:, 2]])
        rows.append((run.position[1:, 2].mean(), abs(norm).max(), *abs(aside).max(axis=1)))
    return simulation, np.array(rows)


def phase_error(simulation):
    """Return in rad how far the wave under the probes is from where exact arithmetic has it."""
    state, boat = simulation.state, simulation.boat
    pitch = state.pitch
    x, _, z = boat.probe_offsets.T
    along = state.position[0] + x * np.cos(pitch) + z * np.sin(pitch)
    up = state.position[2] - x * np.sin(pitch) + z * np.cos(pitch)
    turns = Fraction(simulation.steps, RATE) / Fraction(PERIOD) % 1
    wave_number = (2.0 * np.pi / PERIOD) ** 2 / 9.81
    phase = wave_number * along - 2.0 * np.pi * float(turns)
    elevation = simulation.probe_depths + up
    steep = np.abs(np.sin(phase)) > 0.3
    assert steep.any()
    return np.abs((elevation - AMPLITUDE * np.cos(phase))
                  / (AMPLITUDE * np.sin(phase)))[steep].max()


@pytest.mark.long
def test_a_day_of_waves_along_x_leaves_no_drift_and_keeps_the_phase():
    simulation, rows = run_day(24)
    height, norm, side, roll, yaw = rows.T
    error = phase_error(simulation)
    print(f'mean height, hour 2: {height[1]:.9f} m, last hour: {height[-1]:.9f} m, spread of the '
          f'hours: {np.ptp(height[1:]):.2e} m; quaternion norm off by {norm.max():.2e}; '
          f'y {side.max():.2e} m, roll {2 * roll.max():.2e} rad, yaw {2 * yaw.max():.2e} rad; '
          f'wave phase {error:.2e} rad')
    assert simulation.time == 86400.0
    # The hours hold no whole number of waves, which moves their mean by this much.
    assert abs(height[-1] - height[1]) < 1e-4 * AMPLITUDE + AMPLITUDE * PERIOD / 3600.0 / np.pi
    assert norm.max() < 1e-14
    assert max(side.max(), roll.max(), yaw.max()) < 1e-9
    assert error < 1e-6
