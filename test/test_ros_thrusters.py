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

"""Thrusters driven over topics: the names and types of VRX, each with the time-out of thrust."""

from itertools import cycle
import math
import time
from types import SimpleNamespace

from boat_buoyancy.physics import load_scene
from boat_buoyancy.ros.complaints import Refused
from boat_buoyancy.ros.session import Session
from boat_buoyancy.ros.thrusters import ThrusterInput
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import WrenchStamped
import numpy as np
import pytest
from ros_probe import BEST_EFFORT, BoatProcess, Probe, wrench
from std_msgs.msg import Float64


# Nothing brakes it and the thrusters act level with the centre of mass: speed is impulse / mass.
MASS = 2000.0
BOAT = {'damping.probe': 0.0, 'damping.linear_retention': [1.0], 'hull.bottom': -0.2,
        'status_period': 0.0, 'thrusters.names': ['left', 'right'],
        'thrusters.positions': [-1.5, 0.8, 0.0, -1.5, -0.8, 0.0],
        'thrusters.limits': [-500.0, 1000.0, -500.0, 1000.0]}


@pytest.fixture(scope='module')
def boat():
    """Start a boat with two thrusters."""
    with BoatProcess(BOAT) as process:
        yield process


@pytest.fixture(scope='module')
def listener(boat):
    """Look at it with one probe."""
    with Probe(boat.namespace) as one:
        one.thrust = one.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
        # Reliable, as VRX's own programs publish them.
        one.drive = {name: one.publisher(Float64, f'thrusters/{name}')
                     for name in ('left/thrust', 'right/thrust', 'left/pos', 'right/pos')}
        one.twists = one.listen_to_boat()[1]
        one.diagnostics = one.listen(DiagnosticArray, '/diagnostics')
        one.until(lambda: one.twists)
        yield one


@pytest.fixture
def probe(listener):
    """Put the boat back to its start and look at it from now on."""
    listener.trigger('reset')
    listener.spin(0.05)
    listener.twists.clear()
    listener.until(lambda: listener.twists)
    return listener


def send(probe, **values):
    """Publish left_thrust=250.0 and the like."""
    for name, value in values.items():
        probe.drive[name.replace('_', '/')].publish(Float64(data=value))


def gains(probe):
    """Return the gains of speed ahead of all periods so far, times mass and rate: N."""
    speed = np.array([message.twist.linear.x for message in probe.twists])
    return MASS * 100.0 * np.diff(speed)


def test_thrusters_and_thrust_add_up(probe):
    probe.until(lambda: gains(probe).max(initial=0.0) > 650.0, doing=lambda: (
        send(probe, left_thrust=250.0, right_thrust=250.0),
        probe.thrust.publish(wrench((200.0, 0.0, 0.0)))))
    # Once all three are there: level, so that the force ahead is the gain.
    assert gains(probe).max() == pytest.approx(700.0, rel=1e-6)


def test_more_than_the_limits_is_cut_to_them(probe):
    probe.until(lambda: gains(probe).max(initial=0.0) > 1900.0, doing=lambda: send(
        probe, left_thrust=9000.0, right_thrust=9000.0))
    # However much more, as of a controller that asks for all there is.
    probe.until(lambda: gains(probe).min() < -900.0, doing=lambda: send(
        probe, left_thrust=-9e9, right_thrust=-1e300))
    assert gains(probe).max() == pytest.approx(2000.0, rel=1e-6)
    assert gains(probe).min() == pytest.approx(-1000.0, rel=1e-6)


def test_thrusters_turned_to_port_push_to_port_and_stay_turned(probe):
    send(probe, left_pos=math.pi / 2, right_pos=math.pi / 2)
    probe.spin(0.1)
    # Angles are sent once; behind the centre of mass, it turns the bow to starboard, too.
    probe.until(lambda: probe.twists[-1].twist.linear.y > 0.02, doing=lambda: send(
        probe, left_thrust=500.0, right_thrust=500.0))
    assert probe.twists[-1].twist.angular.z < 0.0


def test_more_on_the_right_turns_left(probe):
    probe.until(lambda: probe.twists[-1].twist.angular.z > 0.005, doing=lambda: send(
        probe, left_thrust=100.0, right_thrust=200.0))


def test_each_thruster_has_the_time_out_of_thrust(probe):
    send(probe, left_thrust=300.0)
    # The other one is kept alive, and does not keep this one alive.
    start = time.monotonic()
    probe.until(lambda: time.monotonic() > start + 1.0,
                doing=lambda: send(probe, right_thrust=100.0))
    both = gains(probe) > 350.0
    # 50 periods, give or take what the messages were late.
    assert 45 <= both.sum() <= 52
    assert gains(probe)[-1] == pytest.approx(100.0, rel=1e-3)


def test_what_is_no_thrust_is_refused_counted_and_leaves_the_last_good_one_its_time_out(
        boat, probe):
    send(probe, left_thrust=300.0)
    probe.until(lambda: gains(probe).max(initial=0.0) > 0.0)
    start, bad = time.monotonic(), cycle((math.nan, math.inf, -math.inf))
    probe.until(lambda: time.monotonic() > start + 0.8,
                doing=lambda: send(probe, left_thrust=next(bad), right_pos=math.nan))
    assert 45 <= (gains(probe) > 250.0).sum() <= 52
    assert 'thrusters/left/thrust: expected finite numbers, got [nan]' in boat.log
    assert 'thrusters/right/pos: expected finite numbers, got [nan]' in boat.log
    key = 'refused, thrusters/left/thrust: not finite'

    def counted():
        return any(item.key == key and int(item.value) > 5 for array in probe.diagnostics
                   for status in array.status for item in status.values)
    probe.until(counted)


def test_diagnostics_tell_what_each_thruster_gives(probe):
    def shown():
        probe.diagnostics[:-1] = []
        values = {item.key: item.value for array in probe.diagnostics
                  for status in array.status for item in status.values}
        return values.get('thruster left (N)') == '250' and values['thruster right (N)'] == '-10'
    probe.until(shown, doing=lambda: send(probe, left_thrust=250.0, right_thrust=-10.0))


# Without a graph.

def test_a_thruster_without_limits_is_asked_for_no_more_than_the_boat_can_mean():
    values = {name: BOAT[name] for name in ('thrusters.names', 'thrusters.positions')}
    session, callbacks = Session(load_scene(values)), {}
    node = SimpleNamespace(create_subscription=lambda kind, topic, act, qos: None)
    ThrusterInput(node, session.scene.thrusters[0], session, callbacks.setdefault)
    with pytest.raises(Refused, match='^thrusters/left/thrust: expected at most 1.96e.07 N, '
                                      '1000 times the weight of this boat, got 1e.300'):
        callbacks['thrusters/left/thrust'](Float64(data=1e300))


def test_a_reset_ends_thrust_and_angle_and_what_the_lag_still_holds():
    session = Session(load_scene({**BOAT, 'thrusters.lag': 1.0}))
    session.thrusters.hold('left', 500.0, 0.0)
    session.thrusters.angles['left'] = 1.0
    session.step()
    assert session.propulsion.forces['left'] > 0.0
    session.reset()
    session.step()
    assert session.propulsion.forces['left'] == 0.0 and session.thrusters.angles == {}
    assert session.simulation.motion.body_velocity[0] == 0.0


def test_another_time_out_holds_for_thrusters_too():
    scene = load_scene(BOAT)
    session = Session(scene)
    session.thrusters.hold('left', 500.0, 0.0)
    assert session.thrusters.commands(0.6) == {}
    longer = load_scene({**BOAT, 'thrust.timeout': 2.0})
    session.change(longer)
    assert session.thrusters.commands(0.6) == {'left': 500.0}
