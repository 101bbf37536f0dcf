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
Roll the dice for a scene's boat: ``python examples/monte_carlo.py config/barge.yaml``.

Many boats, each with a mass and a damping of its own, up to 10 % and twofold off the scene's, and
each in a sea of its own, of one state from any side; the greatest roll and pitch of each are the
outcome.  Fleets of them go to the cores of this machine; or, where those are not enough, to the
workers of any dask.distributed scheduler (--scheduler tcp://HOST:8786), which have this package
installed, too.  Both give the same: what a boat is comes from its number alone.
"""

import argparse
from concurrent.futures import as_completed, ProcessPoolExecutor
from contextlib import contextmanager
import multiprocessing
from pathlib import Path
import signal
import sys

from boat_buoyancy.physics import checks, load_fleet, load_scene
from boat_buoyancy.tools import command_line
from boat_buoyancy.tools.progress import Progress
import numpy as np

PROGRAM = 'monte_carlo'
TOGETHER = 25
DAMPINGS = 'damping.probe', 'damping.linear', 'damping.quadratic'
COLUMNS = 'number,mass_kg,damping,roll_deg,pitch_deg,failed'
LIKELY = 50, 90, 99, 100


def drawn(values, number, sea_state):
    """Return the parameters {name: value} of a boat by its number, and how it is damped."""
    dice = np.random.default_rng(number)
    heavier, damping = dice.uniform(0.9, 1.1), 2.0 ** dice.uniform(-1.0, 1.0)
    kept = {name: value for name, value in values.items()
            if name not in ('sea.waves', 'sea.significant_height', 'sea.peak_period')}
    return kept | {name: [damping * value for value in values[name]] for name in DAMPINGS} | {
        'boat.mass': heavier * values['boat.mass'],
        'boat.inertia': [heavier * value for value in values['boat.inertia']],
        'sea.sea_state': sea_state, 'sea.seed': number,
        'sea.direction': dice.uniform(-np.pi, np.pi)}, damping


def outcomes(values, numbers, sea_state, seconds):
    """
    Return (number, mass, damping, roll, pitch, failed) of each boat of one fleet.

    ``values`` {name: value} of the scene; ``numbers`` of the boats; ``seconds`` that they are at
    sea; mass kg, damping over that of the scene, greatest roll and pitch either way in degrees;
    failed is 1 where a boat left what physics allows.
    """
    boats = [drawn(values, number, sea_state) for number in numbers]
    fleet = load_fleet([boat for boat, _ in boats], threads=1)
    greatest = np.zeros((2, len(boats)))
    for _ in range(round(seconds * values['rate'])):
        fleet.step()
        state = fleet.state
        greatest = np.maximum(greatest, np.abs([state.roll, state.pitch]))
    roll, pitch = np.degrees(greatest).tolist()
    return [(number, boat['boat.mass'], damping, *rest) for number, (boat, damping), *rest in zip(
        numbers, boats, roll, pitch, fleet.failed.astype(int).tolist())]


@contextmanager
def processes():
    """Give the executor of this machine's cores."""
    # Started afresh: threads are not forked. Only this process answers Ctrl-C.
    executor = ProcessPoolExecutor(mp_context=multiprocessing.get_context('spawn'),
                                   initializer=signal.signal,
                                   initargs=(signal.SIGINT, signal.SIG_IGN))
    try:
        yield executor
    finally:
        executor.shutdown(cancel_futures=True)


@contextmanager
def scheduler(address):
    """Give the executor of a dask.distributed scheduler."""
    try:
        from distributed import Client
    except ImportError as error:
        raise ValueError(f'--scheduler needs distributed ({error}): '
                         'pip install distributed') from None
    with Client(address, timeout=10.0, set_as_default=False) as client:
        executor = client.get_executor()
        try:
            yield executor
        finally:
            executor.shutdown(wait=False)


def roll_the_dice(executor, values, count, sea_state, seconds, tell):
    """Return the `outcomes` of boats 0 to ``count``, in order; ``tell`` takes a text."""
    work = [executor.submit(outcomes, values, range(first, min(first + TOGETHER, count)),
                            sea_state, seconds) for first in range(0, count, TOGETHER)]
    for number, _ in enumerate(as_completed(work), 1):
        tell(f'{number} of {len(work)} fleets')
    return [row for done in work for row in done.result()]


def summary(rows):
    """Yield what came of it, as lines."""
    good = [row for row in rows if not row[5]]
    yield f'{len(rows)} boats, {len(rows) - len(good)} of which failed'
    for what, column in (('roll', 3), ('pitch', 4)):
        ordered = sorted(good, key=lambda row: row[column])
        parts = [f'{percent} %: {ordered[(len(ordered) - 1) * percent // 100][column]:.2f}'
                 for percent in LIKELY if ordered]
        yield f'greatest {what} in deg, not exceeded by {", ".join(parts)}' + (
            f' (boat {ordered[-1][0]})' if ordered else '')


def main(arguments=None):
    """Run the program and return its exit code."""
    parser = command_line.scene_parser(
        PROGRAM, 'Print the greatest roll and pitch of many boats like that of a scene.',
        'config/barge.yaml --boats 200')
    option = parser.add_argument
    option('--boats', metavar='N', type=int, default=1000, help='how many (%(default)s)')
    option('--seconds', metavar='S', type=float, default=60.0, help='at sea (%(default)s)')
    option('--sea-state', metavar='N', type=int, default=3, help='of all seas (%(default)s)')
    option('--csv', metavar='FILE', type=Path, help='table, one row per boat')
    option('--scheduler', metavar='ADDRESS',
           help='of dask.distributed, as tcp://host:8786; else this machine works')
    asked = parser.parse_args(arguments, argparse.Namespace())

    def work():
        count = checks.count('--boats', asked.boats, at_least=1)
        seconds = checks.number('--seconds', asked.seconds, above=0.0)
        if asked.csv is not None:
            command_line.check_writable(asked.csv)
        values = load_scene(asked.scene).values
        # Bad input is said before anything is started, and what is to be compiled is, once.
        outcomes(values, [0], asked.sea_state, 1.0 / values['rate'])
        progress = Progress(sys.stderr)
        try:
            with scheduler(asked.scheduler) if asked.scheduler else processes() as executor:
                rows = roll_the_dice(executor, values, count, asked.sea_state, seconds, progress)
        finally:
            progress.clear()
        print(*summary(rows), sep='\n')
        if asked.csv is not None:
            asked.csv.write_text('\n'.join([COLUMNS, *(','.join(map(repr, row)) for row in rows)])
                                 + '\n', encoding='utf-8')

    return command_line.run(PROGRAM, work)


if __name__ == '__main__':
    sys.exit(main())
