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
a fleet of B.  A NumPy call on a handful of numbers costs ten times a Python multiplication, so
floats make one boat fast; arrays make a fleet fast.  What the two need from different libraries
is collected here; all formulas elsewhere use operators and these functions only.
"""

from collections.abc import Callable
from dataclasses import dataclass
import math

import numpy as np


@dataclass(frozen=True)
class Backend:
    """
    The functions that differ between floats and arrays.

    ``where(condition, a, b)`` chooses by component; ``components`` turns a matrix of shape
    (k, B) into k components, and ``column`` a tuple of k components into (k, B);
    ``over_probes(rows, vectors)`` sums vectors (3, n, B) with weights (k, n) over the probes,
    into the 3 k components of (3, k, B); ``place(points, pose)`` multiplies points (n, 4) with
    a pose of 12 components, row by row, into (3, n, B).
    """

    sin: Callable
    cos: Callable
    sqrt: Callable
    maximum: Callable
    where: Callable
    components: Callable
    column: Callable
    over_probes: Callable
    place: Callable


ONE_BOAT = Backend(
    sin=math.sin, cos=math.cos, sqrt=math.sqrt, maximum=max,
    where=lambda condition, a, b: a if condition else b,
    components=lambda matrix: matrix.ravel().tolist(),
    column=lambda values: np.array(values).reshape(-1, 1),
    # For matrices this small, dot takes half the time of matmul.
    over_probes=lambda rows, vectors: vectors[:, :, 0].dot(rows.T).ravel().tolist(),
    place=lambda points, pose: np.array(pose).reshape(3, 4).dot(points.T)[:, :, None])

FLEET = Backend(
    sin=np.sin, cos=np.cos, sqrt=np.sqrt, maximum=np.maximum, where=np.where,
    components=tuple, column=lambda values: np.stack(np.broadcast_arrays(*values)),
    over_probes=lambda rows, vectors: tuple((rows @ vectors).reshape(-1, vectors.shape[2])),
    place=lambda points, pose: points @ np.array(pose).reshape(3, 4, -1))
