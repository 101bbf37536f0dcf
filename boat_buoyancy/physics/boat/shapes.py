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

"""Shapes of hulls: boxes, two boxes side by side, or a mesh, as surfaces and as columns."""

from dataclasses import replace

import numpy as np

from .columns import box_hull, columns_of
from .hull import Hull
from .surface import box_surface, joined

SHAPES = ('box', 'twin', 'mesh')


def box_shaped(size, bottom, probes, *, spacing=None, middle=0.0, specific_weight,
               law='column'):
    """
    Return a `Hull` of one box, or of two side by side, with its surface and its columns.

    Main arguments: ``size`` (3,) length, beam and depth m of each box; ``bottom`` z of the bottom
    in the body frame m; ``probes`` (along, across), how many columns in each.
    Other arguments: ``spacing`` m between the centre lines of two boxes, None for one;
    ``middle`` x of their middle m; ``specific_weight`` rho g in N/m^3; ``law`` as in `Hull`.
    """
    hull = box_hull(size, bottom, probes, specific_weight=specific_weight, law=law)
    sides = (0.0,) if spacing is None else (-spacing / 2.0, spacing / 2.0)
    return replace(
        hull, positions=np.concatenate([hull.positions + [middle, y, 0.0] for y in sides]),
        max_force=np.tile(hull.max_force, len(sides)), height=np.tile(hull.height, len(sides)),
        surface=joined([box_surface(size, (middle, y, bottom + size[2] / 2.0)) for y in sides]))


def mesh_shaped(surface, probes, volume, *, specific_weight, law='column'):
    """
    Return a `Hull` of a closed `Surface`, with columns that stand for it.

    Main arguments: ``probes`` (along, across) columns; ``volume`` m^3 that it displaces at rest.
    Other arguments: as of `box_shaped`.
    """
    positions, areas, heights = columns_of(surface, probes, volume)
    return Hull(positions, specific_weight * areas * heights, heights, law, surface,
                specific_weight=specific_weight)
