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

"""What the command-line programs share: their scene argument, and how they say what is wrong."""

import argparse
from contextlib import contextmanager
from importlib import import_module
import os
from pathlib import Path
import signal
import sys
from threading import Timer
import warnings

from ..physics.stepping.simulation import SimulationError

# Modules of the extras that Ubuntu 24.04 has no package of.
NOT_IN_UBUNTU = ('capytaine', 'rosbags', 'viser')
EXIT_CODES = 'Exit code: 0; 2 after one line that says what is wrong; 130 when interrupted.'
UNTIL_TOLD = 'Exit code: 0 when told to end; 2 after one line that says what is wrong.'


class _Lines(argparse.HelpFormatter):
    """Fills each line of a text by itself."""

    def _fill_text(self, text, width, indent):
        return '\n'.join(super(_Lines, self)._fill_text(line, width, indent)
                         for line in text.splitlines())


class OneLineParser(argparse.ArgumentParser):
    """
    An argument parser that says what is wrong in one line and ends with exit code 2.

    Its help says what a ``program`` is for (``description``), with one ``example`` of its
    arguments and what its ``exit_codes`` mean.
    """

    def __init__(self, program, description, example, exit_codes=EXIT_CODES):
        """Take no arguments so far."""
        super().__init__(prog=program, description=description, formatter_class=_Lines,
                         epilog=f'Example: {program} {example}\n{exit_codes}')

    def error(self, message):
        """Print the message after the program's name and leave."""
        self.exit(2, f'{self.prog}: {one_line(message)} (try {self.prog} --help)\n')


def one_line(message):
    """Return a message with every run of blanks and line ends as one blank."""
    return ' '.join(str(message).split())


def scene_parser(program, description, example, many=False):
    """Return a parser that takes a parameter file as ``scene``, or many as ``scenes``."""
    parser = OneLineParser(program, description, example)
    parser.add_argument(*(['scenes'] if many else ['scene']), metavar='SCENE',
                        **({'nargs': '+'} if many else {}),
                        help='parameter file of the boat and its sea, as config/barge.yaml')
    return parser


def shipped_scenes():
    """Return the parameter files that come with the package, from its source or as installed."""
    here = Path(__file__)
    # Wherever it was installed, for one user or by colcon, share is beside the lib it is in.
    folders = [here.parents[2] / 'config',
               *(parent / 'share' / 'boat_buoyancy' / 'config' for parent in here.parents)]
    return next(filter(None, (sorted(folder.glob('*.yaml')) for folder in folders)), [])


def require_extra(extra, what, *modules):
    """
    Raise ValueError with what to install where a module of an extra cannot be imported.

    ``extra`` as in ``./install.sh EXTRA``; ``what`` needs it, as '--plot'.
    """
    missing = {}
    for module in modules:
        try:
            import_module(module)
        except ImportError as error:
            missing[module] = error
    if missing:
        packages = [f'python3-{module}' for module in missing if module not in NOT_IN_UBUNTU]
        raise ValueError(
            f'{what} needs {" and ".join(missing)} ({"; ".join(map(str, missing.values()))}): '
            f'./install.sh {extra}, or pip install "boat_buoyancy[{extra}]"'
            + (f', or on Ubuntu apt install {" ".join(packages)}' if packages else ''))


def check_output(option, path, endings, extra='chart', module='matplotlib'):
    """
    Raise ValueError or OSError now for a file that could not be written later.

    Main arguments: ``option`` asks for it, as '--plot'; ``path`` of the file; ``endings`` that it
    may have.
    Other arguments: ``extra`` and its ``module``, which write it.
    """
    if path.suffix.lower() not in endings:
        raise ValueError(f'{option}: expected a file name that ends in {" or ".join(endings)}, '
                         f'got {str(path)!r}')
    require_extra(extra, option, module)
    check_writable(path)


def check_writable(path):
    """Raise OSError for a file that cannot be written."""
    existed = path.exists()
    path.open('ab').close()
    if not existed:
        path.unlink()


def run(program, work):
    """
    Return the exit code of a program whose ``work`` is a function without arguments.

    0; or 2 after one line on standard error for input that is wrong (ValueError, OSError) and a
    motion that leaves what physics allows (SimulationError); or 130 after one when interrupted.
    A reader that closes the pipe early, as ``head`` does, is no error.
    """
    try:
        with warnings.catch_warnings(), _interrupts_heard():
            # In one line, without where in the sources.
            warnings.showwarning = lambda message, *_: print(
                f'{program}: {one_line(message)}', file=sys.stderr)
            work()
        sys.stdout.flush()
    except BrokenPipeError:
        # Python flushes once more at exit; nobody reads that either.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        place = f'{error.filename}: ' if error.filename is not None else ''
        return _refuse(program, f'{place}{error.strerror or error}')
    except (ValueError, SimulationError) as error:
        return _refuse(program, error)
    except KeyboardInterrupt:
        print(f'{program}: interrupted', file=sys.stderr)
        return 130
    return 0


@contextmanager
def _interrupts_heard():
    """Send an interrupt again that came where Python ignores what is raised, as in a callback."""
    before = sys.unraisablehook

    def heard(ignored):
        if ignored.exc_type is KeyboardInterrupt:
            Timer(0.05, os.kill, (os.getpid(), signal.SIGINT)).start()
        else:
            before(ignored)
    sys.unraisablehook = heard
    try:
        yield
    finally:
        sys.unraisablehook = before


def _refuse(program, message):
    print(f'{program}: {one_line(message)}', file=sys.stderr)
    return 2
