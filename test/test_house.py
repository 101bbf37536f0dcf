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

"""The house: which folder may import which, and that the step is made of marked functions only."""

import ast
import builtins
import dis
from importlib import import_module
import inspect
import math
from pathlib import Path

import boat_buoyancy
from boat_buoyancy.physics import compiled
import pytest

ROOT = Path(boat_buoyancy.__file__).parent
# From the top down: a folder imports from itself and from those below it.
FLOORS = ('tools', 'ros', 'physics/scene', 'physics/step_size', 'physics/hydrostatics',
          'physics/stepping', 'physics/forces', 'physics/boat', 'physics/sea')
FOUNDATIONS = ('checks', 'compiled', 'rotation', 'trigonometry', 'vectors')
FILES = sorted(ROOT.rglob('*.py'))


def floor(path):
    """Return the number of the floor of a module, from the top; the foundations come last."""
    parts = path.relative_to(ROOT).as_posix()
    for number, folder in enumerate(FLOORS):
        if parts.startswith(folder + '/'):
            return number
    if parts.startswith('physics/') and path.stem in FOUNDATIONS:
        return len(FLOORS)
    return -1  # what binds a package together: __init__.py


def imported(path):
    """Yield the module files of this package that a file imports, at its top or inside."""
    package = path.parent
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = package
            for _ in range(node.level - 1):
                base = base.parent
            base = base.joinpath(*(node.module or '').split('.')) if node.module else base
            yield from _files(base, [alias.name for alias in node.names])
        elif isinstance(node, ast.ImportFrom) and (node.module or '').startswith('boat_buoyancy'):
            base = ROOT.joinpath(*node.module.split('.')[1:])
            yield from _files(base, [alias.name for alias in node.names])


def _files(base, names):
    if base.with_suffix('.py').exists():
        yield base.with_suffix('.py')
        return
    for name in names:
        module = base / f'{name}.py'
        yield module if module.exists() else base / name / '__init__.py' if (
            base / name).is_dir() else base / '__init__.py'


def test_every_module_is_on_a_floor():
    assert [path for path in FILES if floor(path) < 0 and path.name != '__init__.py'] == []


def test_no_import_runs_upwards():
    upwards = [
        f'{path.relative_to(ROOT)} imports {other.relative_to(ROOT)}'
        for path in FILES if floor(path) >= 0
        for other in imported(path)
        # `..physics` is the library as its users see it: only what is above it may take that.
        if (0 <= floor(other) < floor(path))
        or (other == ROOT / 'physics' / '__init__.py' and floor(path) > 1)]
    assert upwards == []


def test_the_imports_of_a_file_are_seen():
    # The test above is worth nothing if it sees no imports.
    seen = {other.relative_to(ROOT).as_posix()
            for other in imported(ROOT / 'physics' / 'stepping' / 'leapfrog.py')}
    assert {'physics/forces/load.py', 'physics/boat/state.py', 'physics/compiled.py',
            'physics/stepping/equations_of_motion.py'} <= seen


def test_no_import_goes_round_in_a_circle():
    graph = {path: set(imported(path)) for path in FILES}
    done, under_way = set(), []

    def visit(path):
        if path in under_way:
            circle = [*under_way[under_way.index(path):], path]
            pytest.fail(' -> '.join(str(other.relative_to(ROOT)) for other in circle))
        if path not in done:
            under_way.append(path)
            for other in graph.get(path, ()):
                visit(other)
            done.add(under_way.pop())

    for path in FILES:
        visit(path)


def test_the_physics_imports_no_ros_and_no_plots():
    for path in FILES:
        if 'physics' in path.relative_to(ROOT).parts:
            nodes = list(ast.walk(ast.parse(path.read_text())))
            modules = {(node.module or '').split('.')[0] for node in nodes
                       if isinstance(node, ast.ImportFrom)}
            modules |= {alias.name.split('.')[0] for node in nodes
                        if isinstance(node, ast.Import) for alias in node.names}
            assert not modules & {'rclpy', 'geometry_msgs', 'std_msgs', 'matplotlib',
                                  'scipy'}, path


def marked_functions():
    """Return every function of the physics that is marked for compiling."""
    found = {}
    for path in FILES:
        if 'physics' in path.relative_to(ROOT).parts and path.name != '__init__.py':
            name = '.'.join(path.relative_to(ROOT.parent).with_suffix('').parts)
            found.update((f'{name}.{function.__name__}', function)
                         for function in vars(import_module(name)).values()
                         if inspect.isfunction(function) and hasattr(function, 'arithmetic')
                         and function.__module__ == name)
    return found


def test_compiled_functions_call_marked_ones_and_math_only():
    marked = marked_functions()
    assert len(marked) > 40
    for name, function in marked.items():
        for instruction in dis.get_instructions(function):
            if instruction.opname == 'LOAD_GLOBAL':
                value = function.__globals__.get(instruction.argval,
                                                 getattr(builtins, instruction.argval, None))
                if inspect.isfunction(value):
                    assert hasattr(value, 'arithmetic'), f'{name} calls {instruction.argval}'
                elif inspect.ismodule(value):
                    assert value is math, f'{name} uses {instruction.argval}'


def test_no_arithmetic_assumes_that_numbers_are_finite():
    # The guard lives on what is not a number.
    for function in marked_functions().values():
        assert not set(function.arithmetic or ()) & {'nnan', 'ninf', 'fast'}
        assert function.arithmetic in (compiled.EXACT, compiled.FUSED, compiled.REORDERED)
