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
Print doc/parameters.md: ``python -m boat_buoyancy.tools.parameter_table > doc/parameters.md``.

All that the page says of a parameter is written in ``physics/scene/parameters.py``.
"""

from ..physics.scene.parameters import PARAMETERS

INTRODUCTION = """\
# Parameters

One parameter file serves the node (`--params-file`), the command-line tools and the library.
`config/default.yaml` lists every parameter with its default and is a good file to copy from.
This page is generated: `python -m boat_buoyancy.tools.parameter_table > doc/parameters.md`.

- Write numbers as `50` or `50.0`. Within one list, give all of them a decimal point or none.
- Spellings that ROS and YAML read differently (`1e3`: write `1.0e+3`) or that are easily misread
  (`010`, `yes`) are refused in one line, and so are unknown names, wrong lengths and NaN.
- Give `hull.*` (a shape, from whose size probes, floatiness and stiffness follow) or `probes.*`
  (points of your own), not both. With neither, the boat is the default box.
- Parameters marked ◦ can be changed while the node runs, with `ros2 param set`; a change is taken
  as a whole or refused as a whole. `ros2 param delete` restores the value the node started with.
- `ros2 param dump` writes a file that starts the same boat, for a node of the same name and
  namespace; put `/**:` at its top to make it fit any node. Waves that arrived as messages are not
  parameters and are not in it. Derived values, such as the inertia, are in it as numbers.
- A default of – means that the parameter is left out; the last column says what then holds.
- Angles are in radians; body axes are x forward, y left, z up
  ([frames and signs](ros.md#frames-and-signs)).

"""
HEAD = """\
| parameter | default | unit | range | meaning |
|---|---|---|---|---|
"""


def page():
    """Return the text of doc/parameters.md."""
    return INTRODUCTION + HEAD + ''.join(map(_row, PARAMETERS.values()))


def _row(parameter):
    mark = '' if parameter.read_only else ' ◦'
    return (f'| `{parameter.name}`{mark} | {_shown(parameter.default)} | {parameter.unit} '
            f'| {_range(parameter)} | {parameter.description} |\n')


def _shown(value):
    if value is None:
        return '–'
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return '[' + ', '.join(map(_shown, value)) + ']'
    return str(value)


def _range(parameter):
    bounds = [f'{sign} {limit:g}' for sign, limit in (
        ('>', parameter.above), ('≥', parameter.at_least), ('≤', parameter.at_most))
        if limit is not None]
    words = [', '.join(bounds or parameter.choices)]
    if parameter.lengths:
        words.append(' or '.join(map(str, parameter.lengths)) + ' numbers')
    return '; '.join(filter(None, words))


if __name__ == '__main__':
    print(page(), end='')
