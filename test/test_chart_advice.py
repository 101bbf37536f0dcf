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

"""The advice of the chart: the setting it names holds on fresh runs, and a cheaper one fails."""

from dataclasses import replace
from pathlib import Path

from boat_buoyancy.physics.hydrostatics.rest import rest_state
from boat_buoyancy.physics.scene.scene import load_scene
from boat_buoyancy.tools.chart import advice, pareto_front, settings, trial as chart_trial
from boat_buoyancy.tools.chart.accuracy import measure
from boat_buoyancy.tools.chart.settings import Setting
from boat_buoyancy.tools.chart.stretch import stretches
from boat_buoyancy.tools.chart.trial import Result, Trial
import pytest
import yaml

CONFIG = Path(__file__).parents[1] / 'config'
# Four probes in an irregular sea; a box in regular waves shorter than twice its length; a box
# that falls into still water.
SCENES = {
    'irregular': ({'probes.positions': [1.2, 0.8, -0.3, 1.2, -0.8, -0.3, -1.2, 0.8, -0.3,
                                        -1.2, -0.8, -0.3],
                   'boat.mass': 900.0, 'probes.floatiness': 2.5, 'probes.stiffness': 1.5,
                   'sea.significant_height': 0.4, 'sea.peak_period': 3.0, 'sea.components': 8},
                  0.01),
    'regular': ({'sea.waves': [0.12, 2.2, 0.4, 0.0], 'damping.probe': 7610.4}, 0.012),
    'drop': ({'start.position': [0.0, 0.0, 1.5], 'start.orientation': [0.1, 0.05, 0.0]}, 0.02)}
# Two apart, so that neighbours differ by more than one stretch of sea from another.
RATES = tuple(2.0 ** power for power in range(11))
COSTS = {'leapfrog': 30e-6, 'implicit': 55e-6, 'symplectic_euler': 40e-6, 'rk4': 110e-6}


@pytest.fixture(autouse=True, scope='module')
def solved_once():
    """Solve the truth of every stretch once for all tests, on half as fine panels."""
    known, solve = {}, Trial.of

    def remembered(stretch):
        key = repr(stretch)
        if key not in known:
            known[key] = solve(stretch)
        return known[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Trial, 'of', staticmethod(remembered))
        patch.setattr(chart_trial, 'FINEST', 4)
        patch.setattr(settings, 'FINER', (2,))
        yield


def known_costs(stretch):
    """Return step costs that do not depend on what else the machine does."""
    panels = {None: 0.0, 0.0: 0.5}
    return {(model, name): cost * (1.0 + 0.05 * Setting(name, 1.0, *model).probe_count
                                   + panels.get(model[1], 10.0))
            for model in settings.choices(stretch.given) for name, cost in COSTS.items()}


def advise(given, tolerance):
    return advice.advise(given, tolerance, rates=RATES, step_costs=known_costs)


def fresh_trials(given):
    """Return trials that the advice has not seen: other seeds, times and starts."""
    _, other = stretches(given)
    if 'sea.significant_height' in given:
        return [Trial.of(replace(other, given={**given, 'sea.seed': seed})) for seed in (11, 12)]
    if 'sea.waves' in given:
        return [Trial.of(replace(other, clock=clock)) for clock in (500.3, 1000.9)]
    return [Trial.of(replace(other, scale=scale)) for scale in (0.95, 1.05)]


@pytest.fixture(scope='module', params=SCENES)
def case(request):
    """Return parameters, tolerance, the advice and fresh trials of one scene."""
    given, tolerance = SCENES[request.param]
    given = load_scene(given).given
    return given, tolerance, advise(given, tolerance), fresh_trials(given)


def test_advised_setting_meets_the_tolerance_on_fresh_runs(case):
    given, tolerance, found, trials = case
    assert found.limit == ''
    assert found.best.error <= tolerance
    assert found.best.checked <= tolerance
    for trial in trials:
        assert trial.error(found.best.setting) <= tolerance


def test_next_cheaper_setting_misses_the_tolerance_on_fresh_runs(case):
    given, tolerance, found, trials = case
    assert found.cheaper.cpu < found.best.cpu
    assert found.cheaper.error > tolerance
    for trial in trials:
        assert trial.error(found.cheaper.setting) > tolerance


def test_lines_take_the_place_of_those_of_a_shipped_file(tmp_path):
    setting = Setting('leapfrog', 8.0, (4, 2))
    lines = (CONFIG / 'barge.yaml').read_text().splitlines()
    for line in setting.lines():
        name = line.partition(':')[0].strip()
        places = [i for i, old in enumerate(lines) if old.strip().startswith(f'{name}:')]
        if name in ('integrator', 'rate', 'substeps'):
            assert not places
            lines.insert(lines.index('  ros__parameters:') + 1, f'    {line}')
        elif name == 'hull':
            assert len(places) == 1
        elif not places:
            assert name == 'model'
            lines.insert(lines.index('    hull:') + 1, f'    {line}')
        else:
            lines[places[0]] = f'    {line}'
    path = tmp_path / 'barge.yaml'
    path.write_text('\n'.join(lines) + '\n')
    simulation = load_scene(path).simulation()
    assert (simulation.rate, len(simulation.probe_depths)) == (8.0, 8)


def test_advised_lines_are_a_parameter_file_that_runs(case, tmp_path):
    given, tolerance, found, trials = case
    lines = found.best.setting.lines()
    assert all(f'    {line}' in advice.report('scene.yaml', found, tolerance) for line in lines)
    pasted = yaml.safe_load('\n'.join(lines))
    kept = {name: list(value) if isinstance(value, tuple) else value
            for name, value in given.items() if name not in found.best.setting.values()}
    path = tmp_path / 'scene.yaml'
    path.write_text(yaml.safe_dump({'/**': {'ros__parameters': {**kept, **pasted}}}))
    simulation = load_scene(path).simulation()
    setting = found.best.setting
    assert (simulation.integrator, simulation.rate, simulation.substeps) == (
        setting.integrator, setting.rate, 1)
    simulation.step()


def test_a_hull_of_too_few_probes_is_not_advised_however_small_the_step():
    # Four probes under 4 m of boat in waves 7.5 m long: more of them or panels is what it takes.
    given, tolerance = SCENES['regular']
    found = advise(load_scene(given).given, tolerance)
    assert found.best.setting.model == 'panels' or found.best.setting.probe_count > 4
    trial = Trial.of(stretches(load_scene(given).given)[0])
    assert trial.error(Setting('leapfrog', 200.0, (2, 2))) > tolerance


def test_no_setting_is_advised_that_is_started_with_a_warning(monkeypatch):
    # Coarse enough for a tolerance of 20 cm, and too coarse to come to rest with.
    given = load_scene(SCENES['irregular'][0]).given
    found = advise(given, 0.2)
    # Its sea has waves that pass between its four probes, which no setting changes.
    spared = load_scene({**given, 'rate': 1000.0}).simulation().warnings
    for setting in (found.best.setting, found.cheaper.setting):
        assert load_scene({**given, **setting.values()}).simulation().warnings == spared
    with monkeypatch.context() as patch:
        patch.setattr(settings, 'acceptance', lambda given: lambda setting: True)
        coarser = advise(given, 0.2).best
    assert coarser.cpu < found.best.cpu
    assert any('will rattle at rest' in sentence for sentence in load_scene(
        {**given, **coarser.setting.values()}).simulation().warnings)


def test_a_warning_that_no_setting_spares_a_scene_keeps_it_from_none():
    # The waves break, whatever the step.
    given = load_scene({'sea.waves': [0.3, 1.5, 0.4, 0.0], 'hull.probes': [8, 8]}).given
    fine = Setting('leapfrog', 128.0, (8, 8))
    warnings = load_scene({**given, **fine.values()}).simulation().warnings
    assert ['steeper than water can be' in sentence for sentence in warnings] == [True]
    accepts = settings.acceptance(given)
    assert accepts(fine)
    assert not accepts(replace(fine, rate=8.0))
    assert not accepts(Setting('leapfrog', 128.0, (2, 2)))
    # Panels feel the lift by themselves, and damping where the probes are.
    assert accepts(Setting('leapfrog', 128.0, (8, 8), 0.0))
    assert not accepts(Setting('leapfrog', 128.0, (2, 2), 0.0))


def test_a_size_of_panels_beside_columns_speaks_against_none():
    accepts = settings.acceptance(load_scene({'hull.panel_size': 0.5}).given)
    assert accepts(Setting('leapfrog', 128.0, (2, 2)))


def test_columns_are_advised_where_they_will_do_and_panels_where_only_they_will():
    # Four columns would let the box come to rest on its side.
    given = load_scene({'start.orientation': [1.3, 0.0, 0.0]}).given
    found = advise(given, 0.06)
    assert found.limit == ''
    assert found.best.setting.model == 'panels'
    given = load_scene({'start.orientation': [0.1, 0.0, 0.0]}).given
    assert advise(given, 0.02).best.setting.model == 'columns'


def test_the_game_loop_is_not_named_where_the_default_is_as_cheap_within_the_noise():
    def ordered(game_loop):
        seconds = {((None, None), 'leapfrog'): 1e-6, ((None, None), 'symplectic_euler'): game_loop}
        return [setting.integrator for _, setting in settings.candidates(seconds, (10.0,))]

    assert ordered(0.95e-6) == ['leapfrog', 'symplectic_euler']
    assert ordered(0.8e-6) == ['symplectic_euler', 'leapfrog']


@pytest.mark.parametrize('error, tolerance, text', [
    (0.01004, 0.01, '0.01004'), (0.00996, 0.01, '0.01'), (0.0121, 0.0123, '0.012'),
    (0.0125, 0.0123, '0.013'), (0.0123001, 0.0123, '0.0123001'), (0.037, 0.01, '0.037')])
def test_an_error_is_told_so_that_one_sees_on_which_side_of_the_tolerance_it_is(
        error, tolerance, text):
    assert advice.metres(error, tolerance) == text


def test_a_setting_that_misses_the_tolerance_is_never_told_to_meet_it():
    best, cheaper = (Result(Setting('leapfrog', rate, (2, 2)), error, cpu, rate, error)
                     for rate, error, cpu in ((11.0, 0.009, 2e-6), (8.0, 0.010004, 1e-6)))
    found = advice.Advice(best, cheaper, None, '', 'its waves', 'another stretch', 20.0)
    said = '\n'.join(advice.report('scene.yaml', found, 0.01))
    assert 'error 0.010004 m' in said and 'error 0.01 m' not in said


def test_what_limits_is_said_when_nothing_meets_the_tolerance():
    given = load_scene(SCENES['irregular'][0]).given
    found = advice.advise(given, 1e-5, rates=RATES[:5], step_costs=known_costs)
    assert found.limit.startswith('The time step limits it: the finest that was tried and starts '
                                  'without a warning is rk4 16 Hz, and twice as many steps leave ')
    lines = advice.report('scene.yaml', found, 1e-5)
    assert lines[0] == 'scene.yaml: no setting meets 1e-05 m.'
    assert 'integrator' in '\n'.join(lines)


def test_a_tolerance_below_what_is_known_of_the_true_motion_is_refused():
    given = load_scene(SCENES['regular'][0]).given
    found = advise(given, 1e-9)
    assert found.limit.startswith('The true motion limits it: by the hull as 6144 panels and as '
                                  '1536 it is known to ')
    assert found.best is None
    assert len(advice.report('scene.yaml', found, 1e-9)) == 2


def test_the_model_of_the_hull_is_named_when_it_limits(monkeypatch):
    monkeypatch.setattr(settings, 'COLUMNS', ((4, 2),))
    monkeypatch.setattr(settings, 'PANEL_PROBES', ())
    monkeypatch.setattr(settings, 'panel_sizes', lambda given: ())
    given = load_scene({**SCENES['regular'][0], 'hull.probes': [4, 2]}).given
    found = advise(given, 2e-3)
    assert found.limit.startswith(
        'The model of the hull limits it: 4x2 columns miss the motion of the hull itself by')


def test_a_scene_in_which_nothing_moves_is_pushed():
    first, second = stretches(load_scene({}).given)
    assert first.push == -second.push / 0.9
    run = first.run()
    assert run.start.position[2] < rest_state(run.boat).position[2]
    assert run.start.orientation[0] == pytest.approx(0.05, rel=0.01)


def test_the_check_is_another_seed_another_stretch_or_another_start():
    irregular, regular, drop = (stretches(load_scene(given).given)
                                for given, _ in SCENES.values())
    assert irregular[1].given['sea.seed'] == 2
    assert regular[1].clock > regular[0].duration
    start = [stretch.run().start.position[2] for stretch in drop]
    rest = rest_state(drop[0].run().boat).position[2]
    assert start[1] - rest == pytest.approx(0.9 * (start[0] - rest))


def test_front_is_what_nothing_else_beats_and_can_be_typed_in():
    given = {'start.position': [0.0, 0.0, 0.4]}
    items = pareto_front.scene_items(given)
    found = [(Setting('leapfrog', rate, (2, 2)), 1.0 / rate) for rate in pareto_front.QUICK_RATES]
    found += [(Setting('rk4', rate, (2, 2)), 2.0 / rate) for rate in pareto_front.QUICK_RATES]
    rows = pareto_front.rows('scene', items, found, True)
    best = [row for row in rows if row.front]
    assert {row.integrator for row in best} == {'leapfrog'}
    for row in best:
        cheaper = [other.error for other in rows if other.cpu < row.cpu and other.front]
        assert all(error > row.error for error in cheaper)
        assert load_scene({**given, **pareto_front.setting_of(row).values()}
                          ).simulation().warnings == ()


def test_the_setting_of_a_row_is_the_one_that_was_measured():
    items = pareto_front.scene_items({'sea.waves': [0.12, 2.2, 0.4, 0.0]})
    found = [(Setting('leapfrog', 8.0, (4, 2), size), 0.1) for size in (None, 0.0)]
    rows = pareto_front.rows('scene', items, found, True)
    assert {pareto_front.setting_of(row) for row in rows} == {setting for setting, _ in found}
    assert [(row.model, row.probes, row.panels) for row in rows] == [
        ('columns', 8, 0), ('panels', 8, 384)]


def test_truth_of_a_hull_is_the_limit_of_ever_finer_panels():
    given = load_scene(SCENES['regular'][0]).given
    trial = Trial.of(stretches(given)[0])
    errors = [trial.error(Setting('rk4', 64.0, (8, 8), size))
              for size in settings.panel_sizes(given)]
    # As the square of the edge, 1 and 1/2 where that of the truth is 1/4.
    assert errors[0] / errors[1] == pytest.approx((1 - 1 / 16) / (1 / 4 - 1 / 16), rel=0.1)
    assert trial.own_error == pytest.approx(errors[1], rel=0.1)
    # Columns come to a limit of their own.
    assert trial.error(Setting('rk4', 64.0, (8, 8))) > 3.0 * errors[1]


def test_added_mass_and_wave_force_of_a_scene_in_waves_are_one_more_choice_to_leave_out():
    three = {'added_mass': [300.0, 700.0, 4900.0, 800.0, 4900.0, 1000.0],
             'damping.linear': [800.0, 2200.0, 8500.0, 900.0, 5200.0, 1000.0],
             'wave_force': 'froude_krylov'}
    waves = {'sea.waves': [0.05, 3.0, 0.4, 0.0]}
    plain, still, given = (load_scene(values).given for values in (
        waves, three, {**waves, **three}))
    assert not any(bare for *_, bare in (*settings.choices(plain), *settings.choices(still)))
    models = settings.choices(given)
    assert len(models) == 2 * len(settings.choices(plain))
    left_out = Setting('leapfrog', 20.0, (2, 2), None, bare=True)
    assert left_out.choice in models and replace(left_out, bare=False).choice in models
    # It is the scene that never had them.
    boat = load_scene({**given, **left_out.values()}).boat
    other = load_scene({**plain, **left_out.values()}).boat
    assert boat.damping.probe.tolist() == other.damping.probe.tolist()
    assert not boat.follows_waves and not boat.added_mass.any()
    pasted = yaml.safe_load('\n'.join(left_out.lines()))
    assert pasted['wave_force'] == 'hydrostatic' and pasted['damping']['linear'] == [0.0] * 6
    # What it is worth is seen at any step: the motion without them is another one.
    run = replace(stretches(given)[0], duration=12.0).run
    truth = run().solve(tolerance=1e-8, restart=False)
    with_it, without = (measure(run(settings.hull_values((2, 2), None, bare)), truth, 'leapfrog',
                                20.0).total for bare in (False, True))
    assert with_it < 0.1 * without
    # The table of the front gives it back.
    hull = run().boat.hull
    row = pareto_front._row('scene', hull, left_out, 0.1, 1e-5, True)
    assert pareto_front.setting_of(row) == left_out
