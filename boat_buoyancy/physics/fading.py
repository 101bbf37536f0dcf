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
How one sea fades: its weight, and the pace of its time.

A wave that goes slows down to a standstill, and one that comes starts from there: at its full
pace it would shake a boat harder.  A wave that stays keeps its pace.
"""

from dataclasses import dataclass, replace

import numpy as np

from .waves import Sea

# The steepest slope of the weight over the duration of the fade.
STEEPEST = 15.0 / 8.0


def weight(part):
    """
    Return the weight of the new sea and its slope, after this part of the fade.

    The polynomial of least degree that leaves and arrives without slope or bend.
    """
    return part ** 3 * (10.0 - 15.0 * part + 6.0 * part ** 2), 30.0 * (part * (1.0 - part)) ** 2


def pace(part):
    """
    Return how fast time goes for a wave, and how far it is off, this part of the fade from alone.

    The pace is 1 where the wave is alone and 0 where it has no weight; what it leaves out of the
    time is in units of the duration.
    """
    return (1.0 - part) ** 2, part ** 2 - part ** 3 / 3.0


@dataclass(frozen=True)
class Fade:
    """
    A fade from ``start`` s on over ``duration`` s.

    ``comes`` True for what fades in; ``slows`` True for waves that start from a standstill or
    come to one.
    """

    start: float
    duration: float
    comes: bool
    slows: bool

    @property
    def end(self):
        """Return when the fade is over, in s."""
        return self.start + self.duration

    def _part(self, time):
        return min(max((time - self.start) / self.duration, 0.0), 1.0)

    def weight(self, time):
        """Return the weight at ``time`` s and its change in 1/s."""
        share, slope = weight(self._part(time))
        slope /= self.duration
        return (share, slope) if self.comes else (1.0 - share, -slope)

    def clock(self, time):
        """Return the time in s that the waves have at ``time`` s, and the pace of their time."""
        if not self.slows:
            return time, 1.0
        part = self._part(time)
        if self.comes:
            rate, late = pace(1.0 - part)
            return time + self.duration * late, rate
        rate, late = pace(part)
        # After its end the wave stands still; it has no weight any more.
        return min(time, self.end) - self.duration * late, rate


@dataclass(frozen=True)
class Group:
    """Waves that fade together: a ``sea``, its current among it, and its ``fades`` one by one."""

    sea: Sea
    fades: tuple = ()

    @property
    def stays(self):
        """Return True for what nothing else has begun to replace."""
        return all(fade.comes for fade in self.fades)

    @property
    def fastest_water(self):
        """Return a bound of the water speed that the group adds, in m/s, at any time."""
        height = float(self.sea.waves[:, 0].sum())
        return self.sea.fastest_water + sum(STEEPEST / fade.duration * height
                                            for fade in self.fades)

    def weight(self, time):
        """Return the weight at ``time`` s and its change in 1/s, of all fades together."""
        total, change = 1.0, 0.0
        for fade in self.fades:
            share, slope = fade.weight(time)
            total, change = total * share, change * share + total * slope
        return total, change

    def clock(self, time):
        """Return the time in s that the waves have at ``time`` s, and the pace of their time."""
        total = 1.0
        # What came last turns the clock that all before it go by.
        for fade in reversed(self.fades):
            time, rate = fade.clock(time)
            total *= rate
        return time, total

    def pruned(self, time):
        """Return what is left of the group from ``time`` s on, None when that is nothing."""
        if any(fade.end <= time and not fade.comes for fade in self.fades):
            return None
        if self.stays:
            return replace(self, fades=tuple(fade for fade in self.fades if fade.end > time))
        return self

    def replaced(self, kept, start, duration):
        """
        Return the group as it goes: the rows ``kept`` (W,) at their pace, the rest slower.

        What goes already goes on as it does, only with less weight.
        """
        if not self.stays:
            return (replace(self, fades=(*self.fades, Fade(start, duration, False, False))),)
        return _split(self.sea, kept, self.fades, Fade(start, duration, False, False))

    def starting_at(self, time):
        """Return the same group with its clock set so that 0 is this one's ``time`` s."""
        return Group(self.sea.starting_at(time),
                     tuple(replace(fade, start=fade.start - time) for fade in self.fades))


def coming(sea, kept, start, duration):
    """Return the groups of a new sea: the rows ``kept`` (W,) at their pace, the rest slower."""
    return _split(sea, kept, (), Fade(start, duration, True, False))


def _split(sea, kept, fades, fade):
    """Return one group for each kind of rows; the current is with the first."""
    groups, current = [], sea.current
    for rows, slows in ((kept, False), (~kept, True)):
        if rows.any() or not (groups or slows or (~kept).any()):
            groups.append(Group(replace(sea, waves=sea.waves[rows], current=current),
                                (*fades, replace(fade, slows=slows))))
            current = np.zeros(2)
    return tuple(groups)


def same_waves(old, new):
    """
    Return which rows of two seas (W,), (V,) are the same wave, only higher, lower or shifted.

    They share period and direction and are at most a quarter of a period apart.
    """
    kept, again = np.zeros(len(old.waves), bool), np.zeros(len(new.waves), bool)
    if (old.depth, old.gravity) != (new.depth, new.gravity):
        return kept, again
    places = {}
    for index, (_, period, direction, phase) in enumerate(old.waves.tolist()):
        places.setdefault((period, direction), []).append((index, phase))
    for index, (_, period, direction, phase) in enumerate(new.waves.tolist()):
        for place in places.get((period, direction), ()):
            if np.cos(phase - place[1]) >= 0.0:
                kept[place[0]] = again[index] = True
                places[period, direction].remove(place)
                break
    return kept, again
