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

import numpy as np

from ..boat.hull import PANELS_A_WAVE
from ..sea.waves import KX, KY, START

# Error of the lift in waves, rms over the sea's waves in parts of their amplitude: what is told
# of, and what the advice comes to.
TOLD, WANTED = 0.15, 0.05
MOST_PROBES = 100


def sampling_warnings(boat, sea, values):
    """
    Return a sentence, in a tuple, where waves pass between the probes or panels of a `Boat`.

    ``values`` {name: value}, the parameters in force.  Of waves along the length or the beam,
    whichever is worse, as a boat turns.
    """
    amplitude = sea.table[START]
    if not amplitude.any():
        return ()
    k = np.hypot(sea.table[KX], sea.table[KY])
    shortest = f'the shortest wave that matters is {sea.shortest_length:.3g} m long'
    hull = boat.hull
    if hull.panels is not None:
        needed = sea.shortest_length / PANELS_A_WAVE
        if hull.panel_size <= needed:
            return ()
        return (f'The panels are too large for the waves: {shortest}, and hull.panel_size is '
                f'{hull.panel_size:g} m; take {needed:.2g} m or less, or 0 to have it chosen.',)
    if hull.surface is None:
        return _between_probes(hull.positions, amplitude, k, shortest)
    sizes = np.ptp(hull.surface.extent, axis=0)[:2]
    if values['hull.shape'] == 'twin':
        sizes[1] = values['hull.size'][1]
    given = values['hull.probes']
    errors = [_error(count, size, amplitude, k) for count, size in zip(given, sizes)]
    if max(errors) <= TOLD:
        return ()
    enough = [max(count, _enough(size, amplitude, k)) for count, size in zip(given, sizes)]
    return (f'The probes are too far apart for the waves: {shortest}, and with hull.probes '
            f'{list(given)} the lift is wrong by {max(errors):.0%} of the amplitude (rms); take '
            f'hull.probes: {enough}, or hull.model: panels.',)


def _error(count, size, amplitude, k):
    """
    Return the rms error of the lift of ``count`` Gauss columns on ``size`` m, by amplitude.

    A wave lifts a length L by sin(kL/2)/(kL/2) of its amplitude, and the columns by their mean.
    """
    half = 0.5 * size * k
    places, weights = np.polynomial.legendre.leggauss(count)
    found = np.cos(np.outer(half, places)) @ weights / 2.0
    away = found - np.sinc(half / np.pi)
    return float(np.sqrt((amplitude * away) @ (amplitude * away) / (amplitude @ amplitude)))


def _enough(size, amplitude, k):
    """Return how many columns on ``size`` m it takes, at most `MOST_PROBES`."""
    return next((count for count in range(1, MOST_PROBES)
                 if _error(count, size, amplitude, k) <= WANTED), MOST_PROBES)


def _between_probes(positions, amplitude, k, shortest):
    """Return the sentence for probes given one by one, none of them within half a wave."""
    apart = np.linalg.norm(positions[:, None, :2] - positions[None, :, :2], axis=2)
    np.fill_diagonal(apart, np.inf)
    widest = apart.min(axis=0).max()
    if not np.isfinite(widest):
        return ()
    unseen = amplitude[k * widest > np.pi]
    if unseen @ unseen <= TOLD ** 2 * (amplitude @ amplitude):
        return ()
    return (f'The probes are too far apart for the waves: {shortest}, and neighbours are up to '
            f'{widest:.3g} m apart, more than half of that, so waves pass between them; add '
            'probes in between (probes.positions).',)
