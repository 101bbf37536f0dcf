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
All forces on a boat at one place and time: what a kick of the integrators needs to know.

Everything is in body axes about the centre of mass.
"""

from typing import NamedTuple

from .added_mass import added_mass
from .buoyancy import buoyancy
from .damping import (body_damping, DampingMatrix, no_damping, probe_damping, ramped, with_body,
                      with_point, with_quadratic_drag)
from .gravity import gravity
from .pressure import pressure
from .probe_laws import wetting
from .wave_force import about_boat, add_to_twist, Twist, water_motion, wave_lift
from .wave_pressure import wave_pressure
from .wind import with_air_drag
from ..compiled import compiled
from ..rotation import rotation_matrix, to_body, to_world
from ..sea.fading import current, ramp
from ..sea.waves import surface
from ..vectors import add, add_scaled, cross, multiply, times, ZERO


class Load(NamedTuple):
    """
    Force and damping of one place and time.

    ``force`` N and ``torque`` N m of buoyancy, gravity and the pull of moving water; ``damping``
    a `DampingMatrix`; ``wetness`` 0 to 1, the probes' weighted mean; ``water`` (3) m/s and
    ``turning`` (3) rad/s, the motion of the water that drag is relative to: the probes' weighted
    mean velocity, and its turn where the wave force is that of Froude and Krylov; ``stream`` (3)
    m/s, the current; ``wind`` (3) m/s.
    """

    force: tuple
    torque: tuple
    damping: DampingMatrix
    wetness: float
    water: tuple
    turning: tuple
    stream: tuple
    wind: tuple


@compiled
def load_at(boat, hull, sea, waves, position, orientation, t):
    """
    Return the `Load` at a place, an orientation and a time, and write what `HullView` says.

    F = lift - m g up + sum c_i s_i v_water,i + s D v_water, s the wetness; the lift is that of
    the probes, or of pressure on the triangles of a hull that has some.  With the wave force of
    Froude and Krylov the water takes the boat along: + s A v'_water, A the added mass.  The
    damping -C u of the boat's own velocity is left to the integrator.
    """
    R = rotation_matrix(orientation)
    up = R[2]
    weight, rate = ramp(sea, t)
    stream = current(sea, weight)
    force, torque, water, wetness, damping = gravity(boat, up), ZERO, ZERO, 0.0, no_damping()
    moving, faster = Twist(ZERO, ZERO), Twist(ZERO, ZERO)
    if boat.triangles > 0:
        if boat.follows_waves > 0:
            lift, turn = wave_pressure(boat, hull, sea, waves, R, position, t, weight)
        else:
            lift, turn = pressure(boat, hull, sea, waves, R, position, t, weight)
        force, torque = add(force, lift), turn
    for i in range(len(hull.probes)):
        probe = hull.probes[i]
        r = (probe.x, probe.y, probe.z)
        x, y, z = add(position, to_world(R, r))
        slope, felt = (0.0, 0.0), 0.0
        if boat.follows_waves > 0:
            eta, felt, slope, orbital, acceleration = water_motion(
                waves, hull.decay[i], sea.waves, x, y, t, weight, rate)
            moving = add_to_twist(boat, moving, probe, to_body(R, orbital))
            faster = add_to_twist(boat, faster, probe, to_body(R, acceleration))
        else:
            eta, orbital = surface(waves, sea.waves, x, y, t, weight, rate)
        hull.depths[i] = depth = eta - z
        wet, share = wetting(boat.law, probe.height, depth, up[2])
        s = ramped(wet)

        if boat.triangles == 0:
            if boat.follows_waves > 0:
                lift, turn = wave_lift(boat.law, probe, felt - z, slope, R)
            else:
                lift, turn = buoyancy(boat.law, probe, wet, share, up)
            force, torque = add(force, lift), add(torque, turn)

        # The probe's own damping pulls along with the water.
        flow = to_body(R, add(orbital, stream))
        c = probe_damping(boat, probe, s)
        pull = multiply(c, flow)
        force, torque = add(force, pull), add(torque, cross(r, pull))
        damping = with_point(damping, c, r)
        water = add_scaled(water, probe.share, flow)
        wetness += probe.share * s
    drag, spin_drag = body_damping(boat, wetness)
    body_stream = to_body(R, stream)
    if boat.follows_waves > 0:
        moving, faster = about_boat(boat, moving), about_boat(boat, faster)
        water = add(moving.linear, body_stream)
        # A nu_w' + B nu_w: the water takes the boat along, as its added mass and its drag have it.
        mass, inertia = added_mass(boat, wetness)
        force = add(force, multiply(mass, faster.linear))
        torque = add(torque, add(multiply(inertia, faster.angular),
                                 times(spin_drag, moving.angular)))
    wind = to_body(R, (sea.wind[0], sea.wind[1], 0.0))
    return Load(add(force, multiply(drag, water)), torque, with_body(damping, drag, spin_drag),
                wetness, water, moving.angular, body_stream, wind)


@compiled
def at_speed(boat, load, body_velocity, angular_velocity):
    """
    Return damping matrix, force and torque of a load, with all drag that is quadratic in speed.

    Linear in velocity, for a step: what is |u| in |u| u is taken at the speed given.
    """
    if boat.has_quadratic == 0:
        return load.damping, load.force, load.torque
    damping, force, torque = with_quadratic_drag(boat, load, body_velocity, angular_velocity)
    return with_air_drag(boat, load.wind, damping, force, torque, body_velocity,
                         angular_velocity)
