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
from ...physics.boat import State
from ...physics.scene import load_scene
from ...physics.simulation import Simulation
from ...physics.waves import Sea

BOATS = (1, 10, 100, 1000, 10000)
PROBES = {4: [2, 2], 8: [4, 2], 16: [4, 4]}
WAVES = (0, 1, 4, 16, 64)
# The case that is told in words, and by which integrators are compared.
BASE_PROBES, BASE_WAVES = 4, 4
# One measurement of a case lasts about this long, in s, or one step.
SLICE = 0.01
ROUNDS, QUICK_ROUNDS = 9, 3
ONE_THREAD = {f'{name}_NUM_THREADS': '1' for name in ('OMP', 'OPENBLAS', 'MKL')}
# Numbers of an array that stays in the cache beside another.
IN_CACHE = 16384
# Boats spread over a square of this many m, each on its own water.
SPREAD = 200.0


@dataclass(frozen=True)
class Case:
    """
    What is timed.

    ``kind`` 'step', or what it is held against, 'trigonometry': the cosines and sines of as many
    waves at as many probes of as many boats.
    """

    kind: str
    boats: int = 1
    probes: int = 0
    waves: int = 0
    integrator: str = 'leapfrog'
    damped: bool = True


def cases(quick):
    """Return all `Case`s to be timed in one run."""
    boats = BOATS[:-1] if quick else BOATS
    waves = WAVES[:-1] if quick else WAVES
    steps = [Case('step', b, p, w) for b in boats for p in PROBES for w in waves]
    base = partial(Case, probes=BASE_PROBES, waves=BASE_WAVES)
    variants = [base('step', b, integrator=integrator, damped=damped) for b in (1, 1000)
                for integrator, damped in (('leapfrog', False), ('implicit', True),
                                           ('implicit', False), ('rk4', True),
                                           ('symplectic_euler', True))]
    limits = [Case('trigonometry', b, p, w) for b in boats for p in PROBES for w in waves if w]
    return steps + variants + limits


def measure_alone(quick, rounds):
    """
    Return what `measure` does, taken in a fresh process with one thread.

    Threads of the linear algebra wait for work by spinning, and what they burn would be counted
    to whatever case comes next.
    """
    before = dict(os.environ)
    os.environ.update(ONE_THREAD)
    try:
        # Ctrl-C reaches both processes; only this one has something to say to it.
        with multiprocessing.get_context('spawn').Pool(
                1, signal.signal, (signal.SIGINT, signal.SIG_IGN)) as pool:
            return pool.apply(_measure_all, (quick, rounds))
    finally:
        os.environ.clear()
        os.environ.update(before)


def _measure_all(quick, rounds):
    progress = Progress(sys.stderr)
    best = measure(cases(quick), rounds, progress)
    progress.clear()
    return best


def measure(wanted, rounds, progress=lambda text: None):
    """
    Return {`Case`: best CPU time in s of one step of all its boats}.

    Interleaved repetitions, the best of ``rounds``: other work on the machine can only add.
    """
    work = {case: _work(case) for case in wanted}
    repeats, best = {}, {}
    for case, once in work.items():
        once()
        quickest = min(_timed(once, 1) for _ in range(3))
        repeats[case] = max(1, int(SLICE / max(quickest, 1e-6)))
        best[case] = math.inf
    for number in range(rounds):
        progress(f'round {number + 1} of {rounds}')
        for case, once in work.items():
            # The case before has left its own data in the cache.
            once()
            best[case] = min(best[case], _timed(once, repeats[case]))
    return best


def _timed(once, count):
    """Return the CPU time in s of one of ``count`` calls."""
    began = time.process_time()
    for _ in range(count):
        once()
    return (time.process_time() - began) / count


def simulation(case):
    """Return the `Simulation` of a case: the default boat, its fleet spread over the water."""
    parameters = {'hull.probes': PROBES[case.probes]}
    if not case.damped:
        parameters['damping.probe'] = 0.0
    scene = load_scene(parameters)
    start = scene.start
    if case.boats > 1:
        random = np.random.default_rng(8)
        position = np.tile(start.position, (case.boats, 1))
        position[:, :2] += random.uniform(-SPREAD / 2, SPREAD / 2, (case.boats, 2))
        start = State(position, start.orientation, start.velocity, start.angular_velocity)
    return Simulation(scene.boat, water(case), start, rate=100.0, integrator=case.integrator)


def water(case):
    """Return the `Sea` of a case."""
    random, count = np.random.default_rng(7), case.waves
    return Sea(np.stack([np.full(count, 0.3 / math.sqrt(max(count, 1))),
                         random.uniform(3.0, 8.0, count), random.uniform(-0.5, 0.5, count),
                         random.uniform(0.0, 6.28, count)], axis=1))


def _work(case):
    """Return a function without arguments that does the work of a case once."""
    return simulation(case).step if case.kind == 'step' else _trigonometry(case)


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
