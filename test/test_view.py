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

"""A boat that is tuned while it floats: the same motion, the same refusals, a file of it."""

import math
from pathlib import Path
import threading
import time

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.boat.state import body_frame
from boat_buoyancy.physics.scene.scene import scene_from_values
from boat_buoyancy.tools.view.history import PERIOD, SPAN
from boat_buoyancy.tools.view.live_boat import LiveBoat, PUSH_LASTS
from boat_buoyancy.tools.view.loop import Loop
import numpy as np
import pytest

CONFIG = Path(__file__).parents[1] / 'config'
STEPS = tuple(f'v{n}_{name}' for n, name in enumerate(
    ('single_probe', 'four_probes', 'budget', 'probe_damping', 'tuned')))
PARTS = ('position', 'orientation', 'velocity', 'angular_velocity')


def source(name):
    return CONFIG / f'{name}.yaml'


def live(name='default'):
    return LiveBoat(source(name))


def tuned(boat, **values):
    """Change parameters given with __ for the dot."""
    boat.take(boat.proposed({name.replace('__', '.'): value for name, value in values.items()}))
    return boat


def numbers(simulation):
    return [getattr(simulation.state, part).tolist() for part in PARTS]


def pose(boat):
    return body_frame(boat.scene.boat, boat.session.simulation.state)


@pytest.mark.parametrize('name', [*STEPS, 'default', 'waves', 'wam_v', 'barge'])
def test_it_moves_bitwise_as_the_simulation_alone(name):
    boat, alone = live(name), load_scene(source(name)).simulation()
    for _ in range(300):
        assert boat.step()
        alone.step()
    assert numbers(boat.session.simulation) == numbers(alone)


@pytest.mark.parametrize('name, values', [
    ('default', {'boat.mass': -5.0}), ('default', {'boat.mas': 5.0}),
    ('default', {'probes.floatiness': 2.0}), ('v4_tuned', {'probes.weights': [1.0, 2.0]}),
    ('default', {'rate': 1e9}), ('default', {'boat.inertia': [1.0, 1.0, 9.0]})])
def test_it_refuses_with_the_sentence_of_the_scene_and_stays_as_it_was(name, values):
    boat = live(name)
    before = boat.scene, boat.session, boat.text()
    with pytest.raises(ValueError) as expected:
        scene_from_values({**boat.scene.given, **values})
    with pytest.raises(ValueError) as refusal:
        boat.proposed(values)
    assert str(refusal.value) == str(expected.value)
    assert (boat.scene, boat.session, boat.text()) == before


@pytest.mark.parametrize('values', [
    {'rate': 200.0}, {'integrator': 'implicit'}, {'boat.center_of_mass': [0.2, 0.1, -0.2]},
    {'substeps': 4}, {'hull.size': [5.0, 2.0, 1.0]}, {'hull.probes': [3, 3]},
    {'hull.model': 'panels'}])
def test_what_a_node_refuses_to_change_restarts_where_the_boat_is(values):
    boat = tuned(live(), sea__waves=[0.2, 4.0, 0.0, 0.0])
    for _ in range(150):
        boat.step()
    frame, stamp = pose(boat), boat.session.stamp
    x, y = frame[0][:2]
    height = boat.session.simulation.sea.elevation(x, y, boat.session.simulation.time)
    boat.take(boat.proposed(values))
    for before, after in zip(frame, pose(boat)):
        # Two turns of a vector there and back: a few roundings of numbers of the size of 1.
        assert after == pytest.approx(before, abs=1e-14)
    # The next period of the new rate has begun by then, and the water is where it was.
    period = 1e9 / boat.scene.rate
    assert 0 <= stamp - boat.session.stamp < period
    simulation = boat.session.simulation
    shift = (stamp - boat.session.stamp) / 1e9
    # The wave rises by at most a omega a second.
    assert simulation.sea.elevation(x, y, simulation.time) == pytest.approx(
        height, abs=1e-12 + 0.2 * math.tau / 4.0 * 2.0 * shift)


@pytest.mark.parametrize('name, values', [
    ('default', {'boat.mass': 2345.6, 'boat.center_of_mass': [0.1, 0, 1e-17]}),
    ('v4_tuned', {'probes.weights': [1, 2, 3, 4], 'damping.probe': 1e7, 'sea.seed': 2 ** 62}),
    ('waves', {'sea.sea_state': 3}), ('wigley', {'hull.model': 'columns'}),
    ('wam_v', {'sea.waves': [0.1, 3.0, 0.0, 0.0], 'integrator': 'implicit', 'rate': 1e5}),
    ('otter', {}), ('barge', {'damping.linear': [1.0] * 6, 'hull.probes': [2, 2]})])
def test_a_saved_file_is_read_as_the_same_scene_and_tells_what_was_tuned(name, values, tmp_path):
    boat = live(name)
    began = boat.scene.given
    boat.take(boat.proposed(values))
    path = tmp_path / 'tuned.yaml'
    path.write_text(boat.text())
    assert load_scene(path).values == boat.scene.values
    marked = [line for line in path.read_text().splitlines() if '# was ' in line]
    changed = [key for key, value in boat.scene.given.items()
               if value != scene_from_values({}).values.get(key) and value != began.get(key)]
    assert [line.split(':')[0].strip() for line in marked] == [
        key.rpartition('.')[2] for key in load_scene(path).given if key in changed]


def test_a_sea_that_was_chosen_goes_along_to_every_step_of_the_idea():
    boat = tuned(live(STEPS[0]), sea__sea_state=4, wind__velocity=[3.0, 0.0])
    for name in STEPS[1:]:
        for _ in range(30):
            boat.step()
        stamp = boat.session.stamp
        boat.take(boat.opened(source(name)))
        assert boat.name == name and boat.session.stamp == stamp
        sea = load_scene({'sea.sea_state': 4}).sea
        assert boat.scene.sea.waves.tolist() == sea.waves.tolist()
        simulation = boat.session.simulation
        # The water goes on: phases are turned by the time that has passed.
        assert simulation.sea.elevation(1.0, 2.0, simulation.time) == pytest.approx(
            sea.elevation(1.0, 2.0, stamp / 1e9), abs=1e-9)


def test_without_one_every_scene_has_the_sea_of_its_file():
    boat = live()
    boat.take(boat.opened(source('waves')))
    assert boat.scene.sea.waves.tolist() == load_scene(source('waves')).sea.waves.tolist()
    boat.take(boat.opened(source('default')))
    assert boat.scene.sea.is_flat


def test_a_push_acts_as_that_thrust_and_ends_by_itself():
    boat, alone = live(), load_scene(source('default')).simulation()
    boat.push(4000.0, 500.0)
    for period in range(200):
        boat.step()
        alone.step([4000.0, 0.0, 0.0, 0.0, 0.0, 500.0]
                   if period / 100.0 <= PUSH_LASTS else None)
    assert numbers(boat.session.simulation) == numbers(alone)


def test_thrusters_share_a_push_ahead_and_turn_by_their_distance():
    boat = live('wam_v')
    boat.push(200.0, 0.0)
    boat.step()
    assert list(boat.session.propulsion.forces.values()) == pytest.approx([100.0, 100.0])
    boat.push(0.0, 100.0)
    boat.step()
    # One ahead and one astern, 1.027135 m to each side.
    assert list(boat.session.propulsion.forces.values()) == pytest.approx(
        [-100.0 / 2.05427, 100.0 / 2.05427])
    places = [place for place, _ in boat.snapshot().pushes]
    assert places == [thruster.position for thruster in boat.scene.thrusters]


def test_lift_and_heel_put_the_boat_at_rest_there():
    boat = tuned(live(), sea__current=[1.0, 0.0])
    boat.push(4000.0, 500.0)
    for _ in range(50):
        boat.step()
    before = boat.session.simulation.state
    boat.lift(1.5)
    state = boat.session.simulation.state
    assert (state.position - before.position).tolist() == pytest.approx([0.0, 0.0, 1.5])
    assert not state.velocity.any() and not state.angular_velocity.any()
    boat.heel(0.5)
    state = boat.session.simulation.state
    assert state.roll == pytest.approx(0.5) and state.pitch == pytest.approx(0.0, abs=1e-12)
    assert state.yaw == pytest.approx(before.yaw)
    boat.reset()
    assert numbers(boat.session.simulation) == numbers(boat.scene.simulation())


def test_lift_acts_at_the_middle_of_the_water_that_a_box_displaces():
    snapshot = live().snapshot()
    draft = 2000.0 / (1025.0 * 4.0 * 2.0)
    assert snapshot.center_of_buoyancy == pytest.approx([0.0, 0.0, -0.5 + draft / 2], abs=1e-9)
    assert snapshot.wetness == pytest.approx(draft, abs=1e-9)
    assert snapshot.lift.sum() == pytest.approx(2000.0 * 9.81)
    high = live()
    high.lift(5.0)
    assert high.snapshot().center_of_buoyancy is None


def test_the_history_is_the_last_minute_and_no_more():
    boat = tuned(live(), sea__waves=[0.2, 4.0, 0.0, 0.0])
    heights = []
    for _ in range(7000):
        boat.step()
        heights.append(boat.snapshot().position[2])
    time_, heave, roll, pitch, speed = boat.history.columns()
    assert len(time_) == SPAN / PERIOD
    assert time_ == pytest.approx(np.arange(len(time_)) * PERIOD - (SPAN - PERIOD), abs=1e-6)
    # From the first step on, every tenth.
    assert heave.tolist() == heights[::10][-600:]
    assert abs(roll).max() < 1e-9 and pitch.any() and speed.any()


@pytest.fixture
def loop():
    made = Loop(live('waves'))
    yield made
    made.stop()
    assert made.ended.result() is None


def test_the_loop_steps_in_real_time_and_not_while_paused(loop):
    boat = loop.boat
    loop.start()
    time.sleep(0.5)
    loop.ask(setattr, boat, 'paused', True).result()
    steps = boat.session.steps
    # As many periods as began; the machine may be late, and catches up.
    assert 25 <= steps <= 51 + 100
    time.sleep(0.2)
    assert boat.session.steps == steps
    assert loop.ask(boat.step).result() and boat.session.steps == steps + 1
    alone = load_scene(source('waves')).simulation()
    for _ in range(steps + 1):
        alone.step()
    assert numbers(boat.session.simulation) == numbers(alone)


def test_what_is_asked_for_is_done_by_the_loop_and_its_errors_come_back(loop):
    loop.start()
    assert loop.ask(lambda: threading.current_thread().name).result() == 'physics'
    with pytest.raises(ZeroDivisionError):
        loop.ask(lambda: 1 / 0).result()
    assert not loop.ended.done()
