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

"""The picture of stability: where each integrator is calm, and what drag does to a game loop."""

from pathlib import Path

import numpy as np

from .stability_map import (loop_growth, measure_map, predicted_loop_growth, RATES,
                            scene_points)
from ..command_line import shipped_scenes

NAME = 'stability.png'
# Each integrator's panel: its title, and where to write that it is calm and that it shakes.
PANELS = {'leapfrog': ('leapfrog (default)', (1.6, 1.5), (2.72, 0.25)),
          'implicit': ('implicit', (1.6, 1.5), None),
          'rk4': ('rk4', (1.7, 0.6), (2.3, 1.45)),
          'symplectic_euler': ('symplectic_euler (game loop)', (1.15, 0.18), (2.1, 1.2)),
          'euler': ('euler (study only)', (0.85, 0.9), (2.2, 1.2))}
ANGLES, RATIOS = 3.2, 2.0
# Runs along omega h and along the damping ratio, and the steps of each; True for quick.
GRIDS = {True: (16, 10, 90), False: (40, 25, 180)}
# Okabe and Ito's colours, told apart by colour-blind eyes too; calm is light, shaking darker.
CALM, SHAKES = '#CFE8F7', '#E8A33D'
# Springs of the second panel by omega h, 0 for free flight: colour, name and where to write it.
LOOPS = {0.0: ('0.4', 'in the air:\nno spring', (1.62, 0.32), 'left'),
         0.0886: ('#0072B2', 'soft spring,\nω h = 0.09', (2.25, 1.48), 'right'),
         0.5: ('#B24A00', 'stiff spring,\nω h = 0.5', (2.95, 0.82), 'right')}
MARKERS = dict(zip(RATES, ('^', 'o', 's')))
HEADING = (
    'Does a small disturbance of a floating boat die out?   Blue: yes.   Orange: it grows, the '
    'boat shakes.\nColour: measured, the shipped code run.   Black line: predicted.   '
    'Small markers: the shipped scenes at 30 Hz (\u25b3), 60 Hz (\u25cb), 100 Hz (\u25a1).')


def draw_stability(out_dir, quick=False, scenes=None, progress=print):
    """
    Measure and draw the chart, and return the path of ``stability.png``.

    Main arguments: ``out_dir`` a folder; ``quick`` takes a coarser grid and shorter runs.
    Other arguments: ``scenes`` parameter files to mark, by default those that are shipped;
    ``progress`` takes a line before each integrator.
    """
    from matplotlib.figure import Figure
    columns, rows, steps = GRIDS[bool(quick)]
    angles = (np.arange(columns) + 0.5) * ANGLES / columns
    ratios = (np.arange(rows) + 0.5) * RATIOS / rows
    points = {Path(path).stem: scene_points(path)
              for path in (shipped_scenes() if scenes is None else scenes)}
    figure = Figure(figsize=(9.0, 6.9), layout='constrained')
    panels = figure.subplots(2, 3)
    for axes, (integrator, panel) in zip(panels.flat, PANELS.items()):
        progress(f'stability: {integrator}, {columns} x {rows} runs')
        draw_map(axes, measure_map(integrator, angles, ratios, steps), panel)
        draw_scenes(axes, points)
    for axes in panels[:, 0]:
        axes.set_ylabel('damping ratio  (1 = critical)')
    name_scenes(panels[0, 0], points)
    draw_loop(panels[1, 2])
    figure.suptitle(HEADING, fontsize=9.0)
    path = Path(out_dir) / NAME
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=200)
    return path


def draw_map(axes, measured, panel):
    """Draw the measured region of an integrator and its predicted boundary."""
    from matplotlib.colors import ListedColormap
    axes.imshow(measured.calm, origin='lower', extent=(0.0, ANGLES, 0.0, RATIOS), aspect='auto',
                cmap=ListedColormap([SHAKES, CALM]), vmin=0, vmax=1, interpolation='nearest')
    ratio, angle = measured.boundary.T
    axes.plot(np.minimum(angle, 10.0 * ANGLES), ratio, color='black', linewidth=1.8)
    title, *places = panel
    axes.set(xlim=(0.0, ANGLES), ylim=(0.0, RATIOS), xlabel='ω h  (natural frequency × step)',
             yticks=(0.0, 0.5, 1.0, 1.5, 2.0))
    axes.set_title(title, fontsize=10.5, fontweight='bold')
    for place, word in zip(places, ('calm', 'shakes')):
        if place is not None:
            axes.text(*place, word, fontsize=11, ha='center', va='center')


def draw_scenes(axes, points):
    """Mark every scene at each of RATES."""
    for at in points.values():
        for rate, (x, y) in zip(RATES, at):
            axes.plot(x, y, MARKERS[rate], color='white', markeredgecolor='black',
                      markersize=4.5, markeredgewidth=0.9, clip_on=False, zorder=3)


def name_scenes(axes, points):
    """Name the scenes beside their 30 Hz markers; scenes at one place share a line."""
    groups = {}
    for name, at in points.items():
        x, y = at[0]
        groups.setdefault((round(x, 1), round(y, 1)), []).append((x, y, name))
    height = -0.04
    for _, members in sorted(groups.items(), key=lambda item: item[1][0][1]):
        x, y, _ = members[0]
        height = max(y, height + 0.12)
        names = ', '.join(name.split('_')[0] if name[0] == 'v' else name
                          for _, _, name in members)
        axes.annotate(names, (x, y), (0.75, height), fontsize=7.5, va='center',
                      arrowprops={'arrowstyle': '-', 'linewidth': 0.5, 'shrinkB': 2.0,
                                  'relpos': (0.0, 0.5)})


def draw_loop(axes):
    """Draw how the drag of a plain game loop makes a small heave grow, predicted and measured."""
    axes.axhspan(1.0, 2.1, color=SHAKES, alpha=0.45, linewidth=0.0)
    axes.axhspan(0.0, 1.0, color=CALM, linewidth=0.0)
    axes.axvline(1.0, color='black', linewidth=0.8, linestyle=':')
    drags, tried = np.linspace(0.0, 3.0, 601), np.arange(0.1, 3.01, 0.2)
    for angle, (colour, label, place, side) in LOOPS.items():
        axes.plot(drags, predicted_loop_growth(angle, drags), color=colour, linewidth=1.8)
        axes.plot(tried, [loop_growth(angle, drag) for drag in tried], 'o', color=colour,
                  markersize=3.5)
        axes.text(*place, label, color=colour, fontsize=8.5, ha=side, va='center')
    axes.text(1.06, 1.88, 'drag·dt above 1:\nevery spring grows', fontsize=8.5, va='center')
    axes.text(2.95, 0.1, 'dots: measured\nlines: predicted', fontsize=7.5, ha='right',
              va='center')
    axes.set(xlim=(0.0, 3.0), ylim=(0.0, 2.1), xlabel='drag·dt  (drag rate × step)',
             ylabel='growth of a heave per step')
    axes.set_title('velocity *= 1 - drag·dt', fontsize=10.5, fontweight='bold')
