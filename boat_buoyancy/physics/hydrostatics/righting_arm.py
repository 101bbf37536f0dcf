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

"""Righting arms: what rights a heeled boat, from upright to upside down."""

import math

import numpy as np

from .rest import floating_state, floats, NEGLIGIBLE, rest_attitude
from .stiffness import still_load
from ..boat.clipping import level_for, submerged
from ..rotation import from_roll_pitch_yaw, rotation_matrix

# How far from rest in rad the range of stability is looked for: first, and then from one to the
# next, and how exactly its end is found.
FIRST_HEEL, HEEL_STEP, FOUND = 1e-3, math.radians(5.0), 1e-4


def righting_arms(boat, heel):
    """
    Return the righting arm GZ (n,) m at each angle of ``heel`` (n,) rad, NaN for one that sinks.

    -(roll torque about the centre of mass) / (m g), free to rise and sink, at the trim that the
    boat has at rest; positive when it rights a positive heel.  The model's own: what the
    simulation does.
    """
    heel = np.asarray(heel, float)
    if not floats(boat):
        return np.full(heel.shape, math.nan)
    if boat.hull.panels is not None:
        boat = boat.on_surface
    states = floating_state(boat, heel.ravel(), trim(boat))
    torque = [still_load(boat, states[i])[0].torque[0] for i in range(heel.size)]
    return -np.reshape(torque, heel.shape) / boat.weight


def surface_righting_arms(boat, heel):
    """
    Return the righting arm (n,) m of a hull's surface, as of `righting_arms`, by exact clipping.

    NaN for a surface that displaces less than the boat weighs.
    """
    heel, surface = np.asarray(heel, float), boat.hull.surface
    volume, arms = boat.weight / boat.hull.specific_weight, []
    for angle in heel.ravel().tolist():
        R = np.array(rotation_matrix(from_roll_pitch_yaw(angle, trim(boat), 0.0)))
        facets = (surface.facets - boat.center_of_mass) @ R.T
        wet, moment = submerged(facets - [0.0, 0.0, level_for(facets, volume)])
        # The lift's torque m g (y, -x, 0) about body x.
        arms.append((R[1, 0] * moment[0] - R[0, 0] * moment[1]) / wet)
    return np.reshape(arms if volume <= surface.volume else [math.nan] * heel.size, heel.shape)


def stability_range(boat):
    """
    Return the heels in rad, to port and to starboard, from which a boat comes back to its rest.

    A `Boat` that floats.  Counted from its list on, at its trim, each to where the righting arm
    vanishes first: the list itself on a side where nothing rights the boat, half a turn from it
    where everything does.
    """
    rest = (rest_attitude(boat) or (0.0, 0.0))[0]
    return tuple(rest + side * _righted(boat, rest, side) for side in (-1.0, 1.0))


def _righted(boat, rest, side):
    """Return how far in rad from a list ``rest`` the arms to one side (-1 or 1) right a boat."""
    # On panels they are the same to round-off, and the surface's the quicker.
    arms_at = righting_arms if boat.hull.panels is None else surface_righting_arms

    def rights(away):
        arm, = arms_at(boat, [rest + side * away])
        return side * arm > NEGLIGIBLE * boat.size

    low = 0.0
    for high in (FIRST_HEEL, *np.arange(HEEL_STEP, math.pi + FOUND, HEEL_STEP).tolist()):
        if not rights(high):
            break
        low = high
    else:
        return math.pi
    if low == 0.0:
        return 0.0
    while high - low > FOUND:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if rights(middle) else (low, middle)
    return high


def trim(boat):
    """Return the pitch in rad at which a boat lies at rest; 0 where it has no rest."""
    return (rest_attitude(boat) or (0.0, 0.0))[1]


def wall_sided_heel(beam, depth, draft, length=0.0, trim=0.0):
    """
    Return the heel in rad at which a box's deck edge dips or its bilge comes out of the water.

    Main arguments: ``beam``, ``depth`` and mean ``draft`` m.
    Other arguments: ``length`` m and ``trim`` rad, of a box that does not lie level along; 0 where
    an edge is through the water upright.

    Up to there its sides are vertical walls through the water and columns at Gauss points give its
    righting arm without error.  The water stands tan(trim) / cos(heel) length / 2 and
    tan(heel) beam / 2 off the draft at the box's corners.
    """
    room, half = min(depth - draft, draft), 0.5 * beam
    along = 0.5 * length * abs(math.tan(trim))
    if along >= room:
        return 0.0
    # room cos(heel) - half sin(heel) = along
    return math.acos(along / math.hypot(room, half)) - math.atan2(half, room)
