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

"""Set up the environment of every test before anything imports rclpy."""

from importlib.util import find_spec
import os
from pathlib import Path

from hypothesis import settings
from network import may_make_namespaces
import pytest

# This machine only, and a domain of our own: the tests neither hear nor disturb anybody's robots,
# nor another run of the tests. Domains 0 to 101 have ports on every system.
os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
os.environ['ROS_DOMAIN_ID'] = str(1 + os.getpid() % 101)
os.environ.pop('ROS_STATIC_PEERS', None)
# Jazzy sends a wrongly typed field as garbage unless told to check.
os.environ['ROS_PYTHON_CHECK_FIELDS'] = '1'
# Plots are drawn without a display.
os.environ['MPLBACKEND'] = 'Agg'

# A shared or slow machine is not a failure; on CI the same commit tries the same examples.
settings.register_profile('boat_buoyancy', deadline=None, derandomize='CI' in os.environ)
settings.load_profile('boat_buoyancy')

# Only these may be missing: the linters come with ROS or by hand, never with the package. CI
# requires that they ran (.ci/check_junit.py).
_linters = {
    'ament_flake8': 'test_flake8.py',
    'ament_pep257': 'test_pep257.py',
}
_missing = [linter for linter in _linters if find_spec(linter) is None]
collect_ignore = [_linters[linter] for linter in _missing]


# Remote hosts are network namespaces, which not every user and container may make.
_hosts = may_make_namespaces()


def pytest_collection_modifyitems(items):
    """Leave out what cannot be tested here."""
    items[:] = [item for item in items if _hosts or not item.get_closest_marker('namespaces')]


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Keep the tests of a file on one worker, and all ROS tests on one, as they watch rates."""
    # Not by groups: pytest-xdist 3.8 does not tell pytest 9.2 about them.
    from xdist.scheduler import LoadFileScheduling

    class Scheduling(LoadFileScheduling):

        def _split_scope(self, nodeid):
            file = super()._split_scope(nodeid)
            return 'ros' if Path(file).name.startswith('test_ros_') else file

    return Scheduling(config, log)


def pytest_report_header():
    """Say which linters are not installed, and where the node under test listens."""
    lines = ['ROS_DOMAIN_ID: ' + os.environ['ROS_DOMAIN_ID']]
    if _missing:
        lines.append('lint tests left out, not installed: ' + ', '.join(_missing))
    if not _hosts:
        lines.append('tests of several hosts left out: network namespaces cannot be made here')
    return lines


@pytest.fixture(scope='session')
def python_files():
    """Return the path of every Python file of the package, built copies left out."""
    root = Path(__file__).parents[1]
    found = [root / 'setup.py']
    for folder in ('.ci', 'benchmarks', 'boat_buoyancy', 'config', 'doc', 'examples', 'launch',
                   'test'):
        found += sorted((root / folder).rglob('*.py'))
    return [str(path) for path in found]
