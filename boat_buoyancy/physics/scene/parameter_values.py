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

"""The value of one parameter: checked against the table and brought to one form."""

import re

import numpy as np

from .parameters import PARAMETERS
from .. import checks
from ..sea.wave_rows import checked_waves, WAVE_FORM

# Arrays that may be given as rows: of how many numbers, and which.
ROWS = {'probes.positions': (3, 'x, y, z of every probe'), 'sea.waves': (4, WAVE_FORM),
        'thrusters.positions': (3, 'x, y, z of every thruster'),
        'thrusters.directions': (3, 'x, y, z of every direction'),
        'thrusters.limits': (2, 'least and greatest thrust of every thruster')}


def checked(name, value):
    """
    Return the value of one parameter as float, int, bool, str, or tuple of numbers or str.

    An integer for a float is taken as the number; arrays may be lists, tuples or NumPy arrays, or
    a number where they may be of one.
    ValueError says what was given and what is expected.
    """
    parameter = PARAMETERS[name]
    limits = {'above': parameter.above, 'at_least': parameter.at_least,
              'at_most': parameter.at_most}
    if parameter.kind == 'float':
        return checks.number(name, value, **limits)
    if parameter.kind == 'int':
        return _integer(name, value, parameter)
    if parameter.kind == 'bool':
        if not isinstance(value, bool):
            raise ValueError(f'{name}: expected true or false, got {checks.shown(value)}')
        return value
    if parameter.kind == 'path':
        if not isinstance(value, str) or not value.strip():
            raise ValueError(f'{name}: expected the path of a file, got {checks.shown(value)}')
        return value
    if parameter.kind == 'string':
        return _string(name, value, parameter)
    if parameter.kind == 'int_array':
        return _integers(name, value, parameter)
    if parameter.kind == 'string_array':
        return _names(name, value)
    alone = 1 in parameter.lengths and isinstance(value, (int, float))
    numbers = _numbers(name, [value] if alone else value)
    if name == 'sea.waves':
        return tuple(checked_waves(numbers).ravel().tolist())
    return tuple(checks.vector(name, numbers, *parameter.lengths, **limits).tolist())


def _numbers(name, value):
    """Return an array as a list, rows of it one after the other."""
    items = value.tolist() if isinstance(value, np.ndarray) else value
    width, form = ROWS.get(name, (0, 'a list of numbers'))
    if isinstance(items, (list, tuple)) and width and all(
            isinstance(row, (list, tuple, np.ndarray)) and len(row) == width for row in items):
        items = [item for row in items for item in row]
    if not isinstance(items, (list, tuple)) or any(
            isinstance(item, (bool, str, list, tuple, dict)) for item in items):
        raise ValueError(f'{name}: expected {form}, got {checks.shown(value)}')
    return items


def _integer(name, value, parameter):
    """Return an int within the range of its parameter."""
    try:
        result = checks.count(name, value, at_least=parameter.at_least)
    except ValueError:
        result = None
    if result is None or result > parameter.at_most:
        raise ValueError(f'{name}: expected an integer of {parameter.at_least} to '
                         f'{parameter.at_most}, got {checks.shown(value)}')
    return result


def _integers(name, value, parameter):
    """Return a tuple of integers within the range of their parameter."""
    items = value.tolist() if hasattr(value, 'tolist') else value
    if not isinstance(items, (list, tuple)) or len(items) not in parameter.lengths:
        raise ValueError(f'{name}: expected {parameter.lengths[0]} integers, '
                         f'got {checks.shown(items)}')
    return tuple(_integer(f'{name}[{i}]', item, parameter) for i, item in enumerate(items))


def _string(name, value, parameter):
    """Return one of the choices of a parameter, or where it has none a frame id."""
    if parameter.choices:
        if value not in parameter.choices:
            raise ValueError(f'{name}: expected one of {", ".join(parameter.choices)}, '
                             f'got {checks.shown(value)}')
    elif value == '' == parameter.default:
        pass
    elif (not isinstance(value, str) or not value or value.startswith('/')
            or any(c.isspace() for c in value)):
        raise ValueError(f'{name}: expected a frame id without spaces or leading slash, '
                         f'got {checks.shown(value)}')
    return value


def _names(name, value):
    """Return a tuple of different words that may be part of the name of a topic."""
    items = value.tolist() if hasattr(value, 'tolist') else value
    if (not isinstance(items, (list, tuple)) or len({*map(repr, items)}) < len(items)
            or not all(isinstance(item, str) and re.fullmatch('[A-Za-z][A-Za-z0-9_]*', item)
                       for item in items)):
        raise ValueError(f'{name}: expected different names of letters, digits and _ that begin '
                         f'with a letter, got {checks.shown(value)}')
    return tuple(items)
