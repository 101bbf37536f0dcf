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

"""The loop that floats a boat at real time, whoever looks on."""

from concurrent.futures import Future
from dataclasses import dataclass
from queue import Empty, Queue
from threading import Thread
import time

from ...ros.clocks import SteadyDrive

PICTURES = 20.0  # Hz
IDLE = 0.05  # s between looks at what is asked for while nothing is due
# Steps that are due go before what is asked for, but for no longer than this at a time.
BUSY = 0.02  # s
# The speed is measured over so long.
MEASURED = 1.0  # s


@dataclass(frozen=True)
class Speed:
    """``cost`` s of a period on average; ``possible`` and ``held`` times real time."""

    cost: float = 0.0
    possible: float = 0.0
    held: float = 0.0


class Loop:
    """
    A thread that steps a boat when its steps are due, and does in between what it is asked for.

    Main arguments: ``boat`` a `LiveBoat`, which nobody else changes from `start` on; ``scenes``
    {name: path}, what it can go over to.
    Public: ``snapshot``, the latest, a new one `PICTURES` times a second; ``speed``, the `Speed`
    of the last second; ``ended``, a `Future` that is done when the loop is, with its exception.
    """

    def __init__(self, boat, scenes=()):
        """Take a first picture."""
        self.scenes = dict(scenes)
        self.boat, self.snapshot, self.speed = boat, boat.snapshot(), Speed()
        self.ended = Future()
        self._asked, self._ending, self._next_picture = Queue(), False, 0.0
        self._thread = Thread(target=self._run, name='physics', daemon=True)

    def start(self):
        """Let time go on."""
        self._thread.start()

    def stop(self):
        """End the thread and wait for it."""
        self._ending = True
        self._thread.join()

    def ask(self, function, *arguments):
        """Return the `Future` of what a function gives that is called between two steps."""
        answer = Future()
        self._asked.put((answer, function, arguments))
        return answer

    # What a page shows: what is replaced whole and never changed.

    name = property(lambda self: self.boat.name)
    scene = property(lambda self: self.boat.scene)
    begun = property(lambda self: self.boat.begun)
    history = property(lambda self: self.boat.history)
    paused = property(lambda self: self.boat.paused)
    fault = property(lambda self: self.boat.session.fault)

    @property
    def snapshots(self):
        """Return {name: `Snapshot`} of all that floats."""
        return {'boat': self.snapshot}

    def text(self):
        """Return the scene as tuned as the text of a parameter file."""
        return self.boat.text()

    # What a page asks for; each waits until it is done, and raises what is wrong.

    def tune(self, values):
        """Change parameters {name: value}; ValueError with the sentence of what is wrong."""
        change = self.boat.proposed(values)
        self.ask(self.boat.take, change).result()

    def switch(self, source):
        """Go over to another parameter file."""
        change = self.boat.opened(source)
        self.ask(self.boat.take, change).result()

    def push(self, ahead, turn):
        """Push as `LiveBoat.push`."""
        self.ask(self.boat.push, ahead, turn).result()

    def lift(self, height):
        """Lift as `LiveBoat.lift`."""
        self.ask(self.boat.lift, height).result()

    def heel(self, angle):
        """Heel as `LiveBoat.heel`."""
        self.ask(self.boat.heel, angle).result()

    def reset(self):
        """Go back to the start."""
        self.ask(self.boat.reset).result()

    def step(self):
        """Advance one period while paused; ValueError while running."""
        if not self.boat.paused:
            raise ValueError('one step: expected a paused boat; pause it first')
        self.ask(self.boat.step).result()

    def pause(self, paused):
        """Stop or go on."""
        self.ask(setattr, self.boat, 'paused', paused).result()

    def set_pace(self, pace):
        """Run at ``pace`` times real time."""
        self.ask(setattr, self.boat, 'pace', pace).result()

    def _run(self):
        try:
            self._float()
        except BaseException as error:
            self.ended.set_exception(error)
        else:
            self.ended.set_result(None)

    def _float(self):
        drive = following = None
        wait = 0.0
        while not self._ending:
            self._answer(wait)
            boat, now = self.boat, time.monotonic()
            paced = None if boat.halted else (boat.session.simulation.rate, boat.pace)
            if paced != following:
                following, drive = paced, paced and SteadyDrive(*paced)
                self._measure_from(now)
            if drive is not None:
                self._run_due(drive, now)
            self._measure(now)
            if now >= self._next_picture:
                self._next_picture = now + 1.0 / PICTURES
                self.snapshot = boat.snapshot()
            wait = IDLE if drive is None else min(drive.wait(), IDLE)

    def _answer(self, wait):
        """Do what is asked for, if it takes ``wait`` s to come."""
        try:
            answer, function, arguments = self._asked.get(timeout=wait) if wait else (
                self._asked.get_nowait())
        except Empty:
            return
        try:
            answer.set_result(function(*arguments))
        except Exception as error:
            answer.set_exception(error)
        # Seen at once, while paused too.
        self._next_picture = 0.0

    def _run_due(self, drive, now):
        for _ in range(drive.turn().due):
            began = time.perf_counter()
            good = self.boat.step()
            self._spent += time.perf_counter() - began
            if not good:
                break
            self._steps += 1
            drive.ran()
            if time.monotonic() - now > BUSY:
                break

    def _measure_from(self, now):
        self._since, self._steps, self._spent = now, 0, 0.0

    def _measure(self, now):
        if now - self._since < MEASURED:
            return
        period, steps = 1.0 / self.boat.session.simulation.rate, self._steps
        cost = self._spent / steps if steps else 0.0
        self.speed = Speed(cost, period / cost if cost else 0.0,
                           steps * period / (now - self._since))
        self._measure_from(now)
