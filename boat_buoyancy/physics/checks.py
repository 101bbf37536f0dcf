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

"""Checks of numbers given by a user: a ValueError says what, what was given, what is expected."""

import math
import reprlib

import numpy as np

_short = reprlib.Repr()
_short.maxlist = _short.maxtuple = _short.maxarray = 12
_short.maxstring = _short.maxother = _short.maxlong = 80


def shown(value):
    """Return what was given as a message shows it: a long list by how it begins."""
    return _short.repr(value)


def number(name, value, *, above=None, at_least=None, at_most=None):
    """Return ``value`` as a finite float within the limits."""
    expected = 'a finite number'
    if above is not None:
        expected += f' above {above:g}'
    if at_least is not None:
        expected += f' of at least {at_least:g}'
    if at_most is not None:
        expected += f'{"" if above is None and at_least is None else " and"} at most {at_most:g}'
    wrong = ValueError(f'{name}: expected {expected}, got {shown(value)}')
    if isinstance(value, (bool, str)):
        raise wrong
    try:
        result = float(value)
    except (TypeError, ValueError, OverflowError):
        raise wrong from None
    if (not math.isfinite(result) or (above is not None and not result > above)
            or (at_least is not None and result < at_least)
            or (at_most is not None and result > at_most)):
        raise wrong
    return result


def vector(name, values, *lengths, above=None, at_least=None, at_most=None):
    """
    Return ``values`` as a read-only float array of shape (n,) with every number checked.

    ``lengths`` are the lengths allowed; with none given, any.  Where 1 is allowed, so is a number
    that is in no list.
    """
    try:
        items = np.asarray(values).tolist()
    except (TypeError, ValueError):
        items = values
    if 1 in lengths and isinstance(items, (int, float)) and not isinstance(items, bool):
        items = [items]
    if not isinstance(items, list):
        raise ValueError(f'{name}: expected a list of numbers, got {shown(values)}')
    if lengths and len(items) not in lengths:
        wanted = ' or '.join(str(length) for length in lengths)
        raise ValueError(f'{name}: expected {wanted} numbers, got {len(items)}: '
                         f'{shown(items)}')
    result = np.array([number(f'{name}[{i}]', item, above=above, at_least=at_least,
                              at_most=at_most) for i, item in enumerate(items)], float)
    result.setflags(write=False)
    return result


def count(name, value, *, at_least):
    """Return ``value`` as an int of at least ``at_least``."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < at_least:
        raise ValueError(f'{name}: expected an integer of at least {at_least}, '
                         f'got {shown(value)}')
    return int(value)
