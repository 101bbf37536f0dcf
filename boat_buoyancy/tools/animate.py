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

from ..physics import Sea
from ..physics.boat.cuts import components
from ..physics.rotation import rotation_matrix

ENDINGS = ('.gif',)
FRAME_MILLISECONDS = 80
# Longer runs are played faster instead: a picture for a README stays small.
MAX_FRAMES = 150
WATER, BEHIND, SURFACE, HULL, EDGE = '#9ecae1', '#e8f1f8', '#1f77b4', '#D55E00', '#5b2600'
WET, DRY = '#0072B2', '#ffffff'
LEVELS, GRID = 10, 60
# Width of the view from the side over that from above.
WIDER = 1.25


@dataclass(frozen=True)
class View:
    """
    What stays the same in every frame.

    ``shells``, corners (n, 3) m of each part of the hull, and ``probes`` (p, 3) m in the body
    frame; ``reach`` m of water shown to every side; ``low`` and ``high`` m, the heights shown;
    ``swing`` m, the highest wave; ``rows`` of the run to draw; ``pace``, simulated over shown
    time; ``sea``.
    """

    shells: list
    probes: np.ndarray
    reach: float
    low: float
    high: float
    swing: float
    rows: np.ndarray
    pace: float
    sea: Sea


def write(path, run, simulation):
    """Draw the `Trajectory` ``run`` of a simulation into a GIF file."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image
    view = view_of(run, simulation)
    figure = Figure(figsize=(7.2, 3.6), dpi=100, layout='constrained')
    canvas = FigureCanvasAgg(figure)
    side, above = figure.subplots(1, 2, width_ratios=[WIDER, 1.0])
    frames = []
    for row in view.rows:
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
        64, method=Image.Quantize.MAXCOVERAGE))
    frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    frames[0].save(path, save_all=True, append_images=frames[1:], loop=0, optimize=False,
                   duration=FRAME_MILLISECONDS)


def with_white(image):
    """Return a paletted image with its lightest colour made white, as the page around it is."""
    colours = np.reshape(image.getpalette(), (-1, 3))
    colours[np.argmax(colours.sum(axis=1))] = 255
    image.putpalette(colours.ravel().tolist())
    return image


def view_of(run, simulation):
    """Return the `View` that holds all of a run."""
    shells = hull_shells(simulation.boat)
    corners = np.concatenate(shells)
    size = max(np.linalg.norm(corners - corners.mean(axis=0), axis=1).max(), 0.2)
    step = max(FRAME_MILLISECONDS / 1000.0, run.time[-1] / MAX_FRAMES)
    moments = np.arange(0.0, run.time[-1] * (1.0 - 1e-9), step)
    swing = float(simulation.sea.waves[:, 0].sum())
    heights = run.position[:, 2]
    low = min(heights.min() - size, -swing - 0.5 * size)
    high = max(heights.max() + size, swing + 0.5 * size)
    # The views stand side by side, equally tall and to one scale.
    reach = max(2.2 * size, (high - low) * WIDER / 2)
    room = reach / WIDER - (high - low) / 2
    return View(shells, simulation.boat.hull.positions, reach, low - room, high + room,
                swing, np.round(moments * simulation.rate).astype(int),
                step / FRAME_MILLISECONDS * 1000.0, simulation.sea)


def hull_shells(boat):
    """Return the corners (n, 3) m in the body frame of each part whose outline is drawn."""
    surface = boat.hull.surface
    if surface is None:
        return [hull_corners(boat)]
    shell = components(surface.triangles)
    return [surface.corners[np.unique(surface.triangles[shell == number])]
            for number in range(shell.max() + 1)]


def hull_corners(boat):
    """
    Return points (n, 3) m in the body frame whose outline is drawn for a hull without a surface.

    The probes, columns put out to the corners of a box, and the same a probe's height further up.
    """
    bottom, height = boat.hull.positions, boat.hull.height[:, None]
    middle = bottom.mean(axis=0)
    if boat.hull.law == 'column':
        # Columns stand in the middle of what they carry: a uniform density of this radius of
        # gyration reaches sqrt(3) times as far.
        reach = np.sqrt(3.0 * boat.hull.share @ (bottom - middle)[:, :2]**2)
        signs = np.array([(1, 1), (1, -1), (-1, -1), (-1, 1)])
        bottom = np.column_stack([middle[:2] + signs * reach, np.full(4, bottom[:, 2].min())])
        height = np.full((4, 1), boat.hull.height.max())
    # Half the height of a single probe, or of probes in a row, makes a body of it.
    room = np.where(np.ptp(bottom, axis=0)[:2] < 1e-9, height.max() / 2, 0.0)
    bottom = np.concatenate([bottom + [a * room[0], b * room[1], 0.0]
                             for a in (-1, 1) for b in (-1, 1)])
    return np.concatenate([bottom, bottom + [0.0, 0.0, 1.0] * np.tile(height, (4, 1))])


def outline(points):
    """Return the convex outline of points (n, 2) in order (Andrew's monotone chain)."""
    ordered = sorted(set(map(tuple, points.tolist())))

    def chain(rest):
        line = []
        for x, y in rest:
            while len(line) > 1 and ((line[-1][0] - line[-2][0]) * (y - line[-2][1])
                                     <= (line[-1][1] - line[-2][1]) * (x - line[-2][0])):
                line.pop()
            line.append((x, y))
        return line[:-1]

    return np.array(chain(ordered) + chain(ordered[::-1]))


def placed(run, row, points):
    """Return body points (n, 3) in world axes at one row of a run."""
    turn = np.reshape(rotation_matrix(tuple(run.orientation[row])), (3, 3))
    return run.position[row] + points @ turn.T


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
    axes.set(xlim=(-view.reach, view.reach), ylim=(view.low, view.high), aspect='equal',
             facecolor=BEHIND, xlabel='ahead (m)', ylabel='height (m)')
    pace = f' ({view.pace:.1f} times as fast)' if view.pace > 1.01 else ''
    axes.set_title(f'from starboard, {run.time[row]:.1f} s{pace}', fontsize='medium')


def draw_above(axes, run, view, row):
    """Draw the boat on its water from above, crests light and troughs dark."""
    x, y, _ = run.position[row]
    across = np.linspace(-view.reach, view.reach, GRID)
    if view.swing > 0.0:
        east, north = np.meshgrid(x + across, y + across)
        height = view.sea.elevation(east, north, run.time[row])
        axes.contourf(east, north, height, cmap='Blues_r', alpha=0.9,
                      levels=np.linspace(-1.6 * view.swing, 1.2 * view.swing, LEVELS))
    track = run.position[:row + 1, :2]
    axes.plot(*track.T, color=EDGE, linewidth=1.2, linestyle=':')
    *shells, probes = (placed(run, row, points) for points in (*view.shells, view.probes))
    for corners, body in zip(shells, view.shells):
        axes.fill(*outline(corners[:, :2]).T, facecolor=HULL, edgecolor=EDGE, linewidth=1.5)
        axes.fill(*placed(run, row, bow_mark(body))[:, :2].T, color=EDGE)
    draw_probes(axes, probes[:, 0], probes[:, 1], run.probe_depths[row])
    axes.set(xlim=(x - view.reach, x + view.reach), ylim=(y - view.reach, y + view.reach),
             aspect='equal', facecolor=WATER, xlabel='x (m)', ylabel='y (m)')
    axes.set_title('from above', fontsize='medium')


def bow_mark(corners):
    """Return a triangle (3, 3) m on deck in the body frame that points ahead."""
    (back, right, _), (front, left, deck) = corners.min(axis=0), corners.max(axis=0)
    middle, length, width = (left + right) / 2, 0.22 * (front - back), 0.15 * (left - right)
    tip = front - 0.03 * (front - back)
    return np.array([(tip, middle, deck), (tip - length, middle + width, deck),
                     (tip - length, middle - width, deck)])


def draw_probes(axes, x, y, depths):
    """Draw probes: filled in the water, empty in the air."""
    colours = [WET if depth > 0.0 else DRY for depth in depths]
    axes.scatter(x, y, s=26, c=colours, edgecolors=EDGE, linewidths=1.0, zorder=5)
