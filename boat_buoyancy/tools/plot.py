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

"""The plot of a run: heave, roll, pitch and the depths of the probes over time."""

import numpy as np

ENDINGS = ('.png', '.pdf', '.svg')
# Okabe and Ito's colours, told apart by colour-blind eyes too; the pale yellow is left out.
COLOURS = ('#0072B2', '#D55E00', '#009E73', '#CC79A7', '#56B4E9', '#E69F00', '#000000')
WATER, BOAT, ROLL, PITCH = '#56B4E9', '#000000', '#D55E00', '#0072B2'
# A boat at rest is a line in the middle, not round-off over the full height.
LEAST_HEIGHT, LEAST_ANGLE = 0.1, 2.0
# With more probes than colours the lines are drawn alike: their spread is what can be read.


def write(path, run, simulation):
    """
    Draw the `Trajectory` ``run`` of a simulation into a file.

    Its ending, one of ENDINGS, says which kind.
    """
    from matplotlib.figure import Figure
    figure = Figure(figsize=(9.0, 7.5), layout='constrained')
    heave, tilt, depth = figure.subplots(3, 1, sharex=True)
    draw_heave(heave, run)
    draw_tilt(tilt, run)
    draw_depths(depth, run)
    for axes in (heave, tilt, depth):
        axes.grid(True, color='0.9', linewidth=0.8)
        axes.set_axisbelow(True)
        axes.spines[['top', 'right']].set_visible(False)
        axes.margins(x=0.0)
        axes.legend(loc='center left', bbox_to_anchor=(1.01, 0.5), frameon=False)
    depth.set_xlabel('time (s)')
    figure.suptitle(f'{simulation.boat.mass:g} kg, {simulation.integrator} at '
                    f'{simulation.rate:g} Hz', fontsize='medium')
    figure.align_ylabels()
    figure.savefig(path, dpi=100)


def draw_heave(axes, run):
    """Draw the height of the body origin over the water under it."""
    time, height, surface = run.time, run.position[:, 2], run.elevation
    low, high = padded(np.concatenate([height, surface]), LEAST_HEIGHT)
    axes.fill_between(time, surface, low, color=WATER, alpha=0.25, linewidth=0.0)
    axes.plot(time, surface, color=WATER, linewidth=1.5, label='water surface\nat the boat')
    axes.plot(time, height, color=BOAT, linewidth=1.5, label='body origin')
    axes.set_ylim(low, high)
    axes.set_ylabel('height (m)')


def draw_tilt(axes, run):
    """Draw roll and pitch in degrees."""
    roll, pitch, _ = np.degrees(run.roll_pitch_yaw).T
    axes.plot(run.time, roll, color=ROLL, linewidth=1.5, label='roll\n(+ starboard down)')
    axes.plot(run.time, pitch, color=PITCH, linewidth=1.5, linestyle='--',
              label='pitch\n(+ bow down)')
    axes.set_ylim(*padded(np.concatenate([roll, pitch]), LEAST_ANGLE))
    axes.set_ylabel('angle (deg)')


def draw_depths(axes, run):
    """Draw how deep every probe is under the surface, downwards."""
    time, depths = run.time, run.probe_depths
    low, high = padded(np.append(depths, 0.0), LEAST_HEIGHT)
    axes.axhspan(0.0, high, color=WATER, alpha=0.25, linewidth=0.0)
    axes.axhline(0.0, color=WATER, linewidth=1.5, label='water surface')
    count = depths.shape[1]
    if count <= len(COLOURS):
        for i, colour in enumerate(COLOURS[:count]):
            axes.plot(time, depths[:, i], color=colour, linewidth=1.2, label=f'probe {i}')
    else:
        axes.fill_between(time, depths.min(axis=1), depths.max(axis=1), color='0.4', alpha=0.4,
                          linewidth=0.0, label=f'all {count} probes')
        axes.plot(time, depths.mean(axis=1), color=BOAT, linewidth=1.5, label='their mean')
    # Downwards: a probe that goes down in the water goes down in the plot.
    axes.set_ylim(high, low)
    axes.set_ylabel('probe depth (m)\nunder water')


def padded(values, least):
    """Return the range of values, at least ``least`` wide, with some room around it."""
    low, high = float(values.min()), float(values.max())
    span = max(high - low, least)
    middle = (low + high) / 2
    return middle - 0.56 * span, middle + 0.56 * span
