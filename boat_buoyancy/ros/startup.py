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

"""Starting the node: what can be wrong before it runs, said in one line."""

from contextlib import contextmanager
import os
import sys
import warnings

from rclpy.executors import SingleThreadedExecutor
from rclpy.utilities import remove_ros_args

from ..physics.scene import parameter_file

try:
    from rclpy.experimental.events_executor import EventsExecutor
except ImportError:  # early releases of Jazzy
    EventsExecutor = None

PROGRAM = 'buoyancy_node'


def executor():
    """Return the executor that costs least; see doc/ros_speed.md."""
    return SingleThreadedExecutor() if EventsExecutor is None else EventsExecutor()


def parameter_files(arguments):
    """Return the paths that follow --params-file."""
    return [path for option, path in zip(arguments, arguments[1:]) if option == '--params-file']


USAGE = (f'usage: {PROGRAM} [--ros-args [--params-file FILE] [-p NAME:=VALUE] '
         '[-r __ns:=/NAME] ...]\n\n'
         'Floats one boat: that of a parameter file as config/barge.yaml, or the default one.\n'
         'config/default.yaml says what every parameter means, as does ros2 param describe.\n\n'
         f'Example: {PROGRAM} --ros-args --params-file config/barge.yaml\n'
         'Exit code: 0 when told to end; 2 after one line that says what is wrong.')


def folder_of(arguments, name, value):
    """Return the folder of the parameter file that gives a parameter its value, or '.'."""
    for path in reversed(parameter_files(arguments)):
        try:
            if parameter_file.read(path).get(name) == value:
                return os.path.dirname(path) or '.'
        except ValueError:  # a file without a section that reads as ours
            continue
    return '.'


def check_arguments(arguments):
    """
    Return True when the arguments ask for help; ValueError for one that nothing looks at.

    ``arguments`` as of the command line, the program first.
    """
    own = remove_ros_args(arguments)[1:]
    if {'-h', '--help'} & set(own):
        return True
    if own:
        raise ValueError(f'expected arguments after --ros-args only, as --ros-args --params-file '
                         f'config/barge.yaml, got {" ".join(own)}')
    return False


def check_files(arguments):
    """
    Raise ValueError for a parameter file that rcl would refuse in words of its own, or misread.

    A file without a section for a node of our name is left to rcl, which knows what this node
    is really called.
    """
    for path in parameter_files(arguments):
        try:
            parameter_file.read(path)
        except ValueError as error:
            if parameter_file.FORM not in str(error):
                raise


def check_time(values, use_sim_time):
    """Raise ValueError for parameters that ask for two clocks at once."""
    if not use_sim_time:
        return
    if values['publish_clock']:
        raise ValueError('publish_clock: expected false because use_sim_time is true, got true: '
                         'a node cannot follow /clock and be its source')
    if values['time_factor'] != 1.0:
        raise ValueError(f'time_factor: expected 1.0 because use_sim_time is true, got '
                         f'{values["time_factor"]:g}: /clock sets the pace')


def remarks(node, given, values):
    """Return sentences about parameters that were surely not meant so."""
    sentences, files = [], parameter_files(sys.argv)
    if files and not given:
        sentences.append(
            f'no parameter of {", ".join(files)} is for {node.get_fully_qualified_name()}: the '
            'defaults are in force. Write "/**:" above "ros__parameters:", or this name')
    if values['time_factor'] != 1.0 and not values['publish_clock']:
        sentences.append(
            f'time_factor is {values["time_factor"]:g} and publish_clock is false: the stamps '
            'leave wall time, and nobody is told; set publish_clock to true')
    return sentences


@contextmanager
def warnings_said(say):
    """Call ``say`` with each of Python's warnings, which it would print with lines of source."""
    with warnings.catch_warnings(record=True) as caught:
        try:
            yield
        finally:
            for warning in caught:
                say(' '.join(str(warning.message).split()))


@contextmanager
def quiet_stderr():
    """Keep rcl from printing in its own words what is printed in one line afterwards."""
    sys.stderr.flush()
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)


def one_line(error, program=PROGRAM):
    """Return an exception as one line of a program for standard error."""
    # rcl adds where in its source it noticed.
    text = ' '.join(str(error).split()).partition(', at /')[0] or repr(error)
    if 'failed to initialize logging' in text:
        text += '; set ROS_LOG_DIR to a folder that can be written'
    if 'Sequence should be of same type' in text:
        text += '; write all numbers of a list with a decimal point or all without'
    return f'{program}: {text}'
