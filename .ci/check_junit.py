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

"""Fail unless every test of a JUnit file passed and every given test file took part."""

import argparse
from pathlib import Path
import sys
from xml.etree import ElementTree


def complaints(junit, test_files):
    """Return one sentence per test that did not pass and per given file without a test."""
    cases = list(ElementTree.parse(junit).iter('testcase'))
    found = [
        f'{case.get("classname")}.{case.get("name")}: {outcome.tag}, {outcome.get("message")}'
        for case in cases
        for outcome in case
        if outcome.tag in ('skipped', 'failure', 'error')
    ]
    modules = {part for case in cases for part in case.get('classname').split('.')}
    for file in test_files:
        if Path(file).stem not in modules:
            found.append(f'{file}: none of its tests ran')
    if not cases:
        found.append(f'{junit}: no tests at all')
    return found


def main():
    """Print what is wrong and return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('junit')
    parser.add_argument('test_files', nargs='+')
    arguments = parser.parse_args()
    found = complaints(arguments.junit, arguments.test_files)
    for line in found:
        print(line, file=sys.stderr)
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
