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

"""
A boat, a sea and a start put together from parameters that are right one by one.

``in_force`` is {name: value} of the parameters that a part is made of (`MADE_OF`), None where
one is to be derived.
"""

from dataclasses import replace
import math

import numpy as np

from .parameters import PARAMETERS, WAVE_KINDS
from ..boat.boat import Boat, Damping
from ..boat.hull import probe_hull
from ..boat.mesh import read_mesh
from ..boat.shapes import box_shaped, mesh_shaped
from ..boat.state import body_frame, center_of_mass_state
from ..checks import shown
from ..forces.thrusters import Thruster
from ..hydrostatics import rest
from ..hydrostatics.natural_modes import equilibrium_stiffness
from ..hydrostatics.stiffness import still_load
from ..rotation import from_roll_pitch_yaw
from ..sea import spectra
from ..sea.wave_rows import stopped
from ..sea.waves import Sea

# What the probes give a boat in surge, sway and heave when nothing is asked for, in parts of
# critical damping in heave: an overshoot of some third there, and so little along the water that
# in a period of heave a boat loses an eighth of its way, 1 - exp(-2 pi 2 0.01).
PROBE_DAMPING_RATIOS = (0.01, 0.01, 0.3)
# Retention that is left out.
RETENTION = {'damping.linear_retention': (0.95,), 'damping.angular_retention': (0.9,)}
# A single probe at the centre of mass has no spread to estimate an inertia from: a solid ball of
# this radius in m is the least it gets.
LEAST_BALL = 0.1
# Part of the energy of an irregular sea that a current may stop.
MOST_STOPPED = 0.5
# The direction and the limits in N of a thruster that is given none.
AHEAD, NO_LIMITS = (1.0, 0.0, 0.0), (-1e15, 1e15)
# The parameters that each part is made of; the start is made of the hull, too. What is given to
# the functions below is this and no more, so that a name that is missing here is seen at once.
_PREFIXES = {'hull': ('boat.', 'hull.', 'probes.', 'gravity', 'water_density', 'added_mass',
                      'wave_force'),
             'damping': ('damping.', 'wind.drag'), 'sea': ('sea.', 'wind.velocity', 'gravity'),
             'start': ('start.',)}
MADE_OF = {part: frozenset(name for name in PARAMETERS if name.startswith(prefixes))
           for part, prefixes in _PREFIXES.items()}


def assembled_boat(in_force, sea, like=None):
    """
    Return the `Boat` for a sea, with everything derived that was not given, and sentences.

    ``like``, a `Boat` that differs in its damping at most, spares working out how it lies.

    Inertia: that of a solid body of the hull's shape, or for probes mass times their mean square
    distance from the centre of mass.  Probe damping: that of `PROBE_DAMPING_RATIOS`, critical
    2 sqrt(K m), K at rest; none where drag is given.  The sentences are what is to be said of a
    mesh.
    """
    damping = Damping(**{name: in_force[f'damping.{name}'] for name in (
        'linear_retention', 'angular_retention', 'air_linear_retention',
        'air_angular_retention', 'linear', 'quadratic')}, wind=in_force['wind.drag'])
    boat, said = _undamped_boat(in_force, sea) if like is None else (like.on(sea), ())
    probe = in_force['damping.probe']
    if probe is None:
        root = 0.0 if gives_drag(in_force) else math.sqrt(
            _heave_stiffness(boat) * (boat.mass + boat.added_mass[2]))
        probe = [ratio * 2.0 * root for ratio in PROBE_DAMPING_RATIOS]
    return boat.with_damping(replace(damping, probe=probe)), said


def gives_drag(in_force):
    """Return True where drag is given that no other is to be made up beside."""
    return any(in_force['damping.linear']) or any(in_force['damping.quadratic'])


def _undamped_boat(in_force, sea):
    """Return the boat without its damping, and what is to be said of its mesh."""
    mass, gravity, said = in_force['boat.mass'], in_force['gravity'], ()
    center_of_mass = np.array(in_force['boat.center_of_mass'])
    if in_force['probes.positions'] is not None:
        hull = _probe_hull(in_force, mass * gravity)
        offsets = hull.positions - center_of_mass
        estimate = np.full(3, max(mass * np.mean(np.sum(offsets ** 2, axis=1)),
                                  0.4 * mass * LEAST_BALL ** 2))
    else:
        hull, said = _shaped(in_force, mass, gravity)
        estimate = mass * hull.surface.unit_inertia
        if in_force['hull.shape'] == 'box':
            length, beam, depth = np.square(in_force['hull.size'])
            estimate = mass / 12.0 * np.array([beam + depth, length + depth, length + beam])
        if in_force['hull.model'] == 'panels':
            hull = replace(hull, panel_size=in_force['hull.panel_size']).panelled(sea)
    inertia = in_force['boat.inertia']
    boat = Boat(mass, hull, estimate if inertia is None else inertia, gravity=gravity,
                center_of_mass=center_of_mass, added_mass=in_force['added_mass'])
    if in_force['wave_force'] == 'froude_krylov':
        depths = still_load(boat, rest.rest_state(boat))[1]
        boat = replace(boat, immersion=np.maximum(depths, 0.0))
    return boat, said


def _probe_hull(in_force, weight):
    """Return the hull of probes given one by one."""
    positions = np.reshape(in_force['probes.positions'], (-1, 3))
    weights = in_force['probes.weights']
    return probe_hull(
        positions, np.ones(len(positions)) if weights is None else weights, weight=weight,
        floatiness=in_force['probes.floatiness'], stiffness=in_force['probes.stiffness'],
        law=in_force['probes.law'] or 'spring')


def _shaped(in_force, mass, gravity):
    """Return the hull of a shape, and what is to be said of its mesh."""
    density, probes = in_force['water_density'], in_force['hull.probes']
    water = {'specific_weight': density * gravity, 'law': in_force['probes.law'] or 'column'}
    if in_force['hull.shape'] == 'mesh':
        surface, said = read_mesh(in_force['hull.mesh'], in_force['hull.scale'])
        return mesh_shaped(surface, probes, mass / density, **water), said
    size, bottom = in_force['hull.size'], in_force['hull.bottom']
    spacing = in_force['hull.spacing'] if in_force['hull.shape'] == 'twin' else None
    return box_shaped(size, -size[2] / 2 if bottom is None else bottom, probes, spacing=spacing,
                      middle=in_force['hull.middle'], **water), ()


def _heave_stiffness(boat):
    """Return the stiffness in N/m at rest, or at the surface for a boat that has no rest."""
    if rest.floats(boat):
        at_rest = equilibrium_stiffness(boat)[2, 2]
        if at_rest > 0.0:
            return float(at_rest)
    return float(boat.hull.stiffness.sum())


def assembled_sea(in_force):
    """Return the `Sea`."""
    return Sea(_waves(in_force), in_force['sea.current'], in_force['sea.depth'],
               in_force['gravity'], in_force['wind.velocity'])


def _waves(in_force):
    """Return the rows of waves of the one kind that is asked for."""
    rows, state = in_force['sea.waves'] or (), in_force['sea.sea_state']
    height, period = in_force['sea.significant_height'], in_force['sea.peak_period']
    asked = [names[0] for names in WAVE_KINDS if in_force[names[0]]]
    if len(asked) > 1:
        raise ValueError(f'sea: expected one kind of waves, got {" and ".join(asked)}')
    if height and not period:
        raise ValueError('sea.peak_period: expected a number above 0 because '
                         f'sea.significant_height is {height:g}, got 0; set the period first')
    if state:
        height, period = spectra.sea_state(state, in_force['gravity'])
    if not height:
        return rows
    rows = spectra.jonswap_waves(
        height, period, direction=in_force['sea.direction'],
        components=in_force['sea.components'], seed=in_force['sea.seed'],
        spreading=in_force['sea.spreading'])
    return _running(rows, in_force)


def _running(rows, in_force):
    """
    Return the rows of an irregular sea without those that cannot run against its current.

    That is what a current does to a sea that runs into it: the short waves break, the long ones
    get through.  Where less than half of the energy does, even the waves of the peak are stopped,
    and what is left is not the sea that was asked for.
    """
    current = in_force['sea.current']
    held = stopped(rows, current, in_force['sea.depth'], in_force['gravity'])
    if held.mean() > MOST_STOPPED:
        raise ValueError(
            f'sea.current: {list(current)} m/s stops {held.sum()} of the {len(rows)} waves of the '
            f'irregular sea, which have {held.mean():.0%} of its energy; expected a current that '
            f'stops at most {MOST_STOPPED:.0%}: give a weaker one, another sea.direction or a '
            'sea of longer waves')
    return rows[~held]


def assembled_start(boat, in_force):
    """Return the `State` of the centre of mass at the start, at its draft unless z is given."""
    x, y, *height = in_force['start.position']
    attitude = start_attitude(boat, in_force)
    if height:
        z, = height
    else:
        z = body_frame(boat, rest.floating_state(boat, *attitude, x, y))[0][2]
    return center_of_mass_state(boat, (x, y, z), np.array(from_roll_pitch_yaw(*attitude)),
                                in_force['start.velocity'], in_force['start.angular_velocity'])


def start_attitude(boat, in_force):
    """Return roll, pitch and yaw rad at the start: as given, or as the boat lies at rest."""
    given = in_force['start.orientation']
    return (*(rest.rest_attitude(boat) or (0.0, 0.0)), 0.0) if given is None else given


def assembled_thrusters(in_force):
    """Return the thrusters, a tuple of `Thruster`."""
    names = in_force['thrusters.names'] or ()
    rows = [_rows_of_thrusters(in_force, part, width, otherwise) for part, width, otherwise in (
        ('positions', 3, ()), ('directions', 3, AHEAD), ('limits', 2, NO_LIMITS))]
    return tuple(Thruster(name, place, direction, *limits, in_force['thrusters.lag'])
                 for name, place, direction, limits in zip(names, *rows))


def _rows_of_thrusters(in_force, part, width, otherwise):
    """Return a parameter of thrusters as rows, one for each; ``otherwise`` where left out."""
    count = len(in_force['thrusters.names'] or ())
    flat = in_force[f'thrusters.{part}'] or otherwise * count
    if flat and not count:
        raise ValueError(f'thrusters.{part}: expected thrusters.names, one for each thruster, got '
                         'none: give thrusters.names')
    if len(flat) != width * count:
        raise ValueError(f'thrusters.{part}: expected {width * count} numbers, {width} for each '
                         f'of thrusters.names, got {len(flat)}: {shown(list(flat))}')
    return zip(*[iter(flat)] * width)
