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

All functions take and give tuples of components, floats or arrays alike (see ``backend``).
"""

import numpy as np


def rotation_matrix(quaternion):
    """
    Return the matrix of a unit quaternion as nine components, row by row.

    The matrix takes body axes to world axes; its third row is the world's z axis in body axes.
    """
    x, y, z, w = quaternion
    x2, y2, z2 = x + x, y + y, z + z
    xx, yy, zz = x * x2, y * y2, z * z2
    xy, xz, yz = x * y2, x * z2, y * z2
    wx, wy, wz = w * x2, w * y2, w * z2
    return (1.0 - (yy + zz), xy - wz, xz + wy,
            xy + wz, 1.0 - (xx + zz), yz - wx,
            xz - wy, yz + wx, 1.0 - (xx + yy))


def to_world(rotation, vector):
    """Return a body-axes vector in world axes; ``rotation`` as from `rotation_matrix`."""
    a, b, c, d, e, f, g, h, i = rotation
    x, y, z = vector
    return a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z


def to_body(rotation, vector):
    """Return a world-axes vector in body axes; ``rotation`` as from `rotation_matrix`."""
    a, b, c, d, e, f, g, h, i = rotation
    x, y, z = vector
    return a * x + d * y + g * z, b * x + e * y + h * z, c * x + f * y + i * z


def cross(a, b):
    """Return the cross product of two vectors given as components."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def multiply(p, q):
    """Return the Hamilton product p q: rotate by q first, then by p."""
    px, py, pz, pw = p
    qx, qy, qz, qw = q
    return (pw * qx + px * qw + py * qz - pz * qy,
            pw * qy - px * qz + py * qw + pz * qx,
            pw * qz + px * qy - py * qx + pz * qw,
            pw * qw - px * qx - py * qy - pz * qz)


def conjugate(q):
    """Return the inverse of a unit quaternion."""
    return -q[0], -q[1], -q[2], q[3]


def normalise(backend, q):
    """Return the quaternion scaled to unit length."""
    x, y, z, w = q
    scale = 1.0 / backend.sqrt(x * x + y * y + z * z + w * w)
    return x * scale, y * scale, z * scale, w * scale


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


def to_roll_pitch_yaw(q):
    """Return roll, pitch, yaw in rad of a unit quaternion; pitch lies within +-pi/2."""
    x, y, z, w = q
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0))
    yaw = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return roll, pitch, yaw
