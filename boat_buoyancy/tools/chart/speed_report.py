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

"""Speed in words: the tables, the ratios and the machine, as the text of ``speed.md``."""

import csv
from functools import partial
import os
import platform

import numpy as np

from .speed import BASE_PROBES, BASE_WAVES, Case, PROBES, ROUNDS


def microseconds(best, case):
    """Return the time per boat-step in microseconds."""
    return 1e6 * best[case] / case.boats


def slope(best, boats=1000, probes=BASE_PROBES):
    """
    Return [(waves x probes, microseconds over the line's)] of a straight line through the cost.

    The line is fitted to the cost per boat-step over waves x probes, waves above 0.
    """
    points = [(case.waves * case.probes, microseconds(best, case)) for case in best
              if case.kind == 'step' and case.boats == boats and case.waves
              and case.integrator == 'leapfrog' and case.damped]
    work, cost = np.array(points).T
    # Relative weights: the line is to be as good at small cost as at large.
    line = np.polynomial.Polynomial.fit(work, cost, 1, w=1.0 / cost)
    return [(int(x), float(y / line(x))) for x, y in sorted(points)]


def machine():
    """Return the machine and its software as one line."""
    name = platform.processor() or platform.machine()
    try:
        with open('/proc/cpuinfo', encoding='utf-8') as file:
            name = next((line.partition(':')[2].strip() for line in file
                         if line.startswith('model name')), name)
    except OSError:
        pass
    return (f'{name}, {os.cpu_count()} cores, {platform.system()}, '
            f'Python {platform.python_version()}, NumPy {np.__version__}')


def text(best, rounds=ROUNDS):
    """Return ``speed.md``."""
    steps = [case for case in best if case.kind == 'step' and case.integrator == 'leapfrog'
             and case.damped]
    boats = sorted({case.boats for case in steps})
    waves = sorted({case.waves for case in steps})
    lines = [
        '# The speed of the step', '',
        'CPU time per boat-step in microseconds, leapfrog, default damping, one thread; beside '
        'it in brackets the limit that the trigonometry alone sets: as many `numpy.cos` and '
        '`numpy.sin` in double, in the same run.  Best of '
        f'{rounds} interleaved repetitions.', '', f'Machine: {machine()}.', '',
        'To repeat it, on a quiet machine: `buoyancy_chart --speed --out doc`.', '']
    for probes in PROBES:
        lines += [f'## {probes} probes', '',
                  '| waves | ' + ' | '.join(f'{b} boat{"s" if b > 1 else ""}' for b in boats)
                  + ' |', '|---' * (len(boats) + 1) + '|']
        for wave in waves:
            cells = [_cell(best, b, probes, wave) for b in boats]
            lines.append(f'| {wave} | ' + ' | '.join(cells) + ' |')
        lines.append('')
    lines += ['## Fleets', '', *_fleets(best), '', *_integrators(best), '']
    return '\n'.join(lines)


def _cell(best, boats, probes, waves):
    value = f'{microseconds(best, Case("step", boats, probes, waves)):.3g}'
    limit = Case('trigonometry', boats, probes, waves)
    return f'{value} ({microseconds(best, limit):.3g})' if limit in best else value


def _fleets(best):
    """Return the lines on what a fleet saves, and how its cost grows with waves times probes."""
    base = partial(Case, probes=BASE_PROBES, waves=BASE_WAVES)
    alone, many, limit = (microseconds(best, case) for case in (
        base('step', 1), base('step', 1000), base('trigonometry', 1000)))
    yield (f'With {BASE_PROBES} probes and {BASE_WAVES} waves, one boat alone costs '
           f'{alone / many:.3g} times what one of 1000 does, and that one '
           f'{many / limit:.3g} times its trigonometry.')
    yield ''
    parts = [part for _, part in slope(best)]
    yield ('Fitted by a straight line over waves x probes, the cost per boat of 1000 lies between '
           f'{min(parts):.2f} and {max(parts):.2f} times that line in all {len(parts)} cases with '
           'waves.')


def _integrators(best):
    """Return the table of integrators and damping."""
    lines = ['## Integrators and damping', '', 'Microseconds per boat-step.', '',
             '| integrator | probe damping | 1 boat | 1000 boats |', '|---|---|---|---|']
    kinds = {(case.integrator, case.damped) for case in best if case.kind == 'step'}
    for integrator, damped in sorted(kinds, key=lambda kind: microseconds(best, Case(
            'step', 1, BASE_PROBES, BASE_WAVES, *kind))):
        one, many = (microseconds(best, Case('step', count, BASE_PROBES, BASE_WAVES,
                                             integrator, damped)) for count in (1, 1000))
        lines.append(f'| {integrator} | {"yes" if damped else "no"} | {one:.3g} | {many:.3g} |')
    return lines


def write_table(path, best):
    """Write what was measured as CSV."""
    with open(path, 'w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(['kind', 'boats', 'probes', 'waves', 'integrator', 'probe_damping',
                         'microseconds_per_boat_step'])
        for case in best:
            writer.writerow([case.kind, case.boats, case.probes, case.waves, case.integrator,
                             int(case.damped), f'{microseconds(best, case):.4g}'])
