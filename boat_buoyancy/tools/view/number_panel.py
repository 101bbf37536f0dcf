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

"""What the boat does on a page: numbers at rest, warnings, the last minute, the pace."""

from .legend import legend
from .readout import numbers_text, warnings_text

BLUE, RED = '#0072B2', '#D55E00'
HEIGHT = 125  # pixels of a plot


class NumberPanel:
    """The panel at the left; ``gui`` of viser."""

    def __init__(self, gui, history):
        """Add everything, empty."""
        panel = gui.add_panel()
        with panel.add_tab('What it does'):
            self._speed = gui.add_markdown('')
            self._numbers = gui.add_markdown('')
            columns = history.columns()
            self._plots = [
                (_plot(gui, columns, (1,), ('heave (m)',), (-0.1, 0.1)), (1,)),
                (_plot(gui, columns, (2, 3), ('roll (deg)', 'pitch (deg)'), (-2.0, 2.0)),
                 (2, 3)),
                (_plot(gui, columns, (4,), ('speed (m/s)',), (0.0, 0.2)), (4,))]
        with panel.add_tab('Warnings'):
            self._warnings = gui.add_markdown('')
        with panel.add_tab('Legend'):
            gui.add_html(legend())
        panel.dock_left()
        panel.set_width(330)

    def show_scene(self, scene, found, *stable):
        """Show what `readout` found of a `Scene`."""
        self._numbers.content = numbers_text(scene, found, *stable)
        count = len(found['warnings'])
        self._warnings.content = warnings_text(found['warnings'])
        self._count = f' · **{count} warning{"" if count == 1 else "s"}**' if count else ''

    def show(self, history, speed, paused):
        """Show the last minute of a `History`, and a `Speed`."""
        columns = history.columns()
        for plot, rows in self._plots:
            plot.data = tuple(columns[row] for row in (0, *rows))
        how = 'paused' if paused else f'{speed.held:.2f} times real time'
        # A node keeps the cost of its steps to itself.
        cost = (f'; a step costs {1e6 * speed.cost:.0f} µs, {speed.possible:.0f} times real time '
                'possible') if speed.cost else ''
        self._speed.content = f'{how}{cost}{self._count}'


def _plot(gui, columns, rows, labels, shown):
    """Return a plot of some columns of a `History`, in which two heights are always shown."""
    series = tuple({'label': label, 'stroke': color, 'width': 1.5}
                   for label, color in zip(labels, (BLUE, RED)))
    return gui.add_uplot(
        tuple(columns[row] for row in (0, *rows)), ({'label': 's'}, *series),
        scales={'x': {'time': False}, 'y': {'range': _at_least(*shown)}},
        axes=({'size': 32}, {'size': 44}), height=HEIGHT, padding=(4, 8, 0, 0))


def _at_least(low, high):
    """Return a range in uPlot's words that takes in what is drawn and two numbers."""
    return {end: {'pad': 0.1, 'soft': soft, 'mode': 1}
            for end, soft in (('min', low), ('max', high))}
