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

"""
The motion of 20 scenes as release 0.1.0 computed it, before the step was rebuilt.

Recorded with its own core, which shared no code of the step with this one: every probe law,
integrator and kind of damping, seas, current, finite depth, capsizing, a drop.  What was default
damping then is given.  The states of the centre of mass after 250, 500, 750 and 1000 periods:
position, orientation, velocity in world axes, angular velocity.  That release gave its waves the
length of still water on any current.
"""

import json
from pathlib import Path

from boat_buoyancy.physics import load_scene, Sea
from boat_buoyancy.physics.boat.state import PARTS
from boat_buoyancy.physics.sea.fading import FadingSea
import numpy as np
import pytest

pytestmark = pytest.mark.plain

RECORDED = json.loads((Path(__file__).parent / 'data' / 'motion_0_1_0.json').read_text())


@pytest.mark.parametrize('case', RECORDED, ids=[case['name'] for case in RECORDED])
def test_the_motion_is_that_of_the_core_before_this_one(case):
    scene = load_scene(case['parameters'])
    simulation, sea = scene.simulation(**case['options']), scene.sea
    if sea.current.any():
        still = Sea(sea.waves, depth=sea.depth, gravity=sea.gravity)
        # A fade that never begins: the waves of a sea in the current of another.
        simulation.sea = FadingSea(still.table, sea.current, Sea(current=sea.current), 1e6, 1.0)
    for recorded in case['states']:
        simulation.run(250 / simulation.rate, case['thrust'])
        state = simulation.state
        np.testing.assert_allclose(
            np.concatenate([getattr(state, part) for part in PARTS]), recorded, atol=1e-13,
            rtol=1e-13)
