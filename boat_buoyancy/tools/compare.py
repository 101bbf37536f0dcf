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

"""Runs of several scenes under one another: what each has that the one before it has not."""

from pathlib import Path

import numpy as np

from .plot import COLOURS, draw_line, padded, WATER
from ..physics.rotation import rotation_matrix

BEFORE = '0.75'


def tilt(run):
    """Return (n,) degrees between the mast of a boat and the vertical: 180 is upside down."""
    up = np.array(rotation_matrix(tuple(run.orientation.T))[2][2])
    return np.degrees(np.arccos(np.clip(up, -1.0, 1.0)))


QUANTITIES = (('height of the boat (m)', lambda run: run.position[:, 2]),
              ('off upright (deg)', tilt),
              ('speed ahead (m/s)', lambda run: run.body_velocity[:, 0]))
LEAST = 0.1, 2.0, 0.1


def write(path, runs, title):
    """
    Draw heave, tilt and speed ahead of `Trajectory` runs into a file, under a title.

    ``runs`` {path of the scene: run}, a row each, in a colour each; the row before it in grey.
    """
    from matplotlib.figure import Figure
    figure = Figure(figsize=(10.0, 1.4 + 1.3 * len(runs)), layout='constrained')
    panels = figure.subplots(len(runs), 3, sharex=True, sharey='col', squeeze=False)
    before = None
    for number, (row, (scene, run)) in enumerate(zip(panels, runs.items())):
        colour = COLOURS[number % len(COLOURS)]
        for axes, (_, values) in zip(row, QUANTITIES):
            if before is not None:
                draw_line(axes, before.time, values(before), color=BEFORE, label=None)
            draw_line(axes, run.time, values(run), color=colour, label=None)
            axes.grid(True, color='0.9', linewidth=0.8)
            axes.spines[['top', 'right']].set_visible(False)
        row[0].plot(run.time, run.elevation, color=WATER, linewidth=1.0, zorder=1.0)
        row[0].set_ylabel(Path(scene).stem.replace('_', ' ').replace(' ', '\n', 1), color=colour,
                          weight='bold', rotation=0, ha='right', va='center')
        before = run
    for axes, (what, values), least in zip(panels[0], QUANTITIES, LEAST):
        axes.set_title(what, fontsize='medium')
        axes.set_ylim(*padded(np.concatenate([values(run) for run in runs.values()]), least))
    for axes in panels[-1]:
        axes.set_xlabel('time (s)')
        axes.set_xlim(run.time[[0, -1]])
    figure.suptitle(f'{title}\ngrey: the row above; light blue: the water', fontsize='medium')
    figure.savefig(path, dpi=100)
