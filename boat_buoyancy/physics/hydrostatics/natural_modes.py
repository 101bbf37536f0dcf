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
A boat at rest as a linear system: stiffness, damping, and the modes of heave, roll and pitch.

Everything is about the centre of mass, along the axes of a boat that lies level with its heading
along x, in the order surge, sway, heave, roll, pitch, yaw.
"""

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import permutations, product

import numpy as np

from .rest import in_air, rest_state, under_water
from .stiffness import hydrostatic_stiffness, still_load
from ..boat.clipping import level_for, waterplane
from ..rotation import rotation_matrix

MODES = ('heave', 'roll', 'pitch')
# The coordinates that still water pushes back against: heave, roll, pitch.
RESTORED = slice(2, 5)


@dataclass(frozen=True)
class Mode:
    """
    A natural mode of a boat at rest.

    ``angular_frequency`` rad/s and ``period`` s, without damping; ``damping_ratio``, 1 is
    critical.  All are None where the water does not push back and nothing oscillates.
    """

    angular_frequency: float | None
    period: float | None
    damping_ratio: float | None


@dataclass(frozen=True)
class Equilibrium:
    """
    The linear system M a + C u + K x = 0 of a boat at rest in still water.

    All (6, 6): ``mass`` M, added mass included, at the draft, ``wet_mass`` with every probe under
    water, ``air_mass`` with none; ``damping`` C likewise; ``stiffness`` K; ``surface_stiffness``
    K+, every probe at the surface.  ``tilted`` 1/s^2, of a hull of panels the greatest eigenvalue
    of M^-1 K that its waterplane has at any attitude; of others, whose K+ is that of all probes
    upright, 0.
    """

    mass: np.ndarray
    wet_mass: np.ndarray
    air_mass: np.ndarray
    stiffness: np.ndarray
    surface_stiffness: np.ndarray
    damping: np.ndarray
    wet_damping: np.ndarray
    air_damping: np.ndarray
    tilted: float

    @classmethod
    @lru_cache(maxsize=64)
    def of(cls, boat):
        """Return the system of a `Boat` where it lies at rest."""
        rest, stiffness = rest_state(boat), np.zeros((6, 6))
        stiffness[RESTORED, RESTORED] = _stiffness_at_rest(boat.lying)
        x, y, _ = boat.probe_offsets.T
        zero, one = np.zeros(len(x)), np.ones(len(x))
        rows = np.stack([zero, zero, one, y, -x, zero])
        surface_stiffness = rows * boat.hull.stiffness @ rows.T
        # Panels have no part in damping, which is that of the probes and of the whole.
        bare = boat if boat.hull.panels is None else replace(
            boat, hull=replace(boat.hull, panels=None))
        loads = [still_load(bare, state)[0] for state in (rest, under_water(boat), in_air(boat))]
        mass, wet_mass, air_mass, surface_stiffness, *damping = (
            levelled(matrix, rest) for matrix in (
                *(boat.mass_matrix_at(load.wetness) for load in loads), surface_stiffness,
                *(damping_matrix(load.damping) for load in loads)))
        tilted = 0.0 if boat.hull.panels is None else _greatest_tilted(boat.lying)
        return cls(mass, wet_mass, air_mass, stiffness, surface_stiffness, *damping, tilted)

    @cached_property
    def modes(self):
        """Return {name: `Mode`}, see `modes`."""
        # What the other three coordinates, which nothing restores, leave of the inertia.
        root = _square_root(np.linalg.inv(self.mass)[RESTORED, RESTORED])
        squared, vectors = np.linalg.eigh(root @ self.stiffness[RESTORED, RESTORED] @ root)
        energy = vectors ** 2
        order = max(permutations(range(3)),
                    key=lambda order: sum(energy[i, mode] for i, mode in enumerate(order)))
        return {name: _mode(self, squared[mode], root @ vectors[:, mode])
                for name, mode in zip(MODES, order)}

    @cached_property
    def highest_frequency(self):
        """Return omega_max in rad/s, see `highest_frequency`."""
        return float(np.sqrt(max(0.0, _greatest(self.wet_mass, self.surface_stiffness),
                                 _greatest(self.mass, self.stiffness), self.tilted)))

    @cached_property
    def highest_damping_rate(self):
        """Return the greatest eigenvalue of M^-1 C in 1/s, all wet or in air."""
        return max(_greatest(self.wet_mass, self.wet_damping),
                   _greatest(self.air_mass, self.air_damping))


@lru_cache(maxsize=64)
def _stiffness_at_rest(boat):
    return hydrostatic_stiffness(boat, rest_state(boat))


@lru_cache(maxsize=64)
def _greatest_tilted(boat):
    """
    Return the greatest eigenvalue 1/s^2 of M^-1 K of the waterplanes of a hull, however it lies.

    K = rho g integral(g g^T), g = (0, 0, 1, y, -x, 0), at 26 attitudes all around, afloat.
    """
    found, surface, per_volume = 0.0, boat.hull.surface, boat.hull.specific_weight
    for up in product((-1.0, 0.0, 1.0), repeat=3):
        if not any(up):
            continue
        # Three axes of the world in body axes, the third up.
        up = np.array(up) / np.linalg.norm(up)
        ahead = np.cross(up, np.eye(3)[np.argmin(np.abs(up))])
        ahead /= np.linalg.norm(ahead)
        R = np.array([ahead, np.cross(up, ahead), up])
        facets = (surface.facets - boat.center_of_mass) @ R.T
        level = level_for(facets, min(boat.weight / per_volume, surface.volume))
        area, (x, y), ((xx, xy), (_, yy)) = waterplane(facets - [0.0, 0.0, level])
        K = np.zeros((6, 6))
        K[RESTORED, RESTORED] = per_volume * np.array(
            [[area, y, -x], [y, yy, -xy], [-x, -xy, xx]])
        turned = np.kron(np.eye(2), R)
        found = max(found, _greatest(turned @ boat.mass_matrix_at(1.0) @ turned.T, K))
    return found


def equilibrium_stiffness(boat):
    """Return K (6, 6) of a boat at rest, N/m, N and N m per m and rad: `hydrostatic_stiffness`."""
    return Equilibrium.of(boat).stiffness


def modes(boat):
    """
    Return {'heave': `Mode`, 'roll': `Mode`, 'pitch': `Mode`} of a boat at rest.

    Coupled modes take the name of the coordinate that holds most of their kinetic energy.  The
    damping ratio is that of the mode's own shape, phi^T C phi / (2 omega phi^T M phi).
    """
    return Equilibrium.of(boat).modes


def _mode(rest, squared, shape):
    """Return the `Mode` of an eigenvalue omega^2 and the shape (3,) of heave, roll, pitch."""
    if not squared > 0:
        return Mode(None, None, None)
    force = np.zeros(6)
    force[RESTORED] = rest.stiffness[RESTORED, RESTORED] @ shape
    # All six coordinates of the mode: M phi omega^2 = K phi.
    shape = np.linalg.solve(rest.mass, force)
    size = np.abs(shape).max()
    if not 0.0 < size < np.inf:
        # So slow or fast that no number is left of it.
        return Mode(None, None, None)
    shape, frequency = shape / size, float(np.sqrt(squared))
    ratio = shape @ rest.damping @ shape / (2 * frequency * (shape @ rest.mass @ shape))
    return Mode(frequency, 2 * np.pi / frequency, float(ratio))


def highest_frequency(boat):
    """
    Return omega_max in rad/s, the fastest oscillation that a step has to follow.

    omega_max^2 is the larger of the greatest eigenvalues of M^-1 K+ with all probes at the
    surface and of M^-1 K_eq: the first alone misses a boat hung below its probes.  Of panels that
    of the waterplane at any attitude counts as well.
    """
    return Equilibrium.of(boat).highest_frequency


def highest_damping_rate(boat):
    """Return the greatest eigenvalue of M^-1 C in 1/s, all wet or in air."""
    return Equilibrium.of(boat).highest_damping_rate


def _greatest(mass, matrix):
    root = np.linalg.inv(_square_root(mass))
    return float(np.linalg.eigvalsh(root @ matrix @ root)[-1])


def _square_root(matrix):
    """Return the symmetric square root of a positive definite matrix."""
    values, vectors = np.linalg.eigh(matrix)
    return vectors @ np.diag(np.sqrt(values)) @ vectors.T


def levelled(matrix, state):
    """Return a matrix (6, 6) of body axes along the axes of the world, of a boat at a `State`."""
    turned = np.kron(np.eye(2), rotation_matrix(state.orientation.tolist()))
    return turned @ matrix @ turned.T


def damping_matrix(damping):
    """Return C (6, 6) of a `DampingMatrix`: force and torque are -C (v, w)."""
    xy, xz, yx, yz, zx, zy = damping.coupling
    turning = np.array([[0.0, xy, xz], [yx, 0.0, yz], [zx, zy, 0.0]])
    xx, yy, zz, xy, xz, yz = damping.angular
    return np.block([[np.diag(damping.linear), turning.T],
                     [turning, np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])]])
