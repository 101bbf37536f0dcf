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

"""How the node is doing: figures of the last second, and the words for them."""

from dataclasses import dataclass
import math

from ..physics.compiled import kind
from ..physics.hydrostatics.natural_modes import modes
from ..physics.hydrostatics.rest import draft, floats, rest_state


@dataclass(frozen=True)
class Figures:
    """
    What was measured since the last look.

    ``rate`` Hz of steps; ``real_time_factor`` simulated over wall time; ``worst`` s, the longest
    step with its publications; ``dropped`` steps given up.
    """

    rate: float
    real_time_factor: float
    worst: float
    dropped: int


class Meter:
    """Counts steps and times them; all times in s on the steady clock."""

    def __init__(self, rate, now):
        """Begin at ``now``."""
        self._rate = rate
        self.steps = self.dropped = 0
        self._begin(now)

    def _begin(self, now):
        self._since, self._steps, self._dropped = now, self.steps, self.dropped
        self._worst = 0.0

    def step(self, seconds):
        """Count one step that took so long."""
        self.steps += 1
        if seconds > self._worst:
            self._worst = seconds

    def drop(self, steps):
        """Count steps given up."""
        self.dropped += steps

    def look(self, now):
        """Return the `Figures` since the last look."""
        rate = (self.steps - self._steps) / max(now - self._since, 1e-9)
        figures = Figures(rate, rate / self._rate, self._worst, self.dropped - self._dropped)
        self._begin(now)
        return figures


def values(session, meter, figures, complaints, now):
    """Return {key: text} of all that a status shows; ``now`` s on the steady clock."""
    simulation, age = session.simulation, session.thrust.age(now)
    shown = {
        'rate asked (Hz)': f'{simulation.rate:g}',
        'rate held (Hz)': f'{figures.rate:.2f}',
        'real-time factor': f'{figures.real_time_factor:.3f}',
        'steps': str(meter.steps),
        'steps dropped': str(meter.dropped),
        'worst step (ms)': f'{1e3 * figures.worst:.3f}',
        'integrator': simulation.integrator,
        'substeps': str(simulation.substeps),
        'step': kind(),
        'thrust age (s)': 'none' if age is None else f'{age:.2f}',
        'messages refused': str(sum(complaints.counts.values()))}
    shown.update((f'refused, {key}', str(count))
                 for key, count in sorted(complaints.counts.items()))
    return shown


def loaded(scene, simulation):
    """Return one line that says what was loaded and what the boat will do."""
    boat, sea, values = scene.boat, scene.sea, scene.values
    hull = (' x '.join(f'{size:g}' for size in values['hull.size']) + ' m '
            + values['hull.shape'] if 'hull.shape' in values else 'boat')
    count = len(boat.hull.positions)
    what = f'{hull} of {boat.mass:g} kg on {count} probe{"s" if count > 1 else ""}'
    if floats(boat):
        motions = ', '.join(
            f'{name} {mode.period:.3g} s' if mode.period else f'{name} not righted'
            for name, mode in modes(boat).items())
        does = f'draft {draft(boat, rest_state(boat)):.3f} m, {motions}'
    else:
        does = f'sinks, floatiness {boat.floatiness:.3g}'
    water = ('flat water' if sea.is_flat else
             f'{len(sea.waves)} wave{"s" if len(sea.waves) > 1 else ""}, '
             f'significant height {sea.significant_height:.3g} m')
    return (f'{what}: {does}; {simulation.rate:g} Hz, {simulation.integrator}, '
            f'{simulation.substeps} substep{"s" if simulation.substeps > 1 else ""}, {kind()}; '
            f'{water}')


def status_line(frame, time, real_time_factor, paused):
    """Return one line for somebody who watches: ``time`` s, place, attitude, speed."""
    x, y, z = frame.position
    qx, qy, qz, qw = frame.orientation
    roll = math.atan2(2.0 * (qw * qx + qy * qz), 1.0 - 2.0 * (qx * qx + qy * qy))
    pitch = math.asin(max(-1.0, min(1.0, 2.0 * (qw * qy - qz * qx))))
    # Without the minus of what rounds to nothing.
    roll, pitch = (round(math.degrees(angle), 1) + 0.0 for angle in (roll, pitch))
    pace = 'paused' if paused else f'real-time factor {real_time_factor:.2f}'
    return (f't {time:.1f} s, x {x:.2f} y {y:.2f} z {z:.3f} m, roll {roll:.1f} pitch {pitch:.1f} '
            f'deg, speed {math.hypot(*frame.body_velocity):.2f} m/s, {pace}')
