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

"""The knobs: which parameters have one, how far it goes, and what turning it asks for."""

from dataclasses import dataclass
import math

import numpy as np

from ...physics.scene.parameters import PARAMETERS

# A knob of a quantity that is never negative goes from a part of its value to a multiple.
LEAST, MOST = 0.2, 4.0
# Where there is nothing to take a multiple of, how far a knob goes.
REACH = {'damping.linear_retention': 1.0, 'damping.angular_retention': 1.0,
         'sea.direction': math.pi, 'sea.current': 3.0, 'wind.velocity': 15.0}
# A regular wave: amplitude m, period s, direction rad, phase rad, where there is none yet.
CALM = (0.0, 4.0, 0.0, 0.0)
WAVE = (('wave amplitude', 'm', 0.0, 2.0, 0.02), ('wave period', 's', 1.0, 12.0, 0.1),
        ('wave direction', 'rad', -3.14, 3.14, 0.02))
AXES = {2: 'xy', 3: 'xyz', 6: ('x', 'y', 'z', 'xy', 'xz', 'yz')}
BODY_AXES = {'damping.linear_retention': ('surge', 'sway', 'heave'),
             'damping.angular_retention': ('roll', 'pitch', 'yaw')}
GROUPS = {
    'Boat': ('probes.floatiness', 'probes.stiffness', 'boat.mass', 'boat.center_of_mass',
             'boat.inertia'),
    'Damping': ('damping.probe', 'damping.linear_retention', 'damping.angular_retention'),
    'Sea': ('sea.sea_state', 'sea.direction', 'sea.waves', 'sea.current', 'wind.velocity')}
# Those whose last word alone says too little.
WHOLE_NAMES = ('damping.probe', 'wind.velocity')
# A click of the trim cross: part of a probe's weight, or of the size of the hull.
TRIM, TRIM_WEIGHT = 0.02, 0.1
# Which end goes down, in body axes.
DOWN = {'bow': (1.0, 0.0), 'stern': (-1.0, 0.0), 'port': (0.0, 1.0), 'starboard': (0.0, -1.0)}


@dataclass(frozen=True)
class Knob:
    """
    A knob of one number of a parameter.

    ``name`` of the parameter, ``index`` of the number in it or None; ``label`` with its unit;
    ``low``, ``high`` and ``step`` of the slider, integers for an integer.
    """

    name: str
    index: int | None
    label: str
    low: float
    high: float
    step: float

    @property
    def hint(self):
        """Return the parameter, what it means and its range."""
        return f'{self.name}: {meaning(self.name)}'

    def value(self, scene):
        """Return the number in force in a `Scene`."""
        value = scene.values[self.name]
        if self.name == 'sea.waves':
            value = value or CALM
        return value if self.index is None else value[self.index]

    def request(self, scene, value):
        """Return {name: value} that turning the knob to a number asks for."""
        if self.index is None:
            return {self.name: value}
        whole = list(scene.values[self.name] or CALM)
        whole[self.index] = float(value)
        return {self.name: whole}


def meaning(name):
    """Return what a parameter is, its unit and its range, in words."""
    parameter = PARAMETERS[name]
    words = [parameter.description]
    if parameter.unit not in ('', '-'):
        words.append(f'Unit {parameter.unit}.')
    if parameter.choices:
        words.append(f'One of {", ".join(parameter.choices)}.')
    bounds = [f'{sign} {bound:g}' for sign, bound in (
        ('>', parameter.above), ('≥', parameter.at_least), ('≤', parameter.at_most))
        if bound is not None]
    if bounds:
        words.append(f'Range {", ".join(bounds)}.')
    return ' '.join(words)


def knobs(scene):
    """Return {group: [`Knob`]} of what there is to tune of a `Scene`."""
    return {group: [knob for name in names if name in scene.values
                    for knob in _of(name, scene)] for group, names in GROUPS.items()}


def turned(scene):
    """Return [(name, index)] of all numbers that have a knob: of how many changes with a value."""
    return [(knob.name, knob.index) for group in knobs(scene).values() for knob in group]


def _of(name, scene):
    """Yield the knobs of a parameter."""
    parameter, value = PARAMETERS[name], scene.values[name]
    last, unit = (name if name in WHOLE_NAMES else name.rpartition('.')[2]), parameter.unit
    last = last.replace('_', ' ').replace('.', ' ')
    if name == 'sea.waves':
        for index, (label, unit, low, high, step) in enumerate(WAVE):
            most = max(high, 2.0 * (value or CALM)[index])
            yield Knob(name, index, f'{label} ({unit})', low, most, step)
    elif parameter.kind == 'int':
        yield Knob(name, None, last, parameter.at_least, parameter.at_most, 1)
    elif parameter.kind == 'float':
        yield Knob(name, None, _labelled(last, unit), *_reach(name, value))
    else:
        axes = BODY_AXES.get(name, AXES.get(len(value), ()))
        for index, number in enumerate(value):
            if name == 'boat.inertia' and index > 2:
                continue
            axis = f' {axes[index]}' if len(value) > 1 else ''
            size = scene.boat.size if name == 'boat.center_of_mass' else None
            yield Knob(name, index, _labelled(last + axis, unit), *_reach(name, number, size))


def _labelled(label, unit):
    return label if unit in ('', '-') else f'{label} ({unit})'


def _reach(name, value, size=None):
    """Return least and greatest value and step of a slider about ``value``."""
    parameter = PARAMETERS[name]
    if name.endswith('retention'):
        return 0.01, 1.0, 0.01
    far = REACH.get(name, size)
    if far is not None:
        far = max(far, 1.5 * abs(value))
        step = _rounded(far / 200.0)
        far = math.ceil(far / step) * step
        return -far, far, step
    if value == 0.0:
        # Nothing to take a multiple of: the damping of a boat that has none.
        return 0.0, 1e4, 100.0
    step = _rounded(value / 100.0)
    low = 0.0 if parameter.at_least == 0.0 else math.ceil(LEAST * value / step) * step
    return low, math.ceil(MOST * value / step) * step, step


def _rounded(value):
    """Return the power of ten at or below a number."""
    return 10.0 ** math.floor(math.log10(value))


def trimmed(scene, end):
    """
    Return {name: value} that lets an ``end`` of `DOWN` sink a little; 'level' undoes all of it.

    By the weights of the probes, and where the hull has a shape by the centre of mass.
    """
    by_weights = 'probes.weights' in scene.values
    if end == 'level':
        return {'probes.weights' if by_weights else 'boat.center_of_mass': None}
    towards = np.array(DOWN[end])
    positions = scene.boat.hull.positions[:, :2]
    if not by_weights:
        x, y, z = scene.values['boat.center_of_mass']
        low, high = scene.boat.hull.surface.extent
        x, y = (x, y) + TRIM * towards * (high - low)[:2]
        return {'boat.center_of_mass': [float(x), float(y), z]}
    along = (positions - positions.mean(axis=0)) @ towards
    along /= np.abs(along).max() or 1.0
    weights = np.array(scene.values['probes.weights']) * (1.0 - TRIM_WEIGHT * along)
    return {'probes.weights': weights.tolist()}
