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

"""The plot of a run: heave, roll, pitch, speed, heading and the depths of the probes over time."""

import numpy as np

ENDINGS = ('.png', '.pdf', '.svg')
WATER, BOAT, ROLL, PITCH = '#56B4E9', '#000000', '#D55E00', '#0072B2'
AHEAD, TO_PORT, HEADING = '#009E73', '#CC79A7', '#000000'
# Okabe and Ito's colours, told apart by colour-blind eyes too, but for the pale yellow and what
# is the water's.
COLOURS = ('#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#000000')
# A boat at rest is a line in the middle, not round-off over the full height.
LEAST_HEIGHT, LEAST_ANGLE, LEAST_SPEED = 0.1, 2.0, 0.1
# Pixels that time has across the picture, and how many swings are still told apart there.
COLUMNS, MOST_SWINGS = 600, 150
# With more probes than colours the lines are drawn alike: their spread is what can be read.


def write(path, run, title):
    """
    Draw the `Trajectory` ``run`` into a file, under a title.

    Its ending, one of ENDINGS, says which kind.
    """
    from matplotlib.figure import Figure
    figure = Figure(figsize=(9.0, 10.5), layout='constrained')
    panels = figure.subplots(5, 1, sharex=True)
    for axes, draw in zip(panels, (draw_heave, draw_tilt, draw_speed, draw_heading, draw_depths)):
        draw(axes, run)
        axes.grid(True, color='0.9', linewidth=0.8)
        axes.set_axisbelow(True)
        axes.spines[['top', 'right']].set_visible(False)
        axes.set_xlim(run.time[[0, -1]])
        axes.legend(loc='center left', bbox_to_anchor=(1.01, 0.5), frameon=False)
    axes.set_xlabel('time (s)')
    figure.suptitle(title, fontsize='medium')
    figure.align_ylabels()
    figure.savefig(path, dpi=100)


def draw_line(axes, time, values, **style):
    """
    Draw values over time: a line, or where its swings would run into each other, their band.

    The band goes from the least to the greatest value of each column of pixels; where a column
    is less than two swings, of two swings, or its edges would follow each of them.
    """
    swings = swings_of(values)
    if swings <= MOST_SWINGS:
        axes.plot(time, values, **style)
        return
    begins = np.linspace(0, len(time), min(COLUMNS, swings // 2), endpoint=False).astype(int)
    low, high = np.minimum.reduceat(values, begins), np.maximum.reduceat(values, begins)
    middle = (time[begins] + time[np.append(begins[1:], len(time)) - 1]) / 2
    middle[[0, -1]] = time[[0, -1]]
    axes.fill_between(middle, low, high, color=style['color'], alpha=0.35, linewidth=0.0)
    for edge, label in ((low, style['label']), (high, None)):
        axes.plot(middle, edge, color=style['color'], linewidth=0.8, label=label)


def swings_of(values):
    """Return how often values swing about their mean."""
    above = values > values.mean()
    return np.count_nonzero(above[1:] != above[:-1]) // 2


def draw_heave(axes, run):
    """Draw the height of the body origin over the water under it."""
    time, height, surface = run.time, run.position[:, 2], run.elevation
    low, high = padded(np.concatenate([height, surface]), LEAST_HEIGHT)
    if swings_of(surface) <= MOST_SWINGS:
        axes.fill_between(time, surface, low, color=WATER, alpha=0.25, linewidth=0.0)
    draw_line(axes, time, surface, color=WATER, linewidth=1.5, label='water surface\nat the boat')
    draw_line(axes, time, height, color=BOAT, linewidth=1.5, label='body origin')
    axes.set_ylim(low, high)
    axes.set_ylabel('height (m)')


def draw_tilt(axes, run):
    """Draw roll and pitch in degrees."""
    roll, pitch, _ = np.degrees(run.roll_pitch_yaw).T
    draw_line(axes, run.time, roll, color=ROLL, linewidth=1.5, label='roll\n(+ starboard down)')
    draw_line(axes, run.time, pitch, color=PITCH, linewidth=1.5, linestyle='--',
              label='pitch\n(+ bow down)')
    axes.set_ylim(*padded(np.concatenate([roll, pitch]), LEAST_ANGLE))
    axes.set_ylabel('angle (deg)')


def draw_speed(axes, run):
    """Draw the speed ahead and to port, of the body origin in body axes."""
    ahead, to_port, _ = run.body_velocity.T
    draw_line(axes, run.time, ahead, color=AHEAD, linewidth=1.5, label='ahead')
    draw_line(axes, run.time, to_port, color=TO_PORT, linewidth=1.5, linestyle='--',
              label='to port')
    axes.set_ylim(*padded(np.concatenate([ahead, to_port]), LEAST_SPEED))
    axes.set_ylabel('speed (m/s)')


def draw_heading(axes, run):
    """Draw the heading in degrees, without a jump where it has gone all the way round."""
    heading = np.degrees(np.unwrap(run.yaw))
    draw_line(axes, run.time, heading, color=HEADING, linewidth=1.5,
              label='heading\n(from x, + to port)')
    axes.set_ylim(*padded(heading, LEAST_ANGLE))
    axes.set_ylabel('heading (deg)')


def draw_depths(axes, run):
    """Draw how deep every probe is under the surface, downwards."""
    time, depths = run.time, run.probe_depths
    low, high = padded(np.append(depths, 0.0), LEAST_HEIGHT)
    axes.axhspan(0.0, high, color=WATER, alpha=0.25, linewidth=0.0)
    axes.axhline(0.0, color=WATER, linewidth=1.5, label='water surface')
    count = depths.shape[1]
    if count <= len(COLOURS):
        for i, colour in enumerate(COLOURS[:count]):
            draw_line(axes, time, depths[:, i], color=colour, linewidth=1.2, label=f'probe {i}')
    else:
        axes.fill_between(time, depths.min(axis=1), depths.max(axis=1), color='0.4', alpha=0.4,
                          linewidth=0.0, label=f'all {count} probes')
        draw_line(axes, time, depths.mean(axis=1), color=BOAT, linewidth=1.5, label='their mean')
    # Downwards: a probe that goes down in the water goes down in the plot.
    axes.set_ylim(high, low)
    axes.set_ylabel('probe depth (m)\nunder water')


def padded(values, least):
    """Return the range of values, at least ``least`` wide, with some room around it."""
    low, high = float(values.min()), float(values.max())
    span = max(high - low, least)
    middle = (low + high) / 2
    return middle - 0.56 * span, middle + 0.56 * span
