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

"""What ``buoyancy_simulate`` says of a run: its summary, and the title of its pictures."""

from pathlib import Path

import numpy as np


def pushes(arguments):
    """Yield what pushes the boat, in words: name and numbers of the thrust and the thrusters."""
    thrust = arguments.thrust
    if any(thrust):
        yield 'thrust', f'{_joined(thrust[:3])} N, {_joined(thrust[3:])} N m, body axes'
    if arguments.thruster:
        yield 'thruster', f'{", ".join(arguments.thruster)} N'


def title(arguments, path, simulation):
    """Return the title of a picture: scene, boat and steps, and what pushes."""
    return (f'{Path(path).name}: {simulation.boat.mass:g} kg, {simulation.integrator} '
            f'at {simulation.rate:g} Hz\n{_pushed(arguments)}')


def compared(arguments):
    """Return the title of a picture of several scenes: what pushes, and the waves."""
    rows = zip(*[iter(arguments.waves or ())] * 4)
    waves = ', '.join(f'{height:g} m every {period:g} s' for height, period, *_ in rows)
    return _pushed(arguments) + (f'; waves of amplitude {waves}' if waves else '')


def summary(arguments, path, simulation, run, seconds):
    """
    Return what was run and what came of it, as lines.

    ``arguments`` of the program; ``path`` of the scene; ``simulation`` at its end and ``run``, its
    `Trajectory`; ``seconds`` of wall time that the run took.
    """
    boat, sea, steps = simulation.boat, simulation.sea, simulation.steps * simulation.substeps
    # Rounded, and without the sign of a zero.
    x, y, z = np.round(run.position[-1], 3) + 0.0
    angles = np.round(np.degrees(run.roll_pitch_yaw), 3) + 0.0
    heave = np.round(run.position[:, 2], 3) + 0.0
    speed = np.linalg.norm(run.body_velocity, axis=1)
    count, depths = len(boat.hull.positions), run.probe_depths
    yield (f'{path}: {run.time[-1]:g} s at {simulation.rate:g} Hz, '
           f'{simulation.integrator}, {_count(simulation.substeps, "step")} per period')
    law = f', law {boat.hull.law}' if boat.hull.panels is None else ''
    yield (f'boat     {boat.mass:g} kg on {boat.hull.carriers}{law}; '
           f'{"flat water" if sea.is_flat else _count(len(sea.waves), "wave")}, '
           f'current {np.hypot(*sea.current):.3g} m/s, wind {np.hypot(*sea.wind):.3g} m/s')
    yield from (f'{name:8} {numbers}' for name, numbers in pushes(arguments))
    yield from (f'warning: {sentence}' for sentence in simulation.warnings)
    yield f'end      x {x:.3f}, y {y:.3f}, z {z:.3f} m; speed {speed[-1]:.4f} m/s'
    yield 'attitude roll {:.3f}, pitch {:.3f}, yaw {:.3f} deg'.format(*angles[-1])
    yield (f'extremes roll {abs(angles[:, 0]).max():.3f}, pitch {abs(angles[:, 1]).max():.3f} deg '
           f'either way; heave {heave.min():.3f} to {heave.max():.3f} m; '
           f'speed {speed.max():.3f} m/s')
    yield (f'probes   {depths.min():.3f} to {depths.max():.3f} m under water; '
           f'at least {int((depths > 0).sum(axis=1).min())} of {count} wet')
    yield (f'cost     {steps} steps in {seconds:.3g} s: {steps / seconds:.4g} steps/s, '
           f'{run.time[-1] / seconds:.3g} times real time'
           f'{"" if arguments.mcap is None else ", recorded as they went"}')


def _pushed(arguments):
    return ', '.join(f'{name} {numbers}' for name, numbers in pushes(arguments)) or 'no thrust'


def _count(number, noun):
    return f'{number} {noun}{"" if number == 1 else "s"}'


def _joined(numbers):
    return ' '.join(f'{number:g}' for number in numbers)
