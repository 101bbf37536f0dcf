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

"""What a user should know of a boat at rest: what is wrong, what is seen, what to do."""

# A module of a package shadows nothing.
# flake8: noqa: A005

import math

import numpy as np

from . import rest
from .metacentric_height import metacentric_heights
from .natural_modes import equilibrium_stiffness, RESTORED
from ..boat.hull import LAWS
from ..boat.state import body_frame, State
from ..forces.probe_laws import wetting
from ..rotation import from_roll_pitch_yaw, rotation_matrix

# Lengths below this part of the boat's size are round-off and no list or lever.
NEGLIGIBLE = 1e-9
# Beyond this angle in rad the attitude that the stiffness at rest leads to says little.
FAR = math.radians(30.0)


def flotation_warnings(boat):
    """Return what a user should know of a `Boat` at rest in still water: a tuple of sentences."""
    if not rest.floats(boat):
        return (_sinking(boat),)
    level = rest.rest_state(boat)
    torque = rest.level_torque(boat)
    tilt = _tilt(boat, torque)
    wet = _wetness(boat, level, np.zeros(3))
    settled = wet if tilt is None else _wetness(boat, level, tilt)
    carries = boat.hull.max_force > 0.0
    full = carries & (np.maximum(wet, settled) >= 1.0 - NEGLIGIBLE)
    left = carries & (settled <= 0.0) & (wet > 0.0)
    sentences = [*_overturning(boat), *_listing(boat, torque, tilt, (full | left).any())]
    if not (carries & (wet > 0.0) & (wet < 1.0 - NEGLIGIBLE)).any():
        sentences.append(
            'No probe is at the waterline at rest: each is either full or dry, so nothing holds '
            'the boat at its height; give the probes other heights (probes.positions) or make '
            'them fill more slowly (lower probes.stiffness).')
    if full.any():
        sentences.append(
            f'A probe is full at rest ({_named(boat, full)}): it gives all it can and neither '
            'trims nor rights the boat any further, so the boat may list or capsize; raise its '
            'weight in probes.weights, raise probes.floatiness (a hull: enlarge hull.size), or '
            'move boat.center_of_mass away from it.')
    if left.any():
        sentences.append(
            f'A probe is out of the water at rest ({_named(boat, left)}): it holds nothing until '
            'it dips in; lower its weight in probes.weights (a hull: make hull.size smaller), or '
            'move boat.center_of_mass towards it.')
    return tuple(sentences)


def dry_thruster_warnings(boat, thrusters):
    """Return a sentence for each `Thruster` that is out of still water at rest, in a tuple."""
    if not thrusters or not rest.floats(boat):
        return ()
    origin = body_frame(boat, rest.rest_state(boat))[0][2]
    heights = {thruster.name: origin + thruster.position[2] for thruster in thrusters}
    return tuple(
        f'The thruster {name} is {height:.3g} m above the water at rest, where it gives nothing; '
        'lower its z in thrusters.positions, that of the propeller.'
        for name, height in heights.items() if height >= 0.0)


def _sinking(boat):
    """Return the sentence for a boat without a draft."""
    cure = 'raise probes.floatiness above 1 (a hull: enlarge hull.size), or lower boat.mass'
    if boat.floatiness >= 1.0 - rest.LIFT_TOLERANCE:
        return ('The boat neither floats nor sinks: its floatiness is 1, so it has no draft, '
                'starts with every probe full and stays wherever it is put under water; '
                f'{cure}.')
    return (f'The boat sinks: its floatiness is {boat.floatiness:.6g}, the part of its weight '
            'that all its probes lift when full, so it starts with every probe full and goes '
            f'down from there; {cure}.')


def _overturning(boat):
    """Yield a sentence for each axis about which nothing rights the boat."""
    round_off = NEGLIGIBLE * _size(boat)
    for height, name, motion, cure in zip(
            metacentric_heights(boat), ('transverse', 'longitudinal'), ('roll', 'pitch'),
            ('wider', 'longer')):
        if height < -round_off:
            yield (f'The boat cannot float upright: its {name} metacentric height is '
                   f'{height:.4g} m and has to be above 0, so at the least push it will {motion} '
                   f'over; lower boat.center_of_mass by more than {-height:.4g} m or make the '
                   f'boat {cure}.')
        elif height <= round_off:
            yield (f'Nothing rights the boat in {motion}: its {name} metacentric height is 0 m '
                   f'and has to be above 0, so it keeps any {motion} angle that it gets; lower '
                   f'boat.center_of_mass or make the boat {cure}.')


def _listing(boat, torque, tilt, uncertain):
    """
    Yield a sentence for a boat whose lift does not act through its centre of mass.

    ``torque`` (2,) N m level and at rest; ``tilt`` as from `_tilt`; ``uncertain`` when a probe
    leaves its range on the way there.
    """
    port, ahead = torque[0] / boat.weight, -torque[1] / boat.weight
    round_off = NEGLIGIBLE * _size(boat)
    if max(abs(ahead), abs(port)) <= round_off:
        return
    places = [f'{abs(arm):.3g} m {word if arm > 0 else opposite}'
              for arm, word, opposite in ((ahead, 'ahead', 'aft'), (port, 'to port',
                                                                    'to starboard'))
              if abs(arm) > round_off]
    if tilt is None or np.abs(tilt[1:]).max() > FAR:
        seen = 'it starts level, turns far away from that and may capsize'
    else:
        roll, pitch = np.degrees(tilt[1:]).round(2) + 0.0
        attitude = f'roll {roll:g} and pitch {pitch:g} degrees (positive pitch is bow down)'
        seen = f'it starts level and settles near {attitude}'
        if uncertain:
            seen = (f'it starts level and leans towards {attitude}, where a probe is full or '
                    'dry: it may go on and capsize')
    yield (f'Level is not an equilibrium: the lift acts {" and ".join(places)} of the centre of '
           f'mass, so {seen}; move boat.center_of_mass there or change probes.weights.')


def _tilt(boat, torque):
    """
    Return the heave m, roll and pitch rad (3,) at which the stiffness balances a level boat.

    ``torque`` (2,) N m level and at rest.  None when the boat does not stand at level against a
    small push.
    """
    stiffness = equilibrium_stiffness(boat)[RESTORED, RESTORED]
    scale = np.array([1.0, _size(boat), _size(boat)])
    values = np.linalg.eigvalsh(stiffness / np.outer(scale, scale))
    if values[0] <= NEGLIGIBLE * values[-1]:
        return None
    return np.linalg.solve(stiffness, [0.0, *torque])


def _wetness(boat, level, tilt):
    """Return each probe's share (n,) of its maximum force, tilted by heave m, roll, pitch rad."""
    heave, roll, pitch = tilt
    state = State(level.position + [0.0, 0.0, heave],
                  np.stack(from_roll_pitch_yaw(roll, pitch, 0.0)))
    depths, upright = rest.still_load(boat, state)[1], rotation_matrix(state.orientation)[2][2]
    law = LAWS.index(boat.hull.law)
    return np.array([wetting(law, height, depth, upright)[1]
                     for height, depth in zip(boat.hull.height, depths)])


def _named(boat, chosen):
    """Return the first of the probes chosen, by number and place, and how many more."""
    first, *others = np.flatnonzero(chosen).tolist()
    place = ', '.join(f'{c:.4g}' for c in boat.hull.positions[first])
    return f'probe {first} at {place} m{f", and {len(others)} more" if others else ""}'


def _size(boat):
    """Return a length of the boat in m, to tell round-off from lengths."""
    return float(np.max(np.linalg.norm(boat.probe_offsets, axis=1) + boat.hull.height))
