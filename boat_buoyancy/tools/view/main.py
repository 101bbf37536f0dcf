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
Tune a boat while it floats, in a browser: ``buoyancy_view SCENE [--port N] [--no-open]``.

The boat on its water, knobs for its parameters beside it, and what they do.  With ``--ros`` those
that running nodes float.
"""

import argparse
from pathlib import Path
import socket
import sys
from threading import Thread
import webbrowser

from .live_boat import LiveBoat
from .loop import Loop, PICTURES
from .. import command_line
from ...physics.compiled import notice
from ...physics.scene.parameters import NODE_NAME
from ...physics.scene.scene import load_scene
from ...physics.stepping.march import march_by
from ...ros.ending import told_to_end

PROGRAM, HOST, PORT = 'buoyancy_view', '127.0.0.1', 8080


def parser():
    """Return the parser of the program's arguments."""
    arguments = command_line.OneLineParser(
        PROGRAM, 'Tune a boat while it floats: a page with the boat on its water and its knobs '
        'beside it. Ctrl-C ends it.', 'config/waves.yaml', command_line.UNTIL_TOLD)
    option = arguments.add_argument
    option('scene', metavar='SCENE', nargs='?',
           help='parameter file of the boat and its sea, as config/barge.yaml')
    option('--port', metavar='N', type=int, default=PORT,
           help=f'port of the page, 0 = any that is free (default {PORT})')
    option('--host', metavar='ADDRESS', default=HOST,
           help='address to listen on; the default is this machine only, and whoever reaches '
           'another one can push and tune the boat')
    option('--no-open', action='store_true', help='do not open a browser')
    option('--ros', nargs=argparse.REMAINDER, metavar='...',
           help='show the boats of running nodes in place of a SCENE; what follows is for ROS, as '
           '-r __ns:=/red for the one to look at first; options of ours go before it')
    return arguments


def scenes_beside(path):
    """Return {name: path} of the parameter files that come with the package, and of one."""
    return {scene.stem: scene for scene in (*command_line.shipped_scenes(), Path(path))}


def check_port(host, port):
    """Raise ValueError or OSError in one line where a page cannot listen."""
    if not 0 <= port <= 65535:
        raise ValueError(f'--port: expected a number of 0 to 65535, got {port}')
    with socket.socket() as trial:
        trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            trial.bind((host, port))
        except OSError as error:
            raise OSError(f'cannot listen on port {port} of {host}: {error.strerror}; give '
                          'another --port, or --port 0 for any that is free') from None


def work(arguments):
    """Show the page until a signal comes; ValueError, OSError for what is wrong."""
    if (arguments.scene is None) == (arguments.ros is None):
        raise ValueError('expected either a SCENE, as config/waves.yaml, or --ros for running '
                         'nodes')
    if arguments.scene is not None:
        # It is compiled while the boat is made.
        if compiling := notice(march_by(load_scene(arguments.scene).integrator)):
            print(f'{PROGRAM}: {compiling}', file=sys.stderr, flush=True)
        boat = LiveBoat(arguments.scene)
    check_port(arguments.host, arguments.port)
    command_line.require_extra('view', 'the page', 'viser')
    with told_to_end() as told:
        if arguments.scene is not None:
            floating = Loop(boat, scenes_beside(arguments.scene))
            floating.start()
        else:
            floating = found(arguments.ros, told)
        try:
            if not (told.is_set() or floating.ended.done()):
                show(floating, arguments, told)
        finally:
            floating.stop()
    if floating.ended.done():
        floating.ended.result()


def found(arguments, told):
    """Return the `Remote` once a node is there, or the program is told to end."""
    try:
        from .remote import Remote
    except ImportError as error:
        if (error.name or '').startswith('boat_buoyancy'):
            raise
        raise ValueError(f'--ros needs ROS 2 Jazzy ({error}): source /opt/ros/jazzy/setup.bash, '
                         'or run ./install.sh ros,view') from None
    if ours := sorted({'--port', '--host', '--no-open'}.intersection(
            word.partition('=')[0] for word in arguments)):
        raise ValueError(f'{" ".join(ours)}: what follows --ros is for ROS; give it before --ros')
    remote = Remote(arguments)
    where = '' if remote.wanted == '/' else f' in {remote.wanted}'
    print(f'{PROGRAM}: looking for a node named {NODE_NAME}{where}', flush=True)
    said = set()
    while not (told.is_set() or remote.ended.done() or remote.wait(0.2)):
        # A boat that cannot be made here, as of a mesh that is not on this machine.
        for sentence in sorted(remote.troubles - said):
            print(f'{PROGRAM}: {command_line.one_line(sentence)}', file=sys.stderr, flush=True)
            said.add(sentence)
    return remote


def show(floating, arguments, told):
    """Show what floats, a `Loop` or the like, until told to end."""
    from .page import Page
    from .stage import in_turn, served
    with served(arguments.host, arguments.port) as server:
        page = in_turn(server, Page, server, floating)
        address = f'http://{arguments.host}:{server.get_port()}'
        print(f'{PROGRAM}: {floating.name} floats at {address} until Ctrl-C', flush=True)
        if not arguments.no_open:
            # A browser in a terminal comes back when its user leaves it.
            Thread(target=webbrowser.open, args=(address,), daemon=True).start()
        while not told.wait(1.0 / PICTURES) and not floating.ended.done():
            in_turn(server, page.show)


def main(argv=None):
    """Run the program and return its exit code."""
    arguments = parser().parse_args(argv)
    return command_line.run(PROGRAM, lambda: work(arguments))


if __name__ == '__main__':
    sys.exit(main())
