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

"""The knobs of a page are those of the parameter table, and what they ask for is right."""

import math
from pathlib import Path
import socket
import threading

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.hydrostatics.rest import rest_attitude
from boat_buoyancy.physics.scene.parameters import PARAMETERS
from boat_buoyancy.physics.scene.scene import scene_from_values
from boat_buoyancy.tools import command_line, report
from boat_buoyancy.tools.view import main
from boat_buoyancy.tools.view.knob_panel import read_value
from boat_buoyancy.tools.view.knobs import knobs, trimmed, turned
from boat_buoyancy.tools.view.live_boat import LiveBoat
from boat_buoyancy.tools.view.readout import figures, stable_step
from boat_buoyancy.tools.view.shapes import (CELLS, hull_mesh, lift_arrows, LINED, probe_colors,
                                             WaterPatch)
from boat_buoyancy.tools.view.worker import Worker
import numpy as np
import programs
import pytest

CONFIG = Path(__file__).parents[1] / 'config'
SCENES = sorted(CONFIG.glob('*.yaml'))


def refused(capsys, *words):
    return programs.refused(main.main, 'buoyancy_view', words, capsys)


@pytest.mark.parametrize('path', SCENES, ids=lambda path: path.stem)
def test_every_knob_stands_at_its_value_and_reaches_only_what_is_taken(path):
    scene = load_scene(path)
    for members in knobs(scene).values():
        for knob in members:
            parameter, value = PARAMETERS[knob.name], knob.value(scene)
            assert knob.low <= value <= knob.high and knob.step > 0
            assert parameter.description in knob.hint and knob.name in knob.hint
            if parameter.limits:
                assert parameter.limits[0] <= knob.low
            asked = knob.request(scene, value)
            assert set(asked) == {knob.name}
            if knob.name != 'sea.waves':
                again = scene_from_values({**scene.given, **asked}, scene)
                assert again.values == scene.values


def test_a_knob_changes_its_own_number_and_no_other():
    scene = load_scene(CONFIG / 'v4_tuned.yaml')
    for members in knobs(scene).values():
        for knob in members:
            value = knob.value(scene)
            value = value + knob.step if value < knob.high else value - knob.step
            changed = scene_from_values({**scene.given, **knob.request(scene, value)}, scene)
            assert knob.value(changed) == value
            if knob.index is not None and knob.name != 'sea.waves':
                before, after = list(scene.values[knob.name]), list(changed.values[knob.name])
                assert after.pop(knob.index) == value
                assert before.pop(knob.index) != value and after == before


@pytest.mark.parametrize('name, before, after', [
    ('damping.probe', 3, 1), ('damping.linear_retention', 3, 1),
    ('damping.angular_retention', 3, 1)])
def test_there_is_a_knob_for_every_number_that_a_parameter_has_by_now(name, before, after):
    for numbers in (before, after):
        scene = scene_from_values({name: [0.5] * numbers})
        assert [index for one, index in turned(scene) if one == name] == list(range(numbers))


@pytest.mark.parametrize('end, axis, sign', [
    ('bow', 1, 1), ('stern', 1, -1), ('port', 0, -1), ('starboard', 0, 1)])
@pytest.mark.parametrize('name', ['default', 'v4_tuned', 'wigley'])
def test_trim_lets_that_end_sink_and_level_undoes_it(name, end, axis, sign):
    boat = LiveBoat(CONFIG / f'{name}.yaml')
    level, values = boat.scene, boat.scene.values
    attitude = rest_attitude(level.boat)[axis]
    boat.take(boat.proposed(trimmed(boat.scene, end)))
    # Roll is starboard down and pitch bow down.
    assert sign * (rest_attitude(boat.scene.boat)[axis] - attitude) > 1e-3
    boat.take(boat.proposed(trimmed(boat.scene, 'level')))
    assert boat.scene.values == values


@pytest.mark.parametrize('path', SCENES, ids=lambda path: path.stem)
def test_what_a_page_says_of_a_boat_at_rest_is_what_the_report_says(path, monkeypatch):
    # Found apart below.
    monkeypatch.setattr(report, 'max_stable_steps', lambda boat: None)
    scene = load_scene(path)
    found, reported = figures(scene), report.figures(scene)
    assert {name: reported[name] for name in found if name != 'warnings'} == {
        name: value for name, value in found.items() if name != 'warnings'}
    assert found['warnings'] == reported['warnings'][:len(found['warnings'])]


def test_the_largest_stable_step_is_the_reports():
    scene = load_scene({})
    step = report.max_stable_steps(scene.boat)['leapfrog']
    assert stable_step(scene) == f'{step:.3g} s'
    assert stable_step(load_scene({'integrator': 'implicit'})) == 'no limit'


@pytest.mark.parametrize('name, text, value', [
    ('boat.mass', '2500', 2500), ('integrator', ' rk4 ', 'rk4'),
    ('sea.current', '[1.0, 2.0]', [1.0, 2.0])])
def test_a_value_is_written_as_in_a_file(name, text, value):
    assert read_value(name, text) == {name: value}


@pytest.mark.parametrize('text', ['1e3', '[1, 2.0]', 'yes', '', '010', ': :', '[1', '2\nrate: 5'])
def test_a_value_that_ros_and_yaml_read_differently_gets_one_line(text):
    try:
        value = read_value('boat.mass', text)
    except ValueError as refusal:
        assert '\n' not in str(refusal) and 'line 3)' not in str(refusal)
    else:
        # What is text is refused as a mass.
        assert list(value) == ['boat.mass']
        with pytest.raises(ValueError, match='^boat.mass: '):
            load_scene(value)


def test_the_water_is_that_of_the_sea_at_fixed_places_and_its_lines_at_multiples():
    boat = LiveBoat(CONFIG / 'waves.yaml')
    patch, seen = WaterPatch(4.5), {}
    for _ in range(3):
        boat.lift(0.0)
        snapshot = boat.snapshot()
        middle, points, lines = patch.around(snapshot)
        assert np.abs(middle[:2] - snapshot.position[:2]).max() <= 0.5 * patch.cell + 1e-12
        places = points + middle
        assert places[:, 2] == pytest.approx(
            snapshot.water.elevation(places[:, 0], places[:, 1], snapshot.time))
        ends = (lines + middle)[..., :2] / patch.cell
        assert ends == pytest.approx(np.round(ends), abs=1e-9)
        along = (np.round(ends) % LINED == 0).all(axis=1)
        assert along.any(axis=1).all()
        assert len(lines) in {CELLS * lines_ for lines_ in (16, 17, 18)}
        seen[tuple(middle)] = True
        state = boat.session.simulation.state
        boat.session.simulation.state = type(state)(
            state.position + [2.3, -1.1, 0.0], state.orientation)
    assert len(seen) == 3


def test_a_hull_without_a_surface_is_drawn_as_a_closed_box_seen_from_outside():
    corners, triangles = hull_mesh(load_scene(CONFIG / 'v4_tuned.yaml').boat)
    a, b, c = np.moveaxis(corners[triangles], 1, 0)
    volume = np.einsum('ij,ij->', a, np.cross(b, c)) / 6.0
    assert volume == pytest.approx(np.prod(np.ptp(corners, axis=0)))


def test_arrows_are_as_long_as_the_lift_and_colours_go_from_dry_to_wet():
    snapshot = LiveBoat(CONFIG / 'default.yaml').snapshot()
    arrows = lift_arrows(snapshot, 2.0)
    lengths = (arrows[:, 1] - arrows[:, 0])
    assert lengths[:, :2] == pytest.approx(0.0, abs=1e-12)
    # Each carries its share of the weight.
    assert lengths[:, 2] == pytest.approx(0.35 * 2.0)
    assert probe_colors(np.array([0.0, 1.0])).tolist() == [[253, 231, 37], [40, 30, 140]]


def test_of_what_waits_under_one_key_only_the_newest_is_done():
    done, errors, go = [], [], threading.Event()
    worker, ended = Worker(errors.append), threading.Event()
    worker.give(None, go.wait)
    for number in range(5):
        worker.give('slider', done.append, number)
        worker.give(None, done.append, -number)
    worker.give(None, lambda: 1 / 0)
    worker.give(None, ended.set)
    go.set()
    assert ended.wait(10)
    assert done == [0, -1, -2, -3, 4, -4]
    assert [type(error) for error in errors] == [ZeroDivisionError]


def test_what_is_wrong_is_one_line(capsys, tmp_path):
    scene = str(CONFIG / 'default.yaml')
    assert 'expected a number of 0 to 65535, got 70000' in refused(
        capsys, scene, '--port', '70000')
    for words in ((), (scene, '--ros')):
        assert 'expected either a SCENE, as config/waves.yaml, or --ros' in refused(capsys, *words)
    assert 'cannot be read' in refused(capsys, str(tmp_path / 'none.yaml'))
    with socket.socket() as taken:
        taken.bind(('127.0.0.1', 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert f'cannot listen on port {port} of 127.0.0.1: Address already in use' in refused(
            capsys, scene, '--port', str(port))
    assert 'give another --port' in refused(capsys, scene, '--host', '192.0.2.1')


@pytest.mark.parametrize('prefix, site', [
    ('', 'lib/python3.12/site-packages'), ('', 'Lib/site-packages'),
    ('local', 'local/lib/python3.12/dist-packages')])
def test_the_scenes_are_found_beside_the_library_wherever_it_was_installed(
        prefix, site, tmp_path, monkeypatch):
    module = tmp_path / site / 'boat_buoyancy' / 'tools' / 'command_line.py'
    monkeypatch.setattr(command_line, '__file__', str(module))
    assert command_line.shipped_scenes() == []
    folder = tmp_path / prefix / 'share' / 'boat_buoyancy' / 'config'
    folder.mkdir(parents=True)
    (folder / 'barge.yaml').touch()
    assert command_line.shipped_scenes() == [folder / 'barge.yaml']


def test_angles_are_drawn_in_the_words_of_the_boat():
    boat = LiveBoat(CONFIG / 'default.yaml')
    boat.heel(math.radians(20.0))
    turn = boat.snapshot().turn
    # Starboard, -y of the body, is down.
    assert (turn @ [0.0, -1.0, 0.0])[2] == pytest.approx(-math.sin(math.radians(20.0)))
