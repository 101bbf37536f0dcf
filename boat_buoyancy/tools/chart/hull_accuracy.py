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

"""Part two of the chart: what probes make of a hull, beside the hull itself clipped exactly."""

from dataclasses import replace
import math

import numpy as np

from .accuracy import difference, Run, simulated
from .hull_shapes import BOX, PLACEMENTS, SHAPES
from .table import Row
from ...physics.boat.boat import Boat, Damping
from ...physics.boat.clipping import level_for, submerged
from ...physics.hydrostatics.rest import rest_state
from ...physics.hydrostatics.righting_arm import righting_arms
from ...physics.sea.waves import Sea

PART = 'model'
DENSITY, GRAVITY = 1025.0, 9.81
LAWS = ('column', 'spring')
COUNTS = (2, 3, 4, 6, 8, 12)
# GZ up to just before the box's deck edge dips, and far beyond.
SMALL_HEELS, LARGE_HEELS = 25.0, 50.0
HEELS = np.radians(np.arange(5.0, LARGE_HEELS + 1.0, 5.0))
GZ_SMALL, GZ_LARGE = f'GZ to {SMALL_HEELS:g} deg', f'GZ to {LARGE_HEELS:g} deg'
# Small enough for GM = GZ / sin(heel), large enough for its digits.
SMALL_HEEL = 1e-5
# The hull itself in waves: columns enough that more change nothing that is drawn.
FINE = 20
# Wavelength over the barge's length; height of the waves over their length; their direction.
WAVELENGTHS = (0.5, 1.0, 2.0, 4.0)
STEEPNESS, DIRECTION = 1.0 / 50.0, 0.6
# The same step for probes and hull, so that its own error cancels.
WAVE_RATE, WAVE_DURATION = 30.0, 30.0


def hydrostatics_of_surface(shape):
    """
    Return draft m, GM m and righting arms (n,) m at `HEELS` of a `Shape`, by exact clipping.

    It weighs what it displaces at its draft; trim 0, free to rise.
    """
    triangles = shape.surface()
    volume = design_volume(shape)
    draft = level_for(triangles, volume)
    arms = [righting_arm(triangles, shape.center, volume, heel) for heel in (SMALL_HEEL, *HEELS)]
    return draft, arms[0] / math.sin(SMALL_HEEL), np.array(arms[1:])


def design_volume(shape):
    """Return the volume in m^3 that a `Shape` displaces at its draft."""
    return submerged(shape.surface() - [0.0, 0.0, shape.draft])[0]


def righting_arm(triangles, center, volume, heel):
    """
    Return the righting arm in m of a surface (n, 3, 3) m that displaces ``volume`` m^3.

    ``center`` m, the centre of mass above the origin; ``heel`` rad.
    """
    c, s = math.cos(heel), math.sin(heel)
    turned = (triangles - [0.0, 0.0, center]) @ np.array(
        [[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])
    wet, moment = submerged(turned - [0.0, 0.0, level_for(turned, volume)])
    return -moment[1] / wet


def boat_of(shape, hull, volume):
    """Return a `Boat` of the weight that a `Shape` displaces, with the inertia of a box."""
    mass = DENSITY * volume
    length, beam, depth = np.square([shape.length, shape.beam, shape.depth])
    inertia = mass / 12.0 * np.array([beam + depth, length + depth, length + beam])
    damping = Damping(probe=0.6 * math.sqrt(
        DENSITY * GRAVITY * volume / shape.draft * mass))
    return Boat(mass, hull, inertia, damping, (0.0, 0.0, shape.center), GRAVITY)


def probe_boat(shape, volume, count, placement='gauss', law='column'):
    """Return the `Boat` of a `Shape` on ``count`` x ``count`` probes."""
    return boat_of(shape, shape.hull(count, placement, law, specific_weight=DENSITY * GRAVITY),
                   volume)


def hydrostatics_of_probes(boat):
    """Return draft m, GM m and righting arms (n,) m at `HEELS` of a `Boat`."""
    draft = boat.center_of_mass[2] - rest_state(boat).position[2]
    arms = righting_arms(boat, np.concatenate([[SMALL_HEEL], HEELS]))
    return draft, arms[0] / math.sin(SMALL_HEEL), arms[1:]


def tasks(quick):
    """Return the arguments of `measured`, one tuple for each piece of work."""
    counts = COUNTS[:3] if quick else COUNTS
    return ([('still', shape.name, counts) for shape in SHAPES]
            + [('waves', ratio, counts) for ratio in (WAVELENGTHS[1:3] if quick
                                                      else WAVELENGTHS)])


def measured(task):
    """Return the rows of one hull in still water, or of the barge in one length of waves."""
    kind, what, counts = task
    if kind == 'waves':
        return _wave_rows(what, counts)
    return _still_rows(next(shape for shape in SHAPES if shape.name == what), counts)


def _cases(counts):
    return [(count, placement, law) for law in LAWS for placement in PLACEMENTS
            for count in counts]


def _still_rows(shape, counts):
    """Return the rows of draft, GM and GZ of one hull."""
    draft, height, arms = hydrostatics_of_surface(shape)
    volume, rows = design_volume(shape), []
    small = np.degrees(HEELS) < SMALL_HEELS + 1.0
    for count, placement, law in _cases(counts):
        boat = probe_boat(shape, volume, count, placement, law)
        row = Row(PART, shape.name, probes=len(boat.hull.positions), placement=placement, law=law)
        found = hydrostatics_of_probes(boat)
        away = found[2] - arms
        rows += [replace(row, quantity=quantity, error=abs(error), percent=100.0 * error / whole)
                 for quantity, error, whole in (
                     ('draft', float(found[0] - draft), draft),
                     ('GM', float(found[1] - height), abs(height)),
                     (GZ_SMALL, _rms(away[small]), np.abs(arms[small]).max()),
                     (GZ_LARGE, _rms(away), np.abs(arms).max()))]
    return rows


def _rms(values):
    return float(np.sqrt(np.mean(values ** 2)))


def wave_run(boat, wavelength):
    """Return the `Run` of a boat of the barge's shape in regular waves of ``wavelength`` m."""
    period = 2.0 * math.pi / math.sqrt(GRAVITY * 2.0 * math.pi / wavelength)
    sea = Sea([[0.5 * STEEPNESS * wavelength, period, DIRECTION, 0.0]])
    return Run('barge in waves', boat, sea, rest_state(boat), WAVE_DURATION, 0.5 * BOX.length)


def _wave_rows(ratio, counts):
    """Return the rows of the barge's motion in waves of one length."""
    volume, wavelength = design_volume(BOX), ratio * BOX.length

    def motion(*case):
        run = wave_run(probe_boat(BOX, volume, *case), wavelength)
        return simulated(run, 'leapfrog', WAVE_RATE)

    _, truth = motion(FINE)
    amplitude, rows = 0.5 * STEEPNESS * wavelength, []
    for count, placement, law in _cases(counts):
        found = motion(count, placement, law)
        if found is None:
            continue
        error = difference(found[1], truth, 0.5 * BOX.length)
        rows.append(Row(PART, 'barge in waves', 'leapfrog', WAVE_RATE, count * count, placement,
                        law, f'wavelength {ratio:g} lengths', position=error.position,
                        rotation=error.rotation, error=error.total,
                        percent=100.0 * error.total / amplitude))
    return rows
