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

"""The pages are a promise: what they name exists, and what they show is what one gets."""

import contextlib
from importlib import import_module
import io
import math
import re
import runpy
import shlex

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.scene import parameter_file
from boat_buoyancy.physics.scene.parameters import PARAMETERS
from boat_buoyancy.physics.step_size.plan import MAX_SUBSTEPS
from boat_buoyancy.tools import parameter_table
from boat_buoyancy.tools.chart import fidelity_text
from boat_buoyancy.tools.chart.stability_map import predicted_loop_growth
from boat_buoyancy.tools.chart.table import read
from programs import console_scripts
import pytest
from readme import (blocks, commands, headings, page, PAGES, prose, README, ROOT, section, table,
                    TEXT)
from test_house import FLOORS, FOUNDATIONS
import yaml

PLAIN = 'the step is plain Python, some fifty times slower'
# The programs that need no ROS, by name: their modules.
TOOLS = {name: module for name, (module, _) in console_scripts().items() if '.tools.' in module}
TOPIC_TYPES = {name: kind for name, kind, *_ in table('Topics')}
SERVICE_TYPES = {name: kind for name, kind, *_ in table('Services')}


def program(name):
    """Return the main function of a program."""
    return import_module(TOOLS[name]).main


def test_the_readme_is_short():
    lines = README.splitlines()
    assert len(lines) <= 200
    # Short in characters, too: a line is 120 of them, or one sentence, link or row of a table.
    for line in lines:
        one_sentence = len(re.findall(r'[.:;] (?=[A-Z])', line)) == 0
        assert len(line) <= 120 or line.startswith(('|', '[INFO]')) or one_sentence, line


def passages(text):
    """Return the sentences and the rows of tables that are too long to be equal by chance."""
    found = set()
    plain = re.sub(r'^(#.*|!\[.*)$', '', prose(text), flags=re.MULTILINE)
    for paragraph in re.split(r'\n{2,}', plain):
        rows = re.findall(r'^\|.*$', paragraph, re.MULTILINE)
        found |= set(rows or re.split(r'(?<=[.?])\s', ' '.join(paragraph.split())))
    return {passage for passage in found if len(passage) > 50}


def test_no_sentence_stands_on_two_pages():
    seen = {}
    for path, text in PAGES.items():
        for passage in passages(text):
            assert passage not in seen, f'{path.name} and {seen[passage].name}: {passage}'
            seen[passage] = path
    assert len(seen) > 200


def test_every_link_leads_somewhere():
    anchors = {path: [re.sub(r'[^\w -]', '', title.lower()).replace(' ', '-')
                      for _, title in headings(text)] for path, text in PAGES.items()}
    count = 0
    for path, text in PAGES.items():
        for link in re.findall(r'\]\(([^)]*)\)', prose(text)):
            name, _, anchor = link.partition('#')
            target = (path.parent / name).resolve() if name else path
            assert target.is_file(), f'{path.name}: {link}'
            assert not anchor or anchor in anchors[target], f'{path.name}: {link}'
            count += 1
    assert count > 50


def test_every_page_is_reached_from_the_readme():
    found, left = set(), [ROOT / 'README.md']
    while left:
        path = left.pop()
        if path in found or path not in PAGES:
            continue
        found.add(path)
        left += [(path.parent / name).resolve()
                 for name in re.findall(r'\]\(([^)#]+)[^)]*\)', prose(PAGES[path]))]
    assert found == set(PAGES)


def test_the_page_of_parameters_is_that_of_the_code():
    assert page('parameters.md') == parameter_table.page()


def test_the_page_of_parameters_has_every_limit_and_choice():
    # What the generator shows, read back and compared with the table itself.
    rows = {row[0].removesuffix(' ◦'): row for row in table('Parameters')}
    assert list(rows) == list(PARAMETERS)
    for name, parameter in PARAMETERS.items():
        mark, default, unit, limits, meaning = rows[name]
        assert mark.endswith('◦') is not parameter.read_only, name
        assert (unit, meaning) == (parameter.unit, parameter.description), name
        if isinstance(parameter.default, str):
            assert default == parameter.default, name
        else:
            shown = yaml.safe_load(default) if default != '–' else None
            assert shown == (list(parameter.default) if isinstance(parameter.default, tuple)
                             else parameter.default), name
        for limit in (parameter.above, parameter.at_least, parameter.at_most):
            assert limit is None or f'{limit:g}' in limits, name
        assert all(choice in limits for choice in parameter.choices), name


def test_every_scene_that_ships_is_in_the_table_and_loads():
    rows = [row[0] for row in table('Start from a scene')]
    assert sorted(rows) == sorted(path.name for path in (ROOT / 'config').glob('*.yaml'))
    for name in rows:
        load_scene(ROOT / 'config' / name)


def test_every_parameter_named_exists():
    prefixes = {name.partition('.')[0] for name in PARAMETERS if '.' in name}
    dotted = re.findall(r'`([a-z_]+\.[a-z_]+)(?::[^`]*)?`', TEXT)
    named = {word for word in dotted if word.partition('.')[0] in prefixes}
    assert len(named) > 10
    assert named <= set(PARAMETERS)


def test_every_parameter_file_shown_loads(tmp_path):
    (tmp_path / 'hulls').symlink_to(ROOT / 'config' / 'hulls')
    shown = blocks('yaml')
    assert len(shown) >= 2
    for text in shown:
        path = tmp_path / 'scene.yaml'
        path.write_text(text)
        load_scene(path)


def test_the_first_run_moves():
    command, = (command for command in commands() if '-p wind' in command)
    words = shlex.split(command)
    values = parameter_file.read(ROOT / words[words.index('--params-file') + 1])
    for word in words[words.index('-p') + 1::2]:
        name, _, value = word.partition(':=')
        values[name] = yaml.safe_load(value)
    run = load_scene(values).simulation().run(5.0)
    start, end = run.position[0], run.position[-1]
    # It starts at rest; in five seconds it has gone its own length and turned by ten degrees.
    assert run.body_velocity[0].tolist() == [0.0, 0.0, 0.0]
    assert max(abs(end - start)[:2]) > 3.0 and abs(run.yaw[-1] - run.yaw[0]) > 0.17
    assert abs(run.pitch).max() > 0.05


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


def test_what_is_at_a_glance_is_in_the_tables():
    for name, kind, said in table('Topics and services at a glance'):
        known = SERVICE_TYPES if name.startswith('~') else TOPIC_TYPES
        assert known[name] == kind
        if not name.startswith('~'):
            row, = (row for row in table('Topics') if row[0] == name)
            assert said.partition(':')[0] == row[2].partition(',')[0], name
    assert set(SERVICE_TYPES) <= {row[0] for row in table('Topics and services at a glance')}


def test_every_extra_that_is_installed_exists():
    known = set(re.findall(r"^        '(\w+)': \[", (ROOT / 'setup.py').read_text(), re.MULTILINE))
    asked = re.findall(r'\./install\.sh ([\w,]+)', TEXT)
    assert len(asked) > 5
    assert {extra for extras in asked for extra in extras.split(',')} <= known


def test_every_file_in_a_command_exists():
    written = {'run.csv', 'run.png', 'boat.gif', 'run.mcap'}
    count = 0
    for command in commands():
        for word in shlex.split(command):
            word = word.removeprefix('src/boat_buoyancy/')
            if re.fullmatch(r'(\./|\.ci/|config/|test/|benchmarks/|doc/)[\w./]+', word):
                assert (ROOT / word).exists(), command
                count += 1
            elif re.search(r'\.(py|yaml|md)$', word) and not word.startswith('--') and (
                    'ros2 launch' not in command):
                assert word in written or list(ROOT.glob(word)), command
    assert count > 10


@pytest.mark.parametrize('command', [
    command.removeprefix('.venv/bin/') for command in commands()
    if re.match(r'(\.venv/bin/)?buoyancy_(?!node)', command)])
def test_every_tool_command_is_understood(command):
    name, *arguments = shlex.split(command)
    options = [word for word in arguments if word.startswith('--')]
    said = io.StringIO()
    with contextlib.redirect_stdout(said), pytest.raises(SystemExit) as left:
        program(name)(['--help'])
    assert left.value.code == 0
    assert all(option in said.getvalue() for option in options)


SHOWN = [block for block in blocks('text') if block.startswith('$ buoyancy_')]


@pytest.mark.parametrize('example', SHOWN, ids=[block.partition('\n')[0] for block in SHOWN])
def test_what_a_program_is_shown_to_print_is_what_it_prints(example, monkeypatch):
    monkeypatch.chdir(ROOT)
    first, _, expected = example.partition('\n')
    _, name, *arguments = first.split()
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        assert program(name)(arguments) == 0
    # As it is where Numba is installed.
    got = said.getvalue().replace(PLAIN, 'the step is compiled')
    # A line of dots stands for lines that are left out.
    parts = [re.escape(part.strip('\n')) for part in f'\n{expected}'.split('\n...\n')]
    assert re.fullmatch(r'\n?' + r'\n(?:.*\n)*?'.join(parts) + r'\n?', '\n' + got), got


def test_what_is_shown_is_of_every_kind():
    assert {block.split()[1] for block in SHOWN} == {'buoyancy_report', 'buoyancy_hydrodynamics'}


LIBRARY = [block for name in ('library.md', 'your_boat.md')
           for block in blocks('python', page(name))]


@pytest.mark.parametrize('number', range(len(LIBRARY)))
def test_a_library_example_runs_and_says_what_is_shown(number, tmp_path, monkeypatch):
    monkeypatch.chdir(ROOT)
    path = tmp_path / 'example.py'
    path.write_text(LIBRARY[number])
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        runpy.run_path(str(path))
    lines = re.findall(r'# -> (.*)$', LIBRARY[number], re.MULTILINE)
    assert lines and lines == said.getvalue().strip().splitlines()


def test_the_other_python_is_of_the_files_that_it_is_said_to_come_from():
    controller, = blocks('python', README)
    assert (ROOT / 'examples' / 'heading_hold.py').read_text().endswith('\n' + controller)
    fleet, = blocks('python', page('ros.md'))
    shipped = (ROOT / 'launch' / 'two_boats.launch.py').read_text()
    assert ' '.join(fleet.split()) in ' '.join(shipped.split())
    assert len(LIBRARY) + 2 == len(blocks('python'))


def test_the_house_is_the_one_that_the_tests_hold():
    rows = [row[0] for row in table('The house')]
    assert rows == list(FLOORS)
    below = section('The house').rpartition('Below them are')[2].partition('.')[0]
    assert tuple(re.findall(r'`(\w+)`', below)) == FOUNDATIONS


def test_what_the_troubles_quote_is_what_the_programs_say():
    sources = '\n'.join(path.read_text() for path in (ROOT / 'boat_buoyancy').rglob('*.py'))
    sources = re.sub(r"'\s+f?'|\s+", ' ', sources).lower()
    quoted = [part.strip() for row in table('When something is not as you expect')
              for text in re.findall(r'^"(.*)"$', row[0])
              for part in re.split(r'\.\.\.|FILE|/boat_buoyancy|, ', text)
              if len(part.strip(' :')) > 8]
    assert len(quoted) >= 4
    for text in quoted:
        assert text.strip(' :').lower() in sources, text


def test_the_values_to_start_tuning_from_are_those_of_the_scenes():
    # The scenes v2 to v4 start from the values that the table recommends.
    text = section('Tuning probes by hand')
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


def test_the_three_parameters_halve_the_error_as_the_readme_says():
    rows = read(ROOT / 'doc' / 'fidelity.csv')
    without, all_three = (fidelity_text.overall(rows, 'columns', fidelity_text.COUNT, parts)[0]
                          for parts in (fidelity_text.NONE, fidelity_text.ALL))
    assert 'more than halve the error' in README
    assert all(2.0 * after < before for before, after in zip(without, all_three))


def test_the_figures_about_stability_are_those_of_the_long_runs_and_the_loop():
    text = page('stability.md')
    recorded = (ROOT / 'doc' / 'long_runs.md').read_text()
    for figure in ('2.51', '80 000'):
        assert figure in text and figure in recorded
    for drag, growth in ((1.1, '1.0007'), (2.1, '1.0955')):
        assert f'{growth}' in text
        assert float(growth) == pytest.approx(float(predicted_loop_growth(0.0886, drag)), abs=5e-5)
    assert f'more than {MAX_SUBSTEPS} substeps' in text.replace('\n', ' ')


def test_the_waves_on_a_current_are_those_of_the_dispersion_relation():
    # In deep water (ω - k U)² = g k, a quadratic in the root of k.
    def length(period, current):
        root = (math.sqrt(9.81 + 8.0 * math.pi * current / period) - math.sqrt(9.81)) / (
            2.0 * current) if current else 2.0 * math.pi / period / math.sqrt(9.81)
        return 2.0 * math.pi / root ** 2

    text = ' '.join(page('model.md').split())
    assert (f'A wave of 3 s is {length(3.0, 0.0):.1f} m long in still water and '
            f'{length(3.0, 1.0):.1f} m on a current of 1 m/s') in text
    assert f'8π U/g, which is {8.0 * math.pi / 9.81:.2f} s against 1 m/s' in text


def test_the_speed_that_the_push_is_said_to_give():
    text = section('Push it, send it waves, watch it')
    force = float(re.search(r'force: \{x: ([\d.]+)\}', text)[1])
    sim = load_scene({}).simulation()
    for _ in range(3000):
        sim.step([force, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert f'make {sim.state.velocity[0]:.2f} m/s' in text
    start = sim.state.position[0]
    for _ in range(6000):
        sim.step()
    assert 'for some ten metres' in ' '.join(text.split())
    assert 5.0 < sim.state.position[0] - start < 20.0
    assert 'draft 0.244 m, heave 0.991 s, roll 1.3 s, pitch 1.06 s' in TEXT
    assert sim.warnings == ()
