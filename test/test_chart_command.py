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

"""The command line of the chart, its pictures and the speed it reports."""

import csv

from boat_buoyancy.physics.compiled import numba
from boat_buoyancy.tools.chart import (hull_accuracy, speed, speed_accuracy_plots as plots,
                                       speed_plot, speed_report, time_stepping)
from boat_buoyancy.tools.chart.main import main
from boat_buoyancy.tools.chart.pareto_front import PART
from boat_buoyancy.tools.chart.scenes import SCENES
from boat_buoyancy.tools.chart.speed import Case
from boat_buoyancy.tools.chart.table import COLUMNS, Row
from PIL import Image
import programs
import pytest
import yaml


def refused(capsys, *words):
    return programs.refused(main, 'buoyancy_chart', words, capsys)


def test_bad_tolerance_gets_one_line(capsys, tmp_path):
    scene = tmp_path / 'scene.yaml'
    scene.write_text('/**:\n  ros__parameters:\n    rate: 50.0\n')
    for tolerance in ('0', '-0.01', 'nan', 'inf', 'fine', ''):
        line = refused(capsys, str(scene), f'--tolerance={tolerance}')
        assert '--tolerance: expected a finite number above 0, got' in line


def test_bad_scenes_and_options_get_one_line(capsys, tmp_path):
    scene = tmp_path / 'scene.yaml'
    scene.write_text('/**:\n  ros__parameters:\n    boat:\n      mass: -1.0\n')
    assert 'boat.mass' in refused(capsys, str(scene), '--tolerance', '0.01')
    assert 'boat.mass' in refused(capsys, str(scene), '--out', str(tmp_path))
    assert 'no-such.yaml' in refused(capsys, 'no-such.yaml', '--tolerance', '0.01')
    assert 'expected a SCENE' in refused(capsys, '--tolerance', '0.01')
    assert 'expected one of them' in refused(capsys, '--speed', '--stability')
    assert 'expected no SCENE' in refused(capsys, str(scene), '--speed')
    assert '--colour' in refused(capsys, '--colour')


def test_command_prints_lines_to_paste_with_error_cost_and_speed(capsys, tmp_path):
    scene = tmp_path / 'scene.yaml'
    scene.write_text('/**:\n  ros__parameters:\n    probes:\n      positions: [0.0, 0.0, 0.0]\n')
    assert main([str(scene), '--tolerance', '0.02']) == 0
    captured = capsys.readouterr()
    printed = captured.out
    assert 'the cheapest setting that meets 0.02 m' in printed
    pasted = yaml.safe_load('\n'.join(line for line in printed.splitlines()
                                      if line.startswith('    ')))
    assert set(pasted) == {'integrator', 'rate', 'substeps'}
    for words in ('Error', 'force evaluations', 'µs of CPU time', 'times real time',
                  'Next cheaper', 'As the scene stands'):
        assert words in printed
    assert 'solving 20 s of the true motion\n' in captured.err


@pytest.mark.long
def test_quick_chart_writes_table_pictures_and_summary(capsys, tmp_path):
    assert main(['--quick', '--out', str(tmp_path)]) == 0
    captured = capsys.readouterr()
    assert 'errors: 1 of' in captured.err
    with open(tmp_path / 'speed_accuracy.csv', encoding='utf-8') as file:
        rows = list(csv.DictReader(file))
    assert tuple(rows[0]) == COLUMNS
    assert {row['part'] for row in rows} == {'time stepping', 'model', 'both'}
    summary, written = captured.out.rsplit('Written to ', 1)
    assert (tmp_path / 'speed_accuracy.txt').read_text() == summary
    assert written.startswith(f'{tmp_path}: ')
    for name in ('speed_accuracy', 'speed_accuracy_model', 'speed_accuracy_front',
                 'righting_arm'):
        assert Image.open(tmp_path / f'{name}.png').width == 1350


def test_pictures_are_as_wide_as_the_readme_and_equal_for_equal_data(tmp_path):
    steps = [Row(time_stepping.PART, scene.name, integrator, float(rate), evaluations=float(rate),
                 cpu=1e-5 * rate, error=1.0 / rate) for scene in SCENES
             for integrator in time_stepping.INTEGRATORS for rate in (10, 100, 1000)]
    hulls = [Row(hull_accuracy.PART, scene, 'leapfrog', 30.0, model, 4, panels,
                 quantity=quantity, cpu=3e-5, percent=1.0)
             for scene in (*(shape.name for shape in hull_accuracy.SHAPES), *hull_accuracy.RATIOS)
             for quantity in (*hull_accuracy.RIGHTING.values(), 'motion')
             for model, panels in (('springs', 0), ('columns', 0), ('panels', 12))]
    fronts = [Row(PART, 'scene', 'leapfrog', 10.0, 'columns', 4, 0, '2x2', cpu=1e-4, error=0.1,
                  front=1),
              Row(PART, 'scene', 'rk4', 10.0, 'panels', 4, 12, '2x2', 0.0, cpu=1e-3, error=0.01,
                  front=1)]
    plots.draw_time_stepping(steps, tmp_path / 'steps.png')
    plots.draw_model(hulls, tmp_path / 'model.png')
    plots.draw_front(fronts, 'scene', tmp_path / 'front.png')
    plots.draw_front(fronts, 'scene', tmp_path / 'again.png')
    for name in ('steps.png', 'model.png', 'front.png'):
        assert Image.open(tmp_path / name).width == 1350
    assert (tmp_path / 'front.png').read_bytes() == (tmp_path / 'again.png').read_bytes()


def made_up_times():
    """Return times of a step: 3 us and 0.05 us for every wave at every probe; of a call 2 us."""
    best = {}
    for case in speed.cases(False):
        work = case.probes * case.waves
        step = 3.0 + 0.05 * work + 2.0 / case.boats
        best[case] = 1e-6 * case.boats * {
            'step': step, 'run': step - 2.0, 'threads': step / 2.0, 'plain': 100.0 * step,
            'trigonometry': 0.04 * work}[case.kind]
    return best


def test_speed_is_told_per_boat_and_held_against_its_trigonometry(tmp_path):
    best = made_up_times()
    text = speed_report.text(best)
    # 4 probes and 4 waves: 3 + 16 x 0.05 us and the call, beside 16 x 0.04 us.
    assert ('| waves | 1 boat, plain Python | 1 boat | 1 boat, in a run | 10 boats | 100 boats '
            '| 1000 boats | 10000 boats | 1000 boats, all threads | 10000 boats, all threads |'
            ) in text
    assert ('| 4 | 580 | 5.8 | 3.8 | 4 (0.64) | 3.82 (0.64) | 3.8 (0.64) | 3.8 (0.64) | 1.9 '
            '| 1.9 |') in text
    for line in ('one boat alone costs 1.53 times what one of 1000 does, and 1.53 times a step of '
                 'a run', 'plain Python costs 100 times that one boat',
                 'one of 1000 boats costs 5.94 times its trigonometry by NumPy, '
                 'with 64 waves 1.54 times',
                 '10000 boats take one thread 2 times as long as all processors',
                 '| rk4 | yes | 580 | 3.8 | 3.8 |'):
        assert line in text
    speed_plot.draw(best, tmp_path / 'speed.png')
    assert Image.open(tmp_path / 'speed.png').width == 1350


def test_every_kind_of_case_of_the_speed_can_be_measured():
    kinds = {(case.kind, case.boats): case for case in speed.cases(True)
             if case.integrator == 'leapfrog' and case.boats <= 1000}
    best = speed.measure(kinds.values(), 1)
    assert {case.kind for case in best} == {'step', 'run', 'plain', 'threads', 'trigonometry'}
    assert all(time > 0.0 for time in best.values())
    assert speed.moving(Case('step', 10, 8, 4)).state.position.shape == (10, 3)
    assert speed.moving(Case('step', 1, 16, 0)).sea.is_flat


def test_plain_python_is_measured_in_a_process_of_its_own():
    assert speed.in_process(speed.PLAIN, [Case('plain')], 1)[Case('plain')] > 10.0 * (
        speed.measure([Case('run')], 1)[Case('run')]) or numba() is None


@pytest.mark.long
def test_quick_speed_writes_text_table_and_picture(capfd, tmp_path):
    assert main(['--speed', '--quick', '--out', str(tmp_path)]) == 0
    captured = capfd.readouterr()
    assert (tmp_path / 'step_speed.md').read_text() + '\n' == captured.out
    assert '## Ratios' in captured.out
    assert captured.err.count('round 3 of 3') == 2
    with open(tmp_path / 'speed.csv', encoding='utf-8') as file:
        rows = list(csv.DictReader(file))
    assert all(float(row['microseconds_per_boat_step']) > 0.0 for row in rows)
    assert Image.open(tmp_path / 'speed.png').width == 1350
