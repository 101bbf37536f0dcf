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

"""Part four of the chart: models of hulls in waves, held against a boundary element method."""

from dataclasses import replace
from importlib.resources import files
import json
import math

import numpy as np

from .accuracy import Run, step_seconds
from .processes import results
from .settings import hull_values
from .table import Row
from ..command_line import shipped_scenes
from ...physics.hydrostatics.rest import rest_state
from ...physics.scene.scene import load_scene, scene_from_values
from ...physics.sea.waves import Sea

PART = 'waves'
# The hulls that have a table in ``responses``, and the scenes they are.
HULLS = {'box': 'default', 'barge': 'barge', 'wigley': 'wigley'}
MOTIONS = ('heave', 'roll', 'pitch')
# Models of a hull, with probes along and across; and the one whose parts are told apart.
MODELS = (('springs', (2, 2)), ('columns', (2, 2)), ('springs', (6, 4)), ('columns', (6, 4)),
          ('panels', (6, 4)))
PARTED = 'columns', (6, 4)
# What of `whole` a scene has: nothing, all of it, or for some columns one parameter alone.
NONE, ALL, ALONE = 'none', 'all', ('added_mass', 'wave_force')
# Waves of these periods in s are compared; by length over that of the hull apart.
PERIODS, LONG = (2.0, 12.0), 4.0
LONG_WAVES = ' in long waves'
QUICK_PERIODS = (2.0, 4.0, 7.0, 12.0)
# m, so small that all is linear.  A motion has settled after so many s, within half a per cent
# with a twentieth of critical damping in the slowest roll, and is read from so many periods.
AMPLITUDE, SETTLED, READ = 0.01, 120.0, 8
RATE = 30.0
# The wave in which a step's cost is taken: period s, heading degrees.
COST_WAVE = (4.0, 45)


def judge(hull):
    """Return the table of a hull by the boundary element method, as of `wave_responses.table`."""
    return json.loads((files(__package__) / 'responses' / f'{hull}.json').read_text('utf-8'))


def whole(hull):
    """Return the three parameters {name: value} of a hull in waves, from its table."""
    table = judge(hull)
    damping = list(table['radiation_damping'])
    damping[3] += table['viscous_roll']
    return {'added_mass': table['added_mass'], 'damping.linear': damping,
            'wave_force': 'froude_krylov'}


def parameters(hull, model, probes, parts):
    """
    Return the parameters of a scene {name: value}: a hull on one model, with what is in ``parts``.

    Springs are points given one by one, as games place them: spread over the hull's bottom with
    its corners among them, with the hull's budget, full at its depth.
    """
    given = _shape(hull)
    if model == 'springs':
        given = _on_springs(scene_from_values(given).boat, probes)
    else:
        given |= hull_values(probes, 0.0 if model == 'panels' else None)
    return given | {name: value for name, value in whole(hull).items() if parts in (ALL, name)}


def _shape(hull):
    """Return the parameters {name: value} that give a hull its shape and its weight."""
    path = {path.stem: path for path in shipped_scenes()}[HULLS[hull]]
    return {name: value for name, value in load_scene(path).given.items()
            if name.startswith(('boat.', 'hull.', 'water_density'))}


def _on_springs(boat, count):
    """Return the parameters of a boat on (along, across) springs in place of its hull."""
    corners = boat.hull.surface.facets.reshape(-1, 3)
    low, high = corners.min(axis=0), corners.max(axis=0)
    x, y = (grid.ravel() for grid in np.meshgrid(
        *(np.linspace(low[i], high[i], count[i]) for i in range(2))))
    inertia = boat.inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    return {'boat.mass': boat.mass, 'boat.center_of_mass': boat.center_of_mass.tolist(),
            'boat.inertia': inertia.tolist(),
            'probes.positions': np.stack([x, y, np.full_like(x, low[2])], axis=1).ravel().tolist(),
            'probes.floatiness': boat.floatiness, 'probes.stiffness': 1.0 / (high[2] - low[2])}


def run(boat, period, heading):
    """Return the `Run` of a boat from rest in a wave of a period s to a heading in degrees."""
    sea = Sea([[AMPLITUDE, period, math.radians(heading), 0.0]], gravity=boat.gravity)
    return Run(PART, boat.on(sea), sea, rest_state(boat), SETTLED + READ * period)


def response(boat, period, heading):
    """
    Return (3,): heave over the amplitude of a wave, roll and pitch over its slope.

    By least squares of a sinusoid, beside a constant and a drift, to what the node would publish.
    """
    of_run = run(boat, period, heading)
    done = of_run.simulation('leapfrog', RATE).run(of_run.duration)
    late = done.time > SETTLED
    omega, time = 2.0 * math.pi / period, done.time[late]
    basis = np.stack([np.cos(omega * time), np.sin(omega * time), np.ones_like(time),
                      time - SETTLED], axis=1)
    motion = np.stack([done.position[:, 2], done.roll, done.pitch], axis=1)[late]
    cosine, sine, *_ = np.linalg.lstsq(basis, motion, rcond=None)[0]
    slope = omega ** 2 / boat.gravity
    return np.hypot(cosine, sine) / AMPLITUDE / [1.0, slope, slope]


def cases():
    """Return (hull, model, probes, parts) of all that is compared."""
    return [(hull, *model, parts) for hull in HULLS for model in MODELS
            for parts in (NONE, ALL, *(ALONE if model == PARTED else ()))]


def measured(task):
    """Return the rows of one of `cases`, with True for few periods, without their cost."""
    *case, quick = task
    boat = scene_from_values(parameters(*case)).boat
    answers = [(period, heading, np.subtract(response(boat, period, heading), answer[:3]))
               for period, heading, *answer in judge(case[0])['rows']
               if (period in QUICK_PERIODS if quick else PERIODS[0] <= period <= PERIODS[1])]
    length = np.ptp(scene_from_values(_shape(case[0])).boat.hull.surface.facets[..., 0])
    rows = []
    for where, answers in (('', answers), (LONG_WAVES, [
            answer for answer in answers
            if boat.gravity * answer[0] ** 2 / (2.0 * math.pi) >= LONG * length])):
        errors = np.sqrt(np.mean([np.square(error) for *_, error in answers], axis=0))
        rows += [replace(_row(case, boat), quantity=f'{motion}{where}', percent=100.0 * error)
                 for motion, error in zip(MOTIONS, errors.tolist())]
    return rows


def _row(case, boat):
    """Return a row of one of `cases` without what is measured."""
    hull, model, probes, parts = case
    panels = run(boat, *COST_WAVE).boat.hull.panels
    return Row(PART, hull, 'leapfrog', RATE, model, probes[0] * probes[1],
               0 if panels is None else len(panels.triangles), '{}x{}'.format(*probes),
               parts=parts)


def measure(quick, progress):
    """Return the rows of all `cases`, errors first, then costs on a machine quiet again."""
    work = [(measured, (*case, quick)) for case in cases()]
    rows = [row for *_, found in results(work, progress, 'responses') for row in found]
    progress('times: models of hulls in a wave')
    seconds = step_seconds({_key(_row(case, boat)): run(boat, *COST_WAVE) for case in cases()
                            for boat in [scene_from_values(parameters(*case)).boat]},
                           ('leapfrog',), repeats=3 if quick else 9)
    return [replace(row, cpu=RATE * seconds[_key(row), 'leapfrog']) for row in rows]


def _key(row):
    return row.scene, row.model, row.grid, row.parts
