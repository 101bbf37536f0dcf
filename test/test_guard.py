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

from boat_buoyancy.physics import Damping, Sea, Simulation, SimulationError, State
from boat_buoyancy.physics.boat.state import Motion, PARTS
from boat_buoyancy.physics.compiled import machine_code
from boat_buoyancy.physics.step_size.plan import plan
from boat_buoyancy.physics.stepping import engine
from boat_buoyancy.physics.stepping.guard import is_possible, MARGIN, speed_reached
from boat_buoyancy.physics.stepping.integrators import Integrator, INTEGRATORS
from boat_buoyancy.physics.stepping.leapfrog import leapfrog
from boat_buoyancy.physics.stepping.march import read_motion
from boat_buoyancy.physics.stepping.speed_bound import SpeedBound
from boats import (
    all_damping, box_boat, fleet_of, LAWS, random_states, reference_boat, same, start,
    undamped, wind_sea)
import numpy as np
import pytest
from random_boats import draw

pytestmark = pytest.mark.plain

EXPLICIT = ('rk4', 'symplectic_euler', 'euler')
PUSH = (1.0, 2.0, 3.0, 0.0, 0.0, 0.0)


def copied(simulation):
    """Return everything that a step may not change when it fails."""
    return (simulation.time, simulation.steps, simulation.probe_depths.tolist(),
            *(getattr(simulation.state, part).tolist() for part in PARTS))


def blowing_up(integrator, *, probe=5e4, shape=()):
    """Return boats that explicit damping blows up in some steps, dropped from 1 m."""
    begin = State(np.broadcast_to((0.0, 0.0, 1.0), (*shape, 3)), velocity=(0.1, 0.0, 0.0))
    return start(box_boat(Damping(probe=probe)), begin, sea=wind_sea(), rate=10.0,
                 integrator=integrator)


@pytest.mark.parametrize('integrator', EXPLICIT)
def test_a_blow_up_is_one_clear_error_that_keeps_the_last_good_state(integrator):
    simulation = blowing_up(integrator)
    with pytest.raises(SimulationError) as caught:
        for _ in range(1000):
            before = copied(simulation)
            simulation.step(PUSH)
    assert copied(simulation) == before
    message = str(caught.value)
    assert '\n' not in message and len(message) < 1000
    assert message.startswith(f'step {simulation.steps + 1} of 10 Hz ({integrator}, substeps 1)')
    assert f'velocity {simulation.state.velocity.tolist()}' in message
    assert f'thrust: {list(PUSH)}' in message
    with pytest.raises(SimulationError):
        simulation.step(PUSH)
    assert copied(simulation) == before


def test_reset_recovers():
    simulation = blowing_up('rk4')
    first = copied(simulation)
    simulation.step()
    after_one = copied(simulation)
    with pytest.raises(SimulationError):
        simulation.run(100.0)
    simulation.reset()
    assert copied(simulation) == first
    simulation.step()
    assert copied(simulation) == after_one


def guards(bound):
    """Return [(is_possible, bound as it reads it)], plain and as the step runs."""
    twin = machine_code(is_possible)
    return [(is_possible, bound)] + [(twin, bound.record[()])] * (twin is not is_possible)


@pytest.mark.parametrize('value', [np.nan, np.inf, -np.inf])
def test_every_number_of_a_motion_that_is_not_finite_is_seen(value):
    numbers = [10.0, 20.0, 0.3, 0.0, 0.0, 0.6, 0.8, 1.0, 2.0, 3.0, 0.1, 0.2, 0.3]
    for possible, bound in guards(SpeedBound.of(box_boat(), Sea())):
        for reached in (1e3, 1e300):
            assert possible(bound, reached, read_motion(numbers))
            for place in range(13):
                spoilt = [*numbers[:place], value, *numbers[place + 1:]]
                assert not possible(bound, reached, read_motion(spoilt))


def test_the_guard_knows_the_speed_and_the_place_past_which_nothing_is_possible():
    still, up = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)
    # 1000 kg; 500 kg m^2 about the easiest axis stands for all three.
    for possible, bound in guards(SpeedBound.of(reference_boat(), Sea())):
        for part, least in ((2, np.sqrt(1000.0)), (3, np.sqrt(500.0))):
            for factor, expected in ((0.999, True), (1.001, False), (1e200, False)):
                motion = [still, up, still, still]
                motion[part] = (0.0, MARGIN * 7.0 / float(least) * factor, 0.0)
                assert possible(bound, 7.0, Motion(*motion)) == expected
        for far, expected in ((9e99, True), (2e100, False), (-1e300, False)):
            assert possible(bound, 7.0, Motion((0.0, far, 0.0), up, still, still)) == expected


def test_the_guard_grows_with_the_forces_and_not_faster():
    # A boat without drag, in free fall: its speed and the bound both grow by the step.
    bound = SpeedBound.of(reference_boat(damping=undamped()), Sea())
    begin = reached = 3.0 * np.sqrt(1000.0)
    lift, reach = 4.0 * 9810.0, np.sqrt(2.0)
    force = (lift + 9810.0 + 500.0) / np.sqrt(1000.0)
    torque = (lift * reach + 80.0) / np.sqrt(500.0)
    for count in range(1, 5):
        reached = speed_reached(bound, reached, ((300.0, -400.0, 0.0), (0.0, 0.0, 80.0)), 0.1)
        assert reached == pytest.approx(begin + 0.1 * count * np.hypot(force, torque))


def broken(monkeypatch, step, state=State()):
    """Return boats in plain Python, moved by an integrator that raises errors."""
    monkeypatch.setitem(INTEGRATORS, 'broken', Integrator(step, 1, 1))
    monkeypatch.setattr(engine, 'compile_now', lambda function, *arguments: function)
    return start(box_boat(), state, integrator='broken')


def raising(error):
    """Return a step of leapfrog that raises an error when it is taken the third time."""
    calls = []

    def step(*arguments):
        calls.append(arguments)
        if len(calls) < 3:
            return leapfrog(*arguments)
        raise error
    return step


@pytest.mark.parametrize('error', [ZeroDivisionError('float division by zero'),
                                   OverflowError('Numerical result out of range')])
def test_arithmetic_that_fails_inside_a_step_is_motion_that_cannot_be(error, monkeypatch):
    simulation = broken(monkeypatch, raising(error))
    with pytest.raises(SimulationError, match='step 3 of 100 Hz') as caught:
        simulation.run(1.0)
    other = Simulation(box_boat(), Sea(), State())
    other.run(0.02)
    for part in PARTS:
        assert getattr(simulation.state, part) == pytest.approx(
            getattr(other.state, part), abs=1e-12)
    assert simulation.steps == 2 and len(caught.value.trajectory.time) == 3
    assert simulation.probe_depths == pytest.approx(other.probe_depths, abs=1e-12)


def test_arithmetic_that_fails_stops_its_boat_only(monkeypatch):
    def step(boat, probes, sea, waves, motion, *others):
        if motion.position[0] == 7.0:
            raise OverflowError
        return leapfrog(boat, probes, sea, waves, motion, *others)

    states = State([[0.0, 0.0, 0.3], [7.0, 0.0, 0.3], [0.0, 0.0, 0.5]])
    fleet = broken(monkeypatch, step, states)
    for _ in range(5):
        fleet.step()
    assert fleet.failed.tolist() == [False, True, False]
    for i in (0, 2):
        alone = broken(monkeypatch, step, states[i])
        alone.run(0.05)
        assert same(fleet.state[i], alone.state)
    assert same(fleet.state[1], states[1])


@pytest.mark.parametrize('error', [ValueError('not of the motion'), TypeError('a bug'),
                                   IndexError('a bug'), KeyboardInterrupt()])
def test_what_is_no_arithmetic_comes_out_of_a_step_as_it_is(error, monkeypatch):
    simulation = broken(monkeypatch, raising(error))
    with pytest.raises(type(error)) as caught:
        for _ in range(3):
            simulation.step()
    assert caught.value is error


@pytest.mark.parametrize('integrator', ['leapfrog', 'implicit', *EXPLICIT])
def test_no_size_of_thrust_gives_anything_but_a_motion_or_the_error(integrator):
    for size in (1e10, 1e100, 1e155, 1e200, 1e300, 1e308):
        simulation = Simulation(box_boat(), wind_sea(), random_states((1,), 3)[0],
                                integrator=integrator)
        before = copied(simulation)
        try:
            for _ in range(20):
                before = copied(simulation)
                simulation.step((size, 0.0, size, size, -size, 0.0))
        except SimulationError:
            assert copied(simulation) == before
        for part in PARTS:
            assert np.isfinite(getattr(simulation.state, part)).all()
        assert np.isfinite(simulation.probe_depths).all()


def test_a_blow_up_prints_no_warnings_of_its_arithmetic():
    for integrator in EXPLICIT:
        alone = blowing_up(integrator, probe=1e300)
        fleet = blowing_up(integrator, probe=1e300, shape=(5,))
        with warnings.catch_warnings():
            warnings.simplefilter('error')
            with pytest.raises(SimulationError):
                for _ in range(1000):
                    alone.step()
            for _ in range(20):
                fleet.step()
        assert fleet.failed.all()


@pytest.mark.parametrize('integrator', ['leapfrog', 'rk4', 'symplectic_euler'])
def test_the_guard_lets_pass_everything_that_boats_do(integrator):
    # Drops, dives, capsizes, waves, thrust that comes and goes, no drag at all.
    boats = [reference_boat(law=law, damping=damping) for law in LAWS
             for damping in (all_damping(), undamped(probe=2000.0), undamped())]
    substeps = [plan(boat, integrator=integrator, rate=60.0).substeps for boat in boats]
    count, push = 5 * len(boats), (20000.0, 0.0, 5000.0, 0.0, 800.0, 300.0)
    for sea, states, periods in (
            (wind_sea(), random_states((count,), 4, height=30.0, tilt=3.0, speed=5.0), 240),
            (Sea(), random_states((count,), 5, height=3.0, speed=5.0), 60)):
        fleet = fleet_of(5 * boats, count * [sea], states, rate=60.0, integrator=integrator,
                         substeps=5 * substeps)
        for period in range(periods):
            fleet.step(push if period % 60 < 20 else None)
        assert not fleet.failed.any()


def test_the_guard_never_stops_implicit():
    for seed in range(2000, 2030):
        drawn = draw(seed)
        fleet = start(drawn.boat, drawn.state, sea=drawn.sea, rate=1.0 / drawn.step,
                      integrator='implicit')
        for step in range(40):
            fleet.step(drawn.thrust if step % 10 < 5 else None)
        assert not fleet.failed.any()
