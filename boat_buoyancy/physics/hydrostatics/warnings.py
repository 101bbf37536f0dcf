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

import numpy as np

from . import rest
from .metacentric_height import metacentric_heights
from .rest import NEGLIGIBLE
from .righting_arm import righting_arms, surface_righting_arms
from .stiffness import still_load
from ..boat.hull import LAWS
from ..boat.state import body_frame
from ..forces.probe_laws import wetting
from ..rotation import rotation_matrix, to_world

# Heels in degrees at which a model is held against the hull, and the part of the greatest righting
# arm by which it has to be off to be told of.
HEELS, TOLD = np.arange(0.0, 181.0, 5.0), 0.05
# A rest this many degrees from any of the hull's own is a wrong one.
WRONG_REST = 10.0
# A list or trim in degrees below which nobody sees one.
LEAST_LIST = 0.5


def flotation_warnings(boat):
    """Return what a user should know of a `Boat` at rest in still water: a tuple of sentences."""
    if not rest.floats(boat):
        return (_sinking(boat),)
    if rest.rest_attitude(boat) is None:
        return ('The boat finds no rest: put into the water level it turns, and goes on turning; '
                'lower boat.center_of_mass, or spread the probes wider.',)
    sentences = [*_overturning(boat), *_listing(boat)]
    if boat.hull.panels is None:
        sentences += _filled(boat)
    return tuple(sentences)


def _filled(boat):
    """Yield a sentence for probes that are full or dry where the boat rests."""
    level, settled = (_shares(boat, state) for state in (
        rest.floating_state(boat), rest.rest_state(boat)))
    carries, probes = boat.hull.max_force > 0.0, boat.hull.surface is None
    # Of a shape some columns may well be under water, or its sides dry, as it lies level.
    full = carries & (settled >= 1.0 - NEGLIGIBLE) & (probes | (level < 1.0 - NEGLIGIBLE))
    left = carries & (settled <= 0.0) & (level > 0.0) & probes
    if not (carries & (settled > 0.0) & (settled < 1.0 - NEGLIGIBLE)).any():
        yield ('No probe is at the waterline at rest: each is either full or dry, so nothing '
               'holds the boat at its height; put some higher or lower (probes.positions), or '
               'have them fill over a greater depth (lower probes.stiffness).')
    if full.any():
        raised = ('raise its weight in probes.weights, raise probes.floatiness' if probes
                  else 'make the hull deeper or wider')
        yield (f'A probe is full at rest ({_named(boat, full)}): it gives all it can and neither '
               'trims nor rights the boat any further, so the boat may list or capsize; '
               f'{raised}, or move boat.center_of_mass away from it.')
    if left.any():
        yield (f'A probe is out of the water at rest ({_named(boat, left)}): it lifts nothing '
               'until it dips in; lower its weight in probes.weights, or move '
               'boat.center_of_mass towards it.')


def parting_warnings(boat, heeled=180.0):
    """
    Return a sentence, in a tuple, where the righting arms of columns leave those of the hull.

    For a `Boat` that heels up to ``heeled`` degrees; nothing where that is not far enough.
    """
    if boat.hull.surface is None or boat.hull.panels is not None or not rest.floats(boat):
        return ()
    arms, exact = (find(boat, np.radians(HEELS))
                   for find in (righting_arms, surface_righting_arms))
    if np.isnan([arms, exact]).any():
        return ()
    off = np.abs(arms - exact)
    parted = np.flatnonzero(off > TOLD * np.abs(exact).max())
    if not len(parted) or HEELS[parted[0]] > heeled:
        return ()
    worst, kind = np.argmax(off), 'columns' if boat.hull.law == 'column' else 'probes'
    # A boat rests where arms turn from upsetting to righting.
    rests, true = (HEELS[:-1][(found[:-1] < 0.0) & (found[1:] > 0.0)] for found in (arms, exact))
    wrong = [place for place in rests if (np.abs(place - true) > WRONG_REST).all()]
    lies = (f', and would let it rest between {wrong[0]:.0f} and {wrong[0] + HEELS[1]:.0f} '
            'degrees, where the hull does not' if wrong else '')
    return (f'From {HEELS[parted[0]]:.0f} degrees of heel on the {kind} do not follow the hull: '
            f'their righting arm is up to {off[worst]:.3f} m off (at {HEELS[worst]:.0f} degrees '
            f'{arms[worst]:.3f} m in place of {exact[worst] + 0.0:.3f} m){lies}; for a boat that '
            'heels so far take hull.model: panels.',)


def dry_thruster_warnings(boat, thrusters):
    """Return a sentence for each `Thruster` that is out of still water at rest, in a tuple."""
    if not thrusters or not rest.floats(boat):
        return ()
    state = rest.rest_state(boat)
    origin, R = body_frame(boat, state)[0][2], rotation_matrix(state.orientation)
    heights = {thruster.name: origin + to_world(R, thruster.position)[2]
               for thruster in thrusters}
    return tuple(
        f'The thruster {name} is {height:.3g} m above the water at rest, where it gives nothing; '
        'lower its z in thrusters.positions, that of the propeller.'
        for name, height in heights.items() if height >= 0.0)


def _sinking(boat):
    """Return the sentence for a boat without a draft."""
    cure = ('raise probes.floatiness above 1' if boat.hull.surface is None
            else 'make the hull larger, or lower boat.mass')
    if boat.floatiness >= 1.0 - rest.LIFT_TOLERANCE:
        return ('The boat neither floats nor sinks: its floatiness is 1, so it has no draft, '
                f'starts just under water and stays at whatever depth it is put; {cure}.')
    return (f'The boat sinks: its floatiness is {boat.floatiness:.6g}, the part of its weight '
            'that it lifts with all of the hull under water, so it starts just under water and '
            f'goes down from there; {cure}.')


def _overturning(boat):
    """Yield a sentence for each axis about which nothing rights the boat."""
    round_off = NEGLIGIBLE * boat.size
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


def _listing(boat):
    """Yield a sentence for a boat that does not lie level."""
    roll, pitch = (np.degrees(rest.rest_attitude(boat)).round(2) + 0.0).tolist()
    if max(abs(roll), abs(pitch)) < LEAST_LIST:
        return
    torque = still_load(boat, rest.floating_state(boat))[0].torque
    places = [f'{abs(arm):.3g} m {word if arm > 0 else opposite}'
              for arm, word, opposite in (
                  (-torque[1] / boat.weight, 'ahead', 'aft'),
                  (torque[0] / boat.weight, 'to port', 'to starboard'))
              if abs(arm) > NEGLIGIBLE * boat.size]
    turned = 'turns over and rests' if rest.turns_over(boat) else 'rests'
    sides = ' and '.join(side for side, angle in (
        ('starboard' if roll > 0.0 else 'port', roll), ('bow' if pitch > 0.0 else 'stern', pitch))
        if angle)
    # Where the centre of mass would have to be, level above the lift; no cure for an axis mixed up.
    place = boat.center_of_mass + [-torque[1] / boat.weight, torque[0] / boat.weight, 0.0]
    there = f'boat.center_of_mass: [{", ".join(f"{round(c, 4) + 0.0:.5g}" for c in place)}]'
    weights = ', or change probes.weights' if boat.hull.surface is None else ''
    cure = ('is its centre of mass right?' if rest.turns_over(boat) else
            f'to level it, give {there}{weights}')
    yield (f'The boat does not lie level: held level, its lift acts {" and ".join(places)} of its '
           f'centre of mass, so the boat {turned} at roll {roll:g} and pitch {pitch:g} degrees '
           f'({sides} down); {cure}{"" if cure.endswith("?") else "."}')


def _shares(boat, state):
    """Return each probe's share (n,) of its maximum force at a `State` in still water."""
    depths, upright = still_load(boat, state)[1], rotation_matrix(state.orientation)[2][2]
    law = LAWS.index(boat.hull.law)
    return np.array([wetting(law, height, depth, upright)[1]
                     for height, depth in zip(boat.hull.height, depths)])


def _named(boat, chosen):
    """Return the first of the probes chosen, by number and place, and how many more."""
    first, *others = np.flatnonzero(chosen).tolist()
    place = ', '.join(f'{c:.4g}' for c in boat.hull.positions[first])
    return f'probe {first} at {place} m{f", and {len(others)} more" if others else ""}'
