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
What keeps a network that drops from holding up the steps.

While a host does not answer any more, Linux keeps what is sent to it until the socket is full;
then a send waits, for up to three seconds, and with it every publication to anybody.  Fast DDS can
be told never to wait, what is reliable is sent again, and to have room for those that do answer.
"""

import os
from pathlib import Path

PROFILE = Path(__file__).with_name('fast_dds.xml')
VARIABLE = 'FASTRTPS_DEFAULT_PROFILES_FILE'
# Who sets one of these has chosen how to talk to the network; ours would replace it.
CHOICES = (VARIABLE, 'FASTDDS_DEFAULT_PROFILES_FILE', 'FASTDDS_BUILTIN_TRANSPORTS',
           'ROS_DISCOVERY_SERVER')
# A file of this name in the working directory is read by Fast DDS itself.
LOCAL_PROFILE = 'DEFAULT_FASTRTPS_PROFILES.xml'


def never_wait(environment=os.environ):
    """
    Let Fast DDS read our profile, unless the user has chosen otherwise.

    ``environment`` is read when rclpy is initialised.  On a machine that talks to itself
    alone nothing waits, and rmw adds transports of its own.
    """
    if not (any(environment.get(name) for name in CHOICES)
            or environment.get('RMW_IMPLEMENTATION', 'rmw_fastrtps_cpp') != 'rmw_fastrtps_cpp'
            or environment.get('ROS_LOCALHOST_ONLY') == '1'
            or environment.get('ROS_AUTOMATIC_DISCOVERY_RANGE') in ('LOCALHOST', 'OFF')
            or Path(LOCAL_PROFILE).exists()):
        environment[VARIABLE] = str(PROFILE)
