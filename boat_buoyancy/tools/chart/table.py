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

"""The chart's table: one row per measurement, one CSV file for all parts."""

import csv
from dataclasses import asdict, dataclass, fields
import math


@dataclass(frozen=True)
class Row:
    """
    One measurement; fields that do not apply are None and stay empty in the file.

    ``part`` 'time stepping', 'model' or 'both'; ``scene`` or hull; ``integrator``; ``rate`` steps
    per s; ``model`` of the hull, springs, columns or panels, with so many ``probes`` and
    ``panels``; ``grid`` of its probes, as 4x2, and ``panel_size`` m as a parameter file has them;
    ``quantity`` that was compared; ``evaluations`` of the force and ``cpu`` s per simulated
    second; ``position``, ``rotation`` and ``error`` (both in one) m; ``percent`` of the true
    value; ``front`` 1 on the front of settings that nothing else beats, else 0; ``parts`` of what
    moves a hull in waves, as of `fidelity`.
    """

    part: str
    scene: str
    integrator: str = None
    rate: float = None
    model: str = None
    probes: int = None
    panels: int = None
    grid: str = None
    panel_size: float = None
    quantity: str = None
    evaluations: float = None
    cpu: float = None
    position: float = None
    rotation: float = None
    error: float = None
    percent: float = None
    front: int = None
    parts: str = None


UNITS = {'rate': 'rate_hz', 'panel_size': 'panel_size_m',
         'evaluations': 'force_evaluations_per_s', 'cpu': 'cpu_s_per_s',
         'position': 'position_error_m', 'rotation': 'rotation_error_m', 'error': 'error_m',
         'percent': 'error_percent', 'front': 'on_front'}
COLUMNS = tuple(UNITS.get(field.name, field.name) for field in fields(Row))


def write(path, rows):
    """Write rows as CSV, numbers to six digits."""
    with open(path, 'w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(COLUMNS)
        for row in rows:
            writer.writerow(['' if value is None else f'{value:.6g}'
                             if isinstance(value, float) else value
                             for value in asdict(row).values()])


def read(path):
    """Return the rows of a CSV file that `write` has written."""
    kinds = {field.name: field.type for field in fields(Row)}
    with open(path, encoding='utf-8') as file:
        return [Row(**{name: kinds[name](text) if text else None
                       for name, text in zip(kinds, line.values())})
                for line in csv.DictReader(file)]


def cost_to_reach(rows, tolerance, cost='evaluations'):
    """
    Return what it costs to reach ``tolerance`` m from where on every finer step reaches it.

    ``rows`` are of one integrator on one scene; between two steps the line through both, on
    logarithmic axes, is read off.  Infinite when no step reaches it.
    """
    ordered = sorted(rows, key=lambda row: row.rate)
    failing = [i for i, row in enumerate(ordered) if not row.error <= tolerance]
    if not failing:
        return getattr(ordered[0], cost)
    if failing[-1] == len(ordered) - 1:
        return math.inf
    before, after = ordered[failing[-1]], ordered[failing[-1] + 1]
    if not math.isfinite(before.error):
        return getattr(after, cost)
    part = math.log(before.error / tolerance) / math.log(before.error / after.error)
    return getattr(before, cost) * (getattr(after, cost) / getattr(before, cost)) ** part


def observed_order(rows):
    """Return the slope of log error over log step, fitted to ``rows`` of one integrator."""
    rows = [row for row in rows if math.isfinite(row.error) and row.error > 0.0]
    steps = [-math.log(row.rate) for row in rows]
    errors = [math.log(row.error) for row in rows]
    step, error = sum(steps) / len(rows), sum(errors) / len(rows)
    return (sum((s - step) * (e - error) for s, e in zip(steps, errors))
            / sum((s - step) ** 2 for s in steps))
