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

"""Classic fourth-order Runge-Kutta, for smooth motion to high accuracy."""

from .arrival import arrival
from .rates import add_rates, moved, rate_of
from ..compiled import compiled
from ..forces.load import load_at

# After the first stage: how far each of the others looks ahead, and its weight.
STAGES = ((0.5, 2.0), (0.5, 2.0), (1.0, 1.0))


@compiled
def rk4(boat, hull, sea, waves, motion, load, thrust, t, h):
    """
    Return motion and load after h s: y+ = y + h/6 (k1 + 2 k2 + 2 k3 + k4).

    Fourth order, four forces a step, stable for w h < 2.83.  A kink (entry, cap) takes it to
    second order.
    """
    k = total = rate_of(boat, load, thrust, motion)
    start = load
    for part, weight in STAGES:
        stage = moved(motion, k, part * h)
        load = load_at(boat, hull, sea, waves, stage.position, stage.orientation, t + part * h)
        k = rate_of(boat, load, thrust, stage)
        total = add_rates(total, weight, k)
    return arrival(boat, hull, sea, waves, moved(motion, total, h / 6.0), start, t + h)
