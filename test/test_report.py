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

"""What the report prints, read as programs and people read it."""

from contextlib import redirect_stderr, redirect_stdout
import io
from itertools import pairwise
import json
import os
from pathlib import Path
import subprocess
import sys

from boat_buoyancy.physics import load_scene, SimulationError
from boat_buoyancy.tools import command_line
from boat_buoyancy.tools.report import exact_heel_degrees, main
from boat_buoyancy.tools.report import text as as_text
import numpy as np
import programs
import pytest

ROOT = Path(__file__).parents[1]
SCENES = sorted(path for path in (ROOT / 'config').glob('*.yaml'))
KEYS = [
    'draft_m', 'floatiness', 'displacement_kg', 'gm_transverse_m', 'gm_longitudinal_m',
    'heave_period_s', 'roll_period_s', 'pitch_period_s', 'heave_damping_ratio',
    'roll_damping_ratio', 'pitch_damping_ratio', 'max_stable_step_s', 'substeps', 'warnings',
    'gz_heel_deg', 'gz_m', 'gz_exact_to_deg', 'step']
SMALL_BARGE = ['hull.size: [4.0, 2.0, 1.0]', 'boat.mass: 2000.0', 'water_density: 1000.0']
UNDAMPED = ['damping.linear_retention: [1.0]', 'damping.angular_retention: [1.0]']
FOUR_PROBES = ['boat.mass: 1000.0',
               'probes.positions: [1.0, 1.0, 0.0, 1.0, -1.0, 0.0,'
               ' -1.0, 1.0, 0.0, -1.0, -1.0, 0.0]']

# By what is written in the file.
REPORTS = {}


@pytest.fixture
def scene(tmp_path):
    """Return a function that writes parameters to a file and returns its path."""
    def write(*lines):
        path = tmp_path / 'scene.yaml'
        path.write_text('\n    '.join(['/**:\n  ros__parameters:', 'rate: 100.0', *lines]) + '\n')
        return str(path)

    return write


def report(path):
    """Return the JSON report of a file, refused where it is not JSON; made once of each."""
    content = Path(path).read_text()
    if content not in REPORTS:
        out, err = io.StringIO(), io.StringIO()
        with redirect_stdout(out), redirect_stderr(err):
            assert main([str(path), '--json']) == 0
        assert err.getvalue() == ''
        REPORTS[content] = json.loads(out.getvalue(), parse_constant=pytest.fail)
    return REPORTS[content]


def text(path):
    """Return the report of a file as a person reads it."""
    return as_text(path, load_scene(path), report(path))


def refused(arguments, capsys):
    return programs.refused(main, 'buoyancy_report', arguments, capsys)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def test_the_scenes_that_ship_are_there():
    assert {'default', 'barge', 'v0_single_probe', 'v1_four_probes', 'v2_budget',
            'v3_probe_damping', 'v4_tuned'} <= {path.stem for path in SCENES}


@pytest.mark.parametrize('path', SCENES, ids=lambda path: path.stem)
def test_every_scene_has_all_figures_and_only_numbers(path):
    result = report(path)
    assert list(result) == KEYS
    assert set(result['max_stable_step_s']) == {
        'leapfrog', 'implicit', 'rk4', 'symplectic_euler', 'euler'}
    assert result['gz_heel_deg'] == [5.0 * i for i in range(37)]
    assert len(result['gz_m']) == 37
    numbers = [result[key] for key in KEYS if key not in (
        'max_stable_step_s', 'warnings', 'gz_heel_deg', 'gz_m', 'step')]
    for value in [*numbers, *result['max_stable_step_s'].values(), *result['gz_m']]:
        assert value is None or is_number(value)
    assert isinstance(result['substeps'], int) and result['substeps'] >= 1
    for sentence in result['warnings']:
        assert len(sentence.split()) > 6 and '\n' not in sentence
    shown = text(path)
    assert f'{result["displacement_kg"]:.6g} kg' in shown
    assert ('No warnings.' in shown) == (result['warnings'] == [])


def test_the_small_barge_is_reported_as_computed_by_hand(scene):
    result = report(scene(*SMALL_BARGE))
    assert result['draft_m'] == pytest.approx(0.25, abs=1e-14)
    assert result['floatiness'] == pytest.approx(4.0, rel=1e-14)
    assert result['displacement_kg'] == 2000.0
    assert result['gm_transverse_m'] == pytest.approx(0.125 + 4.0 / 3.0 - 0.5, rel=1e-12)
    assert result['gm_longitudinal_m'] == pytest.approx(0.125 + 16.0 / 3.0 - 0.5, rel=1e-12)
    assert result['heave_period_s'] == pytest.approx(2 * np.pi * np.sqrt(0.25 / 9.81), rel=1e-12)
    roll = 2000.0 * 9.81 * result['gm_transverse_m'] / (2000.0 / 12.0 * 5.0)
    assert result['roll_period_s'] == pytest.approx(2 * np.pi / np.sqrt(roll), rel=1e-12)
    assert result['gz_exact_to_deg'] == pytest.approx(np.degrees(np.arctan(0.25)), rel=1e-12)
    heel = np.radians(10.0)
    assert result['gz_m'][2] == pytest.approx(np.sin(heel) * (
        result['gm_transverse_m'] + 2.0 / 3.0 * np.tan(heel)**2), rel=1e-12)
    assert result['warnings'] == []


def test_damping_ratios_are_those_of_the_parameters(scene):
    critical = 2 * np.sqrt(4.0 * 2.0 * 9810.0 * 2000.0)
    probe = f'damping.probe: {float(0.2 * critical)!r}'
    result = report(scene(*SMALL_BARGE, *UNDAMPED, probe))
    assert result['heave_damping_ratio'] == pytest.approx(0.2, rel=1e-12)
    assert report(scene(*SMALL_BARGE, *UNDAMPED))['heave_damping_ratio'] == pytest.approx(
        0.3, rel=1e-12)


def test_the_barge_has_its_righting_arms_and_says_how_far_they_are_the_boxs():
    result = report(ROOT / 'config' / 'barge.yaml')
    arms = dict(zip(result['gz_heel_deg'], result['gz_m']))
    assert result['draft_m'] == pytest.approx(1.5, abs=1e-3)
    assert result['gm_transverse_m'] == pytest.approx(0.95, abs=1e-3)
    assert arms[10.0] == pytest.approx(0.1704, abs=2e-4)
    assert arms[20.0] == pytest.approx(0.3702, abs=2e-4)
    assert result['gz_exact_to_deg'] == pytest.approx(26.57, abs=0.02)
    assert f'Up to {result["gz_exact_to_deg"]:.1f} degrees' in text(ROOT / 'config/barge.yaml')


def test_without_columns_side_by_side_no_exact_righting_arm_is_promised(scene):
    for lines in ([*SMALL_BARGE, 'hull.probes: [2, 1]'], [*SMALL_BARGE, 'probes.law: spring'],
                  [*SMALL_BARGE, 'probes.law: soft'], FOUR_PROBES):
        assert exact_heel_degrees(load_scene(scene(*lines))) is None


def test_a_boat_that_sinks_has_no_draft_no_periods_and_no_righting_arm(scene):
    path = scene('boat.mass: 9000.0')
    result = report(path)
    for key in KEYS[:1] + KEYS[3:11] + ['gz_exact_to_deg']:
        assert result[key] is None
    assert result['gz_m'] == [None] * 37
    assert result['displacement_kg'] == pytest.approx(8200.0, rel=1e-12)
    assert result['warnings'][0].startswith('The boat sinks: its floatiness is 0.911111')
    shown = text(path)
    assert 'none: the boat sinks' in shown and '- The boat sinks' in shown


def test_a_boat_that_cannot_float_upright_has_no_roll_period_and_is_told(scene):
    path = scene('hull.size: [1.0, 1.0, 1.0]', 'boat.mass: 500.0', 'water_density: 1000.0')
    result = report(path)
    assert result['gm_transverse_m'] == pytest.approx(-1.0 / 12.0, rel=1e-12)
    assert result['roll_period_s'] is None and result['pitch_damping_ratio'] is None
    assert result['heave_period_s'] is not None
    assert any('cannot float upright' in sentence for sentence in result['warnings'])
    assert 'Nothing rights the boat from upright.' in text(path)


def test_a_full_probe_at_rest_is_told(scene):
    result = report(scene(*FOUR_PROBES, 'probes.weights: [2.0, 1.0, 1.0, 1.0]',
                          'probes.floatiness: 1.2'))
    assert any(sentence.startswith('A probe is full at rest') for sentence in result['warnings'])


def test_drag_that_counts_twice_is_told(scene):
    result = report(scene('damping.linear: [100.0, 100.0, 500.0, 300.0, 900.0, 800.0]'))
    assert any('counts twice' in sentence for sentence in result['warnings'])


def test_a_shallow_boat_is_stepped_as_its_fastest_oscillation_needs(scene):
    result = report(scene(*FOUR_PROBES, *UNDAMPED, 'damping.probe: 0.0',
                          'probes.stiffness: 2000.0'))
    assert result['draft_m'] == pytest.approx(1.0 / 2000.0 / 1.2, rel=1e-12)
    fastest = max(2 * np.pi / result[f'{name}_period_s'] for name in ('heave', 'roll', 'pitch'))
    assert result['max_stable_step_s']['leapfrog'] == pytest.approx(2.0 / fastest, rel=1e-5)
    assert result['max_stable_step_s']['implicit'] is None
    assert result['max_stable_step_s']['euler'] == 0.0
    assert result['substeps'] == np.ceil(fastest / 100.0 / 0.5)


def test_the_righting_arms_are_printed_to_the_millimetre(scene):
    path = scene(*SMALL_BARGE)
    result, lines = report(path), text(path).splitlines()
    heels, arms = [], []
    for above, below in pairwise(lines):
        if above.startswith('  heel '):
            heels += map(float, above.split()[1:])
            arms += map(float, below.split()[1:])
    assert heels == result['gz_heel_deg']
    np.testing.assert_allclose(arms, result['gz_m'], atol=5.1e-4)


def test_without_json_the_report_is_printed_for_a_person(scene, capsys):
    path = scene(*SMALL_BARGE)
    assert main([path]) == 0
    printed = capsys.readouterr()
    assert printed.err == '' and printed.out == text(path) + '\n'


def test_the_vanishing_angle_is_where_the_righting_arm_crosses_zero(scene):
    path = scene(*SMALL_BARGE)
    result = report(path)
    told = float(text(path).split('rights the boat up to ')[1].split()[0])
    heel, arm = np.array(result['gz_heel_deg']), np.array(result['gz_m'])
    last = np.flatnonzero(arm[1:] <= 0.0)[0] + 1
    assert heel[last - 1] <= told <= heel[last]


# Bad input.

@pytest.mark.parametrize('arguments, words', [
    ([], ['SCENE']),
    (['no_such_file.yaml'], ['no_such_file.yaml']),
    ([str(ROOT)], [str(ROOT)]),
    (['a.yaml', '--jsn'], ['--jsn'])])
def test_wrong_arguments_get_one_line_and_exit_code_2(arguments, words, capsys):
    line = refused(arguments, capsys)
    assert all(word in line for word in words)


@pytest.mark.parametrize('lines, words', [
    (['boat.mass: 0.0'], ['boat.mass', 'got 0']),
    (['boat.mas: 10.0'], ['boat.mas']),
    (['hull.size: [1.0, 2.0, 1.0'], ['scene.yaml'])])
def test_wrong_parameters_get_one_line_and_exit_code_2(lines, words, scene, capsys):
    line = refused([scene(*lines)], capsys)
    assert all(word in line for word in words)


def test_substeps_that_break_the_limit_are_refused(scene, capsys):
    line = refused([scene(*FOUR_PROBES, 'probes.stiffness: 100000.0', 'substeps: 1')], capsys)
    assert 'substeps' in line


@pytest.mark.parametrize('error, line', [
    (PermissionError(13, 'Permission denied', '/a/b.csv'), '/a/b.csv: Permission denied'),
    (OSError('no space'), 'no space'),
    (ValueError('boat.mass:\n  wrong'), 'boat.mass: wrong'),
    (SimulationError('step 3 left what numbers can hold'), 'step 3 left what numbers can hold')])
def test_every_program_says_errors_in_one_line(error, line, capsys):
    def work():
        raise error

    assert command_line.run('buoyancy_test', work) == 2
    assert capsys.readouterr().err == f'buoyancy_test: {line}\n'


def test_a_fault_of_the_program_is_not_hidden_as_one_of_the_user():
    def work():
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        command_line.run('buoyancy_test', work)


def program(*arguments, **options):
    """Return the report as a process of its own."""
    return subprocess.Popen(
        [sys.executable, '-m', 'boat_buoyancy.tools.report', *arguments], cwd=ROOT,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)


def test_the_program_prints_the_report_and_leaves_with_0(scene):
    with program(scene(*SMALL_BARGE), '--json') as process:
        out, err = process.communicate(timeout=60)
    assert process.returncode == 0 and err == ''
    assert list(json.loads(out)) == KEYS


@pytest.mark.parametrize('turned_off', ['0', '1'])
def test_it_says_how_the_step_runs_without_loading_numba(turned_off, scene):
    code = ('import sys; from boat_buoyancy.tools.report import main; main(sys.argv[1:]); '
            'print("loaded" if "numba" in sys.modules else "not loaded")')
    said = subprocess.run(
        [sys.executable, '-c', code, scene(*SMALL_BARGE)], cwd=ROOT, text=True, check=True,
        capture_output=True, env={**os.environ, 'NUMBA_DISABLE_JIT': turned_off}).stdout
    # As the step itself finds out.
    code = 'from boat_buoyancy.physics.compiled import kind; print(kind(), end="")'
    kind = subprocess.run(
        [sys.executable, '-c', code], cwd=ROOT, text=True, check=True, capture_output=True,
        env={**os.environ, 'NUMBA_DISABLE_JIT': turned_off}).stdout
    assert f'\n  the step is {kind}' in said and said.endswith('\nnot loaded\n')
    if turned_off == '1':
        assert kind == 'plain Python'


def test_the_program_refuses_with_2(scene):
    with program(scene('boat.mass: -1.0')) as process:
        out, err = process.communicate(timeout=60)
    assert process.returncode == 2 and out == '' and err.count('\n') == 1


def test_a_reader_that_leaves_early_is_no_error(scene):
    with program(scene(*SMALL_BARGE)) as process:
        process.stdout.close()
        err = process.stderr.read()
        assert process.wait(timeout=60) == 0
    assert err == ''
