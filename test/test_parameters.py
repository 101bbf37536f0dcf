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

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.scene import parameter_file
from boat_buoyancy.physics.scene.parameter_names import check_names, WORDS
from boat_buoyancy.physics.scene.parameter_values import checked
from boat_buoyancy.physics.scene.parameters import PARAMETERS
import numpy as np
import pytest

DEFAULT = Path(__file__).parents[1] / 'config' / 'default.yaml'
KINDS = {'float': float, 'int': int, 'bool': bool, 'string': str, 'float_array': tuple,
         'int_array': tuple, 'string_array': tuple, 'path': str}
DERIVED = {'boat.inertia', 'hull.bottom', 'probes.positions', 'probes.weights', 'probes.law',
           'damping.linear_retention', 'damping.angular_retention', 'damping.probe', 'sea.waves',
           'hull.spacing', 'hull.mesh', 'start.orientation', 'thrusters.names',
           'thrusters.positions', 'thrusters.directions', 'thrusters.limits'}
# With these there is nothing to raise.
NO_NUMBER = {'integrator', 'world_frame', 'body_frame', 'publish_clock', 'hull.shape',
             'hull.model', 'hull.mesh', 'probes.law', 'thrusters.names', 'frame_prefix',
             'publish_tf', 'map_frame', 'wave_force'}
# What the node may change while it runs.
LIVE = ('boat.mass', 'boat.inertia', 'probes.floatiness', 'probes.stiffness', 'probes.weights',
        'damping.', 'added_mass', 'sea.', 'wind.', 'thrust.timeout')


NUMBERS = ('float', 'int', 'float_array', 'int_array')


def test_every_default_has_the_kind_that_is_named_and_passes_its_own_checks():
    for name, parameter in PARAMETERS.items():
        default = parameter.default
        if name in DERIVED:
            assert default is None, name
            continue
        assert type(default) is KINDS[parameter.kind], name
        if parameter.kind.endswith('_array'):
            item = KINDS[parameter.kind.removesuffix('_array')]
            assert {type(value) for value in default} == {item}, name
        assert checked(name, default) == default, name


def test_every_number_has_a_unit_and_says_what_raising_it_does():
    raised = re.compile('(Higher|More|Longer|higher|Wider|Shallower|Another)')
    for name, parameter in PARAMETERS.items():
        assert parameter.description.endswith('.'), name
        assert bool(parameter.unit) == (name not in NO_NUMBER), name
        assert raised.search(parameter.description) or name in NO_NUMBER, name


def test_every_scalar_number_has_a_range_and_nothing_else_has():
    for name, parameter in PARAMETERS.items():
        if parameter.kind in ('float', 'int'):
            low, high = parameter.limits
            assert math.isfinite(low) and math.isfinite(high) and low < high, name
        else:
            assert parameter.limits is None, name


def test_what_may_change_while_running_is_what_is_promised():
    assert {name for name, parameter in PARAMETERS.items() if not parameter.read_only} == {
        name for name in PARAMETERS if name.startswith(LIVE)}


def refusal(name, value):
    with pytest.raises(ValueError) as raised:
        checked(name, value)
    message = str(raised.value)
    assert message.startswith(name) and '\n' not in message
    assert 'expected ' in message and re.search('got |is ', message), message
    return message


def alone_and_in_place(parameter, number, others):
    """Yield a number as the value of a parameter, or in each place of its lists among others."""
    if not parameter.kind.endswith('_array'):
        yield number
        return
    for length in parameter.lengths or (4, 12):
        for place in range(length):
            yield [others] * place + [number] + [others] * (length - 1 - place)


def test_the_ends_of_every_range_are_taken_and_the_next_number_beyond_is_refused():
    # Waves have ends of their own.
    ranged = [p for p in PARAMETERS.values() if p.kind in NUMBERS and p.name != 'sea.waves']
    assert len(ranged) == len(PARAMETERS) - len(NO_NUMBER) - 1
    for parameter in ranged:
        whole = parameter.kind.startswith('int')
        low, high = parameter.at_least, parameter.at_most
        below = low if low is None else low - 1 if whole else np.nextafter(low, -math.inf)
        if parameter.above is not None:
            below, low = parameter.above, np.nextafter(parameter.above, math.inf)
        above = high + 1 if whole else np.nextafter(high, math.inf)
        kind = int if whole else float
        for end in (low, high):
            for value in alone_and_in_place(parameter, kind(end), kind(high)):
                taken = checked(parameter.name, value)
                assert taken == (tuple(value) if isinstance(value, list) else value)
        for beyond in (below, above):
            for value in alone_and_in_place(parameter, kind(beyond), kind(high)):
                assert ': expected ' in refusal(parameter.name, value)


def test_the_ends_of_a_row_of_waves_are_taken_and_the_next_number_beyond_is_refused():
    row = [1.0, 5.0, 0.0, 0.0]
    for place, low, high in ((0, 0.0, 1000.0), (1, 0.01, 1e6)):
        for end, beyond in ((low, -math.inf), (high, math.inf)):
            row[place] = end
            assert checked('sea.waves', [*row, *row]) == (*row, *row)
            row[place] = float(np.nextafter(end, beyond))
            assert refusal('sea.waves', [1.0, 5.0, 0.0, 0.0, *row]).startswith(
                f'sea.waves: row 2 is {row}, expected ')
        row[place] = high


def wrong_values(parameter):
    """Return values of a wrong kind, alone and in every place of a list, and wrong lists."""
    if parameter.kind == 'bool':
        return [0, 1, 1.0, 'true', 'yes', None, [True]]
    if parameter.kind == 'string_array':
        return ['left', ['left', 'left'], [''], ['1st'], ['a b'], ['a/b'], ['_a'], [5], [True],
                [['left']], 5, None, {}]
    if parameter.kind == 'string':
        return [*[''] * (parameter.default != ''), True, 5, None, ['leapfrog'], 'no such/ word',
                '/slash', 'a\tb']
    if parameter.kind == 'path':
        return ['', ' ', True, 5, None, ['hull.stl']]
    numbers = [math.nan, math.inf, -math.inf, True, '1', 'word', None, 10 ** 400, {}]
    if parameter.kind.startswith('int'):
        numbers += [1.0, 1.5, 10 ** 30]
    values = [value for number in numbers for value in alone_and_in_place(parameter, number, 1)]
    if not parameter.kind.endswith('_array'):
        return [*values, [1], []]
    values += [True, 'word', None, {}, [[1.0], [1.0, 1.0]]]
    if 1 not in parameter.lengths:
        values += [1, 1.0]
    if parameter.lengths:
        values += [[1] * length for length in range(8) if length not in parameter.lengths]
        values.append([[1] * parameter.lengths[0]])
    return values


def test_every_wrong_value_of_every_parameter_is_refused_in_one_line_that_names_it():
    for name, parameter in PARAMETERS.items():
        for value in wrong_values(parameter):
            refusal(name, value)
    for count in (1, 2, 3, 5):
        assert f'four numbers a row, got {count} numbers' in refusal('sea.waves', [1.0] * count)


def test_every_choice_is_taken_and_a_frame_is_any_word():
    for name, parameter in PARAMETERS.items():
        if parameter.kind == 'string':
            for word in parameter.choices or ('map', 'boat/base_link', 'y'):
                assert checked(name, word) == word
            assert parameter.choices or name in (
                'world_frame', 'body_frame', 'frame_prefix', 'map_frame')
    assert checked('publish_clock', True) is True and checked('publish_clock', False) is False


def test_an_integer_for_a_double_is_taken_as_the_number():
    assert checked('boat.mass', 7) == 7.0
    assert type(checked('boat.mass', 7)) is float
    assert checked('hull.size', [4, 2, 1]) == (4.0, 2.0, 1.0)


def test_an_array_may_be_a_list_a_tuple_or_an_array():
    for value in ([1.0, 2.0, 3.0], (1, 2, 3), np.array([1.0, 2.0, 3.0]), np.array([1, 2, 3]),
                  np.array([1, 2, 3], np.float32)):
        assert checked('boat.center_of_mass', value) == (1.0, 2.0, 3.0)


def test_a_number_is_taken_for_an_array_that_may_be_of_one():
    assert checked('damping.probe', 4000) == checked('damping.probe', [4000.0]) == (4000.0,)
    assert 'expected a list of numbers, got 4000' in refusal('damping.linear', 4000)


def test_rows_of_probes_and_waves_may_stay_rows():
    rows = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
    flat = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert checked('probes.positions', rows) == checked('probes.positions', np.array(rows)) == flat
    assert checked('probes.positions', flat) == flat
    waves = [[1.0, 5.0, 0.0, 0.0], [0.5, 4.0, 1.0, 2.0]]
    assert checked('sea.waves', waves) == checked('sea.waves', np.ravel(waves))
    assert checked('sea.waves', []) == ()


def test_a_misspelt_name_gets_the_nearest_as_a_suggestion():
    for wrong, meant in (
            ('boat.mas', 'boat.mass'), ('mass', 'boat.mass'), ('boat_mass', 'boat.mass'),
            ('boat.centre_of_mass', 'boat.center_of_mass'), ('Rate', 'rate'),
            ('probe.floatiness', 'probes.floatiness'), ('floatines', 'probes.floatiness'),
            ('sea.wave', 'sea.waves'), ('hull.sizes', 'hull.size'),
            ('damping.angular_retension', 'damping.angular_retention')):
        with pytest.raises(ValueError) as raised:
            check_names([wrong])
        assert str(raised.value) == f'{wrong}: no such parameter, did you mean {meant}?'


def test_another_word_for_a_parameter_gets_the_parameter_as_a_suggestion():
    for wrong, meant in (
            ('boat.weight', 'boat.mass'), ('hull.length', 'hull.size'), ('length', 'hull.size'),
            ('boat.beam', 'hull.size'), ('wave_height', 'sea.significant_height'),
            ('sea.wave_height', 'sea.significant_height'), ('sea.Hs', 'sea.significant_height'),
            ('damping.drag', 'damping.linear'), ('probes.buoyancy', 'probes.floatiness'),
            ('boat.cog', 'boat.center_of_mass'), ('dt', 'rate'), ('wind.speed', 'wind.velocity'),
            ('hull.draft', 'boat.mass (draft follows from it and the hull)'),
            # A slip of the finger is nearer than another word.
            ('probes.weight', 'probes.weights'), ('hull.size_', 'hull.size')):
        with pytest.raises(ValueError) as raised:
            check_names([wrong])
        assert str(raised.value) == f'{wrong}: no such parameter, did you mean {meant}?'


def test_every_word_for_a_parameter_stands_for_one_that_exists_and_is_none_itself():
    assert {meant.partition(' ')[0] for meant in WORDS.values()} <= set(PARAMETERS)
    assert not set(WORDS) & set(PARAMETERS)


def test_a_name_like_no_other_gets_the_list():
    with pytest.raises(ValueError, match='xyzzy: no such parameter; expected one of rate, integ'):
        check_names(['boat.mass', 'xyzzy'])


def test_the_default_file_gives_every_default():
    given = {name: tuple(value) if isinstance(value, list) else value
             for name, value in parameter_file.read(DEFAULT).items()}
    assert given == {name: parameter.default for name, parameter in PARAMETERS.items()
                     if parameter.default is not None and not name.startswith('probes.')
                     and name != 'hull.scale'}
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
               if name.startswith(('probes.', 'thrusters.')) and name != 'probes.law'
               or name == 'sea.waves'}
    # What only another shape than the default one has.
    other = {name: shown.pop(name) for name in ('hull.spacing', 'hull.mesh', 'hull.scale')}
    assert other['hull.scale'] == PARAMETERS['hull.scale'].default
    twin = load_scene({'hull.shape': 'twin', 'hull.spacing': other['hull.spacing']})
    assert np.abs(twin.boat.hull.positions[:, 1]).min() > 0.5
    assert (DEFAULT.parent / other['hull.mesh']).exists()
    default = load_scene({})
    for name in DERIVED - set(example) - set(other):
        derived = default.values[name]
        if isinstance(derived, tuple):
            derived = pytest.approx(derived[:len(shown[name])], rel=1e-4)
        elif isinstance(derived, float):
            derived = pytest.approx(derived, rel=1e-4)
        assert shown[name] == derived
    for name in ('probes.floatiness', 'probes.stiffness'):
        assert example[name] == PARAMETERS[name].default
    shown = load_scene(example)
    assert len(shown.sea.waves) == 1
    assert [thruster.name for thruster in shown.thrusters] == ['left', 'right']
