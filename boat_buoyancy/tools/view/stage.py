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

"""The server of the page, and what is drawn on it: boats on their water, as one looks at them."""

from concurrent.futures import Future
from contextlib import contextmanager, redirect_stdout
import io
import warnings

import numpy as np
import viser

from .drawing import Drawing
from .shapes import length_of

# How the boat is looked at first: from there, in lengths of the boat.
FROM_ABEAM, FROM_ABOVE = np.array([-0.9, -1.6, 0.8]), np.array([-0.01, 0.0, 3.0])
SKY = (226, 236, 245)
CAMERAS = ('follow', 'from above', 'free')


@contextmanager
def served(host, port):
    """Give a viser server that listens there and nowhere else; OSError where it cannot."""
    # It says more than a user wants to read.
    with redirect_stdout(io.StringIO()):
        server = viser.ViserServer(host=host, port=port, label='boat_buoyancy', verbose=False)
    # Whoever has the page could ask for a way to it from everywhere, by another host.
    server.request_share_url = lambda *_, **__: None
    try:
        if port not in (0, server.get_port()):
            # It takes the next one by itself.
            raise OSError(f'--port {port}: taken meanwhile; give another one, or 0 for any')
        yield server
    finally:
        with redirect_stdout(io.StringIO()), warnings.catch_warnings():
            # What is still worked out comes too late to be shown.
            warnings.filterwarnings('ignore', 'Queued a ')
            server.stop()


def in_turn(server, function, *arguments):
    """
    Return what a function gives that the server's own thread calls.

    Whatever changes a page has to go this way: viser wakes what sends it without a lock, and a
    change from another thread can meet that at work.
    """
    answer = Future()

    def call():
        try:
            answer.set_result(function(*arguments))
        except Exception as error:
            answer.set_exception(error)
    server.get_event_loop().call_soon_threadsafe(call)
    return answer.result()


class Stage:
    """
    What is drawn on a page, and how it is looked at.

    Main arguments: ``server`` of viser; ``boat``, the first that will be shown.
    Public: ``following``, whether the first boat stays in the middle.
    """

    def __init__(self, server, boat):
        """Show the sky."""
        self._server, self._drawings, self.following = server, {}, True
        server.scene.set_up_direction('+z')
        server.scene.set_background_image(np.full((2, 2, 3), SKY, np.uint8))
        # Shadows cost a machine without a graphics card most of a picture.
        server.scene.configure_default_lights(cast_shadow=False)
        # The world goes past a boat that is followed: so a page's camera stays its user's.
        self._world = server.scene.add_frame('/world', show_axes=False)
        self._look_from(server.initial_camera, FROM_ABEAM * length_of(boat))

    def show(self, snapshots):
        """Show {name: `Snapshot`}, the first of them with its water in the middle."""
        for name in self._drawings.keys() - snapshots.keys():
            self._drawings.pop(name).remove()
        for number, (name, snapshot) in enumerate(snapshots.items()):
            drawing, first = self._drawings.get(name), number == 0
            if drawing is None or not drawing.is_of(snapshot.boat, first):
                if drawing is not None:
                    drawing.remove()
                drawing = self._drawings[name] = Drawing(
                    self._server.scene, f'/world/{name}', snapshot.boat, water=first)
            drawing.show(snapshot)
            if first and self.following:
                x, y, _ = snapshot.position
                self._world.position = (-x, -y, 0.0)

    def look(self, camera, boat):
        """Look at a boat in all pages, and those to come, as one of `CAMERAS` says."""
        self.following = camera != 'free'
        if self.following:
            place = length_of(boat) * (FROM_ABOVE if camera == 'from above' else FROM_ABEAM)
            clients = self._server.get_clients().values()
            for view in (self._server.initial_camera, *(client.camera for client in clients)):
                self._look_from(view, place)

    @staticmethod
    def _look_from(camera, place):
        camera.position = tuple(place)
        camera.look_at = (0.0, 0.0, 0.0)
