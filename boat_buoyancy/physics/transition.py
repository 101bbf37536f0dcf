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

Both seas are exact at the ends, also when a third arrives during the fade.  A sea slows down to
a standstill while it fades out, and starts from one while it fades in: a wave that rises, falls
and grows at its full pace at once would shake a boat harder.  The surface rises continuously,
and its rise counts as water velocity.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .waves import Sea

# A flood of new seas must not make every step dearer: the newest waits while so many fade.
MAX_FADING = 8
# The steepest slope of the weight over the duration of the fade.
STEEPEST = 15.0 / 8.0
# As `pace`, of waves that are the same in both seas.
FULL_PACE = 1.0, 0.0


def weight(part):
    """
    Return the weight of the new sea and its slope, after this part of the fade.

    The polynomial of least degree that leaves and arrives without slope or bend.
    """
    return part ** 3 * (10.0 - 15.0 * part + 6.0 * part ** 2), 30.0 * (part * (1.0 - part)) ** 2


def pace(part):
    """
    Return how fast time goes for a sea, and how far it is off, this part of the fade from alone.

    The pace is 1 where the sea is alone and 0 where it has no weight; what it leaves out of the
    time is in units of the duration.
    """
    return (1.0 - part) ** 2, part ** 2 - part ** 3 / 3.0


@dataclass(frozen=True)
class Part:
    """
    A sea in a blend.

    ``sea`` with its waves at ``pace`` times their speed, as they are ``ahead`` s later.
    """

    sea: object
    pace: float
    ahead: float

    def surface(self, points, time):
        """Return elevation and water velocity, (4, n, B) or (4, n), as `Sea.surface` does."""
        if self.sea.is_flat:
            return np.zeros((4, *points.shape[1:]))
        time = time + self.ahead
        if points.ndim == 2:
            # One boat's points bring their time along.
            points = np.vstack([points[:4], np.full_like(points[4:], time)])
        surface = self.sea.surface(points, time)
        surface[1:] *= self.pace
        return surface

    def elevation(self, x, y, time):
        """Return the height of the surface in m."""
        return self.sea.elevation(x, y, time + self.ahead)

    def orbital_velocity(self, x, y, time):
        """Return the water velocity at the surface without the current, (..., 3) m/s."""
        velocity = self.sea.velocity(x, y, time + self.ahead)
        return self.pace * (velocity - [*self.sea.current, 0.0])


@dataclass(frozen=True)
class Blend:
    """
    Two seas at one instant: (1 - ``weight``) times ``old`` plus ``weight`` times ``new``.

    ``old`` and ``new`` are each a `Part`; ``rate`` 1/s is the weight's change in time, by which
    the surface itself rises.
    """

    old: Part
    new: Part
    weight: float
    rate: float

    @property
    def is_flat(self):
        """Return True when neither sea has waves."""
        return self.old.sea.is_flat and self.new.sea.is_flat

    @property
    def waves(self):
        """Return the rows (W, 4) of both seas, as each has them."""
        return np.concatenate([self.old.sea.waves, self.new.sea.waves])

    @cached_property
    def current(self):
        """Return (2,) m/s in world x and y."""
        return self._mix(self.old.sea.current, self.new.sea.current)

    @property
    def drift(self):
        """Return the current as three components in world axes, None when there is none."""
        return (*self.current.tolist(), 0.0) if self.current.any() else None

    def surface(self, points, time):
        """Return elevation and water velocity, (4, n, B) or (4, n), as `Sea.surface` does."""
        old, new = self.old.surface(points, time), self.new.surface(points, time)
        result = self._mix(old, new)
        result[3] += self.rate * (new[0] - old[0])
        return result

    def elevation(self, x, y, time):
        """Return the height of the surface in m at world ``x``, ``y`` m and ``time`` s."""
        return self._mix(self.old.elevation(x, y, time), self.new.elevation(x, y, time))

    def velocity(self, x, y, time):
        """Return the water velocity at the surface, (..., 3) m/s, world axes, with current."""
        result = self._mix(*(part.orbital_velocity(x, y, time) for part in (self.old, self.new)))
        result[..., 2] += self.rate * (
            self.new.elevation(x, y, time) - self.old.elevation(x, y, time))
        return result + [*self.current, 0.0]

    def _mix(self, old, new):
        return (1.0 - self.weight) * old + self.weight * new


@dataclass(frozen=True)
class SeaTransition:
    """
    A sea in cross-fade, in place of a `Sea` in a simulation.

    ``old``, a `Sea` or itself a transition, until ``start`` s; ``new`` from ``start`` +
    ``duration`` s on; between them a `Blend`.  Over a fade of T s the surface of a wave of
    amplitude a and frequency w, to or from flat water, rises no faster than the wave's own a w
    while w T >= 1.89 (`test_transition` derives it): up to periods of 3.3 T.  Longer waves are
    felt: raise the duration.
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
        if part <= 0.0:
            return self.old.at(time)
        share, slope = weight(part)
        (old_pace, late), (new_pace, early) = (
            2 * [FULL_PACE] if self._is_same_water else (pace(part), pace(1.0 - part)))
        late, early = -self.duration * late, self.duration * early
        return Blend(Part(self.old.at(time + late), old_pace, late),
                     Part(self.new, new_pace, early), share, slope / self.duration)

    @cached_property
    def _is_same_water(self):
        """Return True when the waves stay as they are and only the current changes."""
        old, new = self.old, self.new
        return (isinstance(old, Sea) and np.array_equal(old.waves, new.waves)
                and (old.depth, old.gravity) == (new.depth, new.gravity))

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
