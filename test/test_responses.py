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
Boats with added mass in waves move as a boundary element method says, and as the water does.

By the package's own step in waves of 1 cm, a sinusoid fitted to the motion once it has settled.
"""

import json
from pathlib import Path

import boat_buoyancy
from boat_buoyancy.physics import load_fleet
import numpy as np
import pytest

GRAVITY = 9.81
AMPLITUDE = 0.01
KEEP = {f'damping.{name}': [1.0] for name in (
    'linear_retention', 'angular_retention', 'air_linear_retention', 'air_angular_retention')}
BARGE = json.loads((Path(__file__).parent / 'data' / 'bem_barge.json').read_text())
BOX = json.loads((Path(boat_buoyancy.__file__).parent / 'tools' / 'chart' / 'responses'
                  / 'box.json').read_text())
# Length, beam and depth m, and the height of the bottom in the body frame, that of `com` at the
# mean water level; Hz of the step; s until the slowest mode, roll, is down to 2 % of its start.
HULLS = {'barge': (BARGE, (20.0, 6.0, 3.0), -1.5, 16.0, 60.0),
         'box': (BOX, (4.0, 2.0, 1.0), -0.5, 30.0, 15.0)}


def scene(hull, model, period, heading):
    """Return the parameters of a hull, all of its own table, in one wave."""
    table, size, bottom, rate, _ = HULLS[hull]
    drag = np.array(table['radiation_damping'])
    drag[3] += table['viscous_roll']
    center = (0.0, 0.0, 0.3) if hull == 'barge' else (0.0, 0.0, 0.0)
    return {
        'boat.mass': table['mass'], 'boat.center_of_mass': center,
        'boat.inertia': table['inertia'], 'hull.size': size, 'hull.bottom': bottom,
        'hull.probes': [6, 4], 'hull.model': model, 'added_mass': table['added_mass'],
        'damping.linear': drag.tolist(), 'damping.probe': 0.0, **KEEP,
        'wave_force': 'froude_krylov', 'rate': rate,
        'sea.waves': [AMPLITUDE, period, np.radians(heading), 0.0]}


def responses(hull, model, waves, seconds=36.0):
    """
    Return (n, 6) complex: surge, sway, heave, roll, pitch, yaw for waves (T s, heading degrees).

    Of the centre of mass over the amplitude, and of the turns over the slope of the waves:
    motion = Re(response e^(-i w t)), the elevation at the origin Re(e^(-i w t)).
    """
    periods, _ = np.transpose(waves)
    *_, rate, settled = HULLS[hull]
    fleet = load_fleet([scene(hull, model, *wave) for wave in waves])
    for _ in range(round(settled * rate)):
        fleet.step()
    count = round(seconds * rate)
    time, rows = settled + np.arange(1, count + 1) / rate, []
    for _ in range(count):
        fleet.step()
        state = fleet.state
        rows.append(np.concatenate(
            [state.position.T, [state.roll, state.pitch, state.yaw]]).T)
    assert not fleet.failed.any()
    found = []
    for row, omega in zip(np.moveaxis(rows, 1, 0), 2.0 * np.pi / periods):
        basis = np.stack([np.cos(omega * time), np.sin(omega * time), np.ones(count),
                          time - settled], axis=1)
        cosine, sine, *_ = np.linalg.lstsq(basis, row, rcond=None)[0]
        slope = AMPLITUDE * omega ** 2 / GRAVITY
        found.append((cosine + 1j * sine) / np.repeat([AMPLITUDE, slope], 3))
    return np.array(found)


@pytest.mark.parametrize('model', ['columns', 'panels'])
@pytest.mark.parametrize(('hull', 'most'), [('barge', (12.0, 9.0, 4.0)), ('box', (5.0, 5.0, 4.0))])
def test_heave_roll_and_pitch_are_those_of_a_boundary_element_method(hull, most, model):
    rows = np.array([row for row in HULLS[hull][0]['rows'] if 2.0 <= row[0] <= 12.0])
    assert {*rows[:, 1]} == {0.0, 45.0, 90.0} and len(rows) >= 60
    found = abs(responses(hull, model, rows[:, :2])[:, 2:5])
    percent = 100.0 * np.sqrt(np.mean((found - rows[:, 2:5]) ** 2, axis=0))
    print(hull, model, 'error of heave, roll, pitch, %:', np.round(percent, 2))
    assert (percent <= most).all(), percent


@pytest.mark.parametrize('model', ['columns', 'panels'])
@pytest.mark.parametrize('hull', HULLS)
def test_in_long_waves_a_boat_goes_along_with_the_water(hull, model):
    # T = 20 s: the water moves along a circle, ahead under a crest: x = -a sin, and the surface
    # slopes by -k a sin, where pitch is bow down and roll port up.
    along, abeam = responses(hull, model, [(20.0, 0.0), (20.0, 90.0)], seconds=60.0)
    for found, way, turn, sign in ((along, 0, 4, -1.0), (abeam, 1, 3, 1.0)):
        # cos = Re(1 e^-iwt), -sin(theta) = sin(w t) = Re(i e^-iwt).
        assert found[2] == pytest.approx(1.0, abs=0.01)
        assert found[way] == pytest.approx(1j, abs=0.03)
        assert found[turn] == pytest.approx(sign * 1j, abs=0.03)
        others = [i for i in range(6) if i not in (way, turn, 2)]
        # The triangles of a box are not quite as symmetric as the box.
        assert abs(found[others]).max() < (0.03 if model == 'panels' else 1e-3)
