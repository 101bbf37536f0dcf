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

"""What a boat did over the last minute."""

from collections import deque
import math
from typing import NamedTuple

import numpy as np

SPAN, PERIOD = 60.0, 0.1  # s


class Moment(NamedTuple):
    """Heave in m of the body origin, roll and pitch in degrees, speed in m/s at a time in s."""

    time: float
    heave: float
    roll: float
    pitch: float
    speed: float


class History:
    """The moments of the last `SPAN` s, `PERIOD` s apart; older ones are forgotten."""

    def __init__(self):
        """Know nothing yet."""
        self._moments = deque(maxlen=round(SPAN / PERIOD))

    def is_due(self, time):
        """Return True when a moment at ``time`` s is far enough from the last one."""
        # A part of a period early is round-off.
        return not self._moments or time - self._moments[-1].time >= PERIOD * (1.0 - 1e-6)

    def add(self, time, position, roll_pitch_yaw, velocity):
        """Remember a moment: of the body frame, m, rad and m/s."""
        roll, pitch, _ = map(math.degrees, roll_pitch_yaw)
        self._moments.append(Moment(time, position[2], roll, pitch, math.hypot(*velocity)))

    def columns(self):
        """Return five arrays, those of `Moment`, times in s before the last moment."""
        rows = np.array(list(self._moments) or [(0.0,) * len(Moment._fields)])
        rows[:, 0] -= rows[-1, 0]
        return tuple(rows.T)
