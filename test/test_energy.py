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

"""Energy is kept where nothing takes it, and never gained where damping does."""

from boat_buoyancy.physics import Damping, Sea, State
from boats import (
    DRAFT, fleet_of, HEAVE, LAWS, MASS, reference_boat, simulate, SQUARE, STIFFNESS, turned,
    undamped)
import numpy as np
import pytest
from scipy.integrate import trapezoid
from scipy.spatial.transform import Rotation
from textbook import energy

INTEGRATORS = ('leapfrog', 'implicit', 'rk4')
AMPLITUDE = 0.05


def energies(boat, states):
    """Return the energy in J of every state of a run, by the textbook."""
    return np.array([energy(boat, states[i]) for i in range(len(states.position))])


@pytest.mark.parametrize('rate', [20, 40])
def test_undamped_leapfrog_keeps_energy_within_its_known_swing(rate):
    u = HEAVE / rate
    _, states = simulate(reference_boat(), State((0.0, 0.0, AMPLITUDE - DRAFT)), 400.0, rate=rate)
    height, speed = states.position[:, 2] + DRAFT, states.velocity[:, 2]
    excess = (MASS * speed**2 + STIFFNESS * height**2) / (STIFFNESS * AMPLITUDE**2)
    assert abs(excess - 1.0).max() < 1.2 * u**2 / 4
    # And it is that large: the swing is the integrator's own, not a bound that nothing reaches.
    assert abs(excess - 1.0).max() > 0.9 * u**2 / 4
    tenth = 10 * rate
    assert excess[:tenth].mean() == pytest.approx(excess[-tenth:].mean(), abs=1e-4)
    # What it keeps to round-off is the energy of its own spring, weaker by u^2/4.
    own = (MASS * speed**2 + STIFFNESS * (1 - u**2 / 4) * height**2) / (STIFFNESS * AMPLITUDE**2)
    assert own == pytest.approx(own[0], rel=1e-11)


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize(('integrator', 'order'), [('leapfrog', 2), ('rk4', 4)])
def test_energy_error_of_undamped_motion_falls_with_the_order_of_the_integrator(
        law, integrator, order):
    # On all the boat's axes at once, no kink touched.
    boat = reference_boat(law=law, floatiness=2.0, positions=SQUARE - [0.0, 0.0, 0.2],
                          inertia=[500.0, 700.0, 900.0, 40.0, -30.0, 20.0])
    begin = State((0.0, 0.0, 0.2 - 0.55), turned(0.06, -0.05, 0.3), (0.2, 0.1, 0.1),
                  (0.1, 0.1, 0.3))
    worst = []
    for rate in (50, 100):
        _, states = simulate(boat, begin, 4.0, rate=rate, integrator=integrator)
        course = energies(boat, states)
        worst.append(abs(course - course[0]).max())
    # rk4 loses energy of a linear swing by the fifth power.
    assert order - 0.3 < np.log2(worst[0] / worst[1]) < (2.3 if order == 2 else 5.3)


def damped(ratio, kind):
    """Return the reference boat with such a ratio of heave damping, by one kind of damping."""
    rate = 2 * ratio * HEAVE
    return reference_boat(positions=[[0.0, 0.0, 0.0]], damping={
        # The strongest that a retention above 0 can say is exp(-700).
        'retention': undamped(linear_retention=[np.exp(-min(rate, 700.0))]),
        'linear': undamped(linear=[rate * MASS] * 6),
        'probes': undamped(probe=rate * MASS)}[kind])


@pytest.mark.parametrize(('integrator', 'step', 'most'), [
    ('leapfrog', 0.05, 10.0), ('leapfrog', 0.25, 10.0), ('leapfrog', 0.5, 10.0),
    ('implicit', 0.1, np.inf), ('implicit', 0.5, np.inf), ('implicit', 1.9, np.inf),
    ('rk4', 0.01, 2.0), ('rk4', 0.1, 2.0), ('rk4', 0.5, 2.0)])
def test_damped_heave_never_gains_energy_in_a_step(integrator, step, most):
    """
    Hold every step of every phase of the swing to energy that does not rise.

    The energy is the plain one for implicit and rk4, and for leapfrog that of its own spring,
    k (1 - u^2/4), which it keeps exactly without damping: the plain one swings by u^2/4.
    ``step`` is u = w h, up to the rule for choosing substeps; ``most`` h d: rk4's rule has
    h d <= 2 as well, and leapfrog's step is a contraction in this energy up to h d = 11 (beyond,
    it comes to rest all the same, but not in every step).
    """
    ratios = [ratio for ratio in (0.01, 0.1, 0.5, 1.0, 2.0, 10.0, 100.0)
              if 2 * ratio * step <= most * (1.0 + 1e-12)]
    phase = np.linspace(0.0, 2 * np.pi, 16, endpoint=False)
    boats = [boat for ratio in ratios for kind in ('probes', 'retention', 'linear')
             for boat in len(phase) * [damped(ratio, kind)]]
    phase = np.tile(phase, 3 * len(ratios))
    begin = State(np.outer(AMPLITUDE * np.cos(phase) - DRAFT, (0.0, 0.0, 1.0)),
                  velocity=np.outer(AMPLITUDE * HEAVE * np.sin(phase), (0.0, 0.0, 1.0)))
    fleet = fleet_of(boats, [Sea()] * len(boats), begin, rate=HEAVE / step,
                     integrator=integrator)
    spring = STIFFNESS * (1 - step**2 / 4 if integrator == 'leapfrog' else 1.0)
    course = []
    for _ in range(20):
        state = fleet.state
        course.append(0.5 * (MASS * state.velocity[:, 2]**2
                             + spring * (state.position[:, 2] + DRAFT)**2))
        fleet.step()
    assert (np.diff(course, axis=0) <= 1e-12 * course[0]).all()
    assert (course[-1] < course[0]).all()


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_boat_thrown_into_the_water_loses_energy_in_every_step(integrator, law):
    # Every axis, entry, cap and damping at once; damping as strong as boats have it.
    boat = reference_boat(law=law, floatiness=2.5, positions=SQUARE - [0.0, 0.0, 0.3],
                          inertia=[500.0, 700.0, 900.0, 40.0, -30.0, 20.0],
                          damping=Damping(probe=800.0))
    begin = State((0.0, 0.0, 0.8), turned(0.3, -0.2), (0.3, 0.2, 0.0), (0.5, 0.3, 0.2))
    for rate in (25, 100):
        _, states = simulate(boat, begin, 4.0, rate=rate, integrator=integrator)
        course = energies(boat, states)
        assert np.diff(course).max() < 1e-10 * abs(course[0])
        assert course[-1] < course[0] - 0.5 * MASS * 9.81 * 0.8


@pytest.mark.parametrize('law', LAWS)
def test_what_is_lost_is_what_damping_takes(law):
    # Linear drag on every axis takes u . D u: the lost energy is its integral over time.
    drag = np.array([200.0, 300.0, 400.0, 150.0, 250.0, 350.0])
    boat = reference_boat(law=law, floatiness=2.0, damping=undamped(linear=drag))
    begin = State((0.0, 0.0, -0.6), turned(0.06, -0.05), (0.2, 0.1, 0.0), (0.1, -0.2, 0.3))
    time, states = simulate(boat, begin, 3.0, rate=400, integrator='rk4')
    turn = Rotation.from_quat(np.array(states.orientation))
    body = turn.apply(np.array(states.velocity), inverse=True)
    taken = body**2 @ drag[:3] + states.angular_velocity**2 @ drag[3:]
    course = energies(boat, states)
    lost = course[0] - course[-1]
    assert lost > 50.0
    # The rule is off by a twelfth of (w h)^2 of what it sums, which swings at twice the
    # sqrt(19620 / 500) = 6.3 rad/s of roll.
    assert trapezoid(taken, time) == pytest.approx(lost, rel=(12.6 / 400.0)**2 / 12.0)
