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

"""Waves as they are given, row by row: what they have to be, and whether a current stops them."""

import math

import numpy as np

from .dispersion import wavenumber
from .. import checks

MAX_COMPONENTS = 1000
MAX_AMPLITUDE = 1000.0
MIN_PERIOD, MAX_PERIOD = 0.01, 1e6
WAVE_FORM = 'rows of [amplitude m, period s, direction rad, phase rad]'


def checked_waves(rows):
    """
    Return rows of waves as a read-only (W, 4) array.

    ``rows`` is a (W, 4) array or a flat list of 4 W numbers.  ValueError names the row that is
    wrong, what was given and what is expected.
    """
    try:
        flat = np.array(rows, float).ravel()
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f'sea.waves: expected {WAVE_FORM}, got {checks.shown(rows)}') from None
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


def currents_along(waves, current):
    """Return (W,) m/s, the part of a ``current`` (2,) along the direction of each of ``waves``."""
    return current[0] * np.cos(waves[:, 2]) + current[1] * np.sin(waves[:, 2])


def wavenumbers(waves, current, depth, gravity):
    """Return (W,) rad/m of rows of waves on a current; nan where one cannot run against it."""
    return wavenumber(2 * np.pi / waves[:, 1], depth, gravity, currents_along(waves, current))


def stopped(waves, current, depth, gravity):
    """Return (W,) bool, which rows of waves cannot run against a current (2,) m/s."""
    if not np.any(current):
        return np.zeros(len(waves), bool)
    return np.isnan(wavenumbers(waves, current, depth, gravity))


def shortest_period(against, depth, gravity):
    """Return the least period in s of a wave on a current of ``against`` m/s towards it."""
    def runs(period):
        return np.isfinite(wavenumber(2 * np.pi / period, depth, gravity, -against))

    low, high = MIN_PERIOD, MAX_PERIOD
    if not runs(high):
        return math.inf
    for _ in range(60):
        middle = math.sqrt(low * high)
        low, high = (low, middle) if runs(middle) else (middle, high)
    return high


def check_waves_run(waves, current, depth, gravity):
    """Raise ValueError for a row of waves that cannot run against a current (2,) m/s."""
    held = stopped(waves, current, depth, gravity)
    if not held.any():
        return
    row = int(np.argmax(held))
    against = -float(currents_along(waves, current)[row])
    shortest = shortest_period(against, depth, gravity)
    raise ValueError(
        f'sea.waves: row {row + 1} is {waves[row].tolist()}, which cannot run against '
        f'{against:.3g} m/s of sea.current: {current.tolist()}; expected '
        + (f'less than {math.sqrt(gravity * depth):.3g} m/s, at which the longest waves run in '
           f'{depth:g} m of water' if math.isinf(shortest) else
           f'a period of at least {math.ceil(100.0 * shortest) / 100.0:.2f} s there')
        + ': give it a longer period or another direction, or less current')
