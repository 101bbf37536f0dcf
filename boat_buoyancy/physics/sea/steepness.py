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

"""How steep a sea is: height over length."""

import numpy as np

from .dispersion import wavenumber


def wave_steepness(sea):
    """Return (W,) height over length of each wave of a `Sea`, 2 a k / 2 pi."""
    return 2.0 * sea.waves[:, 0] * np.hypot(*sea.wave_vector.T) / (2.0 * np.pi)


def breaking_steepness(sea):
    """
    Return (W,) height over length at which each wave of a `Sea` breaks, tanh(k h) / 7.

    Michell (1893) in deep water, Miche (1944) in any.
    """
    k = np.hypot(*sea.wave_vector.T)
    return (np.tanh(k * sea.depth) if sea.depth else np.ones_like(k)) / 7.0


def steepness(sea):
    """
    Return height over length of a `Sea`: of its wave, or of an irregular sea as a whole.

    The latter is the significant steepness, the significant height over the length of a wave of
    the mean zero-crossing period, 2 pi sqrt(m0 / m2) (DNV-RP-C205, 3.5); in deep water
    2 pi Hs / (g Tz^2).  Of the frequencies of who drifts with the current.  0 in flat water.
    """
    amplitude = sea.waves[:, 0]
    largest = amplitude.max(initial=0.0)
    if largest == 0.0:
        return 0.0
    # Ratios first: the squares of the smallest amplitudes are 0.
    energy = (amplitude / largest) ** 2
    if np.count_nonzero(energy) == 1:
        return float(wave_steepness(sea).max())
    frequency = np.sqrt(energy @ sea.intrinsic_frequency ** 2 / energy.sum())
    k = wavenumber(frequency, sea.depth, sea.gravity)
    return float(largest * 4.0 * np.sqrt(0.5 * energy.sum()) * k / (2.0 * np.pi))
