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

"""The wind that a message on `wind` asks for."""

from .complaints import check_finite, check_frame, Refused
from ..physics.scene.parameters import PARAMETERS


def read_wind(message, scene):
    """Return x, y m/s, where the wind blows to, of a Vector3Stamped in the world or its map."""
    check_frame('wind', message.header.frame_id,
                *filter(None, (scene.world_frame, scene.values['map_frame'])))
    x, y, z = values = message.vector.x, message.vector.y, message.vector.z
    check_finite('wind', values)
    limit = PARAMETERS['wind.velocity'].at_most
    if max(abs(x), abs(y)) > limit:
        raise Refused('too large', f'wind: expected x and y of at most {limit:g} m/s, '
                      f'got {x:g}, {y:g}')
    if z:
        raise Refused('not level', f'wind: expected a z of 0, as it blows level, got {z:g} m/s')
    return x, y
