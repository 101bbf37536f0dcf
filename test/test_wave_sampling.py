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

"""Waves that pass between probes or panels are told of, and what is advised is right."""

import re

from boat_buoyancy.physics import load_scene
from boat_buoyancy.physics.boat.records import hull_view, readable
from boat_buoyancy.physics.forces.load import load_at
from boat_buoyancy.physics.hydrostatics.rest import rest_state
import numpy as np
import pytest


BARGE = {'boat.mass': 184500.0, 'boat.center_of_mass': [0.0, 0.0, 0.3],
         'hull.size': [20.0, 6.0, 3.0]}
# Along the barge: 3.51 m long, by w^2 = g k.
PERIOD, LENGTH = 1.5, 20.0
WAVENUMBER = (2 * np.pi / PERIOD) ** 2 / 9.81
SHORT = {'sea.waves': [0.01, PERIOD, 0.0, 0.0]}
TOLD = 'are too '


def told(values):
    """Return the sentences on sampling of a scene."""
    return [sentence for sentence in load_scene(values).warnings if TOLD in sentence]


def lift(values):
    """Return by how much a scene's wave lifts its boat at rest, over what its amplitude would."""
    scene = load_scene(values)
    boat, sea, rest = scene.boat, scene.sea, rest_state(scene.boat)
    load = load_at(boat.plain_records[0], hull_view(boat, plain=True), readable(sea.record),
                   sea.table.tolist(), rest.position.tolist(), rest.orientation.tolist(), 0.0)
    length, beam, _ = values['hull.size']
    return load.force[2] / (boat.hull.specific_weight * length * beam * sea.waves[0, 0])


def smith(length, wavenumber):
    """Return the part of its amplitude by which a wave lifts a length: the mean of cos(k x)."""
    return np.sin(0.5 * wavenumber * length) / (0.5 * wavenumber * length)


def test_a_barge_too_coarse_for_short_waves_is_told_by_how_much_and_what_would_do():
    given = {**BARGE, **SHORT, 'hull.probes': [8, 4]}
    off = abs(lift(given) - smith(LENGTH, WAVENUMBER))
    assert off > 0.4
    sentence, = told(given)
    assert 'the shortest wave that matters is 3.51 m long' in sentence
    said = float(re.search(r'off by up to (\d+)%', sentence)[1])
    assert said == pytest.approx(100 * off, abs=1)
    probes = [int(count) for count in re.search(
        r'take hull.probes: \[(\d+), (\d+)\]', sentence).groups()]
    for advised in ({}, {'hull.model': 'panels'}):
        advised['hull.probes'] = probes
        assert told({**given, **advised}) == []
        assert lift({**given, **advised}) == pytest.approx(
            smith(LENGTH, WAVENUMBER), abs=0.05)


def heave(values):
    """Return the amplitude of a boat's heave over that of the wave it meets, once settled."""
    run = load_scene({**values, 'start.position': [0.0, 0.0]}).simulation().run(60.0)
    late = run.time > 30.0
    phase = 2 * np.pi / PERIOD * run.time[late]
    basis = np.column_stack([np.cos(phase), np.sin(phase), np.ones_like(phase)])
    fit = np.linalg.lstsq(basis, run.position[late, 2], rcond=None)[0]
    return np.hypot(*fit[:2]) / 0.01


def test_a_boat_on_the_probes_that_are_advised_hardly_heaves_in_short_waves():
    # 0.028 of the amplitude by a boundary element method; what the lift of a wave that is 0.18 of
    # the length long would do by itself is below 0.05.
    coarse = {**BARGE, **SHORT, 'hull.probes': [8, 4]}
    assert heave(coarse) > 0.3
    for model in ('columns', 'panels'):
        assert heave({**coarse, 'hull.model': model, 'hull.probes': [11, 4]}) < 0.05
    # By themselves panels are no cure: damping at the probes is carried along by the water.
    assert heave({**coarse, 'hull.model': 'panels'}) > 0.2
    sentence, = told({**coarse, 'hull.model': 'panels'})
    assert 'the pull at the probes (damping.probe)' in sentence
    assert 'take hull.probes: [11, 4], or damping.probe: 0.0' in sentence


@pytest.mark.plain
def test_a_panel_size_that_is_not_reached_is_told_of():
    sentence, = (sentence for sentence in load_scene(
        {'hull.model': 'panels', 'hull.panel_size': 0.001}).warnings)
    assert sentence.startswith('hull.panel_size is 0.001 m, and the panels have edges of up to 0.')


@pytest.mark.plain
def test_advice_holds_at_any_heading_and_is_no_lucky_number():
    # Six columns in a row are right in this sea from ahead, by chance.
    lucky = {**BARGE, **SHORT, 'hull.probes': [6, 4]}
    assert abs(lift(lucky) - smith(LENGTH, WAVENUMBER)) < 0.05
    assert len(told(lucky)) == 1
    advised = {**BARGE, 'hull.probes': [11, 4]}
    for heading in np.linspace(0.0, np.pi / 2, 19):
        k = WAVENUMBER * np.array([np.cos(heading), np.sin(heading)])
        exact = np.prod([smith(size, part) if part else 1.0 for size, part in zip((20.0, 6.0), k)])
        found = lift({**advised, 'sea.waves': [0.01, PERIOD, float(heading), 0.0]})
        assert found == pytest.approx(exact, abs=0.05)
    assert told({**advised, **SHORT}) == []


@pytest.mark.plain
def test_an_irregular_sea_is_followed_by_what_is_advised():
    given = {**BARGE, 'sea.sea_state': 3}
    sentence, = told(given)
    along, across = (int(count) for count in re.search(
        r'take hull.probes: \[(\d+), (\d+)\]', sentence).groups())
    assert told({**given, 'hull.probes': [along, across]}) == []
    # What is told of is twice what is aimed at, so a half of them is too few.
    assert len(told({**given, 'hull.probes': [along // 2, across]})) == 1


@pytest.mark.parametrize('values', [
    {}, {'sea.waves': [0.0, 1.0, 0.0, 0.0]}, {'sea.waves': [0.1, 8.0, 0.0, 0.0]},
    {**SHORT, 'hull.probes': [12, 6]}, {**SHORT, 'hull.model': 'panels', 'damping.probe': 0.0},
    {**SHORT, 'hull.model': 'panels', 'hull.probes': [12, 6], 'hull.panel_size': 0.4}])
@pytest.mark.plain
def test_what_is_fine_enough_is_told_nothing(values):
    assert told({**BARGE, **values}) == []


@pytest.mark.plain
def test_each_hull_of_a_twin_is_looked_at_by_its_own_beam():
    twin = {'boat.mass': 2000.0, 'hull.shape': 'twin', 'hull.size': [5.0, 0.6, 1.0],
            'hull.spacing': 4.0, 'hull.probes': [6, 1], 'sea.waves': [0.05, 1.6, 0.0, 0.0]}
    assert told(twin) == []
    # One column cannot stand for 2 m of beam in waves of 4 m.
    sentence, = told({**twin, 'hull.size': [5.0, 2.0, 1.0], 'boat.mass': 6000.0})
    assert re.search(r'take hull.probes: \[6, [23]\]', sentence)


@pytest.mark.plain
@pytest.mark.parametrize('size', [3.0, 0.5])
def test_panels_too_large_for_the_waves_are_told_of_and_the_size_advised_will_do(size):
    given = {**BARGE, **SHORT, 'hull.model': 'panels', 'hull.panel_size': size,
             'damping.probe': 0.0}
    sentence, = told(given)
    advised = float(re.search(r'take hull.panel_size: (\S+) or less', sentence)[1])
    # An eighth of 3.513 m.
    assert 0.42 < advised <= 3.513 / 8
    assert told({**given, 'hull.panel_size': advised}) == []


@pytest.mark.plain
def test_panels_whose_facets_are_fine_by_themselves_are_told_nothing_whatever_their_size():
    fine = {'hull.size': [0.4, 0.2, 0.2], 'boat.mass': 8.0, 'hull.model': 'panels',
            'sea.waves': [0.01, 2.0, 0.0, 0.0]}
    assert told({**fine, 'hull.panel_size': 10.0}) == []


@pytest.mark.plain
@pytest.mark.parametrize('size', [0.0, 0.01])
def test_waves_that_no_panels_can_follow_are_told_of(size):
    sentence, = told({**BARGE, 'hull.model': 'panels', 'hull.panel_size': size,
                      'sea.waves': [0.005, 0.5, 0.0, 0.0]})
    assert sentence.startswith('The panels are too large') and 'take longer waves' in sentence
    assert 'hull.panel_size:' not in sentence


@pytest.mark.plain
def test_waves_that_no_probes_can_follow_get_no_number_of_probes():
    sentence, = told({**BARGE, 'sea.waves': [0.001, 0.3, 0.0, 0.0]})
    assert 'take longer waves or a smaller hull' in sentence


@pytest.mark.plain
@pytest.mark.parametrize('apart, fine', [(1.7, True), (1.8, False)])
def test_probes_given_one_by_one_want_a_neighbour_within_half_a_wave(apart, fine):
    # Half of 3.513 m is 1.756 m.
    positions = [c for x in range(4) for y in (0, 1) for c in (x * apart, y * apart, 0.0)]
    sentences = told({'probes.positions': positions, 'boat.center_of_mass': [
        1.5 * apart, 0.5 * apart, 0.0], **SHORT})
    assert len(sentences) == (0 if fine else 1)
    assert fine or 'neighbours are up to 1.8 m apart' in sentences[0]


@pytest.mark.plain
def test_a_single_probe_has_no_neighbour():
    assert told({'probes.positions': [0.0, 0.0, 0.0], **SHORT}) == []


@pytest.mark.plain
def test_added_mass_alone_is_warned_of_in_waves_and_nothing_else_is():
    waves = {'sea.waves': [0.1, 4.0, 0.0, 0.0]}
    added = {'added_mass': [200.0, 600.0, 2000.0, 300.0, 1500.0, 800.0]}
    follows = {'wave_force': 'froude_krylov'}
    for given, said in ((added, False), ({**added, **waves}, True), ({**follows, **waves}, False),
                        ({**added, **follows, **waves}, False)):
        warnings = ' '.join(load_scene(given).warnings)
        assert ('give wave_force: froude_krylov' in warnings) == said


@pytest.mark.plain
def test_waves_that_do_not_reach_down_to_a_hull_need_no_probes():
    # 1.5 s waves of 3.5 m on a barge of 20 m that is 1.5 m deep: e^-kd is 0.07.
    barge = {'hull.size': [20.0, 6.0, 3.0], 'boat.mass': 184500.0, 'hull.probes': [6, 3],
             'sea.waves': [0.3, 6.0, 0.0, 0.0, 0.1, 1.5, 0.0, 0.0]}
    assert any('too far apart' in line for line in load_scene(barge).warnings)
    deep = load_scene({**barge, 'wave_force': 'froude_krylov'})
    assert not any('too far apart' in line for line in deep.warnings)


@pytest.mark.plain
def test_waves_that_do_not_reach_a_hull_at_all_are_not_warned_of():
    for rows in ([1e-4, 0.01, 0.0, 0.0], [0.05, 1.0, 0.0, 0.0]):
        scene = load_scene({'hull.size': [20.0, 6.0, 3.0], 'boat.mass': 184500.0,
                            'wave_force': 'froude_krylov', 'sea.waves': rows})
        assert not any('too far apart' in line for line in scene.warnings)
