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

"""Thrusters push where they are and as they are turned, late, within limits, and in water only."""

import math
from pathlib import Path

from boat_buoyancy.physics import load_scene, Propulsion, Thruster
from boat_buoyancy.physics.boat.state import body_frame, center_of_mass_state
from boat_buoyancy.physics.rotation import from_roll_pitch_yaw
from boat_buoyancy.physics.scene.parameter_file import read
import numpy as np
import pytest

CONFIG = Path(__file__).parents[1] / 'config'
# Nothing brakes it, so that momentum tells the thrust.
GLIDER = {'damping.probe': 0.0, 'damping.linear_retention': [1.0],
          'damping.angular_retention': [1.0], 'damping.air_linear_retention': [1.0],
          'damping.air_angular_retention': [1.0]}
ONE = {'thrusters.names': ['main'], 'thrusters.positions': [0.0, 0.0, -0.3]}


def driven(scene, seconds, commands, angles=None, *, state=None):
    """Return the `Trajectory` of a scene whose thrusters are held."""
    sim, push = scene.simulation(state=state), scene.propulsion()
    return sim.run(seconds, lambda time, state: push.wrench(sim, commands, angles))


def test_two_thrusters_at_250_n_give_the_published_speed_of_the_wam_v():
    # 100 u + 150 u^2 = 500.
    run = driven(load_scene(CONFIG / 'wam_v.yaml'), 60.0, {'left': 250.0, 'right': 250.0})
    assert run.body_velocity[-1, 0] == pytest.approx(1.5226, abs=5e-5)
    assert abs(run.yaw[-1]) < 1e-9


def test_full_ahead_gives_the_otter_the_six_knots_that_its_drag_was_made_from():
    run = driven(load_scene(CONFIG / 'otter.yaml'), 30.0, {'left': 1e4, 'right': 1e4})
    # A bow-up trim of 0.03 rad at that thrust takes about its square in heave drag.
    assert run.body_velocity[-1, 0] == pytest.approx(6.0 * 0.5144, rel=0.015)


@pytest.mark.parametrize('stronger, sign', [('right', 1.0), ('left', -1.0)])
def test_a_hundred_newton_more_on_one_side_turns_to_the_other(stronger, sign):
    commands = {'left': 150.0, 'right': 150.0, stronger: 250.0}
    scene = load_scene(CONFIG / 'wam_v.yaml')
    run = driven(scene, 60.0, commands)
    # At the end 100 N on an arm of 1.027135 m and the moment of Munk, (M v) x v of the added mass,
    # against 800 r + 800 r^2; its drag acts at the centre of mass and turns it by nothing.
    ahead, abeam, _ = run.body_velocity[-1] + np.cross(
        run.angular_velocity[-1], scene.boat.center_of_mass)
    ahead_mass, abeam_mass, *_ = scene.boat.added_mass
    torque = 100.0 * 1.027135 + sign * (ahead_mass - abeam_mass) * ahead * abeam
    rate = (-1.0 + math.sqrt(1.0 + 4.0 * torque / 800.0)) / 2.0
    assert run.angular_velocity[-1, 2] == pytest.approx(sign * rate, rel=1e-3)


def test_an_azimuth_of_90_degrees_pushes_to_port_and_minus_90_to_starboard():
    scene = load_scene({**GLIDER, **ONE})
    for angle, sign in ((math.pi / 2, 1.0), (-math.pi / 2, -1.0)):
        run = driven(scene, 1.0, {'main': 100.0}, {'main': angle})
        # 100 N for 1 s on 2000 kg.
        assert run.body_velocity[-1, 1] == pytest.approx(sign * 0.05, rel=1e-3)
        assert abs(run.body_velocity[-1, 0]) < 1e-9


def test_the_wrench_is_that_of_forces_at_their_places():
    # At random angles and directions, against rotation matrices and NumPy's cross product.
    random = np.random.default_rng(4)
    for _ in range(20):
        place, direction, angle, force = (random.normal(size=3), random.normal(size=3),
                                          random.uniform(-4.0, 4.0), random.normal())
        turn = np.array([[math.cos(angle), -math.sin(angle), 0.0],
                         [math.sin(angle), math.cos(angle), 0.0], [0.0, 0.0, 1.0]])
        push = force * turn @ direction / np.linalg.norm(direction)
        got = Thruster('one', place, direction).wrench(force, angle)
        np.testing.assert_allclose(np.concatenate(got), [*push, *np.cross(place, push)],
                                   atol=1e-14)


def test_limits_saturate():
    scene = load_scene({**GLIDER, **ONE, 'thrusters.limits': [-50.0, 200.0]})
    for command, given in ((1e9, 200.0), (200.0, 200.0), (-1e9, -50.0), (-20.0, -20.0)):
        run = driven(scene, 1.0, {'main': command})
        assert run.body_velocity[-1, 0] == pytest.approx(given / 2000.0, rel=1e-3)


@pytest.mark.parametrize('rate', [10.0, 100.0, 137.0])
def test_a_held_command_gives_the_momentum_of_first_order_lag_at_any_rate(rate):
    scene = load_scene({**GLIDER, **ONE, 'thrusters.lag': 0.7, 'thrusters.positions': [0.0] * 3,
                        'hull.bottom': -0.2, 'rate': rate})
    sim, push = scene.simulation(), scene.propulsion()
    for _ in range(round(2 * rate)):
        sim.step(push.wrench(sim, {'main': 300.0}))
    # T = F (1 - exp(-t / lag)), and its integral over t.
    assert push.forces['main'] == pytest.approx(300.0 * (1.0 - math.exp(-2.0 / 0.7)), rel=1e-12)
    momentum = 300.0 * (2.0 - 0.7 * (1.0 - math.exp(-2.0 / 0.7)))
    # Through the centre of mass and level: nothing else changes the speed ahead.
    assert sim.state.body_velocity[0] == pytest.approx(momentum / 2000.0, rel=1e-12)


def test_a_command_that_ends_dies_out_with_the_lag_and_stop_ends_it_at_once():
    scene = load_scene({**ONE, 'thrusters.lag': 0.5})
    sim, push = scene.simulation(), scene.propulsion()
    push.wrench(sim, {'main': 100.0})
    before = push.forces['main']
    for _ in range(100):
        push.wrench(sim, {})
    assert push.forces['main'] == pytest.approx(before * math.exp(-1.0 / 0.5), rel=1e-12)
    push.stop()
    assert push.wrench(sim, {}) == (0.0,) * 6


def test_a_thruster_out_of_the_water_gives_nothing():
    scene = load_scene({**GLIDER, **ONE})
    sim, push = scene.simulation(), scene.propulsion()
    origin, turned, *_ = body_frame(scene.boat, scene.start)
    for height, wet in ((0.299 - origin[2], True), (0.301 - origin[2], False)):
        sim.state = center_of_mass_state(scene.boat, origin + [0.0, 0.0, height], turned)
        assert (push.wrench(sim, {'main': 100.0})[0] == 100.0) is wet


def test_the_water_is_that_of_the_place_of_the_thruster_in_waves():
    # At heading 90 degrees and 10 m ahead of the origin it is at world y = 10 m, half a wave away.
    period = math.sqrt(2.0 * math.pi * 20.0 / 9.81)
    scene = load_scene({'thrusters.names': ['bow'], 'thrusters.positions': [10.0, 0.0, 0.0],
                        'boat.center_of_mass': [0.1, 0.2, -0.1],
                        'sea.waves': [0.5, period, math.pi / 2, 0.0]})
    sim, push = scene.simulation(), scene.propulsion()
    for place, wet in ((0.0, False), (10.0, True)):
        sim.state = center_of_mass_state(scene.boat, [0.0, place, 0.0],
                                         np.array(from_roll_pitch_yaw(0.0, 0.0, math.pi / 2)))
        assert any(push.wrench(sim, {'bow': 1.0})) is wet


def test_a_thruster_above_the_water_at_rest_is_warned_of_with_its_height():
    values = {**read(CONFIG / 'wam_v.yaml'), 'thrusters.limits': []}
    # As the heads of the engines in VRX: 0.318 m up in a boat that draws 0.054 m.
    values['thrusters.positions'] = [-2.4, 1.0, 0.318237, -2.4, -1.0, -0.2]
    said, = load_scene(values).warnings
    assert said.startswith('The thruster left is 0.265 m above the water at rest')


def test_what_no_thruster_has_is_refused_in_one_line():
    sim, push = load_scene(ONE).simulation(), load_scene(ONE).propulsion()
    for commands, angles, said in (
            ({'port': 1.0}, {}, "thruster: expected one of main, got 'port'"),
            ({'main': math.nan}, {}, 'thruster main: expected a finite number, got nan'),
            ({}, {'main': math.inf}, 'thruster main: expected a finite number, got inf'),
            ({'main': 'full'}, {}, "thruster main: expected a finite number, got 'full'")):
        with pytest.raises(ValueError) as raised:
            push.wrench(sim, commands, angles)
        assert str(raised.value) == said
    with pytest.raises(ValueError, match="expected one of none, got 'main'"):
        Propulsion(()).wrench(sim, {'main': 1.0})


@pytest.mark.parametrize('values, said', [
    ({'thrusters.names': ['left']}, 'thrusters.positions: expected 3 numbers, 3 for each of '
                                    'thrusters.names, got 0: []'),
    *(({f'thrusters.{part}': [0.0] * 6}, f'thrusters.{part}: expected thrusters.names, one for '
       'each thruster, got none: give thrusters.names')
      for part in ('positions', 'directions', 'limits')),
    ({**ONE, 'thrusters.positions': [0.0] * 6}, 'expected 3 numbers, 3 for each'),
    ({**ONE, 'thrusters.limits': [0.0]}, 'thrusters.limits: expected 2 numbers, 2 for each'),
    # It would push without a command.
    *(({**ONE, 'thrusters.limits': limits}, 'thruster main: expected limits with 0 between them, '
       f'which it gives without a command, got {limits[0]:g} and {limits[1]:g} N')
      for limits in ([1.0, -1.0], [10.0, 100.0], [-100.0, -10.0])),
    ({**ONE, 'thrusters.directions': [0.0] * 3}, 'thruster main: expected a direction of some '
                                                 'length, got (0.0, 0.0, 0.0)')])
def test_thrusters_that_do_not_fit_together_are_refused_in_one_line(values, said):
    with pytest.raises(ValueError) as raised:
        load_scene(values)
    assert said in str(raised.value) and '\n' not in str(raised.value)


def test_a_lag_without_a_thruster_is_warned_of():
    assert load_scene({'thrusters.lag': 1.0}).warnings == (
        'thrusters.lag has no effect: there is no thruster: give thrusters.names.',)


def test_what_is_in_force_makes_the_same_thrusters_again():
    scene = load_scene(CONFIG / 'otter.yaml')
    assert load_scene(scene.values).thrusters == scene.thrusters
    one = load_scene(ONE)
    assert load_scene(one.values).thrusters == one.thrusters == (
        Thruster('main', (0.0, 0.0, -0.3), least=-1e15, greatest=1e15),)
    assert not [name for name in load_scene({}).values if name.startswith('thrusters.')]
