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

"""What the colours of the page mean."""

from . import drawing
from .shapes import WETNESS


def legend():
    """Return HTML that names everything that is drawn."""
    rows = ''.join(f'<div>{_mark(shape, color)} {what}</div>' for shape, color, what in (
        ('●', drawing.WEIGHT_MIDDLE, 'centre of mass'),
        ('●', drawing.LIFT_MIDDLE, 'centre of buoyancy'),
        ('↑', drawing.LIFT, 'lift of each probe'),
        ('◆', drawing.PUSH, 'thruster, or where a wrench pushes'),
        ('➜', drawing.PUSH, 'thrust'),
        ('│', (224, 49, 49), 'ahead (x), green to port (y), blue up (z)')))
    colors = ', '.join(map(_css, WETNESS))
    return (f'<div style="padding: 0 0.75em 0.5em; font-size: 0.8em; line-height: 1.5">'
            f'<div>probes: dry <span style="display: inline-block; width: 6em; height: 0.8em; '
            f'background: linear-gradient(to right, {colors})"></span> '
            f'all under water</div>{rows}</div>')


def _mark(shape, color):
    return f'<b style="color: {_css(color)}">{shape}</b>'


def _css(color):
    return f'rgb({", ".join(map(str, color))})'
