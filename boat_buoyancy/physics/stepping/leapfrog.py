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

"""Leapfrog, the default: kick, drift, kick (Stoermer-Verlet), damping by Crank-Nicolson."""

from .arrival import arrival
from .equations_of_motion import damped_accelerations, net_wrench
from .free_motion import free_motion
from ..boat.state import Motion
from ..compiled import compiled
from ..forces.load import at_speed
from ..vectors import add, add_scaled, scale


@compiled
def leapfrog(boat, hull, sea, waves, motion, load, thrust, t, h):
    """
    Return motion and load after h s.

    Second order, one force a step, no energy drift; stable for w h < 2 at any damping.  The best
    for waves and drops.  The load belongs to the motion returned and is the next step's too.
    """
    body_velocity, spin = kick(boat, load, thrust, motion.body_velocity,
                               motion.angular_velocity, 0.5 * h)
    motion = free_motion(boat, load, Motion(
        motion.position, motion.orientation, body_velocity, spin), h)

    motion, load = arrival(boat, hull, sea, waves, motion, load, t + h)
    body_velocity, spin = kick(boat, load, thrust, motion.body_velocity, motion.angular_velocity,
                               0.5 * h)
    return Motion(motion.position, motion.orientation, body_velocity, spin), load


@compiled
def kick(boat, load, thrust, body_velocity, spin, dt):
    """
    Return velocity and angular velocity (body axes) after dt s at one place, by Crank-Nicolson.

    (M + dt/2 C) (u+ - u) = dt (f - C u): stable at any damping.  Quadratic drag takes the speed at
    the middle of the kick, in two passes, which keeps second order.
    """
    after = body_velocity, spin
    for _ in range(1 + boat.has_quadratic):
        damping, force, torque = at_speed(
            boat, load, scale(0.5, add(body_velocity, after[0])), scale(0.5, add(spin, after[1])))
        force, torque = net_wrench(damping, force, torque, thrust, body_velocity, spin)
        acceleration, spin_up = damped_accelerations(boat, load, damping, 0.5 * dt, force, torque)
        after = add_scaled(body_velocity, dt, acceleration), add_scaled(spin, dt, spin_up)
    return after
