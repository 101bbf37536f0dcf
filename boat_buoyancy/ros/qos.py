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

"""How messages travel: a profile for each use, the one place where it is chosen."""

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

# What the node publishes. Reliable: a best-effort publisher reaches no reliable subscriber.
OUTPUT = QoSProfile(depth=10)
# Of wrenches only the latest counts, and its sender must never wait for the node.
THRUST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
# Waves and poses that others ask for. Volatile: a latched subscription does not hear
# `ros2 topic pub`.
REQUEST = QoSProfile(depth=10)
# Of winds only the latest counts, and one that is sent once must not be lost.
WIND = QoSProfile(depth=1)
# Waves that were latched before the node was there.
LATCHED_REQUEST = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
# The sea in force: whoever comes late is told, too.
SEA_IN_FORCE = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
# What is published otherwise, by topic: that, and transforms, as tf2 has them.
PROFILES = {'waves': SEA_IN_FORCE, '/tf': QoSProfile(depth=100),
            '/tf_static': QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)}
