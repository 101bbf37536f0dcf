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

"""What the sensors on board say: of the forces, at their rates, with the noise that is asked."""

import math
from types import SimpleNamespace

from boat_buoyancy.physics import load_scene
from boat_buoyancy.ros.messages import Outputs
from boat_buoyancy.ros.sensors import sensors_of
from boat_buoyancy.ros.session import Session
from boat_buoyancy.ros.topics import NodeTopics
import numpy as np
import pytest
from ros_probe import BoatProcess, nanoseconds, Probe
from sensor_msgs.msg import Imu, NavSatFix

# No drag in the air: a falling boat feels nothing at all.
FALLING = {'damping.air_linear_retention': [1.0], 'damping.air_angular_retention': [1.0],
           'start.position': [0.0, 0.0, 100.0]}
START = 7_000_000_000  # ns


class Recorder:
    """Stands for a node and all its publishers; keeps copies of what sensors publish."""

    def __init__(self, listeners=('imu', 'fix'), name='/boat_buoyancy'):
        """Let some topics be listened to."""
        self.listeners, self.rows = listeners, {'imu': [], 'fix': []}
        self.get_fully_qualified_name = lambda: name

    def create_publisher(self, kind, topic, _):
        """Return a publisher that writes down the numbers of a message."""
        return SimpleNamespace(
            get_subscription_count=lambda: int(topic in self.listeners),
            publish=lambda message: self.rows[topic].append(row_of(message)))


def row_of(message):
    """Return stamp s and the numbers of an Imu or a NavSatFix."""
    stamp = nanoseconds(message.header.stamp)
    if isinstance(message, NavSatFix):
        return [stamp, message.latitude, message.longitude, message.altitude]
    q, w, a = (message.orientation, message.angular_velocity, message.linear_acceleration)
    return [stamp, q.x, q.y, q.z, q.w, w.x, w.y, w.z, a.x, a.y, a.z]


def record(values, periods, *, thrust=None, start=0, **node):
    """Return the rows of imu (n, 11) and fix (n, 4) over some periods, and the session."""
    recorder = Recorder(**node)
    session = Session(load_scene({'thrust.timeout': 0.0, **values}), start)
    topics = NodeTopics(recorder)
    outputs = Outputs(topics, session.scene, sensors_of(topics, session.scene))
    outputs.publish(session)
    if thrust is not None:
        session.thrust.hold(thrust, False, 0.0)
    for _ in range(periods):
        session.step()
        outputs.publish(session)
    return np.array(recorder.rows['imu']), np.array(recorder.rows['fix']), session


def test_at_rest_the_imu_reads_g_up_and_nothing_else_wherever_it_sits():
    imu, _, _ = record({'imu.position': [1.5, -0.7, 2.0]}, 100)
    np.testing.assert_allclose(imu[:, 1:], [[0, 0, 0, 1, 0, 0, 0, 0, 0, 9.81]] * 101, atol=1e-9)


def test_in_free_fall_it_reads_nothing():
    imu, _, _ = record({**FALLING, 'start.orientation': [0.4, -0.3, 1.0],
                        'imu.position': [1.0, 0.5, 0.2]}, 100)
    np.testing.assert_allclose(imu[:, 5:], 0.0, atol=1e-12)


def test_off_the_centre_of_a_turning_boat_it_reads_the_pull_to_the_axis():
    # Turning about body z at 2 rad/s in free fall: -w^2 r, r from the centre of mass.
    imu, _, _ = record({**FALLING, 'start.angular_velocity': [0.0, 0.0, 2.0],
                        'boat.center_of_mass': [0.2, 0.0, 0.1],
                        'imu.position': [0.7, -0.3, 0.9]}, 50)
    np.testing.assert_allclose(imu[:, 8:], [[-4.0 * 0.5, 4.0 * 0.3, 0.0]] * 51, atol=1e-9)
    np.testing.assert_allclose(imu[:, 5:8], [[0.0, 0.0, 2.0]] * 51, atol=1e-12)


def test_thrust_is_felt_ahead():
    imu, _, _ = record({**FALLING, 'thrust.timeout': 0.0}, 2, thrust=(4000.0, 0, 0, 0, 0, 0))
    # On 2000 kg; the first message is of before.
    np.testing.assert_allclose(imu[:, 8], [0.0, 2.0, 2.0], atol=1e-12)


def rotations(q):
    """Return (n, 3, 3) of unit quaternions (n, 4) by Rodrigues' formula."""
    x, y, z, w = q.T
    K = np.zeros((len(q), 3, 3))
    K[:, 0, 1], K[:, 0, 2], K[:, 1, 0] = -z, y, z
    K[:, 1, 2], K[:, 2, 0], K[:, 2, 1] = -x, -y, x
    return np.eye(3) + 2.0 * w[:, None, None] * K + 2.0 * K @ K


def track_error(rate):
    """Return how far the track of an IMU in waves is from that of its force integrated twice."""
    place = np.array([1.2, -0.6, 1.5])
    values = {'rate': rate, 'imu.rate': rate, 'imu.position': place.tolist(),
              'sea.waves': [0.2, 3.0, 0.7, 0.0], 'boat.center_of_mass': [0.1, 0.05, -0.1],
              'damping.quadratic': [50.0, 80.0, 100.0, 40.0, 50.0, 60.0],
              'start.orientation': [0.05, 0.0, 0.4]}
    scene = load_scene(values)
    run = scene.simulation().run(5.0)
    turned = rotations(run.orientation)
    track = run.position + turned @ place
    imu, _, _ = record(values, round(5.0 * rate))
    force = np.einsum('nij,nj->ni', rotations(imu[:, 1:5]), imu[:, 8:]) - [0.0, 0.0, 9.81]
    speed = run.velocity[0] + np.cross(turned[0] @ run.angular_velocity[0], turned[0] @ place)
    velocity = speed + integrated(force, rate)
    return np.abs(track[0] + integrated(velocity, rate) - track).max()


def integrated(values, rate):
    """Return the integral (n, 3) over time by trapezoids."""
    steps = 0.5 * (values[1:] + values[:-1]) / rate
    return np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])


def test_its_force_integrated_twice_is_the_track_as_well_as_the_step_allows():
    # Both rules and the integrator are of second order: a quarter of the error at half the step,
    # to a few %. 5 s of 3 m/s^2 at up to 6 rad/s: h^2 w^2 a t^2 / 24 = 1e-4 * 36 * 3 * 25 / 24.
    coarse, fine = track_error(100.0), track_error(200.0)
    assert coarse < 0.011
    assert 3.4 < coarse / fine < 4.6


@pytest.fixture(scope='module')
def noisy():
    """Return imu and fix of a boat at rest with noise, and the session."""
    return record({'imu.accelerometer_noise': 0.05, 'imu.gyroscope_noise': 0.002,
                   'imu.orientation_noise': 0.01, 'fix.noise': [0.8, 1.6], 'fix.rate': 100.0},
                  4000)


def noises(noisy):
    """Return {name: (deviation asked for, noise (n,))} of every number, fix in m."""
    imu, fix, _ = noisy
    degree = math.pi / 180.0 * 6378137.0
    columns = {}
    for i, axis in enumerate('xyz'):
        # Of a small turn, twice the vector part is the angle.
        columns[f'orientation {axis}'] = 0.01, 2.0 * imu[:, 1 + i]
        columns[f'gyroscope {axis}'] = 0.002, imu[:, 5 + i]
        columns[f'accelerometer {axis}'] = 0.05, imu[:, 8 + i] - 9.81 * (axis == 'z')
    # At the equator; a degree of latitude is 1 - e^2 shorter.
    columns['east'] = 0.8, fix[:, 2] * degree
    columns['north'] = 0.8, fix[:, 1] * degree * (1.0 - 0.00669438)
    columns['up'] = 1.6, fix[:, 3] - load_scene({}).start.position[2]
    return columns


def test_noise_has_the_variance_that_was_asked_for_and_no_mean(noisy):
    for name, (deviation, noise) in noises(noisy).items():
        n = len(noise)
        # Five standard deviations of the two estimates, 12 numbers: one in 100 000 seeds.
        assert abs(noise.std() / deviation - 1.0) < 5.0 / math.sqrt(2.0 * n), name
        assert abs(noise.mean()) < 5.0 * deviation / math.sqrt(n), name


def test_noise_is_white_and_of_each_axis_its_own(noisy):
    columns = noises(noisy)
    for name, (deviation, noise) in columns.items():
        power = np.abs(np.fft.rfft(noise)[1:-1]) ** 2 / (len(noise) * deviation ** 2)
        # Each bin is exponential of mean 1: the mean of 250 is 1 to 1 / sqrt(250); of 8 bands of
        # 12 numbers, five of that is one in 20 000 seeds.
        for band in np.array_split(power, 8):
            assert abs(band.mean() - 1.0) < 5.0 / math.sqrt(len(band)), name
    table = np.corrcoef([noise for _, noise in columns.values()])
    assert np.abs(table - np.eye(len(table))).max() < 5.0 / math.sqrt(4000)


def test_one_seed_is_one_noise_and_another_is_another():
    values = {'imu.gyroscope_noise': 0.1, 'fix.noise': [1.0, 1.0]}
    one, same, other = (record({**values, 'imu.seed': seed, 'fix.seed': seed}, 20)[:2]
                        for seed in (5, 5, 6))
    assert all(np.array_equal(a, b) for a, b in zip(one, same))
    assert not np.isclose(one[0][:, 5:8], other[0][:, 5:8]).any()
    assert not np.isclose(one[1][:, 1:], other[1][:, 1:], rtol=1e-12).any()


def test_boats_of_one_seed_have_noise_of_their_own_which_comes_again():
    values = {'imu.gyroscope_noise': 0.1, 'fix.noise': [1.0, 1.0]}
    red, blue, again = (record(values, 2000, name=f'/{name}/boat_buoyancy')
                        for name in ('red', 'blue', 'red'))
    for one, other, same, columns in zip(red[:2], blue[:2], again[:2], (slice(5, 8), slice(1, 3))):
        assert np.array_equal(one, same)
        # As alike as chance makes n numbers: one in 30 000 is beyond 4.5 / sqrt(n), of five.
        for column in range(*columns.indices(11)):
            assert abs(np.corrcoef(one[:, column], other[:, column])[0, 1]) < (
                4.5 / math.sqrt(len(one)))


def test_a_boat_that_is_shown_again_at_the_same_time_measures_nothing_new():
    recorder, session = Recorder(), Session(load_scene({'fix.rate': 100.0}))
    topics = NodeTopics(recorder)
    outputs = Outputs(topics, session.scene, sensors_of(topics, session.scene))
    outputs.publish(session)
    session.place(5.0, 0.0, 0.0)
    outputs.publish(session)
    session.step()
    outputs.publish(session)
    for rows in recorder.rows.values():
        assert [row[0] for row in rows] == [0, 10_000_000]


def test_each_sensor_has_its_rate_on_the_clock_of_the_stamps():
    imu, fix, _ = record({'imu.rate': 40.0, 'fix.rate': 5.0}, 200, start=START)
    for rows, rate in ((imu, 40), (fix, 5)):
        since = rows[:, 0].astype(int) - START
        # The first period at or after each multiple of 1/rate.
        expected = [10_000_000 * -(-i * 100 // rate) for i in range(2 * rate + 1)]
        assert since.tolist() == expected


def test_stamps_that_are_cut_to_whole_nanoseconds_lose_no_message():
    # 1/30 s is no whole number of ns.
    imu, fix, _ = record({'rate': 30.0, 'imu.rate': 15.0, 'fix.rate': 10.0}, 90)
    assert (len(imu), len(fix)) == (46, 31)


def test_a_rate_above_that_of_the_steps_is_one_message_a_period_and_said():
    values = {'rate': 20.0, 'imu.rate': 50.0}
    assert len(record(values, 40)[0]) == 41
    assert load_scene(values).warnings == (
        'imu.rate is 50 Hz and rate is 20 Hz: there is at most one message a period; raise rate, '
        'or lower imu.rate.',)
    # Only of what was asked for.
    assert load_scene({'rate': 5.0}).warnings == ()


def test_without_a_listener_nothing_is_computed(monkeypatch):
    scene = load_scene({})
    monkeypatch.setattr(type(scene.simulation()), 'acceleration',
                        lambda *_: pytest.fail('nobody listens'))
    imu, fix, _ = record({}, 10, listeners=('fix',))
    assert len(imu) == 0 and len(fix) == 2


def test_a_rate_of_0_is_no_sensor_at_all():
    assert sensors_of(NodeTopics(Recorder()), load_scene({'imu.rate': 0.0, 'fix.rate': 0.0})) == []


def test_the_fix_is_that_of_the_antenna_in_the_world():
    # Heading north, the antenna 10 m ahead and 3 m up; a degree is 111 km at the equator.
    values = {'fix.position': [10.0, 0.0, 3.0], 'start.position': [100.0, 200.0],
              'start.orientation': [0.0, 0.0, math.pi / 2], 'fix.altitude': 50.0}
    _, fix, session = record(values, 1)
    _, latitude, longitude, altitude = fix[0]
    meridian = 6378137.0 * (1.0 - 0.0066943799901414)
    assert math.radians(longitude) * (6378137.0 + 53.0) == pytest.approx(100.0, abs=1e-4)
    assert math.radians(latitude) * (meridian + 53.0) == pytest.approx(210.0, abs=1e-4)
    # The boat floats with its origin above the water; d^2 / 2R of 233 m is 4 mm.
    assert altitude == pytest.approx(53.0 + session.scene.start.position[2], abs=0.005)


# Over the graph.

@pytest.fixture(scope='module')
def messages():
    """Return imu and fix messages of one second and more, and the frame id of the boat."""
    values = {'imu.accelerometer_noise': 0.1, 'imu.rate': 50.0, 'fix.noise': [2.0, 3.0],
              'fix.latitude': -33.724223, 'fix.longitude': 150.679736, 'status_period': 0.0}
    with BoatProcess(values) as boat, Probe(boat.namespace) as probe:
        imu, fix = probe.listen(Imu, 'imu'), probe.listen(NavSatFix, 'fix')
        probe.until(lambda: len(imu) > 60 and len(fix) > 12)
        yield imu, fix


def test_messages_come_at_their_rates(messages):
    for received, gap in zip(messages, (20_000_000, 100_000_000)):
        stamps = [nanoseconds(message.header.stamp) for message in received]
        assert set(np.diff(stamps)) == {gap}


def test_covariances_say_what_was_added(messages):
    imu, fix = messages[0][-1], messages[1][-1]
    assert imu.header.frame_id == fix.header.frame_id == 'base_link'
    np.testing.assert_allclose(imu.linear_acceleration_covariance,
                               np.diag([0.01] * 3).ravel(), rtol=1e-12)
    assert not np.any(imu.orientation_covariance) and not np.any(imu.angular_velocity_covariance)
    np.testing.assert_allclose(fix.position_covariance, np.diag([4.0, 4.0, 9.0]).ravel())
    assert fix.position_covariance_type == NavSatFix.COVARIANCE_TYPE_DIAGONAL_KNOWN
    assert fix.status.status == 0 and fix.status.service == 1


def test_the_fix_is_about_the_datum(messages):
    fix = messages[1]
    # 2 m of noise are 2e-5 degrees.
    assert np.mean([one.latitude for one in fix]) == pytest.approx(-33.724223, abs=1e-4)
    assert np.mean([one.longitude for one in fix]) == pytest.approx(150.679736, abs=1e-4)
