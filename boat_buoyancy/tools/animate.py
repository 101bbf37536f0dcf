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

"""The animation of a run: the boat on its water, from the side and from above."""

from dataclasses import dataclass

import numpy as np

from .hull_outline import bow_mark, hull_shells, outline
from ..physics import Sea
from ..physics.rotation import rotation_matrix

ENDINGS = ('.gif',)
FRAME_MILLISECONDS = 80
# Longer runs are played faster instead: a picture for a README stays small.
MAX_FRAMES = 150
WATER, BEHIND, SURFACE, HULL, EDGE = '#9ecae1', '#e8f1f8', '#1f77b4', '#D55E00', '#5b2600'
WET, DRY, PUSH = '#0072B2', '#ffffff', '#000000'
LEVELS, GRID = 9, 60
# Width of a view over its height.
WIDER = 2.7
# As many sizes of the boat from above that the whole track may take: then the water stands still
# and the boat goes over it. A longer track is followed.
MOST_SIZES = 7.0
# Length of the arrow of the thrust, and the room for it about the boat, in sizes of the boat.
ARROW, ROOM = 1.5, 1.6


@dataclass(frozen=True)
class View:
    """
    What stays the same in every frame.

    ``shells``, corners (n, 3) m of each part of the hull, and ``probes`` (p, 3) m in the body
    frame; ``size`` m, half that of the hull; ``reach`` m of water shown to every side; ``low``
    and ``high`` m, the heights shown; ``extent`` m, the same as ``reach`` from above, and
    ``middle`` (2,) m in the world of what is shown there, or None to follow the boat; ``swing``
    m, the height of a high wave; ``shades`` of the water from trough to crest; ``push`` (3,) N,
    the thrust in body axes; ``rows`` of the run to draw; ``pace``, simulated over shown time;
    ``sea``.
    """

    shells: list
    probes: np.ndarray
    size: float
    reach: float
    low: float
    high: float
    extent: float
    middle: np.ndarray | None
    swing: float
    shades: np.ndarray
    push: np.ndarray
    rows: np.ndarray
    pace: float
    sea: Sea


def write(path, run, simulation, title, thrust, progress):
    """
    Draw the `Trajectory` ``run`` of a simulation into a GIF file.

    Main arguments: ``title``; ``thrust`` (6,), N and N m in body axes; ``progress`` takes a text
    for every frame.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image
    view = view_of(run, simulation, thrust)
    figure = Figure(figsize=(7.2, 6.6), dpi=100, layout='constrained')
    canvas = FigureCanvasAgg(figure)
    side, above = figure.subplots(2, 1)
    figure.suptitle(title, fontsize='medium')
    figure.legend(handles=legend_of(view), loc='outside lower center', ncols=3, frameon=False,
                  fontsize='small')
    frames = []
    for number, row in enumerate(view.rows):
        progress(f'drawing: frame {number + 1} of {len(view.rows)}')
        side.clear()
        above.clear()
        draw_side(side, run, view, row)
        draw_above(above, run, view, row)
        canvas.draw()
        # The layout of the first frame is kept, or the axes would jitter with their labels.
        figure.set_layout_engine('none')
        frames.append(Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3].copy()))
    # One palette for all frames: what does not move is not written again.
    palette = with_white(frames[len(frames) // 2].quantize(
        128, method=Image.Quantize.MAXCOVERAGE))
    frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    frames[0].save(path, save_all=True, append_images=frames[1:], loop=0, optimize=False,
                   duration=FRAME_MILLISECONDS)


def with_white(image):
    """Return a paletted image with its lightest colour made white, as the page around it is."""
    colours = np.reshape(image.getpalette(), (-1, 3))
    colours[np.argmax(colours.sum(axis=1))] = 255
    image.putpalette(colours.ravel().tolist())
    return image


def view_of(run, simulation, thrust=(0.0,) * 6):
    """Return the `View` that holds all of a run under a thrust (6,)."""
    from matplotlib import colormaps
    shells = hull_shells(simulation.boat)
    corners = np.concatenate(shells)
    size = max(np.linalg.norm(corners - corners.mean(axis=0), axis=1).max(), 0.2)
    step = max(FRAME_MILLISECONDS / 1000.0, run.time[-1] / MAX_FRAMES)
    moments = np.arange(0.0, run.time[-1] * (1.0 - 1e-9), step)
    rows = np.round(moments * simulation.rate).astype(int)
    amplitudes = simulation.sea.waves[:, 0]
    # Of many waves hardly ever all crests meet.
    swing = float(min(amplitudes.sum(), 2.5 * np.sqrt((amplitudes ** 2).sum() / 2)))
    heights = run.position[:, 2]
    low = min(heights.min() - 0.7 * size, -swing - 0.3 * size)
    high = max(heights.max() + 0.7 * size, swing + 0.3 * size)
    # The views stand one above the other, equally wide and high.
    reach = max(ROOM * size, (high - low) * WIDER / 2)
    room = reach / WIDER - (high - low) / 2
    west_south, east_north = run.position[:, :2].min(axis=0), run.position[:, :2].max(axis=0)
    track = ((east_north - west_south) / 2 + ROOM * size) * (1.0, WIDER)
    fits = track.max() <= MOST_SIZES * size
    return View(
        shells, simulation.boat.hull.positions, size, reach, low - room, high + room,
        max(track.max(), reach) if fits else ROOM * WIDER * size,
        (west_south + east_north) / 2 if fits else None, swing,
        colormaps['Blues_r'](np.linspace(0.3, 0.9, LEVELS + 1)), np.array(thrust[:3], float),
        rows, step / FRAME_MILLISECONDS * 1000.0, simulation.sea)


def legend_of(view):
    """Return the handles of the legend: what shades, dots and lines mean."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch
    dot = {'linestyle': '', 'marker': 'o', 'markersize': 5, 'markeredgecolor': EDGE}
    handles = [Line2D([], [], markerfacecolor=WET, label='probe in the water', **dot),
               Line2D([], [], markerfacecolor=DRY, label='probe in the air', **dot),
               Line2D([], [], color=EDGE, linewidth=2.0, linestyle=':', label='track')]
    if view.push.any():
        handles.append(Line2D([], [], color=PUSH, linestyle='', marker=r'$\rightarrow$',
                              markersize=12, label=f'thrust {np.linalg.norm(view.push):.4g} N'))
    if view.swing > 0.0:
        handles += [Patch(facecolor=shade, edgecolor='0.5', label=f'{name}, {height:+.2g} m')
                    for name, shade, height in (('crest', view.shades[-1], view.swing),
                                                ('trough', view.shades[0], -view.swing))]
    return handles


def placed(run, row, points):
    """Return body points (n, 3) in world axes at one row of a run."""
    return run.position[row] + turned(run, row, points)


def turned(run, row, vectors):
    """Return body vectors (..., 3) in world axes at one row of a run."""
    return vectors @ np.reshape(rotation_matrix(tuple(run.orientation[row])), (3, 3)).T


def draw_side(axes, run, view, row):
    """Draw a cut through the water along the heading, with the boat before it."""
    x, y, _ = run.position[row]
    yaw = run.yaw[row]
    ahead = np.array([np.cos(yaw), np.sin(yaw), 0.0])
    along = np.linspace(-view.reach, view.reach, 241)
    surface = view.sea.elevation(x + along * ahead[0], y + along * ahead[1], run.time[row])
    *shells, probes = (placed(run, row, points) - [x, y, 0.0]
                       for points in (*view.shells, view.probes))
    axes.fill_between(along, surface, view.low, color=WATER, linewidth=0.0)
    for corners in shells:
        line = outline(np.column_stack([corners @ ahead, corners[:, 2]]))
        axes.fill(*line.T, facecolor=HULL, edgecolor=EDGE, linewidth=1.5)
    # The water in front of the hull, seen through.
    axes.fill_between(along, surface, view.low, color=WATER, alpha=0.45, linewidth=0.0)
    axes.plot(along, surface, color=SURFACE, linewidth=1.5)
    draw_probes(axes, probes @ ahead, probes[:, 2], run.probe_depths[row])
    push = turned(run, row, view.push)
    draw_push(axes, view, (0.0, run.position[row, 2]), np.array([push @ ahead, push[2]]))
    axes.set(xlim=(-view.reach, view.reach), ylim=(view.low, view.high), aspect='equal',
             facecolor=BEHIND, xlabel='ahead (m)', ylabel='height (m)')
    pace = f' ({view.pace:.1f} times as fast)' if view.pace > 1.01 else ''
    axes.set_title(f'from starboard, {run.time[row]:.1f} s{pace}, '
                   f'{run.body_velocity[row, 0] + 0.0:.1f} m/s ahead', fontsize='medium')


def draw_above(axes, run, view, row):
    """Draw the boat on its water from above, crests light and troughs dark."""
    x, y = run.position[row, :2] if view.middle is None else view.middle
    wide, tall = view.extent, view.extent / WIDER
    if view.swing > 0.0:
        east, north = np.meshgrid(x + np.linspace(-wide, wide, GRID),
                                  y + np.linspace(-tall, tall, GRID))
        axes.contourf(east, north, view.sea.elevation(east, north, run.time[row]),
                      levels=np.linspace(-view.swing, view.swing, LEVELS), colors=view.shades,
                      extend='both')
    track = run.position[:row + 1, :2]
    axes.plot(*track.T, color=EDGE, linewidth=2.0, linestyle=':')
    *shells, probes = (placed(run, row, points) for points in (*view.shells, view.probes))
    for corners, body in zip(shells, view.shells):
        axes.fill(*outline(corners[:, :2]).T, facecolor=HULL, edgecolor=EDGE, linewidth=1.5)
        axes.fill(*placed(run, row, bow_mark(body))[:, :2].T, color=EDGE)
    draw_probes(axes, probes[:, 0], probes[:, 1], run.probe_depths[row])
    draw_push(axes, view, run.position[row, :2], turned(run, row, view.push)[:2])
    axes.set(xlim=(x - wide, x + wide), ylim=(y - tall, y + tall), aspect='equal',
             facecolor=WATER, xlabel='x (m)', ylabel='y (m)')
    # Of the world: where the view follows the boat, it is seen to go.
    axes.grid(True, color='0.5', linewidth=0.5, alpha=0.5)
    axes.set_title('from above', fontsize='medium')


def draw_probes(axes, x, y, depths):
    """Draw probes: filled in the water, empty in the air."""
    colours = [WET if depth > 0.0 else DRY for depth in depths]
    axes.scatter(x, y, s=26, c=colours, edgecolors=EDGE, linewidths=1.0, zorder=5)


def draw_push(axes, view, start, push):
    """Draw a thrust (2,) N as an arrow from ``start``, shorter the more it points at the eye."""
    if np.linalg.norm(push) > 0.1 * np.linalg.norm(view.push):
        end = start + ARROW * view.size * push / np.linalg.norm(view.push)
        axes.annotate('', end, start, annotation_clip=False, zorder=6, arrowprops={
            'arrowstyle': '-|>', 'color': PUSH, 'linewidth': 2.0, 'shrinkA': 0.0, 'shrinkB': 0.0})
