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

from boat_buoyancy.physics.boat import State
from boat_buoyancy.physics.waves import Sea
from boats import (
    all_damping, asymmetric_boat, DRAFT, HEAVE, last_state, METHODS, reference_boat, turned,
    undamped, wind_sea)
import numpy as np
import pytest
from textbook import solve

ORDER = {'leapfrog': 2, 'implicit': 1, 'rk4': 4, 'symplectic_euler': 1, 'euler': 1}
# Steps short enough that the leading term of the error stands alone, long enough that it stands
# above round-off.
RATES = {1: (1600, 3200), 2: (200, 400), 4: (40, 80)}

DAMPINGS = {
    'none': undamped(),
    'retention': undamped(linear_retention=[0.6, 0.5, 0.4], angular_retention=[0.5, 0.4, 0.3]),
    'probes': undamped(probe=800.0),
    'linear': undamped(linear=[100.0, 200.0, 300.0, 100.0, 200.0, 300.0]),
    'quadratic': undamped(quadratic=[300.0, 300.0, 300.0, 200.0, 200.0, 200.0]),
    'all': all_damping(),
}


def numbers(state):
    return np.concatenate([state.position, state.orientation, state.velocity,
                           state.angular_velocity])


def afloat():
    """Return a start from which no probe of the smooth boat leaves the slope of its spring."""
    return State((0.2, -0.1, -0.2), turned(0.05, -0.04, 0.4), (0.4, -0.3, 0.2), (0.15, -0.1, 0.3))


def smooth_boat(damping):
    """Return the boat without symmetry, floating in the middle of its probes."""
    return asymmetric_boat(floatiness=2.5, damping=damping)


def order_of(method, boat, sea, state, seconds, thrust=None):
    """Return the order between two steps, a factor of two apart, against the textbook."""
    exact = solve(boat, sea, state, [seconds], (0.0,) * 6 if thrust is None else thrust)[0]
    errors = [np.linalg.norm(numbers(last_state(
        boat, state, seconds, sea=sea, thrust=thrust, rate=rate, integrator=method)) - exact)
        for rate in RATES[ORDER[method]]]
    return np.log2(errors[0] / errors[1])


@pytest.mark.parametrize('damping', DAMPINGS)
@pytest.mark.parametrize('method', METHODS)
def test_order_on_smooth_motion(method, damping):
    state, boat = afloat(), smooth_boat(DAMPINGS[damping])
    assert order_of(method, boat, Sea(), state, 0.5) == pytest.approx(ORDER[method], abs=0.15)


@pytest.mark.parametrize('method', ['leapfrog', 'implicit', 'rk4'])
def test_order_in_waves_over_a_current_and_under_thrust(method):
    thrust = np.array([300.0, -100.0, 50.0, 40.0, -60.0, 80.0])
    order = order_of(method, smooth_boat(all_damping()), wind_sea(), afloat(), 0.5, thrust)
    assert order == pytest.approx(ORDER[method], abs=0.15)


@pytest.mark.parametrize('law', ['soft', 'column'])
@pytest.mark.parametrize('method', ['leapfrog', 'implicit', 'rk4'])
def test_order_with_the_other_laws(method, law):
    boat = asymmetric_boat(law, floatiness=2.5)
    order = order_of(method, boat, Sea(), afloat(), 0.5)
    assert order == pytest.approx(ORDER[method], abs=0.15)


def fallen(height, time):
    """Return where a boat released above flat water is, while it has not left it again."""
    entry = np.sqrt(2 * height / 9.81)
    speed, wet = 9.81 * entry, time - entry
    return -DRAFT + DRAFT * np.cos(HEAVE * wet) - speed / HEAVE * np.sin(HEAVE * wet)


@pytest.mark.parametrize('method', ['leapfrog', 'rk4'])
def test_entry_takes_every_method_to_second_order(method):
    # One drop may hit the surface at the end of a step by luck: many drops, root mean square.
    heights = np.linspace(0.5, 1.5, 400)
    errors = []
    for rate in (20, 40, 80, 160, 320):
        state = last_state(reference_boat(), State(np.outer(heights, (0.0, 0.0, 1.0))), 1.0,
                           rate=rate, integrator=method)
        errors.append(np.sqrt(np.mean((state.position[:, 2] - fallen(heights, 1.0))**2)))
    slope = np.polyfit(np.log2([20, 40, 80, 160, 320]), np.log2(errors), 1)[0]
    assert slope == pytest.approx(-2.0, abs=0.1)
