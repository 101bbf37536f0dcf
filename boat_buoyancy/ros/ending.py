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

"""Ending the node: the first signal asks for it, a second one is the end."""

from contextlib import contextmanager
import ctypes
import os
import signal
import threading

SIGNALS = (signal.SIGINT, signal.SIGTERM)
# One press of Ctrl-C can come twice, from the terminal and from what started the node.
ONE_REQUEST = 0.1  # s


@contextmanager
def told_to_end():
    """
    Give a `threading.Event` that is set after the first SIGINT or SIGTERM.

    By then the kernel has them again and ends the process at the next one, even where the main
    thread hangs in the middleware with Python's lock held.
    """
    told, over = threading.Event(), threading.Event()
    noticed, notice = os.pipe()

    def listen():
        while (number := os.read(noticed, 1)) and ord(number) not in SIGNALS:
            pass
        if number and not over.wait(ONE_REQUEST):
            # Python's own way is for the main thread alone, which may be busy compiling.
            libc = ctypes.CDLL(None)
            for number in SIGNALS:
                libc.signal(ctypes.c_int(number), ctypes.c_void_p(int(signal.SIG_DFL)))
            told.set()
        os.close(noticed)

    for number in SIGNALS:
        # What Python does first, whatever it is at, is to write the number into the pipe.
        signal.signal(number, lambda *_: None)
    os.set_blocking(notice, False)
    signal.set_wakeup_fd(notice, warn_on_full_buffer=False)
    threading.Thread(target=listen, daemon=True).start()
    try:
        yield told
    finally:
        over.set()
        signal.set_wakeup_fd(-1)
        os.close(notice)
        for number in SIGNALS:
            signal.signal(number, signal.SIG_DFL)
