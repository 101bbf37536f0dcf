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
Parameter files, read as ROS reads them.

The node gets its parameters from rcl, whose rules are not those of YAML's own types nor of
PyYAML: ``1e3`` and ``nan`` are numbers, ``010`` is eight, ``null`` and ``12:30`` are text, and a
list has one type.  Here a file is taken apart by PyYAML and its values are read by rcl's rules
(rcl_yaml_param_parser), so that it means the same to the node and to the library.
"""

import math
import re

import yaml

from .parameters import NODE_NAME

FORM = f'"/**:" or "{NODE_NAME}:", under it "ros__parameters:", under that the parameters'
# Parameters of every ROS node, which are none of ours.
ROS_OWN = ('use_sim_time', 'start_type_description_service', 'qos_overrides')

_TRUE = ('y', 'yes', 'true', 'on')
_FALSE = ('n', 'no', 'false', 'off')
_INTEGER = re.compile(r'[-+]?(0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)')
_DECIMAL = re.compile(r'[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?')
_HEXADECIMAL = re.compile(
    r'[-+]?0[xX]([0-9a-fA-F]+\.?[0-9a-fA-F]*|\.[0-9a-fA-F]+)([pP][-+]?[0-9]+)?')
_INFINITY = re.compile(r'([-+]?)(\.(inf|Inf|INF)|(?i:inf|infinity))')
_NAN = re.compile(r'[-+]?(?i:nan)(\([0-9A-Za-z_]*\))?|\.(nan|NaN|NAN)')
_TEXT, _PLAIN = 'tag:yaml.org,2002:str', 'plain'
# Below these strtod reports a decimal or hexadecimal number as out of range.
_LEAST_NORMAL, _LEAST = 2.0 ** -1022, 2.0 ** -1074


def scalar(text):
    """Return an unquoted word as rcl reads it: bool, int, float, or the text itself."""
    for words, value in ((_TRUE, True), (_FALSE, False)):
        if text.lower() in words and text in (text.lower(), text.upper(), text.capitalize()):
            return value
    if _INTEGER.fullmatch(text):
        digits = text.lstrip('+-')
        octal = digits.startswith('0') and digits.isdigit()
        value = int(digits, 8 if octal else 0) * (-1 if text[0] == '-' else 1)
        if -2 ** 63 <= value < 2 ** 63:
            return value
    number = _float(text)
    return text if number is None else number


def _float(text):
    """Return what C's strtod makes of a word, None where it fails or leaves the range."""
    if _NAN.fullmatch(text):
        return float('nan')
    infinity = _INFINITY.fullmatch(text)
    if infinity:
        return float(infinity.group(1) + 'inf')
    if _DECIMAL.fullmatch(text):
        value, digits, least = float(text), re.split('[eE]', text)[0], _LEAST_NORMAL
    elif _HEXADECIMAL.fullmatch(text):
        digits, least = re.split('[pP]', text)[0].lower().replace('0x', ''), _LEAST
        try:
            value = float.fromhex(text)
        except OverflowError:
            return None
    else:
        return None
    underflow = abs(value) < least and re.search('[1-9a-f]', digits)
    return None if underflow or math.isinf(value) else value


class _Loader(yaml.SafeLoader):
    """Builds the tree of a file: no aliases, scalars tagged as text or plain."""

    def compose_node(self, parent, index):
        if self.check_event(yaml.AliasEvent):
            raise ValueError(f'{_line(self.peek_event())}: expected plain values, got the alias '
                             f'*{self.peek_event().anchor}: ROS reads no aliases')
        return super().compose_node(parent, index)

    def compose_scalar_node(self, anchor):
        tag = self.peek_event().tag
        node = super().compose_scalar_node(anchor)
        node.tag = _TEXT if tag == _TEXT or node.style in ('"', "'") else _PLAIN
        return node


def _line(item):
    return f'line {item.start_mark.line + 1}'


def read(path):
    """
    Return the parameters of a file as {dotted name: bool, int, float, str or list}.

    ValueError says in one line what is wrong and where: a file that cannot be read, YAML that
    ROS refuses, a name given twice, lists of mixed types, nested lists, no section for this node.
    """
    try:
        with open(path, encoding='utf-8-sig') as file:
            text = file.read()
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, 'strerror', None) or 'it is not UTF-8 text'
        raise ValueError(f'{path}: cannot be read: {reason}; '
                         'expected a parameter file') from None
    try:
        return parse(text)
    except yaml.YAMLError as error:
        mark = getattr(error, 'problem_mark', None)
        where = f'line {mark.line + 1}: ' if mark else ''
        reason = getattr(error, 'problem', None) or str(error).splitlines()[0]
        raise ValueError(f'{path}: {where}expected YAML, got an error: {reason}') from None
    except ValueError as error:
        raise ValueError(f'{path}: {error}') from None


def parse(text):
    """Return the parameters in the text of a file, as `read` does."""
    sections = []
    for document in yaml.compose_all(text, _Loader):
        if not isinstance(document, yaml.MappingNode):
            raise ValueError(f'expected {FORM}, got {_shown(document)}')
        sections += _items(document)
    names = [name for name, _ in sections]
    ours = [name for name in names if name.rpartition('/')[2] in ('*', '**', NODE_NAME)]
    if not ours:
        raise ValueError(f'expected {FORM}, got {", ".join(names) or "an empty file"}')
    boats = {'/' + name.lstrip('/') for name in ours if '*' not in name}
    if len(boats) > 1:
        raise ValueError(f'expected the parameters of one boat, got {", ".join(sorted(boats))}')
    values = {}
    for name, node in sections:
        if name in ours:
            values.update(_section(name, node))
    return values


def _section(name, node):
    """Return the parameters of one node name of a file."""
    inner = dict(_items(node)) if isinstance(node, yaml.MappingNode) else {}
    if list(inner) != ['ros__parameters']:
        raise ValueError(f'{name}: expected "ros__parameters:" and nothing else under it, '
                         f'got {", ".join(inner) or _shown(node)}')
    node = inner['ros__parameters']
    if not isinstance(node, yaml.MappingNode):
        raise ValueError(f'ros__parameters: expected parameters, got {_shown(node)}')
    values = {}
    for key, value in _flattened(node):
        if key in values:
            raise ValueError(f'{key}: given twice')
        values[key] = value
    return values


def _items(node):
    """Return the pairs (name, node) of a mapping, each name once."""
    pairs = []
    for key, value in node.value:
        if not isinstance(key, yaml.ScalarNode):
            raise ValueError(f'{_line(key)}: expected a name, got {_shown(key)}')
        if key.value in (name for name, _ in pairs):
            raise ValueError(f'{key.value}: given twice, the second time in {_line(key)}')
        pairs.append((key.value, value))
    return pairs


def _flattened(node, prefix=''):
    """Yield (dotted name, value) of every parameter under a mapping."""
    for key, value in _items(node):
        name = prefix + key
        if isinstance(value, yaml.MappingNode) and value.value:
            yield from _flattened(value, name + '.')
        elif isinstance(value, yaml.SequenceNode):
            yield name, _list(name, value)
        elif value.value == [] or value.value == '' and value.style is None:
            raise ValueError(f'{name}: expected a value, got none ({_line(value)})')
        else:
            yield name, _value(value)


def _value(node):
    """Return the value of a scalar node."""
    return node.value if node.tag == _TEXT else scalar(node.value)


def _list(name, node):
    """Return a list of values of one type."""
    if not all(isinstance(item, yaml.ScalarNode) for item in node.value):
        raise ValueError(f'{name}: expected one flat list, as ROS reads no others, '
                         f'got a nested list ({_line(node)})')
    values = [_value(item) for item in node.value]
    if len({type(value) for value in values}) > 1:
        raise ValueError(f'{name}: expected values of one type, as ROS reads no others '
                         f'(all numbers with a decimal point), got {values!r}')
    return values


def _shown(node):
    if isinstance(node, yaml.ScalarNode):
        return repr(node.value) if node.value else 'nothing'
    return 'a list' if isinstance(node, yaml.SequenceNode) else 'a mapping'
