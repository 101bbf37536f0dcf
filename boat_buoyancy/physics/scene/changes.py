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

"""What is given after some parameters were changed while a boat runs."""

from .parameter_names import check_names
from .parameters import WAVE_KINDS

# Parameters that ask for waves; the rest of sea.* only shapes them.
WAVES = frozenset(name for kind in WAVE_KINDS for name in kind)


def changed(given, at_start, requested):
    """
    Return what is given after a change, {name: value}; ValueError for a name that is none.

    ``given`` {name: value} before it; ``at_start``, what was given in the beginning;
    ``requested`` {name: value}, where None goes back to the beginning.  A change that asks for
    one kind of waves replaces the others.
    """
    check_names(requested)
    given = {**given, **requested,
             **{name: at_start.get(name) for name, value in requested.items() if value is None}}
    for kind in WAVE_KINDS:
        if any(given.get(name) for name in kind if name in requested):
            for other in WAVE_KINDS:
                for name in other:
                    if other is not kind and name not in requested:
                        given.pop(name, None)
    # What is taken away brings back the waves that it replaced.
    if WAVES.intersection(requested) and not any(map(given.get, WAVES)):
        given.update((name, at_start.get(name)) for name in WAVES.difference(requested))
    return {name: value for name, value in given.items() if value is not None}
