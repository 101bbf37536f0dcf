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

"""The examples that need no ROS give what theory says, and the same wherever they run."""

import json
from pathlib import Path
import subprocess
import sys

from boat_buoyancy.physics import load_scene
import numpy as np
from programs import loaded, refused
import pytest

ROOT = Path(__file__).parents[1]
BARGE, DEFAULT = (str(ROOT / 'config' / f'{name}.yaml') for name in ('barge', 'default'))
RUN = ('--boats', '30', '--seconds', '2', '--csv')


def run(name, *words):
    """Return the finished process of an example."""
    return subprocess.run([sys.executable, str(ROOT / 'examples' / f'{name}.py'), *words],
                          cwd=ROOT, capture_output=True, text=True, timeout=300.0)


def test_the_barge_answers_waves_as_the_boundary_element_method_has_it():
    # RMS over 2 to 12 s and three headings, heave, roll and pitch: at most 12, 9 and 4 %.
    known = json.loads((ROOT / 'test/data/bem_barge.json').read_text())
    rows = [row for row in known['rows'] if 2.0 <= row[0] <= 12.0]
    periods, headings = (sorted({row[i] for row in rows}) for i in (0, 1))
    found = loaded('wave_response').responses(load_scene(BARGE).given, periods, headings)
    expected = np.array([row[2:5] for row in sorted(rows)]).reshape(found.shape)
    errors = np.sqrt(np.mean((found - expected) ** 2, axis=(0, 1)))
    assert (errors <= [0.12, 0.09, 0.04]).all(), errors


def test_the_table_and_the_picture_of_wave_responses_are_written(tmp_path, capsys):
    picture = tmp_path / 'barge.png'
    assert loaded('wave_response').main([
        BARGE, '--periods', '4', '20', '--headings', '0', '90', '--plot', str(picture)]) == 0
    _, *rows = capsys.readouterr().out.splitlines()
    rows = np.array([[float(word) for word in row.split()] for row in rows])
    assert rows[:, :2].tolist() == [[4, 0], [4, 90], [20, 0], [20, 90]]
    # Long waves carry it along: up and down with the surface, aslant with its slope.
    assert rows[2:, 2] == pytest.approx(1.0, abs=0.01)
    assert rows[[2, 3], [4, 3]] == pytest.approx(1.0, abs=0.03)
    # From astern nothing rolls it, from the side nothing pitches it.
    assert rows[[0, 1], [3, 4]].tolist() == [0.0, 0.0]
    assert picture.read_bytes().startswith(b'\x89PNG')


def test_wave_responses_of_a_stone_are_one_line(tmp_path, capsys):
    stone = tmp_path / 'stone.yaml'
    stone.write_text('/**:\n  ros__parameters:\n    boat.mass: 9000.0\n')
    assert 'expected a boat that floats, got a floatiness of 0.911' in refused(
        loaded('wave_response').main, 'wave_response', [str(stone)], capsys)


def test_a_boat_of_the_monte_carlo_moves_as_it_does_alone():
    example, values = loaded('monte_carlo'), load_scene(DEFAULT).values
    rows = example.outcomes(values, range(5, 8), 3, 3.0)
    for number, mass, damping, roll, pitch, failed in rows:
        scene, drawn = example.drawn(values, number, 3)
        done = load_scene(scene).simulation().run(3.0)
        assert (mass, damping, failed) == (scene['boat.mass'], drawn, 0)
        assert np.degrees(np.abs(done.roll_pitch_yaw[1:, :2]).max(axis=0)) == pytest.approx(
            [roll, pitch], rel=1e-9)
    assert len({row[1] for row in rows}) == 3


def test_the_monte_carlo_gives_the_same_on_this_machine_and_on_a_scheduler(tmp_path):
    LocalCluster = pytest.importorskip('distributed').LocalCluster
    here, there = tmp_path / 'here.csv', tmp_path / 'there.csv'
    on_cores = run('monte_carlo', DEFAULT, *RUN, str(here))
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        on_scheduler = run('monte_carlo', DEFAULT, *RUN, str(there), '--scheduler',
                           cluster.scheduler_address)
    for done in (on_cores, on_scheduler):
        assert done.returncode == 0, done.stderr
        assert done.stdout.startswith('30 boats, 0 of which failed\n')
        assert '1 of 2 fleets\n' in done.stderr
    assert on_scheduler.stdout == on_cores.stdout
    assert here.read_bytes() == there.read_bytes() and here.read_text().count('\n') == 31


def test_a_scheduler_that_is_not_there_is_one_line(capsys):
    done = run('monte_carlo', DEFAULT, '--scheduler', 'tcp://127.0.0.1:9')
    assert done.returncode == 2 and 'Traceback' not in done.stderr
    assert done.stderr.splitlines()[-1].startswith('monte_carlo: ')
    assert '127.0.0.1:9' in done.stderr.splitlines()[-1]


def test_without_distributed_one_line_says_what_to_install(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, 'distributed', None)
    assert 'pip install distributed' in refused(
        loaded('monte_carlo').main, 'monte_carlo', [DEFAULT, '--scheduler', 'tcp://x:1'], capsys)


@pytest.mark.parametrize('words, said', [
    (['--boats', '0'], '--boats: expected'), (['--seconds', '-1'], '--seconds: expected'),
    (['--sea-state', '10'], 'sea.sea_state: expected')])
def test_bad_numbers_of_the_monte_carlo_are_one_line(words, said, capsys):
    assert said in refused(loaded('monte_carlo').main, 'monte_carlo', [DEFAULT, *words], capsys)
