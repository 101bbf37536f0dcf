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
Rotations as unit quaternions in ROS order (x, y, z, w), body to world.

Quaternions and vectors are tuples of components: floats in the step, arrays of a fleet elsewhere.
"""

import math

import numpy as np

from .compiled import compiled


@compiled
def rotation_matrix(quaternion):
    """
    Return R, body to world, of a unit quaternion: three rows of three.

    Its third row is the world's z axis in body axes.
    """
    x, y, z, w = quaternion
    return ((1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)),
            (2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)),
            (2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)))


@compiled
def to_world(R, v):
    """Return R v, a vector of body axes in world axes."""
    return (R[0][0] * v[0] + R[0][1] * v[1] + R[0][2] * v[2],
            R[1][0] * v[0] + R[1][1] * v[1] + R[1][2] * v[2],
            R[2][0] * v[0] + R[2][1] * v[1] + R[2][2] * v[2])


@compiled
def to_body(R, v):
    """Return R^T v, a vector of world axes in body axes."""
    return (R[0][0] * v[0] + R[1][0] * v[1] + R[2][0] * v[2],
            R[0][1] * v[0] + R[1][1] * v[1] + R[2][1] * v[2],
            R[0][2] * v[0] + R[1][2] * v[1] + R[2][2] * v[2])


@compiled
def product(p, q):
    """Return the Hamilton product p q: rotate by q first, then by p."""
    px, py, pz, pw = p
    qx, qy, qz, qw = q
    return (pw * qx + px * qw + py * qz - pz * qy,
            pw * qy - px * qz + py * qw + pz * qx,
            pw * qz + px * qy - py * qx + pz * qw,
            pw * qw - px * qx - py * qy - pz * qz)


@compiled
def normalise(q):
    """Return the quaternion scaled to unit length."""
    x, y, z, w = q
    s = 1.0 / math.sqrt(x * x + y * y + z * z + w * w)
    return (s * x, s * y, s * z, s * w)


def from_roll_pitch_yaw(roll, pitch, yaw):
    """
    Return the quaternion (x, y, z, w) of fixed-axis roll, pitch, yaw in rad (REP-103).

    Roll is turned first, about x, then pitch about y, then yaw about z, all world axes.
    """
    cr, sr = np.cos(roll / 2), np.sin(roll / 2)
    cp, sp = np.cos(pitch / 2), np.sin(pitch / 2)
    cy, sy = np.cos(yaw / 2), np.sin(yaw / 2)
    return (sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy)


def to_roll_pitch_yaw(quaternion):
    """Return roll, pitch, yaw in rad of a unit quaternion; pitch lies within +-pi/2."""
    x, y, z, w = quaternion
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0))
    yaw = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return roll, pitch, yaw
