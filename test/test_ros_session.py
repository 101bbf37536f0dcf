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

"""What the node keeps between messages and steps, without a graph."""

import math
from pathlib import Path

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.compiled import machine_code, numba
from boat_buoyancy.physics.scene.scene import scene_from_values
from boat_buoyancy.physics.sea.waves import Sea
from boat_buoyancy.physics.stepping.march import march_by
from boat_buoyancy.physics.stepping.simulation import SimulationError
from boat_buoyancy.ros.session import Session
import numpy as np
import pytest

CONFIG = Path(__file__).parents[1] / 'config'


ROWS = [0.2, 4.0, 0.3, 1.0]
START = 1_795_415_697_930_000_000  # ns, a multiple of the period at 100 Hz


def surface(session, x=1.0, y=-2.0):
    """Return the height and the velocity of the water under a session's boat, in m and m/s."""
    sea, time = session.simulation.sea, session.simulation.time
    return [float(sea.elevation(x, y, time)), *sea.velocity(x, y, time)]


def surface_error(session, x=1.0, y=-2.0):
    """Return what the surface in a session is off that of the sea at its stamp, in m."""
    expected = session.sea.elevation(x, y, session.stamp % 4_000_000_000 / 1e9)
    return surface(session, x, y)[0] - expected


def test_the_sea_is_a_function_of_the_stamp_from_the_first_step_on():
    session = Session(load_scene({'sea.waves': ROWS}))
    session.rebase(START)
    # Nothing is lost to the size of the numbers.
    assert abs(surface_error(session)) < 1e-12
    for _ in range(300):
        assert abs(surface_error(session)) < 1e-9
        session.step()
    assert session.stamp == START + 3_000_000_000


def test_skipped_time_brings_other_water_without_a_jump_and_exactly_after_the_fade():
    session = Session(load_scene({'sea.waves': ROWS, 'sea.transition': 1.0}))
    session.rebase(START)
    for _ in range(100):
        session.step()
    before = surface(session)
    session.skip(170)
    assert session.stamp == START + 2_700_000_000
    assert surface(session) == pytest.approx(before, abs=1e-12)
    for _ in range(101):
        session.step()
    assert abs(surface_error(session)) < 1e-9


@pytest.mark.parametrize('step', [3600.25, -0.7])
def test_a_clock_that_steps_brings_the_water_of_its_time_without_a_jump(step):
    session = Session(load_scene({'sea.waves': ROWS, 'sea.transition': 1.0}))
    session.rebase(START)
    for _ in range(100):
        session.step()
    before, age = surface(session), session.age
    session.rebase(session.stamp + round(step * 1e9))
    assert session.stamp == START + 1_000_000_000 + round(step * 1e9) and session.age == age
    assert surface(session) == pytest.approx(before, abs=1e-12)
    for _ in range(101):
        session.step()
    assert abs(surface_error(session)) < 1e-9


def test_boats_that_start_at_other_moments_have_the_same_stamps():
    stamps = []
    for start in (START - 23_456_789, START + 1_234_567):
        session = Session(load_scene({'rate': 60.0}))
        session.rebase(start)
        stamps.append(set())
        for _ in range(12):
            session.step()
            stamps[-1].add(session.stamp)
    # The first began one or two periods of 16.67 ms before.
    assert len(stamps[0] & stamps[1]) in (10, 11)


def test_thrust_lasts_its_time_out_in_periods_and_skipped_ones_count():
    session = Session(load_scene({'thrust.timeout': 0.5, 'damping.probe': 0.0}))

    def accelerates():
        before = session.simulation.motion.body_velocity[0]
        session.step()
        return session.simulation.motion.body_velocity[0] > before
    session.thrust.hold((1000.0, 0.0, 0.0, 0.0, 0.0, 0.0), False, session.age)
    # The step that begins half a second after the wrench is the last, to round-off.
    assert 50 <= [accelerates() for _ in range(60)].count(True) <= 51
    session.thrust.hold((1000.0, 0.0, 0.0, 0.0, 0.0, 0.0), False, session.age)
    assert accelerates()
    session.skip(51)
    assert not accelerates()


def test_a_new_sea_comes_without_a_jump_and_is_exactly_the_one_given_after_its_fade():
    session = Session(load_scene({}))
    session.rebase(START)
    session.step()
    before = surface(session)
    session.set_waves(Sea(ROWS).waves)
    assert surface(session) == pytest.approx(before, abs=1e-12)
    # Four seconds, as sea.transition says when it is left out.
    for _ in range(400):
        session.step()
        assert not isinstance(session.simulation.sea, Sea)
    session.step()
    assert isinstance(session.simulation.sea, Sea)
    assert session.simulation.sea.waves[:, :3].tolist() == [ROWS[:3]]
    assert abs(surface_error(session)) < 1e-12


def test_another_boat_in_the_middle_of_a_fade_sees_the_water_of_the_one_before():
    session = Session(load_scene({}))
    session.set_waves(Sea(ROWS).waves)
    for _ in range(200):
        session.step()
    before = surface(session)
    assert abs(before[0]) > 0.01
    scene = load_scene({'boat.mass': 2500.0})
    session.change(scene, scene.plan())
    assert surface(session) == pytest.approx(before, abs=1e-12)
    for _ in range(201):
        session.step()
    assert abs(surface_error(session)) < 1e-9


def test_another_boat_goes_on_from_place_speed_and_stamp_of_the_one_before():
    session = Session(load_scene({'sea.waves': ROWS}))
    session.rebase(START)
    for _ in range(123):
        session.step()
    before, stamp = session.simulation.state, session.stamp
    scene = load_scene({'sea.waves': ROWS, 'boat.mass': 2500.0})
    session.change(scene, scene.plan())
    after = session.simulation.state
    for name in ('position', 'orientation', 'velocity', 'angular_velocity'):
        np.testing.assert_allclose(getattr(after, name), getattr(before, name), atol=1e-12)
    assert session.stamp == stamp and session.steps == 123
    assert session.simulation.boat.mass == 2500.0
    for _ in range(50):
        session.step()
        assert abs(surface_error(session)) < 1e-9


def test_waves_that_came_by_message_stay_when_the_boat_or_the_current_changes():
    session = Session(load_scene({'sea.transition': 0.0}))
    assert session.set_waves(Sea(ROWS).waves)
    assert not session.set_waves(Sea(ROWS).waves)
    for values in ({'boat.mass': 2500.0}, {'sea.current': [1.0, 0.0]}):
        scene = load_scene({'sea.transition': 0.0, **values})
        session.change(scene, scene.plan())
        assert session.sea.waves.ravel().tolist() == ROWS
    assert session.sea.current.tolist() == [1.0, 0.0]


def test_waves_that_cannot_run_against_the_current_change_nothing():
    session = Session(load_scene({'sea.current': [-1.0, 0.0], 'sea.transition': 0.0}))
    session.set_waves(Sea(ROWS).waves)
    with pytest.raises(ValueError, match='row 1 .* cannot run against 1 m/s of sea.current'):
        session.set_waves(Sea([[0.1, 2.0, 0.0, 0.0]]).waves)
    assert session.sea.waves.ravel().tolist() == ROWS and session.step()
    # A current is judged by the waves in force, whoever asked for them.
    scene = load_scene({'sea.current': [-3.0, 0.0], 'sea.transition': 0.0})
    with pytest.raises(ValueError, match='row 1 .* cannot run against .* of sea.current: .-3.0'):
        session.sea_with(scene, {'sea.current'})
    calm = load_scene({'sea.current': [-3.0, 0.0], 'sea.transition': 0.0, 'sea.waves': []})
    assert session.sea_with(calm, {'sea.current', 'sea.waves'}).is_flat
    assert session.sea.waves.ravel().tolist() == ROWS
    assert session.sea.current.tolist() == [-1.0, 0.0] and session.step()


def test_what_a_current_stops_of_an_irregular_sea_comes_back_as_it_turns():
    sea = {'sea.sea_state': 3, 'sea.transition': 0.0}
    session = Session(load_scene(sea))
    whole = session.sea.waves
    for current, stops in (([-1.2, 0.0], True), ([1.2, 0.0], False)):
        scene = load_scene({**sea, 'sea.current': current})
        session.change(scene, None, {'sea.current'})
        assert np.array_equal(session.sea.waves, scene.sea.waves)
        assert (len(session.sea.waves) < len(whole)) == stops
    assert np.array_equal(session.sea.waves, whole)
    # Waves that came by message are not taken back by what a current does to those of the scene.
    session.set_waves(Sea(ROWS).waves)
    session.change(load_scene({**sea, 'sea.current': [-1.2, 0.0]}), None, {'sea.current'})
    assert session.sea.waves.ravel().tolist() == ROWS
    # Those of another spreading are.
    spread = load_scene({**sea, 'sea.spreading': 10.0})
    session.change(spread, None, {'sea.spreading', 'sea.current'})
    assert np.array_equal(session.sea.waves, spread.sea.waves)


def test_a_wind_blows_from_the_next_step_on_and_waves_go_on_fading():
    session = Session(load_scene({'sea.waves': ROWS, 'sea.transition': 1.0}))
    session.rebase(START)
    for _ in range(50):
        session.step()
    session.set_waves(Sea([[0.1, 3.0, 0.0, 0.0]]).waves)
    session.step()
    before = surface(session)
    assert session.set_wind((6.0, -2.0)) and not session.set_wind((6.0, -2.0))
    assert session.simulation.sea.wind.tolist() == session.sea.wind.tolist() == [6.0, -2.0]
    assert surface(session) == pytest.approx(before, abs=1e-12)
    for _ in range(120):
        session.step()
    # The fade is over, the wind is not.
    assert isinstance(session.simulation.sea, Sea)
    assert session.simulation.sea.wind.tolist() == [6.0, -2.0]


def test_a_wind_that_came_by_message_stays_until_a_parameter_asks_for_another():
    calm = {'sea.transition': 0.0}
    session = Session(load_scene(calm))
    session.set_wind((6.0, -2.0))
    for values in ({'boat.mass': 2500.0}, {'sea.current': [1.0, 0.0]}, {'sea.sea_state': 2}):
        scene = load_scene({**calm, **values})
        session.change(scene, scene.plan(), values)
        assert session.sea.wind.tolist() == session.simulation.sea.wind.tolist() == [6.0, -2.0]
    for wind in ([0.0, 3.0], [0.0, 3.0]):
        session.set_wind((6.0, -2.0))
        session.change(load_scene({**calm, 'wind.velocity': wind}), None, {'wind.velocity'})
        assert session.sea.wind.tolist() == session.simulation.sea.wind.tolist() == wind


def test_a_parameter_that_asks_for_waves_takes_the_place_of_those_of_a_message():
    calm = {'sea.transition': 0.0}
    for values in ({**calm, 'sea.waves': ROWS}, {**calm, 'sea.waves': []}):
        session = Session(load_scene(values))
        session.set_waves(Sea([[0.05, 3.0, 0.0, 0.0]]).waves)
        scene = load_scene(values)
        session.change(scene, scene.plan(), {'sea.waves'})
        assert session.sea.waves.ravel().tolist() == values['sea.waves']


def test_a_seed_without_an_irregular_sea_leaves_the_waves_of_a_message():
    session = Session(load_scene({'sea.transition': 0.0}))
    session.set_waves(Sea(ROWS).waves)
    scene = load_scene({'sea.transition': 0.0, 'sea.seed': 2})
    session.change(scene, scene.plan(), {'sea.seed'})
    assert session.sea.waves.ravel().tolist() == ROWS


def test_a_flood_of_seas_ends_with_the_last_of_them_and_no_step_grows_dearer():
    session = Session(load_scene({'sea.transition': 1.0}))
    for i in range(300):
        session.set_waves(Sea([[0.1, 3.0 + 0.01 * i, 0.0, 0.0]]).waves)
        session.step()
        # What was there, what interrupted it, and what comes.
        assert session.simulation.sea.table.shape[1] <= 3
    for _ in range(201):
        session.step()
    assert isinstance(session.simulation.sea, Sea)
    assert session.simulation.sea.waves[0, 1] == pytest.approx(3.0 + 0.01 * 299)


@pytest.mark.skipif(numba() is None, reason='Numba is not there')
def test_neither_another_boat_nor_another_sea_compiles_anything():
    session = Session(load_scene({'sea.transition': 0.05}))
    session.step()
    step = machine_code(march_by('leapfrog'))
    before = list(step.signatures)
    session.thrust.hold((100.0, 0.0, 0.0, 0.0, 0.0, 0.0), False, 0.0)
    for values in ({'boat.mass': 2500.0}, {'sea.sea_state': 3}, {'sea.current': [1.0, 0.0]},
                   {'wind.velocity': [5.0, 0.0]}, {'wind.drag': [5.0, 9.0, 1.0]}):
        scene = load_scene({'sea.transition': 0.05, **values})
        session.change(scene, scene.plan())
        for _ in range(7):
            session.step()
    assert step.signatures == before


def test_a_fault_stops_the_motion_until_reset(monkeypatch):
    session = Session(load_scene({}))
    session.thrust.hold((100.0, 0.0, 0.0, 0.0, 0.0, 0.0), False, 0.0)
    assert session.step()
    good, stamp = session.simulation.state, session.stamp

    def fail(thrust=None):
        raise SimulationError('forced from inside')
    with monkeypatch.context() as patch:
        patch.setattr(session.simulation, 'step', fail)
        assert not session.step()
    assert session.fault == 'forced from inside'
    assert not session.step()
    np.testing.assert_array_equal(session.simulation.state.position, good.position)
    assert session.stamp == stamp
    session.reset()
    assert session.fault is None and session.thrust.age(0.0) is None
    assert session.step() and session.stamp > stamp


def test_a_boat_put_somewhere_floats_there_at_its_draft_and_at_rest():
    session = Session(load_scene({}))
    session.place(5.0, -3.0, 1.2)
    state = session.simulation.state
    assert state.position.tolist() == pytest.approx([5.0, -3.0, 0.5 - 2000.0 / 8200.0])
    assert not state.velocity.any() and not state.angular_velocity.any()
    assert 2 * math.atan2(state.orientation[2], state.orientation[3]) == pytest.approx(1.2)


def test_a_hull_that_takes_other_columns_at_its_new_draft_is_refused_and_nothing_is_lost():
    # The tubes of the RIB come into the water between the two.
    rib = load_scene(CONFIG / 'rib.yaml')
    session = Session(load_scene({**rib.given, 'hull.model': 'columns', 'boat.mass': 400.0}))
    heavier = scene_from_values({**session.scene.given, 'boat.mass': 650.0}, session.scene)
    with pytest.raises(ValueError, match='boat.mass: expected a boat on as many columns'):
        session.change(heavier, heavier.plan(), {'boat.mass'})
    assert session.scene.boat.mass == session.simulation.boat.mass == 400.0


def test_panels_stay_as_fine_as_the_waves_in_force_need_them_when_the_boat_changes():
    scene = load_scene({'hull.model': 'panels'})
    session = Session(scene)
    session.set_waves(np.array([[0.02, 1.0, 0.0, 0.0]]))
    for _ in range(500):
        session.step()
    fine = len(session.simulation.boat.hull.panels.triangles)
    damped = scene_from_values({'hull.model': 'panels', 'damping.linear': [100.0] * 6}, scene)
    session.change(damped, damped.plan(), {'damping.linear'})
    assert len(session.simulation.boat.hull.panels.triangles) == fine > len(
        scene.boat.hull.panels.triangles)
