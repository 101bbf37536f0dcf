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

"""The page: a boat in the middle, its knobs to the right, what it does to the left."""

from html import escape

from .knob_panel import KnobPanel
from .knobs import turned
from .motion_panel import MotionPanel
from .number_panel import NumberPanel
from .readout import figures, stable_step
from .shapes import length_of
from .stage import CAMERAS, Stage
from .worker import Worker

# Pictures between two looks at what changes slowly.
SLOWLY = 10
# Colours of what is refused, for the page's markup.
REFUSED = '<span style="color: #b00020">{}</span>'


class Page:
    """
    What all pages of a server show alike.

    Main arguments: ``server`` of viser; ``boat``, a `Loop` or what offers the same.  Made and
    shown in the server's own thread, see `stage.in_turn`; what other threads say waits for it.
    """

    def __init__(self, server, boat):
        """Build it."""
        self._boat, self._server = boat, server
        gui = server.gui
        gui.configure_theme(show_logo=False, show_share_button=False)
        gui.main_panel.dock_right()
        gui.main_panel.set_width(350)
        # What is only shown takes a while, and nothing that moves the boat waits for it.
        self._worker, self._finder = Worker(self._refuse), Worker(self._refuse)
        self._stage = Stage(server, boat.scene.boat)
        self._message = gui.add_html('', visible=False)
        self._motion = MotionPanel(gui, boat, self._give, lambda: length_of(boat.scene.boat))
        self._camera = gui.add_dropdown('camera', CAMERAS, initial_value=CAMERAS[0])

        @self._camera.on_update
        async def _(event):
            if event.client_id is not None:
                self._stage.look(self._camera.value, boat.scene.boat)

        save = gui.add_button('Save as YAML', hint=(
            'A parameter file of the scene as tuned, which says what was changed.'))
        save.on_click(self._save)
        self._knobs = KnobPanel(gui, self._set)
        self._numbers = NumberPanel(gui, boat.history)
        self._scene = self._knobs_of = None
        self._sentence, self._shown_sentence, self._stable = '', '', None
        self._pictures = 0
        self.show()

    def show(self):
        """Show how things are now."""
        boat = self._boat
        self._stage.show(boat.snapshots)
        begun, scene = boat.begun, boat.scene
        if self._knobs_of is not None and begun != self._knobs_of[0]:
            self._stage.look(self._camera.value, scene.boat)
        # A change can give a parameter more numbers, and a node's come after it was met.
        knobs_of = begun, turned(scene) if scene is not self._scene else self._knobs_of[1]
        if knobs_of != self._knobs_of:
            self._knobs_of = knobs_of
            self._knobs.rebuild(scene)
        if scene is not self._scene:
            self._scene = scene
            self._found = figures(scene)
            self._numbers.show_scene(scene, self._found)
            self._finder.give('stable', self._find_stable, scene)
        if self._stable is not None:
            of_scene, step = self._stable
            self._stable = None
            if of_scene is scene:
                self._numbers.show_scene(scene, self._found, step)
        if self._pictures % SLOWLY == 0:
            self._knobs.show(scene)
            self._numbers.show(boat.history, boat.speed, boat.paused)
            self._motion.show()
        sentence = self._sentence or (f'stopped: {boat.fault}' if boat.fault else '')
        if sentence != self._shown_sentence:
            self._shown_sentence = sentence
            self._message.visible = bool(sentence)
            self._message.content = REFUSED.format(escape(sentence))
        self._pictures += 1

    def _set(self, key, values):
        """Have parameters changed to what a function gives of the scene by then."""
        self._give(key, lambda: self._boat.tune(values(self._boat.scene)))

    def _give(self, key, function, *arguments):
        def work():
            function(*arguments)
            self._say('')
        self._worker.give(key, work)

    def _refuse(self, error):
        self._say(str(error) or repr(error))

    def _say(self, sentence):
        """Have a sentence shown above everything until something else goes well, '' for none."""
        self._sentence = sentence

    def _find_stable(self, scene):
        self._stable = scene, stable_step(scene)

    async def _save(self, event):
        if event.client is not None:
            event.client.send_file_download(f'{self._boat.name}_tuned.yaml',
                                            self._boat.text().encode(), save_immediately=True)
