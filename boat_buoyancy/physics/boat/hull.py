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

"""The hull: probes that sample the water and share the buoyancy budget."""

from dataclasses import dataclass, replace
from functools import cached_property
import math

import numpy as np
from numpy.typing import ArrayLike

from .surface import Surface
from .. import checks
from ..sea.waves import Water

# Probe laws; the step knows them by their place in this list.
LAWS = ('spring', 'soft', 'column')
# Panels on the length of a wave, which leave 1 % of error where the pressure is worst.
PANELS_A_WAVE = 8
# More panels than these cost milliseconds a step.
MAX_PANELS = 30_000


@dataclass(frozen=True, eq=False)
class Hull:
    """
    The hull: its probes, and its surface where it has one, in body axes.

    Main arguments: ``positions`` (n, 3) m; ``max_force`` (n,) N, what each probe gives at most;
    ``height`` (n,) m, the depth at which it does.
    Other arguments: ``law`` is ``spring`` or ``soft`` (a point) or ``column`` (the probe is the
    bottom of a column of hull of that height); ``surface``, the closed `Surface` that the probes
    stand for; ``panels``, a `Surface` on which the water's pressure lifts instead of the probes,
    in water of ``specific_weight`` rho g in N/m^3; ``panel_size`` m, the longest edge of a panel
    that was asked for, 0 = as the sea needs it.
    """

    positions: ArrayLike
    max_force: ArrayLike
    height: ArrayLike
    law: str = 'spring'
    surface: Surface | None = None
    panels: Surface | None = None
    specific_weight: float = 0.0
    panel_size: float = 0.0

    def __post_init__(self):
        """Store checked, read-only arrays."""
        positions = np.array(self.positions, float).reshape(-1, 3)
        count = len(positions)
        if count == 0:
            raise ValueError('probes.positions: expected at least one probe, got none')
        if not np.isfinite(positions).all():
            raise ValueError('probes.positions: expected finite numbers, '
                             f'got {positions.tolist()}')
        positions.setflags(write=False)
        object.__setattr__(self, 'positions', positions)
        if self.surface is None:
            object.__setattr__(self, 'surface', self.panels)
        for name in ('max_force', 'height'):
            values = np.broadcast_to(np.asarray(getattr(self, name), float), (count,))
            object.__setattr__(self, name, checks.vector(name, values, count, at_least=0.0))
        if not self.max_force.sum() > 0:
            raise ValueError('probes.weights: expected a sum above 0, got 0')
        if not (self.height > 0).all():
            raise ValueError('probes.stiffness: expected a finite height above 0 for every '
                             f'probe, got heights {self.height.tolist()}')
        if self.law not in LAWS:
            raise ValueError(f'probes.law: expected one of {", ".join(LAWS)}, got {self.law!r}')

    def panelled(self, sea: Water) -> 'Hull':
        """
        Return the hull with its surface as panels, as fine as asked for or as a sea needs them.

        By itself an eighth of the sea's shortest wave that counts, in still water the facets that
        the surface has; never more than `MAX_PANELS`.  The hull itself where it has them already.
        """
        longest = max(self.panel_size or sea.shortest_length / PANELS_A_WAVE, self.finest_panel)
        panels = self.surface.refined(longest)
        while len(panels.triangles) > max(MAX_PANELS, len(self.surface.triangles)):
            # Long edges cut in halves can leave some four times as many as they have to be.
            longest *= 1.2
            panels = self.surface.refined(longest)
        if self.panels is not None and len(self.panels.triangles) == len(panels.triangles):
            return self
        return replace(self, panels=panels)

    @property
    def finest_panel(self) -> float:
        """Return the longest edge in m of about `MAX_PANELS` panels on the surface."""
        # Triangles whose edges are halved until none is too long have at least 0.13 of its square.
        return math.sqrt(self.surface.area / (0.13 * MAX_PANELS))

    @property
    def carriers(self) -> str:
        """Return in words what lifts the hull: how many probes, columns or panels."""
        if self.panels is not None:
            return (f'{len(self.panels.triangles)} panels of at most '
                    f'{self.panels.longest_edge:.2g} m')
        kind = 'column' if self.law == 'column' and self.surface is not None else 'probe'
        return f'{len(self.positions)} {kind}{"" if len(self.positions) == 1 else "s"}'

    @cached_property
    def share(self) -> np.ndarray:
        """Return (n,), each probe's part of the budget: weight over sum of weights."""
        return self.max_force / self.max_force.sum()

    @cached_property
    def max_lift(self) -> float:
        """Return the buoyancy budget in N, what the hull lifts with all of it under water."""
        if self.panels is not None:
            return self.specific_weight * self.panels.volume
        return float(self.max_force.sum())

    @cached_property
    def stiffness(self) -> np.ndarray:
        """Return (n,) N/m, the slope of each probe's force at the surface."""
        return self.max_force / self.height


def probe_hull(positions, weights, *, weight, floatiness, stiffness, law):
    """
    Return the idea's hull: a buoyancy budget shared out by weight.

    Main arguments: ``positions`` (n, 3) m; ``weights`` (n,) relative importance; ``weight`` m g
    of the boat in N; ``floatiness`` F_max/(m g); ``stiffness`` 1/m, share of a probe's force
    per metre of depth; ``law`` as in `Hull`.
    """
    positions = np.array(positions, float).reshape(-1, 3)
    weights = checks.vector('probes.weights', weights, len(positions), at_least=0.0)
    if not weights.sum() > 0:
        raise ValueError(f'probes.weights: expected a sum above 0, got {weights.tolist()}')
    budget = weight * floatiness
    return Hull(positions, budget * weights / weights.sum(),
                np.full(len(positions), 1.0 / stiffness), law)
