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

"""Speed in words: the table, the ratios and the machine, as the text of ``speed.md``."""

import csv
import os
import platform

import numpy as np

from .speed import (BASE_PROBES, BASE_WAVES, Case, PROBES, ROUNDS, single_precision_error)


def microseconds(best, case):
    """Return the time per boat-step in microseconds."""
    return 1e6 * best[case] / case.boats


def aims(best):
    """Return [(what, value, aim, unit)] of the ratios that the step is held to."""
    def step(boats, **options):
        return microseconds(best, Case('step', boats, BASE_PROBES, BASE_WAVES, **options))

    limit = microseconds(best, Case('trigonometry', 1000, BASE_PROBES, BASE_WAVES))
    small = 1e6 * best[Case('small call')]
    rows = [
        ('one boat, over a small NumPy call', step(1) / small, 120.0),
        ('1000 boats, per boat over its trigonometry', step(1000) / limit, 2.5),
        ('one boat alone over one of 1000', step(1) / step(1000), -25.0)]
    for name, boats, bound, unit in (('one boat', 1, 240.0, small),
                                     ('1000 boats', 1000, 5.0, limit)):
        over = 'a small NumPy call' if boats == 1 else 'its trigonometry'
        rows.append((f'implicit, {name}, over {over}',
                     step(boats, method='implicit') / unit, bound))
    large = Case('step', 10000, BASE_PROBES, BASE_WAVES)
    if large in best:
        rows.append(('10 000 boats over 1000, per boat', microseconds(best, large) / step(1000),
                     1.2))
    return rows


def slope(best, boats=1000, probes=BASE_PROBES):
    """
    Return [(waves x probes, microseconds over the line's)] of a straight line through the cost.

    The line is fitted to the cost per boat-step over waves x probes, waves above 0.
    """
    points = [(case.waves * case.probes, microseconds(best, case)) for case in best
              if case.kind == 'step' and case.boats == boats and case.waves
              and case.method == 'leapfrog' and case.damped]
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
    steps = [case for case in best if case.kind == 'step' and case.method == 'leapfrog'
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
    lines += ['## Ratios', '', f'{BASE_PROBES} probes, {BASE_WAVES} waves.  A small NumPy call '
              f'(`numpy.add` on 4 elements) takes {1e6 * best[Case("small call")]:.2f} '
              'microseconds here.', '', '| ratio | measured | aim | met |', '|---|---|---|---|']
    for name, value, aim in aims(best):
        met = value <= aim if aim > 0 else value >= -aim
        lines.append(f'| {name} | {value:.3g} | {"at most" if aim > 0 else "at least"} '
                     f'{abs(aim):g} | {"yes" if met else "no"} |')
    lines += ['', *_linearity(best), '', *_methods(best), '', *_single(best), '']
    return '\n'.join(lines)


def _cell(best, boats, probes, waves):
    value = f'{microseconds(best, Case("step", boats, probes, waves)):.3g}'
    limit = Case('trigonometry', boats, probes, waves)
    return f'{value} ({microseconds(best, limit):.3g})' if limit in best else value


def _linearity(best):
    """Return the lines on how the cost of a fleet grows with waves times probes."""
    parts = [part for _, part in slope(best)]
    return [f'Per boat of 1000, the cost over waves x probes is a straight line: the '
            f'{len(parts)} cases with waves lie between {min(parts):.2f} and {max(parts):.2f} '
            'times the line fitted to them.']


def _methods(best):
    """Return the table of step methods and damping."""
    lines = ['## Methods and damping', '', 'Microseconds per boat-step.', '',
             '| method | probe damping | 1 boat | 1000 boats |', '|---|---|---|---|']
    kinds = {(case.method, case.damped) for case in best if case.kind == 'step'}
    for method, damped in sorted(kinds, key=lambda kind: microseconds(best, Case(
            'step', 1, BASE_PROBES, BASE_WAVES, *kind))):
        one, many = (microseconds(best, Case('step', count, BASE_PROBES, BASE_WAVES, method,
                                             damped)) for count in (1, 1000))
        lines.append(f'| {method} | {"yes" if damped else "no"} | {one:.3g} | {many:.3g} |')
    return lines


def _single(best):
    """Return the lines on cosines in single precision."""
    lines = ['## Single precision', '',
             'What cosines and sines in single precision would bring, their angles reduced in '
             f'double: an error of {single_precision_error():.1g} of the amplitude, and these '
             f'microseconds per boat-step ({BASE_PROBES} probes).  The package stays in double.',
             '', '| waves | 1 boat, double | 1 boat, single | 1000 boats, double | '
             '1000 boats, single |', '|---|---|---|---|---|']
    for waves in sorted({case.waves for case in best if case.kind == 'single'}):
        cells = [f'{microseconds(best, Case(kind, boats, BASE_PROBES, waves)):.3g}'
                 for boats in (1, 1000) for kind in ('step', 'single')]
        lines.append(f'| {waves} | ' + ' | '.join(cells) + ' |')
    return lines


def write_table(path, best):
    """Write what was measured as CSV."""
    with open(path, 'w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(['kind', 'boats', 'probes', 'waves', 'method', 'probe_damping',
                         'microseconds_per_boat_step'])
        for case in best:
            writer.writerow([case.kind, case.boats, case.probes, case.waves, case.method,
                             int(case.damped), f'{microseconds(best, case):.4g}'])
