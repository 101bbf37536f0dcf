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

"""Part two of the chart: what springs, columns and panels make of a hull, and what they cost."""

from dataclasses import replace
import math

import numpy as np

from .accuracy import difference, Run, simulated, step_seconds
from .hull_shapes import BOX, SHAPES
from .table import Row
from ...physics.boat.boat import Boat, Damping
from ...physics.boat.clipping import level_for, submerged
from ...physics.boat.shapes import mesh_shaped
from ...physics.hydrostatics.rest import rest_state
from ...physics.hydrostatics.righting_arm import righting_arms, surface_righting_arms
from ...physics.sea.waves import Sea

PART = 'model'
DENSITY, GRAVITY = 1025.0, 9.81
# Springs and columns, so many along and so many across.
COUNTS = (2, 3, 4, 6, 8, 12)
# GZ up to just before the box's deck edge dips, and all the way round.
HEELS = np.radians(np.arange(5.0, 181.0, 5.0))
RIGHTING = {heel: f'GZ to {heel} deg' for heel in (25, 180)}
# Small enough for GM = GZ / sin(heel), large enough for its digits.
SMALL_HEEL = 1e-5
# Wavelength over the length of the box, by scene; height of waves over length; their direction.
RATIOS = {f'box in waves of {ratio:g} L': ratio for ratio in (1.0, 4.0)}
STEEPNESS, DIRECTION = 1.0 / 50.0, 0.6
# Panels on the length of a wave, and on that of the hull itself, whose error falls as the square.
PANELS_ON_WAVE, FINE = (2, 4, 8, 16), 64
# Where probe damping is taken of a hull of panels in waves; of the hull itself.
DAMPED_AT, FINELY_DAMPED_AT = (4, 4), (12, 12)
# The same step for all models, so that its own error cancels; the cost is of so many.
RATE, WAVE_DURATION = 30.0, 30.0


def design_volume(shape):
    """Return the volume in m^3 that a `Shape` displaces at its draft."""
    return submerged(shape.surfaces[-1].facets - [0.0, 0.0, shape.draft])[0]


def boat_of(shape, hull):
    """Return a `Boat` of the weight that a `Shape` displaces, with the inertia of a box."""
    volume = design_volume(shape)
    mass = DENSITY * volume
    length, beam, depth = np.square([shape.length, shape.beam, shape.depth])
    inertia = mass / 12.0 * np.array([beam + depth, length + depth, length + beam])
    damping = Damping(probe=0.6 * math.sqrt(
        DENSITY * GRAVITY * volume / shape.draft * mass))
    return Boat(mass, hull, inertia, damping, (0.0, 0.0, shape.center), GRAVITY)


def spring_boat(shape, count):
    """Return the `Boat` of a `Shape` on ``count`` x ``count`` springs."""
    return boat_of(shape, shape.springs(
        count, DENSITY * GRAVITY * shape.surfaces[-1].volume))


def column_boat(shape, probes, surface=None):
    """Return the `Boat` of a `Shape`, or of a ``surface`` near it, on (along, across) columns."""
    surface = shape.surfaces[-1] if surface is None else surface
    return boat_of(shape, mesh_shaped(surface, probes, design_volume(shape),
                                      specific_weight=DENSITY * GRAVITY))


def panelled(boat, size, sea):
    """Return a `Boat` with panels whose edges are at most ``size`` m, 0 = as a sea needs them."""
    return replace(boat, hull=replace(boat.hull, panel_size=size).panelled(sea))


def models(scene, counts):
    """Yield the name of each model and its `Run` of a scene, the hull itself in waves at last."""
    shape = next((shape for shape in SHAPES if shape.name == scene), BOX)
    ratio = RATIOS.get(scene)
    sea = Sea() if ratio is None else wave(ratio)

    def run(boat):
        return Run(scene, boat, sea, rest_state(boat), WAVE_DURATION, 0.5 * shape.length)

    for count in counts:
        yield 'springs', run(spring_boat(shape, count))
    for count in counts:
        yield 'columns', run(column_boat(shape, (count, count)))
    if ratio is None:
        for surface in shape.surfaces[:max(1, len(shape.surfaces) - 1)]:
            yield 'panels', run(panelled(column_boat(shape, (2, 2), surface), 0.0, sea))
    else:
        for count in PANELS_ON_WAVE:
            yield 'panels', run(panelled(column_boat(shape, DAMPED_AT),
                                         sea.shortest_length / count, sea))


def wave(ratio):
    """Return the `Sea` of regular waves ``ratio`` times as long as the box."""
    length = ratio * BOX.length
    period = 2.0 * math.pi / math.sqrt(GRAVITY * 2.0 * math.pi / length)
    return Sea([[0.5 * STEEPNESS * length, period, DIRECTION, 0.0]], gravity=GRAVITY)


def tasks(quick):
    """Return the arguments of `measured`, one tuple for each piece of work."""
    counts = COUNTS[:4] if quick else COUNTS
    return [(scene, counts) for scene in (*(shape.name for shape in SHAPES), *RATIOS)]


def measured(task):
    """Return the rows of one scene, without their cost."""
    scene, counts = task
    if scene in RATIOS:
        return _wave_rows(scene, counts)
    return _still_rows(scene, counts)


def costs(rows, work, repeats=5):
    """Return the rows of all tasks in ``work`` with their cost; run it on a quiet machine."""
    runs = {}
    for scene, counts in work:
        for model, run in models(scene, counts):
            runs[_key(_row(scene, model, run.boat))] = run
    seconds = step_seconds(runs, ('leapfrog',), repeats=repeats)
    return [replace(row, cpu=RATE * seconds[_key(row), 'leapfrog']) for row in rows]


def _row(scene, model, boat):
    """Return a row of a model without what is measured."""
    hull = boat.hull
    return Row(PART, scene, 'leapfrog', RATE, model, probes=len(hull.positions),
               panels=0 if hull.panels is None else len(hull.panels.triangles))


def _key(row):
    return row.scene, row.model, row.probes, row.panels


def hydrostatics(boat):
    """Return draft m, GM m and righting arms (n,) m at `HEELS` of a `Boat`."""
    arms = righting_arms(boat, np.array([SMALL_HEEL, *HEELS]))
    # The keel goes through the body origin.
    keel = boat.center_of_mass[2] - rest_state(boat).position[2]
    return keel, arms[0] / math.sin(SMALL_HEEL), arms[1:]


def exact_hydrostatics(shape):
    """Return what `hydrostatics` does, of a `Shape`'s surface by exact clipping."""
    arms = surface_righting_arms(column_boat(shape, (2, 2)), np.array([SMALL_HEEL, *HEELS]))
    depth = level_for(shape.surfaces[-1].facets, design_volume(shape))
    return depth, arms[0] / math.sin(SMALL_HEEL), arms[1:]


def _still_rows(scene, counts):
    """Return the rows of draft, GM and GZ of one hull."""
    shape = next(shape for shape in SHAPES if shape.name == scene)
    depth, height, arms = exact_hydrostatics(shape)
    rows = []
    for model, run in models(scene, counts):
        found = hydrostatics(run.boat)
        figures = [('draft', found[0] - depth, depth), ('GM', found[1] - height, abs(height))]
        for heel, quantity in RIGHTING.items():
            within = HEELS < math.radians(heel + 1)
            figures.append((quantity, math.sqrt(np.mean((found[2] - arms)[within] ** 2)),
                            np.abs(arms[within]).max()))
        rows += [replace(_row(scene, model, run.boat), quantity=quantity, error=abs(error),
                         percent=100.0 * error / whole) for quantity, error, whole in figures]
    return rows


def hull_itself(scene):
    """Return the `Run` of the hull itself in waves: of panels so fine that more change little."""
    sea = wave(RATIOS[scene])
    boat = panelled(column_boat(BOX, FINELY_DAMPED_AT), sea.shortest_length / FINE, sea)
    return Run(scene, boat, sea, rest_state(boat), WAVE_DURATION, 0.5 * BOX.length)


def _wave_rows(scene, counts):
    """Return the rows of the box's motion in waves of one length."""
    _, truth = simulated(hull_itself(scene), 'leapfrog', RATE)
    amplitude, rows = 0.5 * STEEPNESS * RATIOS[scene] * BOX.length, []
    for model, run in models(scene, counts):
        found = simulated(run, 'leapfrog', RATE)
        if found is None:
            continue
        error = difference(found[1], truth, run.length)
        rows.append(replace(_row(scene, model, run.boat), quantity='motion',
                            position=error.position, rotation=error.rotation, error=error.total,
                            percent=100.0 * error.total / amplitude))
    return rows
