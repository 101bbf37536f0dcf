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

"""The sea: a sum of linear (Airy) waves over water of constant depth, and a uniform current."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import checks

MAX_COMPONENTS = 1000
MAX_AMPLITUDE = 1000.0
MIN_PERIOD, MAX_PERIOD = 0.01, 1e6
# From so many angles on, one tangent of each is cheaper than cosine and sine, in spite of the
# calls that it takes to make them of it.
MANY_ANGLES = 256
WAVE_FORM = 'rows of [amplitude m, period s, direction rad, phase rad]'


def wavenumber(angular_frequency, depth=0.0, gravity=9.81):
    """
    Return k in rad/m that solves the dispersion relation w^2 = g k tanh(k depth).

    Main arguments: ``angular_frequency`` (...,) rad/s; ``depth`` m, 0 = deep water.
    Other arguments: ``gravity`` m/s^2.
    """
    deep = np.asarray(angular_frequency, float) ** 2 / gravity
    if depth == 0.0:
        return deep
    # Newton on x tanh x = y with x = k depth, from a start that lies right of the root.
    y = deep * depth
    x = np.maximum(y, np.sqrt(y))
    for _ in range(20):
        t = np.tanh(x)
        x = x - (x * t - y) / (t + x * (1.0 - t * t))
    return x / depth


@dataclass(frozen=True)
class Sea:
    """
    The water surface and its motion, a function of place and time only.

    Main arguments: ``waves`` (W, 4), rows of amplitude m, period s, direction rad (where the
    waves go, counter-clockwise from world x) and phase rad, eta = sum a cos(k.x - w t + phase).
    Other arguments: ``current`` (2,) m/s in world x and y; ``depth`` m, 0 = deep water;
    ``gravity`` m/s^2.  ValueError says which row is wrong and what is expected.
    """

    waves: np.ndarray = ()
    current: np.ndarray = (0.0, 0.0)
    depth: float = 0.0
    gravity: float = 9.81

    def __post_init__(self):
        """Store checked, read-only arrays."""
        object.__setattr__(self, 'waves', checked_waves(self.waves))
        object.__setattr__(self, 'current', checks.vector('sea.current', self.current, 2))
        object.__setattr__(self, 'depth', checks.number('sea.depth', self.depth, at_least=0.0))
        object.__setattr__(self, 'gravity', checks.number('gravity', self.gravity, above=0.0))

    @cached_property
    def angular_frequency(self):
        """Return (W,) rad/s."""
        return 2 * np.pi / self.waves[:, 1]

    @cached_property
    def wave_vector(self):
        """Return (W, 2), rad/m along world x and y."""
        k = wavenumber(self.angular_frequency, self.depth, self.gravity)
        direction = self.waves[:, 2]
        return np.stack([k * np.cos(direction), k * np.sin(direction)], axis=1)

    @cached_property
    def _horizontal_ratio(self):
        """Return (W,), horizontal over vertical orbital speed at the surface, 1 / tanh(k h)."""
        if self.depth == 0.0:
            return np.ones(len(self.waves))
        k = np.hypot(*self.wave_vector.T)
        return 1.0 / np.tanh(k * self.depth)

    @cached_property
    def is_flat(self):
        """Return True when there are no waves at all."""
        return len(self.waves) == 0

    @cached_property
    def drift(self):
        """Return the current as three components in world axes, None when there is none."""
        return (*self.current.tolist(), 0.0) if self.current.any() else None

    @cached_property
    def fastest_water(self):
        """Return a bound of the water speed at the surface in m/s: sum a w/tanh(kh) + current."""
        orbital = self.waves[:, 0] * self.angular_frequency * self._horizontal_ratio
        return float(orbital.sum() + np.hypot(*self.current))

    def at(self, time):
        """Return the sea in force at ``time``: itself (a sea in transition gives a blend)."""
        return self

    def starting_at(self, time):
        """
        Return the same sea with its clock set so that its time 0 is this sea's ``time`` s.

        A simulation that counts from 0 sees the water of a large absolute time without the
        round-off that a large time would bring to every step.
        """
        waves = self.waves.copy()
        turns = np.fmod(time, waves[:, 1]) / waves[:, 1]
        waves[:, 3] = np.fmod(waves[:, 3] - 2 * np.pi * turns, 2 * np.pi)
        return Sea(waves, self.current, self.depth, self.gravity)

    def _phase(self, x, y, time):
        x, y, time = np.broadcast_arrays(x, y, time)
        k = self.wave_vector
        return (x[..., None] * k[:, 0] + y[..., None] * k[:, 1]
                - time[..., None] * self.angular_frequency + self.waves[:, 3])

    def elevation(self, x, y, time):
        """Return the height of the surface in m at world ``x``, ``y`` m and ``time`` s."""
        return np.cos(self._phase(x, y, time)) @ self.waves[:, 0]

    def slope(self, x, y, time):
        """Return d eta/dx and d eta/dy, shape (..., 2)."""
        amplitude = self.waves[:, 0]
        return -np.sin(self._phase(x, y, time)) @ (amplitude[:, None] * self.wave_vector)

    def velocity(self, x, y, time):
        """Return the water velocity at the surface, (..., 3) m/s, world axes, with current."""
        phase = self._phase(x, y, time)
        speed = self.waves[:, 0] * self.angular_frequency
        direction = self.waves[:, 2]
        along = np.cos(phase) * (speed * self._horizontal_ratio)
        return np.stack([along @ np.cos(direction) + self.current[0],
                         along @ np.sin(direction) + self.current[1],
                         np.sin(phase) @ speed], axis=-1)

    @cached_property
    def _responses(self):
        """Return (4, W) each: elevation and velocity per cosine and per sine of each wave."""
        amplitude, direction = self.waves[:, 0], self.waves[:, 2]
        speed, zero = amplitude * self.angular_frequency, np.zeros(len(amplitude))
        along = speed * self._horizontal_ratio
        return (np.stack([amplitude, along * np.cos(direction), along * np.sin(direction), zero]),
                np.stack([zero, zero, zero, speed]))

    @cached_property
    def _angle_rows(self):
        """Return (W, 5), what x, y, z, 1 and t contribute to the angle of each wave."""
        return np.column_stack([self.wave_vector, np.zeros(len(self.waves)), self.waves[:, 3],
                                -self.angular_frequency])

    @cached_property
    def _cosine_table(self):
        """
        Return rows of angles and responses for `surface` of a few points.

        Every wave stands twice, as cos(theta) and as cos(theta - pi/2) = sin(theta), so that one
        cosine and one matrix product give elevation and velocity together.
        """
        late = self._angle_rows - [0.0, 0.0, 0.0, np.pi / 2, 0.0]
        return np.vstack([self._angle_rows, late]), np.concatenate(self._responses, axis=1)

    @cached_property
    def _tangent_table(self):
        """
        Return rows of half the angles, responses and offset for `surface` of many points.

        With t = tan(theta/2) and r = 1 / (1 + t^2), cos(theta) = 2 r - 1 and sin(theta) = 2 r t.
        """
        per_cosine, per_sine = self._responses
        return (self._angle_rows / 2.0, 2.0 * np.concatenate([per_cosine, per_sine], axis=1),
                per_cosine.sum(axis=1, keepdims=True))

    def surface(self, points, time):
        """
        Return elevation and water velocity at many points, for the step.

        ``points`` m, world axes, and ``time`` s as `Backend.place` gives them: (3, n, B) for a
        fleet, (5, n) with rows of ones and of the time for one boat.  Returns (4, n, B) or
        (4, n): elevation m, then the velocity of `velocity` without the current.
        """
        count = points.size // len(points)
        if len(self.waves) * count < MANY_ANGLES:
            rows, response = self._cosine_table
            angle = angles(rows, points, time)
            np.cos(angle, angle)
            surface = response.dot(angle)
            return surface if points.ndim == 2 else surface.reshape(4, *points.shape[1:])
        rows, response, offset = self._tangent_table
        waves = len(rows)
        terms = np.empty((2 * waves, count))
        reciprocal, tangent = terms[:waves], terms[waves:]
        angles(rows, points, time, tangent)
        np.tan(tangent, tangent)
        np.multiply(tangent, tangent, reciprocal)
        reciprocal += 1.0
        np.reciprocal(reciprocal, reciprocal)
        tangent *= reciprocal
        return (response.dot(terms) - offset).reshape(4, *points.shape[1:])


def angles(rows, points, time, out=None):
    """
    Return the angle (R, count) rad of each row at each point.

    ``rows`` (R, 5), what x, y, z, 1 and t contribute; ``points`` and ``time`` as in
    `Sea.surface`; ``out`` as NumPy's.
    """
    if points.ndim == 2:
        return rows.dot(points, out)
    # Over a fleet, what depends on time alone is added once, not once a probe.
    angle = rows[:, :2].dot(points[:2].reshape(2, -1), out)
    angle += rows[:, 3:4] + rows[:, 4:] * time
    return angle


def checked_waves(rows):
    """
    Return rows of waves as a read-only (W, 4) array.

    ``rows`` is a (W, 4) array or a flat list of 4 W numbers.  ValueError names the row that is
    wrong, what was given and what is expected.
    """
    try:
        flat = np.array(rows, float).ravel()
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f'sea.waves: expected {WAVE_FORM}, got {rows!r}') from None
    if flat.size % 4:
        raise ValueError(f'sea.waves: expected {WAVE_FORM}, four numbers a row, '
                         f'got {flat.size} numbers')
    if flat.size > 4 * MAX_COMPONENTS:
        raise ValueError(f'sea.waves: expected at most {MAX_COMPONENTS} rows, '
                         f'got {flat.size // 4}')
    waves = flat.reshape(-1, 4)
    amplitude, period = waves[:, 0], waves[:, 1]
    for wrong, expected in (
            (~np.isfinite(waves).all(axis=1), 'four finite numbers'),
            ((amplitude < 0) | (amplitude > MAX_AMPLITUDE),
             f'an amplitude of 0 to {MAX_AMPLITUDE:g} m'),
            ((period < MIN_PERIOD) | (period > MAX_PERIOD),
             f'a period of {MIN_PERIOD:g} to {MAX_PERIOD:g} s')):
        if wrong.any():
            row = int(np.argmax(wrong))
            raise ValueError(f'sea.waves: row {row + 1} is {waves[row].tolist()}, '
                             f'expected {expected}: {WAVE_FORM}')
    waves.setflags(write=False)
    return waves
