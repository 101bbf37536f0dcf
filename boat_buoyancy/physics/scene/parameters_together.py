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

"""Parameters that are right one by one and wrong together, or surely not meant so."""

import numpy as np

from . import parameters
from .wave_sampling import sampling_warnings
from ..checks import shown
from ..hydrostatics.warnings import dry_thruster_warnings, parting_warnings
from ..sea.steepness import breaking_steepness, steepness, wave_steepness

# Somewhat more than 2 pi, so that 6.2832 is one.
FULL_TURN = 6.2833
# A start at a heel in degrees beyond this one is looked at.
HEELING = 10.0
AXES = ('surge', 'sway', 'heave', 'roll', 'pitch', 'yaw')
# A boat that 1 N a kg, a tenth of its weight, takes no faster than this in m/s hardly moves: the
# measured drag of the WAM-V lets it reach 0.81 m/s.
STUCK = 0.5
# The greatest significant steepness of a sea, that of short periods (DNV-RP-C205, 3.5).
STEEPEST_SEA = 1.0 / 10.0
PROBES_ONLY = ('probes.positions', 'probes.weights', 'probes.floatiness', 'probes.stiffness')
# The parameters that a shape of hull has no use for.
USELESS = {'box': ('hull.spacing', 'hull.mesh', 'hull.scale'), 'twin': ('hull.mesh', 'hull.scale'),
           'mesh': ('hull.size', 'hull.spacing', 'hull.bottom', 'hull.middle')}


def check_together(given, in_force):
    """
    Raise ValueError for parameters that are right alone and wrong together.

    ``given`` {name: value} and ``in_force``, every parameter, None where it is to be derived.
    """
    hull = [name for name in given if name.startswith('hull.')]
    probes = [name for name in PROBES_ONLY if name in given]
    if hull and probes:
        raise ValueError(f'hull and probes: expected one of them, got {hull[0]} and {probes[0]}')
    if probes and 'probes.positions' not in given:
        raise ValueError('probes.positions: expected x, y, z of every probe because '
                         f'{probes[0]} is given, got none')
    positions = given.get('probes.positions')
    if positions is not None and (not positions or len(positions) % 3):
        raise ValueError('probes.positions: expected x, y, z of every probe, at least one '
                         f'probe, got {len(positions)} numbers: {shown(list(positions))}')
    if positions and 'probes.weights' in given:
        weights, count = given['probes.weights'], len(positions) // 3
        if len(weights) != count:
            raise ValueError(f'probes.weights: expected {count} numbers, one for every probe, '
                             f'got {len(weights)}: {shown(list(weights))}')
    if 'hull.mesh' in given and 'hull.shape' not in given:
        raise ValueError('hull.shape: expected mesh because hull.mesh is given, got none')
    shape, spacing = in_force['hull.shape'], in_force['hull.spacing']
    if shape == 'mesh' and in_force['hull.mesh'] is None:
        raise ValueError('hull.mesh: expected the path of a file because hull.shape is mesh, got '
                         'none')
    if shape == 'twin' and (spacing is None or spacing < in_force['hull.size'][1]):
        raise ValueError('hull.spacing: expected at least the beam of a hull, '
                         f'{in_force["hull.size"][1]:g} m (hull.size), because hull.shape is '
                         f'twin, got {"none" if spacing is None else f"{spacing:g} m"}')
    body = in_force['frame_prefix'] + in_force['body_frame']
    for name, frame in (('body_frame', body), ('map_frame', in_force['map_frame'])):
        if frame == in_force['world_frame']:
            raise ValueError(f'{name}: expected another frame than world_frame, '
                             f'got {frame!r} for both')
    if in_force['map_frame'] == body:
        raise ValueError(f'map_frame: expected another frame than body_frame, got {body!r} for '
                         'both')


def without_use(in_force):
    """Return the names of the hull's parameters that its shape has no use for."""
    return USELESS[in_force['hull.shape']] if in_force['probes.positions'] is None else ()


def remarks(boat, sea, thrusters, given, in_force):
    """Return sentences about what was surely not meant, but for how the boat lies, in a tuple."""
    warnings = [*_drag_twice(boat), *_stuck(boat, given), *_half_in_waves(boat, sea),
                *_undamped(boat, given)]
    warnings += [f'{name} has no effect: {why}.' for name, why in _without_effect(in_force)
                 if name in given and given[name] != parameters.PARAMETERS[name].default]
    warnings += [f'{name} is {given[name]:g} Hz and rate is {in_force["rate"]:g} Hz: there is at '
                 f'most one message a period; raise rate, or lower {name}.'
                 for name in ('imu.rate', 'fix.rate') if given.get(name, 0.0) > in_force['rate']]
    asked = in_force['sea.components']
    if not sea.is_flat and not in_force['sea.waves'] and len(sea.waves) < asked:
        left_out = asked - len(sea.waves)
        warnings.append(
            f'sea.current stops {left_out} of the {asked} waves of the irregular sea, '
            f'{left_out / asked:.0%} of its energy: they are left out, and its significant height '
            f'is {sea.significant_height:.3g} m; give a weaker current, another sea.direction or '
            'a sea of longer waves to have them all.')
    for name, angles in (('sea.waves', sea.waves[:, 2]),
                         ('sea.direction', [in_force['sea.direction']]),
                         ('start.orientation', in_force['start.orientation'] or ())):
        largest = max(angles, key=abs, default=0.0)
        if name in given and abs(largest) > FULL_TURN:
            warnings.append(f'{name} has an angle of {largest:g}, more than a full turn: angles '
                            'are in radians, and this looks like degrees.')
    if boat.hull.surface is not None:
        low, high = boat.hull.surface.extent
        away = np.maximum(low - boat.center_of_mass, boat.center_of_mass - high).max()
        if away > (high - low).max():
            warnings.append(f'boat.center_of_mass is {away:.3g} m outside of the hull, which is '
                            f'{(high - low).max():.3g} m long: is it in metres, in the body '
                            'frame?')
    if 'start.orientation' in given:
        roll, pitch, _ = given['start.orientation']
        heel = np.degrees(np.arccos(np.cos(roll) * np.cos(pitch)))
        warnings += parting_warnings(boat, heel) if heel > HEELING else ()
    return (*warnings, *sea_warnings(sea), *sampling_warnings(boat, sea, in_force),
            *dry_thruster_warnings(boat, thrusters))


def _drag_twice(boat):
    """Yield a sentence for each damping on an axis that has drag of its own."""
    damping = boat.damping
    drag = {f'damping.{name}': getattr(damping, name) > 0.0 for name in ('linear', 'quadratic')}
    surge, sway, heave = damping.probe
    x, y, z = boat.hull.share @ boat.probe_offsets ** 2
    turning = surge * np.array([0.0, z, y]) + sway * np.array([z, 0.0, x]) + heave * np.array(
        [y, x, 0.0])
    kept = damping.rates[0] > 0.0
    for name, cure, brakes in (
            ('damping.linear_retention', '[1.0]', kept & (np.arange(6) < 3)),
            ('damping.angular_retention', '[1.0]', kept & (np.arange(6) >= 3)),
            ('damping.probe', '0.0', np.concatenate([damping.probe, turning]) > 0.0)):
        twice = brakes & np.any(list(drag.values()), axis=0)
        given = [source for source, axes in drag.items() if (twice & axes).any()]
        if given:
            axes = [axis for axis, counted in zip(AXES, twice) if counted]
            yield (f'Drag counts twice in {", ".join(axes)}: {" and ".join(given)} on top of '
                   f'{name}, so the boat will be slower than the vehicle it was measured on; '
                   f'leave {name} out, or set it to {cure}.')


def _stuck(boat, given):
    """Yield a sentence for probes that were given so much damping that they hold the boat."""
    surge, _, heave = boat.damping.probe
    if 'damping.probe' in given and boat.mass < STUCK * surge:
        yield ('damping.probe holds the boat back: pushed ahead by 1 N for each kg of its mass it '
               f'gets no faster than {boat.mass / surge:.2g} m/s; for a boat that glides give '
               'three numbers, of surge, sway and heave: damping.probe: '
               f'{[0.0, 0.0, float(heave)]}.')


def _undamped(boat, given):
    """Yield a sentence for motions that the damping that was given leaves without any."""
    damping = boat.damping
    if not (damping.linear.any() or damping.quadratic.any()) or damping.probe.any():
        return
    free = (damping.linear == 0.0) & (damping.quadratic == 0.0) & (damping.rates[0] == 0.0)
    ringing = [axis for axis, undamped in zip(AXES[2:5], free[2:5]) if undamped]
    if ringing and not {'damping.probe', 'damping.linear_retention',
                        'damping.angular_retention'} & set(given):
        yield (f'Nothing damps {", ".join(ringing)}: once drag is given it is all there is, so '
               'the boat will not stop bobbing and rolling; give damping.linear there as well '
               '(buoyancy_hydrodynamics prints it), or damping.probe.')


def _half_in_waves(boat, sea):
    """Yield a sentence for added mass without what in waves belongs to it."""
    if sea.ends is not None and boat.added_mass.any() and not boat.follows_waves:
        yield ('In waves added_mass alone moves a hull further from a real one than no added mass '
               'does, as two errors no longer cancel: give wave_force: froude_krylov and '
               'damping.linear as well (buoyancy_hydrodynamics prints all three).')


def sea_warnings(sea):
    """Return sentences on a `Sea` that no water could have, in a tuple."""
    each, whole = wave_steepness(sea), steepness(sea)
    breaking = breaking_steepness(sea)
    if (each > breaking).any():
        row = int(np.argmax(each / breaking))
        return (f'The waves are steeper than water can be: row {row + 1}, '
                f'{sea.waves[row].tolist()}, has a height of {each[row]:.2g} of its length, and '
                f'breaks above {breaking[row]:.2g}; give it a longer period or less amplitude.',)
    if np.count_nonzero(each) > 1 and whole > STEEPEST_SEA:
        return (f'The sea is steeper than any sea is: its significant height of '
                f'{sea.significant_height:.3g} m is {whole:.2g} of the length of its waves, and '
                f'{STEEPEST_SEA:.2g} is the most that is seen; give it longer periods or less '
                'height.',)
    return ()


def _without_effect(in_force):
    """Yield (name, why) of the parameters that nothing in the scene looks at."""
    for name in without_use(in_force):
        yield name, f'hull.shape is {in_force["hull.shape"]}'
    if in_force['hull.model'] != 'panels':
        yield 'hull.panel_size', 'hull.model is columns'
    if in_force['probes.positions'] is not None:
        yield ('water_density', 'probes.floatiness sets the lift of probes, and the density of '
               'water that of a hull shape')
    if not any(in_force['wind.drag']):
        yield 'wind.velocity', 'wind acts through wind.drag, which is all zeros'
    if not in_force['thrusters.names']:
        yield 'thrusters.lag', 'there is no thruster: give thrusters.names'
    if not in_force['sea.significant_height']:
        yield 'sea.peak_period', 'it goes with sea.significant_height, which is 0'
    if not in_force['sea.sea_state'] and not in_force['sea.significant_height']:
        for name in ('sea.direction', 'sea.spreading', 'sea.components', 'sea.seed'):
            yield name, ('it shapes an irregular sea, and there is none: give sea.sea_state or '
                         'sea.significant_height')
