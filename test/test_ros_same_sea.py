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

"""Boats that are to be in one sea: whether they are is watched and said."""

import os
import signal
import subprocess
import sys

from boat_buoyancy.ros.same_sea import SameSea
from ros_probe import BoatProcess, Probe, ROOT
from std_msgs.msg import Float64MultiArray

BOATS = ['/red/boat_buoyancy', '/blue/boat_buoyancy']


def test_two_seas_are_said_once_after_a_while_and_one_again():
    red, blue = BOATS
    watch = SameSea(BOATS)
    assert watch.take(red, 'a', 0.0) == '' and watch.take('/green/boat_buoyancy', 'b', 0.5) == ''
    # A new sea that comes to one before the other is none of our business.
    assert watch.take(blue, 'b', 1.0) == '' and watch.take(red, 'b', 2.0) == ''
    assert watch.take(red, 'a', 10.0) == watch.take(red, 'a', 12.9) == ''
    said = watch.take(blue, 'b', 13.0)
    assert said.startswith(f'the boats are not in one sea ({red} a, {blue} b): ')
    assert watch.take(red, 'a', 20.0) == ''
    assert watch.take(blue, 'a', 21.0) == 'the boats are in one sea again'
    assert watch.take(red, 'a', 22.0) == ''


def watching(*boats, **environment):
    """Start the program."""
    return subprocess.Popen(
        [sys.executable, '-m', 'boat_buoyancy.ros.same_sea', *boats], cwd=ROOT, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, **environment})


def test_waves_that_only_one_of_two_boats_hears_are_warned_of():
    with BoatProcess({'status_period': 0.0}) as red, BoatProcess({'status_period': 0.0}) as blue, \
            Probe(red.namespace) as one:
        names = [f'{boat.namespace}/boat_buoyancy' for boat in (red, blue)]
        watch = watching(*names)
        try:
            one.publisher(Float64MultiArray, 'wave_parameters').publish(
                Float64MultiArray(data=[0.1, 4.0, 0.0, 0.0]))
            line = watch.stderr.readline()
            assert 'the boats are not in one sea' in line and names[0] in line and '-w 2' in line
            watch.send_signal(signal.SIGINT)
            assert watch.wait(5.0) == 0
        finally:
            watch.kill()
            watch.communicate()


def test_names_that_are_none_are_one_line():
    for words in ((), BOATS[:1], ('red', 'blue'), (*BOATS, BOATS[0]), ('--bogus', *BOATS)):
        watch = watching(*words)
        _, said = watch.communicate(timeout=10.0)
        assert watch.returncode == 2 and said.count('\n') == 1
        assert said.startswith('same_sea: expected the full names of two nodes or more, each once')


def test_a_home_that_cannot_be_written_is_one_line(tmp_path):
    (tmp_path / 'a_file').write_text('')
    # A folder under a file cannot be made, by root neither.
    watch = watching(*BOATS, ROS_LOG_DIR='', ROS_HOME='', HOME=str(tmp_path / 'a_file' / 'home'))
    _, said = watch.communicate(timeout=10.0)
    assert watch.returncode == 2 and said.count('\n') == 1
    assert said.startswith('same_sea: ') and 'set ROS_LOG_DIR to a folder' in said


def test_help_says_how_to_start_it():
    for word in ('-h', '--help'):
        watch = watching(word)
        said, wrong = watch.communicate(timeout=10.0)
        assert watch.returncode == 0 and wrong == ''
        assert said.startswith('usage: same_sea /red/boat_buoyancy')
