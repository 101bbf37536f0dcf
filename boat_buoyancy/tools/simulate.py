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

import numpy as np

from . import animate, command_line, plot
from .recording import periods_of, record
from ..physics import load_scene

PROGRAM = 'buoyancy_simulate'
COLUMNS = ('time', 'x', 'y', 'z', 'qx', 'qy', 'qz', 'qw', 'vx', 'vy', 'vz', 'wx', 'wy', 'wz')
THRUST = ('FX', 'FY', 'FZ', 'TX', 'TY', 'TZ')


def parser():
    """Return the parser of the program's arguments."""
    arguments = command_line.scene_parser(
        PROGRAM, 'Run a boat without ROS and write down its motion: body frame in the world, '
        'twist in body axes, depth of every probe.')
    option = arguments.add_argument
    option('--duration', metavar='S', type=float, required=True, help='simulated time, s')
    option('--csv', metavar='FILE', type=Path, help='table, one row per period from time 0')
    option('--plot', metavar='FILE.png', type=Path,
           help='heave, roll, pitch and probe depths over time (.png, .pdf or .svg)')
    option('--animate', metavar='FILE.gif', type=Path,
           help='the boat on its water, from the side and from above')
    option('--thrust', metavar=THRUST, type=float, nargs=6, default=[0.0] * 6,
           help='constant push, N and N m, body axes, at the body origin')
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


def check_outputs(arguments):
    """Raise ValueError or OSError now for files that could not be written after the run."""
    for name, path, endings in (('--plot', arguments.plot, plot.ENDINGS),
                                ('--animate', arguments.animate, animate.ENDINGS)):
        if path is not None:
            if path.suffix.lower() not in endings:
                raise ValueError(f'{name}: expected a file name that ends in '
                                 f'{" or ".join(endings)}, got {str(path)!r}')
            command_line.require_extra('chart', name, 'matplotlib')
    for path in filter(None, (arguments.csv, arguments.plot, arguments.animate)):
        existed = path.exists()
        path.open('ab').close()
        if not existed:
            path.unlink()


def write_csv(path, recording):
    """Write one row per period, every number with all its digits."""
    names = [*COLUMNS, *(f'depth_{i}' for i in range(recording.depths.shape[1]))]
    table = np.column_stack([recording.time, recording.position, recording.orientation,
                             recording.velocity, recording.angular_velocity, recording.depths])
    with path.open('w', encoding='utf-8', newline='') as file:
        file.write(','.join(names) + '\n')
        file.writelines(','.join(map(repr, row.tolist())) + '\n' for row in table)


def summary(name, recording):
    """Return what was run and what came of it, as lines."""
    simulation, boat, sea = recording.simulation, recording.scene.boat, recording.scene.sea
    periods = simulation.steps
    # Rounded, and without the sign of a zero.
    x, y, z = np.round(recording.position[-1], 3) + 0.0
    angles = np.round(np.degrees(recording.roll_pitch_yaw), 3) + 0.0
    heave = np.round(recording.position[:, 2], 3) + 0.0
    speed = np.linalg.norm(recording.velocity, axis=1)
    count, waves = len(boat.hull.positions), len(sea.waves)
    yield (f'{name}: {recording.time[-1]:g} s at {simulation.rate:g} Hz, '
           f'{simulation.integrator}, {_count(simulation.substeps, "step")} per period')
    yield (f'boat     {boat.mass:g} kg, {_count(count, "probe")}, law {boat.hull.law}; '
           f'{"flat water" if sea.is_flat else _count(waves, "wave")}, '
           f'current {np.hypot(*sea.current):.3g} m/s')
    if recording.thrust.any():
        yield (f'thrust   {_joined(recording.thrust[:3])} N, '
               f'{_joined(recording.thrust[3:])} N m, body axes')
    yield from (f'warning: {sentence}' for sentence in simulation.warnings)
    yield (f'end      x {x:.3f}, y {y:.3f}, z {z:.3f} m; draft {recording.depths[-1].max():.4f} m '
           f'(deepest probe); speed {speed[-1]:.4f} m/s')
    yield 'attitude roll {:.3f}, pitch {:.3f}, yaw {:.3f} deg'.format(*angles[-1])
    yield (f'extremes roll {abs(angles[:, 0]).max():.3f}, pitch {abs(angles[:, 1]).max():.3f} deg '
           f'either way; heave {heave.min():.3f} to {heave.max():.3f} m; '
           f'speed {speed.max():.3f} m/s')
    yield (f'probes   {recording.depths.min():.3f} to {recording.depths.max():.3f} m under water; '
           f'at least {int((recording.depths > 0).sum(axis=1).min())} of {count} wet')
    rate = periods * simulation.substeps / recording.seconds
    yield (f'cost     {periods * simulation.substeps} steps in {recording.seconds:.3g} s: '
           f'{rate:.4g} steps/s, {recording.time[-1] / recording.seconds:.3g} times real time')


def _count(number, noun):
    return f'{number} {noun}{"" if number == 1 else "s"}'


def _joined(numbers):
    return ' '.join(f'{number:g}' for number in numbers)


def work(arguments):
    """Do what the arguments ask for; ValueError, OSError, SimulationError for bad input."""
    scene = load_scene(arguments.scene)
    simulation = scene.simulation(integrator=arguments.integrator, rate=arguments.rate,
                                  substeps=arguments.substeps)
    periods = periods_of(arguments.duration, simulation.rate)
    check_outputs(arguments)
    recording = record(scene, simulation, periods, arguments.thrust)
    for line in summary(arguments.scene, recording):
        print(line)
    for path, write in ((arguments.csv, write_csv), (arguments.plot, plot.write),
                        (arguments.animate, animate.write)):
        if path is not None:
            write(path, recording)
            print(f'wrote    {path}')


def main(argv=None):
    """Run the program and return its exit code."""
    words = sys.argv[1:] if argv is None else argv
    arguments = parser().parse_args(protected(words), argparse.Namespace())
    return command_line.run(PROGRAM, lambda: work(arguments))


if __name__ == '__main__':
    sys.exit(main())
