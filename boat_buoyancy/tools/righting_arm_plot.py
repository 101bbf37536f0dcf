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

"""The picture of a boat's righting arm over heel: its model beside the hull itself."""

import matplotlib
import numpy as np

from .plot_style import figure, save, SERIES, SETTINGS
from ..physics.hydrostatics.rest import floats, rest_attitude
from ..physics.hydrostatics.righting_arm import (
    righting_arms, stability_range, surface_righting_arms)

MODEL, HULL, RIGHTED = (colour for colour, _ in SERIES[:3])
# Degrees from one point of a curve to the next.
SPACING = 1.0
# Degrees within which a boat rests upright, and rights itself alike on both sides.
UPRIGHT, ALIKE = 0.05, 0.5


def draw(path, boat, name):
    """
    Draw GZ of a `Boat` over heel into a PNG file, with where it rests and comes back from.

    0 to 180 degrees, and to port as well where the boat is not the same on both sides; ``name``
    goes into the title.  ValueError for a boat that sinks.
    """
    if not floats(boat):
        raise ValueError('--plot: expected a boat that floats, got one that sinks: it has no '
                         f'righting arm (floatiness {boat.floatiness:.6g})')
    # Where it finds no rest, no heel is one to come back to.
    rest, ends = 0.0, np.zeros(2)
    if rest_attitude(boat) is not None:
        rest, ends = np.degrees(rest_attitude(boat)[0]), np.degrees(stability_range(boat))
    alike = abs(rest) < UPRIGHT and abs(ends.sum()) < ALIKE
    start = 0.0 if alike else -180.0
    heel = np.arange(start, 180.0 + SPACING, SPACING)
    with matplotlib.rc_context(SETTINGS):
        made, ((axes,),) = figure(8.0, 4.2, 1, 1)
        axes.axhline(0.0, color='black', linewidth=0.8)
        if boat.hull.surface is not None:
            axes.plot(heel, surface_righting_arms(boat, np.radians(heel)), color=HULL,
                      linewidth=4.5, alpha=0.5, label='the hull itself')
        axes.plot(heel, righting_arms(boat, np.radians(heel)), color=MODEL,
                  label=f'as simulated ({_model(boat.hull)})')
        title = f'{name}: nothing brings it back to rest'
        if ends[0] < rest < ends[1]:
            low, high = max(ends[0], start), min(ends[1], 180.0)
            axes.axvspan(low, high, color=RIGHTED, alpha=0.12, linewidth=0.0,
                         label='comes back to rest')
            axes.plot([rest], [0.0], 'o', color='black', markersize=7, clip_on=False, zorder=3,
                      label='rests here' + ('' if alike else f' ({rest:.1f} degrees)'))
            title = (f'{name} comes back to rest from '
                     + ('up to ' if alike else f'{low:.0f} to ') + f'{high:.0f} degrees of heel')
        axes.set_title(title)
        axes.set_xlim(start, 180.0)
        axes.set_xticks(np.arange(start, 181.0, 30.0))
        axes.set_xlabel('heel (degrees, + starboard down)')
        axes.set_ylabel('righting arm GZ (m)')
        axes.legend(loc='upper center', bbox_to_anchor=(0.47, -0.15), ncols=4)
    save(made, path)


def _model(hull):
    """Return what lifts a hull, in a word or two."""
    if hull.panels is not None:
        return 'panels'
    return 'columns' if hull.law == 'column' else f'{hull.law} probes'
