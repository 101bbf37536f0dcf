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

"""What the tests of the command-line programs share: one line for what is wrong, exit code 2."""

import importlib
import importlib.util
from pathlib import Path
import re
import shlex
import subprocess
import sys

# Runs a program where some modules cannot be imported, whether installed or not.
EXAMPLES = Path(__file__).parents[1] / 'examples'
WITHOUT = """
import importlib
import sys
sys.path[:0] = {path!r}


class Hidden:
    def find_spec(self, name, path=None, target=None):
        if name.partition('.')[0] in {hidden!r}:
            raise ModuleNotFoundError('No module named ' + repr(name))


sys.meta_path.insert(0, Hidden())
sys.exit(importlib.import_module({module!r}).main({words!r}))
"""


def refused(main, program, words, capsys):
    """Return the one line on standard error of arguments that a program refuses with code 2."""
    try:
        code = main(list(words))
    except SystemExit as leaving:
        code = leaving.code
    out, err = capsys.readouterr()
    assert code == 2 and out == '' and err.count('\n') == 1
    assert err.startswith(f'{program}: ')
    return err


def without(hidden, module, words):
    """Return the finished process of a program's ``main`` run without the modules ``hidden``."""
    code = WITHOUT.format(path=sys.path, hidden=hidden, module=module, words=list(words))
    return subprocess.run([sys.executable, '-c', code], capture_output=True, text=True,
                          timeout=60)


def loaded(name):
    """Return an example as a module."""
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f'{name}.py')
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def console_scripts():
    """Return {name: (module, function)} of the programs that are installed."""
    setup = (EXAMPLES.parent / 'setup.py').read_text(encoding='utf-8')
    return {name: (module, function) for name, module, function in re.findall(
        r"'(\w+) = ([\w.]+):(\w+)'", setup)}


def helpful(name, monkeypatch, capsys):
    """Hold that a program's help says what it is for, with an example and its exit codes."""
    module, function = console_scripts()[name]
    monkeypatch.setattr(sys, 'argv', [name, '--help'])
    try:
        code = getattr(importlib.import_module(module), function)()
    except SystemExit as leaving:
        code = leaving.code
    said, wrong = capsys.readouterr()
    assert code == 0 and wrong == ''
    usage, *_, last = said.strip().split('\n\n')
    assert usage.startswith(f'usage: {name} ')
    example, codes = last.splitlines()[0], ' '.join(last.splitlines()[1:])
    words = shlex.split(example.removeprefix('Example: '))
    assert example.startswith(f'Example: {name} ') and words[0] == name
    before = said[:said.index('Example: ')]
    for word in words[1:]:
        assert not word.startswith('--') or word in before, word
        assert not word.startswith('config/') or (EXAMPLES.parent / word).is_file(), word
    assert re.match(r'Exit code: 0\b.*; 2 after one line that says what is wrong', codes)
    # What it is for: between the usage and the arguments, a sentence.
    assert re.search(r'^[A-Z][^\n]* [a-z][^.]*\.', '\n\n'.join(said.split('\n\n')[1:]), re.M)
