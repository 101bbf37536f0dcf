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

"""A tuned scene written as a parameter file."""

import math

import yaml

from ...physics.scene.parameters import PARAMETERS
from ...physics.scene.scene import scene_from_values


def scene_text(name, given, at_start):
    """
    Return the text of a parameter file that makes the same scene.

    ``name`` of the scene it began as; ``given`` {name: value} and ``at_start``, what was given
    then.  What is at its default is left out, and what differs from the beginning says so.
    """
    wanted = {key: value for key, value in given.items() if value != PARAMETERS[key].default}
    # Some defaults depend on what else is given: then all that was given stays.
    if scene_from_values(wanted).values != scene_from_values(given).values:
        wanted = given
    lines = [f'# {name}, tuned in buoyancy_view.', '/**:', '  ros__parameters:']
    group = None
    for key in PARAMETERS:
        before = at_start.get(key, PARAMETERS[key].default)
        if key not in wanted:
            continue
        prefix, _, last = key.rpartition('.')
        if prefix != group:
            lines += [f'    {prefix}:'] if prefix else []
            group = prefix
        tuned = '' if wanted[key] == before else f'  # was {_before(key, at_start)}'
        lines.append(f'    {"  " if prefix else ""}{last}: {_written(wanted[key])}{tuned}')
    gone = [key for key in PARAMETERS if key in at_start and key not in wanted
            and given.get(key, PARAMETERS[key].default) != at_start[key]]
    lines += [f'    # {key} is left out, was {_written(at_start[key])}' for key in gone]
    return '\n'.join(lines) + '\n'


def _before(key, at_start):
    value = at_start.get(key, PARAMETERS[key].default)
    return 'left out' if value is None else _written(value)


def _written(value):
    """Return a value as YAML in one line."""
    value = list(value) if isinstance(value, tuple) else value
    return yaml.safe_dump(value, default_flow_style=True, width=math.inf).splitlines()[0]
