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

"""
Added mass, radiation damping and wave forces by a boundary element method, that of capytaine.

Linear potential flow in deep water: small motions and waves, no friction, no speed.  Hulls that
float side by side are taken one by one: what they do to each other is left out.
"""

from dataclasses import dataclass
import logging
import warnings

import numpy as np

from .command_line import require_extra
from ..physics.boat.clipping import wet_part
from ..physics.boat.closed_mesh import welded
from ..physics.boat.cuts import components
from ..physics.boat.surface import Surface
from ..physics.hydrostatics.moving_water import (
    COORDINATES, modes_with, PERIOD_OF, resting_facets)
from ..physics.hydrostatics.rest import rest_state
from ..physics.hydrostatics.strip_theory import first_guess
from ..physics.rotation import rotation_matrix

# Panels of each hull: within a few per cent of four times as many.
PANELS = 1000
# Their equations fill 16 bytes times the square of this, and take minutes.
MOST_PANELS = 6000
# The periods are found when none moves by more than this part of it: four rounds or so.  Those
# that go to and fro go half the way from a later round on.
SETTLED, ROUNDS, LATER = 0.002, 16, 6
# Corners closer than this part of the hull's length are one, and smaller triangles none.
NEAR = 1e-7


@dataclass(frozen=True)
class Radiation:
    """
    What a `Boat` at rest feels of the waves that it makes; see `at_natural_periods`.

    ``added_mass`` and ``damping`` (6,) about the centre of mass, body axes, without friction;
    ``periods`` (6,) s at which each holds; ``panels``, on how many it was worked out.
    """

    added_mass: np.ndarray
    damping: np.ndarray
    periods: np.ndarray
    panels: int


def at_natural_periods(boat, panels=PANELS, tell=lambda text: None):
    """
    Return the `Radiation` of a boat, each number at the natural period that it makes itself.

    Main arguments: ``panels``, about how many on each hull; ``tell``, called with a text as it
    goes.  ValueError as of `resting_facets`, for a mesh too fine, and without capytaine.

    The period depends on the added mass and that on the period: found in turn, from the strips'.
    """
    hulls = Hulls(boat, panels)
    added, damping = first_guess(boat)
    before, solved = np.zeros(6), {}
    for turn in range(ROUNDS):
        modes = modes_with(boat, added)
        periods = np.array([modes[name].period for name in PERIOD_OF])
        if (np.abs(periods - before) <= SETTLED * periods).all():
            break
        for i, period in enumerate(periods.tolist()):
            if period not in solved:
                tell(f'{hulls.panels} panels, round {turn + 1}: {PERIOD_OF[i]} at {period:.3g} s')
                solved[period] = hulls.radiation(period)
            found, damping[i] = (matrix[i, i] for matrix in solved[period])
            added[i] += (found - added[i]) * (0.5 if turn >= LATER else 1.0)
        before = periods
    else:
        warnings.warn('the natural periods do not settle: added mass holds at periods near by')
    return Radiation(added, damping, periods, hulls.panels)


class Hulls:
    """The hulls of a boat at rest, each as panels with a lid inside its waterline."""

    def __init__(self, boat, panels=PANELS):
        """
        Make about ``panels`` panels on each hull.

        ValueError as of `at_natural_periods`.
        """
        surfaces = wetted_hulls(resting_facets(boat), panels)
        require_extra('bem', '--bem', 'capytaine')
        import capytaine
        logging.getLogger('capytaine').setLevel(logging.ERROR)
        self._capytaine, self._solver = capytaine, capytaine.BEMSolver()
        weight = boat.hull.specific_weight
        self._water = {'rho': weight / boat.gravity, 'g': boat.gravity}
        self.panels = sum(len(surface.triangles) for surface in surfaces)
        state = rest_state(boat)
        axes = np.array(rotation_matrix(state.orientation.tolist())).T
        self._bodies = [self._body(surface, axes, [0.0, 0.0, state.position[2]])
                        for surface in surfaces]

    def radiation(self, period):
        """
        Return added mass and damping, both (6, 6), of waves of a ``period`` in s.

        Body axes, about the centre of mass: kg, kg m, kg m^2 and N/(m/s), N/(rad/s), N m/(rad/s).
        """
        total = np.zeros((2, 6, 6))
        for body in self._bodies:
            for column, name in enumerate(COORDINATES):
                result = self._solver.solve(self._capytaine.RadiationProblem(
                    body=body, period=period, radiating_dof=name, **self._water))
                for matrix, found in zip(total, (result.added_masses, result.radiation_dampings)):
                    matrix[:, column] += [found[row] for row in COORDINATES]
        return total

    def excitation(self, period, direction):
        """
        Return force and torque (6,) of waves of 1 m, complex: times e^(-i omega t), real part.

        ``period`` s, ``direction`` rad where they go; a crest is over the origin at t = 0.
        """
        total = np.zeros(6, complex)
        for body in self._bodies:
            problem = self._capytaine.DiffractionProblem(
                body=body, period=period, wave_direction=direction, **self._water)
            scattered = self._solver.solve(problem).forces
            undisturbed = self._capytaine.bem.airy_waves.froude_krylov_force(problem)
            total += [scattered[name] + undisturbed[name] for name in COORDINATES]
        return total

    def _body(self, surface, axes, center):
        """Return a hull that moves along ``axes``, rows (3, 3), and about them at ``center``."""
        first, second, third = surface.triangles.T
        mesh = self._capytaine.Mesh(vertices=surface.corners,
                                    faces=np.stack([first, second, third, first], axis=1))
        arms = mesh.faces_centers - center
        moves = [*(np.broadcast_to(axis, arms.shape) for axis in axes),
                 *(np.cross(axis, arms) for axis in axes)]
        return self._capytaine.FloatingBody(
            mesh, lid_mesh=mesh.generate_lid(), dofs=dict(zip(COORDINATES, moves)),
            center_of_mass=center)


def wetted_hulls(facets, panels=PANELS):
    """
    Return the `Surface` under water of each hull that floats, of about ``panels`` triangles each.

    ``facets`` (n, 3, 3) m, of a boat in water at z = 0.  ValueError where a mesh has far more.
    """
    wet = wet_part(facets)
    corners, triangles = welded(wet.reshape(-1, 3), np.arange(3 * len(wet)).reshape(-1, 3),
                                NEAR * np.ptp(wet, axis=(0, 1)).max())
    hull = components(triangles)
    surfaces = [_panelled(corners, triangles[hull == number], panels)
                for number in range(hull.max() + 1)]
    most = max(len(surface.triangles) for surface in surfaces)
    if most > MOST_PANELS:
        raise ValueError(f'hull.mesh: expected at most {MOST_PANELS} triangles under water, as a '
                         f'boundary element method takes, got {most}: give a coarser mesh')
    return surfaces


def _panelled(corners, triangles, panels):
    """Return a `Surface` cut into about as many ``panels``; as it is where it has more."""
    used, triangles = np.unique(triangles, return_inverse=True)
    surface = found = Surface(corners[used], triangles.reshape(-1, 3))
    longest = surface.longest_edge
    while len(found.triangles) < panels:
        coarser, longest = found, longest / 1.1
        found = surface.refined(longest)
        if len(found.triangles) * len(coarser.triangles) > panels ** 2:
            return coarser
    return found
