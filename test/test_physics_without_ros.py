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

"""The physics needs NumPy and PyYAML, the tools no ROS."""

from importlib.util import find_spec
import subprocess
import sys

import pytest

ROS = ('rclpy', 'rcl_interfaces', 'rosidl_runtime_py', 'ament_index_python', 'geometry_msgs',
       'std_msgs', 'nav_msgs', 'sensor_msgs', 'std_srvs', 'diagnostic_msgs', 'rosgraph_msgs',
       'visualization_msgs', 'builtin_interfaces', 'launch', 'launch_ros')
# Imports every module of a package with the modules named blocked, and runs what is asked.
IMPORT_ALL = """
import importlib
import pkgutil
import sys


class Blocked:
    def find_spec(self, name, path=None, target=None):
        if name.partition('.')[0] in {blocked!r}:
            raise ImportError(name + ' is blocked', name=name)


sys.meta_path.insert(0, Blocked())
package = importlib.import_module({package!r})
found = [module.name for module in pkgutil.walk_packages(package.__path__, {package!r} + '.')
         if module.name not in {apart!r}]
for name in found:
    importlib.import_module(name)
    print(name)
{then}
"""


# What `buoyancy_view --ros` imports, and nothing else does.
OF_ROS = tuple(f'boat_buoyancy.tools.view.{name}'
               for name in ('remote', 'remote_boat', 'remote_thrust'))
# The page itself, where the extra that draws it is not there.
PAGE = () if find_spec('viser') else (
    'boat_buoyancy.tools.view.page', 'boat_buoyancy.tools.view.stage')


def imported(package, blocked, then=''):
    done = subprocess.run(
        [sys.executable, '-c', IMPORT_ALL.format(package=package, blocked=blocked, then=then,
                                                 apart=OF_ROS + PAGE)],
        capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_every_module_of_the_physics_is_imported_without_ros_and_any_extra():
    modules = imported('boat_buoyancy.physics',
                       ROS + ('numba', 'scipy', 'matplotlib', 'PIL', 'hypothesis'),
                       'from boat_buoyancy.physics import load_scene\n'
                       'sim = load_scene({}).simulation()\n'
                       'sim.step()\nassert sim.time == 0.01')
    assert {'boat_buoyancy.physics.scene.scene',
            'boat_buoyancy.physics.stepping.simulation'} <= set(modules)


def test_every_tool_is_imported_without_ros():
    modules = imported('boat_buoyancy.tools', ROS)
    assert {'boat_buoyancy.tools.report', 'boat_buoyancy.tools.simulate',
            'boat_buoyancy.tools.chart.main'} <= set(modules)


def test_a_blocked_module_is_seen():
    with pytest.raises(AssertionError, match='numpy is blocked'):
        imported('boat_buoyancy.physics', ('numpy',))
