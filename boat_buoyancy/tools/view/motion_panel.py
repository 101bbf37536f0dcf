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

"""What moves the boat on a page: the choice of the scene, pushes, and time itself."""

import math

# A push at full strength over the weight of the boat; the slider goes to so much of it.
STRENGTH, STRONGEST = 0.2, 1.0
# How far a boat is lifted, over its length, and how far it is heeled.
LIFT, HEEL = 0.4, math.radians(30.0)
PACES = {'real time': 1.0, 'half as fast': 0.5, 'a fifth': 0.2, 'a twentieth': 0.05}
# Ahead and turn of each push, with its key.
PUSHES = {'↺ J': (0.0, 1.0, 'J'), '↑ I': (1.0, 0.0, 'I'), '↓ K': (-1.0, 0.0, 'K'),
          '↻ L': (0.0, -1.0, 'L')}


class MotionPanel:
    """
    Buttons and keys that move a boat.

    Main arguments: ``gui`` of viser; ``boat``, that does it, a `Loop` or the like; ``give`` (key,
    function, arguments), to have something done soon; ``length`` () -> m of the boat.
    """

    def __init__(self, gui, boat, give, length):
        """Add the buttons."""
        self._boat, self._length = boat, length
        self._scenes = None
        if boat.scenes:
            self._scenes = scenes = gui.add_dropdown(
                'scene', tuple(boat.scenes), initial_value=boat.name, hint=(
                    'The five steps v0 to v4 add one part of the model each. A sea that you '
                    'chose goes along.'))
            scenes.on_update(lambda event: event.client_id is not None and give(
                'scene', boat.switch, boat.scenes[scenes.value]))
        run = gui.add_button_group('time', ('pause', 'go', 'step', 'reset'))
        run.on_click(lambda _: give(None, self._run, run.value))
        pace = gui.add_dropdown('pace', tuple(PACES), initial_value='real time')
        pace.on_update(lambda event: event.client_id is not None and give(
            'pace', boat.set_pace, PACES[pace.value]))
        push = gui.add_button_group('push', tuple(PUSHES), hint=(
            'Turn to port, ahead, astern, turn to starboard, for a moment. Hold the key J, I, K '
            'or L to go on pushing.'))
        push.on_click(lambda _: give('push', self._push, push.value))
        self._strength = gui.add_slider(
            'push, of the weight', 0.01, STRONGEST, 0.01, STRENGTH,
            hint='Thrust over the weight of the boat; what turns it acts at half its length.')
        try_out = gui.add_button_group('try', ('lift and drop', 'heel and let go'))
        try_out.on_click(lambda _: give(None, self._try_out, try_out.value))
        for name, (_, _, key) in PUSHES.items():
            command = gui.add_command(f'Push {name}', hotkey=key)
            command.on_trigger(lambda _, name=name: give('push', self._push, name))
        pausing = gui.add_command('Pause or go on', hotkey='space')
        pausing.on_trigger(lambda _: give(None, lambda: boat.pause(not boat.paused)))

    def show(self):
        """Offer what there is to go over to by now."""
        if self._scenes is not None and self._scenes.options != tuple(self._boat.scenes):
            self._scenes.options = tuple(self._boat.scenes)

    def _run(self, what):
        if what == 'step':
            self._boat.step()
        elif what == 'reset':
            self._boat.reset()
        else:
            self._boat.pause(what == 'pause')

    def _push(self, where):
        ahead, turn, _ = PUSHES[where]
        force = self._strength.value * self._boat.scene.boat.weight
        self._boat.push(ahead * force, turn * force * 0.5 * self._length())

    def _try_out(self, what):
        if what == 'lift and drop':
            self._boat.lift(LIFT * self._length())
        else:
            self._boat.heel(HEEL)
