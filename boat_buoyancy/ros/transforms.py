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
Where the boat is as tf2 wants it: `/tf` every period and, with a map, `/tf_static` once.

tf2_msgs comes with every ROS installation, but not with the wheels: only this needs it.
"""

from geometry_msgs.msg import TransformStamped

from . import qos
from .messages import set_stamp, set_vector

try:
    from tf2_msgs.msg import TFMessage
except ImportError as error:
    TFMessage, MISSING = None, str(error)


def check(values):
    """Raise ValueError for parameters that ask for transforms where tf2_msgs is not installed."""
    if values['publish_tf'] and TFMessage is None:
        raise ValueError(f'publish_tf: needs tf2_msgs ({MISSING}): apt install '
                         'ros-jazzy-tf2-msgs, or set publish_tf to false')


def prefix(namespace):
    """Return what keeps the frames of a namespace apart: red/ of /red, nothing of /."""
    return namespace.strip('/') + '/' if namespace.strip('/') else ''


def topics_of(node, scene):
    """
    Return the topics of every period that a scene asks for: (publisher, message, fill) each.

    The map is where the world is: that is said once, and kept for late listeners.
    """
    if not scene.values['publish_tf']:
        return []
    map_frame = scene.values['map_frame']
    if map_frame:
        same_place = _message(map_frame, scene.world_frame)
        set_stamp(same_place.transforms[0].header.stamp, node.get_clock().now().nanoseconds)
        node.create_publisher(TFMessage, '/tf_static', qos.FIXED_TRANSFORMS).publish(same_place)
    return [(node.create_publisher(TFMessage, '/tf', qos.TRANSFORMS),
             _message(scene.world_frame, scene.body_frame), _fill)]


def _message(parent, child):
    """Return a TFMessage of one transform, which turns and moves nothing so far."""
    transform = TransformStamped(child_frame_id=child)
    transform.header.frame_id = parent
    return TFMessage(transforms=[transform])


def _fill(message, frame):
    transform, = message.transforms
    set_stamp(transform.header.stamp, frame.stamp)
    set_vector(transform.transform.translation, frame.position)
    turned = transform.transform.rotation
    turned.x, turned.y, turned.z, turned.w = frame.orientation
