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

"""A boat that is tuned, pushed and looked at while it floats, without a page."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .history import History
from .scene_text import scene_text
from .snapshot import pushes_of, Snapshot
from ...physics.boat.state import body_frame, center_of_mass_state
from ...physics.hydrostatics.rest import floating_state
from ...physics.rotation import rotation_matrix, to_roll_pitch_yaw
from ...physics.scene.changes import changed
from ...physics.scene.parameters import PARAMETERS
from ...physics.scene.scene import load_scene, Scene, scene_from_values
from ...physics.sea.fading import FadingSea
from ...physics.step_size.plan import Plan
from ...ros.session import Session

# A push acts for so long in s after it was last asked for, so that held keys push without a gap.
PUSH_LASTS = 0.6
# What makes the sea that goes along to another scene.
SEA = ('sea.', 'wind.velocity')


@dataclass(frozen=True, eq=False)
class Change:
    """
    A change that was found to be right, to be taken between two steps.

    ``scene`` after it; ``plan`` of another boat, None where it is the same; ``names`` that were
    asked for; ``session`` to go on with where the one that runs cannot take it, else None;
    of another scene, its ``name`` and ``at_start``, what its file gives.
    """

    scene: Scene
    plan: Plan | None = None
    names: frozenset = frozenset()
    session: Session | None = None
    name: str | None = None
    at_start: dict | None = None


class LiveBoat:
    """
    A scene afloat.

    Main arguments: ``source``, the path of a parameter file.
    Public: ``name`` of the scene; ``begun``, how many scenes were; ``scene`` in force; ``session``
    that steps it; ``history``; ``paused``; ``pace``, simulated over wall time.
    """

    def __init__(self, source):
        """Stand at the start; ValueError says what is wrong with the file."""
        self.paused, self.pace, self.history = False, 1.0, History()
        self.session, self.begun = None, 0
        self.take(self.opened(source))

    # Changes: worked out at leisure, then taken between two steps.

    def proposed(self, values):
        """
        Return the `Change` of parameters {name: value}, None to go back to the beginning.

        ValueError with the sentence that `ros2 param set` gives.  What a node refuses to change
        while it runs, the rate as an example, restarts the simulation where the boat is.
        """
        before = self.scene
        scene = scene_from_values(changed(before.given, self._at_start, values), before)
        if any(PARAMETERS[name].read_only and scene.values.get(name) != before.values.get(name)
               for name in values):
            return Change(scene, session=Session(scene))
        self.session.sea_with(scene, frozenset(values))
        plan = None if scene.boat is before.boat else scene.plan()
        return Change(scene, plan, frozenset(values))

    def opened(self, source):
        """
        Return the `Change` to another parameter file; ValueError says what is wrong with it.

        A sea that was chosen here goes along, so that boats can be felt in the same one.
        """
        scene = load_scene(source)
        at_start, sea = scene.given, None if self.session is None else self._sea(self.scene.given)
        if sea is not None and sea != self._sea(self._at_start):
            boat = {name: value for name, value in at_start.items() if not name.startswith(SEA)}
            scene = scene_from_values({**boat, **sea}, scene)
        return Change(scene, session=Session(scene), name=Path(source).stem, at_start=at_start)

    def take(self, change):
        """Go on with a `Change`: what moves keeps moving, but in another scene from its start."""
        before = self.session
        if change.session is None:
            before.change(change.scene, change.plan, change.names)
        else:
            self.session = change.session
            if before is not None:
                self._carry_over(before, change)
        self.scene = change.scene
        if change.at_start is not None:
            self.name, self._at_start, self.history = change.name, change.at_start, History()
            self.begun += 1
        self.session.thrust.timeout = PUSH_LASTS
        self.session.thrusters.set_timeout(PUSH_LASTS)

    def _carry_over(self, before, change):
        """Let a new session go on where another one was."""
        session, old = change.session, before.simulation
        session.rebase(before.stamp)
        if change.at_start is not None:
            return
        position, orientation, velocity, turning = body_frame(before.scene.boat, old.state)
        session.simulation.state = center_of_mass_state(
            change.scene.boat, position, orientation, velocity, turning)
        if change.scene.sea is before.scene.sea and isinstance(old.sea, FadingSea):
            session.simulation.sea = old.sea.starting_at(old.time)

    @staticmethod
    def _sea(given):
        return {name: value for name, value in given.items() if name.startswith(SEA)}

    def text(self):
        """Return the scene as tuned as the text of a parameter file."""
        return scene_text(self.name, self.scene.given, self._at_start)

    # What moves it.

    @property
    def halted(self):
        """Return True while nothing moves by itself: paused, or stopped by a fault."""
        return self.paused or self.session.fault is not None

    def step(self):
        """Advance one period, and remember; return False when the motion cannot go on."""
        if not self.session.step():
            return False
        time = self.session.stamp / 1e9
        if self.history.is_due(time):
            motion = self.session.simulation.motion
            self.history.add(time, self._placed(motion)[0], to_roll_pitch_yaw(motion.orientation),
                             motion.body_velocity)
        return True

    def push(self, ahead, turn):
        """
        Push by ``ahead`` N and ``turn`` N m, positive to port, for `PUSH_LASTS` s.

        By its thrusters, ahead shared alike and the turn by those beside the middle; a boat that
        has none is pushed at the body origin.
        """
        session = self.session
        if not self.scene.thrusters:
            session.thrust.hold((ahead, 0.0, 0.0, 0.0, 0.0, turn), False, session.age)
            return
        effect = np.array([[push[0], torque[2]] for push, torque in (
            thruster.wrench(1.0) for thruster in self.scene.thrusters)])
        # The least thrusts that come nearest to what is asked for.
        thrusts = np.linalg.pinv(effect.T) @ [ahead, turn]
        for thruster, thrust in zip(self.scene.thrusters, thrusts.tolist()):
            session.thrusters.hold(thruster.name, thrust, session.age)

    def lift(self, height):
        """Raise the boat by ``height`` m, at rest and as it is turned, and let go."""
        state = self.session.simulation.state
        self._put(state, position=state.position + [0.0, 0.0, height])

    def heel(self, angle):
        """Heel the boat to ``angle`` rad, starboard down, afloat and at rest, and let go."""
        state = self.session.simulation.state
        position = body_frame(self.scene.boat, state)[0]
        self.session.simulation.state = floating_state(
            self.scene.boat, roll=angle, yaw=float(state.yaw), x=position[0], y=position[1])

    def _put(self, state, position):
        self.session.simulation.state = type(state)(position, state.orientation)

    def reset(self):
        """Go back to the start; sea and time go on."""
        self.session.reset()

    # What is seen of it.

    def _placed(self, motion):
        """Return position (3,) m of the body frame in the world and the matrix of its turn."""
        turn = np.reshape(rotation_matrix(motion.orientation), (3, 3))
        return motion.position - turn @ self.scene.boat.center_of_mass, turn

    def snapshot(self):
        """Return the `Snapshot` of this moment."""
        session = self.session
        simulation, boat = session.simulation, session.simulation.boat
        motion = simulation.motion
        thrusters = session.propulsion.thrusters.values()
        pushes = pushes_of(thrusters, session.propulsion.forces, session.thrusters.angles,
                           None if thrusters else session.wrench)
        return Snapshot(
            boat, simulation.sea, simulation.time, session.stamp / 1e9, self._placed(motion)[0],
            np.array(motion.orientation), np.array(simulation.probe_depths),
            np.array(simulation.probe_forces), pushes)
