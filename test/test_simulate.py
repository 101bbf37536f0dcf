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

from io import StringIO
import math
import os
from pathlib import Path
import re
import signal
import subprocess
import sys

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.boat.state import body_frame, center_of_mass_state
from boat_buoyancy.physics.rotation import to_roll_pitch_yaw
from boat_buoyancy.physics.stepping.simulation import periods_of, Simulation
from boat_buoyancy.tools import (animate, compare, hull_outline, plot, progress, simulate,
                                 simulate_text)
from boats import turned
import numpy as np
from PIL import Image
import programs
import pytest

CONFIG = Path(__file__).parents[1] / 'config'
BARGE, DEFAULT = str(CONFIG / 'barge.yaml'), str(CONFIG / 'default.yaml')
WAVES = {'sea.waves': [0.3, 4.0, 0.6, 0.0, 0.15, 2.7, -0.5, 1.0],
         'boat.center_of_mass': [0.1, 0.05, -0.1], 'start.orientation': [0.1, -0.05, 0.4]}
PARAMETERS = '/**:\n  ros__parameters:\n'


def scene_file(path, values):
    path.write_text(PARAMETERS + ''.join(f'    {name}: {value}\n'
                                         for name, value in values.items()))
    return str(path)


@pytest.fixture
def wavy(tmp_path):
    return scene_file(tmp_path / 'wavy.yaml', WAVES)


def table(path):
    names, *rows = path.read_text().splitlines()
    return names.split(','), np.array([[float(word) for word in row.split(',')] for row in rows])


def refused(capsys, *words):
    return programs.refused(simulate.main, 'buoyancy_simulate', words, capsys)


def test_table_holds_the_body_frame_and_the_depths_of_every_period(wavy, tmp_path):
    thrust = [300.0, -20.0, 0.0, 0.0, 10.0, 1e2]
    assert simulate.main([wavy, '--duration', '0.5', '--csv', str(tmp_path / 'a.csv'), '--rate',
                          '50', '--thrust', *map(str, thrust)]) == 0
    names, rows = table(tmp_path / 'a.csv')
    assert names == ['time', 'x', 'y', 'z', 'qx', 'qy', 'qz', 'qw', 'vx', 'vy', 'vz', 'wx', 'wy',
                     'wz', 'depth_0', 'depth_1', 'depth_2', 'depth_3', 'roll', 'pitch', 'yaw',
                     'elevation']
    assert rows.shape == (26, 22)
    scene = load_scene(wavy)
    simulation = scene.simulation(rate=50.0)
    for row in rows:
        # Bitwise: every number is written with all its digits.
        pose = body_frame(scene.boat, simulation.state)
        expected = np.concatenate([[simulation.time], *pose, simulation.probe_depths])
        assert row[:18].tolist() == expected.tolist()
        assert row[18:21] == pytest.approx(to_roll_pitch_yaw(pose[1]), abs=1e-14)
        assert row[21] == pytest.approx(scene.sea.elevation(*pose[0][:2], simulation.time),
                                        abs=1e-14)
        simulation.step(thrust)


@pytest.mark.parametrize('every', [1, 7, 25, 26, 1000])
def test_every_nth_row_of_the_table_are_those_of_the_whole_table(wavy, tmp_path, every):
    words = [wavy, '--duration', '0.25', '--csv']
    assert simulate.main([*words, str(tmp_path / 'all.csv')]) == 0
    assert simulate.main([*words, str(tmp_path / 'some.csv'), '--every', str(every)]) == 0
    head, *rows = (tmp_path / 'all.csv').read_text().splitlines()
    assert len(rows) == 26
    assert (tmp_path / 'some.csv').read_text().splitlines() == [head, *rows[::every]]


def test_twist_is_in_body_axes_at_ninety_degrees_of_yaw(tmp_path):
    scene = scene_file(tmp_path / 'east.yaml', {
        'start.orientation': [0.0, 0.0, math.pi / 2], 'damping.linear_retention': [1.0],
        'damping.probe': 0.0})
    assert simulate.main([scene, '--duration', '1', '--csv', str(tmp_path / 'a.csv'),
                          '--thrust', '2000', '0', '0', '0', '0', '0']) == 0
    names, rows = table(tmp_path / 'a.csv')
    last = dict(zip(names, rows[-1]))
    # 2000 N on 2000 kg for a second: 1 m/s ahead, which is north.
    assert last['vx'] == pytest.approx(1.0, abs=1e-3) and abs(last['vy']) < 1e-9
    assert last['y'] == pytest.approx(0.5, abs=1e-3) and abs(last['x']) < 1e-9


def test_body_frame_is_not_the_centre_of_mass():
    scene = load_scene(WAVES)
    simulation = scene.simulation()
    run = simulation.run(0.3)
    state = center_of_mass_state(scene.boat, run.position[-1], run.orientation[-1],
                                 run.body_velocity[-1], run.angular_velocity[-1])
    assert state.position == pytest.approx(simulation.state.position, abs=1e-12)
    assert state.velocity == pytest.approx(simulation.state.velocity, abs=1e-12)
    assert np.linalg.norm(state.position - run.position[-1]) == pytest.approx(0.15)


@pytest.mark.parametrize(('duration', 'rate', 'periods'), [
    (0.3, 10.0, 3), (0.31, 10.0, 4), (1e-9, 10.0, 1), (20.0, 100.0, 2000), (0.7, 1000.0, 700),
    (86400.0, 100.0, 8640000), (1.0, 3.0, 3)])
def test_periods_cover_the_duration(duration, rate, periods):
    assert periods_of(duration, rate) == periods


def test_summary_says_what_was_run_and_how_it_ended(capsys):
    assert simulate.main([BARGE, '--duration', '2', '--integrator', 'rk4', '--rate', '20',
                          '--substeps', '3', '--thrust', '-1e3', '0', '0', '0', '0', '0']) == 0
    out, err = capsys.readouterr()
    # The step is compiled once on a machine.
    assert err == '' or 'compiling the step' in err
    assert f'{BARGE}: 2 s at 20 Hz, rk4, 3 steps per period\n' in out
    assert 'thrust   -1000 0 0 N, 0 0 0 N m, body axes\n' in out
    # 20 x 6 x 3 m, half of it under water.
    deepest = float(re.search(r'probes +[\d.]+ to ([\d.]+) m under water', out)[1])
    assert deepest == pytest.approx(1.5, abs=1e-3)
    assert 'boat     184500 kg on 16 columns, law column; flat water' in out
    assert re.search(r'attitude roll .*, pitch .*, yaw .* deg\n', out)
    assert re.search(r'120 steps in [\d.e-]+ s: [\d.e+]+ steps/s, [\d.e+]+ times real time', out)


def test_thrusters_push_by_name_and_add_up_with_thrust(capsys):
    wam_v = str(CONFIG / 'wam_v.yaml')
    assert simulate.main([wam_v, '--duration', '60', '--thruster', 'left=150', '--thruster',
                          'right=150', '--thrust', '200', '0', '0', '0', '0', '0']) == 0
    out = capsys.readouterr().out
    assert 'thruster left=150, right=150 N\n' in out and 'speed 1.5226 m/s' in out
    for word, said in (('left', "--thruster: expected NAME=N, as left=250, got 'left'"),
                       ('left=full', "--thruster: expected NAME=N, as left=250, got 'left=full'"),
                       ('left=nan', 'thruster left: expected a finite number, got nan'),
                       ('bow=1', "thruster: expected one of left, right, got 'bow'")):
        assert said in refused(capsys, wam_v, '--duration', '1', '--thruster', word)
    assert 'left is given twice' in refused(
        capsys, wam_v, '--duration', '1', '--thruster', 'left=1', '--thruster', 'left=2')


def test_warnings_of_the_scene_are_in_the_summary(tmp_path, capsys):
    scene = scene_file(tmp_path / 'stone.yaml', {
        'probes.positions': [0.5, 0.5, 0.0, 0.5, -0.5, 0.0, -0.5, 0.0, 0.0],
        'probes.floatiness': 0.5})
    assert simulate.main([scene, '--duration', '0.1']) == 0
    warnings = load_scene(scene).simulation().warnings
    out = capsys.readouterr().out
    assert warnings and all(f'warning: {sentence}\n' in out for sentence in warnings)


@pytest.mark.parametrize('ending, begins', [
    ('.png', b'\x89PNG'), ('.pdf', b'%PDF'), ('.svg', b'<?xml')])
def test_plot_is_drawn_as_what_its_name_says(wavy, tmp_path, ending, begins):
    assert ending in plot.ENDINGS
    path = tmp_path / f'motion{ending}'
    assert simulate.main([wavy, '--duration', '1', '--plot', str(path)]) == 0
    assert path.read_bytes().startswith(begins)


def plotted(values, duration=1.0):
    from matplotlib.figure import Figure
    return load_scene(values).simulation().run(duration), Figure().subplots(5, 1)


def test_plot_shows_the_run_with_units_on_every_axis():
    run, (heave, tilt, speed, heading, depth) = plotted(WAVES)
    plot.draw_heave(heave, run)
    plot.draw_tilt(tilt, run)
    plot.draw_speed(speed, run)
    plot.draw_heading(heading, run)
    plot.draw_depths(depth, run)
    assert [axes.get_ylabel() for axes in (heave, tilt, speed, heading, depth)] == [
        'height (m)', 'angle (deg)', 'speed (m/s)', 'heading (deg)',
        'probe depth (m)\nunder water']
    ahead, to_port = speed.get_lines()
    assert np.array_equal(ahead.get_ydata(), run.body_velocity[:, 0])
    assert np.array_equal(to_port.get_ydata(), run.body_velocity[:, 1])
    assert np.radians(heading.get_lines()[0].get_ydata()[0]) == pytest.approx(0.4, abs=1e-12)
    surface, origin = heave.get_lines()
    assert np.array_equal(origin.get_ydata(), run.position[:, 2])
    sea = load_scene(WAVES).sea
    expected = [sea.elevation(x, y, t) for (x, y, _), t in zip(run.position, run.time)]
    assert surface.get_ydata() == pytest.approx(expected, abs=1e-12)
    roll, pitch = tilt.get_lines()
    assert np.radians(roll.get_ydata()[0]) == pytest.approx(0.1, abs=1e-12)
    assert np.radians(pitch.get_ydata()[0]) == pytest.approx(-0.05, abs=1e-12)
    lines = depth.get_lines()
    assert [line.get_label() for line in lines] == [
        'water surface', 'probe 0', 'probe 1', 'probe 2', 'probe 3']
    for i, line in enumerate(lines[1:]):
        assert np.array_equal(line.get_ydata(), run.probe_depths[:, i])
    # Deeper is further down, and nothing is cut off.
    bottom, top = depth.get_ylim()
    assert bottom > run.probe_depths.max() and top < min(run.probe_depths.min(), 0.0)


def test_many_probes_are_drawn_as_their_spread():
    run, (*_, depth) = plotted({'hull.probes': [4, 3]}, 0.1)
    plot.draw_depths(depth, run)
    assert len(depth.get_lines()) == 2
    assert depth.get_legend_handles_labels()[1] == [
        'water surface', 'all 12 probes', 'their mean']


def test_no_probe_has_the_colour_of_the_water():
    assert plot.WATER not in plot.COLOURS and len(set(plot.COLOURS)) == len(plot.COLOURS)


def test_swings_that_would_run_into_each_other_are_drawn_as_their_band():
    _, (axes, *_) = plotted({}, 0.01)
    time = np.arange(360_001) / 100.0
    # An hour of swings of 4 s about a slow drift: 900 of them on some 600 pixels.
    drift = 0.1 * time / 3600.0
    plot.draw_line(axes, time, np.cos(np.pi * time / 2) + drift, color='k', label='swings')
    (low, high), (band,) = axes.get_lines(), axes.collections
    assert low.get_label() == 'swings' and band.get_alpha() < 0.5
    for edge, expected in ((low, -1.0), (high, 1.0)):
        assert edge.get_xdata()[[0, -1]].tolist() == [0.0, 3600.0]
        assert len(edge.get_xdata()) <= plot.COLUMNS
        # The tops are hit to 1 - cos(pi / 400); a column drifts by 0.1 / 450.
        assert edge.get_ydata() - drift[np.searchsorted(time, edge.get_xdata())] == (
            pytest.approx(expected, abs=5e-4))


def test_what_changes_slowly_stays_a_line_however_long_the_run():
    _, (axes, *_) = plotted({}, 0.01)
    time = np.arange(360_001) / 100.0
    plot.draw_line(axes, time, np.cos(time / 60.0), color='k', label='slow')
    line, = axes.get_lines()
    assert len(line.get_xdata()) == len(time) and not axes.collections


def test_heading_goes_on_after_a_turn_all_the_way_round():
    run, (axes, *_) = plotted({'start.angular_velocity': [0.0, 0.0, 3.0],
                               'damping.angular_retention': [1.0], 'damping.probe': 0.0}, 4.0)
    plot.draw_heading(axes, run)
    assert axes.get_lines()[0].get_ydata()[-1] == pytest.approx(math.degrees(12.0), rel=0.01)


@pytest.mark.parametrize('words, said', [
    ([], 'no thrust'),
    (['--thrust', '300', '0', '0', '0', '0', '60'], 'thrust 300 0 0 N, 0 0 60 N m, body axes'),
    (['--thruster', 'left=150', '--thruster', 'right=0'], 'thruster left=150, right=0 N')])
def test_title_names_scene_and_thrust(words, said):
    wam_v = str(CONFIG / 'wam_v.yaml')
    arguments = simulate.parser().parse_args([wam_v, '--duration', '1', *words])
    assert simulate_text.title(arguments, wam_v, load_scene(wam_v).simulation()) == (
        f'wam_v.yaml: 180 kg, leapfrog at 100 Hz\n{said}')


STEPS = sorted(map(str, CONFIG.glob('v*.yaml')))
SAME = ['--duration', '4', '--waves', '0.25', '4', '0.8', '0', '--thrust', '500', *'00000']


def test_scenes_are_compared_under_the_same_push_in_the_same_sea(tmp_path, monkeypatch):
    seen = []
    monkeypatch.setattr(simulate.compare, 'write', lambda *given: seen.append(given))
    assert simulate.main([*STEPS, *SAME, '--compare', str(tmp_path / 'a.png')]) == 0
    (path, runs, title), = seen
    assert path == tmp_path / 'a.png' and list(runs) == STEPS and len(STEPS) == 5
    assert title == 'thrust 500 0 0 N, 0 0 0 N m, body axes; waves of amplitude 0.25 m every 4 s'
    for run in runs.values():
        assert run.sea.waves.tolist() == [[0.25, 4.0, 0.8, 0.0]]
    # Nothing holds or turns the first: 500 N on 1000 kg for 4 s.
    first = runs[STEPS[0]]
    assert first.body_velocity[-1, 0] == pytest.approx(2.0, abs=1e-9)
    assert compare.tilt(first).max() < 1e-3
    alone = load_scene(load_scene(STEPS[4]).given | {'sea.waves': [0.25, 4.0, 0.8, 0.0]})
    assert np.array_equal(runs[STEPS[4]].position,
                          alone.simulation().run(4.0, [500.0, *[0.0] * 5]).position)


def test_tilt_is_the_angle_of_the_mast_whatever_the_heading():
    run = load_scene({'start.orientation': [0.4, -0.3, 2.0]}).simulation().run(0.01)
    assert compare.tilt(run)[0] == pytest.approx(
        math.degrees(math.acos(math.cos(0.4) * math.cos(0.3))), abs=1e-9)
    over = load_scene({'start.orientation': [math.pi, 0.0, 0.0]}).simulation().run(0.01)
    assert compare.tilt(over)[0] == pytest.approx(180.0, abs=1e-5)


def test_the_picture_of_a_comparison_is_written(tmp_path, capsys):
    path = tmp_path / 'steps.png'
    assert simulate.main([*STEPS[:2], *SAME, '--compare', str(path)]) == 0
    assert path.read_bytes().startswith(b'\x89PNG')
    assert f'wrote    {path}\n' in capsys.readouterr().out


def test_waves_replace_the_sea_of_a_scene(tmp_path, capsys):
    scene = scene_file(tmp_path / 'rough.yaml', {'sea.sea_state': 4, 'sea.depth': 3.0})
    assert simulate.main([scene, '--duration', '0.1', '--waves', '0.1', '4', '0', '0']) == 0
    assert '; 1 wave, ' in capsys.readouterr().out
    assert simulate.scene_of(scene, [0.1, 4.0, 0.0, 0.0]).sea.depth == 3.0


@pytest.mark.parametrize('words, said', [
    ([DEFAULT, BARGE], 'expected one SCENE, got 2; to see several beside each other give '
     '--compare FILE.png'),
    ([DEFAULT, '--compare', 'a.png', '--csv', 'a.csv'], '--csv and --compare: expected one of'),
    ([DEFAULT, '--compare', 'a.gif'], '--compare: expected a file name that ends in .png'),
    ([DEFAULT, '--waves', '0.1', '4'], 'sea.waves: expected'),
    ([DEFAULT, DEFAULT, '--compare', 'a.png'], 'is given twice')])
def test_what_cannot_be_compared_is_one_line(words, said, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert said in refused(capsys, *words, '--duration', '1')


def test_animation_has_a_frame_every_eighty_milliseconds_in_real_time(wavy, tmp_path):
    path = tmp_path / 'boat.gif'
    assert simulate.main([wavy, '--duration', '0.4', '--animate', str(path)]) == 0
    with Image.open(path) as image:
        assert image.n_frames == 5 and image.info['duration'] == 80
        first = np.asarray(image.convert('RGB'), int)
        image.seek(4)
        assert (abs(np.asarray(image.convert('RGB'), int) - first).max(axis=2) > 50).sum() > 100
    # The largest animation stays small enough for a README.
    assert path.stat().st_size / 5 * animate.MAX_FRAMES < 3e6


def test_long_animations_are_played_faster():
    simulation = load_scene({}).simulation(rate=10.0)
    view = animate.view_of(simulation.run(60.0), simulation)
    assert len(view.rows) == animate.MAX_FRAMES
    assert view.pace == pytest.approx(60.0 / (0.08 * animate.MAX_FRAMES))
    assert view.rows[0] == 0 and np.ptp(np.diff(view.rows)) <= 1


def test_legend_of_an_animation_says_what_shades_dots_and_lines_mean():
    simulation = load_scene(WAVES).simulation()
    view = animate.view_of(simulation.run(0.1), simulation, [30.0, 40.0, 0.0, 0.0, 0.0, 9.0])
    handles = animate.legend_of(view)
    assert [handle.get_label() for handle in handles] == [
        'probe in the water', 'probe in the air', 'track', 'thrust 50 N', 'crest, +0.45 m',
        'trough, -0.45 m']
    # Light crests and dark troughs, in the very colours of the water.
    crest, trough = (handle.get_facecolor() for handle in handles[-2:])
    assert crest == tuple(view.shades[-1]) and trough == tuple(view.shades[0])
    assert sum(crest[:3]) > sum(trough[:3]) + 0.5
    flat = load_scene({}).simulation()
    assert [handle.get_label() for handle in animate.legend_of(
        animate.view_of(flat.run(0.1), flat))] == [
            'probe in the water', 'probe in the air', 'track']


@pytest.mark.parametrize('speed, stands', [(1.0, True), (10.0, False)])
def test_the_whole_track_is_shown_from_above_or_the_boat_is_followed(speed, stands):
    from matplotlib.figure import Figure
    simulation = load_scene({'start.velocity': [speed, 0.0, 0.0], 'damping.probe': 0.0,
                             'damping.linear_retention': [1.0]}).simulation()
    run, axes = simulation.run(10.0), Figure().subplots()
    view = animate.view_of(run, simulation)
    shown = []
    for row in (0, 1000):
        axes.clear()
        animate.draw_above(axes, run, view, row)
        west, east = axes.get_xlim()
        shown.append(west)
        # The hull is 4 m long.
        assert west + 2.0 < run.position[row, 0] < east - 2.0
    assert shown[1] - shown[0] == pytest.approx(0.0 if stands else run.position[-1, 0])


def test_thrust_is_drawn_as_it_turns_with_the_boat():
    from matplotlib.figure import Figure
    simulation = load_scene({'start.orientation': [0.0, 0.0, math.pi / 2]}).simulation()
    run, axes = simulation.run(0.1), Figure().subplots()
    view = animate.view_of(run, simulation, [500.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    animate.draw_above(axes, run, view, 0)
    arrow, = axes.texts
    # Ahead is north.
    assert np.subtract(arrow.xy, arrow.xyann) == pytest.approx(
        (0.0, animate.ARROW * view.size))


# Each is told to end when it shows that it is under way.
@pytest.mark.parametrize('duration, under_way, file', [
    ('9000', 'running: ', 'a.csv'), ('12', 'drawing: frame ', 'a.gif')])
def test_long_work_shows_how_far_it_is_and_ends_with_one_line_on_ctrl_c(
        tmp_path, duration, under_way, file):
    process = subprocess.Popen(
        [sys.executable, '-m', 'boat_buoyancy.tools.simulate', DEFAULT, '--duration', duration,
         '--csv' if file.endswith('.csv') else '--animate', str(tmp_path / file)],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
        env={**os.environ, 'NUMBA_DISABLE_JIT': '1'})
    with process:
        line = process.stderr.readline()
        while under_way not in line:
            assert line, 'it ended by itself'
            line = process.stderr.readline()
        process.send_signal(signal.SIGINT)
        assert process.stderr.read() == 'buoyancy_simulate: interrupted\n'
        assert process.wait() == 130
    assert list(tmp_path.iterdir()) == []


def test_an_interrupt_where_python_ignores_what_is_raised_ends_a_program_all_the_same():
    code = """if True:
        import sys, time
        from boat_buoyancy.tools.command_line import run

        class Dropped:
            def __del__(self):
                raise KeyboardInterrupt

        def work():
            Dropped()
            time.sleep(30.0)

        sys.exit(run('it', work))
    """
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True, timeout=20)
    assert (done.returncode, done.stderr) == (130, 'it: interrupted\n')


def test_progress_is_silent_at_first_and_then_on_one_line(monkeypatch):
    class Terminal(StringIO):

        def isatty(self):
            return True

    now, terminal = [0.0], Terminal()
    monkeypatch.setattr(progress, 'monotonic', lambda: now[0])
    shown = progress.Progress(terminal, after=2.0, every=0.1)
    for now[0] in (0.0, 1.9, 2.0, 2.05, 2.2):
        shown(f'at {now[0]}')
    assert terminal.getvalue() == '\rat 2.0\rat 2.2'
    shown.clear()
    assert terminal.getvalue().endswith('\r      \r')


def test_hull_of_a_box_is_drawn_as_that_box():
    for probes in ([2, 2], [4, 3]):
        corners, = hull_outline.hull_shells(load_scene({
            'hull.size': [5.0, 2.0, 0.8], 'hull.probes': probes, 'hull.bottom': -0.3}).boat)
        assert corners.min(axis=0) == pytest.approx((-2.5, -1.0, -0.3), abs=1e-12)
        assert corners.max(axis=0) == pytest.approx((2.5, 1.0, 0.5), abs=1e-12)


def test_each_hull_of_a_twin_is_drawn_by_itself():
    shells = hull_outline.hull_shells(load_scene({
        'hull.shape': 'twin', 'hull.size': [5.0, 0.5, 0.8], 'hull.spacing': 2.0}).boat)
    assert [corners[:, 1].min() for corners in shells] == pytest.approx([-1.25, 0.75])


def test_hull_of_probes_reaches_to_the_outermost():
    corners, = hull_outline.hull_shells(load_scene({
        'probes.positions': [1.0, 0.5, -0.1, -2.0, 0.0, 0.0, 1.0, -0.5, -0.1],
        'probes.stiffness': 4.0}).boat)
    assert corners.min(axis=0) == pytest.approx((-2.0, -0.5, -0.1))
    assert corners.max(axis=0) == pytest.approx((1.0, 0.5, 0.25))
    lonely, = hull_outline.hull_shells(load_scene({'probes.positions': [0.0, 0.0, 0.0]}).boat)
    assert (np.ptp(lonely, axis=0) > 0.1).all()


def test_outline_is_the_convex_hull():
    points = np.random.default_rng(1).normal(size=(200, 2))
    line = hull_outline.outline(points)
    edges = np.roll(line, -1, axis=0) - line
    turns = edges[:, 0] * np.roll(edges, -1, axis=0)[:, 1] - (
        edges[:, 1] * np.roll(edges, -1, axis=0)[:, 0])
    assert (turns > 0).all()
    for point in points:
        beside = point - line
        assert (edges[:, 0] * beside[:, 1] - edges[:, 1] * beside[:, 0] > -1e-12).all()


def test_boat_is_drawn_where_it_is():
    scene = load_scene({'start.position': [3.0, -2.0, 0.5], 'start.orientation': [0.2, 0.1, 1.0]})
    run = scene.simulation().run(0.01)
    probes = animate.placed(run, 0, scene.boat.hull.positions)
    # On flat water a probe is as deep as it lies below 0.
    assert probes[:, 2] == pytest.approx(-run.probe_depths[0], abs=1e-12)
    origin = animate.placed(run, 0, np.zeros((1, 3)))
    assert origin == pytest.approx(np.array([[3.0, -2.0, 0.5]]), abs=1e-12)
    assert run.orientation[0] == pytest.approx(turned(0.2, 0.1, 1.0), abs=1e-15)


@pytest.mark.parametrize(('words', 'says'), [
    (['--duration', '-5'], r'duration: expected a finite number above 0, got -5.0'),
    (['--duration', '0'], 'duration: expected a finite number above 0'),
    (['--duration', 'nan'], 'duration: expected a finite number above 0, got nan'),
    (['--duration', 'inf'], 'duration: expected a finite number above 0, got inf'),
    (['--duration', 'long'], "--duration: invalid float value: 'long'"),
    (['--duration', '1e9'], 'duration: expected at most 10000000 periods, got 1e.09 s'),
    ([], 'the following arguments are required: --duration'),
    (['--duration', '1', '--rate', '0'], 'rate: .*got 0.0'),
    (['--duration', '1', '--rate', '-1e3'], 'rate: .*got -1000.0'),
    (['--duration', '1', '--rate', 'nan'], 'rate: .*got nan'),
    (['--duration', '1', '--integrator', 'heun'], "integrator: expected .*got 'heun'"),
    (['--duration', '1', '--substeps', '-1'], 'substeps: .*got -1'),
    (['--duration', '1', '--substeps', '1.5'], '--substeps: invalid int value'),
    (['--duration', '1', '--thrust', '1', '2', '3', '4', '5'],
     '--thrust: expected 6 arguments'),
    (['--duration', '1', '--thrust', '1', '2', '3', '4', '5', 'nan'],
     r'thrust: expected finite numbers, got \[1.0, 2.0, 3.0, 4.0, 5.0, nan\]'),
    (['--duration', '1', '--thrust', '-inf', '2', '3', '4', '5', '6'],
     'thrust: expected finite numbers, got .-inf, 2.0'),
    (['--duration', '1', '--csv', 'a.csv', '--every', '0'],
     '--every: expected an integer of at least 1, got 0'),
    (['--duration', '1', '--csv', 'a.csv', '--every', '-3'],
     '--every: expected an integer of at least 1, got -3'),
    (['--duration', '1', '--csv', 'a.csv', '--every', '1.5'],
     "--every: invalid int value: '1.5'"),
    (['--duration', '1', '--every', '10'],
     '--every: it thins the table, and none is asked for; give --csv FILE'),
    (['--duration', '1', '--csv', '/no/such/folder/a.csv'],
     '/no/such/folder/a.csv: No such file or directory'),
    (['--duration', '1', '--csv', '/'], '/: Is a directory'),
    (['--duration', '1', '--plot', 'motion.jpeg2'],
     "--plot: expected a file name that ends in .png or .pdf or .svg, got 'motion.jpeg2'"),
    (['--duration', '1', '--animate', 'motion.png'],
     "--animate: expected a file name that ends in .gif, got 'motion.png'"),
    (['--duration', '1', '--speed', '3'], 'unrecognized arguments: --speed 3')])
def test_bad_input_gets_one_line_and_exit_code_2(words, says, capsys):
    assert re.search(says, refused(capsys, DEFAULT, *words))


def test_missing_scene_gets_one_line_and_exit_code_2(tmp_path, capsys):
    missing = str(tmp_path / 'none.yaml')
    assert missing in refused(capsys, missing, '--duration', '1')


def test_file_that_cannot_be_written_is_refused_before_the_run(capsys, monkeypatch):
    monkeypatch.setattr(Simulation, 'run', lambda *_: pytest.fail('it ran'))
    refused(capsys, DEFAULT, '--duration', '1', '--animate', '/no/such/folder/a.gif')


def test_refused_run_leaves_no_file_behind(tmp_path, capsys):
    path = tmp_path / 'a.csv'
    refused(capsys, DEFAULT, '--duration', '1', '--csv', str(path), '--thrust', 'nan', '0', '0',
            '0', '0', '0')
    assert not path.exists()
