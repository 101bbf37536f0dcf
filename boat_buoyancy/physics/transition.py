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

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .fading import coming, Group, same_waves
from .waves import Sea

# A flood of new seas must not make every step dearer: the newest waits while so many fade.
MAX_FADING = 8


@dataclass(frozen=True)
class Part:
    """
    Waves at one instant.

    ``sea`` as it is at ``time`` s, its time going at ``pace`` times that of the rest; ``weight``
    and its ``change`` in 1/s, by which the surface itself rises.
    """

    sea: Sea
    time: float
    pace: float
    weight: float
    change: float

    def surface(self, points):
        """Return the part's share of what `Sea.surface` gives."""
        if points.ndim == 2:
            # One boat's points bring their time along.
            points = np.vstack([points[:4], np.full_like(points[4:], self.time)])
        surface = self.sea.surface(points, self.time)
        height = surface[0].copy()
        surface[0] *= self.weight
        surface[1:] *= self.weight * self.pace
        surface[3] += self.change * height
        return surface

    def elevation(self, x, y):
        """Return the part's share of the height of the surface in m."""
        return self.weight * self.sea.elevation(x, y, self.time)

    def velocity(self, x, y):
        """Return the part's share of the water velocity, (..., 3) m/s, its current included."""
        current = [*self.sea.current, 0.0]
        orbital = self.sea.velocity(x, y, self.time) - current
        velocity = self.weight * (self.pace * orbital + current)
        velocity[..., 2] += self.change * self.sea.elevation(x, y, self.time)
        return velocity


@dataclass(frozen=True)
class Blend:
    """The sea of one instant of a transition: the sum of its ``parts``."""

    parts: tuple

    @cached_property
    def _waving(self):
        return tuple(part for part in self.parts if not part.sea.is_flat)

    @property
    def is_flat(self):
        """Return True when no part has waves."""
        return not self._waving

    @property
    def waves(self):
        """Return the rows (W, 4) of all parts, as each has them."""
        return np.concatenate([part.sea.waves for part in self.parts])

    @cached_property
    def current(self):
        """Return (2,) m/s in world x and y."""
        return sum(part.weight * part.sea.current for part in self.parts)

    @property
    def drift(self):
        """Return the current as three components in world axes, None when there is none."""
        return (*self.current.tolist(), 0.0) if self.current.any() else None

    def surface(self, points, time):
        """Return elevation and water velocity, (4, n, B) or (4, n), as `Sea.surface` does."""
        first, *others = self._waving
        result = first.surface(points)
        for part in others:
            result += part.surface(points)
        return result

    def elevation(self, x, y, time):
        """Return the height of the surface in m at world ``x`` and ``y`` m."""
        return sum(part.elevation(x, y) for part in self.parts)

    def velocity(self, x, y, time):
        """Return the water velocity at the surface, (..., 3) m/s, world axes, with current."""
        return sum(part.velocity(x, y) for part in self.parts)


@dataclass(frozen=True)
class SeaTransition:
    """
    A sea in cross-fade, in place of a `Sea` in a simulation.

    ``groups`` of waves from ``start`` to ``end`` s; from then on ``new``; ``before``, the groups
    without the last fade.  Over a fade of T s the surface of
    a wave of amplitude a and frequency w, to or from flat water, rises no faster than the wave's
    own a w while w T >= 1.89 (`test_transition` derives it): up to periods of 3.3 T.  Longer
    waves are felt: raise the duration.
    """

    groups: tuple
    new: Sea
    start: float
    end: float
    before: tuple = ()

    def at(self, time):
        """Return the sea in force at ``time``: the new one, or a `Blend`."""
        if self.settled(time):
            return self.new
        parts = []
        for group in self.groups:
            weight, change = group.weight(time)
            if weight != 0.0 or change != 0.0:
                parts.append(Part(group.sea, *group.clock(time), weight, change))
        return Blend(tuple(parts))

    def settled(self, time):
        """Return True when only the new sea is left."""
        return time >= self.end

    def fading(self, time):
        """Return how many seas are fading in at ``time``."""
        return len({fade.start for group in self.groups for fade in group.fades
                    if fade.comes and fade.end > time})

    @property
    def fastest_water(self):
        """Return a bound of the water speed at the surface in m/s, over the whole fade."""
        return sum(group.fastest_water for group in self.groups)

    def elevation(self, x, y, time):
        """Return the height of the surface in m at world ``x``, ``y`` m and one ``time`` s."""
        return self.at(time).elevation(x, y, time)

    def velocity(self, x, y, time):
        """Return the water velocity at the surface, (..., 3) m/s, at one ``time`` s."""
        return self.at(time).velocity(x, y, time)

    def starting_at(self, time):
        """Return the same transition with its clock set so that 0 is this one's ``time`` s."""
        groups, before = (tuple(group.starting_at(time) for group in some)
                          for some in (self.groups, self.before))
        return SeaTransition(groups, self.new.starting_at(time), self.start - time,
                             self.end - time, before)


def fade(sea, new, time, duration):
    """
    Return what fades from ``sea`` to ``new`` over ``duration`` s from ``time`` on; 0 = at once.

    ``sea`` may itself be in transition.  None while `MAX_FADING` seas are fading: try again.
    """
    if duration == 0.0:
        return new
    if isinstance(sea, SeaTransition) and not sea.settled(time):
        if sea.start == time:
            # The last had no time to begin.
            before = sea.before
        elif sea.fading(time) >= MAX_FADING:
            return None
        else:
            before = tuple(filter(None, (group.pruned(time) for group in sea.groups)))
    else:
        before = (Group(sea.at(time)),)
    going, again = [], np.zeros(len(new.waves), bool)
    for group in before:
        left = np.flatnonzero(~again)
        kept, found = same_waves(group.sea, replace(new, waves=new.waves[left]))
        if group.stays:
            again[left[found]] = True
        going += group.replaced(kept, time, duration)
    return SeaTransition((*going, *coming(new, again, time, duration)), new, time,
                         time + duration, before)
