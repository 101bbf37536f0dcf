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

"""
Parameter files, in the words that ROS and YAML read alike.

The node gets its parameters from rcl, to which ``1e3`` is a number and ``y`` is true where PyYAML
reads text, and ``null`` and ``12:30`` are text where PyYAML reads nothing and a number; ``010``
is eight to both.  What they read differently, or as hardly anybody means it, is refused.
"""

import math
import re
import textwrap

import yaml

from .parameters import NODE_NAME

FORM = f'"/**:" or "{NODE_NAME}:", under it "ros__parameters:", under that the parameters'
# Parameters of every ROS node, which are none of ours.
ROS_OWN = ('use_sim_time', 'start_type_description_service', 'qos_overrides')

# Two digits of exponent: near the ends of double precision rcl reads text.
_ALIKE = re.compile('true|True|TRUE|false|False|FALSE|[-+]?(0|[1-9][0-9]{0,18})|'
                    r'([-+]?[0-9]{1,30}\.[0-9]{0,30}|\.[0-9]{1,30})([eE][-+][0-9]{1,2})?')
# What else is not text without quotes to one of the two, or looks so, and what is meant by it.
_MEANT = {'true or false': re.compile('(?i)y|yes|on|true|n|no|off|false'),
          'a finite number': re.compile(r'(?i)[-+]?\.?(inf|infinity|nan(\(.*\))?)'),
          'a decimal number that ROS and YAML read alike': re.compile('(?s)[-+.0-9].*'),
          'a value': re.compile('(?is)null|[~=<!&|>{].*|')}


def read(path):
    """
    Return the parameters of a file as {dotted name: bool, int, float, str or list}.

    ValueError says in one line what is wrong, where, and what to write: a file that cannot be
    read, a word that ROS and YAML read differently, a name given twice, a list of mixed types,
    a nested list, no section for this node.
    """
    try:
        with open(path, encoding='utf-8') as file:
            return parse(file.read())
    except OSError as error:
        reason = f'cannot be read: {error.strerror}; expected a parameter file'
    except UnicodeDecodeError:
        reason = 'cannot be read: it is not UTF-8 text; expected a parameter file'
    except ValueError as error:
        reason = error
    raise ValueError(f'{path}: {reason}')


def parse(text):
    """Return the parameters in the text of a file, as `read` does."""
    tree = _tree(text)
    sections = _items(tree, f'expected {FORM}') if tree else {}
    ours = [name for name in sections if name.rpartition('/')[2] in ('*', '**', NODE_NAME)]
    if not ours:
        raise ValueError(f'expected {FORM}, got {", ".join(sections) or "an empty file"}')
    for name, node in sections.items():
        # What is a mapping may be for another node.
        if not isinstance(node, yaml.MappingNode):
            raise ValueError(
                f'{name}: expected parameters under "ros__parameters:", got one beside '
                f'"{ours[0]}:" in line {node.start_mark.line + 1}; indent it like the others')
    boats = {'/' + name.lstrip('/') for name in ours if '*' not in name}
    if len(boats) > 1:
        raise ValueError(f'expected the parameters of one boat, got {", ".join(sorted(boats))}')
    values = {}
    for name in ours:
        expected = f'{name}: expected "ros__parameters:" and nothing else under it'
        inner = _items(sections[name], expected)
        if list(inner) != ['ros__parameters']:
            raise _refusal(expected, sections[name])
        values.update(_flattened(inner['ros__parameters'], '', {}))
    return values


def _tree(text):
    """Return the root node of a text, None where it is empty."""
    try:
        for event in yaml.parse(text, yaml.SafeLoader):
            if isinstance(event, yaml.AliasEvent):
                raise _refusal('expected no alias, as ROS reads none', event)
        return yaml.compose(text, yaml.SafeLoader)
    except (yaml.YAMLError, RecursionError) as error:
        mark = getattr(error, 'problem_mark', None)
        where = f'line {mark.line + 1}: ' if mark else ''
        reason = getattr(error, 'problem', None) or str(error).splitlines()[0]
        raise ValueError(f'{where}expected YAML, got an error: {reason}') from None


def _items(node, expected):
    """Return a mapping as {name: node}, each name once."""
    if not isinstance(node, yaml.MappingNode):
        raise _refusal(expected, node)
    items = {}
    for key, value in node.value:
        if not isinstance(key, yaml.ScalarNode):
            raise _refusal('expected a name', key)
        if key.value in items:
            raise ValueError(f'{key.value}: given twice, the second time in line '
                             f'{key.start_mark.line + 1}')
        items[key.value] = value
    return items


def _flattened(node, prefix, values):
    """Return ``values`` with {dotted name: value} of every parameter under a mapping."""
    for key, value in _items(node, 'ros__parameters: expected parameters').items():
        name = prefix + key
        if isinstance(value, yaml.MappingNode) and value.value:
            _flattened(value, name + '.', values)
        elif name in values:
            raise ValueError(f'{name}: given twice')
        else:
            values[name] = _value(name, value)
    return values


def _value(name, node):
    """Return the value of a parameter; ValueError unless ROS and YAML read it alike."""
    if isinstance(node, yaml.SequenceNode):
        return _list(name, node)
    word = _source(node)
    value = word if word.startswith(('"', "'")) else _plain(word)
    if value is None:
        meant = next(words for words, pattern in _MEANT.items() if pattern.fullmatch(word))
        cure = _cure(word)
        raise _refusal(f'{name}: expected {meant}' + ('' if cure else ', or text in quotes'),
                       node, cure)
    return node.value if isinstance(value, str) else value


def _list(name, node):
    """Return a list of values of one type."""
    if not all(isinstance(item, yaml.ScalarNode) for item in node.value):
        raise _refusal(f'{name}: expected one flat list, as ROS reads no others', node)
    values = [_value(name, item) for item in node.value]
    kinds = {type(value) for value in values}
    if len(kinds) > 1:
        cure = kinds == {int, float} and (_written([float(value) for value in values])
                                          if len(values) <= 12 else 'all with a decimal point')
        raise _refusal(f'{name}: expected values of one type, as ROS reads no other lists', node,
                       cure)
    return values


def _plain(word):
    """Return what a word without quotes is to ROS and YAML alike, else None."""
    if _ALIKE.fullmatch(word):
        value = yaml.safe_load(word)
        return None if type(value) is int and not -2 ** 63 <= value < 2 ** 63 else value
    return None if any(pattern.fullmatch(word) for pattern in _MEANT.values()) else word


def _cure(word):
    """Return what to write for a word that is some number, None where it is none."""
    for number in (int, float):
        try:
            cure = _written(number(word))
        except ValueError:
            continue
        if _plain(cure) is not None:
            return cure


def _written(value):
    """Return a number or a list of numbers as YAML."""
    return yaml.safe_dump(value, default_flow_style=True, width=math.inf).splitlines()[0]


def _refusal(expected, node, cure=None):
    """Return a ValueError about a part of a file."""
    given = textwrap.shorten(_source(node), 80) or 'nothing'
    return ValueError(f'{expected}, got {given} (line {node.start_mark.line + 1})'
                      + (f': write {cure}' if cure else ''))


def _source(node):
    """Return what stands in a file for a node."""
    start, end = node.start_mark, node.end_mark
    return start.buffer[start.pointer:end.pointer]
