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
What the water that moves along does to a boat at rest: its natural modes, and the drag for them.

Added mass and damping are six numbers, surge, sway, heave, roll, pitch and yaw, about the centre
of mass along the body axes.
"""

from dataclasses import replace

import numpy as np

from .natural_modes import Equilibrium, levelled
from .rest import floats, rest_attitude, rest_state
from ..rotation import rotation_matrix

COORDINATES = ('surge', 'sway', 'heave', 'roll', 'pitch', 'yaw')
# At whose natural period each of them counts: pitch takes surge along, roll takes sway and yaw.
PERIOD_OF = ('pitch', 'roll', 'heave', 'roll', 'pitch', 'roll')


def resting_facets(boat):
    """
    Return the triangles (n, 3, 3) m of a boat's hull at rest in still water, which is at z = 0.

    The centre of mass is at (0, 0, z).  ValueError for a boat without a surface, and for one that
    does not come back to rest in heave, roll and pitch.
    """
    if boat.hull.surface is None:
        raise ValueError('probes.positions: expected a hull whose surface moves the water, got '
                         'probes one by one: give hull.shape and hull.size, or hull.mesh, in '
                         'their place')
    if not floats(boat):
        raise ValueError('boat.mass: expected a boat that floats, got floatiness '
                         f'{boat.floatiness:.3g}: make it lighter or its hull larger')
    fixed = [name for name, mode in Equilibrium.of(boat).modes.items() if mode.period is None]
    if rest_attitude(boat) is None or fixed:
        raise ValueError('boat.center_of_mass: expected a boat that comes back to rest, got one '
                         f'that nothing rights in {" and ".join(fixed) or "roll and pitch"}: '
                         'lower its centre of mass')
    state = rest_state(boat)
    rotation = np.array(rotation_matrix(state.orientation.tolist()))
    return ((boat.hull.surface.facets - boat.center_of_mass) @ rotation.T
            + [0.0, 0.0, state.position[2]])


def modes_with(boat, added_mass, damping=(0.0,) * 6):
    """
    Return the natural modes of a boat at rest, as `modes`, with the water that moves along.

    ``added_mass`` (6,) kg and kg m^2; ``damping`` (6,) N/(m/s) and N m/(rad/s), in place of all
    that the boat has.
    """
    mass, drag = (levelled(matrix, rest_state(boat)) for matrix in (
        boat.mass_matrix + np.diag(added_mass), np.diag(damping)))
    return replace(Equilibrium.of(boat), mass=mass, damping=drag).modes


def critical_damping(boat, added_mass):
    """
    Return twice omega (m + A), (6,) N/(m/s) and N m/(rad/s): damping of ratio 1.

    ``added_mass`` (6,) A; omega, that of `PERIOD_OF`.  Of what nothing restores it is but a
    measure.
    """
    modes = modes_with(boat, added_mass)
    frequency = np.array([modes[name].angular_frequency for name in PERIOD_OF])
    return 2.0 * frequency * (np.diag(boat.mass_matrix) + added_mass)
