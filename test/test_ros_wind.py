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

"""Wind by message and by parameter, while the boat floats."""

import math

from boat_buoyancy.physics import load_scene
from boat_buoyancy.ros.complaints import Refused
from boat_buoyancy.ros.wind import read_wind
from geometry_msgs.msg import Vector3, Vector3Stamped
import pytest
from ros_probe import BoatProcess, Probe

# Ahead X (W - u)^2 = D u with W 10 m/s; so much drag that it takes half a second.
SURGE, DRAG, WIND = 2000.0, 20000.0, 10.0
DRIFT = (2.0 * WIND + DRAG / SURGE - math.sqrt(
    (2.0 * WIND + DRAG / SURGE) ** 2 - 4.0 * WIND ** 2)) / 2.0


def blowing(x, y=0.0, z=0.0, frame=''):
    """Return a Vector3Stamped."""
    message = Vector3Stamped(vector=Vector3(x=x, y=y, z=z))
    message.header.frame_id = frame
    return message


@pytest.fixture(scope='module')
def boat():
    """Start a boat that only wind moves."""
    with BoatProcess({'wind.drag': [SURGE, SURGE, 0.0], 'damping.linear': [DRAG] * 6,
                      'damping.linear_retention': [1.0], 'damping.probe': 0.0,
                      'status_period': 0.0}) as process:
        yield process


@pytest.fixture(scope='module')
def probe(boat):
    """Look at it with one probe."""
    with Probe(boat.namespace) as one:
        one.wind = one.publisher(Vector3Stamped, 'wind')
        one.twists = one.listen_to_boat()[1]
        one.until(lambda: one.twists)
        yield one


def drifts(probe, speed):
    """Wait until the boat goes ahead at a speed in m/s."""
    probe.until(lambda: abs(probe.twists[-1].twist.linear.x - speed) < 1e-3)


def test_a_wind_by_message_and_one_by_parameter_drive_the_boat(boat, probe):
    assert abs(probe.twists[-1].twist.linear.x) < 1e-9
    probe.wind.publish(blowing(WIND, frame='odom'))
    drifts(probe, DRIFT)
    boat.wait_for_log('wind: x 10.00 y 0.00 m/s')
    # Another parameter leaves the wind of the message.
    assert probe.set_parameters({'thrust.timeout': 1.0})[0].successful
    probe.spin(0.3)
    drifts(probe, DRIFT)
    assert probe.set_parameters({'wind.velocity': [-WIND, 0.0]})[0].successful
    drifts(probe, -DRIFT)
    assert probe.set_parameters({'wind.drag': [0.0, 0.0, 0.0]})[0].successful
    drifts(probe, 0.0)
    boat.wait_for_log('wind.velocity has no effect')


def test_a_refused_wind_is_told_of_and_changes_nothing(boat, probe):
    for message, said in ((blowing(math.nan), 'wind: expected finite numbers'),
                          (blowing(5.0, frame='base_link'), 'wind: expected frame_id empty or')):
        probe.wind.publish(message)
        boat.wait_for_log(said)


@pytest.mark.parametrize('message, kind, said', [
    (blowing(1.0, math.inf), 'not finite', 'expected finite numbers, got [1.0, inf, 0.0]'),
    (blowing(1.0, z=0.5), 'not level', 'expected a z of 0, as it blows level, got 0.5 m/s'),
    (blowing(0.0, -1001.0), 'too large', 'x and y of at most 1000 m/s, got 0, -1001'),
    (blowing(1.0, frame='base_link'), 'unknown frame', "empty or 'odom', got 'base_link'")])
def test_a_wind_that_is_none_is_refused_with_the_reason(message, kind, said):
    with pytest.raises(Refused) as raised:
        read_wind(message, load_scene({}))
    assert raised.value.kind == kind
    assert str(raised.value).startswith('wind: ') and said in str(raised.value)


def test_a_wind_may_be_in_the_map_that_is_the_same_place_as_the_world():
    assert read_wind(blowing(3.0, -4.0, frame='map'), load_scene({'map_frame': 'map'})) == (3, -4)
