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

"""What buoyancy_view --ros shows of running nodes is what they publish; what it asks is done."""

import itertools
import math
import signal
import threading
import time

from boat_buoyancy.physics import load_scene
from boat_buoyancy.tools.view import main, remote_boat
from boat_buoyancy.tools.view.remote import Remote
from geometry_msgs.msg import WrenchStamped
import pytest
from ros_probe import BEST_EFFORT, BoatProcess, LATCHED, new_namespace, Probe
from std_msgs.msg import Float64, Float64MultiArray

WAVES = {'sea.waves': [0.2, 4.0, 0.3, 1.0], 'boat.mass': 2100.0}


def until(condition, seconds=20.0):
    """Return what a condition gives once it is true; fail after a while."""
    end = time.monotonic() + seconds
    while not (result := condition()):
        assert time.monotonic() < end
        time.sleep(0.02)
    return result


@pytest.fixture
def seen():
    """Give the namespace of a boat, its process and what a page sees of it."""
    with BoatProcess(WAVES) as boat:
        remote = Remote(['-r', f'__ns:={boat.namespace}'])
        try:
            assert remote.wait(20.0)
            until(lambda: remote.snapshots)
            yield boat, remote
        finally:
            remote.stop()


def test_a_node_is_shown_as_it_is_and_tuned_as_by_ros2_param_set(seen):
    boat, remote = seen
    assert remote.name == boat.namespace and remote.fault is None
    assert remote.scene.boat.mass == 2100.0
    assert remote.scene.sea.waves.ravel().tolist() == WAVES['sea.waves']
    with Probe(boat.namespace) as probe:
        poses, *_ = probe.listen_to_boat()
        probe.until(lambda: len(poses) > 50)
        snapshot = next(iter(remote.snapshots.values()))
        probe.spin(0.5)
        of_stamp = {pose.header.stamp.sec + 1e-9 * pose.header.stamp.nanosec: pose.pose.position
                    for pose in poses}
        place = of_stamp[snapshot.stamp]
        assert snapshot.position.tolist() == [place.x, place.y, place.z]
    # Its probes are as deep in its water as the node says: to the single precision of the cloud
    # and a period or two between the messages, in which the water rises by 0.3 m/s at most.
    places = snapshot.boat.hull.positions @ snapshot.turn.T + snapshot.position
    depth = snapshot.water.elevation(*places[:, :2].T, snapshot.time) - places[:, 2]
    assert snapshot.depths == pytest.approx(depth, abs=0.02)

    remote.tune({'boat.mass': 2500.0})
    until(lambda: remote.scene.boat.mass == 2500.0)
    for values, sentence in (
            ({'rate': 50.0}, 'rate: cannot change while the node runs; start it again with the '
             'new value'),
            ({'boat.mass': -1.0}, None)):
        if sentence is None:
            with pytest.raises(ValueError) as refusal:
                load_scene(values)
            sentence = str(refusal.value)
        with pytest.raises(ValueError) as refusal:
            remote.tune(values)
        assert str(refusal.value) == sentence
    assert 'mass: 2500.0  # was 2100.0' in remote.text()


def test_a_node_is_pushed_paused_stepped_and_reset(seen):
    _, remote = seen
    with pytest.raises(ValueError, match='paused'):
        remote.step()
    end = time.monotonic() + 20.0
    while remote.history.columns()[4][-1] < 0.1 or next(
            iter(remote.snapshots.values())).position[0] < 0.5:
        remote.push(4000.0, 0.0)
        assert time.monotonic() < end
        time.sleep(0.1)
    # In real time while it runs; a paused node says nothing.
    until(lambda: remote.speed.held > 0.5)
    remote.pause(True)
    until(lambda: remote.speed.held == 0.0)
    remote.step()
    remote.reset()
    until(lambda: abs(next(iter(remote.snapshots.values())).position[0]) < 0.1)
    remote.pause(False)
    for refused in (lambda: remote.lift(1.0), lambda: remote.heel(0.5),
                    lambda: remote.set_pace(0.5)):
        with pytest.raises(ValueError, match='a running node'):
            refused()


def test_the_thrust_that_others_ask_for_is_shown_as_long_as_it_acts():
    thrusters = {'thrusters.names': ['left', 'right'],
                 'thrusters.positions': [-1.5, 0.8, -0.4, -1.5, -0.8, -0.4],
                 'thrusters.limits': [-300.0, 300.0, -1e15, 1e15]}
    with BoatProcess(thrusters) as boat, Probe(boat.namespace) as probe:
        remote = Remote(['-r', f'__ns:={boat.namespace}'])
        left, turn, right = (probe.publisher(Float64, f'thrusters/{part}')
                             for part in ('left/thrust', 'left/pos', 'right/thrust'))
        wrench = probe.publisher(WrenchStamped, 'thrust')
        asked = WrenchStamped()
        asked.wrench.force.y = 200.0

        def send():
            left.publish(Float64(data=500.0))
            turn.publish(Float64(data=math.pi / 2.0))
            wrench.publish(asked)

        def shown():
            return [(place, pytest.approx(force, abs=1e-9)) for place, force in next(
                iter(remote.snapshots.values())).pushes]
        places = (-1.5, 0.8, -0.4), (-1.5, -0.8, -0.4)
        idle = [(place, (0.0, 0.0, 0.0)) for place in places]
        try:
            assert remote.wait(20.0)
            until(lambda: remote.snapshots)
            assert shown() == idle
            # The one on the left is turned to port, at its limit; the wrench is at the origin.
            probe.until(lambda: shown() == [
                (places[0], (0.0, 300.0, 0.0)), idle[1], ((0.0, 0.0, 0.0), (0.0, 200.0, 0.0))],
                doing=send)
            # A wrench in world axes keeps its direction; what is refused replaces nothing.
            remote.reset()
            until(lambda: shown() == idle)
            asked.header.frame_id = 'odom'
            too_large = WrenchStamped()
            too_large.wrench.force.x = 1e300

            # In turn: only the last that came is kept until it is looked at.
            in_turn = itertools.cycle([asked, too_large])

            def send_both():
                wrench.publish(next(in_turn))
                right.publish(Float64(data=1e300))

            def in_the_world():
                snapshot = next(iter(remote.snapshots.values()))
                return [(snapshot.turn @ force).tolist() for _, force in snapshot.pushes]
            probe.until(lambda: in_the_world() == [
                [0.0] * 3, [0.0] * 3, pytest.approx([0.0, 200.0, 0.0], abs=1e-6)], doing=send_both)
            # Nor is what the node forgets.
            asked.wrench.force.y = math.nan
            probe.until(lambda: shown() == idle, doing=lambda: wrench.publish(asked))
            assert remote.fault is None
        finally:
            remote.stop()


def test_a_node_that_goes_away_and_comes_back_is_shown_as_such():
    namespace = new_namespace()
    with BoatProcess(WAVES, namespace=namespace) as boat:
        remote = Remote(['-r', f'__ns:={namespace}'])
        try:
            assert remote.wait(20.0)
            until(lambda: remote.snapshots)
            begun = remote.begun
            assert boat.end(signal.SIGINT) == 0
            until(lambda: remote.fault)
            assert remote.fault == (f'{namespace}/boat_buoyancy is gone; it is shown again when '
                                    'it comes back')
            assert remote.snapshots == {}
            with BoatProcess({**WAVES, 'boat.mass': 1900.0}, namespace=namespace):
                until(lambda: remote.fault is None and remote.snapshots)
                until(lambda: remote.scene.boat.mass == 1900.0)
                assert remote.begun != begun
        finally:
            remote.stop()


def test_of_two_nodes_the_pushed_one_is_let_go_when_the_page_turns_to_the_other():
    # They would hold a push for ever.
    held = {'thrust.timeout': 0.0}
    with (BoatProcess(held) as one, BoatProcess({**held, 'boat.mass': 1900.0}) as two,
          Probe(one.namespace) as probe):
        thrusts, others = (probe.listen(WrenchStamped, f'{boat.namespace}/thrust', BEST_EFFORT)
                           for boat in (one, two))
        names = [boat.namespace.strip('/') for boat in (one, two)]
        remote = Remote(['-r', f'__ns:={one.namespace}'])
        try:
            assert remote.wait(20.0)
            until(lambda: list(remote.snapshots) == names)
            probe.until(lambda: thrusts, doing=lambda: remote.push(500.0, 0.0))
            remote.push(500.0, 0.0)
            remote.switch(two.namespace)
            assert remote.scene.boat.mass == 1900.0 and list(remote.snapshots) == names[::-1]
            probe.until(lambda: thrusts[-1].wrench.force.x == 0.0)
            probe.until(lambda: others, doing=lambda: remote.push(500.0, 0.0))
            assert others[-1].wrench.force.x == 500.0
        finally:
            remote.stop()
        probe.until(lambda: others[-1].wrench.force.x == 0.0)


def test_news_that_cannot_be_read_are_said_until_it_can_be_again(seen):
    boat, remote = seen
    with Probe(boat.namespace) as probe:
        waves = probe.node.create_publisher(Float64MultiArray, f'{boat.namespace}/waves', LATCHED)
        probe.until(waves.get_subscription_count)
        for data in ([0.2, 4.0, 0.3], [0.2, -4.0, 0.3, 1.0]):
            waves.publish(Float64MultiArray(data=data))
            sentence = until(lambda: remote.fault)
            assert sentence.startswith(f'{boat.namespace}/boat_buoyancy: waves: ')
            assert remote.snapshots == {} and remote.troubles == {sentence}
            waves.publish(Float64MultiArray(data=[0.1, 5.0, 0.3, 1.0]))
            until(lambda: remote.fault is None and remote.snapshots)
        snapshot = next(iter(remote.snapshots.values()))
        assert snapshot.water.waves.tolist() == [[0.1, 5.0, 0.3, 1.0]]
    assert not remote.ended.done()


def test_what_ends_the_listening_ends_the_program(monkeypatch):
    monkeypatch.setattr(Remote, '_look', lambda _: 1 / 0)
    remote = Remote([])
    try:
        with pytest.raises(ZeroDivisionError):
            remote.ended.result(20.0)
    finally:
        remote.stop()


def test_a_boat_that_cannot_be_made_here_is_said_while_the_program_looks_for_one(
        monkeypatch, capfd):
    def refuse(*_):
        raise ValueError('hull.mesh: no such file')
    monkeypatch.setattr(remote_boat, 'scene_from_values', refuse)
    told = threading.Event()
    with BoatProcess({}) as boat:
        looking = threading.Thread(
            target=lambda: main.found(['-r', f'__ns:={boat.namespace}'], told).stop())
        looking.start()
        # Two looks more, at which nothing is said again.
        said = []
        try:
            until(lambda: said.append(capfd.readouterr().err) or any(said))
            time.sleep(2.5)
        finally:
            told.set()
            looking.join()
    said.append(capfd.readouterr().err)
    assert ''.join(said) == (f'buoyancy_view: {boat.namespace}/boat_buoyancy: parameters: '
                             'hull.mesh: no such file\n')


def test_arguments_that_ros_does_not_take_are_refused():
    with pytest.raises(ValueError, match='^--ros: '):
        Remote(['-r', 'nonsense'])
    with pytest.raises(ValueError, match='^--port: what follows --ros is for ROS; give it before'):
        main.found(['-r', '__ns:=/red', '--port', '0'], threading.Event())
