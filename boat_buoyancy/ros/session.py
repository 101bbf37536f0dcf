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
One boat as the node runs it, without ROS.

`Session` holds together what a period needs: the simulation, the stamps of its steps, the sea in
force at those stamps, the thrust that acts, and a fault if there was one.
"""

from dataclasses import replace

import numpy as np

from .pacing import Grid, NANOSECONDS, Timeline
from .thrust import ThrusterLatches, ThrustLatch
from ..physics.hydrostatics.rest import rest_state
from ..physics.scene.changes import WAVES
from ..physics.sea.fading import fade, FadingSea
from ..physics.stepping.simulation import SimulationError

# What shapes an irregular sea, and asks for none.
SHAPES = ('sea.direction', 'sea.spreading', 'sea.components', 'sea.seed')


class Session:
    """
    A scene under way.

    Main arguments: ``scene`` a `Scene`; ``start`` ns, the stamp of step 0 but for less than
    a period: stamps are multiples of it.
    Public: ``scene``; ``simulation``; ``sea``, as given, its time 0 that of the stamps;
    ``thrust`` a `ThrustLatch`; ``thrusters`` `ThrusterLatches`; ``propulsion``, what they give;
    ``wrench`` (6), the thrust of the last period, or None; ``fault``, why the motion was stopped,
    or None.
    """

    def __init__(self, scene, start=0):
        """Stand at the scene's start; ValueError when the scene cannot be stepped."""
        self.scene, self.simulation = scene, scene.simulation()
        self.thrust = ThrustLatch(scene.thrust_timeout)
        self.propulsion = scene.propulsion()
        self.thrusters = ThrusterLatches(self.propulsion.thrusters, scene.thrust_timeout)
        self.fault = self.wrench = None
        # A scene's centre of mass cannot change while it runs.
        self._center_of_mass = tuple(scene.boat.center_of_mass.tolist())
        self._timeline = Timeline(Grid(scene.rate)).rebased(start, 0)
        self._skipped = 0
        # Steps of simulations that were replaced by this one.
        self._earlier = 0
        self.sea, self._waiting = scene.sea, False
        self.simulation.sea = self._clocked(self.sea)

    @property
    def steps(self):
        """Return how many periods were stepped since the start."""
        return self._earlier + self.simulation.steps

    @property
    def center_of_mass(self):
        """Return the centre of mass in the body frame, three floats in m."""
        return self._center_of_mass

    @property
    def stamp(self):
        """Return the stamp of the present state in ns."""
        return self._timeline.stamp(self.steps)

    @property
    def age(self):
        """Return the s since the start on the clock of the stamps, through all its jumps."""
        return (self.steps + self._skipped) / self.simulation.rate

    def step(self):
        """
        Advance one period.

        Returns False when the motion left what physics allows: the last good state stays,
        `fault` says why, and nothing moves until `reset`.
        """
        if self.fault:
            return False
        simulation = self.simulation
        sea = simulation.sea
        if isinstance(sea, FadingSea) and sea.settled(simulation.time):
            if self._waiting:
                self._fade_to_given()
            else:
                simulation.sea = self._clocked(self.sea)
        try:
            self.wrench = self._push(self.age)
            simulation.step(self.wrench)
        except SimulationError as error:
            self.fault = str(error)
            return False
        return True

    def reset(self):
        """Go back to the start with neither thrust nor fault; sea and time go on."""
        self.simulation.state = self.scene.start
        self.thrust.clear()
        self.thrusters.clear()
        self.propulsion.stop()
        self.fault = self.wrench = None

    def place(self, x, y, yaw):
        """Put the boat at x, y m, heading yaw rad, as it lies at rest, with list and trim."""
        self.simulation.state = rest_state(self.scene.boat, yaw=yaw, x=x, y=y)

    def set_waves(self, rows):
        """
        Go over to other waves, (W, 4); return False when they are those in force.

        ValueError, and nothing changes, when one of them cannot run against the current.
        """
        if np.array_equal(rows, self.sea.waves):
            return False
        self.sea = replace(self.sea, waves=rows)
        self._fade_to_given()
        return True

    def set_wind(self, wind):
        """Let another wind (2,) m/s blow from the next step on; return False when it does."""
        if np.array_equal(wind, self.sea.wind):
            return False
        self.sea = self.sea.with_wind(wind)
        self.simulation.wind = wind
        return True

    def change(self, scene, plan=None, names=()):
        """
        Go on with another boat or sea: a `Scene` of the same probes.

        ``plan`` is the `Plan` of another boat, None where it is the same.  What moves keeps
        moving.  Waves and wind that came by message stay unless the scene's changed or ``names``,
        the parameters that were set, ask for them.
        """
        sea = self.sea_with(scene, names)
        self.scene = scene
        self.thrust.timeout = scene.thrust_timeout
        self.thrusters.set_timeout(scene.thrust_timeout)
        if plan is not None:
            self._change_boat(scene, plan)
        self.set_wind(sea.wind)
        if not np.array_equal(sea.waves, self.sea.waves) or sea.depth != self.sea.depth or (
                not np.array_equal(sea.current, self.sea.current)):
            self.sea = sea
            self._fade_to_given()

    def sea_with(self, scene, names):
        """
        Return the `Sea` after `change` to a scene, with the names of the parameters that were set.

        ValueError when the waves that came by message cannot run against its current, and when
        the boat lies so deep or high that its hull takes more or fewer columns.
        """
        before = self.scene
        count, wanted = (len(one.boat.hull.share) for one in (scene, before))
        if count != wanted:
            raise ValueError(f'{" and ".join(sorted(names))}: expected a boat on as many columns '
                             f'as before, {wanted}, as depths are published of each, got one that '
                             f'takes {count} at its new draft; start again with it')

        def changed(name):
            return scene.values[name] != before.values[name]
        # Which of its waves a scene has to leave out goes by the current: that asks for no waves.
        asked = WAVES.intersection(names) or any(map(changed, SHAPES)) and not np.array_equal(
            scene.sea.waves, before.sea.waves)
        own = asked or np.array_equal(self.sea.waves, before.sea.waves)
        windy = 'wind.velocity' in names or changed('wind.velocity')
        return replace(scene.sea, waves=(scene if own else self).sea.waves,
                       wind=(scene if windy else self).sea.wind)

    def _change_boat(self, scene, plan):
        """Step the boat of a scene from now on, as a `Plan` says."""
        old = self.simulation
        if (plan.integrator, plan.substeps) == (old.integrator, old.substeps):
            old.boat = scene.boat
            return
        self.simulation = scene.simulation()
        self._earlier += old.steps
        self.simulation.reset(old.state)
        self.simulation.sea = (old.sea.starting_at(old.time) if isinstance(old.sea, FadingSea)
                               else self._clocked(self.sea))

    def skip(self, periods):
        """Let the time of the stamps go on by so many periods in which the boat did not move."""
        if periods > 0:
            self._skipped += periods
            self._move(self._timeline.skipped(periods))

    def rebase(self, stamp):
        """Let the stamps go on from ``stamp`` ns."""
        self._move(self._timeline.rebased(stamp, self.steps))

    def _move(self, timeline):
        """Take other stamps; the water of the new time comes without a jump."""
        self._timeline = timeline
        if self.steps == 0:
            self.simulation.sea = self._clocked(self.sea)
        elif not self.sea.is_flat:
            self._fade_to_given()

    def _fade_to_given(self):
        """Fade over to the sea as given, or note that it has to wait: the newest wins."""
        simulation = self.simulation
        faded = fade(simulation.sea, self._clocked(self.sea), simulation.time,
                     self.scene.values['sea.transition'])
        self._waiting = faded is None
        if faded is not None:
            simulation.sea = faded

    def _clocked(self, sea):
        """Return a sea of stamp times as the simulation has to see it, which counts from 0."""
        # Whole seconds first: they and their remainder are exact, 1.7e18 ns in a float is not.
        seconds, nanoseconds = divmod(self._timeline.stamp(self._earlier), NANOSECONDS)
        return sea.starting_at(float(seconds)).starting_at(nanoseconds / NANOSECONDS)

    def _push(self, now):
        """Return wrench and thrusters together (6), body axes, or None."""
        wrench = self.thrust.wrench(now, self._orientation)
        if not self.propulsion.thrusters:
            return wrench
        pushed = self.propulsion.wrench(self.simulation, self.thrusters.commands(now),
                                        self.thrusters.angles)
        return pushed if wrench is None else [sum(both) for both in zip(wrench, pushed)]

    def _orientation(self):
        return self.simulation.motion.orientation
