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

"""A program whose extra is not installed says in one line which one it misses."""

from pathlib import Path

from boat_buoyancy.tools import command_line
from programs import without
import pytest

SCENE = str(Path(__file__).parents[1] / 'config' / 'default.yaml')
SIMULATE, CHART = 'boat_buoyancy.tools.simulate', 'boat_buoyancy.tools.chart.main'
REPORT, VIEW = 'boat_buoyancy.tools.report', 'boat_buoyancy.tools.view.main'
RUN = [SCENE, '--duration', '0.1']
# What the extra brings: Pillow comes with Matplotlib.
BROUGHT = ('matplotlib', 'PIL', 'scipy')


@pytest.mark.parametrize('module, words, needs', [
    (SIMULATE, [*RUN, '--plot', 'a.png'], '--plot needs matplotlib '),
    (SIMULATE, [*RUN, '--animate', 'a.gif'], '--animate needs matplotlib '),
    (REPORT, [SCENE, '--plot', 'a.png'], '--plot needs matplotlib '),
    (CHART, ['--speed'], 'a chart needs matplotlib and scipy '),
    (CHART, [SCENE, '--tolerance', '0.01'], 'a chart needs matplotlib and scipy ')])
def test_what_needs_the_extra_chart_says_so_in_one_line(module, words, needs):
    done = without(BROUGHT, module, words)
    assert done.returncode == 2 and done.stdout == '' and done.stderr.count('\n') == 1
    assert needs in done.stderr
    assert ': ./install.sh chart, or pip install "boat_buoyancy[chart]"' in done.stderr


@pytest.mark.parametrize('module, words', [
    (SIMULATE, RUN), (CHART, ['--help']), (REPORT, [SCENE])])
def test_what_does_not_need_it_runs_all_the_same(module, words):
    done = without(BROUGHT, module, words)
    assert done.returncode == 0, done.stderr


def test_the_page_says_in_one_line_what_it_needs():
    done = without(('viser',), VIEW, [SCENE, '--port', '0', '--no-open'])
    assert done.returncode == 2 and done.stdout == '' and done.stderr.count('\n') == 1
    assert 'the page needs viser ' in done.stderr
    assert done.stderr.endswith(': ./install.sh view, or pip install "boat_buoyancy[view]"\n')


def test_the_page_of_running_nodes_says_in_one_line_that_it_needs_ros():
    done = without(('rclpy', 'geometry_msgs'), VIEW, ['--port', '0', '--ros'])
    # Where viser is missing, too, that is said first.
    assert done.returncode == 2 and done.stdout == '' and done.stderr.count('\n') == 1
    assert '--ros needs ROS 2 Jazzy ' in done.stderr or 'needs viser ' in done.stderr


def test_only_what_is_missing_is_named():
    with pytest.raises(ValueError, match=r"^--plot needs no_such \(No module named 'no_such'\): "
                       r'\./install\.sh view, or pip install "boat_buoyancy\[view\]", or on '
                       r'Ubuntu apt install python3-no_such$'):
        command_line.require_extra('view', '--plot', 'json', 'no_such')
