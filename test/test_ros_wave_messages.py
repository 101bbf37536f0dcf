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

"""What a wave message becomes: the sea that the boat floats on, or a refusal."""

from array import array
import math
import re
import time

from boat_buoyancy.physics.sea.waves import Sea
from boat_buoyancy.ros.complaints import Refused
from boat_buoyancy.ros.wave_messages import Duplicates, read_waves, unpack_waves
import numpy as np
import pytest
from rclpy.serialization import serialize_message
from ros_probe import BoatProcess, by_stamp, LATCHED, Probe
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Float64MultiArray, MultiArrayDimension, MultiArrayLayout


@pytest.fixture(scope='module')
def boat():
    """Start the default boat once."""
    with BoatProcess({'status_period': 0.0}) as process:
        yield process


@pytest.fixture(scope='module')
def probe(boat):
    """Look at it with one probe, which can ask for waves."""
    with Probe(boat.namespace) as one:
        one.poses = one.listen_to_boat()[0]
        one.waves = one.listen(Float64MultiArray, 'waves', LATCHED)
        one.until(lambda: one.poses and one.waves)
        yield one


@pytest.fixture
def ask(probe):
    """Return a function that asks for rows of waves; in the end for flat water."""
    publisher = probe.publisher(Float64MultiArray, 'wave_parameters')

    def publish(rows):
        publisher.publish(Float64MultiArray(data=rows))
    yield publish
    publish([])
    probe.until(lambda: len(probe.waves[-1].data) == 0)


@pytest.mark.parametrize('rows, kind, said', [
    ([0.1, 4.0, 0.0], 'wrong length', 'four numbers a row, got 3 numbers'),
    ([0.1, 4.0, 0.0, 0.0, math.nan, 4.0, 0.0, 0.0], 'not finite',
     'row 2 is [nan, 4.0, 0.0, 0.0]'),
    ([-0.1, 4.0, 0.0, 0.0], 'out of range', 'expected an amplitude of 0 to'),
    ([0.1, 0.0, 0.0, 0.0], 'out of range', 'expected a period of'),
    ([0.1, 4.0, 0.0, 0.0] * 1001, 'too many rows', 'expected at most 1000 rows, got 1001')])
def test_bad_waves_are_refused_with_the_reason(rows, kind, said):
    with pytest.raises(Refused, match=re.escape(said)) as raised:
        read_waves(array('d', rows))
    assert raised.value.kind == kind
    assert str(raised.value).startswith('wave_parameters: ')


def laid_out(count, sizes, strides=(), offset=0):
    """Return a serialised message of so many numbers with a layout."""
    strides = strides or [0] * len(sizes)
    return serialize_message(Float64MultiArray(
        data=[0.1, 4.0, 0.0, 0.0] * (count // 4), layout=MultiArrayLayout(
            dim=[MultiArrayDimension(size=size, stride=stride)
                 for size, stride in zip(sizes, strides)], data_offset=offset)))


@pytest.mark.parametrize('layout', [([],), ([8],), ([2, 4],), ([2, 4], [8, 4]), ([8], [8])])
def test_a_layout_of_rows_is_taken(layout):
    assert len(unpack_waves(laid_out(8, *layout))) == 8


@pytest.mark.parametrize('layout', [
    ([4, 2],), ([2, 4], [4, 8]), ([2, 4], [8, 2]), ([2, 4], [8, 4], 1), ([3, 4],)])
def test_a_layout_of_anything_but_rows_is_refused(layout):
    with pytest.raises(Refused, match='expected rows of four one after the other, .* got sizes'):
        unpack_waves(laid_out(8, *layout))


def test_a_layout_of_many_dimensions_is_refused_at_once_in_one_short_line():
    # As many as fit into a message of the greatest length; their products of all sizes that
    # follow would take more than 10 s.
    raw = laid_out(8, [2, 2, 2] + [2] * 3500)
    began = time.monotonic()
    with pytest.raises(Refused, match='got 3503 dimensions$') as raised:
        unpack_waves(raw)
    assert time.monotonic() - began < 0.5 and len(str(raised.value)) < 200
    with pytest.raises(Refused, match='got 3 dimensions$'):
        unpack_waves(laid_out(8, [2, 2, 2]))


def test_the_sea_in_force_can_be_sent_back_as_it_comes(probe, ask):
    ask([0.05, 4.0, 0.0, 0.0, 0.1, 3.0, 0.0, 0.0])
    probe.until(lambda: len(probe.waves[-1].data) == 8)
    assert len(unpack_waves(serialize_message(probe.waves[-1]))) == 8


def test_bad_waves_are_refused_whole_and_the_sea_stays(boat, probe, ask):
    good = [0.05, 4.0, 0.0, 0.0]
    ask(good)
    probe.until(lambda: probe.waves[-1].data.tolist() == good)
    count = len(probe.waves)
    ask([*good, math.nan, 4.0, 0.0, 0.0])
    probe.until(lambda: 'row 2 is [nan, 4.0, 0.0, 0.0]' in boat.log)
    assert 'amplitude m, period s, direction rad, phase rad' in boat.log
    assert len(probe.waves) == count


def test_a_wave_that_cannot_run_against_the_current_is_refused_and_the_sea_stays(
        boat, probe, ask):
    good = [0.05, 6.0, 3.0, 0.0]
    ask(good)
    probe.until(lambda: probe.waves[-1].data.tolist() == good)
    assert probe.set_parameters({'sea.current': [1.0, 0.0]})[0].successful
    ask([0.05, 6.0, 0.0, 0.0, 0.05, 2.0, 3.0, 0.0])
    boat.wait_for_log('wave_parameters: row 2 is [0.05, 2.0, 3.0, 0.0], which cannot run against '
                      '0.99 m/s of sea.current')
    assert probe.waves[-1].data.tolist() == good
    assert probe.set_parameters({'sea.current': [0.0, 0.0]})[0].successful


def test_copies_are_told_apart_from_messages_that_are_sent_again():
    copies = Duplicates()
    # a, b, a by both subscriptions, interleaved as they may come.
    seen = [('volatile', b'a'), ('volatile', b'b'), ('latched', b'a'), ('volatile', b'a'),
            ('latched', b'b'), ('latched', b'a')]
    assert [copies.is_copy(*one, 0.1) for one in seen] == [False, False, True, False, True, True]
    # By one subscription alone nothing is a copy; nor is what comes much later.
    assert [copies.is_copy('volatile', b'c', 0.2) for _ in range(3)] == [False] * 3
    assert not copies.is_copy('latched', b'c', 5.0)


def test_waves_lift_the_boat_and_the_sea_in_force_is_shown(probe, ask):
    level = probe.poses[-1].pose.position.z
    rows = [0.3, 3.0, 0.5, 0.25]
    ask(rows)
    probe.until(lambda: probe.waves[-1].data.tolist() == rows)
    probe.until(lambda: max(m.pose.position.z for m in probe.poses) > level + 0.15)
    probe.until(lambda: min(m.pose.position.z for m in probe.poses) < level - 0.15)


def test_waves_that_no_water_could_have_are_warned_of(boat, probe, ask):
    ask([0.05, 0.5, 0.0, 0.0])
    boat.wait_for_log('The waves are steeper than water can be')
    # More of them are not said each time.
    for phase in (0.1, 0.2, 0.3, 0.4):
        rows = [0.05, 0.5, 0.0, phase]
        ask(rows)
        probe.until(lambda: probe.waves[-1].data.tolist() == rows)
    assert boat.log.count('steeper than water can be') == 1


def test_an_ordinary_publisher_is_heard_without_a_warning(boat, probe, ask):
    ask([0.01, 7.0, 0.0, 0.0])
    probe.until(lambda: probe.waves[-1].data.tolist() == [0.01, 7.0, 0.0, 0.0])
    assert 'incompatible' not in boat.log


def test_a_latched_publisher_that_came_first_is_heard():
    rows = [0.2, 5.0, 1.0, 0.5]
    with Probe('/latched_first') as one:
        publisher = one.node.create_publisher(Float64MultiArray, 'wave_parameters', LATCHED)
        publisher.publish(Float64MultiArray(data=rows))
        one.spin(0.2)
        with BoatProcess({'status_period': 0.0}, namespace='/latched_first') as boat:
            waves = one.listen(Float64MultiArray, 'waves', LATCHED)
            one.until(lambda: waves and waves[-1].data.tolist() == rows)
            # Later ones come by both subscriptions and count once.
            for phase in (0.1, 0.2, 0.3):
                publisher.publish(Float64MultiArray(data=[*rows[:3], phase]))
                # It keeps the last one only.
                one.until(lambda: waves[-1].data.tolist() == [*rows[:3], phase])
            one.spin(0.3)
            assert [m.data[3] for m in waves if len(m.data)] == [0.5, 0.1, 0.2, 0.3]
            # What comes one after the other is not said each time.
            assert boat.log.count('waves: 1 in force') == 1
            assert 'incompatible' not in boat.log


def test_two_nodes_started_apart_see_the_same_water_at_the_same_stamp():
    rows = [0.3, 4.0, 0.3, 1.0, 0.1, 2.5, -1.0, 0.2]
    # Without a fade: a node that fell behind takes the sea of its stamp at once.
    sea = {'sea.waves': rows, 'sea.transition': 0.0, 'status_period': 0.0}
    with BoatProcess(sea) as first, Probe(first.namespace) as probe:
        poses, _, _, _ = probe.listen_to_boat()
        clouds = probe.listen(PointCloud2, 'probes')
        probe.until(lambda: poses)
        probe.spin(2.0)
        with BoatProcess(sea) as second:
            others = probe.listen(PointCloud2, f'{second.namespace}/probes')
            probe.until(lambda: len(others) > 100)
    water = Sea(rows)
    for messages in (clouds, others):
        for stamp, message in list(by_stamp(messages).items())[-50:]:
            x, y, z, depth, _ = np.frombuffer(message.data.tobytes(), '<f4').reshape(-1, 5).T
            # The surface over each probe is that of one sea of all stamps.
            expected = water.elevation(x.astype(float), y.astype(float), stamp / 1e9)
            np.testing.assert_allclose(z + depth, expected, atol=2e-6)
