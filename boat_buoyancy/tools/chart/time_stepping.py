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

"""Part one of the chart: the error of every integrator over its cost, on scenes of all kinds."""

from functools import lru_cache

from .accuracy import force_evaluations, measure, reference_error, step_seconds
from .scenes import BY_NAME
from .table import cost_to_reach, observed_order, Row

PART = 'time stepping'
INTEGRATORS = ('leapfrog', 'rk4', 'implicit', 'symplectic_euler', 'euler')
# The scene and how many of the finest steps an order is read from: few where errors are smooth,
# many where they scatter with the place of a kink within the step.
SMOOTH, KINKED = ('free decay', 4), ('drop', 12)
# Force evaluations per simulated second; the integrators are compared at equal cost.  Two
# interleaved series that double at every step.
FULL_COSTS = tuple(base * 2 ** k for k in range(9) for base in (5, 7))
QUICK_COSTS = tuple(5 * 2 ** k for k in range(6))


@lru_cache(maxsize=1)
def solution(name, quick):
    """Return the run and the reference of a scene, solved once in every process."""
    run = BY_NAME[name].run(quick)
    return run, run.solve()


def tasks(quick):
    """Return the arguments of `measured`, one tuple for each piece of work."""
    return [(name, integrator, quick) for name in BY_NAME
            for integrator in (*INTEGRATORS, None)]


def measured(task):
    """Return the rows of one integrator on one scene; of the reference itself for None."""
    name, integrator, quick = task
    run, truth = solution(name, quick)
    if integrator is None:
        error = reference_error(run, truth)
        return [Row(PART, name, 'reference', probes=len(run.boat.hull.positions),
                    position=error.position, rotation=error.rotation, error=error.total)]
    rows = []
    for cost in QUICK_COSTS if quick else FULL_COSTS:
        rate = cost / force_evaluations(integrator, 1.0)
        if rate * run.duration < 10:
            continue
        error = measure(run, truth, integrator, rate)
        rows.append(Row(PART, name, integrator, rate, probes=len(run.boat.hull.positions),
                        evaluations=force_evaluations(integrator, rate),
                        position=error.position, rotation=error.rotation, error=error.total))
    return rows


def step_costs(quick):
    """Return the CPU time in s of one step, by (scene, integrator); run it on a quiet machine."""
    return step_seconds({name: scene.run(quick) for name, scene in BY_NAME.items()},
                        INTEGRATORS, repeats=3 if quick else 9)


def orders(rows, scene, finest):
    """Return {integrator: observed order} on a scene, over its ``finest`` steps."""
    found = {}
    for integrator in INTEGRATORS:
        measured_of = sorted(_of(rows, scene, integrator), key=lambda row: -row.rate)
        if measured_of:
            found[integrator] = observed_order(measured_of[:finest])
    return found


def ranking(rows, scene, tolerance, cost='evaluations'):
    """Return [(integrator, cost to reach the tolerance)] of one scene, cheapest first."""
    measured_of = {integrator: _of(rows, scene, integrator) for integrator in INTEGRATORS}
    costs = {integrator: cost_to_reach(found, tolerance, cost)
             for integrator, found in measured_of.items() if found}
    return sorted(costs.items(), key=lambda pair: pair[1])


def _of(rows, scene, integrator):
    """Return the rows of one integrator on one scene."""
    return [row for row in rows
            if (row.part, row.scene, row.integrator) == (PART, scene, integrator)]
