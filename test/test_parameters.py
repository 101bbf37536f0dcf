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

"""The table of parameters is complete, and its defaults are the file's."""

import math
from pathlib import Path
import re

from boat_buoyancy.physics import load_scene, parameter_file
from boat_buoyancy.physics.parameter_values import checked
from boat_buoyancy.physics.parameters import check_names, PARAMETERS
import numpy as np
import pytest

DEFAULT = Path(__file__).parents[1] / 'config' / 'default.yaml'
KINDS = {'float': float, 'int': int, 'bool': bool, 'string': str, 'float_array': tuple,
         'int_array': tuple}
DERIVED = {'boat.inertia', 'hull.bottom', 'probes.positions', 'probes.weights', 'probes.law',
           'damping.probe', 'sea.waves'}
# With these there is nothing to raise.
NO_NUMBER = {'integrator', 'world_frame', 'body_frame', 'publish_clock', 'hull.shape',
             'probes.law'}
# What the node may change while it runs.
LIVE = ('boat.mass', 'boat.inertia', 'probes.floatiness', 'probes.stiffness', 'probes.weights',
        'damping.', 'sea.', 'thrust.timeout')


@pytest.fixture(params=PARAMETERS.values(), ids=lambda parameter: parameter.name)
def parameter(request):
    return request.param


def test_the_default_has_the_kind_that_is_named(parameter):
    if parameter.default is None:
        assert parameter.name in DERIVED
        return
    assert type(parameter.default) is KINDS[parameter.kind]
    if parameter.kind.endswith('_array'):
        item = float if parameter.kind == 'float_array' else int
        assert all(type(value) is item for value in parameter.default)


def test_the_default_passes_its_own_checks(parameter):
    if parameter.default is not None:
        assert checked(parameter.name, parameter.default) == parameter.default


def test_every_number_has_a_unit_and_says_what_raising_it_does(parameter):
    numeric = parameter.name not in NO_NUMBER
    assert bool(parameter.unit) == numeric
    assert re.search(r'(Higher|More|Longer|higher|Wider|Shallower|Another)', parameter.description
                     ) or not numeric
    assert parameter.description.endswith('.')


def test_every_scalar_number_has_a_range(parameter):
    if parameter.kind in ('float', 'int'):
        low, high = parameter.limits
        assert math.isfinite(low) and math.isfinite(high) and low < high
    else:
        assert parameter.limits is None


def test_what_may_change_while_running_is_what_is_promised(parameter):
    assert parameter.read_only == (not parameter.name.startswith(LIVE))


def test_one_beyond_either_end_of_the_range_is_refused(parameter):
    if parameter.limits is None:
        return
    low, high = parameter.limits
    kind = KINDS[parameter.kind]
    below = low if parameter.above is not None else (
        low - 1 if kind is int else np.nextafter(low, -math.inf))
    above = high + 1 if kind is int else np.nextafter(high, math.inf)
    for value in (kind(below), kind(above)):
        with pytest.raises(ValueError, match=re.escape(parameter.name) + ': expected'):
            checked(parameter.name, value)
    assert checked(parameter.name, kind(high)) == high


def wrong_values(parameter):
    nothing = {'float': 'word', 'int': 1.0, 'bool': 1, 'string': 5, 'float_array': 1.0,
               'int_array': 1}[parameter.kind]
    yield nothing
    if parameter.kind in ('float', 'float_array'):
        for bad in (math.nan, math.inf, -math.inf, True, '1.0', None, 10 ** 400):
            yield bad if parameter.kind == 'float' else [bad] * (parameter.lengths or (4,))[0]
    if parameter.kind == 'int':
        yield from (True, '1', math.nan, 10 ** 30)
    if parameter.lengths:
        yield from ([], [1.0] * 7, [[1.0, 1.0, 1.0]])
    if parameter.kind == 'string':
        yield from ('', True, ['leapfrog'], 'no such/ word', '/slash')


def test_every_wrong_value_is_refused_in_one_line_that_names_it(parameter):
    for value in wrong_values(parameter):
        with pytest.raises(ValueError) as raised:
            checked(parameter.name, value)
        message = str(raised.value)
        assert message.startswith(parameter.name), message
        assert 'expected ' in message and re.search('got |is ', message)
        assert '\n' not in message


def test_an_integer_for_a_double_is_taken_as_the_number():
    assert checked('boat.mass', 7) == 7.0
    assert type(checked('boat.mass', 7)) is float
    assert checked('hull.size', [4, 2, 1]) == (4.0, 2.0, 1.0)


@pytest.mark.parametrize('value', [[1.0, 2.0, 3.0], (1, 2, 3), np.array([1.0, 2.0, 3.0]),
                                   np.array([1, 2, 3]), np.array([1, 2, 3], np.float32)])
def test_an_array_may_be_a_list_a_tuple_or_an_array(value):
    assert checked('boat.center_of_mass', value) == (1.0, 2.0, 3.0)


def test_rows_of_probes_and_waves_may_stay_rows():
    rows = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
    flat = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert checked('probes.positions', rows) == checked('probes.positions', np.array(rows)) == flat
    assert checked('probes.positions', flat) == flat
    waves = [[1.0, 5.0, 0.0, 0.0], [0.5, 4.0, 1.0, 2.0]]
    assert checked('sea.waves', waves) == checked('sea.waves', np.ravel(waves))
    assert checked('sea.waves', []) == ()


@pytest.mark.parametrize('wrong, meant', [
    ('boat.mas', 'boat.mass'), ('mass', 'boat.mass'), ('boat_mass', 'boat.mass'),
    ('boat.centre_of_mass', 'boat.center_of_mass'), ('probe.floatiness', 'probes.floatiness'),
    ('floatines', 'probes.floatiness'), ('Rate', 'rate'), ('sea.wave', 'sea.waves'),
    ('hull.sizes', 'hull.size'), ('damping.angular_retension', 'damping.angular_retention')])
def test_a_misspelt_name_gets_the_nearest_as_a_suggestion(wrong, meant):
    with pytest.raises(ValueError) as raised:
        check_names([wrong])
    assert str(raised.value) == f'{wrong}: no such parameter, did you mean {meant}?'


def test_a_name_like_no_other_gets_the_list():
    with pytest.raises(ValueError, match='xyzzy: no such parameter; expected one of rate, integ'):
        check_names(['boat.mass', 'xyzzy'])


def test_the_default_file_gives_every_default():
    given = {name: tuple(value) if isinstance(value, list) else value
             for name, value in parameter_file.read(DEFAULT).items()}
    assert given == {name: parameter.default for name, parameter in PARAMETERS.items()
                     if parameter.default is not None and not name.startswith('probes.')}
    assert load_scene(DEFAULT).values == load_scene({}).values


def uncommented(text):
    """Return the text of the default file with every left-out line put in."""
    keys = '|'.join(name.rpartition('.')[2] for name in PARAMETERS)
    text = text.replace('# probes, in place of hull:', 'probes:')
    return re.sub(rf'(?m)^( +)# (?=({keys}): | +-?[0-9])', r'\1', text)


def test_the_lines_left_out_of_the_default_file_show_what_is_derived():
    shown = parameter_file.parse(uncommented(DEFAULT.read_text(encoding='utf-8')))
    assert list(shown) == list(PARAMETERS)
    example = {name: shown.pop(name) for name in list(shown)
               if name.startswith('probes.') and name != 'probes.law' or name == 'sea.waves'}
    default = load_scene({})
    for name in DERIVED - set(example):
        derived = default.values[name]
        if isinstance(derived, tuple):
            derived = pytest.approx(derived[:len(shown[name])], rel=1e-4)
        elif isinstance(derived, float):
            derived = pytest.approx(derived, rel=1e-4)
        assert shown[name] == derived
    for name in ('probes.floatiness', 'probes.stiffness'):
        assert example[name] == PARAMETERS[name].default
    assert len(load_scene(example).sea.waves) == 1
