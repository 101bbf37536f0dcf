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

from importlib import import_module

from .messages import set_stamp, set_vector


def check(values):
    """Raise ValueError for parameters that ask for transforms where tf2_msgs is not installed."""
    if values['publish_tf']:
        try:
            import_module('tf2_msgs.msg')
        except ImportError as error:
            raise ValueError(f'publish_tf: needs tf2_msgs ({error}): apt install '
                             'ros-jazzy-tf2-msgs, or set publish_tf to false') from None


def prefix(namespace):
    """Return what keeps the frames of a namespace apart: red/ of /red, nothing of /."""
    return namespace.strip('/') + '/' if namespace.strip('/') else ''


def topics_of(topics, scene, now):
    """
    Return the topics of every period that a scene asks for: (publisher, message, fill) each.

    Main arguments: ``topics`` as `NodeTopics`; ``scene``; ``now`` ns.  The map is where the world
    is: that is said once, and kept for late listeners.
    """
    if not scene.values['publish_tf']:
        return []
    map_frame = scene.values['map_frame']
    if map_frame:
        same_place = _message(topics.make, map_frame, scene.world_frame)
        set_stamp(same_place.transforms[0].header.stamp, now)
        topics.publisher('/tf_static', same_place).publish(same_place)
    moving = _message(topics.make, scene.world_frame, scene.body_frame)
    return [(topics.publisher('/tf', moving), moving, _fill)]


def _message(make, parent, child):
    """Return a TFMessage of one transform, which turns and moves nothing so far."""
    message, transform = make('tf2_msgs/msg/TFMessage'), make('geometry_msgs/msg/TransformStamped')
    transform.header.frame_id, transform.child_frame_id = parent, child
    transform.transform.rotation.w = 1.0
    message.transforms = [transform]
    return message


def _fill(message, frame):
    transform, = message.transforms
    set_stamp(transform.header.stamp, frame.stamp)
    set_vector(transform.transform.translation, frame.position)
    turned = transform.transform.rotation
    turned.x, turned.y, turned.z, turned.w = frame.orientation
