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
Start a command that ends in the node, see it run, press Ctrl-C, expect exit 0.

It runs when it has logged two lines under the node's name: the one at start and, some seconds
later, the first of its status lines.
"""

import os
import signal
import subprocess
import sys
import threading
import time

NODE = '[boat_buoyancy]'
LINES = 2
START_TIMEOUT = 900.0  # s; the command may install first
STOP_TIMEOUT = 10.0  # s


def main():
    """Run the command given by the arguments and return the exit status."""
    process = subprocess.Popen(
        sys.argv[1:], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True, start_new_session=True)
    lines = []

    def read():
        for line in process.stdout:
            print('  ' + line, end='', flush=True)
            lines.append(line)

    reader = threading.Thread(target=read, daemon=True)
    reader.start()
    try:
        deadline = time.monotonic() + START_TIMEOUT
        while sum(NODE in line for line in lines) < LINES:
            if process.poll() is not None:
                return fail(f'it ended by itself with {process.returncode}')
            if time.monotonic() > deadline:
                return fail(f'no {LINES} lines with {NODE} in {START_TIMEOUT:.0f} s')
            time.sleep(0.1)
        # To the whole group, as a terminal does.
        os.killpg(process.pid, signal.SIGINT)
        status = process.wait(STOP_TIMEOUT)
        reader.join(STOP_TIMEOUT)
        if status != 0:
            return fail(f'Ctrl-C ended it with {status}, expected 0')
        if any('Traceback' in line for line in lines):
            return fail('it printed a traceback')
        print('ran, and ended with 0 on Ctrl-C')
        return 0
    except subprocess.TimeoutExpired:
        return fail(f'still there {STOP_TIMEOUT:.0f} s after Ctrl-C')
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass


def fail(reason):
    """Print why the check failed and return 1."""
    print(f'{" ".join(sys.argv[1:])}: {reason}', file=sys.stderr)
    return 1


if __name__ == '__main__':
    sys.exit(main())
