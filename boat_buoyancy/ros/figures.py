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
import os
import zlib

import numpy as np

from ..physics.compiled import kind
from ..physics.hydrostatics.natural_modes import modes
from ..physics.hydrostatics.rest import draft, floats, rest_attitude, rest_state


SEA = 'sea'  # the key of the fingerprint


@dataclass(frozen=True)
class Figures:
    """
    What was measured since the last look.

    ``rate`` Hz of steps; ``real_time_factor`` simulated over wall time; ``worst`` s, the longest
    step with its publications, and ``worst_publishing`` s, those alone; ``dropped`` steps given
    up.
    """

    rate: float
    real_time_factor: float
    worst: float
    worst_publishing: float
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
        self._worst = self._worst_publishing = self._stepping = self._publishing = 0.0

    def step(self, stepping, publishing):
        """Count one step, which took so many s, and its publications."""
        self.steps += 1
        self._stepping += stepping
        self._publishing += publishing
        if stepping + publishing > self._worst:
            self._worst = stepping + publishing
        if publishing > self._worst_publishing:
            self._worst_publishing = publishing

    def drop(self, steps):
        """Count steps given up."""
        self.dropped += steps

    def look(self, now):
        """Return the `Figures` since the last look."""
        rate = (self.steps - self._steps) / max(now - self._since, 1e-9)
        figures = Figures(rate, rate / self._rate, self._worst, self._worst_publishing,
                          self.dropped - self._dropped)
        self._begin(now)
        return figures

    def slow(self, lost, pace):
        """
        Return 'publishing', 'stepping' or 'machine': what so many s that were ``lost`` went to.

        One of the first two when once it took half of them, or when on average it takes half of
        what there is for a step at a ``pace`` in Hz of wall time.
        """
        steps = max(1, self.steps - self._steps)
        share = {'publishing': max(self._worst_publishing / lost,
                                   self._publishing / steps * pace),
                 'stepping': max((self._worst - self._worst_publishing) / lost,
                                 self._stepping / steps * pace)}
        most = max(share, key=share.get)
        return most if share[most] > 0.5 else 'machine'


def values(session, meter, figures, complaints):
    """Return {key: text} of all that a status shows."""
    simulation, age = session.simulation, session.thrust.age(session.age)
    shown = {
        SEA: fingerprint(session.sea),
        'rate asked (Hz)': f'{simulation.rate:g}',
        'rate held (Hz)': f'{figures.rate:.2f}',
        'real-time factor': f'{figures.real_time_factor:.3f}',
        'steps': str(meter.steps),
        'steps dropped': str(meter.dropped),
        'worst step (ms)': f'{1e3 * figures.worst:.3f}',
        'worst publishing (ms)': f'{1e3 * figures.worst_publishing:.3f}',
        'integrator': simulation.integrator,
        'substeps': str(simulation.substeps),
        'step': kind(),
        'thrust age (s)': 'none' if age is None else f'{age:.2f}',
        'messages refused': str(complaints.total)}
    forces = session.propulsion.forces
    shown.update((f'thruster {name} (N)', f'{force:.4g}') for name, force in forces.items())
    shown.update((f'refused, {key}', str(count))
                 for key, count in sorted(complaints.counts.items()))
    return shown


def fingerprint(sea):
    """Return eight digits that are the same for the same water, and hardly ever for other."""
    numbers = np.concatenate([sea.waves.ravel(), sea.current, [sea.depth, sea.gravity]])
    # Without the minus of a zero.
    return f'{zlib.crc32((numbers + 0.0).tobytes()):08x}'


def loaded(scene, simulation):
    """Return one line that says what was loaded and what the boat will do."""
    boat, sea, values = scene.boat, scene.sea, scene.values
    what = f'{_shape(values)} of {boat.mass:g} kg on {boat.hull.carriers}'
    if floats(boat):
        motions = ', '.join(
            f'{name} {mode.period:.3g} s' if mode.period else f'{name} not righted'
            for name, mode in modes(boat).items())
        lies = ''.join(f'{name} {abs(angle):.1f} deg {side if angle > 0.0 else other}, '
                       for name, angle, side, other in zip(
                           ('list', 'trim'), np.degrees(rest_attitude(boat) or (0.0, 0.0)),
                           ('to starboard', 'by the bow'), ('to port', 'by the stern'))
                       if abs(angle) >= 0.05)
        does = f'draft {draft(boat, rest_state(boat)):.3f} m, {lies}{motions}'
    else:
        does = f'sinks, floatiness {boat.floatiness:.3g}'
    water = ('flat water' if sea.is_flat else
             f'{len(sea.waves)} wave{"s" if len(sea.waves) > 1 else ""}, '
             f'significant height {sea.significant_height:.3g} m')
    return (f'{what}: {does}; {simulation.rate:g} Hz, {simulation.integrator}, '
            f'{simulation.substeps} substep{"s" if simulation.substeps > 1 else ""}, {kind()}; '
            f'{water}')


def _shape(values):
    """Return the shape of the hull in words."""
    if 'hull.shape' not in values:
        return 'boat'
    if values['hull.shape'] == 'mesh':
        return os.path.basename(values['hull.mesh'])
    return f'{" x ".join(f"{size:g}" for size in values["hull.size"])} m {values["hull.shape"]}'


def status_line(frame, time, real_time_factor, paused):
    """Return one line for somebody who watches: ``time`` s, place, attitude, speed."""
    x, y, z = frame.position
    qx, qy, qz, qw = frame.orientation
    roll = math.atan2(2.0 * (qw * qx + qy * qz), 1.0 - 2.0 * (qx * qx + qy * qy))
    pitch = math.asin(max(-1.0, min(1.0, 2.0 * (qw * qy - qz * qx))))
    pace = 'paused' if paused else f'real-time factor {real_time_factor:.2f}'
    return (f't {time:.1f} s, x {x:.2f} y {y:.2f} z {z:.3f} m, roll {_rounded(roll)} '
            f'pitch {_rounded(pitch)} deg, {heading_and_speed(frame)}, {pace}')


def heading_and_speed(frame):
    """Return in words where a boat heads, counter-clockwise from x, and how fast it goes there."""
    qx, qy, qz, qw = frame.orientation
    heading = math.atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz))
    ahead = round(frame.body_velocity[0], 2) + 0.0
    return f'heading {_rounded(heading)} deg, {ahead:.2f} m/s ahead'


def _rounded(angle):
    """Return an angle in degrees, without the minus of what rounds to nothing."""
    return f'{round(math.degrees(angle), 1) + 0.0:.1f}'
