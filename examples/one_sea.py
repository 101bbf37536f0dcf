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
Put a boat of this host into one sea with the boats of others.

    python3 one_sea.py red      # on one host
    python3 one_sea.py blue     # on another, in the same network

The sea is a function of the stamp time: all that hosts have to agree on is its parameters, below,
and the time, as chrony or ntpd keeps it.  Each host hears the boats of all, here or there, as
/red/pose and /blue/pose; ``same_sea /red/boat_buoyancy /blue/boat_buoyancy``, on any, warns when
they are not in one sea.  What follows the name of a boat is for its node, as -p boat.mass:=900.0.
"""

import os
import sys

SEA = {'sea.sea_state': 3, 'sea.direction': 0.6, 'sea.seed': 7}
BERTHS = {'red': (0.0, 0.0), 'blue': (0.0, 10.0)}  # m, where each starts


def main():
    """Become the node of a boat; return 2 after one line where none is named."""
    boat, *more = sys.argv[1:] or ['']
    if boat not in BERTHS:
        print(f'one_sea: expected the name of a boat, {" or ".join(BERTHS)}, '
              f'got {boat or "none"}', file=sys.stderr)
        return 2
    # Found beyond this machine, by default as well, but not where it is set otherwise.
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'SUBNET')
    given = {**SEA, 'start.position': list(BERTHS[boat])}
    words = [word for name, value in given.items() for word in ('-p', f'{name}:={value}')]
    os.execv(sys.executable, [
        sys.executable, '-m', 'boat_buoyancy.ros.main', '--ros-args', '-r', f'__ns:=/{boat}',
        # New waves and new wind are for all.
        '-r', 'wave_parameters:=/wave_parameters', '-r', 'wind:=/wind', *words, *more])


if __name__ == '__main__':
    sys.exit(main())
