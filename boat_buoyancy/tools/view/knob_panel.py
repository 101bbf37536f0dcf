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

"""The knobs of a page: sliders for what is tuned most, a field for every parameter."""

import time

from .knobs import knobs, meaning, trimmed
from ...physics.scene.parameter_file import parse
from ...physics.scene.parameters import PARAMETERS
from ...physics.stepping.integrators import INTEGRATORS

# A slider that was moved less than so many s ago is in somebody's hand: it is left alone.
IN_HAND = 3.0
ENDS = ('bow', 'stern', 'port', 'starboard', 'level')


class KnobPanel:
    """
    Tabs of knobs.

    Main arguments: ``gui`` of viser; ``set_values``, called with (key, function) when something
    is to be changed: the function of a `Scene` gives {name: value} once it is its turn, and of
    those with the same key, but None, the newest counts.
    """

    def __init__(self, gui, set_values):
        """Add nothing yet."""
        self._gui, self._set = gui, set_values
        self._scene = self._tabs = None
        self._sliders = {}

    def rebuild(self, scene):
        """Make the knobs for a `Scene` that has others than the one before."""
        if self._tabs is not None:
            self._tabs.remove()
        self._scene, self._sliders = scene, {}
        self._tabs = self._gui.add_tab_group()
        for group, members in knobs(scene).items():
            with self._tabs.add_tab(group):
                if group == 'Boat':
                    self._add_trim()
                for knob in members:
                    self._add_slider(knob)
        with self._tabs.add_tab('Step'):
            self._add_step()
        with self._tabs.add_tab('All'):
            self._add_any()

    def show(self, scene):
        """Let every knob that nobody holds stand where its value is."""
        self._scene = scene
        for knob, slider in self._sliders.items():
            if time.time() - slider.update_timestamp < IN_HAND:
                continue
            value = type(slider.value)(knob.value(scene))
            slider.min, slider.max = min(slider.min, value), max(slider.max, value)
            slider.value = value
        self._integrator.value = scene.integrator
        self._rate.value = scene.rate
        self._substeps.value = scene.substeps
        self._follow()

    def _add_slider(self, knob):
        slider = self._gui.add_slider(knob.label, knob.low, knob.high, knob.step,
                                      type(knob.low)(knob.value(self._scene)), hint=knob.hint)
        self._sliders[knob] = slider

        @slider.on_update
        def _(event):
            value = slider.value
            # What lies outside is a number of which the first digits are written.
            if event.client_id is not None and slider.min <= value <= slider.max:
                self._set(knob, lambda scene: knob.request(scene, value))

    def _add_trim(self):
        trim = self._gui.add_button_group('let down', ENDS, hint=(
            'Trim: lets that end sink a little, by the weights of the probes (probes.weights), '
            'or of a hull by its centre of mass. Level goes back to the beginning.'))

        @trim.on_click
        def _(_):
            end = trim.value
            self._set(None, lambda scene: trimmed(scene, end))

    def _add_step(self):
        scene, gui = self._scene, self._gui
        self._integrator = gui.add_dropdown(
            'integrator', tuple(INTEGRATORS), initial_value=scene.integrator,
            hint=meaning('integrator'))
        self._rate = gui.add_number('rate (Hz)', scene.rate, min=0.1, step=0.1,
                                    hint=meaning('rate'))
        self._substeps = gui.add_number('substeps', scene.substeps, step=1,
                                        hint=meaning('substeps'))
        gui.add_markdown('These restart the simulation where the boat is.')
        for name, field in (('integrator', self._integrator), ('rate', self._rate),
                            ('substeps', self._substeps)):
            field.on_update(lambda event, name=name, field=field: (
                event.client_id is not None and self._set(
                    name, lambda _, value=field.value: {name: value})))

    def _add_any(self):
        gui, scene = self._gui, self._scene
        names = tuple(name for name in PARAMETERS if name in scene.values)
        name = gui.add_dropdown('parameter', names, initial_value='boat.mass')
        value = gui.add_text('value', '')
        button = gui.add_button('Set')
        about = gui.add_markdown('')

        told = None

        def tell():
            # What somebody writes there stays, until the value is another one.
            nonlocal told
            now = name.value, self._scene.values.get(name.value)
            if now != told:
                told = now
                value.value = str(list(now[1]) if isinstance(now[1], tuple) else now[1])
                about.content = meaning(name.value)

        @button.on_click
        def _(_):
            given = name.value, value.value
            self._set(None, lambda _: read_value(*given))

        @name.on_update
        async def _(_):
            tell()

        self._follow = tell
        tell()


def read_value(name, text):
    """
    Return {name: value} of a value as it stands in a parameter file.

    ValueError says what is wrong with it, as of a file.
    """
    try:
        return parse(f'/**:\n  ros__parameters:\n    {name}: {" ".join(text.split())}\n')
    except ValueError as error:
        # There is no third line on a page.
        raise ValueError(str(error).replace(' (line 3)', '')) from None
