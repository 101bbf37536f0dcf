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

import json
from pathlib import Path
import subprocess
import sys

from boat_buoyancy.physics import yaml_file
import pytest

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

WORDS = (
    '1', '+1', '-5', '0', '-0', '00', '010', '-010', '08', '09.5', '0o10', '0b11', '0x10', '0X1F',
    '-0x10', '0x', '0xg', '9223372036854775807', '9223372036854775808', '-9223372036854775808',
    '-9223372036854775809', '99999999999999999999', '0x8000000000000000',
    '1.0', '1.', '.5', '-.5', '+1.5', '+.5', '5.e3', '00.5', '-0.0', '.', '+.', '.e3', '++1',
    '+-1', '1e3', '1E3', '1.0e3', '1e-3', '1e+3', '1e', '1.e', '1.0e', '1e400', '-1e400', '1e-400',
    '1e-310', '4.9e-324', '2.5e-324', '0e-400', '1e308', '1.8e308', '0x1p3', '0x1.8p1', '0x.8',
    '0x1p', '0x1p5000', '0x1p-1074', '0x1p-1080', '0x1p-1022', '2.2250738585072014e-308', '1d3',
    '1f', '1.5f',
    'nan', 'NaN', 'NAN', 'nAn', '+nan', '-nan', 'nan(1)', '.nan', '.NaN', '.NAN', '.Nan', '-.nan',
    'inf', 'Inf', 'iNf', '-inf', '+inf', 'infinity', 'INFINITY', 'infinit', '.inf', '.Inf', '.INF',
    '-.inf', '+.inf', '-.INF', '.iNf', '.infinity',
    'true', 'True', 'TRUE', 'tRue', 'false', 'yes', 'no', 'Yes', 'NO', 'on', 'off', 'On', 'OFF',
    'y', 'n', 'Y', 'N', 'null', '~', 'Null',
    '1_000', '1_000.0', '12:30', '1:30.5', '1,5', '1,000', '2001-01-01', '=', '<<', '1.0.0',
    '1.0abc', '1.0#c', '1.0 #c', '\u0661', 'one two',
    "'1.0'", '"1.0"', "'1'", '"true"', '""', "''", '"1.0 "', '"a\\tb"', '!!str 1.0', '!!str yes',
    '!!int 1.0', '!!float 1', '!!int "5"', '!!bool "true"', '!!float abc', '!foo 1', '&a 1.0',
    '|\n      1.0', '|-\n      1.0', '>-\n      1.0', '|-\n      yes', '!!str |-\n      1.0',
    '[1]', '[1,2]', '[1.0,2.0]', '[1.0,]', '[1e3]', '[1e3,2.0]', '[+1.5]', '[010]', '[0x10]',
    '[1.0,nan]', '[.inf,-.inf]', '[1e400]', '[9223372036854775808]', '[yes,no]', '[true]',
    '[a,b]', "['1','2']", '["1.0"]', '[~]', '[1_0]', '\n    - 1.0\n    - 2.0')
REFUSED_WORDS = (
    '', '-', '@a', '%a', '`', '[1,2.5]', '[1.0,2]', '[1.0,a]', '[a,1]', '[true,1]', '[1.0,true]',
    "[1.0,'2.0']", "['1',2]", '[null,1.0]', '[nan,1]', '[[1.0,2.0],[3.0]]', '[', '*a', '{a: 1',
    # To the node this is a parameter of no type.
    '{}')

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
    'two documents': HEAD + '    a: 1.0\n---\n' + HEAD + '    b: 1.0\n',
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
    'tabs': '/**:\n\tros__parameters:\n\t\ta: 1.0\n',
    'a list': '- a\n- b\n'}
# ROS takes these in silence: the library says what was surely not meant.
TAKEN_BY_ROS_ALONE = {
    'a name twice': (HEAD + '    a: 1.0\n    a: 2.0\n',
                     'a: given twice, the second time in line 4'),
    'a name twice, dotted': (HEAD + '    a.b: 1.0\n    a:\n      b: 2.0\n', 'a.b: given twice'),
    'a node twice': (HEAD + '    a: 1.0\n' + HEAD + '    b: 1.0\n', '/**: given twice'),
    'another node': ('boat:\n  ros__parameters:\n    a: 1.0\n', 'got boat'),
    'nothing': ('# nothing\n', 'got an empty file'),
    'groups in a list': (HEAD + '    p: [{a: 1}]\n', 'nested list')}
# Parameters that every node has.
OWN = {'use_sim_time', 'start_type_description_service'}


def text_of(word):
    return f'{HEAD}    p: {word}\n'


def read_here(text):
    return {name: repr(value) for name, value in yaml_file.parse(text).items()}


@pytest.fixture(scope='module')
def paths(tmp_path_factory):
    """Return {text: path of a file that holds it}."""
    folder = tmp_path_factory.mktemp('files')
    texts = [*map(text_of, WORDS + REFUSED_WORDS), *FILES.values(), *REFUSED_FILES.values(),
             *(text for text, _ in TAKEN_BY_ROS_ALONE.values())]
    paths = {text: folder / f'{i}.yaml' for i, text in enumerate(texts)}
    for text, path in paths.items():
        path.write_bytes(text.encode())
    return paths


@pytest.fixture(scope='module')
def by_ros(paths):
    """Return {text: what a node gets from it}; None where the node does not start."""
    done = subprocess.run(
        [sys.executable, '-c', READER], input=json.dumps([str(path) for path in paths.values()]),
        text=True, capture_output=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return {text: answer if answer is None else
            {name: value for name, value in answer.items() if name not in OWN}
            for text, answer in zip(paths, json.loads(done.stdout))}


def refusal(path):
    with pytest.raises(ValueError) as raised:
        yaml_file.read(path)
    message = str(raised.value)
    assert message.startswith(f'{path}: ')
    assert '\n' not in message
    return message


def test_every_word_has_the_value_it_has_in_ros(by_ros):
    assert ({word: read_here(text_of(word)) for word in WORDS}
            == {word: by_ros[text_of(word)] for word in WORDS})


@pytest.mark.parametrize('word', REFUSED_WORDS)
def test_every_word_that_ros_refuses_is_refused_in_one_line(word, paths, by_ros):
    assert by_ros[text_of(word)] is None
    refusal(paths[text_of(word)])


@pytest.mark.parametrize('what', FILES)
def test_every_form_of_file_means_what_it_means_in_ros(what, paths, by_ros):
    text = FILES[what]
    read = {name: repr(value) for name, value in yaml_file.read(paths[text]).items()}
    assert read == by_ros[text]


@pytest.mark.parametrize('what', REFUSED_FILES)
def test_every_form_of_file_that_ros_refuses_is_refused_in_one_line(what, paths, by_ros):
    assert by_ros[REFUSED_FILES[what]] is None
    refusal(paths[REFUSED_FILES[what]])


@pytest.mark.parametrize('what', TAKEN_BY_ROS_ALONE)
def test_what_ros_takes_in_silence_is_refused_in_one_line(what, paths, by_ros):
    text, reason = TAKEN_BY_ROS_ALONE[what]
    assert by_ros[text] is not None
    assert reason in refusal(paths[text])
