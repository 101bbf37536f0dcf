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

"""What a boat as tuned will do, in numbers and sentences, fast enough to follow a knob."""

from ..report import at_rest
from ...physics.hydrostatics.metacentric_height import metacentric_heights
from ...physics.hydrostatics.natural_modes import MODES, modes
from ...physics.hydrostatics.rest import draft
from ...physics.step_size.limits import combined_step

UNKNOWN = '…'


def figures(scene):
    """
    Return {name: number or None} under the names of ``buoyancy_report --json``, those found fast.

    The largest stable step, of the scene's integrator, takes longer: see `stable_step`.
    """
    boat, plan = scene.boat, scene.plan()
    rest = at_rest(boat)
    transverse, longitudinal = metacentric_heights(boat) if rest else (None, None)
    motions = modes(boat) if rest else {}
    found = {'draft_m': draft(boat, rest) if rest else None, 'floatiness': boat.floatiness,
             'gm_transverse_m': transverse, 'gm_longitudinal_m': longitudinal}
    for name in MODES:
        found[f'{name}_period_s'] = motions[name].period if rest else None
        found[f'{name}_damping_ratio'] = motions[name].damping_ratio if rest else None
    return {**found, 'substeps': plan.substeps,
            'warnings': list(dict.fromkeys((*scene.warnings, *plan.warnings)))}


def stable_step(scene):
    """Return in words the largest step at which the scene's integrator is stable at rest."""
    step = combined_step(scene.boat, scene.plan().integrator)
    return 'no limit' if step is None else f'{step:.3g} s' if step else 'none is stable'


def numbers_text(scene, found, stable=UNKNOWN):
    """Return Markdown of what `figures` found; ``stable`` as of `stable_step`."""
    step = 1.0 / (scene.rate * found['substeps'])
    rows = [f'| {name} | {_number(found[f"{name}_period_s"])} | '
            f'{_number(found[f"{name}_damping_ratio"])} |' for name in MODES]
    return '\n'.join([
        f'**draft {_number(found["draft_m"])} m** · GM {_number(found["gm_transverse_m"])} m '
        f'across, {_number(found["gm_longitudinal_m"])} m along · floatiness '
        f'{_number(found["floatiness"])}', '',
        '| at rest | period s | damping ratio |', '| --- | --- | --- |', *rows, '',
        f'largest stable step {stable}; it takes {step:.3g} s'])


def warnings_text(sentences):
    """Return Markdown of warnings."""
    return '\n'.join(f'- {sentence}' for sentence in sentences) or 'No warnings.'


def _number(value):
    return '–' if value is None else f'{value:.3g}'
