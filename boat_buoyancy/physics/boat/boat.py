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

"""What never changes of a boat: mass, inertia, hull and damping."""

from dataclasses import dataclass, field, fields, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from .hull import Hull
from .inertia import checked_inertia, principal_axes
from .records import boat_record, panel_rows, probe_records, readable
from .. import checks
from ..sea.waves import Water


# Farther ahead of its centre of mass, in m, the wind does not push a boat.
FARTHEST_ARM = 1e6


@dataclass(frozen=True, eq=False)
class Damping:
    """
    Everything that takes speed away, in body axes; see the parameter table for meaning.

    Main arguments: ``linear_retention`` and ``angular_retention`` (3,), part of the velocity
    kept after one second in water; ``air_...``, the same in air; ``probe`` (3,) N s/m over all
    probes.  Of these four and this one number stands for all three axes.
    Other arguments: ``linear`` (6,) N/(m/s) and N m/(rad/s), ``quadratic`` (6,) N/(m/s)^2 and
    N m/(rad/s)^2, in water only; ``wind`` (3,), surge and sway N/(m/s)^2 and yaw N m/(m/s)^2, see
    `forces.wind`.
    """

    linear_retention: ArrayLike = (0.95,)
    angular_retention: ArrayLike = (0.9,)
    air_linear_retention: ArrayLike = (0.999,)
    air_angular_retention: ArrayLike = (0.999,)
    probe: ArrayLike = (0.0,)
    linear: ArrayLike = (0.0,) * 6
    quadratic: ArrayLike = (0.0,) * 6
    wind: ArrayLike = (0.0,) * 3

    def __post_init__(self):
        """Store checked, read-only arrays."""
        for name in ('linear_retention', 'angular_retention',
                     'air_linear_retention', 'air_angular_retention'):
            values = checks.vector(f'damping.{name}', getattr(self, name), 1, 3,
                                   above=0.0, at_most=1.0)
            object.__setattr__(self, name, np.broadcast_to(values, (3,)))
        object.__setattr__(self, 'probe', np.broadcast_to(
            checks.vector('damping.probe', self.probe, 1, 3, at_least=0.0), (3,)))
        for name in ('linear', 'quadratic'):
            values = checks.vector(f'damping.{name}', getattr(self, name), 6, at_least=0.0)
            object.__setattr__(self, name, values)
        wind = checks.vector('wind.drag', self.wind, 3)
        if min(wind[:2]) < 0.0:
            raise ValueError('wind.drag: expected surge and sway of at least 0, '
                             f'got {wind.tolist()}')
        if abs(wind[2]) > FARTHEST_ARM * wind[1]:
            raise ValueError('wind.drag: expected a yaw of at most '
                             f'{FARTHEST_ARM:g} m times the sway, as it is the sway times how far '
                             f'ahead its force acts, got {wind.tolist()}')
        object.__setattr__(self, 'wind', wind)

    @property
    def wind_arm(self) -> float:
        """Return how far ahead of the centre of mass the wind's side force acts, in m."""
        return float(self.wind[2] / self.wind[1]) if self.wind[2] else 0.0

    @cached_property
    def rates(self) -> np.ndarray:
        """Return (2, 6) 1/s, -ln(retention): in water and in air; linear, then angular."""
        water = np.concatenate([self.linear_retention, self.angular_retention])
        air = np.concatenate([self.air_linear_retention, self.air_angular_retention])
        return -np.log(np.stack([water, air]))


@dataclass(frozen=True, eq=False)
class Boat:
    """
    A rigid boat; one is equal to itself only.

    Main arguments: ``mass`` kg; ``hull`` a `Hull`; ``inertia`` (3, 3) kg m^2 about the centre of
    mass, off-diagonals -integral(xy dm) as in URDF; ``damping`` a `Damping`.
    Other arguments: ``center_of_mass`` (3,) m in the body frame; ``gravity`` m/s^2;
    ``added_mass`` (6,) kg and kg m^2 about the centre of mass, body axes, all wet; ``immersion``
    (n,) m, how deep the probes are at rest, down to where waves die out: with it the wave force
    is that of Froude and Krylov, without it hydrostatic.
    """

    mass: float
    hull: Hull
    inertia: ArrayLike
    damping: Damping = field(default_factory=Damping)
    center_of_mass: ArrayLike = (0.0, 0.0, 0.0)
    gravity: float = 9.81
    added_mass: ArrayLike = (0.0,) * 6
    immersion: ArrayLike = ()

    def __post_init__(self):
        """Store checked, read-only arrays."""
        object.__setattr__(self, 'mass', checks.number('boat.mass', self.mass, above=0.0))
        object.__setattr__(self, 'gravity', checks.number('gravity', self.gravity, above=0.0))
        object.__setattr__(self, 'center_of_mass', checks.vector(
            'boat.center_of_mass', self.center_of_mass, 3))
        object.__setattr__(self, 'inertia', checked_inertia(self.inertia))
        object.__setattr__(self, 'added_mass', checks.vector(
            'added_mass', self.added_mass, 6, at_least=0.0))
        object.__setattr__(self, 'immersion', checks.vector(
            'immersion', self.immersion, 0, len(self.hull.share), at_least=0.0))

    def __getstate__(self):
        """Leave out what is derived; it is made again when it is asked for."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def with_damping(self, damping: Damping) -> 'Boat':
        """Return a boat that differs in its damping alone, and lies as this one does."""
        boat = replace(self, damping=damping)
        boat.__dict__['lying'] = self.lying
        return boat

    @cached_property
    def lying(self) -> 'Boat':
        """Return the one of all boats `with_damping` of each other whose rest is worked out."""
        return self

    @property
    def weight(self) -> float:
        """Return m g in N."""
        return self.mass * self.gravity

    @property
    def follows_waves(self) -> bool:
        """Return whether the wave force is that of Froude and Krylov."""
        return len(self.immersion) > 0

    @cached_property
    def waterplane_parts(self) -> np.ndarray:
        """Return (n,), the parts of the waterplane that the probes stand for, if wet at rest."""
        areas = self.hull.stiffness * (self.immersion > 0.0 if self.follows_waves else 1.0)
        return areas / areas.sum() if areas.any() else self.hull.share

    @property
    def floatiness(self) -> float:
        """Return the buoyancy budget over the weight, F_max / (m g)."""
        return self.hull.max_lift / self.weight

    @cached_property
    def probe_offsets(self) -> np.ndarray:
        """Return (n, 3) m, the probes from the centre of mass, in body axes."""
        return self.hull.positions - self.center_of_mass

    def on(self, sea: Water) -> 'Boat':
        """Return the boat with panels as fine as a sea needs them; itself where they are."""
        if self.hull.panels is None:
            return self
        hull = self.hull.panelled(sea)
        return self if hull is self.hull else replace(self, hull=hull)

    @cached_property
    def on_surface(self) -> 'Boat | None':
        """
        Return the boat with its hull's surface, as it is, for panels; None where there is none.

        In still water it is the boat with any other panels, and of fewer.
        """
        if self.hull.surface is None or self.hull.panels is self.hull.surface:
            return None if self.hull.surface is None else self
        return replace(self, hull=replace(self.hull, panels=self.hull.surface))

    @cached_property
    def size(self) -> float:
        """Return how far in m the farthest end of a probe or corner is from the centre of mass."""
        return float(max(np.max(np.linalg.norm(self.probe_offsets, axis=1) + self.hull.height),
                         self.record['reach']))

    @property
    def pieces(self) -> int:
        """Return how many probes and triangles a force is summed over."""
        return len(self.hull.share) + self.panel_rows[1].shape[1]

    @cached_property
    def record(self) -> np.ndarray:
        """Return the boat as the compiled step reads it, see `records`."""
        return boat_record(self)

    @cached_property
    def probe_records(self) -> np.ndarray:
        """Return the probes as the compiled step reads them, see `records`."""
        return probe_records(self)

    @cached_property
    def panel_rows(self) -> tuple[np.ndarray, np.ndarray]:
        """Return corners (3, n) and triangles (3, m) as the compiled step reads them."""
        return panel_rows(self)

    @cached_property
    def plain_records(self) -> tuple:
        """Return boat, probes, corners and triangles as the step in plain Python reads them."""
        corners, triangles = self.panel_rows
        return (readable(self.record), readable(self.probe_records), corners.tolist(),
                triangles.tolist())

    @cached_property
    def principal(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the principal moments and axes of the inertia, see `principal_axes`."""
        return principal_axes(self.inertia)

    @cached_property
    def wet_principal(self) -> tuple[np.ndarray, np.ndarray]:
        """Return those of the inertia with all of the added mass, see `principal_axes`."""
        return principal_axes(self.mass_matrix_at(1.0)[3:, 3:])

    @cached_property
    def mass_matrix(self) -> np.ndarray:
        """Return (6, 6), diag(m, m, m, I)."""
        matrix = np.zeros((6, 6))
        matrix[:3, :3] = self.mass * np.eye(3)
        matrix[3:, 3:] = self.inertia
        return matrix

    def mass_matrix_at(self, wetness: float) -> np.ndarray:
        """Return (6, 6), the mass matrix with the added mass of a wetness 0 to 1."""
        return self.mass_matrix + np.diag(wetness * self.added_mass)

    @cached_property
    def retention_damping(self) -> np.ndarray:
        """
        Return (2, 6, 6), the damping matrix of retention in water and in air, body axes.

        Force -m d_i u_i; torque -C w, C = L diag(d) L^T with I = L L^T (Cholesky), the axes in
        order of rising d; in water m and I with the added mass.  Then I^-1 C = L^-T diag(d) L^T
        is triangular with d on its diagonal: a rotation about a body axis decays at the rate of
        that axis, whatever the products of inertia, and stirs none that decay faster.  As
        d_min I <= C <= d_max I, no torque ever feeds energy in.
        """
        matrices = np.zeros((2, 6, 6))
        for matrix, rates, wetness in zip(matrices, self.damping.rates, (1.0, 0.0)):
            mass = self.mass_matrix_at(wetness)
            matrix[:3, :3] = mass[:3, :3] * rates[:3]
            rising = np.argsort(rates[3:], kind='stable')
            block = np.ix_(rising, rising)
            root = np.linalg.cholesky(mass[3:, 3:][block])
            matrix[3:, 3:][block] = root @ np.diag(rates[3:][rising]) @ root.T
        return matrices
