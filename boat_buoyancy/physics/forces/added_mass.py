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
Added mass: the water that a hull in the water takes along as it gets faster.

Six numbers A about the centre of mass, body axes, all wet; of a part-wet hull its wetness s times
as much, so that a boat in the air falls with g.  The mass in force is M = m + s A, I + s A_angular
(Kirchhoff; Fossen, Handbook of Marine Craft Hydrodynamics, 2011, 6.3).
"""

from ..compiled import compiled
from ..vectors import (add, add_scaled_matrix, cross, diagonal, divide, factor, multiply, scale,
                       six, solve_factored, subtract, times)


@compiled
def added_mass(boat, wetness):
    """Return s A: kg (3) along the body axes and kg m^2 (3) about them."""
    a = boat.added_mass
    return (scale(wetness, (a[0], a[1], a[2])), scale(wetness, (a[3], a[4], a[5])))


@compiled
def mass_in_force(boat, wetness):
    """Return M: kg (3) along the body axes, and kg m^2 (6) a symmetric matrix."""
    linear, angular = added_mass(boat, wetness)
    return (add((boat.mass, boat.mass, boat.mass), linear),
            add_scaled_matrix(six(boat.inertia), 1.0, diagonal(angular)))


@compiled
def munk(mass, velocity):
    """Return (M v) x v, N m: what turns a hull across its way through the water (Munk, 1924)."""
    return cross(multiply(mass, velocity), velocity)


@compiled
def dipped(boat, before, load, body_velocity, angular_velocity):
    """
    Return velocity and angular velocity where the wetness is no longer ``before``, body axes.

    What comes in keeps the momentum, relative to the stream, as a hull that meets the water is
    slowed down by what it takes along; what comes out keeps the velocity.  The energy never grows.
    """
    if boat.has_added_mass == 0 or load.wetness <= before:
        return body_velocity, angular_velocity
    (mass, inertia), (heavier, wider) = (mass_in_force(boat, before),
                                         mass_in_force(boat, load.wetness))
    momentum = multiply(mass, subtract(body_velocity, load.stream))
    return (add(load.stream, divide(momentum, heavier)),
            solve_factored(factor(wider), times(inertia, angular_velocity)))
