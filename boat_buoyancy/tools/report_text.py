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

"""The report as a person reads it."""

import math
import textwrap

from ..physics.hydrostatics.natural_modes import MODES
from ..physics.hydrostatics.rest import turns_over
from ..physics.hydrostatics.righting_arm import stability_range

TABLE_COLUMNS = 10
# An angle in degrees, and a distance in m, that is shown as 0.
UNSEEN_ANGLE, UNSEEN_ARM = 0.05, 5e-4


def text(source, scene, result):
    """
    Return a report as lines for a person.

    ``source`` is the name of the `Scene`'s file; ``result``, the figures of `report`.
    """
    return '\n'.join([
        f'{source}: {scene.boat.mass:.6g} kg, {_model(scene)}', '',
        *_at_rest(result), '', *_motions(scene.boat, result), '', *_handling(result),
        *_sea(result), '',
        *_steps(result, scene), '', *_righting(scene.boat, result), '', *_warnings(result)])


def _model(scene):
    """Return what the hull is, and what lifts it."""
    hull, shape = scene.boat.hull, scene.values.get('hull.shape')
    depths = (f'; depths at {_counted(len(hull.positions), "probe")}'
              if hull.panels is not None else '')
    law = '' if hull.panels is not None or hull.law == 'column' and shape else f', law {hull.law}'
    return f'{f"{shape} on " if shape else ""}{hull.carriers}{depths}{law}'


def _at_rest(result):
    probes = result['displaced_volume_m3'] is None
    rows = [
        ('draft', 'draft_m', 'm',
         f'depth of the {"deepest probe" if probes else "lowest point of the hull"}'),
        ('floatiness', 'floatiness', '', 'greatest lift over weight; floats above 1'),
        ('displacement', 'displacement_kg', 'kg', 'mass of the water that the hull displaces'),
        ('volume', 'displaced_volume_m3', 'm3', 'of that water'),
        ('wetted surface', 'wetted_surface_m2', 'm2', 'area of the hull under water'),
        ('GM transverse', 'gm_transverse_m', 'm',
         'metacentric height; above 0 the boat rights itself in roll'),
        ('GM longitudinal', 'gm_longitudinal_m', 'm', 'the same in pitch')]
    if result['rest_roll_deg'] is None:
        yield 'No rest in still water'
    else:
        unstable = min(result['gm_transverse_m'], result['gm_longitudinal_m']) < 0.0
        yield (f'At rest in still water: {attitude(result)}'
               + (', until the least push turns it over' if unstable else ''))
    for name, key, unit, meaning in rows:
        if not (probes and key in ('displaced_volume_m3', 'wetted_surface_m2')):
            yield f'  {name:<16} {_number(result[key], 6):>10} {unit:<3} {meaning}'


def attitude(result):
    """Return list and trim at rest in words."""
    roll, pitch = result['rest_roll_deg'], result['rest_pitch_deg']
    if max(abs(roll), abs(pitch)) < UNSEEN_ANGLE:
        return 'level'
    trim = f'{abs(pitch):.1f} degrees by the {"bow" if pitch > 0.0 else "stern"}'
    return (f'list {_heel(roll) if abs(roll) >= UNSEEN_ANGLE else "none"}, '
            f'trim {trim if abs(pitch) >= UNSEEN_ANGLE else "none"}')


def _motions(boat, result):
    added = boat.added_mass.any()
    yield ('Small motions about rest    period s   damping ratio (1 = no overshoot)'
           + ('   period s without added mass' if added else ''))
    for name in MODES:
        period, ratio = result[f'{name}_period_s'], result[f'{name}_damping_ratio']
        bare = result[f'{name}_period_without_added_mass_s']
        yield (f'  {name:<23} {_number(period, 5):>10}   {_number(ratio, 3):>10}'
               + (f'{_number(bare, 5):>33}' if added else ''))
    if not added:
        yield ('  Without the mass of water that moves along (added_mass): real hulls are slower, '
               'by up to 1.9;')
        yield '  buoyancy_hydrodynamics prints it.'


def _handling(result):
    found = result['handling']
    if found is None:
        return
    yield 'Handling in still water'
    speed, torque = found['speed_ahead_m_per_s'], found['turning_torque_n_m']
    time, needed = found['time_to_turn_90_deg_s'], found['push_for_1_m_per_s_n']
    yield (f'  speed ahead      {_speed(speed):>10} m/s pushed by {found["push_n"]:.4g} N; '
           f'{needed:.4g} N hold 1 m/s')
    steady = found['steady_course_up_to_m_per_s']
    if steady is not None:
        yield f'  steady course    {steady:>10.3g} m/s at most; faster it has to be steered'
    if time is not None:
        yield f'  turn of 90 deg   {time:>10.3g} s   from rest, by {torque:.4g} N m'
    yield ''


def _speed(speed):
    return 'no limit' if speed is None else f'{speed:.3g}'


def _sea(result):
    sea = result['sea']
    if sea is None:
        yield 'Sea: flat water'
        return
    ends = [f'{sea[f"{name}_wave_m"]:.3g} m ({sea[f"{name}_wave_s"]:.3g} s)'
            for name in ('shortest', 'longest')]
    yield (f'Sea: significant height {sea["significant_height_m"]:.3g} m, steepness '
           f'{_ratio(sea["steepness"])}; the waves that matter are '
           f'{" to ".join(dict.fromkeys(ends))} long')
    met = ' and '.join(f'{name} ({result[f"{name}_period_s"]:.3g} s)' for name in sea['meets'])
    yield (f'  They meet the natural period of {met}: expect large motions.' if met
           else '  No natural period meets them.')


def _steps(result, scene):
    yield (f'Steps: {scene.rate:g} Hz with {scene.plan().integrator}, '
           f'{_counted(result["substeps"], "substep")} in each period')
    plain = result['step'] != 'compiled'
    yield f'  the step is {result["step"]}{", some fifty times slower" if plain else ""}'
    yield '  largest stable step for this boat:'
    for name, limit in result['max_stable_step_s'].items():
        said = {None: 'no limit', 0.0: 'never stable'}.get(limit) or f'{limit:.4g} s'
        yield f'    {name:<18} {said}'


def _righting(boat, result):
    heel, arms, exact = result['gz_heel_deg'], result['gz_m'], result['gz_exact_m']
    yield 'Righting arm GZ in m over heel to starboard in degrees (above 0 rights the boat)'
    if None in arms:
        yield '  none: the boat sinks'
        return
    rows = [('GZ', arms)]
    if exact is not None and boat.hull.panels is None:
        rows.append(('hull', exact))
    for start in range(0, len(heel), TABLE_COLUMNS):
        cut = slice(start, start + TABLE_COLUMNS)
        yield '  heel ' + ' '.join(f'{angle:7.0f}' for angle in heel[cut])
        for name, values in rows:
            yield f'  {name:<5}' + ' '.join(f'{round(a, 3) + 0.0:7.3f}' for a in values[cut])
    for sentence in (stability(boat, result), *_exactness(boat, result)):
        yield _filled(sentence, '  ', '  ')


def stability(boat, result):
    """Return how far a boat comes back to its rest, and how strongly, as a sentence."""
    rest = result['rest_roll_deg']
    if rest is None:
        return 'The boat finds no rest.'
    if turns_over(boat):
        return 'From level the boat turns over: see the warnings.'
    port, starboard = map(math.degrees, stability_range(boat))
    upright = abs(rest) < UNSEEN_ANGLE
    if min(rest - port, starboard - rest) == 0.0:
        return f'Nothing rights the boat from {"upright" if upright else "its list"}.'
    back = 'rights the boat' if upright else 'brings the boat back to its list'
    arm, at = max((arm, at) for at, arm in zip(result['gz_heel_deg'], result['gz_m'])
                  if rest <= at <= starboard)
    said = f'Greatest {arm:.3f} m at {at:.0f} degrees; {back}'
    if starboard - port > 359.0:
        return f'{said} from any heel.'
    if upright and abs(port + starboard) < 0.5:
        return f'{said} up to {starboard:.0f} degrees.'
    return f'{said} from {_heel(port, 0)} up to {_heel(starboard, 0)}.'


def _exactness(boat, result):
    """Yield sentences on how near the righting arm is to that of the hull itself."""
    exact_to, error = result['gz_exact_to_deg'], result['model_error']
    if boat.hull.panels is not None:
        yield "Exactly that of the hull's surface, at any heel."
        return
    if exact_to:
        yield (f'Up to {exact_to:.1f} degrees, where an edge dips or rises, '
               'exactly that of the real box.')
    if error is not None:
        off = ', '.join(
            f'{name} {"0" if abs(error[key]) < UNSEEN_ARM else format(error[key], "+.3f")} m'
            for name, key in (('draft', 'draft_m'), ('GM transverse', 'gm_transverse_m'),
                              ('longitudinal', 'gm_longitudinal_m')))
        yield (f'Off the hull itself: {off}; GZ {error["gz_rms_to_30_deg_m"]:.3f} m (rms) to 30 '
               f'degrees, at most {error["gz_greatest_m"]:.3f} m, at '
               f'{error["gz_greatest_at_deg"]:.0f} degrees.')


def _warnings(result):
    if not result['warnings']:
        return ['No warnings.']
    return ['Warnings', *(_filled(sentence, '  - ', '    ') for sentence in result['warnings'])]


def _filled(sentence, first, rest):
    """Return a sentence in lines of at most 99 columns, each with its indent."""
    return textwrap.fill(sentence, 99, initial_indent=first, subsequent_indent=rest,
                         break_on_hyphens=False)


def _heel(degrees, digits=1):
    """Return an angle of heel in words."""
    return f'{abs(degrees):.{digits}f} degrees to {"starboard" if degrees > 0.0 else "port"}'


def _ratio(value):
    """Return a part of 1 as sailors say it, 1/23."""
    return f'1/{1.0 / value:{".0f" if value < 0.1 else ".2g"}}'


def _counted(count, noun):
    return f'{count} {noun}{"" if count == 1 else "s"}'


def _number(value, digits):
    return '-' if value is None else f'{value:.{digits}g}'
