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

"""Columns of a shape: probes that stand for its volume."""

import numpy as np

from .hull import Hull


def box_hull(size, bottom, probes, *, specific_weight, law='column'):
    """
    Return a box hull of columns at Gauss points, exact until an edge leaves the water.

    Main arguments: ``size`` (3,) length, beam, depth m; ``bottom`` z of the bottom in the body
    frame m; ``probes`` (along, across), how many columns.
    Other arguments: ``specific_weight`` rho g in N/m^3; ``law`` as in `Hull`.

    Gauss-Legendre points integrate the box's volume and first moments of the wet volume, linear
    and quadratic in place, without error from 2 x 2 columns on.
    """
    length, beam, depth = size
    (along, along_weight), (across, across_weight) = (
        np.polynomial.legendre.leggauss(count) for count in probes)
    x, y = np.meshgrid(along * length / 2, across * beam / 2, indexing='ij')
    weights = np.outer(along_weight, across_weight).ravel() / 4.0
    positions = np.stack([x.ravel(), y.ravel(), np.full(x.size, float(bottom))], axis=1)
    volume = length * beam * depth
    return Hull(positions, specific_weight * volume * weights,
                np.full(x.size, float(depth)), law, specific_weight=specific_weight)


def columns_of(surface, probes, volume):
    raise NotImplementedError
