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

from glob import glob

from setuptools import find_packages, setup

package_name = 'boat_buoyancy'

setup(
    name=package_name,
    version='0.2.0',
    packages=find_packages(include=[package_name, package_name + '.*']),
    package_data={package_name: ['py.typed'], package_name + '.ros': ['fast_dds.xml'],
                  package_name + '.tools.chart': ['responses/*.json']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/config',
         sorted(glob('config/*.yaml') + glob('config/*.rviz'))),
        ('share/' + package_name + '/config/hulls', sorted(glob('config/hulls/*.*'))),
        ('share/' + package_name + '/launch', sorted(glob('launch/*.py') + glob('launch/*.yaml'))),
        ('share/' + package_name + '/examples',
         sorted(glob('examples/*.py') + glob('examples/*.yaml'))),
    ],
    python_requires='>=3.10',
    install_requires=['numpy>=1.26', 'pyyaml'],
    extras_require={
        # ROS 2 Jazzy for a machine without ROS; one with ROS needs none of these.
        'ros': ['ros-jazzy-rclpy', 'ros-jazzy-common-interfaces', 'ros-jazzy-rmw-fastrtps-cpp'],
        'chart': ['matplotlib', 'scipy'],
        # Compiles the step; without it everything works, slower.
        'fast': ['numba'],
        # Reads hulls from mesh files.
        'mesh': ['trimesh'],
        # Computes added mass and damping by a boundary element method.
        'bem': ['capytaine>=3.0'],
        # Writes recordings; MCAP's own reader reads them back in the tests.
        'bag': ['rosbags'],
        # The page of buoyancy_view.
        'view': ['viser>=1.1'],
        'test': ['distributed', 'hypothesis', 'matplotlib', 'mcap-ros2-support', 'pytest',
                 'pytest-xdist', 'rosbags', 'scipy', 'trimesh'],
    },
    zip_safe=False,
    maintainer='boat_buoyancy maintainers',
    maintainer_email='maintainers@users.noreply.h-seed-4fa897fd.example',
    description='Floats boats: a fixed-rate buoyancy node, and its physics as a library.',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'buoyancy_node = boat_buoyancy.ros.main:main',
            'same_sea = boat_buoyancy.ros.same_sea:main',
            'buoyancy_report = boat_buoyancy.tools.report:main',
            'buoyancy_simulate = boat_buoyancy.tools.simulate:main',
            'buoyancy_hydrodynamics = boat_buoyancy.tools.hydrodynamics:main',
            'buoyancy_chart = boat_buoyancy.tools.chart.main:main',
            'buoyancy_view = boat_buoyancy.tools.view.main:main',
        ],
    },
)
