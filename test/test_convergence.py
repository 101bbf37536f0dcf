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

"""Every integrator has its order, against an adaptive integrator of eighth order."""

from functools import lru_cache

from boat_buoyancy.physics import Sea, State
from boats import (
    all_damping, asymmetric_boat, DRAFT, HEAVE, in_waves, INTEGRATORS, last_state, LAWS,
    reference_boat, turned, undamped, wind_sea, windy)
import numpy as np
import pytest
from textbook import solve

pytestmark = pytest.mark.plain

ORDER = {'leapfrog': 2, 'implicit': 1, 'rk4': 4, 'symplectic_euler': 1, 'euler': 1}
# Steps short enough that the leading term of the error stands alone, long enough that it stands
# above round-off.
RATES = {1: (1600, 3200), 2: (200, 400), 4: (40, 80)}
SECONDS = 0.5
# From here no probe of a boat that floats in the middle of its probes leaves its spring's slope.
AFLOAT = State((0.2, -0.1, -0.2), turned(0.05, -0.04, 0.4), (0.4, -0.3, 0.2), (0.15, -0.1, 0.3))
# Boat, sea and thrust.
CASES = {
    'undamped': (asymmetric_boat(floatiness=2.5, damping=undamped()), Sea(), (0.0,) * 6),
    'probe drag': (asymmetric_boat(floatiness=2.5, damping=undamped(probe=800.0)), Sea(),
                   (0.0,) * 6),
    **{law: (asymmetric_boat(law, floatiness=2.5, damping=all_damping()), wind_sea(),
             (300.0, -100.0, 50.0, 40.0, -60.0, 80.0)) for law in LAWS},
    'water taken along': (
        in_waves(asymmetric_boat('column', floatiness=2.5, damping=windy())),
        wind_sea().with_wind((9.0, 7.0)), (300.0, -100.0, 50.0, 40.0, -60.0, 80.0)),
    'wind': (asymmetric_boat(floatiness=2.5, damping=windy()), wind_sea().with_wind((9.0, 7.0)),
             (0.0,) * 6),
}


def numbers(state):
    return np.concatenate([state.position, state.orientation, state.velocity,
                           state.angular_velocity])


@lru_cache
def exact(case):
    """Return the end of the motion of a case by the textbook."""
    boat, sea, thrust = CASES[case]
    return solve(boat, sea, AFLOAT, [SECONDS], thrust)[0]


@pytest.mark.parametrize('case', CASES)
@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_order_on_smooth_motion_in_still_water_and_in_waves_under_thrust(integrator, case):
    boat, sea, thrust = CASES[case]
    errors = [np.linalg.norm(numbers(last_state(
        boat, AFLOAT, SECONDS, sea=sea, thrust=thrust, rate=rate,
        integrator=integrator)) - exact(case)) for rate in RATES[ORDER[integrator]]]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(ORDER[integrator], abs=0.15)


def fallen(height, time):
    """Return where a boat released above flat water is, while it has not left it again."""
    entry = np.sqrt(2 * height / 9.81)
    speed, wet = 9.81 * entry, time - entry
    return -DRAFT + DRAFT * np.cos(HEAVE * wet) - speed / HEAVE * np.sin(HEAVE * wet)


@pytest.mark.parametrize('integrator', ['leapfrog', 'rk4'])
def test_entry_takes_every_integrator_to_second_order(integrator):
    # One drop may hit the surface at the end of a step by luck: many drops, root mean square.
    heights = np.linspace(0.5, 1.5, 100)
    boat, rates, errors = reference_boat(positions=[[0.0, 0.0, 0.0]]), (20, 40, 80, 160), []
    for rate in rates:
        state = last_state(boat, State(np.outer(heights, (0.0, 0.0, 1.0))), 1.0, rate=rate,
                           integrator=integrator)
        errors.append(np.sqrt(np.mean((state.position[:, 2] - fallen(heights, 1.0))**2)))
    slope = np.polyfit(np.log2(rates), np.log2(errors), 1)[0]
    assert slope == pytest.approx(-2.0, abs=0.1)
