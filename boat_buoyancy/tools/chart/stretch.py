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

"""Stretches of a scene: the motion by which a setting is chosen, and one to check it on."""

from dataclasses import dataclass, replace
import math

import numpy as np

from .accuracy import Run
from ...physics.boat.state import State
from ...physics.hydrostatics.rest import draft, floats, rest_state
from ...physics.rotation import from_roll_pitch_yaw, to_roll_pitch_yaw
from ...physics.scene.scene import scene_from_values

# Long enough for the root mean square of an irregular sea to mean something.
WAVE_PERIODS = 10
LEAST_DURATION, MOST_DURATION = 20.0, 60.0
# A push for a boat that would not move at all: part of the draft, and rad of roll and pitch.
PUSH_HEAVE, PUSH_ROLL, PUSH_PITCH = 0.2, 0.1, 0.05


@dataclass(frozen=True)
class Stretch:
    """
    A scene over some time.

    Main arguments: ``name`` in words; ``given`` parameters {name: value}; ``duration`` s.
    Other arguments: ``clock`` s at which its sea starts; ``push``, how hard a boat at rest in
    still water is pushed (1 = as the constants above); ``scale`` of the start's distance from
    rest and of its speed.
    """

    name: str
    given: dict
    duration: float
    clock: float = 0.0
    push: float = 0.0
    scale: float = 1.0

    def run(self, changes=None):
        """Return the `Run`, with some parameters ``changes`` {name: value}."""
        scene = scene_from_values({**self.given, **(changes or {})})
        start = scene.start
        if self.push or self.scale != 1.0:
            start = _moved(scene.boat, start, self.push, self.scale)
        sea = scene.sea.starting_at(self.clock) if self.clock else scene.sea
        return Run(self.name, scene.boat, sea, start, self.duration)


def stretches(given):
    """
    Return two `Stretch`es: one to choose a setting by, one to check it on.

    The second is another seed of an irregular sea, another stretch of regular waves, and in
    still water another start.
    """
    scene = scene_from_values(given)
    if not scene.sea.is_flat:
        amplitude, period = scene.sea.waves[:, 0], scene.sea.waves[:, 1]
        dominant = float((amplitude ** 2 * period).sum() / (amplitude ** 2).sum())
        duration = min(max(WAVE_PERIODS * dominant, LEAST_DURATION), MOST_DURATION)
        duration = float(math.ceil(duration))
        chosen = Stretch('its waves', given, duration)
        if scene.values['sea.sea_state'] or scene.values['sea.significant_height']:
            seed = scene.values['sea.seed']
            other = seed + 1 if seed < 2 ** 62 else seed - 1
            return chosen, Stretch('another seed of the sea', {**given, 'sea.seed': other},
                                   duration)
        # Far from a whole number of periods, whatever the period is.
        return chosen, replace(chosen, name='another stretch of its waves',
                               clock=duration + 0.381966 * dominant)
    if _moves(scene):
        chosen = Stretch('its motion from the start', given, LEAST_DURATION)
        return chosen, replace(chosen, name='a start nine tenths as far from rest', scale=0.9)
    chosen = Stretch('a free decay after a push, as nothing moves by itself', given,
                     LEAST_DURATION, push=1.0)
    return chosen, replace(chosen, name='a free decay after a push the other way', push=-0.9)


def _moves(scene):
    """Return True when the boat does not start at rest, or water, wind or weight move it."""
    start = scene.start
    if start.velocity.any() or start.angular_velocity.any() or scene.sea.current.any():
        return True
    if scene.sea.wind.any() and scene.boat.damping.wind.any():
        return True
    if not floats(scene.boat):
        return True
    rest = rest_state(scene.boat)
    roll, pitch, _ = to_roll_pitch_yaw(tuple(start.orientation))
    return (abs(start.position[2] - rest.position[2]) > 1e-6 or abs(roll) > 1e-6
            or abs(pitch) > 1e-6)


def _moved(boat, start, push, scale):
    """Return a start pushed from where it is, and scaled about rest."""
    rest = rest_state(boat)
    roll, pitch, yaw = to_roll_pitch_yaw(tuple(start.orientation))
    orientation = from_roll_pitch_yaw(
        scale * roll + push * PUSH_ROLL, scale * pitch + push * PUSH_PITCH, yaw)
    height = rest.position[2] + scale * (start.position[2] - rest.position[2])
    # Down, not up: a boat of little draft must not start out of the water.
    height -= push * PUSH_HEAVE * (draft(boat, rest) if floats(boat) else 0.0)
    return State(np.array([*start.position[:2], height]), orientation, scale * start.velocity,
                 scale * start.angular_velocity)
