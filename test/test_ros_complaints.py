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

"""Refused messages are counted by reason and said now and then."""

from boat_buoyancy.ros.complaints import Complaints, Refused


def test_complaints_are_all_counted_and_said_once_in_five_seconds():
    said = []
    complaints = Complaints(said.append)
    for i in range(100):
        complaints.add('thrust', Refused('not finite', 'thrust: nan'), 0.01 * i)
    complaints.add('thrust', Refused('unknown frame', 'thrust: map'), 1.0)
    complaints.add('thrust', Refused('not finite', 'thrust: nan'), 6.0)
    assert said == ['thrust: nan', 'thrust: map', 'thrust: nan (99 more like it before)']
    assert complaints.counts == {'thrust: not finite': 101, 'thrust: unknown frame': 1}
