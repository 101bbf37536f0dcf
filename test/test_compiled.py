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

"""One source, plain and compiled: they agree, and what bites about Numba is handled."""

from dataclasses import replace
from importlib.util import find_spec
import os
from pathlib import Path
import shutil
import subprocess
import sys
import textwrap

import boat_buoyancy
from boat_buoyancy.physics import compiled
from boat_buoyancy.physics.boat.records import readable
from boat_buoyancy.physics.boat.state import to_rows
from boat_buoyancy.physics.boat.surface import box_surface
from boat_buoyancy.physics.stepping.engine import decay_of_waves
from boat_buoyancy.physics.stepping.integrators import INTEGRATORS
from boat_buoyancy.physics.stepping.march import begin, LOAD_SIZE, march_by, PACE
from boat_buoyancy.physics.stepping.speed_bound import SpeedBound
from boats import asymmetric_boat, in_waves, LAWS, random_states, wind_sea, windy
import numpy as np
import pytest

PACKAGE = Path(boat_buoyancy.__file__).parent
needs_numba = pytest.mark.skipif(compiled.numba() is None, reason='Numba is not there')
# A function that compiles in a moment, and one of another file that it calls.
SMALL = """
from boat_buoyancy.physics import compiled
from boat_buoyancy.physics.rotation import rotation_matrix
turn = compiled.machine_code(rotation_matrix)
print(turn((0.0, 0.0, 0.0, 1.0))[0][0], turn is not rotation_matrix)
"""
CALLS_ANOTHER = """
from boat_buoyancy.physics import compiled
from boat_buoyancy.physics.forces.gravity import gravity
from boat_buoyancy.physics.scene.scene import load_scene
boat = load_scene({}).boat.record[()]
print(compiled.machine_code(gravity)(boat, (0.0, 0.0, 1.0))[2] / 2000.0)
"""


def python(code, path=PACKAGE.parent, **environment):
    """Return standard output and standard error of a program run in a process of its own."""
    done = subprocess.run(
        # Not here: Python looks into the working folder first.
        [sys.executable, '-c', textwrap.dedent(code)], capture_output=True, text=True, timeout=120,
        cwd='/', env={**os.environ, 'PYTHONPATH': str(path), **environment})
    assert done.returncode == 0, done.stderr
    return done.stdout.split(), done.stderr


def fleet(boat, count=20):
    """Return the arguments of `march` for boats thrown about in waves, current and wind."""
    sea, (corners, triangles) = wind_sea().with_wind((8.0, -6.0)), boat.panel_rows
    pace = (0, 0, 0, 2, 50.0, SpeedBound.of(boat, sea).record.item())
    return [np.array([boat.record] * count), np.array([boat.probe_records] * count),
            corners[None].copy(), triangles[None].copy(), decay_of_waves(boat, sea)[None],
            np.array([sea.record]), sea.table[None].copy(), np.array([pace] * count, PACE),
            to_rows(random_states((count,), 5)), np.zeros((count, LOAD_SIZE)),
            np.zeros((count, 2, len(boat.hull.share))), np.zeros((count, 5, corners.shape[1])),
            np.full(count, 1e3), np.zeros(count, int)]


def panelled(boat):
    """Return a boat that the pressure on a box lifts, and not its probes."""
    return replace(boat, hull=replace(
        boat.hull, panels=box_surface((2.0, 1.5, 0.8)).refined(0.7), specific_weight=1e4))


@needs_numba
@pytest.mark.parametrize('integrator', INTEGRATORS)
def test_compiled_and_plain_agree_to_round_off(integrator):
    push = (np.array([[300.0, -50.0, 20.0, 10.0, -30.0, 60.0]]), 0, 0, 7, 1)
    boats = [asymmetric_boat(law) for law in LAWS]
    for boat in (*boats, panelled(boats[0]), asymmetric_boat(damping=windy()),
                 in_waves(boats[2]), in_waves(panelled(boats[0]))):
        arrays = fleet(boat)
        lists = [*map(readable, arrays[:8]), *(values.tolist() for values in arrays[8:12]),
                 arrays[12].copy(), arrays[13].copy()]
        track = np.empty((0, 0)), np.empty((0, 0))
        for function, arguments in ((compiled.machine_code(begin), arrays), (begin, lists)):
            function(*arguments[:12], np.arange(20), 0.14)
        assert compiled.machine_code(march_by(integrator))(*arrays, *push, *track) == 0
        assert march_by(integrator)(*lists, push[0].tolist(), *push[1:], *track) == 0
        # The states are of order 1; a load is of the order of the weight.
        np.testing.assert_allclose(arrays[8], lists[8], rtol=0, atol=1e-12)
        np.testing.assert_allclose(arrays[9], lists[9], rtol=0, atol=1e-12 * 1e4)
        np.testing.assert_allclose(arrays[10], lists[10], rtol=0, atol=1e-12)
        np.testing.assert_allclose(arrays[11], lists[11], rtol=0, atol=1e-12)


@needs_numba
def test_compiled_code_is_kept_in_the_users_cache_and_found_again(tmp_path):
    for _ in range(2):
        out, error = python(SMALL, XDG_CACHE_HOME=str(tmp_path), NUMBA_CACHE_DIR='')
        assert (out, error) == (['1.0', 'True'], '')
    folder, = (tmp_path / 'boat_buoyancy').iterdir()
    assert list(folder.rglob('*.nbi')) and folder.name.startswith('step-')


@needs_numba
def test_without_a_folder_to_write_to_it_compiles_all_the_same(tmp_path):
    package = copy_of_package(tmp_path)
    nowhere = tmp_path / 'a_file'
    nowhere.write_text('')
    out, error = python(SMALL, package, XDG_CACHE_HOME=str(nowhere), NUMBA_CACHE_DIR='')
    assert (out, error) == (['1.0', 'True'], '')
    # Never beside the sources.
    assert not list(package.rglob('*.nbi'))


@needs_numba
def test_a_damaged_cache_costs_a_compilation_and_no_more(tmp_path):
    code = """
    from boat_buoyancy.physics import compiled
    from boat_buoyancy.physics.rotation import rotation_matrix
    turn = compiled.compile_now(rotation_matrix, (0.0, 0.0, 0.0, 1.0))
    print(turn is not rotation_matrix, compiled.kind())
    """
    cache = {'XDG_CACHE_HOME': str(tmp_path), 'NUMBA_CACHE_DIR': ''}
    assert python(code, **cache) == (['True', 'compiled'], '')
    for ending in ('nbi', 'nbc'):
        path, = tmp_path.rglob(f'*.{ending}')
        path.write_bytes(path.read_bytes()[:10])
        for _ in range(2):
            assert python(code, **cache) == (['True', 'compiled'], '')


@needs_numba
def test_a_change_in_another_file_is_not_missed(tmp_path):
    package, cache = copy_of_package(tmp_path), {'XDG_CACHE_HOME': str(tmp_path / 'cache'),
                                                 'NUMBA_CACHE_DIR': ''}
    (before,), _ = python(CALLS_ANOTHER, package, **cache)
    vectors = package / 'boat_buoyancy' / 'physics' / 'vectors.py'
    text = vectors.read_text()
    changed = text.replace('(s * a[0], s * a[1], s * a[2])',
                           '(s * a[0], s * a[1], 2.0 * s * a[2])')
    assert changed != text
    vectors.write_text(changed)
    (after,), _ = python(CALLS_ANOTHER, package, **cache)
    assert (float(before), float(after)) == (-9.81, -19.62)


def copy_of_package(folder):
    """Return a folder with a copy of the package, to be changed."""
    shutil.copytree(PACKAGE, folder / 'copy' / 'boat_buoyancy',
                    ignore=shutil.ignore_patterns('__pycache__'))
    return folder / 'copy'


@pytest.mark.parametrize(('module', 'complaint'), [
    ("__version__ = '0.50.1'", 'Numba 0.50.1 is too old, expected 0.59 or newer'),
    ("raise ImportError('Numba needs NumPy 2.3 or less')", 'Numba needs NumPy 2.3 or less'),
    ("raise SystemError('initialization failed')", 'initialization failed')],
    ids=['too old', 'of another NumPy', 'broken'])
def test_a_numba_that_is_no_good_is_told_of_once(tmp_path, module, complaint):
    (tmp_path / 'numba').mkdir()
    (tmp_path / 'numba' / '__init__.py').write_text(module)
    out, error = python(
        """
        from boat_buoyancy.physics import compiled, load_scene
        for _ in range(2):
            simulation = load_scene({}).simulation()
            simulation.step()
        print(compiled.kind())
        """, os.pathsep.join((str(tmp_path), str(PACKAGE.parent))), NUMBA_DISABLE_JIT='0')
    assert out == ['plain', 'Python']
    assert error.count('RuntimeWarning') == 1
    assert complaint in error and 'runs as plain Python' in error


@needs_numba
def test_what_numba_cannot_compile_is_told_of_and_stays_plain(monkeypatch):
    monkeypatch.setattr(compiled, '_ready', {})

    @compiled.compiled
    def not_for_numba(x):
        return {}.fromkeys('ab', [x])

    with pytest.warns(RuntimeWarning, match='cannot compile the step'):
        assert compiled.compile_now(not_for_numba, 1.0) is not_for_numba
    assert compiled.kind() == 'plain Python'


@pytest.mark.parametrize('environment', [{'NUMBA_DISABLE_JIT': '1'}, {'WITHOUT_NUMBA': '1'}])
def test_turned_off_or_missing_it_is_plain_without_a_word(environment):
    out, error = python(
        """
        import os, sys
        if 'WITHOUT_NUMBA' in os.environ:
            sys.modules['numba'] = None
        from boat_buoyancy.physics import compiled, load_scene
        simulation = load_scene({'sea.sea_state': 3}).simulation()
        simulation.step()
        print(compiled.kind(), repr(compiled.notice()))
        """, **environment)
    assert (out, error) == (['plain', 'Python', "''"], '')


def test_a_fleet_without_numba_says_once_what_to_install():
    code = """
    import sys
    sys.modules['numba'] = None
    from boat_buoyancy.physics import load_fleet
    for _ in range(2):
        load_fleet([{}, {}]).step()
    """
    _, error = python(code, NUMBA_DISABLE_JIT='0')
    assert error.count('pip install "boat_buoyancy[fast]"') == 1
    # Who has turned it off knows.
    assert python(code, NUMBA_DISABLE_JIT='1')[1] == ''


@needs_numba
def test_numbas_own_setting_of_the_cache_is_put_back(monkeypatch):
    monkeypatch.setattr(compiled.numba().config, 'CACHE_DIR', 'as it was')
    compiled.machine_code.__wrapped__(begin)
    assert compiled.numba().config.CACHE_DIR == 'as it was'


@needs_numba
def test_the_notice_is_given_until_something_is_compiled(tmp_path):
    code = """
    from boat_buoyancy.physics import compiled, load_scene
    print(compiled.notice().replace(' ', '_') or 'nothing')
    load_scene({}).simulation()
    print(compiled.notice() or 'nothing')
    """
    out, _ = python(code, XDG_CACHE_HOME=str(tmp_path), NUMBA_CACHE_DIR='')
    assert out[0].startswith('compiling_the_step,_once_for_each_integrator')
    assert out[1] == 'nothing'


@pytest.mark.skipif(find_spec('numba') is None, reason='Numba is not there')
@pytest.mark.parametrize('work', [
    'from boat_buoyancy.tools.report import main; main(["config/default.yaml"])',
    'from boat_buoyancy.physics import load_scene; load_scene({})'])
def test_what_does_not_step_does_not_load_numba(work):
    done = subprocess.run(
        [sys.executable, '-c', f'import sys; {work}; sys.exit("numba" in sys.modules)'],
        capture_output=True, text=True, timeout=60, cwd=PACKAGE.parent,
        env={**os.environ, 'PYTHONPATH': str(PACKAGE.parent)})
    assert done.returncode == 0, done.stderr


def test_a_bound_function_calls_what_it_was_given():
    leapfrog, implicit = (march_by(name) for name in ('leapfrog', 'implicit'))
    assert leapfrog is march_by('leapfrog') is not implicit
    # What Numba tells its caches apart by.
    assert leapfrog.__qualname__ != implicit.__qualname__
    assert implicit.__globals__['step'] is INTEGRATORS['implicit'].step
