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

from boat_buoyancy.physics.boat import Damping, State
from boat_buoyancy.physics.simulation import Simulation
from boat_buoyancy.physics.waves import Sea
from boats import (
    DRAFT, HEAVE, LAWS, MASS, reference_boat, simulate, SQUARE, STIFFNESS, turned, undamped)
import numpy as np
import pytest
from scipy.integrate import trapezoid
from textbook import energy

METHODS = ('leapfrog', 'implicit', 'rk4')
AMPLITUDE = 0.05


def energies(boat, states):
    """Return the energy in J of every state of a run, by the textbook."""
    names = ('position', 'orientation', 'velocity', 'angular_velocity')
    return np.array([energy(boat, State(*(np.array(getattr(states, name)[i]) for name in names)))
                     for i in range(len(states.position))])


@pytest.mark.parametrize('rate', [20, 40])
def test_undamped_leapfrog_keeps_energy_within_its_known_swing(rate):
    u = HEAVE / rate
    _, states = simulate(reference_boat(), State((0.0, 0.0, AMPLITUDE - DRAFT)), 400.0, rate=rate)
    height, speed = states.position[:, 2] + DRAFT, states.velocity[:, 2]
    excess = (MASS * speed**2 + STIFFNESS * height**2) / (STIFFNESS * AMPLITUDE**2)
    assert abs(excess - 1.0).max() < 1.2 * u**2 / 4
    # And it is that large: the swing is the method's own, not a bound that nothing reaches.
    assert abs(excess - 1.0).max() > 0.9 * u**2 / 4
    tenth = 10 * rate
    assert excess[:tenth].mean() == pytest.approx(excess[-tenth:].mean(), abs=1e-4)
    # What it keeps to round-off is the energy of its own spring, weaker by u^2/4.
    own = (MASS * speed**2 + STIFFNESS * (1 - u**2 / 4) * height**2) / (STIFFNESS * AMPLITUDE**2)
    assert own == pytest.approx(own[0], rel=1e-11)


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize(('method', 'order'), [('leapfrog', 2), ('rk4', 4)])
def test_energy_error_of_undamped_motion_falls_with_the_order_of_the_method(law, method, order):
    # On all the boat's axes at once, no kink touched.
    boat = reference_boat(law=law, floatiness=2.0, positions=SQUARE - [0.0, 0.0, 0.2],
                          inertia=[500.0, 700.0, 900.0, 40.0, -30.0, 20.0])
    start = State((0.0, 0.0, 0.2 - 0.55), turned(0.06, -0.05, 0.3), (0.2, 0.1, 0.1),
                  (0.1, 0.1, 0.3))
    worst = []
    for rate in (50, 100):
        _, states = simulate(boat, start, 4.0, rate=rate, integrator=method)
        course = energies(boat, states)
        worst.append(abs(course - course[0]).max())
    assert np.log2(worst[0] / worst[1]) == pytest.approx(order, abs=0.3 if order == 2 else 1.2)
    assert worst[1] < 1e-3 * 0.5 * STIFFNESS * 0.1**2


@pytest.mark.parametrize('kind', ['probes', 'retention', 'linear'])
@pytest.mark.parametrize('ratio', [0.01, 0.1, 0.5, 1.0, 2.0, 10.0, 100.0])
@pytest.mark.parametrize(('method', 'step'), [
    ('leapfrog', 0.1), ('leapfrog', 0.25), ('leapfrog', 0.5),
    ('implicit', 0.1), ('implicit', 0.5), ('implicit', 1.9),
    ('rk4', 0.1), ('rk4', 0.5)])
def test_damped_heave_never_gains_energy_in_a_step(method, step, ratio, kind):
    """
    Hold every step of every phase of the swing to energy that does not rise.

    The energy is the plain one for implicit and rk4, and for leapfrog that of its own spring,
    k (1 - u^2/4), which it keeps exactly without damping: the plain one swings by u^2/4.
    ``step`` is u = w h, up to the rule for choosing substeps; rk4's has h d <= 2 as well, and
    with h d above 10 Crank-Nicolson turns the velocity round in every kick: leapfrog comes to
    rest all the same, but not in every step.
    """
    rate = 2 * ratio * HEAVE
    step = min(step, {'leapfrog': 10.0, 'implicit': np.inf, 'rk4': 2.0}[method] / (2 * ratio))
    if kind == 'retention':
        # The strongest that a retention above 0 can say is exp(-700).
        damping = undamped(linear_retention=[np.exp(-min(rate, 700.0))])
    elif kind == 'linear':
        damping = undamped(linear=[rate * MASS] * 6)
    else:
        damping = undamped(probe=rate * MASS)
    phase = np.linspace(0.0, 2 * np.pi, 64, endpoint=False)
    start = State(
        np.stack([0 * phase, 0 * phase, AMPLITUDE * np.cos(phase) - DRAFT], axis=1),
        velocity=np.stack([0 * phase, 0 * phase, AMPLITUDE * HEAVE * np.sin(phase)], axis=1))
    simulation = Simulation(reference_boat(damping=damping), Sea(), start, rate=HEAVE / step,
                            integrator=method)
    spring = STIFFNESS * (1 - step**2 / 4 if method == 'leapfrog' else 1.0)
    course = []
    for _ in range(20):
        state = simulation.state
        course.append(0.5 * (MASS * state.velocity[:, 2]**2
                             + spring * (state.position[:, 2] + DRAFT)**2))
        simulation.step()
    assert (np.diff(course, axis=0) <= 1e-12 * course[0]).all()
    assert (course[-1] < course[0]).all()


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('rate', [25, 100])
@pytest.mark.parametrize('method', METHODS)
def test_boat_thrown_into_the_water_loses_energy_in_every_step(method, rate, law):
    # Every axis, entry, cap and damping at once; damping as strong as boats have it.
    boat = reference_boat(law=law, floatiness=2.5, positions=SQUARE - [0.0, 0.0, 0.3],
                          inertia=[500.0, 700.0, 900.0, 40.0, -30.0, 20.0],
                          damping=Damping(probe=800.0))
    start = State((0.0, 0.0, 0.8), turned(0.3, -0.2), (0.3, 0.2, 0.0), (0.5, 0.3, 0.2))
    time, states = simulate(boat, start, 6.0, rate=rate, integrator=method)
    course = energies(boat, states)
    assert np.diff(course).max() < 1e-10 * abs(course[0])
    assert course[-1] < course[0] - 0.5 * MASS * 9.81 * 0.8
    assert time[-1] == 6.0


@pytest.mark.parametrize('law', LAWS)
def test_what_is_lost_is_what_damping_takes(law):
    # Linear drag on every axis takes u . D u: the lost energy is its integral over time.
    drag = np.array([200.0, 300.0, 400.0, 150.0, 250.0, 350.0])
    boat = reference_boat(law=law, floatiness=2.0, damping=undamped(linear=drag))
    start = State((0.0, 0.0, -0.6), turned(0.06, -0.05), (0.0, 0.0, 0.0), (0.1, -0.2, 0.3))
    time, states = simulate(boat, start, 3.0, rate=400, integrator='rk4')
    x, y, z, w = states.orientation.T
    up = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=1)
    assert abs(states.velocity[:, :2]).max() < 0.01
    body = up * states.velocity[:, 2:]
    taken = body**2 @ drag[:3] + states.angular_velocity**2 @ drag[3:]
    lost = energies(boat, states)
    lost = lost[0] - lost[-1]
    assert lost > 50.0
    assert trapezoid(taken, time) == pytest.approx(lost, rel=1e-3)
