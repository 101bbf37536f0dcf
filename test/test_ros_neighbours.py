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

from itertools import cycle
import os
import random
import subprocess
import sys

from boat_buoyancy.physics.sea.waves import Sea
from boat_buoyancy.ros.figures import fingerprint
from boat_buoyancy.ros.neighbours import Neighbours, Rivals
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseWithCovarianceStamped, Wrench, WrenchStamped
import pytest
from ros_probe import BEST_EFFORT, BoatProcess, NAME, Probe, wrench
from std_msgs.msg import Float64, Float64MultiArray


def fights(numbers, rate=10.0):
    """Return whether messages of such numbers, at some rate in Hz, are ever taken for a fight."""
    rivals, found = Rivals(), False
    for i, number in enumerate(numbers):
        rivals.heard(number, i / rate)
        found |= rivals.fight(i / rate)
    return found


def turns(*counts, seconds=20.0):
    """
    Return the numbers of messages of publishers that send in turn, 10 a second in all.

    ``counts`` of each, the number it begins with, as often as it has a turn.
    """
    numbers = {begin: begin for begin in counts}
    found = []
    for i in range(int(10.0 * seconds)):
        begin = counts[i % len(counts)]
        found.append(numbers[begin])
        numbers[begin] += 1
    return found


def test_two_and_more_that_send_fight_however_often_each_of_them_sends():
    assert fights(turns(5000, 7))
    assert fights(turns(5000, 7, 300))
    # One that sends every fifth second, whichever has sent more so far.
    assert fights(turns(*[2] * 50, 900, seconds=30.0))
    assert fights(turns(*[900] * 50, 2, seconds=30.0))
    # Started together and as quick as each other.
    assert fights([number for number in range(2, 40) for _ in range(2)])


def test_what_one_sends_is_no_fight():
    assert not fights(range(1, 200))
    # Some of its messages are lost.
    assert not fights(sorted(random.Random(0).sample(range(1, 1000), 200)))
    # It is started again three times, or for one message each time as by `ros2 topic pub --once`.
    assert not fights([*range(1, 50)] * 3)
    assert not fights([1] * 50)


def test_a_hand_over_in_which_both_send_for_a_second_is_no_fight():
    assert not fights([*range(1, 100), *turns(100, 3, seconds=1.0), *range(8, 100)])


def test_a_fight_that_has_ended_is_over_before_long():
    rivals = Rivals()
    for i, number in enumerate(turns(5000, 7)):
        rivals.heard(number, i / 10.0)
    assert rivals.fight(i / 10.0) and not rivals.fight(i / 10.0 + 4.0)


def test_a_message_and_its_number_are_taken_however_an_executor_hands_them_over():
    taken, neighbours = [], Neighbours(None)
    callback = neighbours.watched('thrust', taken.append)
    # Of middleware that numbers nothing, too.
    for number in (1, None):
        callback('message', {'publication_sequence_number': number})
        callback(('message', {'publication_sequence_number': number}))
    assert taken == ['message'] * 4


@pytest.fixture(scope='module')
def boat():
    """Start one boat for all neighbours."""
    with BoatProcess({'status_period': 0.0, 'thrusters.names': ['main'],
                      'thrusters.positions': [0.0, 0.0, -0.3]}) as process:
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


@pytest.mark.parametrize('topic, qos, messages', [
    # In the two frames these numbers are two thrusts as soon as the boat has turned.
    ('thrust', BEST_EFFORT, (wrench((500.0, 0.0, 0.0)), wrench((500.0, 0.0, 0.0), frame='odom'))),
    ('thrusters/main/thrust', 10, (Float64(data=500.0), Float64(data=-300.0)))])
def test_publishers_that_fight_over_the_boat_are_named(boat, probe, topic, qos, messages):
    with Probe(boat.namespace, 'rival') as rival:
        kind = type(messages[0])
        one, other = (side.publisher(kind, topic, qos) for side in (probe, rival))

        def both():
            one.publish(messages[0])
            probe.spin(0.01)
            other.publish(messages[1])
        said = f' publishers sends on {boat.namespace}/{topic}'
        probe.until(lambda: warned(boat, probe, f'more than one of 2{said}',
                                   f'{boat.namespace}/rival', f'{boat.namespace}/probe'),
                    doing=both)
        assert 'so they fight over the boat' in boat.wait_for_log(said)
        # Over when the other one falls silent, though it stays.
        probe.until(lambda: well(boat, probe), doing=lambda: one.publish(messages[0]))
    probe.node.destroy_publisher(one)


# Publishes a few wrenches and then nothing.
SILENT = """
import sys
from ros_probe import BEST_EFFORT, Probe, wrench
from geometry_msgs.msg import WrenchStamped
with Probe(sys.argv[1], 'silent') as one:
    thrust = one.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
    for _ in range(5):
        thrust.publish(wrench((100.0, 0.0, 0.0)))
        one.spin(0.05)
    print('silent', flush=True)
    one.spin(60.0)
"""


def test_one_that_goes_to_and_fro_beside_one_that_was_killed_is_no_fight(boat, probe):
    silent = subprocess.Popen([sys.executable, '-c', SILENT, boat.namespace], text=True,
                              cwd=os.path.dirname(__file__), stdout=subprocess.PIPE)
    try:
        assert silent.stdout.readline() == 'silent\n'
        # Who is killed before anybody knows of him is never there.
        probe.until(lambda: probe.node.get_publishers_info_by_topic(
            f'{boat.namespace}/thrust'))
    finally:
        silent.kill()
        silent.wait()
        silent.stdout.close()
    thrust = probe.publisher(WrenchStamped, 'thrust', BEST_EFFORT)
    bang, end = cycle((500.0, -500.0)), len(probe.diagnostics) + 6
    probe.until(lambda: len(probe.diagnostics) > end,
                doing=lambda: thrust.publish(wrench((next(bang), 0.0, 0.0))))
    # It was there to the last, and nothing was said of it.
    assert len(probe.node.get_publishers_info_by_topic(thrust.topic_name)) == 2
    assert not any('fight' in status.message for array in probe.diagnostics[-6:]
                   for status in array.status)
    probe.node.destroy_publisher(thrust)


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
