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
One source for the step, plain or compiled: functions marked `compiled`, handed to Numba on demand.

A marked function stays plain Python, which is how one debugs it.  `machine_code` returns its
compiled twin, where Numba is installed and works; where not, the function itself.
"""

import dis
from functools import lru_cache
import hashlib
from importlib.util import find_spec
import os
from pathlib import Path
from types import FunctionType
import warnings

LEAST_NUMBA = (0, 59)
# What LLVM may do to the arithmetic of a function; never 'nnan' or 'ninf', as the guard lives on
# what is not a number.  Fused: a product and a sum rounded once.  Reordered, too: sums in any
# order, so that they become vector instructions.
EXACT, FUSED, REORDERED = False, {'contract'}, {'reassoc', 'contract', 'nsz', 'arcp'}
PLAIN = 'the step runs as plain Python, some fifty times slower'


def _hash_of_sources():
    """Return a hash of the sources of the physics and of where they are, in hexadecimal digits."""
    folder = Path(__file__).parent
    digest = hashlib.sha256(str(folder).encode())
    for path in sorted(folder.rglob('*.py')):
        digest.update(path.relative_to(folder).as_posix().encode() + b'\0' + path.read_bytes())
    return digest.hexdigest()[:16]


# Taken as they are loaded: they may change while this runs.
SOURCES = _hash_of_sources()
# What `compile_now` gave for each function.
_ready = {}


def compiled(function=None, *, arithmetic=EXACT):
    """
    Mark a function for `machine_code`; of functions it calls marked ones, math's and min's like.

    ``arithmetic`` is EXACT, FUSED or REORDERED.
    """
    if function is None:
        return lambda marked: compiled(marked, arithmetic=arithmetic)
    function.arithmetic = arithmetic
    return function


@lru_cache(maxsize=None)
def numba():
    """Return the module Numba, or None where it is missing, too old, broken or turned off."""
    if turned_off():
        return None
    try:
        import numba as module
        version = tuple(int(part) for part in module.__version__.split('.')[:2])
    except ImportError as error:
        if getattr(error, 'name', None) != 'numba':
            _warn(f'Numba is installed and cannot be imported ({error})')
        return None
    except Exception as error:  # whatever a broken installation does
        _warn(f'Numba is installed and broken ({error!r})')
        return None
    if version < LEAST_NUMBA:
        _warn(f'Numba {module.__version__} is too old, expected '
              f'{".".join(map(str, LEAST_NUMBA))} or newer')
        return None
    return module


def kind():
    """Return in words how the step runs: 'compiled' or 'plain Python'."""
    failed = any(twin is function for function, twin in _ready.items())
    return 'plain Python' if numba() is None or failed else 'compiled'


def expected_kind():
    """Return what `kind` will say where Numba is in order, without the time to import it."""
    return 'plain Python' if turned_off() or find_spec('numba') is None else 'compiled'


def turned_off():
    """Return whether the environment asks for plain Python."""
    return os.environ.get('NUMBA_DISABLE_JIT', '0') not in ('', '0')


@lru_cache(maxsize=None)
def calling(function, **names):
    """
    Return a marked function with other functions in place of globals that it calls.

    So that what varies is chosen once, outside, and compiled code holds no choice.
    """
    copy = _copy(function, {**function.__globals__, **names})
    # Numba tells what it keeps apart by this.
    copy.__qualname__ = '_'.join([function.__qualname__, *(
        chosen.__name__ for chosen in names.values())])
    return compiled(copy, arithmetic=function.arithmetic)


@lru_cache(maxsize=None)
def machine_code(function):
    """Return the compiled twin of a marked function, or the function itself without Numba."""
    if numba() is None:
        return function
    folder = cache_folder()
    before = numba().config.CACHE_DIR
    # Numba reads this when a function is decorated; other packages keep their own.
    numba().config.CACHE_DIR = '' if folder is None else str(folder)
    try:
        return _twin(function, cache=folder is not None)
    finally:
        numba().config.CACHE_DIR = before


def compile_now(function, *arguments):
    """
    Return `machine_code` compiled for the types of ``arguments``, or the plain function.

    Plain, with one warning, where Numba fails to compile it; once, as the types never change.
    """
    if numba() is None:
        return function
    if function not in _ready:
        types = tuple(numba().typeof(argument) for argument in arguments)
        try:
            _ready[function] = twin = machine_code(function)
            twin.compile(types)
        except Exception:  # Numba's, LLVM's and those of a damaged cache have no base in common
            _ready[function] = _compiled_without_cache(function, types)
    return _ready[function]


def _compiled_without_cache(function, types):
    """Return the compiled twin of a function for once, or with a warning the function itself."""
    folder = cache_folder()
    for damaged in folder.rglob(f'*.{function.__qualname__}-*') if folder else ():
        damaged.unlink(missing_ok=True)
    try:
        twin = _twin(function)
        twin.compile(types)
    except Exception as error:
        _warn(f'Numba {numba().__version__} cannot compile the step '
              f'({" ".join(str(error).split())[:200]})')
        return function
    return twin


def _twin(function, cache=False):
    """Return a copy of a function, compiled, in which the marked functions it names are, too."""
    names = dict(function.__globals__)
    for name in {step.argval for step in dis.get_instructions(function)
                 if step.opname == 'LOAD_GLOBAL'}:
        if hasattr(names.get(name), 'arithmetic'):
            names[name] = _inner(names[name])
    # Nothing here allocates: without Numba's counting of references a step costs a tenth less, and
    # with all of it inlined, arrays passed on for nothing, a fifth.
    return numba().njit(cache=cache, error_model='numpy', nogil=True, _nrt=False,
                        forceinline=True, fastmath=function.arithmetic)(_copy(function, names))


def _copy(function, names):
    copy = FunctionType(function.__code__, names, function.__name__, function.__defaults__)
    copy.__module__, copy.__qualname__ = function.__module__, function.__qualname__
    copy.__doc__ = function.__doc__
    return copy


@lru_cache(maxsize=None)
def _inner(function):
    """Return the twin of a function that others call: once, however many they are."""
    return _twin(function)


def cache_folder():
    """
    Return the folder for compiled code, made if need be, or None where none can be written.

    Under the user's cache, or NUMBA_CACHE_DIR where that is set, and named by a hash of the
    package's sources: Numba's own cache does not notice when a function in another file changes.
    """
    try:
        base = os.environ.get('NUMBA_CACHE_DIR') or Path(
            os.environ.get('XDG_CACHE_HOME') or Path.home() / '.cache', 'boat_buoyancy')
        folder = Path(base, f'step-{SOURCES}')
        probe = folder / f'.writable-{os.getpid()}'
        folder.mkdir(parents=True, exist_ok=True)
        probe.touch()
        probe.unlink()
    except (OSError, RuntimeError):  # the latter from a user without a home
        return None
    return folder


def notice(function=None):
    """
    Return a sentence when the step is about to be compiled, which takes a while, else ''.

    ``function``, that of `march_by`, tells the integrators apart; None is any of them.
    """
    if numba() is None:
        return ''
    folder = cache_folder()
    if folder is None:
        return ('compiling the step, up to half a minute at every start: no folder for compiled '
                'code can be written; set NUMBA_CACHE_DIR to one that can')
    name = '*' if function is None else f'*.{function.__qualname__}-*'
    if any(folder.rglob(f'{name}.nbi')):
        return ''
    return 'compiling the step, once for each integrator on this machine: up to half a minute'


def _warn(what):
    warnings.warn(f'{what}: {PLAIN}', RuntimeWarning, stacklevel=2)
