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
Irregular seas: a significant height and peak period, or a sea state, turned into rows of waves.

JONSWAP spectrum: Hasselmann et al., Measurements of wind-wave growth and swell decay during the
Joint North Sea Wave Project, Deutsche Hydrographische Zeitschrift A8 (1973).  Sea states: WMO
code table 3700, middle of each class.  Spreading: Longuet-Higgins, Cartwright and Smith,
Observations of the directional spectrum of sea waves using the motions of a floating buoy (1963).
"""

from functools import lru_cache

import numpy as np

from .. import checks

# Significant height in m of WMO sea states 0 to 9.
SEA_STATE_HEIGHT = (0.0, 0.05, 0.3, 0.875, 1.875, 3.25, 5.0, 7.5, 11.5, 16.0)
PEAK_ENHANCEMENT = 3.3
# Shorter peaks would put the shortest of 1000 components under the least period of a wave.
MIN_PEAK_PERIOD = 0.1


def jonswap(frequency, gamma=PEAK_ENHANCEMENT):
    """
    Return the JONSWAP spectral density at ``frequency`` over peak frequency, up to a factor.

    f^-5 exp(-1.25 f^-4) gamma^exp(-(f - 1)^2 / (2 s^2)), s = 0.07 below the peak, 0.09 above.
    """
    width = np.where(frequency <= 1.0, 0.07, 0.09)
    peak = np.exp(-0.5 * ((frequency - 1.0) / width) ** 2)
    return frequency ** -5.0 * np.exp(-1.25 * frequency ** -4.0) * gamma ** peak


@lru_cache(maxsize=16)
def equal_energy_frequencies(count):
    """
    Return (count,) frequencies over peak frequency, one for each of ``count`` equal energies.

    Each is the root mean square frequency of its part of the spectrum, so that the sum has the
    spectrum's own mean zero-crossing period with any count.  Their spacing follows the spectrum
    and shares no common period.
    """
    # The tail past 300 peak frequencies would add 1e-5 to the mean square.
    frequency = np.geomspace(0.3, 300.0, 20001)
    density = jonswap(frequency)

    frequencies = np.sqrt(_means_of_equal_parts(frequency, density, frequency ** 2, count))
    frequencies.setflags(write=False)
    return frequencies


@lru_cache(maxsize=16)
def equal_energy_directions(count, spreading):
    """
    Return (count,) directions in rad from the mean one, from right to left, of equal energies.

    Each stands for its part of cos^2s(theta / 2), s = ``spreading`` above 0: its mean cosine is
    that of the part, so that an even count has the spread of the distribution,
    sqrt(2 / (1 + s)) rad (Kuik, van Vledder and Holthuijsen 1988), and an odd one nearly.
    """
    angle = np.linspace(-np.pi, np.pi, 20001)
    parts = _means_of_equal_parts(angle, np.cos(0.5 * angle) ** (2.0 * spreading),
                                  np.sin(0.5 * angle) ** 2, count)
    # 1 - cos = 2 sin^2 of the half, which keeps its digits near the mean direction.
    directions = 2.0 * np.arcsin(np.sqrt(parts)) * np.sign(2 * np.arange(count) - (count - 1))
    directions.setflags(write=False)
    return directions


def _means_of_equal_parts(x, density, values, count):
    """Return (count,) the mean of ``values`` over each of ``count`` equal parts of a density."""
    def running_integral(of):
        steps = 0.5 * (of[1:] + of[:-1]) * np.diff(x)
        return np.concatenate([[0.0], np.cumsum(steps)])

    whole = running_integral(density)
    edges = np.interp(np.linspace(0.0, whole[-1], count + 1), whole, x)
    edges[-1] = x[-1]
    return np.diff(np.interp(edges, x, running_integral(values * density))) * count / whole[-1]


def jonswap_waves(significant_height, peak_period, *, direction=0.0, components=16, seed=1,
                  spreading=0.0):
    """
    Return rows of waves (components, 4) of an irregular sea, as `Sea` takes them.

    Main arguments: ``significant_height`` m, 4 sqrt(sum a^2 / 2) exactly; ``peak_period`` s.
    Other arguments: ``direction`` rad, where the waves go; ``components`` how many;
    ``seed`` chooses the phases, same seed, same sea everywhere; ``spreading`` s, 0 = all in one
    direction, else they go about it as cos^2s(theta / 2), and the seed chooses which goes where.
    """
    height = checks.number('sea.significant_height', significant_height, at_least=0.0)
    period = checks.number('sea.peak_period', peak_period, at_least=MIN_PEAK_PERIOD)
    count = checks.count('sea.components', components, at_least=1)
    generator = np.random.Generator(np.random.PCG64(checks.count('sea.seed', seed, at_least=0)))
    mean = checks.number('sea.direction', direction)
    s = checks.number('sea.spreading', spreading, at_least=0.0)
    if height == 0.0:
        return np.zeros((0, 4))
    phases, directions = 2 * np.pi * generator.random(count), np.full(count, mean)
    if s > 0.0:
        # Whatever its frequency, a wave goes anywhere.
        directions += equal_energy_directions(count, s)[np.argsort(generator.random(count))]
    return np.stack([np.full(count, height * np.sqrt(0.125 / count)),
                     period / equal_energy_frequencies(count), directions, phases], axis=1)


def sea_state(state, gravity=9.81):
    """
    Return significant height m and peak period s of a WMO sea state, an integer 0 to 9.

    The period is that of a fully grown sea (Pierson and Moskowitz 1964): Hs = 0.21 U^2 / g and
    peak angular frequency 0.879 g / U.  State 0 is flat, with period 0.
    """
    if checks.count('sea.sea_state', state, at_least=0) >= len(SEA_STATE_HEIGHT):
        raise ValueError(f'sea.sea_state: expected an integer of 0 to 9, got {state!r}')
    height = SEA_STATE_HEIGHT[state]
    wind = np.sqrt(height * gravity / 0.21)
    return height, float(2 * np.pi * wind / (0.879 * gravity))
