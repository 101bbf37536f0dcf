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
What a step costs, as ratios of one run: ``python benchmarks/step.py``, on a quiet machine.

The unit is one call of ``numpy.add`` on four elements.  Trigonometry is ``numpy.cos`` and
``numpy.sin`` of as many angles as the step has.  Interleaved repetitions, the best of each: what
else the machine does can only add.
"""

import argparse
from dataclasses import replace
import math
import os
import subprocess
import sys
import time

from boat_buoyancy.physics import Fleet, load_scene, Sea, Simulation, State
from boat_buoyancy.physics.boat.surface import box_surface, Surface
from boat_buoyancy.physics.compiled import kind
import numpy as np

WAVES = [[0.2, 5.0, 0.0, 0.0], [0.1, 3.3, 0.5, 1.0], [0.1, 2.7, -0.4, 2.0],
         [0.05, 2.1, 1.0, 3.0]]
MANY, MOST = 1000, 10000
# Panels of the box, and the longest edge of so many on a cube of 1 m.
PANELS = {12: 1.5, 48: 0.75, 192: 0.375, 768: 0.1875}
RUN_SECONDS = 10.0
# A block of angles that stays in the cache.
IN_CACHE = 16384


def sea(waves):
    """Return a `Sea` of so many waves."""
    rows = np.tile(WAVES, (math.ceil(waves / 4), 1))[:waves]
    return Sea(rows * [4.0 / max(waves, 4), 1.0, 1.0, 1.0])


def simulation(integrator='leapfrog', waves=4):
    """Return a simulation of the default box in waves."""
    made = load_scene({'integrator': integrator}).simulation()
    made.sea = sea(waves)
    return made


def fleet(boats, waves, threads=1, boat=None):
    """Return a fleet of default boxes, or of a ``boat`` like them, spread over the water."""
    scene, random = load_scene({}), np.random.default_rng(8)
    position = np.tile(scene.start.position, (boats, 1))
    position[:, :2] = random.uniform(-100.0, 100.0, (boats, 2))
    return Fleet([boat or scene.boat] * boats, [sea(waves)] * boats, State(position),
                 threads=threads)


def panelled(panels):
    """Return the default box with so many panels."""
    scene, cube = load_scene({}), box_surface((1.0, 1.0, 1.0)).refined(PANELS[panels])
    surface = Surface(cube.corners * scene.values['hull.size'], cube.triangles)
    return replace(scene.boat, hull=replace(scene.boat.hull, panels=surface))


def in_waves(boat):
    """Return a boat that takes water along, in waves that die out with depth."""
    return replace(boat, added_mass=boat.mass * np.array([0.1, 0.5, 1.0, 0.1, 0.5, 0.3]),
                   immersion=np.full(len(boat.hull.share), 0.25))


def run_of(boat, waves):
    """Return the run of a boat like the default box, for `best_of`."""
    made = Simulation(boat, sea(waves), load_scene({}).start)
    return (lambda: made.run(RUN_SECONDS)), 1


def trigonometry(angles):
    """Return a function that takes cosine and sine of so many angles, in blocks."""
    angle = np.random.default_rng(7).uniform(0.0, 2.0 * math.pi, min(angles, IN_CACHE))
    out = np.empty_like(angle)

    def work():
        for _ in range(math.ceil(angles / IN_CACHE)):
            np.cos(angle, out=out)
            np.sin(angle, out=out)
    return work


def small_call():
    """Return the small call and how often to make it, for `best_of`."""
    four, out = np.arange(4.0), np.empty(4)
    return (lambda: np.add(four, four, out)), 2000


def best_of(cases, rounds):
    """Return {name: least s of one call} of {name: (function, calls)}, interleaved."""
    best = dict.fromkeys(cases, math.inf)
    for _ in range(rounds):
        for name, (work, calls) in cases.items():
            work()
            began = time.perf_counter()
            for _ in range(calls):
                work()
            best[name] = min(best[name], (time.perf_counter() - began) / calls)
    return best


def measure(rounds):
    """Return the times in s of all cases."""
    running = simulation()
    cases = {'call': small_call(), 'step': (simulation().step, 500),
             'run': (lambda: running.run(RUN_SECONDS), 1)}
    for integrator in ('leapfrog', 'implicit'):
        made = simulation(integrator)
        cases[integrator] = (lambda made=made: made.run(RUN_SECONDS), 1)
    for waves in (4, 64):
        cases[f'{MANY} boats, {waves} waves'] = (fleet(MANY, waves).step, 3)
        cases[f'trigonometry, {waves} waves'] = (trigonometry(4 * waves * MANY), 3)
    cases['columns, flat'] = run_of(load_scene({}).boat, 0)
    cases['12 panels, flat'] = run_of(panelled(12), 0)
    for part, boat in (('columns', load_scene({}).boat), ('192 panels', panelled(192))):
        cases[f'{part}, all of it'] = run_of(in_waves(boat), 4)
    cases['columns, 4 waves'] = run_of(load_scene({}).boat, 4)
    for panels in (48, 192, 768):
        cases[f'{panels} panels, 4 waves'] = run_of(panelled(panels), 4)
    cases[f'{MANY} boats of 48 panels'] = (fleet(MANY, 4, boat=panelled(48)).step, 3)
    for threads in (1, 2):
        cases[f'{threads} threads'] = (fleet(MOST, 4, threads).step, 1)
    return best_of(cases, rounds)


def plain_step(rounds):
    """Return the time of a step in plain Python over that of a call, in a process of its own."""
    code = ('from step import best_of, simulation, small_call; best = best_of({'
            f'"call": small_call(), "step": (simulation().step, 50)}}, {rounds}); '
            'print(best["step"] / best["call"])')
    done = subprocess.run(
        [sys.executable, '-c', code], capture_output=True, text=True, check=True,
        cwd=os.path.dirname(os.path.abspath(__file__)),
        env={**os.environ, 'NUMBA_DISABLE_JIT': '1', 'PYTHONPATH': os.pathsep.join(
            filter(None, (os.getcwd(), os.environ.get('PYTHONPATH'))))})
    return float(done.stdout)


def main():
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[1])
    parser.add_argument('--rounds', type=int, default=30, help='repetitions of each case')
    rounds = parser.parse_args().rounds
    best = measure(rounds)
    periods = RUN_SECONDS * 100.0
    rows = [
        ('one boat, `sim.step()`, 4 columns, 4 waves, calls', best['step'] / best['call'], 8.0),
        ('one boat, a step in `sim.run`, calls', best['run'] / periods / best['call'], 3.0),
        ('1000 boats, 4 waves, over the trigonometry',
         best[f'{MANY} boats, 4 waves'] / best['trigonometry, 4 waves'], 1.2),
        ('1000 boats, 64 waves, over the trigonometry',
         best[f'{MANY} boats, 64 waves'] / best['trigonometry, 64 waves'], 0.15),
        ('10 000 boats, one thread over two', best['1 threads'] / best['2 threads'], -1.8),
        ('implicit over leapfrog, in `sim.run`', best['implicit'] / best['leapfrog'], 1.7),
        ('added mass and the wave force of Froude and Krylov over neither, 4 columns, 4 waves, '
         'in `sim.run`', best['columns, all of it'] / best['columns, 4 waves'], 1.3),
        ('the same of 192 panels',
         best['192 panels, all of it'] / best['192 panels, 4 waves'], 2.0),
        ('a box of 12 panels in flat water over its 4 columns, in `sim.run`',
         best['12 panels, flat'] / best['columns, flat'], 3.0),
        ('192 panels, 4 waves, a step in `sim.run`, calls',
         best['192 panels, 4 waves'] / periods / best['call'], 20.0),
        ('768 panels over 192, 4 waves, in `sim.run`',
         best['768 panels, 4 waves'] / best['192 panels, 4 waves'], 4.0),
        ('1000 boats of 48 panels, 4 waves, over 1000 steps of one in `sim.run`',
         best[f'{MANY} boats of 48 panels'] / (MANY * best['48 panels, 4 waves'] / periods), 1.2),
        ('one boat in plain Python, calls', plain_step(max(3, rounds // 5)), 450.0)]
    print(f'One call of `numpy.add` on four elements: {1e6 * best["call"]:.3f} us; the step is '
          f'{kind()}; {len(os.sched_getaffinity(0))} processors.\n')
    print('| work | measured | aim |\n|---|---|---|')
    for name, value, aim in rows:
        print(f'| {name} | {value:.3g} | {"at most" if aim > 0 else "at least"} {abs(aim):g} |')


if __name__ == '__main__':
    main()
