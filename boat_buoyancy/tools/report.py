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
Print what a boat will do before it does it: ``buoyancy_report SCENE [--json] [--plot FILE.png]``.

Rest, stability, periods, handling, steps and righting arms of a parameter file's boat, in still
water, and how it meets its sea.
"""

from dataclasses import replace
import json
from pathlib import Path
import sys

import numpy as np

from . import command_line
from .handling import handling
from .report_text import text
from ..physics import checks
from ..physics.compiled import expected_kind
from ..physics.hydrostatics.metacentric_height import metacentric_heights
from ..physics.hydrostatics.natural_modes import MODES, modes
from ..physics.hydrostatics.rest import draft, floats, rest_attitude, rest_state
from ..physics.hydrostatics.righting_arm import (
    righting_arms, surface_righting_arms, trim, wall_sided_heel)
from ..physics.hydrostatics.warnings import HEELS, parting_warnings
from ..physics.hydrostatics.wetted_surface import wetted_surface
from ..physics.scene.scene import load_scene
from ..physics.sea.steepness import steepness
from ..physics.step_size.limits import max_stable_steps, notice_of

PROGRAM = 'buoyancy_report'
# The heels in degrees that a boat is sailed at, for the error of a model.
SMALL_HEEL = 30.0
# A righting arm in m below which there is none.
ROUND_OFF = 1e-9
# A natural period meets the sea where waves within this part of it have this share of its energy.
NEAR, MUCH = 0.2, 0.1


def figures(scene, push=None):
    """
    Return what ``--json`` prints of a `Scene`: names with their units, to numbers or None.

    ``push`` N ahead, as of `handling`.
    None stands for what does not exist: the draft of a boat that sinks, the period of what does
    not oscillate, the limit of an integrator without one, the surface of probes.
    """
    boat, plan = scene.boat, scene.plan()
    rest, surface = at_rest(boat), boat.on_surface
    transverse, longitudinal = metacentric_heights(boat) if rest else (None, None)
    roll, pitch = np.degrees(rest_attitude(boat)).tolist() if rest else (None, None)
    motions = modes(boat) if rest else {}
    bare = modes(replace(boat, added_mass=np.zeros(6))) if rest else {}
    periods, bare_periods = ({name: found[name].period if rest else None for name in MODES}
                             for found in (motions, bare))
    heel = np.radians(HEELS)
    exact = None if surface is None else surface_righting_arms(boat, heel)
    # On panels they are the same to round-off.
    arms = righting_arms(boat, heel) if boat.hull.panels is None else exact
    # A boat that sinks displaces its whole hull, which is less than its mass.
    displaced = boat.mass * min(1.0, boat.floatiness)
    return {
        'draft_m': draft(boat, rest) if rest else None,
        'rest_roll_deg': roll,
        'rest_pitch_deg': pitch,
        'floatiness': boat.floatiness,
        'displacement_kg': displaced,
        'displaced_volume_m3':
            None if surface is None else displaced * boat.gravity / boat.hull.specific_weight,
        'wetted_surface_m2': wetted_surface(boat, rest) if surface and rest else None,
        'gm_transverse_m': transverse,
        'gm_longitudinal_m': longitudinal,
        **{f'{name}_period_s': periods[name] for name in MODES},
        **{f'{name}_damping_ratio': motions[name].damping_ratio if rest else None
           for name in MODES},
        **{f'{name}_period_without_added_mass_s': bare_periods[name] for name in MODES},
        'handling': handling(scene, push) if rest else None,
        'max_stable_step_s': max_stable_steps(boat),
        'substeps': plan.substeps,
        'sea': sea_figures(scene.sea, periods),
        'warnings': list(dict.fromkeys(
            [*scene.warnings, *plan.warnings, *parting_warnings(boat)])),
        'gz_heel_deg': HEELS.tolist(),
        'gz_m': _numbers(arms),
        'gz_exact_m': None if surface is None else _numbers(exact),
        'gz_exact_to_deg': exact_heel_degrees(scene),
        'model_error': model_error(boat, surface, arms, exact),
        'step': expected_kind()}


def at_rest(boat):
    """Return the `State` at which a boat lies at rest; None where it sinks or finds no rest."""
    return rest_state(boat) if floats(boat) and rest_attitude(boat) else None


def model_error(boat, surface, arms, exact):
    """
    Return how far a boat's model is off its surface, {name: number}; None where one has no rest.

    ``surface``, the `Boat` on its surface or None; ``arms`` and ``exact`` (n,) m, the righting
    arms of both.  Draft and metacentric heights are those of the model less those of the surface,
    each at its own rest.
    """
    states = [at_rest(one) if one else None for one in (boat, surface)]
    if not all(states):
        return None
    model, true = ([draft(one, state), *metacentric_heights(one)]
                   for one, state in zip((boat, surface), states))
    off, small = np.abs(arms - exact), HEELS <= SMALL_HEEL
    names = 'draft_m', 'gm_transverse_m', 'gm_longitudinal_m'
    return {
        **dict(zip(names, np.subtract(model, true).tolist())),
        'gz_greatest_m': float(off.max()),
        'gz_greatest_at_deg': float(HEELS[np.argmax(off)]),
        f'gz_rms_to_{SMALL_HEEL:.0f}_deg_m': float(np.sqrt(np.mean(off[small] ** 2)))}


def exact_heel_degrees(scene):
    """
    Return up to which heel in degrees GZ is that of the hull itself; None where none is promised.

    Any on panels.  Of a box on columns until an edge dips or rises; None for any other hull.
    """
    values, boat = scene.values, scene.boat
    if not floats(boat) or boat.hull.surface is None:
        return None
    if boat.hull.panels is not None:
        return 180.0
    if values['hull.shape'] == 'mesh' or values['probes.law'] != 'column':
        return None
    along, across = values['hull.probes']
    # One column has no waterplane to heel with, nor to trim with.
    if across < 2 or (along < 2 and trim(boat)):
        return None
    length, beam, depth = values['hull.size']
    if values['hull.shape'] == 'twin':
        # The outer sides dip and rise first.
        beam += values['hull.spacing']
    return float(np.degrees(wall_sided_heel(
        beam, depth, depth / boat.floatiness, length, trim(boat))))


def sea_figures(sea, periods):
    """
    Return what a boat of natural ``periods`` {name: s or None} should know of a `Sea`.

    {name: number}, and ``meets``, the names of the motions that it excites in a boat that drifts
    with the current; None in flat water.
    """
    if sea.ends is None:
        return None
    found = {'significant_height_m': sea.significant_height, 'steepness': steepness(sea)}
    for name, row in zip(('shortest', 'longest'), sea.ends):
        found[f'{name}_wave_m'] = float(2.0 * np.pi / np.hypot(*sea.wave_vector[row]))
        found[f'{name}_wave_s'] = float(sea.waves[row, 1])
    share = sea.waves[:, 0] ** 2 / np.sum(sea.waves[:, 0] ** 2)
    felt = 2.0 * np.pi / sea.intrinsic_frequency
    found['meets'] = [name for name, period in periods.items() if period is not None and share[
        np.abs(felt - period) <= NEAR * period].sum() >= MUCH]
    return found


def _numbers(arms):
    return [None if np.isnan(arm) else arm + 0.0 for arm in arms.tolist()]


def main(arguments=None):
    """Run the program and return its exit code."""
    parser = command_line.scene_parser(PROGRAM, (
        'Print what a boat will do before it does it: how it lies at rest, how stable it is, its '
        'periods, how fast a push makes it, and warnings.'), 'config/barge.yaml --plot gz.png')
    parser.add_argument('--json', action='store_true', help='print JSON, for programs')
    parser.add_argument('--thrust', metavar='N', type=float,
                        help='push ahead in N that the boat is to answer; without it all that its '
                             'thrusters give, or 1 N for each kg of its mass')
    parser.add_argument('--plot', metavar='FILE.png', type=Path,
                        help='draw the righting arm over heel, of the model and of the hull')
    given = parser.parse_args(arguments)

    def report():
        push = given.thrust
        if push is not None:
            checks.number('--thrust', push, above=0.0)
        scene = load_scene(given.scene)
        if compiling := notice_of(scene.boat):
            print(f'{PROGRAM}: {compiling}', file=sys.stderr)
        if given.plot is not None:
            command_line.check_output('--plot', given.plot, ('.png',))
            from . import righting_arm_plot
            righting_arm_plot.draw(given.plot, scene.boat, Path(given.scene).stem)
        result = figures(scene, push)
        if given.json:
            print(json.dumps(result, indent=2, allow_nan=False))
            return
        print(text(given.scene, scene, result))
        if given.plot is not None:
            print(f'\nwrote {given.plot}')

    return command_line.run(PROGRAM, report)


if __name__ == '__main__':
    sys.exit(main())
