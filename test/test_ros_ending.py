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

"""The node ends when it is told to, and says what keeps it from starting."""

import signal
import time

from boat_buoyancy.physics.compiled import cache_folder, numba
import pytest
from ros_probe import BoatProcess, run_and_end


# A shutdown that hangs in the middleware, with Python's lock held; one of 390 was seen to.
HANGING = """
import ctypes, sys
from boat_buoyancy.ros.node import BoatNode, main
BoatNode.destroy_node = lambda self: ctypes.PyDLL(None).sleep(60)
sys.exit(main())
"""


@pytest.mark.parametrize('signals', [
    [signal.SIGTERM], [signal.SIGINT] * 3, [signal.SIGTERM, signal.SIGINT, signal.SIGTERM]])
def test_it_ends_with_0_and_without_a_traceback_on_signals(signals):
    with BoatProcess() as boat:
        boat.wait_for_log('draft')
        assert boat.end(*signals) == 0
        assert 'Traceback' not in boat.log and 'rror' not in boat.log


@pytest.mark.parametrize('second', [signal.SIGINT, signal.SIGTERM])
def test_a_second_signal_ends_it_at_once_where_the_middleware_hangs(second):
    with BoatProcess(script=HANGING) as boat:
        boat.wait_for_log('draft')
        boat.process.send_signal(signal.SIGINT)
        time.sleep(1.0)
        assert boat.alive
        assert boat.end(second, timeout=1.0) == -second


@pytest.mark.skipif(numba() is None, reason='Numba is not there')
def test_a_second_signal_ends_it_at_once_while_the_step_is_compiled(tmp_path):
    with BoatProcess(environment={'NUMBA_CACHE_DIR': str(tmp_path)}) as boat:
        boat.wait_for_log('compiling the step')
        boat.process.send_signal(signal.SIGINT)
        # More than what counts as one request, less than compiling takes.
        time.sleep(0.6)
        assert boat.alive
        assert boat.end(signal.SIGINT, timeout=1.0) == -signal.SIGINT


def test_a_home_that_cannot_be_written_is_one_line_that_says_what_to_set(tmp_path, monkeypatch):
    monkeypatch.setenv('NUMBA_CACHE_DIR', str(cache_folder().parent))
    monkeypatch.delenv('ROS_LOG_DIR', raising=False)
    monkeypatch.delenv('ROS_HOME', raising=False)
    (tmp_path / 'a_file').write_text('')
    # A folder under a file cannot be made, by root neither.
    monkeypatch.setenv('HOME', str(tmp_path / 'a_file' / 'home'))
    (status, lines), = run_and_end([[]])
    assert (status, len(lines)) == (2, 1) and 'set ROS_LOG_DIR to a folder' in lines[0]
    monkeypatch.setenv('ROS_LOG_DIR', str(tmp_path))
    (status, lines), = run_and_end([[]], seconds=1.0)
    assert status == 0 and any('draft' in line for line in lines)
