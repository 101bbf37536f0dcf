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
The command line of ``buoyancy_chart``.

Speed against accuracy for all integrators and probes; advice for one scene; the speed of the
step; the limits of stability; hulls in waves against a boundary element method.
"""

from pathlib import Path
import sys

from .. import command_line
from ..progress import Progress
from ...physics import checks
from ...physics.scene.scene import load_scene

PROGRAM = 'buoyancy_chart'
DESCRIPTION = (
    'Charts speed against accuracy (speed_accuracy.png and .csv, _model.png, _front.png, '
    'righting_arm.png and a summary). With --tolerance it measures the scene and prints the '
    'cheapest setting that meets it; with --speed the cost of a step; with --stability where each '
    'integrator is stable; with --fidelity how far hulls in waves are from a boundary element '
    'method, with and without added mass and wave force.')


def parser():
    """Return the argument parser."""
    made = command_line.OneLineParser(
        PROGRAM, DESCRIPTION, 'config/barge.yaml --tolerance 0.01')
    made.add_argument('scenes', metavar='SCENE', nargs='*',
                      help='parameter file, as config/barge.yaml; without --tolerance the '
                           'scene of the third picture')
    made.add_argument('--out', metavar='DIR', default='.', help='folder to write to [.]')
    made.add_argument('--tolerance', metavar='METRES',
                      help='print the cheapest setting of each scene that is this accurate')
    made.add_argument('--speed', action='store_true',
                      help='measure the cost of a step: step_speed.md, speed.png, speed.csv')
    made.add_argument('--stability', action='store_true',
                      help='measure where each integrator is stable: stability.png')
    made.add_argument('--fidelity', action='store_true',
                      help='measure hulls in waves: fidelity.png, fidelity.csv')
    made.add_argument('--quick', action='store_true', help='coarser, in under a minute')
    return made


def work(arguments, progress):
    """Do what the arguments ask for; ValueError when they or a scene are wrong."""
    command_line.require_extra('chart', 'a chart', 'matplotlib', 'scipy')
    asked = [name for name in ('tolerance', 'speed', 'stability', 'fidelity')
             if getattr(arguments, name) not in (None, False)]
    if len(asked) > 1:
        raise ValueError(f'--{asked[0]} and --{asked[1]}: expected one of them')
    if arguments.quick and asked == ['tolerance']:
        raise ValueError('--quick and --tolerance: expected one of them, advice is as quick as it '
                         'can be')
    if arguments.scenes and asked in (['speed'], ['stability'], ['fidelity']):
        raise ValueError(f'--{asked[0]}: expected no SCENE, got {arguments.scenes[0]}')
    {'tolerance': _advise, 'speed': _speed, 'stability': _stability, 'fidelity': _fidelity}.get(
        asked[0] if asked else None, _chart)(arguments, progress)


def _advise(arguments, progress):
    from . import advice
    try:
        tolerance = float(arguments.tolerance)
    except ValueError:
        tolerance = arguments.tolerance
    tolerance = checks.number('--tolerance', tolerance, above=0.0)
    if not arguments.scenes:
        raise ValueError('--tolerance: expected a SCENE to measure, got none')
    scenes = {path: load_scene(path) for path in arguments.scenes}
    for path, scene in scenes.items():
        found = advice.advise(scene.given, tolerance, progress=progress)
        progress.clear()
        print(*advice.report(path, found, tolerance), '', sep='\n', flush=True)


def _speed(arguments, progress):
    from . import speed, speed_plot, speed_report
    out = _folder(arguments.out)
    rounds = speed.QUICK_ROUNDS if arguments.quick else speed.ROUNDS
    best = speed.measure_alone(arguments.quick, rounds)
    progress.clear()
    text = speed_report.text(best, rounds)
    speed_report.write_table(out / 'speed.csv', best)
    (out / 'step_speed.md').write_text(text, encoding='utf-8')
    speed_plot.draw(best, out / 'speed.png')
    print(text)


def _stability(arguments, progress):
    from .stability_plot import draw_stability
    path = draw_stability(_folder(arguments.out), quick=arguments.quick, progress=progress)
    progress.clear()
    print(path)


def _fidelity(arguments, progress):
    from . import fidelity, fidelity_plot, fidelity_text, table
    command_line.require_extra('mesh', '--fidelity', 'trimesh')
    out = _folder(arguments.out)
    table.write(out / 'fidelity.csv', fidelity.measure(arguments.quick, progress))
    # Read again: picture and text are of the digits that the table has.
    rows = table.read(out / 'fidelity.csv')
    fidelity_plot.draw(rows, out / 'fidelity.png')
    progress.clear()
    print(*fidelity_text.lines(rows), f'Written to {out}: fidelity.png, .csv', sep='\n')


def _chart(arguments, progress):
    from .speed_accuracy import write_chart
    lines = write_chart(arguments.out, arguments.scenes, arguments.quick, progress)
    progress.clear()
    print(*lines, f'Written to {arguments.out}: speed_accuracy.png, .csv, .txt, _model.png, '
          '_front*.png, righting_arm.png', sep='\n')


def _folder(path):
    folder = Path(path)
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def main(arguments=None):
    """Run the program and return its exit code."""
    parsed = parser().parse_args(arguments)
    return command_line.run(PROGRAM, lambda: work(parsed, Progress(sys.stderr)))


if __name__ == '__main__':
    sys.exit(main())
