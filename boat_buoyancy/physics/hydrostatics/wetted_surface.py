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

"""The wetted surface: how much of a hull is under still water."""

import numpy as np

from ..boat.clipping import wet_part
from ..boat.surface import Surface
from ..rotation import rotation_matrix


def wetted_surface(boat, state):
    """Return the area in m^2 of a hull's surface that is under still water, of a `State`."""
    rotation = np.array(rotation_matrix(state.orientation.tolist()))
    facets = (boat.hull.surface.facets - boat.center_of_mass) @ rotation.T
    wet = wet_part(facets + [0.0, 0.0, state.position[2]])
    return Surface(wet, np.arange(3 * len(wet))).area
