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

"""Columns of a shape: probes that stand for its volume."""

import numpy as np

from .clipping import level_for, plane_moments, signed_areas, submerged
from .column_places import points_beside_waterplane, points_on_waterplane
from .cuts import chords, components, cuts
from .hull import Hull


def box_hull(size, bottom, probes, *, specific_weight, law='column'):
    """
    Return a box hull of columns at Gauss points, exact until an edge leaves the water.

    Main arguments: ``size`` (3,) length, beam, depth m; ``bottom`` z of the bottom in the body
    frame m; ``probes`` (along, across), how many columns.
    Other arguments: ``specific_weight`` rho g in N/m^3; ``law`` as in `Hull`.

    Gauss-Legendre points integrate the box's volume and first moments of the wet volume, linear
    and quadratic in place, without error from 2 x 2 columns on.
    """
    length, beam, depth = size
    (along, along_weight), (across, across_weight) = (
        np.polynomial.legendre.leggauss(count) for count in probes)
    x, y = np.meshgrid(along * length / 2, across * beam / 2, indexing='ij')
    weights = np.outer(along_weight, across_weight).ravel() / 4.0
    positions = np.stack([x.ravel(), y.ravel(), np.full(x.size, float(bottom))], axis=1)
    volume = length * beam * depth
    return Hull(positions, specific_weight * volume * weights,
                np.full(x.size, float(depth)), law, specific_weight=specific_weight)


def columns_of(surface, probes, volume):
    """
    Return columns that stand for a closed surface: bottoms (n, 3) m, areas (n,) m^2, heights (n,).

    Main arguments: ``surface`` a `Surface`; ``probes`` (along, across), how many columns for each
    piece of its waterplane; ``volume`` m^3 that it displaces level at rest.  One that sinks, as
    ``volume`` is all of it or more, is taken as half under.

    Columns stand at Gauss points on the waterplane and, fewer, beside it (flare, overhang, a
    bridge deck, a bulb); their ends are where the vertical line meets the surface.  Areas, places
    and depths are then put right.  Volume below and above the water and area of the waterplane are
    exact at any number of columns; the waterplane's first and second moments and the centre of
    buoyancy from 2 x 3 columns on for hulls as boats have them, and with those draft, trim and
    both metacentric heights.
    """
    whole = surface.volume
    level = level_for(surface.facets, volume if volume < whole else 0.5 * whole)
    displaced, moment = submerged(surface.facets - [0.0, 0.0, level])
    places, areas, bottoms, tops, on_waterplane = (np.concatenate(part) for part in zip(
        *(_columns_of_body(body, probes, level) for body in _bodies(surface, level))))
    depths, heights = level - bottoms, tops - bottoms
    wet = np.clip(depths, 0.0, heights)
    floating = on_waterplane & (wet > 0.0) & (wet < heights)
    # As much volume above the water as the surface has: in freeboard, and in width off the
    # waterplane.  As much below: in width off the waterplane, the rest in depth.
    above, below = (exact / max(areas @ found, np.finfo(float).tiny) for exact, found in (
        (whole - displaced, heights - wet), (displaced, wet)))
    areas *= np.where(floating, 1.0, np.where(depths > 0.0, below, above))
    sunk = areas * wet * ~floating
    freeboards = (heights - wet)[floating] * above
    depths[floating] = _fitted_depths(
        places[floating], areas[floating], depths[floating], displaced - sunk.sum(),
        moment[:2] - sunk @ places, sunk @ (wet - 2.0 * depths) - 2.0 * moment[2])
    heights[floating] = depths[floating] + freeboards
    real = (areas > 0.0) & (heights > 0.0)
    return np.column_stack([places, level - depths])[real], areas[real], heights[real]


def _bodies(surface, level):
    """
    Return the triangles (n, 3, 3) of each shell that is afloat, and those of the rest in one.

    Where a shell is a cavity all are one body.
    """
    shell, facets = components(surface.triangles), surface.facets
    z = facets[:, :, 2]
    if (np.bincount(shell, signed_areas(facets) * (z - level).sum(axis=1)) <= 0.0).any():
        return [facets]
    low, high = np.full((2, shell.max() + 1), [[np.inf], [-np.inf]])
    np.minimum.at(low, shell, z.min(axis=1))
    np.maximum.at(high, shell, z.max(axis=1))
    afloat = (low < level) & (level < high)
    bodies = [facets[shell == number] for number in np.flatnonzero(afloat)]
    rest = facets[~afloat[shell]]
    return [*bodies, rest] if len(rest) else bodies


def _columns_of_body(triangles, probes, level):
    """
    Return the columns of one body: places (n, 2), areas, bottoms and tops (n,), the surface's own.

    A fifth array (n,) says which of them stand on the waterplane; their places and areas are put
    right.
    """
    cut, pieces = _pieces(*cuts(triangles, 2, [level])[1:])
    number, places, areas = points_on_waterplane(cut, probes)
    beside, more_areas = points_beside_waterplane(triangles, cut, probes)
    rays = np.concatenate([places, beside])
    for i, piece in enumerate(pieces):
        mine = number == i
        places[mine], areas[mine] = _fitted_places(places[mine], areas[mine], *piece)
    places, areas = np.concatenate([places, beside]), np.concatenate([areas, more_areas])
    x, section = np.unique(rays[:, 0], return_inverse=True)
    ray, bottoms, tops = chords(cuts(triangles, 0, x), section, rays[:, 1])
    return places[ray], areas[ray], bottoms, tops, ray < len(number)


def _pieces(start, end):
    """
    Return the cut at the water, its rows numbered by piece, and what each piece of it has.

    That is area, centre (2,) and spread (2, 2), the second moment about the centre over the area.
    Where there is a hole all is one piece.
    """
    _, joints = np.unique(np.concatenate([start, end]), axis=0, return_inverse=True)
    piece = components(joints.reshape(2, -1).T)
    middle = start.sum(axis=0) / max(len(start), 1)
    fans = np.stack([np.zeros_like(start), end - middle, start - middle], axis=1)
    areas = np.bincount(piece, signed_areas(fans))
    # Corners and edges that just touch the water have none.
    real = np.abs(areas) > 1e-12 * np.abs(areas).sum()
    kept = real[piece]
    piece = (np.cumsum(real) - 1)[piece[kept]] if (areas[real] > 0.0).all() else piece[kept] * 0
    found = []
    for i in range(piece.max(initial=-1) + 1):
        area, first, second = plane_moments(fans[kept][piece == i])
        center = first / area
        found.append((area, middle + center, second / area - np.outer(center, center)))
    return (piece, start[kept], end[kept]), found


def _fitted_places(places, areas, area, center, spread):
    """
    Return places (n, 2) and areas (n,) with the area, centre and spread (2, 2) of a waterplane.

    Of all linear maps that give the spread, the one that moves the columns least (Olkin and
    Pukelsheim, Linear Algebra Appl. 48, 1982).  Where they stand in one line, along it only.
    """
    share = areas / areas.sum()
    away = places - share @ places
    values, axes = np.linalg.eigh((away.T * share) @ away)
    inside = values > 1e-12 * values[-1]
    root = (axes * np.sqrt(np.where(inside, values, 0.0))) @ axes.T
    inverse = (axes * np.where(inside, 1.0 / np.sqrt(np.where(inside, values, 1.0)), 0.0)) @ axes.T
    stretch, turned = np.linalg.eigh(root @ spread @ root)
    stretch = (turned * np.sqrt(np.clip(stretch, 0.0, None))) @ turned.T
    change = inverse @ stretch @ inverse + (axes * ~inside) @ axes.T
    return center + away @ change, share * area


def _fitted_depths(places, areas, depths, volume, first, second):
    """
    Return depths (n,) m of columns that displace a volume, with its centre.

    ``volume`` m^3, ``first`` (2,) m^4 its moments in x and y, ``second`` m^4 the integral of the
    squared depth, twice the volume's moment below the water.

    The plane through the depths that fits them best takes the place that volume and first moments
    ask for; what they deviate from it is stretched to the second.  Of the surface's own depths
    that plane and that mean square are these, so this comes to little where columns are many.
    Where it would lift a bottom out of the water, all depths grow alike, for the volume alone.
    """
    if not len(depths):
        return depths
    middle = areas @ places / areas.sum()
    basis = np.column_stack([np.ones(len(places)), places - middle])
    project = np.linalg.pinv(basis.T * areas @ basis, hermitian=True)
    plane = basis @ (project @ np.append(volume, first - volume * middle))
    rough = depths - basis @ (project @ (basis.T @ (areas * depths)))
    found, wanted = areas @ rough ** 2, second - areas @ plane ** 2
    stretch = 1.0
    if 0.0 < 0.25 * found < wanted < 4.0 * found and found > 1e-20 * second:
        stretch = np.sqrt(wanted / found)
    for changed in (plane + stretch * rough, plane + rough):
        if (changed > 0.0).all():
            return changed
    return depths * (volume / (areas @ depths))
