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

"""How long a wave of a period is: the dispersion relation, in still water and on a current."""

import numpy as np


def wavenumber(angular_frequency, depth=0.0, gravity=9.81, current=0.0):
    """
    Return k in rad/m that solves the dispersion relation (w - k U)^2 = g k tanh(k depth).

    Main arguments: ``angular_frequency`` (...,) rad/s as seen from a fixed point; ``depth`` m,
    0 = deep water.
    Other arguments: ``gravity`` m/s^2; ``current`` (...,) m/s, U along the wave's direction.
    Of several roots the one that goes over into that of still water as the current does; nan
    where there is none: the wave cannot run against the current (Peregrine 1976, Interaction of
    water waves and currents, Advances in Applied Mechanics 16).
    """
    deep = np.asarray(angular_frequency, float) ** 2 / gravity
    still = deep
    if depth != 0.0:
        # Newton on x tanh x = y with x = k depth, from a start that lies right of the root.
        y = deep * depth
        x = np.maximum(y, np.sqrt(y))
        for _ in range(20):
            t = np.tanh(x)
            x = x - (x * t - y) / (t + x * (1.0 - t * t))
        still = x / depth
    if not np.any(current):
        return still
    return np.where(current, _on_current(angular_frequency, depth, gravity, current, still), still)


def _on_current(frequency, depth, gravity, current, k):
    """
    Return the root of f(k) = s + U k - w, s = sqrt(g k tanh(k h)), from that of still water ``k``.

    s is concave, and so is f: after a step of Newton's method it lies left of the lesser root and
    comes up to it.  Where it meets f' <= 0 instead, past the greatest f, there is none: the
    energy of a wave of this length runs at s' and is held up by the current.
    """
    for _ in range(60):  # a root that is nearly double takes one for each bit
        t = np.tanh(k * depth) if depth else 1.0
        s = np.sqrt(gravity * k * t)
        slope = 0.5 * gravity / s * (t + k * depth * (1.0 - t * t)) + current
        before = k
        k = np.where(slope > 0.0, k - (s + current * k - frequency) / slope, np.nan)
        if not (np.abs(k - before) > 1e-15 * k).any():
            break
    return k
