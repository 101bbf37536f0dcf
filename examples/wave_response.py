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
Measure how a scene's boat answers waves: ``python examples/wave_response.py config/barge.yaml``.

A fleet: the same boat in a low wave of each period from each side, all at once.  Printed are the
amplitude of heave over that of the wave, and of roll and pitch over the greatest slope of the
wave.  Headings are where the waves go, in degrees from ahead to the left: 0 from astern, 90 from
starboard, 180 from ahead.
"""

import math
from pathlib import Path
import sys

from boat_buoyancy.physics import Fleet, load_scene, Sea, State
from boat_buoyancy.physics.hydrostatics.rest import floats, rest_state
from boat_buoyancy.tools import command_line
from boat_buoyancy.tools.progress import Progress
import numpy as np

PROGRAM = 'wave_response'
MOTIONS = 'heave', 'roll', 'pitch'
PERIODS, HEADINGS = (2, 2.5, 3, 3.5, 4, 4.5, 5, 5.5, 6, 7, 8, 10, 12), (0, 45, 90)
AMPLITUDE = 0.01  # m, so low that answers are in proportion
SETTLED, READ = 120.0, 8  # s before the first reading, and the longest periods that are read


def responses(scene, periods, headings, tell=lambda text: None):
    """
    Return (periods, headings, 3), amplitudes of heave, roll and pitch as printed.

    ``scene`` {name: value} of parameters, whose sea is taken out but for its depth; ``periods`` s;
    ``headings`` degrees; ``tell`` takes a text.  NaN of a boat that leaves what physics allows.
    """
    given = {name: value for name, value in scene.items()
             if not name.startswith(('sea.', 'start.')) or name == 'sea.depth'}
    # One boat for all: with panels as fine as the shortest wave needs.
    scene = load_scene(given | {'sea.waves': [AMPLITUDE, min(periods), 0.0, 0.0]})
    if not floats(scene.boat):
        raise ValueError('expected a boat that floats, got a floatiness of '
                         f'{scene.boat.floatiness:.3g}; above 1 it floats')
    seas = [Sea([[AMPLITUDE, period, math.radians(heading), 0.0]], depth=scene.sea.depth,
                gravity=scene.boat.gravity) for period in periods for heading in headings]
    rest, plan = rest_state(scene.boat), scene.plan()
    start = State(np.tile(rest.position, (len(seas), 1)), rest.orientation)
    fleet = Fleet([scene.boat] * len(seas), seas, start, rate=scene.rate,
                  integrator=plan.integrator, substeps=plan.substeps)
    settled = round(SETTLED * scene.rate)
    last = settled + round(READ * max(periods) * scene.rate)
    motions = []
    for step in range(1, last + 1):
        fleet.step()
        if step > settled:
            state = fleet.state
            motions.append([state.position[:, 2], state.roll, state.pitch])
        if step % 100 == 0:
            tell(f'{len(seas)} boats, {step / scene.rate:.0f} of {last / scene.rate:.0f} s')
    time, motions = np.arange(settled + 1, last + 1) / scene.rate, np.array(motions)
    found = np.array([_amplitudes(time, motions[:, :, boat], sea)
                      for boat, sea in enumerate(seas)])
    found[fleet.failed] = np.nan
    return found.reshape(len(periods), len(headings), 3)


def _amplitudes(time, motions, sea):
    """Return (3,) of a sinusoid of the wave's period, by least squares beside a drift."""
    omega = 2.0 * math.pi / sea.waves[0, 1]
    basis = np.stack([np.cos(omega * time), np.sin(omega * time), np.ones_like(time),
                      time - time[0]], axis=1)
    cosine, sine, *_ = np.linalg.lstsq(basis, motions, rcond=None)[0]
    slope = AMPLITUDE * np.hypot(*sea.wave_vector[0])
    return np.hypot(cosine, sine) / [AMPLITUDE, slope, slope]


def table(periods, headings, found):
    """Yield the lines of a table of `responses`."""
    yield 'period s  heading deg  heave / amplitude  roll / slope  pitch / slope'
    for period, row in zip(periods, found):
        for heading, (heave, roll, pitch) in zip(headings, row):
            yield f'{period:8g}  {heading:11g}  {heave:17.3f}  {roll:12.3f}  {pitch:13.3f}'


def draw(path, title, periods, headings, found):
    """Draw `responses` over the period into a PNG file, a line for each heading."""
    from matplotlib.figure import Figure
    figure = Figure(figsize=(10.0, 4.5), layout='constrained')
    figure.suptitle(title)
    for motion, (axes, what) in enumerate(zip(figure.subplots(1, 3), MOTIONS)):
        lines = axes.plot(periods, found[:, :, motion], marker='o')
        axes.set_xlabel('wave period (s)')
        axes.set_title(f'{what} over {"amplitude" if motion == 0 else "slope"} of the wave')
        axes.set_ylim(bottom=0.0)
        axes.grid(True, color='0.9')
    figure.legend(lines, [f'waves to {heading:g} deg' for heading in headings],
                  loc='outside lower center', ncols=len(headings), frameon=False)
    figure.savefig(path)


def main(arguments=None):
    """Run the program and return its exit code."""
    parser = command_line.scene_parser(PROGRAM, 'Print how the boat of a scene answers waves.',
                                       'config/barge.yaml --plot barge.png')
    parser.add_argument('--periods', metavar='S', type=float, nargs='+', default=PERIODS,
                        help='of the waves, s')
    parser.add_argument('--headings', metavar='DEG', type=float, nargs='+', default=HEADINGS,
                        help='where waves go, degrees from ahead to the left (0: from astern)')
    parser.add_argument('--plot', metavar='FILE.png', type=Path, help='draw it, too')
    asked = parser.parse_args(arguments)

    def work():
        if asked.plot is not None:
            command_line.check_output('--plot', asked.plot, ('.png',))
        progress = Progress(sys.stderr, after=2.0, every=0.1)
        try:
            found = responses(load_scene(asked.scene).given, asked.periods, asked.headings,
                              progress)
        finally:
            progress.clear()
        print(*table(asked.periods, asked.headings, found), sep='\n')
        if asked.plot is not None:
            draw(asked.plot, f'{Path(asked.scene).stem} in waves', asked.periods, asked.headings,
                 found)

    return command_line.run(PROGRAM, work)


if __name__ == '__main__':
    sys.exit(main())
