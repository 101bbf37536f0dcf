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

"""The README is a promise: what it names exists, and what it shows is what one gets."""

import contextlib
import io
import re
import runpy
import shlex

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.scene.parameters import PARAMETERS
from boat_buoyancy.physics.step_size.plan import MAX_SUBSTEPS
from boat_buoyancy.tools import hydrodynamics, report, simulate
from boat_buoyancy.tools.chart import fidelity_text
from boat_buoyancy.tools.chart.main import main as chart
from boat_buoyancy.tools.chart.stability_map import predicted_loop_growth
from boat_buoyancy.tools.chart.table import read
from boat_buoyancy.tools.view.main import main as view
import pytest
from readme import blocks, commands, ROOT, section, table, TEXT

PLAIN = 'the step is plain Python, some fifty times slower'
TOOLS = {'buoyancy_report': report.main, 'buoyancy_simulate': simulate.main,
         'buoyancy_chart': chart, 'buoyancy_hydrodynamics': hydrodynamics.main,
         'buoyancy_view': view}
TOPIC_TYPES = {name: kind for name, kind, *_ in table('Topics')}
SERVICE_TYPES = {name: kind for name, kind, *_ in table('Services')}


def shown(value):
    """Return a default as the README writes it."""
    if value is None:
        return '–'
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return '[' + ', '.join(map(shown, value)) + ']'
    return str(value)


def test_the_parameter_table_is_that_of_the_code():
    rows = {row[0].removesuffix(' ◦'): row for row in table('Parameters')}
    assert list(rows) == list(PARAMETERS)
    for name, parameter in PARAMETERS.items():
        mark, default, unit, limits, meaning = rows[name]
        assert mark.endswith('◦') is not parameter.read_only, name
        assert (default, unit, meaning) == (
            shown(parameter.default), parameter.unit, parameter.description), name
        for limit in (parameter.above, parameter.at_least, parameter.at_most):
            assert limit is None or f'{limit:g}' in limits, name
        assert all(choice in limits for choice in parameter.choices), name


def test_every_scene_that_ships_is_in_the_table_and_loads():
    rows = [row[0] for row in table('Scenes that ship')]
    assert sorted(rows) == sorted(path.name for path in (ROOT / 'config').glob('*.yaml'))
    for name in rows:
        load_scene(ROOT / 'config' / name)


def test_every_parameter_and_file_named_exists():
    prefixes = {name.partition('.')[0] for name in PARAMETERS if '.' in name}
    dotted = re.findall(r'`([a-z_]+\.[a-z_]+)(?::[^`]*)?`', TEXT)
    named = {word for word in dotted if word.partition('.')[0] in prefixes}
    assert len(named) > 10
    assert named <= set(PARAMETERS)
    for link in re.findall(r'\]\(([^)#][^)]*)\)', TEXT):
        assert (ROOT / link).is_file(), link
    for anchor in re.findall(r'\]\(#([^)]*)\)', TEXT):
        headings = [re.sub(r'[^a-z0-9 -]', '', heading.lower()).replace(' ', '-')
                    for heading in re.findall(r'^#+ (.*)$', TEXT, re.MULTILINE)]
        assert anchor in headings, anchor


def test_every_topic_service_and_parameter_in_a_ros2_command_exists():
    seen = 0
    for command in commands():
        words = shlex.split(command)
        if words[:1] != ['ros2']:
            continue
        seen += 1
        verb = words[1:3]
        if verb[0] == 'topic':
            arguments = [word for word in words[3:] if not word.startswith('-')]
            topic = next(word for word in arguments if word.startswith('/'))
            rest = arguments[arguments.index(topic) + 1:]
            assert topic.lstrip('/') in TOPIC_TYPES or topic in TOPIC_TYPES, command
            assert not rest or rest[0] == TOPIC_TYPES[topic.lstrip('/')], command
        elif verb[0] == 'service':
            assert words[4] == SERVICE_TYPES[words[3].replace('/boat_buoyancy', '~')], command
        elif verb == ['param', 'set']:
            parameter = PARAMETERS[words[4]]
            assert not parameter.read_only and words[3] == '/boat_buoyancy', command
            load_scene({words[4]: float(words[5])})
        elif verb[0] == 'launch':
            launch = (ROOT / 'launch' / words[3]).read_text()
            for argument in words[4:]:
                assert f"'{argument.partition(':=')[0]}'" in launch or argument == '--show-args'
        elif verb[0] == 'run':
            assert words[2:4] == ['boat_buoyancy', 'buoyancy_node'], command
        else:
            assert verb[0] in ('node', 'param'), command
    assert seen > 8


@pytest.mark.parametrize('command', [c for c in commands() if c.startswith('buoyancy_')])
def test_every_tool_command_is_understood(command):
    program, *arguments = shlex.split(command)
    options = [word for word in arguments if word.startswith('--')]
    said = io.StringIO()
    with contextlib.redirect_stdout(said), pytest.raises(SystemExit) as left:
        TOOLS[program](['--help'])
    assert left.value.code == 0
    assert all(option in said.getvalue() for option in options)
    for word in arguments:
        if word.endswith('.yaml') and word.startswith('config/'):
            assert (ROOT / word).is_file()


def test_the_report_shown_is_the_report_one_gets(monkeypatch):
    monkeypatch.chdir(ROOT)
    example, = (block for block in blocks('text') if block.startswith('$ buoyancy_report'))
    first, _, expected = example.partition('\n')
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        assert report.main(first.split()[2:]) == 0
    # As it is where Numba is installed.
    got = said.getvalue().replace(PLAIN, 'the step is compiled')
    assert got.strip() == expected.strip()


def test_the_added_mass_shown_is_what_one_gets(monkeypatch):
    monkeypatch.chdir(ROOT)
    example, = (block for block in blocks('text')
                if block.startswith('$ buoyancy_hydrodynamics'))
    first, _, expected = example.partition('\n')
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        assert hydrodynamics.main(first.split()[2:]) == 0
    assert said.getvalue().strip() == expected.strip()


def test_the_library_example_runs_and_says_what_is_shown(tmp_path, monkeypatch):
    monkeypatch.chdir(ROOT)
    _, example = blocks('python')
    path = tmp_path / 'example.py'
    path.write_text(example)
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        runpy.run_path(str(path))
    lines = re.findall(r'# -> (.*)$', example, re.MULTILINE)
    assert lines == said.getvalue().strip().splitlines()


def test_the_launch_example_is_a_part_of_the_file_it_is_said_to_come_from():
    example, _ = blocks('python')
    shipped = (ROOT / 'launch' / 'two_boats.launch.py').read_text()
    assert ' '.join(example.split()) in ' '.join(shipped.split())


def test_the_figures_of_the_knobs_are_those_of_the_scenes():
    # The scenes of the idea start from the values that the table recommends.
    text = section('The knobs of the idea, and where to start')
    for name in ('v2_budget', 'v3_probe_damping', 'v4_tuned'):
        boat = load_scene(ROOT / 'config' / f'{name}.yaml')
        assert 1.1 <= boat.values['probes.floatiness'] <= 1.3
        assert 2.0 <= boat.values['probes.stiffness'] <= 10.0
    assert '1.1 to 1.3' in text and '2 to 10' in text


WRITTEN = (ROOT / 'doc' / 'speed_accuracy.txt').read_text()


def evaluations(task, *integrators):
    """Return the force evaluations that integrators need for a task, as the chart wrote them."""
    line, = re.findall(rf'^  {task}: (.*)$', WRITTEN, re.MULTILINE)
    found = dict(re.findall(r'(\w+) (\d+) \(', line))
    return [found[integrator] for integrator in integrators]


def cpu_times(task, *integrators):
    """Return the CPU time in µs that integrators need for a task."""
    line, = re.findall(rf'^  {task}: (.*)$', WRITTEN, re.MULTILINE)
    found = dict(re.findall(r'(\w+) \d+ \(([\d.]+) µs\)', line))
    return [found[integrator] for integrator in integrators]


def figure(what, model, count):
    """Return what the chart wrote of so many springs, columns or panels: (error in %, µs)."""
    line, = re.findall(rf'^  {what}, {model}: (.*)$', WRITTEN, re.MULTILINE)
    return re.search(rf'(?:^|, ){count} (?:(\S+) %|exact) \((\S+) µs\)', line).groups()


def settings():
    """Return (error in m, integrator, rate, the rest) of the settings that nothing else beats."""
    return re.findall(r'^  (\S+) m, .*: integrator: (\w+), rate: (\S+), substeps: 1, (.*)$',
                      WRITTEN, re.MULTILINE)


def test_every_figure_of_accuracy_is_the_one_that_the_chart_wrote():
    first = 'leapfrog', 'rk4', 'symplectic_euler'
    box, round_, small = 'GM of the box', 'GZ to 180 deg of the box', 'GZ to 25 deg of the '
    curved = [float(figure(f'{small}{hull}', 'columns', 36)[0])
              for hull in ('Wigley hull', 'V hull')]
    waves = 'motion of the box in waves of 1 L'
    most, = re.findall(rf'^  {waves}, panels: .*, (\d+) \S+ % \(\S+ µs\)$', WRITTEN, re.MULTILINE)
    four_by_two = [setting for setting in settings()
                   if setting[3] == 'hull.model: columns, hull.probes: [4, 2]']
    panels = [setting for setting in settings() if setting[3].startswith('hull.model: panels')]
    centimetre = next(setting for setting in panels if float(setting[0]) < 0.01)
    finest = next(setting for setting in panels if float(setting[0]) < 0.001)
    assert 'hull.panel_size: 0.0' in centimetre[3]
    claims = [
        ('To 10 mm in an irregular sea `leapfrog` needs {} force evaluations per simulated '
         'second, `rk4` {} and the plain game loop {}',
         evaluations('irregular sea to 10 mm', *first)),
        ('in a drop it is {}, {} and {}.', evaluations('drop to 10 mm', *first)),
        ('(a free decay to 1 mm: {} against {})',
         evaluations('free decay to 1 mm', 'rk4', 'leapfrog')),
        ('(to 1 mm: {} against {}, {} and {};', evaluations(
            'stiff barge to 1 mm', 'implicit', 'leapfrog', 'symplectic_euler', 'rk4')),
        ('in CPU time {} µs against {} for `leapfrog`)',
         cpu_times('stiff barge to 1 mm', 'implicit', 'leapfrog')),
        ('({} evaluations where `leapfrog` takes {})',
         evaluations('stiff barge in swell to 10 mm', 'implicit', 'leapfrog')),
        ('a step of four columns takes {} µs, one of twelve panels {}.',
         [figure(box, 'columns', 4)[1], figure(box, 'panels', 12)[1]]),
        ('miss its GM by {} % and its righting arm all the way round by {} %, and a hundred and '
         'forty-four of them still by {} %', [figure(box, 'springs', 4)[0], *(
             figure(round_, 'springs', count)[0] for count in (4, 144))]),
        ('miss by {} % all the way round when they are four, by {} % when they are a hundred and '
         'forty-four', [figure(round_, 'columns', count)[0] for count in (4, 144)]),
        ('36 columns for {:g} % of its righting arm to 25 degrees', [max(curved)]),
        ('16 columns are within {} % of the amplitude', figure(waves, 'columns', 16)[:1]),
        ('only many panels are: within {} %', figure(waves, 'panels', most)[:1]),
        ('For the barge in sea state 5, `leapfrog` at {} Hz on `[4, 2]` columns is within {} m',
         [four_by_two[0][2], four_by_two[0][0]]),
        ('with `leapfrog` at {} Hz within {} m', [centimetre[2], centimetre[0]]),
        ('below 1 mm it is `{}` at {} Hz on panels of {} m',
         [*finest[1:3], finest[3].rpartition(' ')[2]])]
    assert 'barge in sea state 5' in WRITTEN and centimetre[1] == four_by_two[0][1] == 'leapfrog'
    text = ' '.join(section('How accurate, and how fast').split())
    for words, figures in claims:
        claim = words.format(*figures)
        assert claim in text, claim
        text = text.replace(claim, ' ')
    for sentence in fidelity_text.sentences(read(ROOT / 'doc' / 'fidelity.csv')):
        assert sentence in text
        text = text.replace(sentence, ' ')
    # And there is no other: figures in code and links are not of the chart.
    rest = re.sub(r'```.*?```|\]\([^)]*\)|`[^`]*`', ' ', text)
    assert re.findall(r'\d+(?:\.\d+)?', rest) == []


def test_the_figures_about_stability_are_those_of_the_long_runs_and_the_loop():
    text = section('Stable where other integrators fail')
    recorded = (ROOT / 'doc' / 'long_runs.md').read_text()
    for figure in ('2.51', '80 000'):
        assert figure in text and figure in recorded
    for drag, growth in ((1.1, '1.0007'), (2.1, '1.0955')):
        assert f'{growth}' in text
        assert float(growth) == pytest.approx(float(predicted_loop_growth(0.0886, drag)), abs=5e-5)
    assert f'more than {MAX_SUBSTEPS} substeps' in text.replace('\n', ' ')


def test_the_speed_that_the_push_is_said_to_give():
    text = section('Push it, roll waves under it, watch it')
    force = float(re.search(r'force: \{x: ([\d.]+)\}', text)[1])
    sim = load_scene({}).simulation()
    for _ in range(3000):
        sim.step([force, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert f'make {sim.state.velocity[0]:.2f} m/s' in text
    assert 'draft 0.244 m, heave 0.991 s, roll 1.3 s, pitch 1.06 s' in TEXT
    assert sim.warnings == ()
