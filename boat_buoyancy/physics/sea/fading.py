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
A sea that turns into another without a jump: every wave goes from one amplitude to another.

What stays of the old sea fades out while the new one fades in, on a smooth ramp; the change of
amplitude is part of the water's velocity.  The surface never jumps; where a third sea comes in
the middle, the speed at which it rises and sinks does.  The wind is the new sea's from the start:
it only pushes, so that nothing jumps with it, and who sends gusts wants each of them at once.
The current fades with the waves; each of them keeps the length and the orbital speed that it has
on the full current of its own sea.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .waves import (
    ALONG_X, ALONG_Y, BOTTOM, FREQUENCY, INTRINSIC, KX, KY, PHASE, RISE, SEA, Sea, START, Water)
from ..compiled import compiled

# The steepest slope of the ramp times its duration.
STEEPEST = 15.0 / 8.0
# What makes two waves the same but for their amplitude.
WAVE = [KX, KY, FREQUENCY, PHASE, INTRINSIC, BOTTOM]


@compiled
def smooth(p):
    """
    Return weight and slope of the ramp at the part p of the fade, 0 to 1.

    s = p^3 (10 - 15 p + 6 p^2), the polynomial of least degree that leaves and arrives without
    slope or bend.
    """
    return (p * p * p * (10.0 - 15.0 * p + 6.0 * p * p),
            30.0 * p * p * (1.0 - p) * (1.0 - p))


@compiled
def ramp(sea, t):
    """Return the weight of the new sea at t s, 0 to 1, and its change in 1/s."""
    weight, slope = smooth(min(max((t - sea.fade_start) / sea.fade_duration, 0.0), 1.0))
    return weight, slope / sea.fade_duration


@compiled
def current(sea, weight):
    """Return (3) m/s, the current in world axes at a weight of the new sea."""
    return (sea.current[0] + weight * sea.current_rise[0],
            sea.current[1] + weight * sea.current_rise[1], 0.0)


@dataclass(frozen=True, eq=False)
class FadingSea(Water):
    """
    A sea that turns into ``new`` from ``start`` s on, over ``duration`` s; made by `fade`.

    ``table`` (10, W) of the waves of both, amplitudes as they start and what they rise by;
    ``current_start`` (2,) m/s; ``layered``: it began while another fade was under way.
    """

    table: np.ndarray
    current_start: np.ndarray
    new: Sea
    start: float
    duration: float
    layered: bool = False

    def _ramp(self, time):
        """Return weight and its change in 1/s, (..., 1) each."""
        part = np.clip((np.asarray(time, float) - self.start) / self.duration, 0.0, 1.0)
        weight, slope = smooth(part[..., None])
        return weight, slope / self.duration

    def amplitudes(self, time):
        """Return amplitude (..., W) m of each wave, and its change (..., W) in m/s."""
        weight, rate = self._ramp(time)
        return self.table[START] + weight * self.table[RISE], rate * self.table[RISE]

    def current_at(self, time):
        """Return the current (..., 2) m/s."""
        return self.current_start + self._ramp(time)[0] * (self.new.current - self.current_start)

    @property
    def waves(self):
        """Return the rows (W, 4) of the new sea, the one that will be in force."""
        return self.new.waves

    @property
    def current(self):
        """Return (2,) m/s, the current of the new sea."""
        return self.new.current

    @property
    def wind(self):
        """Return (2,) m/s, the wind of the new sea."""
        return self.new.wind

    @property
    def is_flat(self):
        """Return False: the water moves until the fade is over."""
        return False

    @cached_property
    def record(self):
        """Return what the step reads beside the waves, as a record of `SEA`."""
        return np.array((self.table.shape[1], self.start, self.duration, self.current_start,
                         self.new.current - self.current_start, self.wind), SEA)

    def settled(self, time):
        """Return True when only the new sea is left."""
        return time >= self.start + self.duration

    @property
    def fastest_water(self):
        """Return a bound of the water speed at the surface in m/s, over the whole fade."""
        begin, end = self.table[START], self.table[START] + self.table[RISE]
        along = np.hypot(self.table[ALONG_X], self.table[ALONG_Y])
        return float(np.maximum(np.abs(begin), np.abs(end)) @ along
                     + STEEPEST / self.duration * np.abs(self.table[RISE]).sum()
                     + self.fastest_current[0])

    @property
    def fastest_current(self):
        """Return a bound of the current in m/s, and of its change in m/s^2, over the fade."""
        return (float(max(np.hypot(*self.current_start), np.hypot(*self.new.current))), float(
            STEEPEST / self.duration * np.hypot(*(self.new.current - self.current_start))))

    def with_wind(self, wind):
        """Return the same fade under another wind (2,) m/s."""
        return replace(self, new=self.new.with_wind(wind))

    def starting_at(self, time):
        """Return the same fade with its clock set so that 0 is this one's ``time`` s."""
        table = self.table.copy()
        table[PHASE] = np.fmod(table[PHASE] - table[FREQUENCY] * time, 2.0 * np.pi)
        return replace(self, table=table, new=self.new.starting_at(time), start=self.start - time)


def fade(sea, new, time, duration):
    """
    Return what fades from ``sea`` to the `Sea` ``new`` over ``duration`` s from ``time`` on.

    0 s is at once.  ``sea`` may be under way itself: then the fade starts from what is there.
    None when that one had begun like this, too: wait until it has settled, so that seas that
    arrive faster than they fade never make a step dearer.
    """
    if duration == 0.0:
        return new
    under_way = isinstance(sea, FadingSea) and not sea.settled(time)
    if under_way and sea.layered and time > sea.start:
        return None
    if isinstance(sea, FadingSea) and not under_way:
        sea = sea.new
    there = sea.table.copy()
    there[START] = sea.amplitudes(time)[0]
    there[RISE] = -there[START]
    # What has not begun to come, or is gone, is not carried along.
    there = there[:, there[START] != 0.0]
    coming = new.table.copy()
    coming[RISE], coming[START] = coming[START], 0.0
    # A wave of both seas only changes its amplitude.
    places = {tuple(wave): i for i, wave in enumerate(there[WAVE].T.tolist())}
    again = [places.pop(tuple(wave), None) for wave in coming[WAVE].T.tolist()]
    for column, place in enumerate(again):
        if place is not None:
            there[RISE, place] += coming[RISE, column]
    table = np.concatenate([there, coming[:, [place is None for place in again]]], axis=1)
    return FadingSea(np.ascontiguousarray(table), sea.current_at(time), new, time, duration,
                     under_way and (time > sea.start or sea.layered))
