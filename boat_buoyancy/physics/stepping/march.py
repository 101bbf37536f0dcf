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
The step of many boats by many periods, in one call: what is compiled.

What changes of a boat are rows of floats (arrays when compiled, lists in plain Python): the state
(13), the load (34) at its place and time, and what a `HullView` has of it.
"""

import numpy as np

from .guard import is_possible, speed_reached
from .integrators import INTEGRATORS
from .leapfrog import leapfrog as step
from .speed_bound import BOUND
from ..boat.records import HullView
from ..boat.state import Motion
from ..compiled import calling, compiled
from ..forces.damping import DampingMatrix
from ..forces.load import Load, load_at
from ..vectors import cross, subtract, three

# How a boat is stepped: on which sea, with which panels, integrator steps per period, the rate in
# Hz of periods, and the bound that the guard holds its speed to.
PACE = np.dtype([('sea', 'i8'), ('panels', 'i8'), ('decay', 'i8'), ('substeps', 'i8'),
                 ('rate', 'f8'), ('bound', BOUND)])
STATE_SIZE, LOAD_SIZE = 13, 34


@compiled
def march(boats, probes, corners, triangles, decays, seas, waves, paces, states, loads, depths,
          places, reached, failed, thrust, by_boat, by_period, first, periods, track, depth_track):
    """
    Advance every boat by some periods; return how many of them have failed.

    Main arguments: records of ``boats`` (B,), ``probes`` (B, n), ``seas`` (S,), ``paces`` (B,);
    ``corners`` and ``triangles`` of P panelled hulls; ``decays`` of D hulls in their seas, each as
    `HullView` has it; ``waves`` S tables.  Rows that change:
    ``states``, ``loads``, ``depths`` (B, 2, n), now and before the period, and ``places`` of each
    boat, ``reached`` (B,) |u|_M,
    ``failed`` (B,), the number of the period in which a boat failed, or 0: it stands still from
    then on, in its last good state.
    Other arguments: ``thrust`` (k, 6) N and N m, body axes, at the body origin; row
    i by_boat + j by_period is boat i's in period j; ``first``, periods done before;
    ``track`` (periods, 13) and ``depth_track`` (periods, n) are written for the only boat, or
    empty.
    """
    for i in range(len(boats)):
        boat, pace, depth, kept = boats[i], paces[i], depths[i][0], depths[i][1]
        sea, table = seas[pace.sea], waves[pace.sea]
        hull = HullView(probes[i], corners[pace.panels], triangles[pace.panels],
                        decays[pace.decay], depth, places[i])
        state, memory, greatest = states[i], loads[i], float(reached[i])
        motion, load = read_motion(state), read_load(memory)
        h = 1.0 / (pace.rate * pace.substeps)
        for j in range(periods):
            if failed[i] != 0:
                break
            push = about_center_of_mass(boat, thrust[i * by_boat + j * by_period])
            copy(depth, kept)
            after, load_after = motion, load
            for k in range(pace.substeps):
                t = ((first + j) * pace.substeps + k) / (pace.rate * pace.substeps)
                after, load_after = step(boat, hull, sea, table, after, load_after, push, t, h)
                greatest = speed_reached(pace.bound, greatest, push, h)
                if not is_possible(pace.bound, greatest, after):
                    failed[i] = first + j + 1
                    break
            if failed[i] != 0:
                # What the hull has was written over: that of the last good state again.  Sums
                # are rounded another way here than within a step, so the depths are those kept.
                load_at(boat, hull, sea, table, motion.position, motion.orientation,
                        (first + j) / pace.rate)
                copy(kept, depth)
                break
            motion, load, reached[i] = after, load_after, greatest
            if len(track) > 0:
                write_motion(motion, track[j])
                copy(depth, depth_track[j])
        write_motion(motion, state)
        write_load(load, memory)
    count = 0
    for i in range(len(boats)):
        count += failed[i] != 0
    return count


def march_by(integrator):
    """Return `march` by the integrator of a name."""
    return calling(march, step=INTEGRATORS[integrator].step)


@compiled
def begin(boats, probes, corners, triangles, decays, seas, waves, paces, states, loads, depths,
          places, chosen, t):
    """Compute loads and depths of the boats ``chosen`` (k,) at their places and t s."""
    for i in chosen:
        motion, pace = read_motion(states[i]), paces[i]
        hull = HullView(probes[i], corners[pace.panels], triangles[pace.panels],
                        decays[pace.decay], depths[i][0], places[i])
        write_load(load_at(boats[i], hull, seas[pace.sea], waves[pace.sea], motion.position,
                           motion.orientation, t), loads[i])


@compiled
def copy(numbers, row):
    """Write some numbers to a row as long."""
    for n in range(len(numbers)):
        row[n] = numbers[n]


@compiled
def about_center_of_mass(boat, thrust):
    """Return force and torque about the centre of mass of six numbers at the body origin."""
    force, torque = three(thrust), (thrust[3], thrust[4], thrust[5])
    return force, subtract(torque, cross(three(boat.center_of_mass), force))


@compiled
def read_motion(row):
    """Return the `Motion` of a row (13)."""
    return Motion((row[0], row[1], row[2]), (row[3], row[4], row[5], row[6]),
                  (row[7], row[8], row[9]), (row[10], row[11], row[12]))


@compiled
def write_motion(motion, row):
    """Write a `Motion` to a row (13)."""
    row[0], row[1], row[2] = motion.position
    row[3], row[4], row[5], row[6] = motion.orientation
    row[7], row[8], row[9] = motion.body_velocity
    row[10], row[11], row[12] = motion.angular_velocity


@compiled
def read_load(row):
    """Return the `Load` of a row (34)."""
    damping = DampingMatrix((row[6], row[7], row[8]),
                            (row[9], row[10], row[11], row[12], row[13], row[14]),
                            (row[15], row[16], row[17], row[18], row[19], row[20]))
    return Load((row[0], row[1], row[2]), (row[3], row[4], row[5]), damping, row[21],
                (row[22], row[23], row[24]), (row[25], row[26], row[27]),
                (row[28], row[29], row[30]), (row[31], row[32], row[33]))


@compiled
def write_load(load, row):
    """Write a `Load` to a row (34)."""
    row[0], row[1], row[2] = load.force
    row[3], row[4], row[5] = load.torque
    row[6], row[7], row[8] = load.damping.linear
    row[9], row[10], row[11], row[12], row[13], row[14] = load.damping.coupling
    row[15], row[16], row[17], row[18], row[19], row[20] = load.damping.angular
    row[21] = load.wetness
    row[22], row[23], row[24] = load.water
    row[25], row[26], row[27] = load.turning
    row[28], row[29], row[30] = load.stream
    row[31], row[32], row[33] = load.wind
