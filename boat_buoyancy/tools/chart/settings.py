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

"""Settings that a parameter file can have, and what each costs and is worth on one stretch."""

from dataclasses import dataclass, field
import math

from .accuracy import apart, boat_length, force_evaluations, measure, Run, step_seconds
from .reference_solution import Reference
from .stretch import Stretch
from ...physics.scene.scene import scene_from_values

# For study only, never the best: euler is not among them.
INTEGRATORS = ('leapfrog', 'rk4', 'implicit', 'symplectic_euler')
# Steps per simulated second, about a factor of the square root of 2 apart.
RATES = (1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0, 11.0, 16.0, 22.0, 32.0, 45.0, 64.0, 90.0, 128.0,
         180.0, 256.0, 360.0, 512.0, 720.0, 1024.0, 1440.0, 2048.0)
# Probes along and across a hull of a given shape.
PROBES = ((2, 2), (3, 2), (4, 2), (4, 4), (6, 4), (8, 8))
# What stands for the hull itself: this many columns along and across, and fewer of them for how
# far that is from the limit of ever more.
HULL, COARSER_HULL = (16, 16), (12, 12)
# Relative to the errors of a handful of probes nothing; it saves the restart at each of the
# thousands of kinks of a hull of many.
HULL_TOLERANCE = 1e-8


@dataclass(frozen=True)
class Setting:
    """An integrator, its steps per second and, for a hull of a shape, the probes under it."""

    integrator: str
    rate: float
    probes: tuple | None = None

    @property
    def probe_count(self):
        """Return how many probes, 0 for those the scene has."""
        return 0 if self.probes is None else self.probes[0] * self.probes[1]

    def values(self):
        """Return the parameters as {name: value}."""
        values = {'integrator': self.integrator, 'rate': self.rate, 'substeps': 1}
        if self.probes is not None:
            values['hull.probes'] = list(self.probes)
        return values

    def lines(self):
        """Return the lines of a parameter file, groups nested as the shipped files have them."""
        lines, group = [], None
        for name, value in self.values().items():
            above, _, last = name.rpartition('.')
            if above and above != group:
                lines.append(f'{above}:')
            group = above
            lines.append(f'{"  " if above else ""}{last}: {value}')
        return lines

    def __str__(self):
        """Return it in a few words."""
        probes = '' if self.probes is None else f', {self.probes[0]}x{self.probes[1]} probes'
        return f'{self.integrator} {self.rate:g} Hz{probes}'


@dataclass(frozen=True)
class Result:
    """A setting measured: ``error`` m, ``cpu`` s and ``evaluations`` per simulated second."""

    setting: Setting
    error: float
    cpu: float
    evaluations: float


@dataclass(frozen=True)
class Trial:
    """
    One stretch of a scene with its true motion, on which settings are measured.

    ``truth`` is the motion of the hull itself, or of the probes where no hull is given;
    ``own_error`` m, how far that truth is from a finer or coarser one.
    """

    stretch: Stretch
    truth: Reference
    own_error: float
    length: float
    _runs: dict = field(default_factory=dict)

    @classmethod
    def of(cls, stretch):
        """Return the trial of a stretch, its truth solved."""
        if not has_hull(stretch.given):
            run = stretch.run()
            truth = run.solve()
            return cls(stretch, truth, apart(run, truth, run.solve(tolerance=1e-13)).total,
                       run.length)
        options = {'tolerance': HULL_TOLERANCE, 'restart': False}
        run = stretch.run(hull_values(HULL))
        truth = run.solve(**options)
        coarser = stretch.run(hull_values(COARSER_HULL)).solve(**options)
        return cls(stretch, truth, apart(run, truth, coarser).total, boat_length(run.boat))

    def run(self, probes):
        """Return the `Run` of this stretch with other probes; None = the scene's own."""
        if probes not in self._runs:
            run = self.stretch.run({} if probes is None else {'hull.probes': list(probes)})
            self._runs[probes] = Run(str(probes), run.boat, run.sea, run.start, run.duration,
                                     self.length)
        return self._runs[probes]

    def error(self, setting):
        """Return how far a `Setting` is from the truth, in m."""
        return measure(self.run(setting.probes), self.truth, setting.integrator,
                       setting.rate).total


def has_hull(given):
    """Return True when the boat has the shape of a hull, so that its probes can be chosen."""
    return 'probes.positions' not in given


def hull_values(probes):
    """Return the parameters that make probes stand for the hull as it is."""
    return {'hull.probes': list(probes), 'probes.law': 'column'}


def choices(given):
    """Return the probes to choose from, its own among them; a scene of given probes keeps them."""
    if not has_hull(given):
        return (None,)
    own = tuple(scene_from_values(given).values['hull.probes'])
    return tuple(sorted({*PROBES, own}, key=lambda probes: (probes[0] * probes[1], probes)))


def step_costs(trial, integrators=INTEGRATORS, repeats=5):
    """Return {(probes, integrator): CPU time in s of one step}, measured here and now."""
    probes = choices(trial.stretch.given)
    return step_seconds({p: trial.run(p) for p in probes}, integrators, repeats=repeats)


def candidates(seconds, rates=RATES):
    """
    Return all settings as (cpu s per simulated s, `Setting`), cheapest first.

    ``seconds`` as from `step_costs`, fewest probes first.
    """
    found, cheapest = [], {}
    # More probes never cost less; where it looks so, the clock was disturbed.
    for (probes, integrator), second in reversed(seconds.items()):
        cheapest[integrator] = min(cheapest.get(integrator, math.inf), second)
        found += [(rate * cheapest[integrator], Setting(integrator, rate, probes))
                  for rate in rates]
    return sorted(found, key=lambda pair: (pair[0], pair[1].probe_count))


def is_allowed(given, setting):
    """Return True when a scene with this setting is not refused as unstable."""
    try:
        warnings(given, setting)
    except ValueError:
        return False
    return True


def warnings(given, setting):
    """Return the sentences that a scene with this setting is started with."""
    return scene_from_values({**given, **setting.values()}).simulation().warnings


def present(trial, measured):
    """
    Return the `Result` of the scene as it stands, or None where its step is not stable.

    ``measured`` as from `candidates`, for the time of a step.
    """
    try:
        simulation = scene_from_values(trial.stretch.given).simulation()
    except ValueError:
        return None
    own = None
    if has_hull(trial.stretch.given):
        own = tuple(scene_from_values(trial.stretch.given).values['hull.probes'])
    setting = Setting(simulation.integrator, simulation.rate * simulation.substeps, own)
    for cpu, other in measured:
        if (other.integrator, other.probes) == (setting.integrator, own):
            return result(trial, cpu / other.rate * setting.rate, setting)
    return None


def result(trial, cpu, setting):
    """Return a setting measured on a trial."""
    return Result(setting, trial.error(setting), cpu,
                  force_evaluations(setting.integrator, setting.rate))
