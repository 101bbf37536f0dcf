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

"""The scenes on which the integrators are compared: four that differ in kind, and one more."""

from dataclasses import dataclass

from .accuracy import Run
from ...physics.scene.scene import load_scene


@dataclass(frozen=True)
class ChartScene:
    """
    A scene of the chart.

    ``name`` as in the table; ``kind``, what is hard about it; ``parameters`` as in a parameter
    file; ``duration`` s; ``tolerance`` m, the accuracy at which the integrators are ranked.
    """

    name: str
    kind: str
    parameters: dict
    duration: float
    tolerance: float

    def run(self, quick=False):
        """Return the `accuracy.Run` of this scene."""
        scene = load_scene(self.parameters)
        duration = min(self.duration, 10.0) if quick else self.duration
        return Run(self.name, scene.boat, scene.sea, scene.start, duration)


# 0.3 of critical in heave, and as much in surge and sway, so that errors do not build up.
_HELD = {'damping.probe': 7610.4}
# 6 x 3 x 1 m and 37 kg float at 2 mm: 70 rad/s in heave.
_STIFF_BARGE = {'hull.size': [6.0, 3.0, 1.0], 'boat.mass': 37.0, 'damping.probe': 1552.7}

SCENES = (
    ChartScene(
        'free decay', 'smooth',
        # Damped by retention alone, so that errors of phase build up; every column stays wet
        # past its ramp and none is full.
        {'start.position': [0.0, 0.0, 0.29], 'start.orientation': [0.06, 0.03, 0.0],
         'start.velocity': [0.5, 0.0, 0.0], 'damping.probe': 0.0},
        duration=20.0, tolerance=0.001),
    ChartScene(
        'irregular sea', 'waves that bare the probes',
        {**_HELD, 'sea.sea_state': 3, 'sea.direction': 0.5},
        duration=40.0, tolerance=0.01),
    ChartScene(
        'drop', 'kinks at entry and cap',
        {**_HELD, 'start.position': [0.0, 0.0, 3.0], 'start.orientation': [0.1, 0.05, 0.0]},
        duration=10.0, tolerance=0.01),
    ChartScene(
        'stiff barge', 'fast heave, slow drift',
        {**_STIFF_BARGE, 'start.position': [0.0, 0.0, 0.4985],
         'start.orientation': [0.0002, 0.0002, 0.0], 'start.velocity': [0.05, 0.0, 0.0]},
        duration=20.0, tolerance=0.001),
)

# In the table, not in the picture: what swell makes of the stiff barge.
SWELL = ChartScene(
    'stiff barge in swell', 'a stiff boat whose water moves',
    # 10 cm of an 8 s swell from astern, the barge started lying on it and rising with it.
    {**_STIFF_BARGE, 'sea.waves': [0.1, 8.0, 0.0, 1.5707963267948966],
     'start.position': [0.0, 0.0, 0.498], 'start.orientation': [0.0, 0.006287987, 0.0],
     'start.velocity': [-0.000493859, 0.0, 0.078538264]},
    duration=20.0, tolerance=0.01)

BY_NAME = {scene.name: scene for scene in (*SCENES, SWELL)}
