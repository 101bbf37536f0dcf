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

"""The program `buoyancy_node`, which also says what to do where ROS 2 is not to be had."""

import sys


def main():
    """Run the node and return its exit status."""
    try:
        from .node import main as run
    except ImportError as error:
        if (error.name or '').startswith('boat_buoyancy'):
            raise
        print(f'buoyancy_node: needs ROS 2 Jazzy ({" ".join(str(error).split())}): source '
              '/opt/ros/jazzy/setup.bash, or run ./install.sh ros', file=sys.stderr)
        return 2
    except KeyboardInterrupt:  # before the node can listen to it
        return 0
    return run()


if __name__ == '__main__':
    sys.exit(main())
