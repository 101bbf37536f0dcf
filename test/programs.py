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

import importlib.util
from pathlib import Path
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
