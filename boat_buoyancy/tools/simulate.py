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

A table (CSV), a plot, an animation and a recording (MCAP) of its motion, as asked for, and a
summary; or several scenes under one another in one plot.
"""

import argparse
from pathlib import Path
import re
import sys
from time import perf_counter

import numpy as np

from . import animate, command_line, compare, plot, recording, simulate_text
from .progress import Progress
from ..physics import checks, load_scene
from ..physics.compiled import notice
from ..physics.scene.changes import changed
from ..physics.stepping.integrators import INTEGRATORS
from ..physics.stepping.march import march_by

PROGRAM = 'buoyancy_simulate'
# Time in s that is waited for without a word.
PATIENCE = 2.0
THRUST = ('FX', 'FY', 'FZ', 'TX', 'TY', 'TZ')


def parser():
    """Return the parser of the program's arguments."""
    arguments = command_line.scene_parser(
        PROGRAM, 'Run a boat without ROS and write down its motion: body frame in the world, '
        'twist in body axes, depth of every probe.',
        'config/waves.yaml --duration 20 --plot run.png', many=True)
    option = arguments.add_argument
    option('--duration', metavar='S', type=float, required=True, help='simulated time, s')
    option('--csv', metavar='FILE', type=Path, help='table, one row per period from time 0')
    option('--every', metavar='N', type=int, default=1,
           help='every N-th row of the table only, from time 0 on')
    option('--plot', metavar='FILE.png', type=Path,
           help='heave, attitude, speed and probe depths over time (.png, .pdf or .svg)')
    option('--animate', metavar='FILE.gif', type=Path,
           help='the boat on its water, from the side and from above')
    option('--compare', metavar='FILE.png', type=Path,
           help='heave, tilt and speed of several scenes, one under the other')
    option('--mcap', metavar='FILE.mcap', type=Path,
           help='what the node would publish, for Foxglove and ros2 bag play')
    option('--thrust', metavar=THRUST, type=float, nargs=6, default=[0.0] * 6,
           help='constant push, N and N m, body axes, at the body origin')
    option('--thruster', metavar='NAME=N', action='append', default=[],
           help='constant thrust of a thruster of the scene, N; once for each')
    option('--waves', metavar='NUMBER', type=float, nargs='+',
           help="sea.waves, instead of the scene's sea: four numbers a wave")
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


def scene_of(path, waves):
    """Return the scene of a file, on ``waves``, rows in one flat list, where they are not None."""
    scene = load_scene(path)
    return scene if waves is None else load_scene(
        changed(scene.given, scene.given, {'sea.waves': waves}))


def check_outputs(arguments):
    """Raise ValueError or OSError now for what could not be written after the run."""
    others = [f'--{name}' for name in ('csv', 'plot', 'animate', 'mcap')
              if getattr(arguments, name) is not None]
    if arguments.compare is not None and others:
        raise ValueError(f'{others[0]} and --compare: expected one of them')
    if len({*arguments.scenes}) < len(arguments.scenes):
        raise ValueError('expected each SCENE once, one is given twice')
    if arguments.compare is None and len(arguments.scenes) > 1:
        raise ValueError(f'expected one SCENE, got {len(arguments.scenes)}; to see several beside '
                         'each other give --compare FILE.png')
    checks.count('--every', arguments.every, at_least=1)
    if arguments.every > 1 and arguments.csv is None:
        raise ValueError('--every: it thins the table, and none is asked for; give --csv FILE')
    for name, path, *how in (
            ('--plot', arguments.plot, plot.ENDINGS),
            ('--compare', arguments.compare, plot.ENDINGS),
            ('--animate', arguments.animate, animate.ENDINGS),
            ('--mcap', arguments.mcap, recording.ENDINGS, 'bag', 'rosbags')):
        if path is not None:
            command_line.check_output(name, path, *how)
    if arguments.csv is not None:
        command_line.check_writable(arguments.csv)


def work(arguments):
    """Do what the arguments ask for; ValueError, OSError, SimulationError for bad input."""
    check_outputs(arguments)
    scenes = {path: scene_of(path, arguments.waves) for path in arguments.scenes}
    runs, progress = {}, Progress(sys.stderr, after=PATIENCE, every=0.1)
    try:
        for path, scene in scenes.items():
            integrator = arguments.integrator or scene.integrator
            if integrator in INTEGRATORS and (compiling := notice(march_by(integrator))):
                print(f'{PROGRAM}: {compiling}', file=sys.stderr)
            simulation = scene.simulation(integrator=arguments.integrator, rate=arguments.rate,
                                          substeps=arguments.substeps)
            runs[path] = run_and_write(arguments, path, scene, simulation, progress)
        if arguments.compare is not None:
            compare.write(arguments.compare, runs, simulate_text.compared(arguments))
            print(f'wrote    {arguments.compare}')
    finally:
        progress.clear()


def run_and_write(arguments, path, scene, simulation, progress):
    """Return the run of a scene's file, after writing what is asked; ``progress`` takes a text."""
    thrust = push_of(scene, simulation, arguments)

    def told(time):
        progress(f'running: {time:.0f} of {arguments.duration:g} s')

    start = perf_counter()
    run = (simulation.run(arguments.duration, thrust, progress=told) if arguments.mcap is None
           else recording.record(arguments.mcap, scene, simulation, arguments.duration, thrust,
                                 told))
    seconds = perf_counter() - start
    # With thrusters, what they have come to.
    steady = thrust(simulation.time, simulation.state) if callable(thrust) else thrust
    heading = simulate_text.title(arguments, path, simulation)
    progress.clear()
    for line in simulate_text.summary(arguments, path, simulation, run, seconds):
        print(line, flush=True)
    for file, write in (
            (arguments.csv, run.every(arguments.every).to_csv),
            (arguments.plot, lambda file: plot.write(file, run, heading)),
            (arguments.animate, lambda file: animate.write(
                file, run, simulation, heading, steady, progress))):
        if file is not None:
            progress(f'writing {file}')
            try:
                write(file)
            except BaseException:
                # Half of it would be taken for the whole.
                if file.is_file() and not file.is_symlink():
                    file.unlink()
                raise
            progress.clear()
            print(f'wrote    {file}', flush=True)
    if arguments.mcap is not None:
        print(f'wrote    {arguments.mcap}')
    return run


def main(argv=None):
    """Run the program and return its exit code."""
    words = sys.argv[1:] if argv is None else argv
    arguments = parser().parse_args(protected(words), argparse.Namespace())
    return command_line.run(PROGRAM, lambda: work(arguments))


if __name__ == '__main__':
    sys.exit(main())
