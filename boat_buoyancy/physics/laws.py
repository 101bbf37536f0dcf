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


class Wetting(NamedTuple):
    """
    How wet each probe is; every array is (n, B).

    ``fraction`` of its height under water, 0 to 1; ``share`` of its maximum force.
    """

    fraction: np.ndarray
    share: np.ndarray


@dataclass(frozen=True)
class Law:
    """
    A probe law.

    ``wetting`` (backend, inverse_height, depth, upright) -> `Wetting`, with ``inverse_height``
    (n, 1) 1/m, ``depth`` (n, B) m under the surface and ``upright`` the cosine between body z
    and world z; ``slope`` (backend, inverse_height, wetting, depth, upright) -> (n, B) 1/m, the
    change of share with the height of the surface; ``has_arm``: the force acts at the middle of
    the wet part of a column that stands on the probe, not at the probe.
    """

    wetting: Callable
    slope: Callable
    has_arm: bool = False


def spring(backend, inverse_height, depth, upright):
    """Return the `Wetting` of a capped spring at the probe."""
    fraction = np.minimum(np.maximum(depth * inverse_height, 0.0), 1.0)
    return Wetting(fraction, fraction)


def spring_slope(backend, inverse_height, wetting, depth, upright):
    """Return the slope of a capped spring: 0 where the probe is dry or full."""
    return ((wetting.share > 0.0) & (wetting.share < 1.0)) * inverse_height


def soft(backend, inverse_height, depth, upright):
    """Return the `Wetting` of a spring that saturates smoothly, 1 - exp(-depth / height)."""
    submerged = np.maximum(depth * inverse_height, 0.0)
    return Wetting(np.minimum(submerged, 1.0), -np.expm1(-submerged))


def soft_slope(backend, inverse_height, wetting, depth, upright):
    """Return the slope of a spring that saturates smoothly."""
    return (depth > 0.0) * (1.0 - wetting.share) * inverse_height


def column(backend, inverse_height, depth, upright):
    """
    Return the `Wetting` of a column of hull that stands on the probe along body z.

    Upside down the wet part is measured from the top end; the surface is taken above the bottom.
    """
    stretch = 1.0 / backend.maximum(abs(upright), MIN_UPRIGHT)
    below_bottom = backend.maximum(-upright, 0.0) * stretch
    fraction = np.minimum(
        np.maximum(depth * inverse_height * stretch + below_bottom, 0.0), 1.0)
    return Wetting(fraction, fraction)


def column_slope(backend, inverse_height, wetting, depth, upright):
    """Return the slope of a column: 0 where it is dry or full."""
    return spring_slope(backend, inverse_height, wetting, depth, upright) * (
        1.0 / backend.maximum(abs(upright), MIN_UPRIGHT))


LAWS = {'spring': Law(spring, spring_slope), 'soft': Law(soft, soft_slope),
        'column': Law(column, column_slope, has_arm=True)}
