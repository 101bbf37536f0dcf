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

"""The speed of the step: what one boat and a fleet cost, beside what their cosines alone cost."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
import math
import multiprocessing
import os
import signal
import sys
import time

import numpy as np

from ..progress import Progress
from ...physics.boat.state import State
from ...physics.scene.scene import load_scene
from ...physics.sea.waves import Sea
from ...physics.stepping.fleet import Fleet
from ...physics.stepping.simulation import Simulation

BOATS = (1, 10, 100, 1000, 10000)
PROBES = {4: [2, 2], 8: [4, 2], 16: [4, 4]}
WAVES = (0, 1, 4, 16, 64)
# The case that is told in words, and by which integrators are compared.
BASE_PROBES, BASE_WAVES = 4, 4
# Fleets from this size on are stepped with all processors, too.
LARGE_FLEET = 1000
# One measurement of a case lasts about this long, in s, or one step.
SLICE = 0.01
ROUNDS, QUICK_ROUNDS = 9, 3
RATE, RUN_STEPS = 100.0, 1000
# Threads of the linear algebra wait for work by spinning, and what they burn would be counted to
# whatever case comes next.
ONE_THREAD = {f'{name}_NUM_THREADS': '1' for name in ('OMP', 'OPENBLAS', 'MKL')}
PLAIN = {**ONE_THREAD, 'NUMBA_DISABLE_JIT': '1'}
# Numbers of an array that stays in the cache beside another.
IN_CACHE = 16384
# Boats spread over a square of this many m, each on its own water.
SPREAD = 200.0


@dataclass(frozen=True)
class Case:
    """
    What is timed.

    ``kind`` is 'step', one call of it for all boats in one thread; 'run', a step of one boat in a
    run of many; 'threads', a step with all processors; 'plain', 'step' in plain Python; or what
    they are held against, 'trigonometry': the cosines and sines, by NumPy, of as many waves at as
    many probes of as many boats.
    """

    kind: str
    boats: int = 1
    probes: int = BASE_PROBES
    waves: int = BASE_WAVES
    integrator: str = 'leapfrog'
    damped: bool = True


@dataclass(frozen=True)
class Work:
    """What a case does: ``once`` does ``steps`` steps, timed by ``clock``."""

    once: Callable
    steps: int = 1
    clock: Callable = time.process_time


def cases(quick):
    """Return all `Case`s to be timed in one run."""
    boats = BOATS[:-1] if quick else BOATS
    waves = WAVES[:-1] if quick else WAVES
    size = [(p, w) for p in PROBES for w in waves]
    variants = [(integrator, damped) for integrator, damped in (
        ('leapfrog', False), ('implicit', True), ('implicit', False), ('rk4', True),
        ('symplectic_euler', True), ('euler', True))]
    return ([Case('step', b, *of) for b in boats for of in size]
            + [Case(kind, 1, *of) for kind in ('run', 'plain') for of in size]
            + [Case('threads', b, *of) for b in boats if b >= LARGE_FLEET for of in size]
            + [Case('trigonometry', b, *of) for b in boats for of in size if of[1]]
            + [Case(kind, b, integrator=integrator, damped=damped)
               for kind, b in (('run', 1), ('step', LARGE_FLEET), ('plain', 1))
               for integrator, damped in variants])


def measure_alone(quick, rounds):
    """Return what `measure` does, taken in two fresh processes: compiled, and in plain Python."""
    wanted = cases(quick)
    plain = [case for case in wanted if case.kind == 'plain']
    compiled = [case for case in wanted if case.kind != 'plain']
    found = {**in_process(ONE_THREAD, compiled, rounds), **in_process(PLAIN, plain, rounds)}
    return {case: found[case] for case in wanted}


def in_process(environment, wanted, rounds):
    """Return what `measure` does, in a process started with some environment variables."""
    before = dict(os.environ)
    os.environ.update(environment)
    try:
        # Ctrl-C reaches both processes; only this one has something to say to it.
        with multiprocessing.get_context('spawn').Pool(
                1, signal.signal, (signal.SIGINT, signal.SIG_IGN)) as pool:
            return pool.apply(_measure_with_progress, (wanted, rounds))
    finally:
        os.environ.clear()
        os.environ.update(before)


def _measure_with_progress(wanted, rounds):
    progress = Progress(sys.stderr)
    best = measure(wanted, rounds, progress)
    progress.clear()
    return best


def measure(wanted, rounds, progress=lambda text: None):
    """
    Return {`Case`: best time in s of one step of all its boats}: of CPU, of threads by the clock.

    Interleaved repetitions, the best of ``rounds``: other work on the machine can only add.
    """
    progress('compiling and warming up')
    work = {case: _work(case) for case in wanted}
    repeats, best = {}, {}
    for case, of in work.items():
        of.once()
        quickest = min(_timed(of, 1) for _ in range(3))
        repeats[case] = max(1, int(SLICE / max(quickest * of.steps, 1e-6)))
        best[case] = math.inf
    for number in range(rounds):
        progress(f'round {number + 1} of {rounds}')
        for case, of in work.items():
            # The case before has left its own data in the cache.
            of.once()
            best[case] = min(best[case], _timed(of, repeats[case]))
    return best


def _timed(work, count):
    """Return the time in s of one step, of ``count`` calls."""
    began = work.clock()
    for _ in range(count):
        work.once()
    return (work.clock() - began) / (count * work.steps)


def moving(case):
    """Return the `Simulation` or `Fleet` of a case: default boats, spread over the water."""
    parameters = {'hull.probes': PROBES[case.probes]}
    if not case.damped:
        parameters['damping.probe'] = 0.0
    scene, sea = load_scene(parameters), water(case)
    options = {'rate': RATE, 'integrator': case.integrator}
    if case.boats == 1:
        return Simulation(scene.boat, sea, scene.start, **options)
    position = np.tile(scene.start.position, (case.boats, 1))
    position[:, :2] += np.random.default_rng(8).uniform(
        -SPREAD / 2, SPREAD / 2, (case.boats, 2))
    return Fleet([scene.boat] * case.boats, [sea] * case.boats,
                 State(position, scene.start.orientation),
                 threads=None if case.kind == 'threads' else 1, **options)


def water(case):
    """Return the `Sea` of a case."""
    random, count = np.random.default_rng(7), case.waves
    return Sea(np.stack([np.full(count, 0.3 / math.sqrt(max(count, 1))),
                         random.uniform(3.0, 8.0, count), random.uniform(-0.5, 0.5, count),
                         random.uniform(0.0, 6.28, count)], axis=1))


def _work(case):
    """Return the `Work` of a case."""
    if case.kind == 'trigonometry':
        return Work(_trigonometry(case))
    started = moving(case)
    if case.kind == 'run':
        return Work(partial(started.run, RUN_STEPS / RATE), RUN_STEPS)
    return Work(started.step, clock=(
        time.perf_counter if case.kind == 'threads' else time.process_time))


def _trigonometry(case):
    """Return the work of the trigonometry alone, in blocks of boats that stay in the cache."""
    width = max(1, min(case.boats, IN_CACHE // (case.waves * case.probes)))
    blocks = math.ceil(case.boats / width)
    angle = np.random.default_rng(7).uniform(0.0, 2.0 * math.pi,
                                             (case.waves * case.probes, width))
    out = np.empty_like(angle)

    def both():
        for _ in range(blocks):
            np.cos(angle, out=out)
            np.sin(angle, out=out)
    return both
