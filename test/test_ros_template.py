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

"""Messages that are written over as bytes are those that ROS itself would have made."""

from array import array
import math

from boat_buoyancy.ros.messages import pose_of, stamp_of
from boat_buoyancy.ros.template import Template
from nav_msgs.msg import Odometry
import numpy as np
import pytest
from rclpy.serialization import deserialize_message
from std_msgs.msg import Float64MultiArray
from visualization_msgs.msg import Marker


@pytest.mark.parametrize('frame', ['', 'a', 'odom', 'base_link', 'a/long name \u00e9 ' * 9])
def test_numbers_land_in_their_fields_whatever_the_lengths_of_the_strings(frame):
    message = Odometry(child_frame_id=frame)
    message.header.frame_id = frame
    message.pose.covariance[7] = 0.25
    template = Template(message)
    stamp = stamp_of(template, message.header.stamp)
    pose = pose_of(template, message.pose.pose)
    for seconds, numbers in ((-2 ** 31, [math.inf, -0.0, 1e-320, 1.0, 2.0, 3.0, 4.0]),
                             (2 ** 31 - 1, [-1.0, -2.0, -3.0, 0.5, 0.5, -0.5, 0.5])):
        stamp(seconds, 999_999_999)
        pose(*numbers)
        read = deserialize_message(template.content(), Odometry)
        place, turned = read.pose.pose.position, read.pose.pose.orientation
        assert [place.x, place.y, place.z, turned.x, turned.y, turned.z, turned.w] == numbers
        assert (read.header.stamp.sec, read.header.stamp.nanosec) == (seconds, 999_999_999)
        # And what no place was made for is as it was given.
        assert (read.header.frame_id, read.child_frame_id) == (frame, frame)
        assert read.pose.covariance[7] == 0.25 and read.twist.twist.linear.x == 0.0


@pytest.mark.parametrize('count', [1, 2, 5, 1000])
def test_a_block_is_the_whole_list(count):
    message = Float64MultiArray(data=[0.0] * count)

    def put(values):
        message.data = array('d', values)
    template = Template(message)
    write = template.block((count,), put)
    values = np.random.default_rng(1).normal(size=count)
    write(values)
    assert deserialize_message(template.content(), Float64MultiArray).data == array('d', values)


def test_what_was_published_is_not_changed_by_what_comes_after():
    message = Odometry()
    template = Template(message)
    stamp = stamp_of(template, message.header.stamp)
    stamp(1, 2)
    first = template.content()
    stamp(3, 4)
    assert deserialize_message(first, Odometry).header.stamp.sec == 1


def test_a_place_that_is_not_in_the_message_is_an_error():
    write = Template(Marker()).numbers('ii', lambda *numbers: None)
    with pytest.raises(RuntimeError, match='expected 8 bytes once .* found them 0 times'):
        write(1, 2)


def test_an_array_of_another_size_is_an_error_and_changes_nothing():
    message = Float64MultiArray(data=[0.0] * 4)

    def put(values):
        message.data = array('d', values)
    template = Template(message)
    write = template.block((4,), put)
    write([1.0, 2.0, 3.0, 4.0])
    for wrong in ([1.0] * 3, [1.0] * 5):
        with pytest.raises(ValueError):
            write(wrong)
    read = deserialize_message(template.content(), Float64MultiArray)
    assert read.data.tolist() == [1.0, 2.0, 3.0, 4.0]
