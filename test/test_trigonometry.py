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

"""The step's own sine and cosine, against the C library's."""

import math

from boat_buoyancy.physics.compiled import machine_code
from boat_buoyancy.physics.trigonometry import decay, sine_cosine
import numpy as np
import pytest

plain_and_compiled = pytest.mark.parametrize(
    'twin', [lambda function: function, machine_code], ids=['plain', 'compiled'])


def angles(largest, count=20_000):
    """Return angles up to ``largest`` either way, many of them next to multiples of pi / 4."""
    random = np.random.default_rng(1)
    even = largest * random.uniform(-1.0, 1.0, count)
    small = np.exp(random.uniform(math.log(1e-300), math.log(largest), count))
    edges = np.round(even / (math.pi / 4)) * (math.pi / 4)
    beside = edges + np.spacing(edges) * random.integers(-3, 4, count)
    return np.concatenate([even, small, -small, edges, beside, [0.0, -0.0, 5e-324]]).tolist()


@plain_and_compiled
def test_of_angles_up_to_1e5_both_are_right_within_two_units_in_the_last_place(twin):
    function = twin(sine_cosine)
    for x in angles(1e5):
        for value, exact in zip(function(x), (math.sin(x), math.cos(x))):
            assert abs(value - exact) <= 2.0 * math.ulp(exact), x


@plain_and_compiled
def test_beyond_that_both_are_right_within_the_rounding_of_the_angle(twin):
    function = twin(sine_cosine)
    for x in angles(1e15):
        for value, exact in zip(function(x), (math.sin(x), math.cos(x))):
            assert abs(value - exact) <= math.ulp(x) + 2.0 * math.ulp(1.0), x


@plain_and_compiled
@pytest.mark.parametrize('largest', [10.0, 1e5, 1e15, 1e17, 1e300, 1e308])
def test_both_are_within_one_whatever_the_angle(twin, largest):
    values = np.array([twin(sine_cosine)(x) for x in angles(largest, 2000)])
    assert (np.abs(values) <= 1.0).all()


@plain_and_compiled
def test_what_is_no_angle_stays_so_and_raises_nothing(twin):
    function = twin(sine_cosine)
    assert all(math.isnan(value) for value in function(math.nan))
    for x in (math.inf, -math.inf):
        assert all(math.isnan(value) or abs(value) <= 1.0 for value in function(x))


@plain_and_compiled
def test_the_sine_is_odd_and_the_cosine_even(twin):
    function = twin(sine_cosine)
    for x in angles(1e6, 2000):
        sine, cosine = function(x)
        assert function(-x) == (-sine, cosine)


@plain_and_compiled
def test_the_decay_is_right_to_1e_11_of_it_down_to_e_to_the_minus_20_and_never_rises(twin):
    function = twin(decay)
    values = np.linspace(-20.0, 0.0, 20_001).tolist()
    for x in values:
        assert abs(function(x) / math.exp(x) - 1.0) <= 1e-11, x
    assert function(0.0) == 1.0
    # Beyond, it is next to nothing and stays so.
    deep = [function(x) for x in (-1e308, -1e3, -40.0, -30.0, -20.0)]
    assert 0.0 < deep[0] == deep[1] == deep[2] < deep[3] < deep[4] and deep[2] < 1e-16
