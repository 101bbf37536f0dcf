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

"""The sea: linear (Airy) waves over water of constant depth, and a uniform current and wind."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from .wave_rows import check_waves_run, checked_waves, currents_along, wavenumbers
from .. import checks
from ..compiled import compiled, FUSED, REORDERED
from ..trigonometry import sine_cosine

# Rows of a wave table, a column a wave.  Amplitudes are start + weight * rise, weight 0 to 1 as
# the sea fades (see `fading`); a wave of 1 m moves the water at the speeds given.  The frequency
# is that at a fixed point and makes the phase; the intrinsic one is that in the water, which a
# current carries along, and makes the speeds: up as it is, along divided by tanh(k h).  The last
# is e^(-2 k h), 0 in deep water: what the bottom changes of how a wave dies out.
KX, KY, FREQUENCY, PHASE, START, RISE, ALONG_X, ALONG_Y, INTRINSIC, BOTTOM = range(10)
# What the step reads of a sea beside its waves.
SEA = np.dtype([('waves', 'i8'), ('fade_start', 'f8'), ('fade_duration', 'f8'),
                ('current', 'f8', 2), ('current_rise', 'f8', 2), ('wind', 'f8', 2)])


@compiled(arithmetic=REORDERED)
def surface(waves, number, x, y, t, weight, rate):
    """
    Return the height of the water in m and its orbital velocity (3) m/s at a place and time.

    eta = sum a cos theta, u = sum a s / tanh(k h) cos theta along each wave's direction,
    w = sum a s sin theta + sum a' cos theta, theta = k.x - w t + phase, s the intrinsic
    frequency; amplitudes a = start + weight rise, a' = rate rise.  Of the table's waves, the
    first ``number``: what comes after them would not change the sums, but their order.
    """
    kx, ky, frequency, phase = waves[KX], waves[KY], waves[FREQUENCY], waves[PHASE]
    start, rise, intrinsic = waves[START], waves[RISE], waves[INTRINSIC]
    along_x, along_y = waves[ALONG_X], waves[ALONG_Y]
    eta = u = v = w = 0.0
    for j in range(number):
        theta = kx[j] * x + ky[j] * y - frequency[j] * t + phase[j]
        sine, cosine = sine_cosine(theta)
        amplitude = start[j] + weight * rise[j]
        eta += amplitude * cosine
        u += amplitude * along_x[j] * cosine
        v += amplitude * along_y[j] * cosine
        w += amplitude * intrinsic[j] * sine + rate * rise[j] * cosine
    return eta, (u, v, w)


@compiled(arithmetic=FUSED)
def add_elevation(waves, number, origin, x, y, points, t, weight, heights):
    """
    Add the height of the water in m, as of `surface`, at many places to ``heights`` (n,).

    ``x`` and ``y`` (n,) m from ``origin``, of which the first ``points`` count.
    """
    kx, ky, frequency, phase = waves[KX], waves[KY], waves[FREQUENCY], waves[PHASE]
    for j in range(number):
        amplitude = waves[START][j] + weight * waves[RISE][j]
        along, across = kx[j], ky[j]
        here = along * origin[0] + across * origin[1] - frequency[j] * t + phase[j]
        for i in range(points):
            _, cosine = sine_cosine(along * x[i] + across * y[i] + here)
            heights[i] += amplitude * cosine


# The waves that together carry this part of a sea's energy, the shortest or the longest, do not
# count.
NEGLIGIBLE_ENERGY = 0.01


class Water:
    """
    What every sea can be asked: its surface and its motion, from its table of waves.

    ``table`` (10, W), see above; ``amplitudes`` (time) and ``current_at`` (time) as they are then.
    """

    def _angle(self, x, y, time):
        x, y, time = np.broadcast_arrays(x, y, time)
        kx, ky, frequency, phase = self.table[:4]
        return (x[..., None] * kx + y[..., None] * ky - time[..., None] * frequency + phase)

    @cached_property
    def ends(self) -> tuple[int, int] | None:
        """Return the numbers of the shortest and the longest wave that count; None when flat."""
        amplitude = np.maximum(np.abs(self.table[START]),
                               np.abs(self.table[START] + self.table[RISE]))
        if not amplitude.any():
            return None

        def first(order):
            energy = np.cumsum(amplitude[order] ** 2)
            return int(order[np.argmax(energy >= NEGLIGIBLE_ENERGY * energy[-1])])

        k = np.hypot(self.table[KX], self.table[KY])
        return first(np.argsort(-k)), first(np.argsort(k))

    @cached_property
    def fastest_acceleration(self) -> float:
        """Return a bound of the water's orbital acceleration in m/s^2: sum a s^2 / tanh(kh)."""
        greatest = np.maximum(np.abs(self.table[START]),
                              np.abs(self.table[START] + self.table[RISE]))
        along = np.hypot(self.table[ALONG_X], self.table[ALONG_Y])
        return float(greatest @ (along * self.table[INTRINSIC]))

    @cached_property
    def shortest_length(self) -> float:
        """Return the length in m of the shortest wave that counts, infinite in flat water."""
        if self.ends is None:
            return np.inf
        return float(2.0 * np.pi / np.hypot(*self.table[[KX, KY], self.ends[0]]))

    def elevation(self, x: ArrayLike, y: ArrayLike, time: ArrayLike) -> np.ndarray:
        """Return the height of the surface in m at world ``x``, ``y`` m and ``time`` s."""
        amplitude, _ = self.amplitudes(time)
        return (np.cos(self._angle(x, y, time)) * amplitude).sum(axis=-1)

    def slope(self, x: ArrayLike, y: ArrayLike, time: ArrayLike) -> np.ndarray:
        """Return d eta/dx and d eta/dy, shape (..., 2)."""
        amplitude, _ = self.amplitudes(time)
        return -(np.sin(self._angle(x, y, time)) * amplitude) @ self.table[:2].T

    def velocity(self, x: ArrayLike, y: ArrayLike, time: ArrayLike) -> np.ndarray:
        """Return the water velocity at the surface, (..., 3) m/s, world axes, with current."""
        angle, (amplitude, change) = self._angle(x, y, time), self.amplitudes(time)
        cosine, current = np.cos(angle), self.current_at(time)
        along = (cosine * amplitude) @ self.table[[ALONG_X, ALONG_Y]].T
        up = (np.sin(angle) * amplitude) @ self.table[INTRINSIC] + (cosine * change).sum(axis=-1)
        return np.concatenate([along + current, up[..., None]], axis=-1)


@dataclass(frozen=True, eq=False)
class Sea(Water):
    """
    The water surface and its motion, a function of place and time only, and the wind over it.

    Main arguments: ``waves`` (W, 4), rows of amplitude m, period s, direction rad (where the
    waves go, counter-clockwise from world x) and phase rad, eta = sum a cos(k.x - w t + phase).
    Periods are those at a fixed point: a current makes its waves longer or shorter.
    Other arguments: ``current`` (2,) m/s in world x and y; ``depth`` m, 0 = deep water;
    ``gravity`` m/s^2; ``wind`` (2,) m/s in world x and y, where it blows to.  ValueError says
    which row is wrong, or cannot run against the current, and what is expected.
    """

    waves: ArrayLike = ()
    current: ArrayLike = (0.0, 0.0)
    depth: float = 0.0
    gravity: float = 9.81
    wind: ArrayLike = (0.0, 0.0)

    def __post_init__(self):
        """Store checked, read-only arrays."""
        object.__setattr__(self, 'waves', checked_waves(self.waves))
        object.__setattr__(self, 'current', checks.vector('sea.current', self.current, 2))
        object.__setattr__(self, 'depth', checks.number('sea.depth', self.depth, at_least=0.0))
        object.__setattr__(self, 'gravity', checks.number('gravity', self.gravity, above=0.0))
        object.__setattr__(self, 'wind', checks.vector('wind.velocity', self.wind, 2))
        check_waves_run(self.waves, self.current, self.depth, self.gravity)

    @cached_property
    def angular_frequency(self) -> np.ndarray:
        """Return (W,) rad/s, as seen from a fixed point."""
        return 2 * np.pi / self.waves[:, 1]

    @cached_property
    def _wavenumber(self):
        """Return (W,) rad/m."""
        return wavenumbers(self.waves, self.current, self.depth, self.gravity)

    @cached_property
    def wave_vector(self) -> np.ndarray:
        """Return (W, 2), rad/m along world x and y."""
        k, direction = self._wavenumber, self.waves[:, 2]
        return np.stack([k * np.cos(direction), k * np.sin(direction)], axis=1)

    @cached_property
    def intrinsic_frequency(self) -> np.ndarray:
        """Return (W,) rad/s, as who drifts with the current sees it: w - k.U."""
        if not self.current.any():
            return self.angular_frequency
        along = currents_along(self.waves, self.current)
        shallow = np.tanh(self._wavenumber * self.depth) if self.depth else 1.0
        # The same as w - k.U, which loses its digits in a strong current.
        return np.where(along, np.sqrt(self.gravity * self._wavenumber * shallow),
                        self.angular_frequency)

    @cached_property
    def _horizontal_ratio(self):
        """Return (W,), horizontal over vertical orbital speed at the surface, 1 / tanh(k h)."""
        if self.depth == 0.0:
            return np.ones(len(self.waves))
        k = np.hypot(*self.wave_vector.T)
        return 1.0 / np.tanh(k * self.depth)

    @cached_property
    def is_flat(self) -> bool:
        """Return True when there are no waves at all."""
        return len(self.waves) == 0

    @property
    def significant_height(self) -> float:
        """Return 4 sqrt(sum a^2 / 2) in m."""
        return float(4.0 * np.sqrt(0.5 * np.sum(self.waves[:, 0] ** 2)))

    @cached_property
    def table(self) -> np.ndarray:
        """Return the table of waves (10, W) that the step reads."""
        amplitude, _, direction, phase = self.waves.T
        along = self.intrinsic_frequency * self._horizontal_ratio
        k = np.hypot(*self.wave_vector.T)
        bottom = np.exp(-2.0 * k * self.depth) if self.depth else np.zeros_like(k)
        table = np.stack([*self.wave_vector.T, self.angular_frequency, phase, amplitude,
                          np.zeros(len(self.waves)), along * np.cos(direction),
                          along * np.sin(direction), self.intrinsic_frequency, bottom])
        table.setflags(write=False)
        return table

    @cached_property
    def record(self) -> np.ndarray:
        """Return what the step reads beside the waves, as a record of `SEA`."""
        return np.array((len(self.waves), -1.0, 1.0, self.current, (0.0, 0.0), self.wind), SEA)

    def amplitudes(self, time: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Return amplitude (..., W) m of each wave, and its change (..., W) in m/s."""
        return self.table[START], self.table[RISE]

    def current_at(self, time: ArrayLike) -> np.ndarray:
        """Return the current (..., 2) m/s."""
        return self.current

    @cached_property
    def fastest_water(self) -> float:
        """Return a bound of the water speed at the surface in m/s: sum a s/tanh(kh) + current."""
        orbital = self.waves[:, 0] * self.intrinsic_frequency * self._horizontal_ratio
        return float(orbital.sum() + np.hypot(*self.current))

    @property
    def fastest_current(self) -> tuple[float, float]:
        """Return a bound of the current in m/s, and of its change in m/s^2."""
        return float(np.hypot(*self.current)), 0.0

    def with_wind(self, wind: ArrayLike) -> 'Sea':
        """Return the same water under another wind (2,) m/s."""
        return replace(self, wind=wind)

    def starting_at(self, time: float) -> 'Sea':
        """
        Return the same sea with its clock set so that its time 0 is this sea's ``time`` s.

        A simulation that counts from 0 sees the water of a large absolute time without the
        round-off that a large time would bring to every step.
        """
        waves = self.waves.copy()
        turns = np.fmod(time, waves[:, 1]) / waves[:, 1]
        waves[:, 3] = np.fmod(waves[:, 3] - 2 * np.pi * turns, 2 * np.pi)
        return replace(self, waves=waves)
