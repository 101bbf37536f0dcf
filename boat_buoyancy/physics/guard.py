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

"""The guard of a simulation: motion that is not finite, or faster than any force can make it."""

import numpy as np

from .bound import speed_norm, SpeedBound

# The bound is proved for the implicit method.  Others may pass it a little by their error; once
# unstable they pass it by orders of magnitude within a few steps.
MARGIN = 10.0


class Guard:
    """
    Follows the greatest speed that the forces can have given since the start.

    Main arguments: ``boat`` and ``sea`` as they are from now on; ``state`` the start, of one boat
    or a fleet; ``period`` s between calls of `passes`.
    """

    def __init__(self, boat, sea, state, period):
        """Take the bound of the boat on the sea, and the fastest of the fleet."""
        bound = self._bound = SpeedBound.of(boat, sea)
        self._period = period
        self._greatest, self._all = (np.max, np.all) if state.batch_shape else (float, bool)
        self._without_thrust = bound.forcing(), bound.limit()
        # Slower than this, the power of moving water over the speed means nothing.
        floor = (period * bound.power) ** 0.5 + 1e-150
        with np.errstate(over='ignore'):
            fastest = float(np.max(speed_norm(boat, state), initial=0.0))
        self._reached = max(fastest, floor)

    @property
    def limit(self):
        """Return the greatest |u|_M that is let pass now."""
        return MARGIN * self._reached

    def passes(self, motions, wrench=None):
        """
        Return whether the motions after one more period can be.

        ``wrench`` is the thrust of that period, six components about the centre of mass.  A
        period that passes counts towards the speed reached; one that does not leaves no trace.
        """
        bound, reached = self._bound, self._reached
        forcing, limit = self._without_thrust
        if wrench is not None:
            fx, fy, fz, tx, ty, tz = wrench
            thrust = (self._greatest(fx * fx + fy * fy + fz * fz) ** 0.5,
                      self._greatest(tx * tx + ty * ty + tz * tz) ** 0.5)
            forcing, limit = bound.forcing(*thrust), bound.limit(*thrust)
        gained = self._period * (forcing + bound.power_rate + bound.power / reached)
        reached = min(reached + gained, max(reached, limit))
        allowed = MARGIN * reached * MARGIN * reached
        for motion in motions:
            if not self._all(self._squared(motion) < allowed):
                return False
        self._reached = reached
        return True

    def fastest(self, motions):
        """Return which boat of a fleet is the fastest, one that is not finite before all."""
        squared = np.concatenate([np.atleast_1d(self._squared(motion)) for motion in motions])
        return int(np.argmax(np.where(np.isfinite(squared), squared, np.inf)))

    def _squared(self, motion):
        """Return at most |u|_M^2; not a number or infinite when any component is."""
        (x, y, z), (a, b, c, d), (u, v, w), (p, q, r) = motion
        # The least moment stands for all three.
        return (self._bound.mass * (u * u + v * v + w * w)
                + self._bound.least_moment * (p * p + q * q + r * r)
                + 0.0 * (x + y + z + a + b + c + d))
