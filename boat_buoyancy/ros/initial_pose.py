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

"""Where a boat is put by a message on `initialpose`."""

import math

from .complaints import check_finite, check_frame, Refused

MAX_PLACE = 1e9  # m, as start.position


def read_place(message, scene):
    """Return x, y m and yaw rad of a PoseWithCovarianceStamped in the world frame or its map."""
    check_frame('initialpose', message.header.frame_id,
                *filter(None, (scene.world_frame, scene.values['map_frame'])))
    place, turned = message.pose.pose.position, message.pose.pose.orientation
    check_finite('initialpose', (place.x, place.y, turned.x, turned.y, turned.z, turned.w))
    if max(abs(place.x), abs(place.y)) > MAX_PLACE:
        raise Refused('too large', f'initialpose: expected x and y of at most {MAX_PLACE:g} m, '
                      f'got {place.x:g}, {place.y:g}')
    x, y, z, w = turned.x, turned.y, turned.z, turned.w
    if not 0.9 < x * x + y * y + z * z + w * w < 1.1:
        raise Refused('no orientation', 'initialpose: expected a unit quaternion, '
                      f'got {[x, y, z, w]}')
    return place.x, place.y, math.atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)
