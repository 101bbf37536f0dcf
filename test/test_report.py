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
import json
import os
from pathlib import Path
import subprocess
import sys

from boat_buoyancy.physics import load_scene, SimulationError
from boat_buoyancy.physics.hydrostatics import rest
from boat_buoyancy.tools import command_line
from boat_buoyancy.tools.report import exact_heel_degrees, main
from boat_buoyancy.tools.report import text as as_text
import numpy as np
import programs
import pytest

ROOT = Path(__file__).parents[1]
SCENES = sorted(path for path in (ROOT / 'config').glob('*.yaml'))
# What a boat that sinks, or finds no rest, has not.
AT_REST = [
    'draft_m', 'rest_roll_deg', 'rest_pitch_deg', 'wetted_surface_m2', 'gm_transverse_m',
    'gm_longitudinal_m', 'heave_period_s', 'roll_period_s', 'pitch_period_s',
    'heave_damping_ratio', 'roll_damping_ratio', 'pitch_damping_ratio', 'model_error']
KEYS = [
    'draft_m', 'rest_roll_deg', 'rest_pitch_deg', 'floatiness', 'displacement_kg',
    'displaced_volume_m3', 'wetted_surface_m2', 'gm_transverse_m', 'gm_longitudinal_m',
    'heave_period_s', 'roll_period_s', 'pitch_period_s', 'heave_damping_ratio',
    'roll_damping_ratio', 'pitch_damping_ratio', 'heave_period_without_added_mass_s',
    'roll_period_without_added_mass_s', 'pitch_period_without_added_mass_s', 'handling',
    'max_stable_step_s', 'substeps', 'sea',
    'warnings', 'gz_heel_deg', 'gz_m', 'gz_exact_m', 'gz_exact_to_deg', 'model_error', 'step']
SEA_KEYS = ['significant_height_m', 'steepness', 'shortest_wave_m', 'shortest_wave_s',
            'longest_wave_m', 'longest_wave_s', 'meets']
ERROR_KEYS = ['draft_m', 'gm_transverse_m', 'gm_longitudinal_m', 'gz_greatest_m',
              'gz_greatest_at_deg', 'gz_rms_to_30_deg_m']
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
        # Of a hull of many panels the step is compiled, once on a machine.
        assert err.getvalue() == '' or 'compiling the step' in err.getvalue()
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
    nested = ('handling', 'max_stable_step_s', 'sea', 'warnings', 'gz_heel_deg', 'model_error',
              'step')
    numbers = [result[key] for key in KEYS if key not in (*nested, 'gz_m', 'gz_exact_m')]
    for value in [*numbers, *result['max_stable_step_s'].values(), *result['gz_m'],
                  *(result['handling'] or {}).values(),
                  *(result['gz_exact_m'] or [])]:
        assert value is None or is_number(value)
    of_hull = load_scene(path).boat.hull.surface is not None
    assert all((result[key] is not None) == of_hull for key in (
        'displaced_volume_m3', 'wetted_surface_m2', 'gz_exact_m', 'model_error'))
    assert not of_hull or list(result['model_error']) == ERROR_KEYS
    assert result['sea'] is None or list(result['sea']) == SEA_KEYS
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
    assert result['gz_exact_m'][2] == pytest.approx(result['gz_m'][2], rel=1e-12)
    assert (result['rest_roll_deg'], result['rest_pitch_deg']) == (0.0, 0.0)
    assert result['displaced_volume_m3'] == pytest.approx(2.0, rel=1e-14)
    assert result['wetted_surface_m2'] == pytest.approx(8.0 + 12.0 * 0.25, rel=1e-12)
    assert result['sea'] is None


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
                  [*SMALL_BARGE, 'probes.law: soft'], FOUR_PROBES,
                  # One column along has no waterplane to trim with.
                  [*SMALL_BARGE, 'hull.probes: [1, 2]',
                   'boat.center_of_mass: [0.05, 0.0, 0.0]']):
        assert exact_heel_degrees(load_scene(scene(*lines))) is None


def test_a_boat_that_sinks_has_no_draft_no_periods_and_no_righting_arm(scene):
    path = scene('boat.mass: 9000.0')
    result = report(path)
    for key in [*AT_REST, 'gz_exact_to_deg']:
        assert result[key] is None
    assert result['gz_m'] == result['gz_exact_m'] == [None] * 37
    assert result['displaced_volume_m3'] == pytest.approx(8.0, rel=1e-12)
    assert result['displacement_kg'] == pytest.approx(8200.0, rel=1e-12)
    assert result['warnings'][0].startswith('The boat sinks: its floatiness is 0.911111')
    shown = text(path)
    assert 'none: the boat sinks' in shown and '- The boat sinks' in shown
    assert '\nNo rest in still water\n' in shown


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
    drag = 'damping.linear: [100.0, 100.0, 500.0, 300.0, 900.0, 800.0]'
    assert not any('counts twice' in sentence for sentence in report(scene(drag))['warnings'])
    twice = report(scene(drag, 'damping.angular_retention: [0.9]'))['warnings']
    assert any('counts twice in roll, pitch, yaw' in sentence for sentence in twice)


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
    result, shown = report(path), {'heel': [], 'GZ': [], 'hull': []}
    for line in text(path).splitlines():
        name, *values = line.split() or ['']
        if name in shown and line.startswith('  ') and len(values) in (7, 10):
            shown[name] += map(float, values)
    assert shown['heel'] == result['gz_heel_deg']
    np.testing.assert_allclose(shown['GZ'], result['gz_m'], atol=5.1e-4)
    np.testing.assert_allclose(shown['hull'], result['gz_exact_m'], atol=5.1e-4)


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


# Lists and trims.

OFF_CENTRE = ['hull.size: [20.0, 6.0, 3.0]', 'boat.mass: 184500.0']


def test_a_boat_with_a_list_is_told_of_by_side_and_counts_from_there(scene):
    said = {}
    for x, y in ((0.8, 0.25), (0.8, -0.25), (-0.8, 0.25)):
        path = scene(*OFF_CENTRE, f'boat.center_of_mass: [{x}, {y}, 0.3]')
        said[x, y] = report(path), text(path)
    (result, shown), (across, shown_across), (along, shown_along) = said.values()
    # As computed before by minimising energy, to the digit given.
    assert result['rest_roll_deg'] == pytest.approx(-13.7, abs=0.05)
    assert result['draft_m'] == pytest.approx(2.53, abs=0.005)
    assert ('At rest in still water: list 13.7 degrees to port, trim 2.1 degrees by the bow\n'
            in shown)
    assert 'list 13.7 degrees to starboard, trim 2.1 degrees by the bow' in shown_across
    assert 'list 13.7 degrees to port, trim 2.1 degrees by the stern' in shown_along
    for other in (across, along):
        for key in ('draft_m', 'wetted_surface_m2', 'gm_transverse_m', 'gm_longitudinal_m',
                    'roll_period_s', 'gz_exact_to_deg'):
            assert other[key] == pytest.approx(result[key], rel=1e-9), key
    np.testing.assert_allclose(along['gz_m'], result['gz_m'], atol=1e-9)
    # Of all sides of the mean draft 1.5 m is wet.
    assert result['wetted_surface_m2'] == pytest.approx(120.0 + 52.0 * 1.5, rel=1e-9)

    def ends(shown):
        words = ' '.join(shown.split()).split('brings the boat back to its list from ')[1].split()
        return words[0], words[3], words[6], words[9].rstrip('.')

    port, to_port, starboard, to_starboard = ends(shown)
    assert (to_port, to_starboard) == ('port', 'starboard')
    # A mirrored boat comes back from as far on the other side.
    assert ends(shown_across) == (starboard, 'port', port, 'starboard')
    heel, arm = np.array(result['gz_heel_deg']), np.array(result['gz_m'])
    lost = np.flatnonzero(arm <= 0.0)[0]
    assert heel[lost - 1] <= float(starboard) <= heel[lost]


def test_the_exact_range_of_a_trimmed_box_ends_where_its_arms_part(scene):
    result = report(scene(*OFF_CENTRE, 'boat.center_of_mass: [0.8, 0.25, 0.3]'))
    off = np.abs(np.subtract(result['gz_m'], result['gz_exact_m']))
    exact = np.array(result['gz_heel_deg']) <= result['gz_exact_to_deg']
    assert 15.0 < result['gz_exact_to_deg'] < 25.0
    assert off[exact].max() < 1e-12 < 1e-3 < off[~exact][0]


def test_a_self_righting_boat_is_righted_from_any_heel(scene):
    shown = text(scene(*SMALL_BARGE, 'boat.center_of_mass: [0.0, 0.0, -2.0]',
                       'hull.model: panels'))
    assert 'rights the boat from any heel.' in shown


def test_a_boat_that_finds_no_rest_has_nothing_that_is_said_of_one(scene, monkeypatch):
    # No boat is known that finds none, so the search is cut short.
    monkeypatch.setattr(rest, 'MAX_TURNS', 1)
    path = scene(*OFF_CENTRE, 'boat.center_of_mass: [0.7, 0.25, 0.3]')
    result, shown = report(path), text(path)
    assert all(result[key] is None for key in AT_REST)
    assert '\nNo rest in still water\n' in shown and 'The boat finds no rest' in shown


# The model and the hull itself.

def test_panels_have_the_righting_arms_of_the_surface_at_any_heel(scene):
    path = scene('hull.model: panels')
    result, columns = report(path), report(scene('boat.mass: 2000.0'))
    np.testing.assert_allclose(result['gz_m'], result['gz_exact_m'], atol=1e-12)
    assert result['gz_exact_m'] == columns['gz_exact_m']
    assert result['gz_exact_to_deg'] == 180.0 and result['warnings'] == []
    assert max(abs(result['model_error'][key]) for key in ERROR_KEYS
               if key != 'gz_greatest_at_deg') < 1e-12
    shown = text(scene('hull.model: panels'))
    assert 'box on 12 panels of at most 4.5 m; depths at 4 probes' in shown
    assert "Exactly that of the hull's surface, at any heel." in shown
    assert 'rights the boat up to 90 degrees' in shown


def test_finer_panels_than_still_water_needs_change_nothing_of_the_report(scene):
    fine, coarse = (report(scene('hull.model: panels', *more))
                    for more in (['hull.panel_size: 1.5'], []))
    for key in ('draft_m', 'gm_transverse_m', 'roll_period_s', 'gz_m', 'wetted_surface_m2'):
        assert fine[key] == pytest.approx(coarse[key], rel=1e-9, abs=1e-12), key


def test_where_columns_part_from_the_hull_a_warning_names_the_heel_and_the_cure(scene):
    result = report(scene('boat.mass: 2000.0'))
    arms, exact = np.array(result['gz_m']), np.array(result['gz_exact_m'])
    # As measured on the default box by exact clipping.
    heel = result['gz_heel_deg'].index
    assert arms[heel(25.0)] == pytest.approx(0.415, abs=5e-4)
    assert exact[heel(25.0)] == pytest.approx(0.353, abs=5e-4)
    assert exact[heel(45.0)] == pytest.approx(0.354, abs=5e-4)
    sentence, = result['warnings']
    off = np.abs(arms - exact)
    assert sentence.startswith('From 20 degrees of heel on the columns do not follow the hull')
    assert 'would let it rest between 90 and 95 degrees, where the hull does not' in sentence
    assert 'hull.model: panels' in sentence and f'{off.max():.3f} m off' in sentence
    error = result['model_error']
    assert error['gz_greatest_m'] == off.max()
    assert error['gz_greatest_at_deg'] == 90.0
    assert error['gz_rms_to_30_deg_m'] == pytest.approx(np.sqrt(np.mean(off[:7] ** 2)))
    assert abs(error['draft_m']) < 1e-12 and abs(error['gm_transverse_m']) < 1e-9


def test_springs_on_a_box_miss_its_gm_by_what_is_known(scene):
    # They push at the bottom, not at half the draft: GM lacks KB.
    result = report(scene(*SMALL_BARGE, 'probes.law: spring'))
    assert result['model_error']['gm_transverse_m'] == pytest.approx(-0.125, rel=1e-9)
    assert result['model_error']['draft_m'] == pytest.approx(0.0, abs=1e-12)


def test_probes_have_no_hull_to_be_compared_with(scene):
    path = scene(*FOUR_PROBES)
    result = report(path)
    for key in ('displaced_volume_m3', 'wetted_surface_m2', 'gz_exact_m', 'gz_exact_to_deg',
                'model_error'):
        assert result[key] is None
    shown = text(path)
    assert '4 probes, law spring' in shown and 'depth of the deepest probe' in shown
    assert 'hull itself' not in shown and 'wetted' not in shown


@pytest.mark.parametrize('lines, words', [
    ([], 'box on 4 columns'), (['probes.law: soft'], 'box on 4 probes, law soft'),
    (['hull.shape: twin', 'hull.spacing: 3.0'], 'twin on 8 columns')])
def test_the_model_in_force_is_named_with_its_size(lines, words, scene):
    assert text(scene(*lines, 'boat.mass: 2000.0')).splitlines()[0].endswith(f'kg, {words}')


# The sea.

def test_the_sea_is_given_by_its_height_and_its_ends(scene):
    path = scene('sea.waves: [0.3, 6.0, 0.0, 0.0, 0.4, 4.0, 1.0, 0.0, 0.01, 1.0, 2.0, 0.0]')
    sea = report(path)['sea']
    assert sea['significant_height_m'] == pytest.approx(
        4 * np.sqrt((0.3**2 + 0.4**2 + 0.01**2) / 2))
    # The third has less than a hundredth of the energy.
    assert (sea['shortest_wave_s'], sea['longest_wave_s']) == (4.0, 6.0)
    assert sea['shortest_wave_m'] == pytest.approx(24.981, abs=1e-3)
    assert sea['longest_wave_m'] == pytest.approx(9.81 * 36.0 / (2 * np.pi))
    assert sea['meets'] == []
    shown = text(path)
    assert 'significant height 1.41 m, steepness 1/' in shown
    assert 'No natural period meets them.' in shown


@pytest.mark.parametrize('small, period, meets', [
    # Heave of this barge takes 1.003 s: within 20 %, and with a tenth of the energy or not.
    (0.34, 1.19, ['heave']), (0.34, 1.21, []), (0.34, 0.81, ['heave']), (0.32, 1.19, [])])
def test_a_natural_period_meets_the_sea_where_much_of_its_energy_is_near(
        small, period, meets, scene):
    heavy = ['boat.inertia: [50000.0, 50000.0, 90000.0]']
    result = report(scene(*SMALL_BARGE, *heavy,
                          f'sea.waves: [{small}, {period}, 0.0, 0.0, 1.0, 30.0, 0.0, 0.0]'))
    assert result['heave_period_s'] == pytest.approx(1.003, abs=1e-3)
    assert result['sea']['meets'] == meets


def test_a_wave_that_meets_a_period_is_told_of_once_when_it_is_the_only_one(scene):
    shown = text(scene(*SMALL_BARGE, 'sea.waves: [0.01, 1.05, 0.0, 0.0]'))
    assert 'the waves that matter are 1.72 m (1.05 s) long' in shown
    assert 'They meet the natural period of heave (1 s)' in shown


def test_a_boat_adrift_meets_a_wave_at_the_period_of_the_water_that_it_drifts_with(scene):
    # (w - k)^2 = g k: 1.19 s at a fixed point, on 1 m/s with it, are 1.62 s in the water.
    for current, meets in (('[0.0, 0.0]', ['heave']), ('[1.0, 0.0]', [])):
        assert report(scene(*SMALL_BARGE, 'boat.inertia: [50000.0, 50000.0, 90000.0]',
                            'sea.waves: [0.01, 1.19, 0.0, 0.0]',
                            f'sea.current: {current}'))['sea']['meets'] == meets


def test_the_steepness_of_a_sea_is_said_as_a_part_of_one(scene):
    # A fully grown sea of any state: 2 pi 0.21 (0.879 / (2 pi 0.778))^2, 0.778 = Tz / Tp.
    path = scene('sea.sea_state: 4')
    assert report(path)['sea']['steepness'] == pytest.approx(1 / 23.4, rel=3e-3)
    assert 'significant height 1.88 m, steepness 1/23; the waves' in text(path)
    assert 'steepness 1/62; the waves' in text(scene('sea.waves: [0.2, 4.0, 0.0, 0.0]'))


# The picture.

def test_the_righting_arms_are_drawn_where_asked(scene, tmp_path, capsys):
    for number, lines in enumerate((
            SMALL_BARGE, FOUR_PROBES, [*SMALL_BARGE, 'hull.model: panels',
                                       'boat.center_of_mass: [0.0, 0.1, 0.0]'])):
        path = tmp_path / f'gz{number}.png'
        assert main([scene(*lines), '--plot', str(path)]) == 0
        assert path.read_bytes().startswith(b'\x89PNG') and path.stat().st_size > 10_000
        assert capsys.readouterr().out.endswith(f'\nwrote {path}\n')
    assert main([scene(*SMALL_BARGE), '--json', '--plot', str(path)]) == 0
    assert list(json.loads(capsys.readouterr().out)) == KEYS


@pytest.mark.parametrize('lines, heels, before', [
    (SMALL_BARGE, (0.0, 180.0), 'rights the boat up to '),
    ([*SMALL_BARGE, 'boat.center_of_mass: [0.0, 0.1, 0.0]'], (-180.0, 180.0), 'to port up to ')])
def test_the_picture_shows_the_arms_of_model_and_hull(lines, heels, before, scene, monkeypatch):
    from boat_buoyancy.tools import righting_arm_plot
    drawn = []
    monkeypatch.setattr(righting_arm_plot, 'save', lambda made, path: drawn.append(made))
    path = scene(*lines)
    righting_arm_plot.draw('unused.png', load_scene(path).boat, 'scene')
    axes, = drawn[0].axes
    result = report(path)
    curves = {line.get_label(): line.get_xydata() for line in axes.get_lines()}
    assert axes.get_xlim() == heels
    for label, key in (('as simulated (columns)', 'gz_m'), ('the hull itself', 'gz_exact_m')):
        x, y = curves[label].T
        np.testing.assert_allclose(np.interp(result['gz_heel_deg'], x, y), result[key], atol=1e-9)
    mark = next(data for label, data in curves.items() if label.startswith('rests here'))
    np.testing.assert_allclose(mark, [[result['rest_roll_deg'], 0.0]], atol=1e-12)
    shaded, = axes.patches
    low, high = shaded.get_extents().transformed(axes.transData.inverted()).intervalx
    assert low - 1e-9 <= result['rest_roll_deg'] < high
    told = ' '.join(text(path).split()).split(before)[1].split()[0]
    assert axes.get_title(loc='left').endswith(f' to {told} degrees of heel')
    assert high == pytest.approx(float(told), abs=0.5)


def test_a_boat_that_sinks_has_no_picture(scene, tmp_path, capsys):
    line = refused([scene('boat.mass: 9000.0'), '--plot', str(tmp_path / 'gz.png')], capsys)
    assert '--plot' in line and 'sinks' in line and not (tmp_path / 'gz.png').exists()


@pytest.mark.parametrize('name, words', [
    ('gz.jpg', "--plot: expected a file name that ends in .png, got '"),
    ('no/such/gz.png', 'No such file or directory')])
def test_a_picture_that_cannot_be_written_is_refused(name, words, scene, tmp_path, capsys):
    assert words in refused([scene(*SMALL_BARGE), '--plot', str(tmp_path / name)], capsys)


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
