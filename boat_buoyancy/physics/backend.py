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
Arithmetic for one boat and for a fleet by the same code.

Rigid-body quantities are tuples of components: Python floats for one boat, ``(B,)`` arrays for
a fleet of B; what each of n probes has is ``(n,)`` for one boat and ``(n, B)`` for a fleet.  A
NumPy call on a handful of numbers costs ten times a Python multiplication, so floats make one
boat fast; arrays make a fleet fast.  What the two need from different libraries is collected
here; all formulas elsewhere use operators and these functions only.
"""

from collections.abc import Callable
from dataclasses import dataclass
import math

import numpy as np


@dataclass(frozen=True)
class Backend:
    """
    The functions that differ between floats and arrays.

    ``where(condition, a, b)`` chooses by component and ``holds(condition)`` tells whether it holds
    for any boat; ``components`` turns an array (k,) or (k, B) into k components, and ``column`` a
    tuple of k components into (k, B); ``per_probe`` shapes constants (n,) to go with what each
    probe has; ``over_probes(rows, vectors)`` sums vectors (3, n) or (3, n, B) with weights (k, n)
    over the probes, into 3 times k components; ``place(points, rotation, position, time)`` takes
    homogeneous points (4, n) from body axes to the world, (3, n, B); for one boat to (5, n),
    where ones and the time follow, so that the phases of waves are one matrix product.
    """

    sin: Callable
    cos: Callable
    sqrt: Callable
    maximum: Callable
    where: Callable
    holds: Callable
    components: Callable
    column: Callable
    per_probe: Callable
    over_probes: Callable
    place: Callable


# No boat is farther away, in m, all three coordinates together; below, nothing that is computed
# of one can overflow.
FARTHEST = 1e100


def _place_one(points, rotation, position, time):
    a, b, c, d, e, f, g, h, i = rotation
    x, y, z = position
    if not abs(x) + abs(y) + abs(z) < FARTHEST:
        # Before NumPy meets what is infinite or no number, and warns.
        raise ArithmeticError('the boat is nowhere')
    return np.array((a, b, c, x, d, e, f, y, g, h, i, z, 0.0, 0.0, 0.0, 1.0,
                     0.0, 0.0, 0.0, time)).reshape(5, 4).dot(points)


def _place_fleet(points, rotation, position, time):
    a, b, c, d, e, f, g, h, i = rotation
    x, y, z = position
    return points.T @ np.array((a, b, c, x, d, e, f, y, g, h, i, z)).reshape(3, 4, -1)


ONE_BOAT = Backend(
    sin=math.sin, cos=math.cos, sqrt=math.sqrt, maximum=max,
    where=lambda condition, a, b: a if condition else b, holds=bool,
    components=np.ndarray.tolist,
    column=lambda values: np.array(values).reshape(-1, 1), per_probe=np.array,
    # For matrices this small, dot takes half the time of matmul.
    over_probes=lambda rows, vectors: vectors.dot(rows.T).tolist(), place=_place_one)

FLEET = Backend(
    sin=np.sin, cos=np.cos, sqrt=np.sqrt, maximum=np.maximum, where=np.where, holds=np.any,
    components=tuple, column=lambda values: np.stack(np.broadcast_arrays(*values)),
    per_probe=lambda values: np.array(values)[:, None],
    over_probes=lambda rows, vectors: rows @ vectors, place=_place_fleet)
