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

"""Settings that a parameter file can have, what a step of each costs, and which are accepted."""

from dataclasses import dataclass
import math
import re

from .accuracy import step_seconds
from ...physics.boat.hull import PANELS_A_WAVE
from ...physics.scene.scene import scene_from_values

# For study only, never the best: euler is not among them.
INTEGRATORS = ('leapfrog', 'rk4', 'implicit', 'symplectic_euler')
# Of second order and more: their error levels off, with the step, at that of the model.
CONVERGING = ('leapfrog', 'rk4')
# Steps per simulated second, about a factor of the square root of 2 apart.
RATES = (1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0, 11.0, 16.0, 22.0, 32.0, 45.0, 64.0, 90.0, 128.0,
         180.0, 256.0, 360.0, 512.0, 720.0, 1024.0, 1440.0, 2048.0)
# Columns along and across a hull of a given shape; probes for the depths and damping of panels.
COLUMNS = ((2, 2), (3, 2), (4, 2), (4, 4), (6, 4), (8, 8))
PANEL_PROBES = ((2, 2), (4, 2), (6, 4), (8, 8))
# Panels in waves as fine as `hull.panel_size: 0` makes them, and this many times finer.
FINER = (2, 4)
# The plain game loop is named only where it saves more than the noise of the clock: it has
# nothing else for it.
GAME_LOOP, NOISE = 'symplectic_euler', 1.15
# What a scene is without that moves a hull in waves; damping is then derived again.
BARE = {'added_mass': [0.0] * 6, 'wave_force': 'hydrostatic', 'damping.linear': [0.0] * 6}


@dataclass(frozen=True)
class Setting:
    """
    An integrator, its steps per second ``rate`` and, for a hull of a shape, the model of it.

    ``probes`` along and across, None = those of the scene; ``panel_size`` m, 0 = chosen by the
    sea, None = columns; ``bare`` leaves out the added mass, damping.linear and wave force that
    the scene has.
    """

    integrator: str
    rate: float
    probes: tuple | None = None
    panel_size: float | None = None
    bare: bool = False

    @property
    def choice(self):
        """Return (probes, panel_size, bare), one of `choices`."""
        return self.probes, self.panel_size, self.bare

    @property
    def probe_count(self):
        """Return how many probes, 0 for those the scene has."""
        return 0 if self.probes is None else self.probes[0] * self.probes[1]

    @property
    def model(self):
        """Return 'columns' or 'panels', None for a scene of given probes."""
        if self.probes is None:
            return None
        return 'columns' if self.panel_size is None else 'panels'

    def values(self):
        """Return the parameters as {name: value}."""
        return {'integrator': self.integrator, 'rate': self.rate, 'substeps': 1,
                **hull_values(*self.choice)}

    def lines(self):
        """Return the lines of a parameter file, groups nested as the shipped files have them."""
        lines, group = [], None
        for name, value in self.values().items():
            above, _, last = name.rpartition('.')
            if above and above != group:
                lines.append(f'{above}:')
            group = above
            lines.append(f'{"  " if above else ""}{last}: {value}')
        return lines

    def __str__(self):
        """Return it in a few words."""
        return ', '.join(filter(None, (f'{self.integrator} {self.rate:g} Hz', self.hull,
                                       'no added mass or wave force' if self.bare else '')))

    @property
    def hull(self):
        """Return the model of the hull in a few words, none for a scene of given probes."""
        if self.probes is None:
            return ''
        grid = '{}x{}'.format(*self.probes)
        if self.panel_size is None:
            return f'{grid} columns'
        return f'panels{f" of {self.panel_size:g} m" if self.panel_size else ""}, {grid} probes'


def has_hull(given):
    """Return True when the boat has the shape of a hull, so that its model can be chosen."""
    return 'probes.positions' not in given


def hull_values(probes, panel_size=None, bare=False):
    """Return the parameters of a model of the hull, as of `Setting`: {name: value}."""
    values = dict(BARE) if bare else {}
    if probes is None:
        return values
    values.update({'hull.model': 'columns', 'hull.probes': list(probes)})
    if panel_size is not None:
        values.update({'hull.model': 'panels', 'hull.panel_size': panel_size})
    return values


def surface_values(probes, panel_size):
    """Return the parameters that make panels stand for the hull as it is."""
    return {**hull_values(probes, panel_size), 'probes.law': 'column'}


def choices(given):
    """
    Return (probes, panel_size, bare) of all models to choose from, as of `Setting`, its own too.

    A scene of given probes keeps them.  What a scene in waves has of added mass and wave force
    is there to leave out.
    """
    found = {own_model(given)}
    if has_hull(given):
        (own, *_), = found
        found |= {(probes, None) for probes in (*COLUMNS, own)}
        found |= {(probes, size) for probes in (*PANEL_PROBES, own) for size in panel_sizes(given)}
    found = sorted(found, key=lambda model: (model[1] is not None, model[1] or 0.0,
                                             math.prod(model[0] or ()), model[0]))
    scene = scene_from_values(given)
    moved = scene.boat.follows_waves or scene.boat.added_mass.any()
    return tuple((*model, bare) for bare in (
        (True, False) if moved and not scene.sea.is_flat else (False,)) for model in found)


def own_model(given):
    """Return (probes, panel_size) of a scene as it stands, as of `Setting`."""
    if not has_hull(given):
        return None, None
    values = scene_from_values(given).values
    panels = values['hull.model'] == 'panels'
    return tuple(values['hull.probes']), values['hull.panel_size'] if panels else None


def panel_sizes(given):
    """Return the sizes of panels in m to choose from; finer ones only where waves ask for them."""
    scene = scene_from_values(given)
    fine = scene.sea.shortest_length / PANELS_A_WAVE
    return (0.0, *(float(f'{fine / finer:.3g}') for finer in FINER
                   if fine / finer < scene.boat.hull.surface.longest_edge))


def step_costs(stretch, integrators=INTEGRATORS, repeats=5):
    """Return {(one of `choices`, integrator): CPU s of one step}, measured here and now."""
    return step_seconds({model: stretch.run(hull_values(*model))
                         for model in choices(stretch.given)}, integrators, repeats=repeats)


def candidates(seconds, rates=RATES):
    """
    Return all settings as (cpu s per simulated s, `Setting`), cheapest first as of `counted`.

    ``seconds`` as from `step_costs`, fewest probes first.
    """
    found, cheapest = [], {}
    # More probes never cost less; where it looks so, the clock was disturbed.
    for ((probes, *model), integrator), second in reversed(seconds.items()):
        key = integrator, *model
        cheapest[key] = min(cheapest.get(key, math.inf), second)
        found += [(rate * cheapest[key], Setting(integrator, rate, probes, *model))
                  for rate in rates]
    return sorted(found, key=lambda pair: (counted(*pair), pair[1].probe_count))


def counted(cpu, setting):
    """Return the cost by which settings are ordered: the game loop's with the clock's noise."""
    return cpu * NOISE if setting.integrator == GAME_LOOP else cpu


def acceptance(given):
    """
    Return a function of a `Setting`: True when a scene with it starts without a warning.

    Or without one more than it has with a fine step and the hull's own surface, figures apart:
    those are of the boat or the sea, and no setting helps.
    """
    # A size of panels that columns have no use for speaks against nothing.
    given = {name: value for name, value in given.items() if name != 'hull.panel_size'}
    fine = {'integrator': 'leapfrog', 'rate': RATES[-1], 'substeps': 0}
    if has_hull(given):
        fine.update(surface_values(COLUMNS[-1], 0.0))
    known = _warnings({**given, **fine})

    def accepts(setting):
        try:
            return _warnings({**given, **setting.values()}) <= known
        except ValueError:
            return False
    return accepts


def _warnings(values):
    """Return the sentences that a scene is started with, without their figures."""
    return {re.sub(r'[-+.\d]+(e[-+]?\d+)?', '#', sentence)
            for sentence in scene_from_values(values).simulation().warnings}
