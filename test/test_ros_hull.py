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

"""The node on a hull of its own: a mesh beside its parameter file, on panels."""

from pathlib import Path
import shutil

from boat_buoyancy.physics import load_scene
import pytest
from ros_probe import BoatProcess, Probe
from std_msgs.msg import Float64MultiArray
from visualization_msgs.msg import Marker, MarkerArray

CONFIG = Path(__file__).parents[1] / 'config'


@pytest.fixture(scope='module')
def boat(tmp_path_factory):
    """Start the rigid inflatable, copied with its mesh to a folder that is not the node's."""
    folder = tmp_path_factory.mktemp('boat')
    shutil.copy(CONFIG / 'rib.yaml', folder / 'rib.yaml')
    shutil.copytree(CONFIG / 'hulls', folder / 'hulls')
    with BoatProcess({'status_period': 0.0, 'sea.transition': 0.2},
                     arguments=('--params-file', str(folder / 'rib.yaml'))) as process:
        yield process


@pytest.fixture(scope='module')
def probe(boat):
    """Look at it with one probe."""
    with Probe(boat.namespace) as one:
        yield one


def test_the_first_line_says_which_hull_it_is_on_how_many_panels(boat):
    boat.wait_for_log('rib.stl of 465 kg on 518 panels of at most 1.1 m: draft 0.236 m')


def test_it_lies_as_the_library_says(boat, probe):
    poses = probe.listen_to_boat()[0]
    probe.until(lambda: len(poses) > 5)
    run = load_scene(CONFIG / 'rib.yaml').simulation().run(0.01)
    assert poses[-1].pose.position.z == pytest.approx(run.position[0, 2], abs=1e-6)


def test_markers_show_the_mesh(probe):
    arrays = probe.listen(MarkerArray, 'markers')
    probe.until(lambda: arrays)
    hull = arrays[-1].markers[0]
    assert hull.type == Marker.TRIANGLE_LIST and len(hull.points) == 3 * 518


def test_short_waves_are_said_to_be_met_by_more_panels(boat, probe):
    publisher = probe.publisher(Float64MultiArray, 'wave_parameters')
    publisher.publish(Float64MultiArray(data=[0.05, 1.2, 0.0, 0.0]))
    boat.wait_for_log('waves: 1 in force, on ')
    # An eighth of 2.25 m.
    line = next(line for line in boat.log.splitlines() if 'waves: 1 in force' in line)
    assert 'panels of at most 0.28 m' in line or 'panels of at most 0.27 m' in line
    poses = probe.listen_to_boat()[0]
    probe.until(lambda: len(poses) > 100)
    assert abs(poses[-1].pose.position.z) < 0.5


def test_a_mesh_that_is_not_there_is_one_line_that_names_it(tmp_path):
    with BoatProcess({'hull.shape': 'mesh', 'hull.mesh': str(tmp_path / 'no.stl')}) as process:
        process.wait_for_log('cannot be read')
        assert process.end() == 2
        assert len(process.lines) == 1 and 'hull.mesh: ' in process.log
