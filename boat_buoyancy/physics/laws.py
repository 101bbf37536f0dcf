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

"""The three probe laws: how much of its maximum force a probe gives, and where."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

# Below this cosine of the heel a column is treated as if it lay at this cosine: a hull on its
# side would otherwise fill and empty within no height at all.
MIN_UPRIGHT = 0.05


class Heights(NamedTuple):
    """
    The heights of a boat's probes, in the form that the laws use.

    ``inverse`` 1/m, a float where all are equal; ``dry`` and ``full``, 0 and 1 for each probe:
    NumPy takes an array faster than a number that it has to turn into one.
    """

    inverse: object
    dry: np.ndarray
    full: np.ndarray

    @classmethod
    def of(cls, hull, backend):
        """Return the heights of a `Hull`."""
        height = hull.height
        return cls(1.0 / float(height[0]) if (height == height[0]).all()
                   else backend.per_probe(1.0 / height),
                   backend.per_probe(np.zeros(len(height))),
                   backend.per_probe(np.ones(len(height))))

    def clipped(self, fraction):
        """Return fractions of the height, clipped to 0 and 1."""
        return np.minimum(np.maximum(fraction, self.dry), self.full)


@dataclass(frozen=True)
class Law:
    """
    A probe law.

    ``wetting`` (backend, heights, depth, upright) -> (fraction, share), for each probe the part
    of its height under water, 0 to 1, and the part of its maximum force that it gives; with
    ``heights`` the boat's `Heights`, ``depth`` m of each probe under the surface and ``upright``
    the cosine between body z and world z; ``slope`` (backend, heights, share, depth, upright)
    -> 1/m, the change of each probe's share with the height of the surface; ``has_arm``: the
    force acts at the middle of the wet part of a column that stands on the probe, not at the
    probe.
    """

    wetting: Callable
    slope: Callable
    has_arm: bool = False


def spring(backend, heights, depth, upright):
    """Return fraction and share of a capped spring at the probe."""
    fraction = heights.clipped(depth * heights.inverse)
    return fraction, fraction


def spring_slope(backend, heights, share, depth, upright):
    """Return the slope of a capped spring: 0 where the probe is dry or full."""
    return ((share > heights.dry) & (share < heights.full)) * heights.inverse


def soft(backend, heights, depth, upright):
    """Return fraction and share of a spring that saturates smoothly, 1 - exp(-depth / height)."""
    submerged = np.maximum(depth * heights.inverse, heights.dry)
    return np.minimum(submerged, heights.full), -np.expm1(-submerged)


def soft_slope(backend, heights, share, depth, upright):
    """Return the slope of a spring that saturates smoothly."""
    return (depth > heights.dry) * (heights.full - share) * heights.inverse


def column(backend, heights, depth, upright):
    """
    Return fraction and share of a column of hull that stands on the probe along body z.

    Upside down the wet part is measured from the top end; the surface is taken above the bottom.
    """
    stretch = 1.0 / backend.maximum(abs(upright), MIN_UPRIGHT)
    wet = depth * (heights.inverse * stretch)
    if backend.holds(upright < 0.0):
        wet = wet + backend.maximum(-upright, 0.0) * stretch
    fraction = heights.clipped(wet)
    return fraction, fraction


def column_slope(backend, heights, share, depth, upright):
    """Return the slope of a column: 0 where it is dry or full."""
    return spring_slope(backend, heights, share, depth, upright) * (
        1.0 / backend.maximum(abs(upright), MIN_UPRIGHT))


LAWS = {'spring': Law(spring, spring_slope), 'soft': Law(soft, soft_slope),
        'column': Law(column, column_slope, has_arm=True)}
