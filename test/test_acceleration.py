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

"""The acceleration of a simulation is that of its forces: gravity, lift, drag, thrust, spin."""

import math

from boat_buoyancy.physics import load_scene
import numpy as np
import pytest

AIR = {'damping.air_linear_retention': [1.0], 'damping.air_angular_retention': [1.0],
       'start.position': [0.0, 0.0, 50.0]}


def test_at_rest_nothing_accelerates():
    linear, angular = load_scene({}).simulation().acceleration()
    assert np.abs([*linear, *angular]).max() < 1e-9


def test_in_the_air_gravity_is_all_there_is_at_any_attitude():
    sim = load_scene({**AIR, 'start.orientation': [math.pi / 2, 0.0, 0.3]}).simulation()
    linear, angular = sim.acceleration()
    # Starboard down: gravity is along -y.
    np.testing.assert_allclose(linear, [0.0, -9.81, 0.0], atol=1e-12)
    np.testing.assert_allclose(angular, 0.0, atol=1e-12)


def test_a_torque_free_body_turns_by_euler_s_equations():
    # I w' = I w x w: with I (3, 4, 5) and w (1, 0, 1.2), w'_y = (5 - 3) 1 1.2 / 4.
    sim = load_scene({**AIR, 'boat.inertia': [3.0, 4.0, 5.0],
                      'start.angular_velocity': [1.0, 0.0, 1.2]}).simulation()
    np.testing.assert_allclose(sim.acceleration()[1], [0.0, 2.0 * 1.2 / 4.0, 0.0], atol=1e-12)


def test_thrust_acts_at_the_body_origin():
    # In the air, 0.5 m below the centre of mass: 100 N ahead turn the bow up.
    sim = load_scene({**AIR, 'boat.center_of_mass': [0.0, 0.0, 0.5], 'boat.mass': 50.0,
                      'boat.inertia': [10.0, 20.0, 25.0]}).simulation()
    linear, angular = sim.acceleration([100.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(linear, [2.0, 0.0, -9.81], atol=1e-12)
    np.testing.assert_allclose(angular, [0.0, -100.0 * 0.5 / 20.0, 0.0], atol=1e-12)


@pytest.mark.parametrize('integrator', ['leapfrog', 'rk4'])
def test_it_is_the_change_of_the_velocity_in_waves(integrator):
    thrust = [900.0, -200.0, 0.0, 50.0, 0.0, 300.0]
    values = {'sea.waves': [0.05, 4.0, 0.7, 0.0], 'start.orientation': [0.05, -0.02, 0.4],
              'boat.center_of_mass': [0.1, 0.05, -0.1], 'integrator': integrator,
              'damping.quadratic': [50.0, 80.0, 100.0, 40.0, 50.0, 60.0], 'rate': 1000.0}
    # No edge dips and no probe leaves the water: there the acceleration jumps.
    sim = load_scene(values).simulation()
    before = None
    for _ in range(500):
        state = sim.state
        linear, angular = sim.acceleration(thrust)
        sim.step(thrust)
        if before is not None:
            # Central differences: off by h^2 / 6 of the third derivative, some 10 times w^2 of
            # the fastest motion, 6 rad/s: 1e-6 / 6 * 36 * 10.
            change = (sim.state.velocity - before.velocity) * 500.0
            spin = (sim.state.angular_velocity - before.angular_velocity) * 500.0
            there = rotation(state.orientation) @ linear
            np.testing.assert_allclose(there, change, atol=1e-4)
            np.testing.assert_allclose(angular, spin, atol=1e-4)
        before = state


def rotation(q):
    """Return the matrix (3, 3) of a unit quaternion x, y, z, w by Rodrigues' formula."""
    x, y, z = q[:3]
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + 2.0 * q[3] * K + 2.0 * K @ K


@pytest.mark.parametrize('thrust, said', [
    ([1.0], r'expected shape \(6,\), got \(1,\)'), ('full', 'expected six numbers')])
def test_a_wrong_thrust_is_refused(thrust, said):
    with pytest.raises(ValueError, match=said):
        load_scene({}).simulation().acceleration(thrust)
