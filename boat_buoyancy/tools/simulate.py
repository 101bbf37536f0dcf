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
Run a boat and write down what it does: ``buoyancy_simulate SCENE --duration S [...]``.

A table (CSV), a plot and an animation of its motion, as asked for, and a summary.
"""

import argparse
from pathlib import Path
import re
import sys
from time import perf_counter

import numpy as np

from . import animate, command_line, plot
from ..physics import checks, load_scene
from ..physics.compiled import notice
from ..physics.stepping.integrators import INTEGRATORS
from ..physics.stepping.march import march_by

PROGRAM = 'buoyancy_simulate'
THRUST = ('FX', 'FY', 'FZ', 'TX', 'TY', 'TZ')


def parser():
    """Return the parser of the program's arguments."""
    arguments = command_line.scene_parser(
        PROGRAM, 'Run a boat without ROS and write down its motion: body frame in the world, '
        'twist in body axes, depth of every probe.')
    option = arguments.add_argument
    option('--duration', metavar='S', type=float, required=True, help='simulated time, s')
    option('--csv', metavar='FILE', type=Path, help='table, one row per period from time 0')
    option('--every', metavar='N', type=int, default=1,
           help='every N-th row of the table only, from time 0 on')
    option('--plot', metavar='FILE.png', type=Path,
           help='heave, roll, pitch and probe depths over time (.png, .pdf or .svg)')
    option('--animate', metavar='FILE.gif', type=Path,
           help='the boat on its water, from the side and from above')
    option('--thrust', metavar=THRUST, type=float, nargs=6, default=[0.0] * 6,
           help='constant push, N and N m, body axes, at the body origin')
    option('--thruster', metavar='NAME=N', action='append', default=[],
           help='constant thrust of a thruster of the scene, N; once for each')
    option('--rate', metavar='HZ', type=float, help="periods per second, instead of the scene's")
    option('--integrator', metavar='NAME', help="integrator, instead of the scene's")
    option('--substeps', metavar='N', type=int,
           help='integrator steps per period; 0 = chosen from the stability limit')
    return arguments


def protected(words):
    """Return the words of a command line with a blank before negative numbers such as -1e3."""
    # Python takes -1e3 and -inf for options; a leading blank shows that they are none.
    number = re.compile(r'-[\d.]+([eE][+-]?\d+)?$|-(inf|nan)', re.IGNORECASE)
    return [f' {word}' if number.match(word) else word for word in words]


def thruster_commands(words):
    """Return {name: N} of words such as left=250; ValueError for one that is none."""
    commands = {}
    for word in words:
        name, _, force = word.partition('=')
        if name in commands:
            raise ValueError(f'--thruster: {name} is given twice')
        try:
            commands[name] = float(force)
        except ValueError:
            raise ValueError(f'--thruster: expected NAME=N, as left=250, got {word!r}') from None
    return commands


def push_of(scene, simulation, arguments):
    """Return the thrust of a run: six numbers, or with thrusters a function that gives them."""
    commands = thruster_commands(arguments.thruster)
    if not commands:
        return arguments.thrust
    propulsion = scene.propulsion()
    return lambda time, state: np.add(arguments.thrust, propulsion.wrench(simulation, commands))


def check_outputs(arguments):
    """Raise ValueError or OSError now for what could not be written after the run."""
    checks.count('--every', arguments.every, at_least=1)
    if arguments.every > 1 and arguments.csv is None:
        raise ValueError('--every: it thins the table, and none is asked for; give --csv FILE')
    for name, path, endings in (('--plot', arguments.plot, plot.ENDINGS),
                                ('--animate', arguments.animate, animate.ENDINGS)):
        if path is not None:
            command_line.check_picture(name, path, endings)
    if arguments.csv is not None:
        command_line.check_writable(arguments.csv)


def summary(arguments, simulation, run, seconds):
    """
    Return what was run and what came of it, as lines.

    ``arguments`` of the program; ``simulation`` at its end and ``run``, its `Trajectory`;
    ``seconds`` of wall time that the run took.
    """
    thrust = arguments.thrust
    boat, sea, steps = simulation.boat, simulation.sea, simulation.steps * simulation.substeps
    # Rounded, and without the sign of a zero.
    x, y, z = np.round(run.position[-1], 3) + 0.0
    angles = np.round(np.degrees(run.roll_pitch_yaw), 3) + 0.0
    heave = np.round(run.position[:, 2], 3) + 0.0
    speed = np.linalg.norm(run.body_velocity, axis=1)
    count, depths = len(boat.hull.positions), run.probe_depths
    yield (f'{arguments.scene}: {run.time[-1]:g} s at {simulation.rate:g} Hz, '
           f'{simulation.integrator}, {_count(simulation.substeps, "step")} per period')
    law = f', law {boat.hull.law}' if boat.hull.panels is None else ''
    yield (f'boat     {boat.mass:g} kg on {boat.hull.carriers}{law}; '
           f'{"flat water" if sea.is_flat else _count(len(sea.waves), "wave")}, '
           f'current {np.hypot(*sea.current):.3g} m/s, wind {np.hypot(*sea.wind):.3g} m/s')
    if any(thrust):
        yield f'thrust   {_joined(thrust[:3])} N, {_joined(thrust[3:])} N m, body axes'
    if arguments.thruster:
        yield f'thruster {", ".join(arguments.thruster)} N'
    yield from (f'warning: {sentence}' for sentence in simulation.warnings)
    yield f'end      x {x:.3f}, y {y:.3f}, z {z:.3f} m; speed {speed[-1]:.4f} m/s'
    yield 'attitude roll {:.3f}, pitch {:.3f}, yaw {:.3f} deg'.format(*angles[-1])
    yield (f'extremes roll {abs(angles[:, 0]).max():.3f}, pitch {abs(angles[:, 1]).max():.3f} deg '
           f'either way; heave {heave.min():.3f} to {heave.max():.3f} m; '
           f'speed {speed.max():.3f} m/s')
    yield (f'probes   {depths.min():.3f} to {depths.max():.3f} m under water; '
           f'at least {int((depths > 0).sum(axis=1).min())} of {count} wet')
    yield (f'cost     {steps} steps in {seconds:.3g} s: {steps / seconds:.4g} steps/s, '
           f'{run.time[-1] / seconds:.3g} times real time')


def _count(number, noun):
    return f'{number} {noun}{"" if number == 1 else "s"}'


def _joined(numbers):
    return ' '.join(f'{number:g}' for number in numbers)


def work(arguments):
    """Do what the arguments ask for; ValueError, OSError, SimulationError for bad input."""
    scene = load_scene(arguments.scene)
    check_outputs(arguments)
    integrator = arguments.integrator or scene.integrator
    if integrator in INTEGRATORS and (compiling := notice(march_by(integrator))):
        print(f'{PROGRAM}: {compiling}', file=sys.stderr)
    simulation = scene.simulation(integrator=arguments.integrator, rate=arguments.rate,
                                  substeps=arguments.substeps)
    start = perf_counter()
    run = simulation.run(arguments.duration, push_of(scene, simulation, arguments))
    seconds = perf_counter() - start
    for line in summary(arguments, simulation, run, seconds):
        print(line)
    for path, write in (
            (arguments.csv, run.every(arguments.every).to_csv),
            (arguments.plot, lambda path: plot.write(path, run, simulation)),
            (arguments.animate, lambda path: animate.write(path, run, simulation))):
        if path is not None:
            write(path)
            print(f'wrote    {path}')


def main(argv=None):
    """Run the program and return its exit code."""
    words = sys.argv[1:] if argv is None else argv
    arguments = parser().parse_args(protected(words), argparse.Namespace())
    return command_line.run(PROGRAM, lambda: work(arguments))


if __name__ == '__main__':
    sys.exit(main())
