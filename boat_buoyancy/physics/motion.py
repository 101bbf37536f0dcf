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

"""What a step takes and gives: a motion in components, and what it leaves for the next."""

from typing import NamedTuple

from .forces import evaluate, Load


class Motion(NamedTuple):
    """
    A state in components, as the step carries it.

    ``position`` (3) world and ``orientation`` (4); ``velocity`` (3) and ``angular_velocity`` (3)
    in body axes; all of the centre of mass.
    """

    position: tuple
    orientation: tuple
    velocity: tuple
    angular_velocity: tuple


class Memory(NamedTuple):
    """What a step leaves for the next: the `Load` of the new motion, and leapfrog's factors."""

    load: Load
    factors: object = None


def begin(system, sea, position, orientation, time, h):
    """Return the `Memory` of a place and time; ``h`` s is for methods that need the step."""
    return Memory(evaluate(system, sea, position, orientation, time))
