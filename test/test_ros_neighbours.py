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

"""What the node says of neighbours that are up to something that cannot be meant."""

import math

from boat_buoyancy.physics.sea.waves import Sea
from boat_buoyancy.ros.figures import fingerprint
from boat_buoyancy.ros.neighbours import Rivals
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseWithCovarianceStamped, Wrench, WrenchStamped
import pytest
from ros_probe import BEST_EFFORT, BoatProcess, NAME, Probe, wrench
from std_msgs.msg import Float64MultiArray


AHEAD, ASTERN = (500.0, 0.0, 0.0, 0.0, 0.0, 0.0), (-300.0, 0.0, 0.0, 0.0, 0.0, 50.0)


def fights(wrenches, rate=10.0):
    """Return whether wrenches that come at some rate in Hz are taken for a fight in the end."""
    rivals, now = Rivals(), 0.0
    rivals.possible = True
    for one in wrenches:
        now += 1.0 / rate
        rivals.heard(one, now)
    return rivals.fight(now)


def test_two_that_push_elsewhere_fight_however_often_each_of_them_sends():
    assert fights([AHEAD, ASTERN] * 20)
    assert fights(([AHEAD] * 9 + [ASTERN]) * 10)
    # Also while each of them changes its mind.
    assert fights([(500.0 + i if i % 2 else -300.0 - i, 0.0, 0.0, 0.0, 0.0, 0.0)
                   for i in range(40)])


def test_what_one_controller_sends_is_no_fight():
    assert not fights([AHEAD] * 100)
    # It goes about once, and oscillates as slowly as boats do.
    assert not fights([AHEAD] * 20 + [ASTERN] * 20)
    assert not fights([(500.0 * math.sin(0.3 * i), 0.0, 0.0, 0.0, 0.0, 0.0) for i in range(200)])
    # One that is noisy by a few parts in a hundred.
    assert not fights([(500.0 + 20.0 * (-1) ** i, 0.0, 0.0, 0.0, 0.0, 0.0) for i in range(200)])


@pytest.fixture(scope='module')
def boat():
    """Start one boat for all neighbours."""
    with BoatProcess({'status_period': 0.0}) as process:
        yield process


@pytest.fixture(scope='module')
def probe(boat):
    """Look at it with one probe."""
    with Probe(boat.namespace) as one:
        one.diagnostics = one.listen(DiagnosticArray, '/diagnostics')
        one.until(lambda: one.diagnostics)
        yield one


def last_status(boat, probe):
    """Return the last status of a boat, and its values."""
    for array in reversed(probe.diagnostics):
        for status in array.status:
            if status.hardware_id == f'{boat.namespace}/{NAME}':
                return status, {item.key: item.value for item in status.values}
    return None, {}


def warned(boat, probe, *words):
    """Return whether the last status is WARN with some words in its message."""
    status, _ = last_status(boat, probe)
    return status and status.level == DiagnosticStatus.WARN and all(
        word in status.message for word in words)


def well(boat, probe):
    """Return whether the last status is OK."""
    status, _ = last_status(boat, probe)
    return status and status.level == DiagnosticStatus.OK


def test_refused_wrenches_are_a_warning_with_their_number_and_the_last_reason(boat, probe):
    thrust = probe.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
    probe.until(lambda: warned(boat, probe, ' messages refused, the last: ', "got 'map'"),
                doing=lambda: thrust.publish(wrench((1.0, 0.0, 0.0), frame='map')))
    status, values = last_status(boat, probe)
    assert 0 < int(status.message.split()[0]) <= int(values['messages refused'])
    # It goes with them.
    probe.until(lambda: well(boat, probe))
    probe.node.destroy_publisher(thrust)


def test_two_publishers_that_fight_over_thrust_are_named_and_the_latest_wrench_acts(boat, probe):
    with Probe(boat.namespace, 'rival') as rival:
        one, other = (side.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
                      for side in (probe, rival))
        # A silent one is no rival.
        end = len(probe.diagnostics) + 3
        probe.until(lambda: len(probe.diagnostics) > end,
                    doing=lambda: one.publish(wrench((500.0, 0.0, 0.0))))
        assert well(boat, probe)

        def both():
            one.publish(wrench((500.0, 0.0, 0.0)))
            probe.spin(0.01)
            other.publish(wrench((-300.0, 0.0, 0.0)))
        probe.until(lambda: warned(boat, probe, '2 publishers send on', f'{boat.namespace}/rival',
                                   f'{boat.namespace}/probe'), doing=both)
        boat.wait_for_log('so they fight over the boat')
        probe.until(lambda: well(boat, probe))
        probe.node.destroy_publisher(one)


def test_another_type_on_a_topic_of_ours_is_a_warning_that_names_who_has_it(boat, probe):
    for kind, topic, ours in ((Wrench, 'thrust', 'WrenchStamped'),
                              (PoseWithCovarianceStamped, 'pose', 'PoseStamped')):
        publisher = probe.node.create_publisher(kind, topic, 1)
        probe.until(lambda: warned(
            boat, probe, f'{boat.namespace}/probe has geometry_msgs/msg/{kind.__name__} on '
            f'{boat.namespace}/{topic}, which is geometry_msgs/msg/{ours} here'))
        probe.node.destroy_publisher(publisher)
        probe.until(lambda: well(boat, probe))
    assert boat.log.count('neither hears the other') == 2


def test_a_status_has_the_namespace_in_its_name_and_the_sea_in_its_values(boat, probe):
    probe.until(lambda: well(boat, probe))
    status, values = last_status(boat, probe)
    assert status.name == f'{boat.namespace[1:]}/{NAME}: motion'
    assert values['sea'] == fingerprint(Sea())
    rows = [0.1, 4.0, 0.0, 0.0]
    probe.publisher(Float64MultiArray, 'wave_parameters').publish(Float64MultiArray(data=rows))
    probe.until(lambda: last_status(boat, probe)[1]['sea'] == fingerprint(Sea(rows)))


def test_a_fingerprint_is_of_all_that_makes_the_water():
    rows = [0.1, 4.0, 0.0, 0.0]
    assert fingerprint(Sea(rows)) == fingerprint(Sea([0.1, 4.0, -0.0, 0.0]))
    others = [Sea(), Sea(rows), Sea([0.1, 4.0, 0.0, 1e-9]), Sea(rows * 2), Sea(rows, depth=9.0),
              Sea(rows, current=[0.1, 0.0]), Sea(rows, gravity=9.8)]
    assert len({fingerprint(sea) for sea in others}) == len(others)
    assert all(len(fingerprint(sea)) == 8 for sea in others)
