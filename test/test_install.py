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

"""What install.sh says and asks pip for; pip itself is a stand-in here."""

from pathlib import Path
import platform
import re
import shutil
import subprocess

import pytest

ROOT = Path(__file__).parents[1]
EXTRAS = set(re.findall(r"^        '(\w+)': \[", re.search(
    r'extras_require=\{(.*?)^    \}', (ROOT / 'setup.py').read_text(),
    re.MULTILINE | re.DOTALL)[1], re.MULTILINE))
# Says what it was called with, in place of the Python of a .venv that is already there.
PYTHON = '#!/bin/sh\necho called with "$@"\n'

no_wheels_of_ros = pytest.mark.skipif(
    (platform.system(), platform.machine()) != ('Linux', 'x86_64'),
    reason='the wheels of ROS are for Linux x86_64')


@pytest.fixture
def install(tmp_path):
    """Return a function that runs a copy of install.sh, and the folder it runs in."""
    shutil.copy(ROOT / 'install.sh', tmp_path)

    def run(*words):
        return subprocess.run([tmp_path / 'install.sh', *words], capture_output=True, text=True,
                              timeout=60)

    return run, tmp_path


@pytest.mark.parametrize('option', ['-h', '--help'])
def test_help_names_every_extra_and_installs_nothing(install, option):
    run, folder = install
    done = run(option)
    assert done.returncode == 0 and done.stderr == ''
    assert len(EXTRAS) > 3
    assert set(re.findall(r'^  (\w+)  ', done.stdout, re.MULTILINE)) == EXTRAS
    assert [path.name for path in folder.iterdir()] == ['install.sh']


@pytest.mark.parametrize('words, got', [
    (['rso'], "'rso'"), (['ros,tset'], "'tset'"), (['--fast'], "'--fast'"),
    (['ros', 'test'], "'ros test'")])
def test_a_wrong_extra_gets_one_line_before_anything_is_installed(install, words, got):
    run, folder = install
    done = run(*words)
    assert done.returncode == 2 and done.stdout == '' and done.stderr.count('\n') == 1
    assert got in done.stderr and '--help' in done.stderr
    assert [path.name for path in folder.iterdir()] == ['install.sh']


@pytest.mark.parametrize('asked, installed', [
    pytest.param([], 'ros,fast,mesh', marks=no_wheels_of_ros),
    pytest.param(['ros,test'], 'ros,test,fast,mesh', marks=no_wheels_of_ros),
    (['chart'], 'chart,fast,mesh'), (['mesh,chart'], 'mesh,chart,fast'), (['fast'], 'fast'),
    (['test'], 'test')])
def test_ros_and_chart_take_numba_and_trimesh_along_and_sizes_are_told(install, asked, installed):
    run, folder = install
    python = folder / '.venv' / 'bin' / 'python'
    python.parent.mkdir(parents=True)
    python.write_text(PYTHON)
    python.chmod(0o755)
    done = run(*asked)
    assert done.returncode == 0, done.stderr
    before, called, after = done.stdout.splitlines()
    assert re.search(r'into \.venv; a new one takes about \d+ MB', before)
    assert called == f'called with -m pip install --quiet .[{installed}]'
    assert re.search(r'\.venv takes \d+ MB$', after)
