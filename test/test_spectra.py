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

"""Irregular seas: heights, periods and phases against the definitions they come from."""

from boat_buoyancy.physics import Sea
from boat_buoyancy.physics.sea import spectra
import numpy as np
import pytest
from scipy import integrate, signal


def spectral_moment(order):
    """Return the integral of f^order times the JONSWAP spectrum over f / f_p."""
    edges = (0.2, 0.8, 1.0, 1.2, 2.0, 10.0, 1e4)
    return sum(integrate.quad(lambda f: f ** order * float(spectra.jonswap(np.array(f))),
                              a, b, epsabs=1e-14, epsrel=1e-12, limit=500)[0]
               for a, b in zip(edges, edges[1:]))


def significant_height(waves):
    return 4.0 * np.sqrt(np.sum(waves[:, 0] ** 2 / 2.0))


def mean_zero_crossing_period(waves):
    """Return 2 pi sqrt(m0 / m2) of rows of waves."""
    energy = waves[:, 0] ** 2 / 2.0
    return np.sqrt(energy.sum() / np.sum(energy / waves[:, 1] ** 2))


def test_the_spectrum_has_the_published_ratio_of_zero_crossing_to_peak_period():
    ratio = np.sqrt(spectral_moment(0) / spectral_moment(2))
    assert ratio == pytest.approx(0.778, abs=1e-3)


@pytest.mark.parametrize('count', [1, 4, 16, 64, 256, 1000])
def test_any_number_of_components_has_the_zero_crossing_period_of_the_spectrum(count):
    waves = spectra.jonswap_waves(2.0, 10.0, components=count)
    of_spectrum = 10.0 * np.sqrt(spectral_moment(0) / spectral_moment(2))
    assert mean_zero_crossing_period(waves) == pytest.approx(of_spectrum, rel=1e-4)


def test_a_gamma_of_one_is_pierson_moskowitz():
    # Its own ratio is known in closed form: (pi 1.25)^-1/4.
    def moment(order):
        return integrate.quad(lambda f: f ** order * float(spectra.jonswap(np.array(f), 1.0)),
                              0.1, np.inf, limit=500)[0]
    assert np.sqrt(moment(0) / moment(2)) == pytest.approx((np.pi * 1.25) ** -0.25, rel=1e-6)


@pytest.mark.parametrize('count', [1, 3, 16, 1000])
@pytest.mark.parametrize('height', [0.05, 3.25, 16.0])
def test_the_significant_height_is_exact(count, height):
    waves = spectra.jonswap_waves(height, 9.0, components=count)
    assert significant_height(waves) == pytest.approx(height, rel=1e-14)
    assert np.ptp(waves[:, 0]) == 0.0


@pytest.mark.parametrize('count', [16, 64])
def test_each_component_holds_an_equal_part_of_the_spectrum(count):
    frequency = spectra.equal_energy_frequencies(count)
    assert (np.diff(frequency) > 0).all()
    energy = [integrate.quad(lambda f: float(spectra.jonswap(np.array(f))), 0.2, f,
                             points=[0.8, 1.0, 1.2], limit=500)[0] for f in frequency]
    parts = np.array(energy) / spectral_moment(0) * count
    # Each lies within its own part: between i and i + 1 of them.
    assert (np.floor(parts) == np.arange(count)).all()


def test_a_measured_record_has_the_height_and_peak_that_were_asked_for():
    sea = Sea(spectra.jonswap_waves(2.0, 8.0, components=200))
    time = np.arange(0.0, 6 * 3600.0, 0.5)
    record = np.concatenate([sea.elevation(0.0, 0.0, part) for part in np.split(time, 20)])
    assert 4.0 * record.std() == pytest.approx(2.0, rel=0.03)
    frequency, power = signal.welch(record, 2.0, nperseg=1024)
    assert 1.0 / frequency[np.argmax(power)] == pytest.approx(8.0, rel=0.05)
    rising = np.count_nonzero((record[:-1] < 0.0) & (record[1:] >= 0.0))
    assert time[-1] / rising == pytest.approx(0.778 * 8.0, rel=0.02)


def test_the_frequencies_share_no_common_period():
    frequency = spectra.equal_energy_frequencies(16)

    def likeness(frequencies):
        """Return the most the sea is like itself at a later time, 1 = it has come back."""
        later = np.arange(10.0, 5000.0, 0.02)
        return max(np.cos(2 * np.pi * np.outer(part, frequencies)).mean(axis=1).max()
                   for part in np.array_split(later, 10))

    # Evenly spaced frequencies come back after one over their spacing.
    assert likeness(1.0 + 0.1 * np.arange(16)) == pytest.approx(1.0, abs=1e-6)
    assert likeness(frequency) < 0.85


def test_the_same_seed_is_the_same_sea_for_ever():
    waves = spectra.jonswap_waves(2.0, 8.0, direction=0.5, components=4, seed=7)
    np.testing.assert_allclose(waves, [
        [0.3535533905932738, 8.960389707188055, 0.5, 3.927590651355011],
        [0.3535533905932738, 7.899828591328004, 0.5, 5.637360571650786],
        [0.3535533905932738, 7.020157710216407, 0.5, 4.873776931938056],
        [0.3535533905932738, 4.2778085558714345, 0.5, 1.4150185072200883]], rtol=1e-12)
    assert np.array_equal(waves, spectra.jonswap_waves(2.0, 8.0, direction=0.5, components=4,
                                                       seed=7))


def test_another_seed_has_other_phases_and_the_same_frequencies():
    one, two = (spectra.jonswap_waves(2.0, 8.0, seed=seed) for seed in (1, 2))
    assert np.array_equal(one[:, :3], two[:, :3])
    assert (np.abs(one[:, 3] - two[:, 3]) > 1e-3).all()


def test_no_spreading_is_the_sea_of_one_direction_and_any_keeps_all_but_directions():
    sea = {'direction': 0.4, 'components': 33, 'seed': 5}
    long_crested = spectra.jonswap_waves(2.0, 8.0, **sea)
    assert (long_crested[:, 2] == 0.4).all()
    assert np.array_equal(long_crested, spectra.jonswap_waves(2.0, 8.0, spreading=0.0, **sea))
    spread = spectra.jonswap_waves(2.0, 8.0, spreading=10.0, **sea)
    assert np.array_equal(np.delete(long_crested, 2, 1), np.delete(spread, 2, 1))
    assert len(set(spread[:, 2])) == 33


@pytest.mark.parametrize('s', [1.0, 5.0, 10.0, 75.0])
@pytest.mark.parametrize('count', [2, 16, 1000])
def test_the_directions_have_the_mean_and_the_spread_of_the_distribution(count, s):
    directions = spectra.jonswap_waves(2.0, 8.0, direction=0.7, components=count,
                                       spreading=s)[:, 2]
    # Circular moments of equal energies; those of cos^2s(theta / 2): m1 = s / (1 + s).
    moment = np.exp(1j * directions).mean()
    assert np.angle(moment) == pytest.approx(0.7, abs=1e-12)
    assert np.sqrt(2.0 * (1.0 - abs(moment))) == pytest.approx(np.sqrt(2.0 / (1.0 + s)), rel=1e-6)


@pytest.mark.parametrize('s', [1.0, 10.0])
def test_each_direction_holds_an_equal_part_of_the_distribution(s):
    def energy(angle):
        return integrate.quad(lambda a: np.cos(a / 2.0) ** (2.0 * s), -np.pi, angle)[0]
    parts = [energy(a) / energy(np.pi) for a in spectra.equal_energy_directions(17, s)]
    # The middle one is the mean direction itself.
    assert (np.floor(np.multiply(parts, 17)) == np.arange(17)).all()
    assert parts[8] == pytest.approx(0.5, abs=1e-12)


def test_a_wave_of_any_frequency_goes_anywhere_and_the_seed_says_where():
    def directions(seed):
        return spectra.jonswap_waves(2.0, 8.0, components=1000, seed=seed, spreading=10.0)[:, 2]
    assert np.array_equal(directions(3), directions(3))
    assert not np.array_equal(directions(3), directions(4))
    for seed in range(5):
        # Of independent ranks the correlation scatters by 1 / sqrt(1000).
        ranks = np.argsort(np.argsort(directions(seed)))
        assert abs(np.corrcoef(ranks, np.arange(1000))[0, 1]) < 4.0 / np.sqrt(1000.0)


def test_the_same_seed_is_the_same_spread_sea_for_ever():
    waves = spectra.jonswap_waves(2.0, 8.0, direction=0.5, components=4, seed=7, spreading=10.0)
    np.testing.assert_allclose(waves[:, 2], [
        0.6664634345766368, -0.08808444953306138, 1.0880844495330562, 0.3335365654233641],
        rtol=1e-12)


def test_phases_fill_the_circle_evenly():
    phases = spectra.jonswap_waves(2.0, 8.0, components=1000)[:, 3]
    assert (0.0 <= phases).all() and (phases < 2 * np.pi).all()
    counts = np.histogram(phases, 10, (0.0, 2 * np.pi))[0]
    assert (np.abs(counts - 100) < 40).all()


def test_sea_states_have_the_heights_of_the_wmo_table():
    heights = [spectra.sea_state(state)[0] for state in range(10)]
    assert heights == [0.0, 0.05, 0.3, 0.875, 1.875, 3.25, 5.0, 7.5, 11.5, 16.0]


def test_sea_state_5_peaks_at_8_978_s():
    assert spectra.sea_state(5)[1] == pytest.approx(8.978, abs=5e-4)


def test_the_peak_period_is_that_of_a_fully_grown_sea():
    for state in range(1, 10):
        height, period = spectra.sea_state(state)
        wind = 0.879 * 9.81 * period / (2 * np.pi)
        assert height == pytest.approx(0.21 * wind ** 2 / 9.81, rel=1e-12)


@pytest.mark.parametrize('state', [10, -1, 3.5, True, '5', None])
def test_a_sea_state_that_is_not_in_the_table_is_refused(state):
    with pytest.raises(ValueError, match='sea.sea_state: expected an integer'):
        spectra.sea_state(state)


def test_no_height_is_no_waves():
    assert spectra.jonswap_waves(0.0, 5.0).shape == (0, 4)
    assert Sea(spectra.jonswap_waves(0.0, 5.0)).is_flat


def test_the_shortest_peak_still_makes_waves_that_a_sea_takes():
    waves = spectra.jonswap_waves(0.001, spectra.MIN_PEAK_PERIOD, components=1000)
    assert len(Sea(waves).waves) == 1000


@pytest.mark.parametrize('wrong, name', [
    ({'significant_height': -1.0}, 'sea.significant_height'),
    ({'significant_height': np.nan}, 'sea.significant_height'),
    ({'peak_period': 0.0}, 'sea.peak_period'), ({'peak_period': np.inf}, 'sea.peak_period'),
    ({'components': 0}, 'sea.components'), ({'components': 4.0}, 'sea.components'),
    ({'spreading': -1.0}, 'sea.spreading'), ({'spreading': np.nan}, 'sea.spreading'),
    ({'seed': -1}, 'sea.seed'), ({'seed': 1.5}, 'sea.seed'),
    ({'direction': np.nan}, 'sea.direction')])
def test_wrong_numbers_are_named(wrong, name):
    with pytest.raises(ValueError, match=f'^{name}: expected'):
        spectra.jonswap_waves(**{'significant_height': 2.0, 'peak_period': 8.0, **wrong})
