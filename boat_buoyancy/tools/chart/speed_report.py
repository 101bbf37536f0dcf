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

"""Speed in words: the tables, the ratios and the machine, as the text of ``step_speed.md``."""

import csv
from importlib.metadata import PackageNotFoundError, version
import os
import platform

import numpy as np

from .speed import Case, LARGE_FLEET, PROBES, ROUNDS, RUN_STEPS

# The columns of a table beside those of fleets: kind of case, and heading.
ALONE = {'plain': '1 boat, plain Python', 'step': '1 boat', 'run': '1 boat, in a run'}


# Measured once, beside the step in NumPy that release 0.1.0 had.
PEERS = (
    'A peer, from another run, in which one boat in four waves took the NumPy step of release '
    '0.1.0 24.7 microseconds: Jolt Physics in WebAssembly, an exact box in flat water, took 6.6 '
    'microseconds for one boat and 2.1 per boat for 1000.')


def microseconds(best, case):
    """Return the time per boat-step in microseconds."""
    return 1e6 * best[case] / case.boats


def ratio(best, case, other):
    """Return how many times the time per boat-step of ``other`` a case takes."""
    return microseconds(best, case) / microseconds(best, other)


def sizes(best):
    """Return the fleets (boats), and the numbers of waves, that were measured."""
    steps = [case for case in best if case.kind == 'step']
    return (sorted({case.boats for case in steps} - {1}), sorted({case.waves for case in steps}))


def machine():
    """Return the machine and its software as one line."""
    name = platform.processor() or platform.machine()
    try:
        with open('/proc/cpuinfo', encoding='utf-8') as file:
            name = next((line.partition(':')[2].strip() for line in file
                         if line.startswith('model name')), name)
    except OSError:
        pass
    try:
        numba = f'Numba {version("numba")}'
    except PackageNotFoundError:
        numba = 'no Numba'
    return (f'{name}, {os.cpu_count()} cores, {platform.system()}, '
            f'Python {platform.python_version()}, NumPy {np.__version__}, {numba}')


def text(best, rounds=ROUNDS):
    """Return ``step_speed.md``."""
    fleets, waves = sizes(best)
    threaded = [boats for boats in fleets if boats >= LARGE_FLEET]
    lines = [
        '# The speed of the step', '',
        'Time per boat-step in microseconds, leapfrog, default damping. Fleets are stepped by one '
        'thread; in brackets the same water by `numpy.cos` and `numpy.sin` alone, of as many '
        'angles in double. In plain Python a step is what it is where Numba is not installed. In '
        f'a run is a step of `run` over {RUN_STEPS}, its trajectory included. Of threads the time '
        'of the clock is told, of all else that of the CPU. Best of '
        f'{rounds} interleaved repetitions.', '', f'Machine: {machine()}.', '',
        'To repeat it, on a quiet machine: `buoyancy_chart --speed --out doc`.', '']
    heads = ['waves', *ALONE.values(), *(f'{boats} boats' for boats in fleets),
             *(f'{boats} boats, all threads' for boats in threaded)]
    for probes in PROBES:
        lines += [f'## {probes} probes', '', _line(heads), '|---' * len(heads) + '|']
        for wave in waves:
            alone = [f'{microseconds(best, Case(kind, 1, probes, wave)):.3g}' for kind in ALONE]
            together = [f'{microseconds(best, Case("threads", boats, probes, wave)):.3g}'
                        for boats in threaded]
            lines.append(_line([wave, *alone, *(
                _beside_limit(best, Case('step', boats, probes, wave)) for boats in fleets),
                *together]))
        lines.append('')
    return '\n'.join([*lines, '## Ratios', '', *_ratios(best), '', PEERS, '', *_integrators(best),
                      ''])


def _line(cells):
    return '| ' + ' | '.join(map(str, cells)) + ' |'


def _limit(case):
    """Return the trigonometry of a case."""
    return Case('trigonometry', case.boats, case.probes, case.waves)


def _beside_limit(best, case):
    cell = f'{microseconds(best, case):.3g}'
    limit = _limit(case)
    return f'{cell} ({microseconds(best, limit):.3g})' if limit in best else cell


def _ratios(best):
    """Yield the lines on what compiling, runs, fleets and threads save."""
    fleets, waves = sizes(best)
    one, many, largest = Case('step'), Case('step', LARGE_FLEET), fleets[-1]
    yield f'With {one.probes} probes and {one.waves} waves:'
    yield ''
    yield ('- one boat alone costs '
           f'{ratio(best, one, many):.3g} times what one of {LARGE_FLEET} does, '
           f'and {ratio(best, one, Case("run")):.3g} times a step of a run;')
    yield f'- plain Python costs {ratio(best, Case("plain"), one):.3g} times that one boat;'
    yield (f'- one of {LARGE_FLEET} boats costs {ratio(best, many, _limit(many)):.3g} times its '
           'trigonometry by NumPy'
           + ''.join(f', with {count} waves {ratio(best, case, _limit(case)):.3g} times'
                     for count in waves[-1:]
                     for case in [Case('step', LARGE_FLEET, waves=count)]) + ';')
    yield (f'- {largest} boats take one thread '
           f'{ratio(best, Case("step", largest), Case("threads", largest)):.3g} times as long as '
           'all processors.')


def _integrators(best):
    """Yield the table of integrators and damping."""
    yield from ('## Integrators and damping', '', 'Microseconds per boat-step.', '')
    kinds = [('plain', 1), ('run', 1), ('step', LARGE_FLEET)]
    yield _line(['integrator', 'probe damping', ALONE['plain'], ALONE['run'],
                 f'{LARGE_FLEET} boats'])
    yield '|---' * 5 + '|'
    found = {(case.integrator, case.damped) for case in best if case.kind == 'run'}
    rows = [(integrator, damped, *(microseconds(best, Case(
        kind, boats, integrator=integrator, damped=damped)) for kind, boats in kinds))
        for integrator, damped in found]
    for integrator, damped, *times in sorted(rows, key=lambda row: row[-1]):
        yield _line([integrator, 'yes' if damped else 'no', *(f'{t:.3g}' for t in times)])


def write_table(path, best):
    """Write what was measured as CSV."""
    with open(path, 'w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(['kind', 'boats', 'probes', 'waves', 'integrator', 'probe_damping',
                         'microseconds_per_boat_step'])
        for case in best:
            writer.writerow([case.kind, case.boats, case.probes, case.waves, case.integrator,
                             int(case.damped), f'{microseconds(best, case):.4g}'])
