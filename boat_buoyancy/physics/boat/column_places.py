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

"""Where a hull of any form gets its columns: Gauss points on its waterplane and beside it."""

import math

import numpy as np

from .cuts import chords, cuts

# Of a hull's length or breadth: a strip beside the waterplane that is narrower gets no columns.
NARROW = 0.01


def points_on_waterplane(cut, probes):
    """
    Return Gauss points on each piece of a waterplane.

    ``cut`` of the surface at the water as from `cuts`, its rows numbered by piece instead of
    plane; ``probes`` (along, across), how many on each piece: along it, and at each station across
    each half of it, or all of it where ``across`` is odd.  The number of its piece (n,), place
    (n, 2) m and area (n,) m^2 of each.
    """
    along, across = probes
    piece, start, _ = cut
    extents = [(start[piece == i, 0].min(), start[piece == i, 0].max())
               for i in range(piece.max(initial=-1) + 1)]
    x, length = _gauss(*np.reshape(extents, (-1, 2)).T, along)
    station, low, high = chords(cut, np.repeat(np.arange(len(extents)), along), x)
    if across % 2 == 0:
        # A section has its kink at the keel.
        middle = 0.5 * (low + high)
        low, high = (np.stack(ends, axis=1).ravel() for ends in ((low, middle), (middle, high)))
        station, across = np.repeat(station, 2), across // 2
    return (np.repeat(station // along, across),
            *_across(x[station], length[station], low, high, across))


def points_beside_waterplane(triangles, cut, probes):
    """
    Return Gauss points on what of a body's silhouette from above is no part of its waterplane.

    Flare, overhang, a bridge deck, a bulb: half as many stations along and points across as
    `points_on_waterplane` has, at least one each.  Place (n, 2) m and area (n,) m^2 of each.
    """
    along, across = probes
    piece, start, end = cut
    first, last = triangles[:, :, 0].min(), triangles[:, :, 0].max()
    breaks = np.unique([first, last, *(place for i in range(piece.max(initial=-1) + 1) for place in
                                       (start[piece == i, 0].min(), start[piece == i, 0].max()))])
    x, length = np.zeros((2, 0))
    for low, high in zip(breaks, breaks[1:]):
        part = (high - low) / (last - first)
        if part > NARROW:
            # A little less, so that round-off does not choose where it comes to a whole number.
            more = _gauss(low[None], high[None], math.ceil(0.5 * along * part - 1e-6))
            x, length = np.append(x, more[0]), np.append(length, more[1])
    section, *edges = cuts(triangles, 0, x)
    whole = np.zeros(len(start), int), start, end
    station, low, high = [], [], []
    for i in range(len(x)):
        strips = _strips_beside(*(ends[section == i, 0] for ends in edges),
                                *chords(whole, [0], x[i:i + 1])[1:])
        station += [i] * len(strips[0])
        low, high = np.append(low, strips[0]), np.append(high, strips[1])
    return _across(x[station], length[station], low, high, math.ceil(0.25 * across))


def _strips_beside(start, end, wet_low, wet_high):
    """
    Return the lower and the upper ends of the strips of a section beside its waterplane.

    ``start`` and ``end`` (k,) m across of the section's edges; ``wet_low`` and ``wet_high`` (m,)
    the ends of its waterplane.
    """
    low, high = np.sort([start, end], axis=0)
    order = np.argsort(low)
    low, reach = low[order], np.maximum.accumulate(high[order])
    gap = np.flatnonzero(low[1:] > reach[:-1])
    low, high = low[np.append(0, gap + 1)], reach[np.append(gap, -1)]
    breaks = np.unique(np.concatenate([low, high, wet_low, wet_high]))
    left, right = breaks[:-1], breaks[1:]
    middle = 0.5 * (left + right)[:, None]
    beside = (((low < middle) & (middle < high)).any(axis=1)
              & ~((wet_low < middle) & (middle < wet_high)).any(axis=1)
              & (right - left > NARROW * (breaks[-1] - breaks[0])))
    return left[beside], right[beside]


def _across(x, length, low, high, count):
    """Return places and areas of ``count`` points across each strip, for a length at each x."""
    y, width = _gauss(low, high, count)
    return np.column_stack([np.repeat(x, count), y]), np.repeat(length, count) * width


def _gauss(low, high, count):
    """Return places and weights (m * count,) of Gauss-Legendre points from low to high (m,)."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    half = 0.5 * (high - low)[:, None]
    return (0.5 * (low + high)[:, None] + half * nodes).ravel(), (half * weights).ravel()
