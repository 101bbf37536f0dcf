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

"""The inertia tensor of a rigid body: whether there is such a body, and its principal axes."""

import numpy as np

from .. import checks


def principal_axes(inertia):
    """
    Return the principal moments (3,) of a tensor in rising order, and their axes (3, 3), columns.

    The axes are right-handed, and exact where they are those of the body.
    """
    moments = np.diag(inertia)
    if (inertia - np.diag(moments)).any():
        moments, axes = np.linalg.eigh(inertia)
    else:
        order = np.argsort(moments, kind='stable')
        moments, axes = moments[order], np.eye(3)[:, order]
    if np.linalg.det(axes) < 0:
        axes = axes * [1.0, 1.0, -1.0]
    return moments, axes


def checked_inertia(inertia):
    """
    Return an inertia tensor (3, 3), checked to be one that a rigid body can have.

    ``inertia`` is (3, 3), or [Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] in kg m^2.
    ValueError when it is not positive definite or breaks the triangle rule.
    """
    values = np.asarray(inertia)
    if values.shape != (3, 3):
        xx, yy, zz, *rest = checks.vector('boat.inertia', inertia, 3, 6)
        xy, xz, yz = rest or (0.0, 0.0, 0.0)
        values = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    values = np.array(values, float)
    if not np.isfinite(values).all() or not np.array_equal(values, values.T):
        raise ValueError('boat.inertia: expected a finite symmetric tensor, '
                         f'got {values.tolist()}')
    moments = np.linalg.eigvalsh(values)
    if not moments[0] > 1e-12 * moments[2]:
        raise ValueError('boat.inertia: expected a positive definite tensor, got principal '
                         f'moments {moments.tolist()} kg m^2')
    if moments[0] + moments[1] < moments[2] * (1 - 1e-6):
        raise ValueError('boat.inertia: expected no principal moment above the sum of the other '
                         f'two, got {moments.tolist()} kg m^2: no body has that inertia')
    values.setflags(write=False)
    return values
