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
The three probe laws: how much of its maximum force a probe gives, where, and its slope.

Numbers of one probe: ``height`` m, at which it is full; ``depth`` m of it under the surface;
``upright``, the cosine between body z and world z.
"""

import math

from ..boat.hull import LAWS
from ..compiled import compiled

SPRING, SOFT, COLUMN = (LAWS.index(law) for law in ('spring', 'soft', 'column'))
# Below this cosine of the heel a column is treated as if it lay at this cosine: a hull on its
# side would otherwise fill and empty within no height at all.
MIN_UPRIGHT = 0.05


@compiled
def wetting(law, height, depth, upright):
    """
    Return the part of a probe's height that is wet, and its share of its maximum force.

    Both 0 to 1.  spring: depth / height, capped.  soft: 1 - exp(-depth / height), a spring that
    saturates smoothly.  column: the part under water of a column of hull that stands on the probe
    along body z; upside down it is measured from the top end, the surface still taken above the
    bottom.
    """
    if law == COLUMN:
        cosine = max(abs(upright), MIN_UPRIGHT)
        fraction = depth / (height * cosine) + max(-upright, 0.0) / cosine
    else:
        fraction = depth / height
    wet = min(max(fraction, 0.0), 1.0)
    if law == SOFT:
        return wet, -math.expm1(-max(fraction, 0.0))
    return wet, wet


@compiled
def slope(law, height, depth, upright):
    """Return d share / d depth in 1/m: 0 where the probe is dry or full."""
    _, share = wetting(law, height, depth, upright)
    if law == SOFT:
        return (1.0 - share) / height if depth > 0.0 else 0.0
    if not 0.0 < share < 1.0:
        return 0.0
    return 1.0 / (height * max(abs(upright), MIN_UPRIGHT)) if law == COLUMN else 1.0 / height


@compiled
def arm(law, height, wet, upright):
    """
    Return how far above the probe, along body z, its force acts, in m.

    At the middle of the wet part of a column, which upside down hangs from the top end; a spring
    acts at the probe.
    """
    if law != COLUMN:
        return 0.0
    half = 0.5 * height * wet
    return half if upright > 0.0 else height - half
