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

"""What a setting is worth: its motion beside the true one, on one stretch of a scene."""

from dataclasses import dataclass, field, replace
import math

from .accuracy import apart, boat_length, force_evaluations, measure, Run
from .reference_solution import Reference
from .settings import has_hull, hull_values, own_model, Setting, surface_values
from .stretch import Stretch
from ...physics.boat.hull import PANELS_A_WAVE
from ...physics.scene.scene import scene_from_values

# What stands for the hull itself: panels this many times finer, their damping taken at so many
# probes; twice as coarse panels and fewer probes for how far that is from the limit of ever more.
FINEST, PROBES, FEWER_PROBES = 8, (16, 16), (12, 12)
# Relative to the errors of a model nothing; it saves the restart at each of the thousands of
# kinks of a hull of many probes.
HULL_TOLERANCE = 1e-8


@dataclass(frozen=True)
class Result:
    """
    A setting measured: ``error`` m, ``cpu`` s and ``evaluations`` per simulated second.

    ``checked`` m, its error on another stretch, None where that was not looked at.
    """

    setting: Setting
    error: float
    cpu: float
    evaluations: float
    checked: float | None = None

    @property
    def worst(self):
        """Return the larger of both errors in m."""
        return self.error if self.checked is None else max(self.error, self.checked)


@dataclass(frozen=True)
class Trial:
    """
    One stretch of a scene with its true motion, on which settings are measured.

    ``truth`` is the motion of the hull itself, or of the probes where no hull is given, with the
    added mass and wave force of the scene: how true those are is for `fidelity` to say;
    ``own_error`` m, how far that truth is from a finer or coarser one, ``compared`` says which.
    """

    stretch: Stretch
    truth: Reference
    own_error: float
    compared: str
    length: float
    _runs: dict = field(default_factory=dict)

    @classmethod
    def of(cls, stretch):
        """Return the trial of a stretch, its truth solved."""
        if not has_hull(stretch.given):
            run = stretch.run()
            truth = run.solve()
            return cls(stretch, truth, apart(run, truth, run.solve(tolerance=1e-13)).total,
                       'two solutions of tolerance 1e-12 and 1e-13', run.length)
        options = {'tolerance': HULL_TOLERANCE, 'restart': False}
        shortest = stretch.run().sea.shortest_length
        finest = shortest / PANELS_A_WAVE / FINEST if math.isfinite(shortest) else 0.0
        run = stretch.run(surface_values(PROBES, finest))
        # As coarse as that where panels are as many as there may be.
        double = 2.0 * run.boat.hull.panels.longest_edge if finest else 0.0
        coarser = stretch.run(surface_values(FEWER_PROBES, double))
        truth = run.solve(**options)
        counts = (len(of.boat.hull.panels.triangles) for of in (run, coarser))
        return cls(stretch, truth, apart(run, truth, coarser.solve(**options)).total,
                   'the hull as {} panels and as {}'.format(*counts), boat_length(run.boat))

    def run(self, *choice):
        """Return the `Run` of this stretch with another model of the hull, one of `choices`."""
        if choice not in self._runs:
            run = self.stretch.run(hull_values(*choice))
            self._runs[choice] = Run(str(choice), run.boat, run.sea, run.start, run.duration,
                                     self.length)
        return self._runs[choice]

    def error(self, setting):
        """Return how far a `Setting` is from the truth, in m."""
        return measure(self.run(*setting.choice), self.truth,
                       setting.integrator, setting.rate).total


def present_result(trial, measured):
    """
    Return the `Result` of the scene as it stands, or None where its step is not stable.

    ``measured`` as from `candidates`, for the time of a step.
    """
    try:
        simulation = scene_from_values(trial.stretch.given).simulation()
    except ValueError:
        return None
    setting = Setting(simulation.integrator, simulation.rate * simulation.substeps,
                      *own_model(trial.stretch.given))
    for cpu, other in measured:
        if replace(other, rate=setting.rate) == setting:
            return result_of(trial, cpu / other.rate * setting.rate, setting)
    return None


def result_of(trial, cpu, setting):
    """Return a setting measured on a trial."""
    return Result(setting, trial.error(setting), cpu,
                  force_evaluations(setting.integrator, setting.rate))
