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

"""The end of a step: the forces of the place reached, and the water that now moves along."""

from ..boat.state import Motion
from ..compiled import compiled
from ..forces.added_mass import dipped
from ..forces.load import load_at


@compiled
def arrival(boat, hull, sea, waves, motion, load, t):
    """Return the `Motion` and `Load` of a boat that comes to a place at t s with a ``load``."""
    position, orientation, body_velocity, angular_velocity = motion
    reached = load_at(boat, hull, sea, waves, position, orientation, t)
    body_velocity, angular_velocity = dipped(boat, load.wetness, reached, body_velocity,
                                             angular_velocity)
    return Motion(position, orientation, body_velocity, angular_velocity), reached
