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
The largest stable step of each step method, from its own amplification matrix.

The linear system of a boat at rest is stepped by each method's formula, written as a matrix on
(modal displacements q, velocities u); the step is stable while no eigenvalue leaves the unit
circle.  Coordinates are those in which M is the unit matrix and K is diagonal.

``implicit`` needs no matrix.  It takes a stiffness P that is no less than K, and then the energy
E = u^T M u / 2 + x^T K x / 2 never grows, at any step h: E+ - E = -|u+ - u|_M^2 / 2 - h u+^T C u+
- h^2 u+^T (P - K/2) u+.
"""

from dataclasses import dataclass, replace

import numpy as np

from .equilibrium import Equilibrium
from .integrators import METHODS

# An eigenvalue this far outside the unit circle is round-off, which grows with the square of
# the step.
ROUND_OFF, ROUND_OFF_RATE = 1e-9, 1e-17
# Steps tried, in units of the fastest time of the system, before there is no limit.
TRIED = np.geomspace(1e-2, 1e6, 101)


@dataclass(frozen=True)
class StepLimit:
    """
    The largest stable steps of one method in s; None = no limit, 0.0 = never stable.

    ``oscillation`` without damping; ``damping`` without stiffness, in water or in air, whichever
    is less; ``combination`` both, at rest: what the boat itself does.
    """

    oscillation: float | None
    damping: float | None
    combination: float | None


@dataclass(frozen=True)
class Modal:
    """
    A linear system u' = -D u - E^T L q, q' = E u with unit mass.

    ``squared`` (p,) the positive omega^2, L; ``damping`` (6, 6) D and ``retention`` its part
    from retention.  E picks the first p of u.
    """

    squared: np.ndarray
    damping: np.ndarray
    retention: np.ndarray

    @classmethod
    def of(cls, rest, damping, retention):
        """Return the system of an `Equilibrium` with another damping (6, 6) in place of its C."""
        # Congruence with the inverse of M's Cholesky factor makes M the unit matrix.
        inverse = np.linalg.inv(np.linalg.cholesky(rest.mass))
        squared, vectors = np.linalg.eigh(inverse @ rest.stiffness @ inverse.T)
        # Modes that fall over instead of oscillating grow with any method: no step limit is
        # theirs, and those that nothing restores are left without a displacement.
        order = np.argsort(-squared)
        squared, vectors = squared[order], vectors[:, order]
        basis = inverse.T @ vectors
        return cls(squared[squared > 1e-12 * np.abs(squared).max(initial=1e-300)],
                   *(basis.T @ matrix @ basis for matrix in (damping, retention)))

    @property
    def pick(self):
        """Return E (p, 6)."""
        return np.eye(len(self.squared), 6)

    @property
    def pull(self):
        """Return E^T L (6, p)."""
        return self.pick.T * self.squared

    @property
    def generator(self):
        """Return the matrix of d/dt (q, u)."""
        return np.block([[np.zeros((len(self.squared),) * 2), self.pick],
                         [-self.pull, -self.damping]])

    @property
    def fastest(self):
        """Return the highest rate in the system in 1/s."""
        return max(np.sqrt(self.squared.max(initial=0.0)), np.linalg.norm(self.damping, 2))


def leapfrog_matrix(modal, h):
    """Return half a kick by Crank-Nicolson, a drift, half a kick."""
    size, unit = len(modal.squared), np.eye(6)
    ahead = np.linalg.inv(unit + 0.25 * h * modal.damping)
    kick = np.block([
        [np.eye(size), np.zeros((size, 6))],
        [-0.5 * h * ahead @ modal.pull, ahead @ (unit - 0.25 * h * modal.damping)]])
    drift = np.block([[np.eye(size), h * modal.pick], [np.zeros((6, size)), unit]])
    return kick @ drift @ kick


def symplectic_euler_matrix(modal, h):
    """Return all explicit forces, then the velocity's factor 1 - retention rate h, then drift."""
    factor = np.eye(6) - h * modal.retention
    kept = factor @ (np.eye(6) - h * (modal.damping - modal.retention))
    pulled = h * factor @ modal.pull
    return np.block([
        [np.eye(len(modal.squared)) - h * modal.pick @ pulled, h * modal.pick @ kept],
        [-pulled, kept]])


def rk4_matrix(modal, h):
    """Return 1 + z + z^2/2 + z^3/6 + z^4/24, z = h times the generator."""
    z = h * modal.generator
    unit = np.eye(len(z))
    return unit + z @ (unit + z @ (unit + z @ (unit + z / 4) / 3) / 2)


def euler_matrix(modal, h):
    """Return 1 + h times the generator."""
    return np.eye(6 + len(modal.squared)) + h * modal.generator


MATRICES = {'leapfrog': leapfrog_matrix, 'rk4': rk4_matrix,
            'symplectic_euler': symplectic_euler_matrix, 'euler': euler_matrix}


def growth(method, modal, h):
    """Return the largest factor by which one step of h s multiplies anything."""
    return float(np.abs(np.linalg.eigvals(MATRICES[method](modal, h))).max())


def largest_step(method, modal):
    """Return the step in s at which a method first turns unstable, None or 0.0 as `StepLimit`."""
    if method == 'euler':
        return _largest_euler_step(modal)
    if method == 'implicit' or not modal.fastest > 0:
        return None
    tried = TRIED / modal.fastest
    factors = np.abs(np.linalg.eigvals([MATRICES[method](modal, h) for h in tried])).max(axis=1)
    limit = 1.0 + ROUND_OFF + ROUND_OFF_RATE * TRIED ** 2
    grows = factors > limit
    if not grows.any():
        return None
    first = int(np.argmax(grows))
    stable, unstable, limit = tried[first - 1] if first else 0.0, tried[first], limit[first]
    while unstable - stable > 1e-6 * unstable:
        middle = 0.5 * (stable + unstable)
        if growth(method, modal, middle) > limit:
            unstable = middle
        else:
            stable = middle
    return float(stable)


def _largest_euler_step(modal):
    """Return the limit of explicit Euler: |1 + h g| <= 1 for every eigenvalue g, exactly."""
    values = np.linalg.eigvals(modal.generator)
    values = values[np.abs(values) > ROUND_OFF * np.abs(values).max(initial=0.0)]
    if not values.size:
        return None
    step = float((-2.0 * values.real / np.abs(values) ** 2).min())
    return step if step * np.abs(values).max() > ROUND_OFF else 0.0


def damping_step(rest, method):
    """Return the largest step in s without stiffness, in water or in air, or None."""
    if method in ('leapfrog', 'implicit'):
        # Crank-Nicolson and backward Euler: stable at any damping.
        return None
    return least(*(largest_step(method, replace(
        Modal.of(rest, damping, retention), squared=np.empty(0)))
        for damping, retention in ((rest.wet_damping, rest.wet_retention),
                                   (rest.air_damping, rest.air_damping))))


def combined_step(rest, method):
    """Return the largest step in s at rest, stiffness and damping together, or None."""
    return largest_step(method, Modal.of(rest, rest.damping, rest.retention))


def step_limit(boat, method):
    """Return the `StepLimit` of one method for a `Boat` at rest."""
    rest, nothing = Equilibrium.of(boat), np.zeros((6, 6))
    return StepLimit(oscillation=largest_step(method, Modal.of(rest, nothing, nothing)),
                     damping=damping_step(rest, method), combination=combined_step(rest, method))


def least(*steps):
    """Return the smallest of some steps, None counting as no limit."""
    return min((step for step in steps if step is not None), default=None)


def max_stable_steps(boat):
    """
    Return {method: s}, the largest step at which a boat at rest stays at rest.

    None = no limit, 0.0 = never stable: the combination of `StepLimit`.
    """
    rest = Equilibrium.of(boat)
    return {method: combined_step(rest, method) for method in METHODS}
