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

"""The guard ends a motion that cannot be with one clear error, and never a motion that can."""

import warnings

from boat_buoyancy.physics.boat import Damping, State
from boat_buoyancy.physics.guard import Guard, MARGIN
from boat_buoyancy.physics.simulation import Simulation, SimulationError
from boat_buoyancy.physics.stability import plan
from boat_buoyancy.physics.waves import Sea
from boats import (all_damping, box_boat, LAWS, METHODS, random_states, reference_boat, undamped,
                   wind_sea)
import numpy as np
import pytest
from random_boats import draw

EXPLICIT = ('rk4', 'symplectic_euler', 'euler')


def copied(simulation):
    """Return everything that a step may not change when it fails."""
    state = simulation.state
    return (simulation.time, simulation.steps, state.position.tolist(),
            state.orientation.tolist(), state.velocity.tolist(),
            state.angular_velocity.tolist(), simulation.probe_depths.tolist())


def blowing_up(integrator, shape=(), *, probe=5e4):
    """Return a simulation that explicit damping blows up in some steps, dropped from 1 m."""
    boat = box_boat(Damping(probe=probe))
    start = State(np.broadcast_to((0.0, 0.0, 1.0), (*shape, 3)), velocity=(0.1, 0.0, 0.0))
    return Simulation(boat, wind_sea(), start, rate=10.0, integrator=integrator)


def broken_step(value):
    """Return a step function whose every result holds ``value`` for a number of the motion."""
    def step(system, sea, motion, memory, thrust, time, h):
        position, orientation, velocity, spin = motion
        spoilt = value + 0.0 * spin[0]
        return motion._replace(angular_velocity=(spoilt, spin[1], spin[2])), memory
    return step


@pytest.mark.parametrize('shape', [(), (5,), (2, 3)])
@pytest.mark.parametrize('integrator', EXPLICIT)
def test_a_blow_up_is_one_clear_error_that_keeps_the_last_good_state(integrator, shape):
    simulation = blowing_up(integrator, shape)
    with pytest.raises(SimulationError) as caught:
        for _ in range(1000):
            before = copied(simulation)
            simulation.step((1.0, 2.0, 3.0, 0.0, 0.0, 0.0))
    assert copied(simulation) == before
    assert np.isfinite(simulation.state.velocity).all()
    message = str(caught.value)
    assert '\n' not in message and len(message) < 1000
    assert message.startswith(f'step {simulation.steps + 1} of 10 Hz ({integrator}, substeps 1)')
    worst = simulation.state.velocity.reshape(-1, 3)
    assert any(str(velocity.tolist()) in message for velocity in worst)
    assert 'thrust: [1.0, 2.0, 3.0, 0.0, 0.0, 0.0]' in message
    with pytest.raises(SimulationError):
        simulation.step((1.0, 2.0, 3.0, 0.0, 0.0, 0.0))
    assert copied(simulation) == before


@pytest.mark.parametrize('shape', [(), (5,)])
def test_reset_recovers(shape):
    simulation = blowing_up('rk4', shape)
    first = copied(simulation)
    simulation.step()
    after_one = copied(simulation)
    with pytest.raises(SimulationError):
        for _ in range(1000):
            simulation.step()
    simulation.reset()
    assert copied(simulation) == first
    simulation.step()
    assert copied(simulation) == after_one


@pytest.mark.parametrize('shape', [(), (4,)])
@pytest.mark.parametrize('value', [np.nan, np.inf, -np.inf, 1e300, 1e9])
def test_a_number_that_cannot_be_forced_from_inside_is_seen_at_once(shape, value, monkeypatch):
    simulation = Simulation(box_boat(), wind_sea(), random_states(shape, 2))
    simulation.step()
    before = copied(simulation)
    method = simulation._method
    broken = type(method)(method.name, broken_step(float(value)), method.order,
                          method.evaluations, method.begin)
    monkeypatch.setattr(simulation, '_method', broken)
    with pytest.raises(SimulationError):
        simulation.step()
    assert copied(simulation) == before
    monkeypatch.setattr(simulation, '_method', method)
    simulation.step()
    assert simulation.steps == 2


@pytest.mark.parametrize('error', [ZeroDivisionError('float division by zero'),
                                   OverflowError('Numerical result out of range'),
                                   ValueError('math domain error'),
                                   FloatingPointError('overflow')])
def test_arithmetic_that_fails_inside_a_step_is_the_same_error(error, monkeypatch):
    def step(*arguments):
        raise error

    simulation = Simulation(box_boat(), Sea(), State())
    method = simulation._method
    monkeypatch.setattr(simulation, '_method', type(method)(
        method.name, step, method.order, method.evaluations, method.begin))
    before = copied(simulation)
    with pytest.raises(SimulationError) as caught:
        simulation.step()
    assert caught.value.__cause__ is error
    assert copied(simulation) == before


@pytest.mark.parametrize('integrator', METHODS)
@pytest.mark.parametrize('shape', [(), (3,)])
def test_no_size_of_thrust_gives_anything_but_a_motion_or_the_error(integrator, shape):
    for size in (1e10, 1e100, 1e155, 1e200, 1e300):
        simulation = Simulation(box_boat(), wind_sea(), random_states(shape, 3),
                                integrator=integrator)
        try:
            for _ in range(20):
                simulation.step((size, 0.0, size, size, -size, 0.0))
        except SimulationError:
            pass
        state = simulation.state
        for values in (state.position, state.orientation, state.velocity,
                       state.angular_velocity, simulation.probe_depths):
            assert np.isfinite(values).all()


@pytest.mark.parametrize('shape', [(), (5,)])
def test_a_blow_up_prints_no_warnings_of_its_arithmetic(shape):
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        for integrator in EXPLICIT:
            simulation = blowing_up(integrator, shape, probe=1e300)
            with pytest.raises(SimulationError):
                for _ in range(1000):
                    simulation.step()


def test_a_bad_thrust_is_still_an_error_of_the_input():
    simulation = Simulation(box_boat(), Sea(), State())
    with pytest.raises(ValueError, match='thrust: expected finite numbers'):
        simulation.step((np.nan,) * 6)


@pytest.mark.parametrize('law', LAWS)
@pytest.mark.parametrize('integrator', ['leapfrog', 'rk4', 'symplectic_euler'])
def test_the_guard_lets_pass_everything_that_boats_do(integrator, law):
    # Drops, dives, capsizes, waves, thrust that comes and goes, no drag at all.
    for damping in (all_damping(), undamped(probe=2000.0), undamped()):
        boat = reference_boat(law=law, damping=damping)
        chosen = plan(boat, integrator=integrator, rate=60.0)
        start = random_states((40,), 4, height=30.0, tilt=3.0, speed=5.0)
        simulation = Simulation(boat, wind_sea(), start, rate=60.0, integrator=integrator,
                                substeps=chosen.substeps)
        for step in range(240):
            simulation.step((20000.0, 0.0, 5000.0, 0.0, 800.0, 300.0) if step % 60 < 20 else None)
        simulation.sea = Sea()
        simulation.state = random_states((40,), 5, height=3.0, speed=5.0)
        for _ in range(60):
            simulation.step()


def test_the_guard_never_stops_implicit():
    for seed in range(2000, 2030):
        drawn = draw(seed)
        simulation = Simulation(drawn.boat, drawn.sea, drawn.state, rate=1.0 / drawn.step,
                                integrator='implicit')
        for step in range(40):
            simulation.step(drawn.thrust if step % 10 < 5 else None)


def test_the_guard_grows_with_the_forces_and_not_faster():
    # A boat without drag, in free fall: its speed and the bound both grow by the step.
    boat = reference_boat(damping=undamped())
    guard = Guard(boat, Sea(), State(velocity=(3.0, 0.0, 0.0)), 0.1)
    assert guard.limit == pytest.approx(MARGIN * 3.0 * np.sqrt(1000.0))
    simulation = Simulation(boat, Sea(), State((0.0, 0.0, 100.0), velocity=(3.0, 0.0, 0.0)))
    lift, reach = 4.0 * 9810.0, np.sqrt(2.0)
    force = (lift + 9810.0) / np.sqrt(1000.0)
    torque = lift * reach / np.sqrt(500.0)
    for count in range(1, 5):
        assert guard.passes(simulation._motions)
        assert guard.limit == pytest.approx(
            MARGIN * (3.0 * np.sqrt(1000.0) + 0.1 * count * np.hypot(force, torque)))
