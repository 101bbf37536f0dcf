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

"""
The program `same_sea`: warns when boats that are to be in one sea are not.

    same_sea /red/boat_buoyancy /blue/boat_buoyancy

It compares what the boats say of their sea on /diagnostics.
"""

import sys
import time

from diagnostic_msgs.msg import DiagnosticArray
import rclpy
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

from . import network, qos, startup
from .ending import told_to_end
from .figures import SEA

PROGRAM = 'same_sea'
USAGE = (f'usage: {PROGRAM} /red/boat_buoyancy /blue/boat_buoyancy ... [--ros-args ...]\n\n'
         'Warns when boats, given by the full names of their nodes, are not in one sea.\n\n'
         f'Example: {PROGRAM} /red/boat_buoyancy /blue/boat_buoyancy\n'
         'Exit code: 0 when told to end; 2 after one line that says what is wrong.')
CURE = ('whoever sends waves has to wait for all of them (ros2 topic pub --once -w 2), and to one '
        'that came late those of another are to be sent (-r wave_parameters:=/red/waves)')


class SameSea:
    """
    Whether some boats say the same of their seas.

    Main arguments: ``boats``, their nodes' full names.
    """

    GRACE = 3.0  # s; diagnostics come once a second, and a new sea to one boat before the other

    def __init__(self, boats):
        """Know no sea."""
        self._seas, self._since, self._said = dict.fromkeys(boats), None, False

    def take(self, boat, sea, now):
        """Take what a boat says of its sea at ``now`` s; return a sentence that is news, or ''."""
        if boat not in self._seas:
            return ''
        self._seas[boat] = sea
        if len({*self._seas.values()} - {None}) < 2:
            news = 'the boats are in one sea again' if self._said else ''
            self._since, self._said = None, False
            return news
        self._since = now if self._since is None else self._since
        if self._said or now - self._since < self.GRACE:
            return ''
        self._said = True
        seas = ', '.join(f'{name} {sea}' for name, sea in self._seas.items())
        return f'the boats are not in one sea ({seas}): {CURE}'


def named(arguments):
    """Return the boats that the words of a command line name; ValueError when they are none."""
    boats = remove_ros_args(arguments)[1:]
    if len({*boats}) < max(2, len(boats)) or not all(boat.startswith('/') for boat in boats):
        raise ValueError('expected the full names of two nodes or more, each once, as '
                         '/red/boat_buoyancy /blue/boat_buoyancy, '
                         f'got {" ".join(boats) or "none"}')
    return boats


def main():
    """Watch until a signal and return the exit status."""
    with told_to_end() as told:
        return _run(told)


def _run(told):
    """Watch until an event is set and return the exit status."""
    try:
        if {'-h', '--help'} & {*remove_ros_args(sys.argv)}:
            print(USAGE)
            return 0
        watch = SameSea(named(sys.argv))
        network.never_wait()
        with startup.quiet_stderr():
            rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
        node = rclpy.create_node(PROGRAM)
    except Exception as error:
        rclpy.try_shutdown()
        print(startup.one_line(error, PROGRAM), file=sys.stderr)
        return 2

    def take(message):
        for status in message.status:
            sea = next((item.value for item in status.values if item.key == SEA), None)
            if news := watch.take(status.hardware_id, sea, time.monotonic()):
                node.get_logger().warning(news)
    node.create_subscription(DiagnosticArray, '/diagnostics', take, qos.OUTPUT)
    executor = startup.executor()
    executor.add_node(node)
    try:
        while not told.is_set():
            executor.spin_once(0.1)
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())
