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

"""A parameter file means the same to a ROS node and to the library."""

import ast
import json
from pathlib import Path
import random
import subprocess
import sys

from boat_buoyancy.physics.scene import parameter_file
import pytest
import yaml

# Reads parameter files as a node does; each path gives {name: repr(value)} or, refused, null.
READER = """
import json
import sys

import rclpy
from rclpy.node import Node

answers = []
for path in json.load(sys.stdin):
    context = rclpy.Context()
    try:
        rclpy.init(args=['--ros-args', '--params-file', path], context=context)
        node = Node('boat_buoyancy', context=context, start_parameter_services=False,
                    enable_rosout=False, allow_undeclared_parameters=True,
                    automatically_declare_parameters_from_overrides=True)
        values = {name: parameter.value
                  for name, parameter in node.get_parameters_by_prefix('').items()}
        answers.append({name: repr(value.tolist() if hasattr(value, 'tolist') else value)
                        for name, value in values.items()})
        node.destroy_node()
    except (RuntimeError, ValueError):
        answers.append(None)
    finally:
        rclpy.try_shutdown(context=context)
print(json.dumps(answers))
"""

# Words that rcl and PyYAML read alike.
ALIKE = (
    '1', '+1', '-5', '0', '-0', '9223372036854775807', '-9223372036854775808', '1.0', '1.', '.5',
    '+1.5', '-0.25', '00.5', '09.5', '-0.0', '1.0e+3', '1.5E-3', '5.e+3', '.5e-3', '0.0e-99',
    '999999999999999999999999999999.0e+99', '0.000000000000000000000000000001e-99',
    '0.1234567890123456789', 'true', 'True', 'TRUE', 'false', 'False', 'FALSE',
    'leapfrog', 'base_link', '/odom', '_a', 'one two', 'one\n      two', 'infinit', 'nano', 'e3',
    'x1F', 'a:b', 'a#b', "it's", 'truely', 'nn', 'nullify', '\u0661', '\u00e9t\u00e9',
    "'1.0'", '"1.0"', "'1'", '"true"', '"yes"', "'~'", '""', "''", '"1.0 "', '"a\\tb"', "'it''s'",
    '[1]', '[1, -2]', '[1.0, 2.0]', '[1.0,]', '[1.0e+3, 2.0]', '[true, FALSE]', '[a, b]',
    "['1', '2']", '[a, "1.0"]', '[0.0,\n      1.0,  # why\n      2.0]', '\n    - 1.0\n    - 2.0')
NUMBER = 'a decimal number that ROS and YAML read alike'
TEXT = 'or text in quotes'
# Words that they read differently: what is expected instead, and what to write.
UNALIKE = {
    NUMBER: {
        '1e3': '1000.0', '1E3': '1000.0', '1.0e3': '1000.0', '1e-3': '0.001', '1e+3': '1000.0',
        '-1e3': '-1000.0', '1e20': '1.0e+20', '5.e3': '5000.0', '-.5': '-0.5', '+.5': '0.5',
        '08': '8', '-09': '-9', '9223372036854775808': '9.223372036854776e+18',
        '99999999999999999999': '1.0e+20', '1_000': '1000', '1_000.5': '1000.5',
        '1.0e-400': '0.0'},
    f'{NUMBER}, {TEXT}': dict.fromkeys((
        '12:30', '1:30.5', '2001-01-01', '1.0e+400', '-1.0e+400', '1.0e-310', '0x1p3', '0X1F',
        '0b11')),
    f'a finite number, {TEXT}': dict.fromkeys((
        'nan', 'NaN', 'nAn', '-nan', 'nan(1)', 'inf', 'Inf', '-inf', '+inf', 'INFINITY')),
    f'true or false, {TEXT}': dict.fromkeys('yYnN'),
    f'a value, {TEXT}': dict.fromkeys((
        'null', 'Null', 'NULL', '~', '=', '<<', '!!float 1', '!!int "5"', '!!bool "true"',
        '!foo a'))}
# Words that they read alike, but as something else than what most people mean by them.
SURPRISING = {
    NUMBER: {'010': '10', '-010': '-10', '00': '0'},
    f'{NUMBER}, {TEXT}': dict.fromkeys((
        '0x1F', '-0x10', '0o10', '1e400', '1.0e+100', '1.0e-100', '1,5', '1.0.0', '1f', '1d3',
        '1e', '++1', '.', '2nd', '-a')),
    f'a finite number, {TEXT}': dict.fromkeys((
        '.nan', '.NaN', '.NAN', '.inf', '.Inf', '.INF', '-.inf', '+.inf', '-.nan')),
    f'true or false, {TEXT}': dict.fromkeys((
        'yes', 'Yes', 'YES', 'no', 'No', 'NO', 'on', 'On', 'ON', 'off', 'Off', 'OFF', 'tRue')),
    f'a value, {TEXT}': dict.fromkeys((
        'nULL', '~/a', '!!str 1.0', '!!int 5', '&a 1.0', '|\n      1.0', '>-\n      a\n      b'))}
MIXED = 'p: expected values of one type, as ROS reads no other lists, got '
# What ROS refuses, and what is said of it.
REFUSED_WORDS = {
    '': f'p: expected a value, {TEXT}, got nothing (line 3)',
    # To the node this is a parameter of no type.
    '{}': f'p: expected a value, {TEXT}, got {{}} (line 3)',
    '[0, 0, 0.2]': f'{MIXED}[0, 0, 0.2] (line 3): write [0.0, 0.0, 0.2]',
    '[1.0e+20,\n      2]': f'{MIXED}[1.0e+20, 2] (line 3): write [1.0e+20, 2.0]',
    **{f'[{items}]': f'{MIXED}[{items}] (line 3)'
       for items in ('1.0, a', 'a, 1', 'true, 1', "1.0, '2.0'", "'1', 2")},
    '[[1.0, 2.0], [3.0]]': 'p: expected one flat list, as ROS reads no others, '
                           'got [[1.0, 2.0], [3.0]] (line 3)',
    '*a': 'expected no alias, as ROS reads none, got *a (line 3)',
    **dict.fromkeys(('-', '@a', '%a', '`', '[', '{a: 1', 'a: 1'), 'expected YAML, got an error')}

HEAD = '/**:\n  ros__parameters:\n'
FILES = {
    'nested and dotted names':
        HEAD + '    a:\n      b: 1.0\n      c:\n        d: 2.0\n    a.e: 3.0\n',
    'the node by name': 'boat_buoyancy:\n  ros__parameters:\n    a: 1.0\n',
    'the node by full name': '/boat_buoyancy:\n  ros__parameters:\n    a: 1.0\n',
    'any namespace': '/**/boat_buoyancy:\n  ros__parameters:\n    a: 1.0\n',
    'any name': '/*:\n  ros__parameters:\n    a: 1.0\n',
    'name after wildcard': HEAD + '    a: 2.0\n    b: 3.0\n'
    'boat_buoyancy:\n  ros__parameters:\n    a: 1.0\n',
    'wildcard after name': 'boat_buoyancy:\n  ros__parameters:\n    a: 1.0\n'
    + HEAD + '    a: 2.0\n    b: 3.0\n',
    'another node beside': 'other:\n  ros__parameters:\n    z: 1.0\n' + HEAD + '    a: 1.0\n',
    'flow style': '/**: {ros__parameters: {a: 1.0, b: {c: 2}}}\n',
    'no parameters': '/**:\n  ros__parameters: {}\n',
    'names like other types': HEAD + '    1: 1.0\n    true: 2.0\n    null: 3.0\n    "a": 4.0\n',
    'Windows line ends': HEAD.replace('\n', '\r\n') + '    a: 1.0\r\n',
    'a byte order mark': '\ufeff' + HEAD + '    a: 1.0\n',
    'document marks': '---\n' + HEAD + '    a: 1.0\n...\n',
    # As launch writes a list.
    'a tuple of Python': HEAD + '    a: !!python/tuple\n    - 1.0\n    - 2.0\n',
    **{path.name: path.read_text(encoding='utf-8')
       for path in sorted((Path(__file__).parents[1] / 'config').glob('*.yaml'))}}
REFUSED_FILES = {
    'no ros__parameters': '/**:\n  a: 1.0\n',
    'parameters alone': 'a: 1.0\n',
    'empty ros__parameters': HEAD,
    'a list for parameters': '/**:\n  ros__parameters: [1.0]\n',
    'a number for parameters': '/**:\n  ros__parameters: 5\n',
    'a number for a node': '/**: 5\n',
    'more than ros__parameters': HEAD + '    a: 1.0\n  b: 1.0\n',
    'ros__parameters twice': HEAD + '    a: 1.0\n  ros__parameters:\n    b: 1.0\n',
    'an empty group': HEAD + '    a:\n    b: 1.0\n',
    'an alias': HEAD + '    a: &x 1.0\n    b: *x\n',
    'a merge': HEAD + '    a: &x {c: 1.0}\n    b:\n      <<: *x\n',
    "another node's alias": 'z:\n  ros__parameters: {a: &x 1.0, b: *x}\n' + HEAD + '    a: 1.0\n',
    'tabs': '/**:\n\tros__parameters:\n\t\ta: 1.0\n',
    'a list': '- a\n- b\n'}
# ROS takes these in silence: the library says what was surely not meant.
TAKEN_BY_ROS_ALONE = {
    'two documents': (HEAD + '    a: 1.0\n---\n' + HEAD + '    b: 1.0\n',
                      'expected YAML, got an error: but found another document'),
    'a group twice': (HEAD + '    a: {b: 1.0}\n    a: {c: 2.0}\n',
                      'a: given twice, the second time in line 4'),
    'a name twice': (HEAD + '    a: 1.0\n    a: 2.0\n',
                     'a: given twice, the second time in line 4'),
    'a name twice, dotted': (HEAD + '    a.b: 1.0\n    a:\n      b: 2.0\n', 'a.b: given twice'),
    'a node twice': (HEAD + '    a: 1.0\n' + HEAD + '    b: 1.0\n', '/**: given twice'),
    'only another node': ('boat:\n  ros__parameters:\n    a: 1.0\n', 'got boat'),
    'nothing': ('# nothing\n', 'got an empty file'),
    'groups in a list': (HEAD + '    p: [{a: 1}]\n', 'p: expected one flat list')}
# Parameters that every node has.
OWN = {'use_sim_time', 'start_type_description_service'}


def text_of(word):
    return f'{HEAD}    p: {word}\n'


def read_by_ros(texts, folder):
    """Return {text: what a node gets from a file of it}; None where the node does not start."""
    paths = [folder / f'{i}.yaml' for i in range(len(texts))]
    for path, text in zip(paths, texts):
        path.write_bytes(text.encode())
    done = subprocess.run([sys.executable, '-c', READER], input=json.dumps(list(map(str, paths))),
                          text=True, capture_output=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return {text: answer if answer is None else
            {name: value for name, value in answer.items() if name not in OWN}
            for text, answer in zip(texts, json.loads(done.stdout))}


def read_here(text):
    return {name: repr(value) for name, value in parameter_file.parse(text).items()}


def read_by_yaml(word):
    """Return what PyYAML takes a word for; None where it refuses it."""
    try:
        return repr(yaml.safe_load(text_of(word))['/**']['ros__parameters']['p'])
    except yaml.YAMLError:
        return None


def refusal(text, folder):
    path = folder / 'refused.yaml'
    path.write_bytes(text.encode())
    with pytest.raises(ValueError) as raised:
        parameter_file.read(path)
    message = str(raised.value)
    assert message.startswith(f'{path}: ') and '\n' not in message
    return message.removeprefix(f'{path}: ')


@pytest.fixture(scope='module')
def by_ros(tmp_path_factory):
    """Return {text: what a node gets from it} of every table."""
    words = [*ALIKE, *REFUSED_WORDS, *(word for table in (UNALIKE, SURPRISING)
                                       for words in table.values() for word in words)]
    texts = [*map(text_of, words), *FILES.values(), *REFUSED_FILES.values(),
             *(text for text, _ in TAKEN_BY_ROS_ALONE.values())]
    return read_by_ros(texts, tmp_path_factory.mktemp('files'))


def test_every_word_that_is_taken_is_the_same_to_ros_and_to_yaml(by_ros):
    here = {word: read_here(text_of(word)) for word in ALIKE}
    assert here == {word: by_ros[text_of(word)] for word in ALIKE}
    assert here == {word: {'p': read_by_yaml(word)} for word in ALIKE}


def test_every_random_word_that_is_taken_is_the_same_to_ros_and_to_yaml(tmp_path):
    draw = random.Random(1)
    pieces = [*'0189+-._eExXaynN:~=', 'inf', 'nan', 'true', 'e+', 'e-', '00', '1.', '.5', '1_0']
    taken = []
    for _ in range(3000):
        word = ''.join(draw.choices(pieces, k=draw.randint(1, 6)))
        try:
            here = read_here(text_of(word))
        except ValueError:
            continue
        # Not `a:`, a name.
        if list(here) == ['p']:
            taken.append((word, here['p']))
    kinds = {type(ast.literal_eval(value)) for _, value in taken}
    assert len(taken) > 400 and kinds == {int, float, bool, str}
    text = HEAD + ''.join(f'    p{i}: {word}\n' for i, (word, _) in enumerate(taken))
    by_ros = read_by_ros([text], tmp_path)[text]
    assert taken == [(word, by_ros[f'p{i}']) for i, (word, _) in enumerate(taken)]
    assert taken == [(word, read_by_yaml(word)) for word, _ in taken]


@pytest.mark.parametrize('table, differ', [(UNALIKE, True), (SURPRISING, False)],
                         ids=['unalike', 'surprising'])
def test_other_words_are_refused_with_what_to_write(table, differ, by_ros, tmp_path):
    for expected, words in table.items():
        for word, cure in words.items():
            ros, by_yaml = by_ros[text_of(word)]['p'], read_by_yaml(word)
            assert (ros != by_yaml) == differ, word
            message = f'p: expected {expected}, got {" ".join(word.split())} (line 3)'
            assert refusal(text_of(word), tmp_path) == message + (
                f': write {cure}' if cure else '')
            # The cure is the number that one of the two reads.
            if cure and differ:
                meant = {float(value) for value in (ros, by_yaml) if value[0] != "'"}
                assert float(read_here(text_of(cure))['p']) in meant, word


def test_every_word_that_ros_refuses_is_refused_in_one_line(by_ros, tmp_path):
    for word, message in REFUSED_WORDS.items():
        assert by_ros[text_of(word)] is None, word
        assert message in refusal(text_of(word), tmp_path), word


def test_every_form_of_file_means_what_it_means_in_ros(by_ros, tmp_path):
    path = tmp_path / 'scene.yaml'
    for what, text in FILES.items():
        path.write_bytes(text.encode())
        values = parameter_file.read(path)
        assert {name: repr(value) for name, value in values.items()} == by_ros[text], what


def test_every_form_of_file_that_ros_refuses_is_refused_in_one_line(by_ros, tmp_path):
    for what, text in REFUSED_FILES.items():
        assert by_ros[text] is None, what
        refusal(text, tmp_path)


def test_what_ros_takes_in_silence_is_refused_in_one_line(by_ros, tmp_path):
    for what, (text, reason) in TAKEN_BY_ROS_ALONE.items():
        assert by_ros[text] is not None, what
        assert reason in refusal(text, tmp_path), what
