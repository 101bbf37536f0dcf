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

"""The help of every program that needs ROS says what it is for, as that of the others does."""

from programs import console_scripts, helpful
import pytest


@pytest.mark.parametrize('name', [
    name for name, (module, _) in console_scripts().items() if '.ros.' in module])
def test_help_says_what_a_program_is_for_with_an_example_and_exit_codes(
        name, monkeypatch, capsys):
    helpful(name, monkeypatch, capsys)
