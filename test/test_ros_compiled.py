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

"""The node says how its step runs: compiled, about to be compiled, or plain Python and why."""

import os

from boat_buoyancy.physics.compiled import numba
from diagnostic_msgs.msg import DiagnosticArray
import pytest
from ros_probe import BoatProcess, Probe

needs_numba = pytest.mark.skipif(numba() is None, reason='Numba is not there')


def step_of(boat):
    """Return what the diagnostics of a boat call its step."""
    with Probe(boat.namespace) as one:
        arrays = one.listen(DiagnosticArray, '/diagnostics')
        one.until(lambda: any(status.hardware_id.startswith(boat.namespace)
                              for array in arrays for status in array.status))
        step, = {value.value for array in arrays for status in array.status
                 if status.hardware_id.startswith(boat.namespace)
                 for value in status.values if value.key == 'step'}
        return step


@needs_numba
@pytest.mark.parametrize(('cache', 'said'), [
    ('a_folder', 'compiling the step, once for each integrator on this machine'),
    ('a_file', 'compiling the step, up to half a minute at every start')])
def test_what_takes_seconds_is_said_before_it_is_done(tmp_path, cache, said):
    (tmp_path / 'a_file').write_text('')
    with BoatProcess(environment={'NUMBA_CACHE_DIR': str(tmp_path / cache)}) as boat:
        boat.wait_for_log(said)
        assert len(boat.lines) == 1 and '[INFO]' in boat.lines[0]


@needs_numba
def test_a_step_that_was_compiled_before_is_not_spoken_of():
    with BoatProcess() as boat:
        boat.wait_for_log('draft')
        assert 'compiling' not in boat.log and 'draft' in boat.lines[0]
        assert step_of(boat) == 'compiled'


def test_a_numba_that_is_no_good_is_one_warning_in_the_log_and_the_boat_floats_all_the_same(
        tmp_path):
    (tmp_path / 'numba').mkdir()
    (tmp_path / 'numba' / '__init__.py').write_text("__version__ = '0.50.1'")
    path = os.pathsep.join([str(tmp_path), *filter(None, [os.environ.get('PYTHONPATH')])])
    with BoatProcess(environment={'PYTHONPATH': path, 'NUMBA_DISABLE_JIT': '0'}) as boat:
        boat.wait_for_log('draft')
        assert step_of(boat) == 'plain Python'
        warned, loaded, *_ = boat.lines
        assert '[WARN]' in warned and 'Numba 0.50.1 is too old' in warned and 'draft' in loaded
        assert 'RuntimeWarning' not in boat.log
