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

"""Whether a hull's probes or panels are close enough to feel the waves of its sea as they are."""

from functools import lru_cache
import math

import numpy as np

from ..boat.hull import MAX_PANELS, PANELS_A_WAVE
from ..forces.wave_force import PRESSURE, wave_decay
from ..sea.waves import KX, KY, START

# Error of the lift in waves, rms over the sea's waves in parts of their amplitude: what is told
# of, and what the advice comes to.
TOLD, WANTED = 0.15, 0.05
MOST_PROBES = 100
# Of a wave's length, what the length or the beam of a turning boat sees of it: cosines.
HEADINGS = np.linspace(0.0, 1.0, 32)

_gauss_points = lru_cache(maxsize=MOST_PROBES)(np.polynomial.legendre.leggauss)


def sampling_warnings(boat, sea, values):
    """
    Return a sentence, in a tuple, where waves pass between the probes or panels of a `Boat`.

    ``values`` {name: value}, the parameters in force.  Of waves along the length or the beam,
    whichever is worse, as a boat turns.
    """
    amplitude, hull = sea.table[START], boat.hull
    if not amplitude.any():
        return _unreached(hull)
    # In parts of all of them; first of the largest, as the squares of the smallest numbers are 0.
    amplitude = amplitude / np.abs(amplitude).max()
    amplitude /= np.sqrt(amplitude @ amplitude)
    if boat.follows_waves:
        # As the hull feels them, where it is as deep as its columns are on average.
        amplitude = amplitude * wave_decay(boat.immersion, sea.table)[:, PRESSURE].mean(axis=0)
    k = np.hypot(sea.table[KX], sea.table[KY])
    shortest = f'the shortest wave that matters is {sea.shortest_length:.3g} m long'
    if hull.panels is not None:
        too_large = _between_corners(hull, sea.shortest_length, shortest)
        if too_large or not boat.damping.probe.any():
            return too_large or _unreached(hull)
    if hull.surface is None:
        return _between_probes(hull.positions, amplitude, k, shortest)
    sizes = np.ptp(hull.surface.extent, axis=0)[:2]
    if values['hull.shape'] == 'twin':
        sizes[1] = values['hull.size'][1]
    given = values['hull.probes']
    errors = [_error(count, size, amplitude, k) for count, size in zip(given, sizes)]
    if max(errors) <= TOLD:
        return ()
    enough = [_enough(count, size, amplitude, k) for count, size in zip(given, sizes)]
    cures = [f'hull.probes: {enough}'] if None not in enough else []
    # Panels feel the lift by themselves, and by damping at the probes what moves past them.
    what, more = (('lift', []) if hull.panels is None else
                  ('pull at the probes (damping.probe)', ['damping.probe: 0.0']))
    cures += more
    return (f'The probes are too far apart for the waves: {shortest}, and with hull.probes: '
            f'{list(given)} the {what} of the waves is off by up to {max(errors):.0%} of their '
            f'amplitude (rms); take {", or ".join(cures) or "longer waves or a smaller hull"}.',)


def _unreached(hull):
    """Return the sentence for panels that are larger than was asked for."""
    if hull.panels is None or not 0.0 < hull.panel_size < hull.panels.longest_edge:
        return ()
    return (f'hull.panel_size is {hull.panel_size:g} m, and the panels have edges of up to '
            f'{hull.panels.longest_edge:.2g} m, as more panels than {MAX_PANELS} are not made; '
            'give a larger one.',)


def _between_corners(hull, length, shortest):
    """Return the sentence for panels that are too large for a wave of ``length`` m."""
    needed, longest = length / PANELS_A_WAVE, hull.panels.longest_edge
    if longest <= needed:
        return ()
    cure = (f'take hull.panel_size: {_rounded_down(needed)} or less, or 0 to have it chosen'
            if needed >= hull.finest_panel else
            f'more than {MAX_PANELS} are not made: take longer waves, a smaller hull or '
            'hull.model: columns')
    return (f'The panels are too large for the waves: {shortest} and wants edges of at most '
            f'{needed:.2g} m, and the panels have edges of up to {longest:.2g} m; {cure}.',)


def _rounded_down(value):
    """Return a number as text of two digits that stand for no more than it."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f'{math.floor(value / digit) * digit:.2g}'


def _error(count, size, amplitude, k):
    """
    Return the rms error of the lift of ``count`` Gauss columns on ``size`` m, as the amplitudes.

    A wave lifts a length L by sin(kL/2)/(kL/2) of its amplitude, and the columns by their mean.
    Of the worst heading: at a single one, too few columns may be right by chance.
    """
    half = 0.5 * size * np.outer(HEADINGS, k)
    found = np.zeros_like(half)
    for place, weight in zip(*_gauss_points(count)):
        found += 0.5 * weight * np.cos(half * place)
    away = amplitude * (found - np.sinc(half / np.pi))
    return float(np.sqrt((away ** 2).sum(axis=1).max()))


def _enough(count, size, amplitude, k):
    """Return how many columns on ``size`` m, from ``count`` on, are enough; None where none is."""
    few, enough = count - 1, MOST_PROBES
    if _error(enough, size, amplitude, k) > WANTED:
        return None
    while enough - few > 1:
        middle = (few + enough) // 2
        if _error(middle, size, amplitude, k) > WANTED:
            few = middle
        else:
            enough = middle
    return enough


def _between_probes(positions, amplitude, k, shortest):
    """Return the sentence for probes given one by one, none of them within half a wave."""
    apart = np.linalg.norm(positions[:, None, :2] - positions[None, :, :2], axis=2)
    np.fill_diagonal(apart, np.inf)
    widest = apart.min(axis=0).max()
    if not np.isfinite(widest):
        return ()
    unseen = amplitude[k * widest > np.pi]
    if unseen @ unseen <= TOLD ** 2:
        return ()
    return (f'The probes are too far apart for the waves: {shortest}, and neighbours are up to '
            f'{widest:.3g} m apart, more than half of that, so waves pass between them; add '
            'probes in between (probes.positions), or take longer waves.',)
