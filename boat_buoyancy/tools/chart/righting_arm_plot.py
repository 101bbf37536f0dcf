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

"""The picture of righting arms: how each model of a box's hull turns it, at any heel."""

import matplotlib
import numpy as np

from ..plot_style import figure, save, SERIES, SETTINGS
from ...physics.hydrostatics.righting_arm import righting_arms, surface_righting_arms
from ...physics.scene.scene import load_scene

NAME = 'righting_arm.png'
# Both sides of 90 degrees, where columns jump.
HEELS = np.concatenate([np.arange(0.0, 90.0), [90.0 - 1e-6, 90.0 + 1e-6],
                        np.arange(91.0, 181.0)])


def models():
    """Return {name: `Boat`}, the default box on springs, on columns and on panels."""
    box = load_scene({})
    (length, beam, depth), bottom = box.values['hull.size'], box.values['hull.bottom']
    corners = [[x, y, bottom] for x in (-length / 2, length / 2) for y in (-beam / 2, beam / 2)]
    springs = load_scene({'probes.positions': np.ravel(corners).tolist(),
                          'probes.floatiness': box.boat.floatiness,
                          'probes.stiffness': 1.0 / depth})
    return {'four springs on the corners, as in games': springs.boat, 'four columns': box.boat,
            'twelve panels': load_scene({'hull.model': 'panels'}).boat}


@matplotlib.rc_context(SETTINGS)
def draw(path):
    """Draw GZ over heel of every model, and that of the surface by exact clipping."""
    made, panels = figure(9.0, 4.0, 1, 1)
    axes, (springs, columns, surface) = panels[0][0], models().items()
    axes.axhline(0.0, color='black', linewidth=0.8)
    axes.plot(HEELS, surface_righting_arms(surface[1], np.radians(HEELS)), color='black',
              linewidth=6.0, alpha=0.25, label='exact')
    for (name, boat), (colour, _), style in zip(
            (surface, columns, springs), (SERIES[2], SERIES[0], SERIES[1]), ('-', '--', ':')):
        axes.plot(HEELS, righting_arms(boat, np.radians(HEELS)), style, color=colour, label=name,
                  linewidth=2.0)
    axes.annotate('columns: it comes to rest on its side,\nwhere no such box does', (90.0, 0.0),
                  xytext=(112.0, 0.42), fontsize=9.5, color=SERIES[0][0],
                  arrowprops={'arrowstyle': '->', 'color': SERIES[0][0]})
    axes.set(xlim=(0.0, 180.0), xticks=range(0, 181, 30), xlabel='heel [°]',
             ylabel='righting arm GZ [m]', title='Which way the water turns a heeled box: above 0 '
             'back upright, below 0 upside down')
    axes.legend(loc='lower left')
    save(made, path)
