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
A sea that changes without a jump: the old one fades out while the new one fades in.

Both seas are exact at the ends, also when a third arrives during the fade.  The surface rises
continuously, and its rise counts as water velocity.
"""

from dataclasses import dataclass
from functools import cached_property
import math

import numpy as np

from .waves import Sea

# A flood of new seas must not make every step dearer: the newest waits while so many fade.
MAX_FADING = 8
# The steepest slope of the weight over the duration of the fade.
STEEPEST = math.pi / 2


@dataclass(frozen=True)
class Blend:
    """
    Two seas at one instant: (1 - ``weight``) times ``old`` plus ``weight`` times ``new``.

    ``rate`` 1/s is the weight's change in time, by which the surface itself rises.
    """

    old: object
    new: Sea
    weight: float
    rate: float

    @property
    def is_flat(self):
        """Return True when neither sea has waves."""
        return self.old.is_flat and self.new.is_flat

    @property
    def waves(self):
        """Return the rows (W, 4) of both seas, as each has them."""
        return np.concatenate([self.old.waves, self.new.waves])

    @cached_property
    def current(self):
        """Return (2,) m/s in world x and y."""
        return self._mix(self.old.current, self.new.current)

    @property
    def drift(self):
        """Return the current as three components in world axes, None when there is none."""
        return (*self.current.tolist(), 0.0) if self.current.any() else None

    def surface(self, points, time):
        """Return elevation and water velocity, (4, n, B), as `Sea.surface` does."""
        old, new = (np.zeros((4, *points.shape[1:])) if sea.is_flat
                    else sea.surface(points, time) for sea in (self.old, self.new))
        result = self._mix(old, new)
        result[3] += self.rate * (new[0] - old[0])
        return result

    def elevation(self, x, y, time):
        """Return the height of the surface in m at world ``x``, ``y`` m and ``time`` s."""
        return self._mix(self.old.elevation(x, y, time), self.new.elevation(x, y, time))

    def velocity(self, x, y, time):
        """Return the water velocity at the surface, (..., 3) m/s, world axes, with current."""
        result = self._mix(self.old.velocity(x, y, time), self.new.velocity(x, y, time))
        result[..., 2] += self.rate * (
            self.new.elevation(x, y, time) - self.old.elevation(x, y, time))
        return result

    def _mix(self, old, new):
        return (1.0 - self.weight) * old + self.weight * new


@dataclass(frozen=True)
class SeaTransition:
    """
    A sea in cross-fade, in place of a `Sea` in a simulation.

    ``old``, a `Sea` or itself a transition, until ``start`` s; ``new`` from ``start`` +
    ``duration`` s on; between them a `Blend` whose weight is half a cosine, the ramp that asks
    least of a boat.  The surface then rises at most as fast as the faster of both seas plus
    pi/2 times their heights over ``duration``: waves much longer than ``duration`` are felt.
    """

    old: object
    new: Sea
    start: float
    duration: float

    def at(self, time):
        """Return the sea in force at ``time``: the old, the new, or their `Blend`."""
        part = (time - self.start) / self.duration
        if part >= 1.0:
            return self.new
        old = self.old.at(time)
        if part <= 0.0:
            return old
        angle = math.pi * part
        return Blend(old, self.new, 0.5 - 0.5 * math.cos(angle),
                     STEEPEST / self.duration * math.sin(angle))

    def settled(self, time):
        """Return True when only the new sea is left."""
        return time >= self.start + self.duration

    def fading(self, time):
        """Return how many seas are fading in at ``time``."""
        if self.settled(time):
            return 0
        return 1 + (self.old.fading(time) if isinstance(self.old, SeaTransition) else 0)

    @property
    def fastest_water(self):
        """Return a bound of the water speed at the surface in m/s, over the whole fade."""
        return (self.old.fastest_water + self.new.fastest_water
                + STEEPEST / self.duration * self.highest_water)

    @property
    def highest_water(self):
        """Return a bound of the elevation in m, over the whole fade."""
        return highest_water(self.old) + highest_water(self.new)

    def elevation(self, x, y, time):
        """Return the height of the surface in m at world ``x``, ``y`` m and one ``time`` s."""
        return self.at(time).elevation(x, y, time)

    def velocity(self, x, y, time):
        """Return the water velocity at the surface, (..., 3) m/s, at one ``time`` s."""
        return self.at(time).velocity(x, y, time)

    def starting_at(self, time):
        """Return the same transition with its clock set so that 0 is this one's ``time`` s."""
        return SeaTransition(self.old.starting_at(time), self.new.starting_at(time),
                             self.start - time, self.duration)


def highest_water(sea):
    """Return a bound of the elevation of a sea or transition in m."""
    return sea.highest_water if isinstance(sea, SeaTransition) else float(sea.waves[:, 0].sum())


def fade(sea, new, time, duration):
    """
    Return what fades from ``sea`` to ``new`` over ``duration`` s from ``time`` on; 0 = at once.

    ``sea`` may itself be in transition.  None while `MAX_FADING` seas are fading: try again.
    """
    if isinstance(sea, SeaTransition):
        if sea.fading(time) >= MAX_FADING and duration > 0.0:
            return None
        if sea.settled(time):
            sea = sea.new
    return SeaTransition(sea, new, time, duration) if duration > 0.0 else new
