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

"""
Print what a boat will do before it does it: ``buoyancy_report SCENE [--json]``.

Draft, stability, periods, steps and righting arms of a parameter file's boat, in still water.
"""

import json
import sys
import textwrap

import numpy as np

from . import command_line
from ..physics.compiled import expected_kind
from ..physics.hydrostatics.metacentric_height import metacentric_heights
from ..physics.hydrostatics.natural_modes import MODES, modes
from ..physics.hydrostatics.rest import draft, floats, rest_state
from ..physics.hydrostatics.righting_arm import righting_arms, wall_sided_heel
from ..physics.scene.scene import load_scene
from ..physics.step_size.limits import max_stable_steps

PROGRAM = 'buoyancy_report'
HEEL_DEGREES = np.arange(0.0, 181.0, 5.0)
TABLE_COLUMNS = 10
# A righting arm in m below which there is none.
ROUND_OFF = 1e-9


def figures(scene):
    """
    Return what ``--json`` prints of a `Scene`: names with their units, to numbers or None.

    None stands for what does not exist: the draft of a boat that sinks, the period of what does
    not oscillate, the limit of an integrator without one.
    """
    boat, plan = scene.boat, scene.plan()
    floating = floats(boat)
    transverse, longitudinal = metacentric_heights(boat)
    motions = modes(boat) if floating else {}
    arms = righting_arms(boat, np.radians(HEEL_DEGREES))
    return {
        'draft_m': draft(boat, rest_state(boat)) if floating else None,
        'floatiness': boat.floatiness,
        # A boat that sinks displaces its whole hull, which is less than its mass.
        'displacement_kg': boat.mass * min(1.0, boat.floatiness),
        'gm_transverse_m': transverse,
        'gm_longitudinal_m': longitudinal,
        **{f'{name}_period_s': motions[name].period if floating else None for name in MODES},
        **{f'{name}_damping_ratio': motions[name].damping_ratio if floating else None
           for name in MODES},
        'max_stable_step_s': max_stable_steps(boat),
        'substeps': plan.substeps,
        'warnings': [*scene.warnings, *plan.warnings],
        'gz_heel_deg': HEEL_DEGREES.tolist(),
        'gz_m': [None if np.isnan(arm) else arm + 0.0 for arm in arms.tolist()],
        'gz_exact_to_deg': exact_heel_degrees(scene),
        'step': expected_kind()}


def exact_heel_degrees(scene):
    """Return up to which heel in degrees GZ is the real box's; None for any other hull."""
    values, boat = scene.values, scene.boat
    if values.get('hull.shape') != 'box' or not floats(boat):
        return None
    # One column across, or a law without columns, has no waterplane to heel with.
    if values['hull.probes'][1] < 2 or values['probes.law'] != 'column':
        return None
    _, beam, depth = values['hull.size']
    return float(np.degrees(wall_sided_heel(beam, depth, depth / boat.floatiness)))


def text(source, scene, result):
    """Return the figures as lines for a person; ``source`` is the name of the scene's file."""
    return '\n'.join([
        f'{source}: {scene.boat.mass:.6g} kg, '
        f'{_counted(len(scene.boat.hull.positions), "probe")}, law {scene.boat.hull.law}', '',
        *_at_rest(result), '', *_motions(result), '',
        *_steps(result, scene), '', *_righting(result), '', *_warnings(result)])


def _at_rest(result):
    rows = (
        ('draft', 'draft_m', 'm', 'depth of the deepest probe'),
        ('floatiness', 'floatiness', '', 'greatest lift over weight; floats above 1'),
        ('displacement', 'displacement_kg', 'kg', 'mass of the water that the hull displaces'),
        ('GM transverse', 'gm_transverse_m', 'm',
         'metacentric height; above 0 the boat rights itself in roll'),
        ('GM longitudinal', 'gm_longitudinal_m', 'm', 'the same in pitch'))
    yield 'At rest, level, in still water'
    for name, key, unit, meaning in rows:
        yield f'  {name:<16} {_number(result[key], 6):>10} {unit:<3} {meaning}'


def _motions(result):
    yield 'Small motions about rest    period s   damping ratio (1 = no overshoot)'
    for name in MODES:
        period, ratio = result[f'{name}_period_s'], result[f'{name}_damping_ratio']
        yield f'  {name:<23} {_number(period, 5):>10}   {_number(ratio, 3):>10}'
    yield '  The mass of water that moves along is not modelled: real hulls are slower.'


def _steps(result, scene):
    yield (f'Steps: {scene.rate:g} Hz with {scene.plan().integrator}, '
           f'{_counted(result["substeps"], "substep")} in each period')
    plain = result['step'] != 'compiled'
    yield f'  the step is {result["step"]}{", some fifty times slower" if plain else ""}'
    yield '  largest stable step for this boat:'
    for name, limit in result['max_stable_step_s'].items():
        said = {None: 'no limit', 0.0: 'never stable'}.get(limit) or f'{limit:.4g} s'
        yield f'    {name:<18} {said}'


def _righting(result):
    heel, arms = result['gz_heel_deg'], result['gz_m']
    yield 'Righting arm GZ in m over heel in degrees (above 0 rights the boat)'
    if None in arms:
        yield '  none: the boat sinks'
        return
    for start in range(0, len(heel), TABLE_COLUMNS):
        row = slice(start, start + TABLE_COLUMNS)
        yield '  heel ' + ' '.join(f'{angle:7.0f}' for angle in heel[row])
        yield '  GZ   ' + ' '.join(f'{round(arm, 3) + 0.0:7.3f}' for arm in arms[row])
    yield f'  {_range(heel, arms)}'
    if result['gz_exact_to_deg'] is not None:
        yield (f'  Up to {result["gz_exact_to_deg"]:.1f} degrees, where an edge dips or rises, '
               'exactly that of the real box.')


def _range(heel, arms):
    """Return how far the boat rights itself from upright, and how strongly, as a sentence."""
    lost = next((i for i, arm in enumerate(arms) if i and not arm > ROUND_OFF), None)
    if lost == 1:
        return 'Nothing rights the boat from upright.'
    greatest = max(arms[:lost])
    said = f'Greatest {greatest:.3f} m at {heel[arms.index(greatest)]:.0f} degrees'
    if lost is None:
        return f'{said}; rights the boat from any heel.'
    start, arm, last = heel[lost - 1], arms[lost - 1], arms[lost]
    vanishing = start + (heel[lost] - start) * arm / (arm - last)
    return f'{said}; rights the boat up to {vanishing:.0f} degrees.'


def _warnings(result):
    if not result['warnings']:
        return ['No warnings.']
    return ['Warnings', *(textwrap.fill(sentence, 99, initial_indent='  - ',
                                        subsequent_indent='    ', break_on_hyphens=False)
                          for sentence in result['warnings'])]


def _counted(count, noun):
    return f'{count} {noun}{"" if count == 1 else "s"}'


def _number(value, digits):
    return '-' if value is None else f'{value:.{digits}g}'


def main(arguments=None):
    """Run the program and return its exit code."""
    parser = command_line.scene_parser(PROGRAM, 'Print what a boat will do before it does it.')
    parser.add_argument('--json', action='store_true', help='print JSON, for programs')
    given = parser.parse_args(arguments)

    def report():
        scene = load_scene(given.scene)
        result = figures(scene)
        print(json.dumps(result, indent=2, allow_nan=False) if given.json
              else text(given.scene, scene, result))

    return command_line.run(PROGRAM, report)


if __name__ == '__main__':
    sys.exit(main())
