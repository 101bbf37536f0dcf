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

"""The implicit integrator keeps the speed bound that is proved for it; leapfrog is observed."""

from boat_buoyancy.physics import Boat, Damping, Hull, Sea, Simulation, SimulationError, State
from boat_buoyancy.physics.sea.fading import fade
from boat_buoyancy.physics.step_size.plan import plan
from boat_buoyancy.physics.stepping.guard import MARGIN
from boat_buoyancy.physics.stepping.speed_bound import speed_norm, SpeedBound
from boats import reference_boat, start, turned, undamped, wind_sea
import numpy as np
import pytest
from random_boats import afloat_in_waves, blown, draw

PERIODS = 40
# What floating-point sums of this length can be off by.
ROUND_OFF = 1e-9


def about_center_of_mass(boat, thrust):
    """Return the magnitudes (B,) of force and of torque about the centre of mass."""
    force, torque = thrust[:, :3], thrust[:, 3:]
    return (np.linalg.norm(force, axis=1),
            np.linalg.norm(torque - np.cross(boat.center_of_mass, force), axis=1))


def speeds(drawn, *, integrator='implicit', substeps=1, periods=PERIODS):
    """Return |u|_M (periods + 1, boats) of a draw's fleet, no boat of which fails."""
    fleet = start(drawn.boat, drawn.state, sea=drawn.sea, rate=1.0 / drawn.step,
                  integrator=integrator, substeps=substeps)
    norms = [speed_norm(drawn.boat, fleet.state, fleet.wetness, drawn.sea.current)]
    for _ in range(periods):
        fleet.step(drawn.thrust)
        norms.append(speed_norm(drawn.boat, fleet.state, fleet.wetness, drawn.sea.current))
    assert not fleet.failed.any()
    return np.array(norms)


def worst_ratio(drawn):
    """Return the largest ratio of a step's |u|_M to the most that the theorem allows it."""
    norms = speeds(drawn)
    bound = SpeedBound.of(drawn.boat, drawn.sea)
    push = about_center_of_mass(drawn.boat, drawn.thrust)
    overall = np.maximum(norms[0], bound.limit(*push))
    assert (norms <= overall * (1.0 + ROUND_OFF)).all()
    return float((norms[1:] / bound.after(norms[:-1], drawn.step, *push)).max())


def leapfrog_ratio(drawn):
    """Return |u|_M over the bound for leapfrog at its chosen substeps, None beyond 64 of them."""
    chosen = plan(drawn.boat, integrator='leapfrog', rate=1.0 / drawn.step)
    if chosen.integrator != 'leapfrog':
        return None
    norms = speeds(drawn, integrator='leapfrog', substeps=chosen.substeps, periods=30)
    bound = SpeedBound.of(drawn.boat, drawn.sea)
    push = about_center_of_mass(drawn.boat, drawn.thrust)
    most = norms[0]
    ratios = []
    for norm in norms[1:]:
        for _ in range(chosen.substeps):
            most = bound.after(most, drawn.step / chosen.substeps, *push)
        ratios.append(norm / most)
    return float(np.max(ratios))


def test_no_step_of_implicit_passes_the_bound_of_two_thousand_random_boats():
    ratios = [worst_ratio(draw(seed)) for seed in range(250)]
    assert max(ratios) <= 1.0 + ROUND_OFF


def test_no_step_of_implicit_passes_the_bound_in_wind_that_storms_at_random_boats():
    ratios = [worst_ratio(blown(draw(seed), seed)) for seed in range(250)]
    assert max(ratios) <= 1.0 + ROUND_OFF


def test_no_step_of_implicit_passes_the_bound_of_random_boats_that_take_water_along():
    ratios = [worst_ratio(afloat_in_waves(draw(seed), seed)) for seed in range(250)]
    assert max(ratios) <= 1.0 + ROUND_OFF


@pytest.mark.long
def test_no_step_of_implicit_passes_the_bound_of_eighty_thousand_random_boats(record_property):
    ratios = [worst_ratio(draw(seed)) for seed in range(250, 10250)]
    record_property('worst ratio', max(ratios))
    print(f'worst ratio to the bound of one step: {max(ratios):.8f}')
    assert max(ratios) <= 1.0 + ROUND_OFF


def test_without_drag_the_speed_of_random_boats_grows_at_most_linearly():
    for seed in range(30):
        drawn = draw(seed, drag=False)._replace(sea=Sea())
        norms = speeds(drawn)
        forcing = SpeedBound.of(drawn.boat, drawn.sea).forcing(
            *about_center_of_mass(drawn.boat, drawn.thrust))
        time = np.arange(len(norms))[:, None] * drawn.step
        assert (norms <= (norms[0] + time * forcing) * (1.0 + ROUND_OFF)).all()


def test_leapfrog_at_its_chosen_substeps_stays_within_the_margin_of_the_guard():
    ratios = [leapfrog_ratio(draw(seed)) for seed in range(30)]
    ratios = [ratio for ratio in ratios if ratio is not None]
    assert len(ratios) >= 9
    assert max(ratios) < MARGIN


@pytest.mark.long
def test_leapfrog_stays_within_the_margin_of_the_guard_on_eight_thousand_random_boats():
    ratios = [leapfrog_ratio(draw(seed)) for seed in range(30, 1030)]
    ratios = [ratio for ratio in ratios if ratio is not None]
    print(f'worst ratio to the bound: {max(ratios):.6f}, draws within 64 substeps: {len(ratios)}')
    assert max(ratios) < MARGIN


def test_the_bound_is_the_published_formula():
    # 1000 kg on probes that lift 4 x 9810 N at a distance of sqrt(2) m at most, pushed by 300 N
    # at the body origin 0.5 m below the centre of mass, in a sea whose fastest water is 2 m/s: of
    # a wave across the current.
    drag = {name: [np.exp(-0.5)] for name in ('angular_retention', 'air_linear_retention',
                                              'air_angular_retention')}
    boat = reference_boat(damping=Damping(linear_retention=[np.exp(-0.7)], **drag,
                                          probe=[200.0, 1500.0, 900.0],
                                          linear=[40.0, 60.0, 20.0, 900.0, 0.0, 0.0]),
                          center_of_mass=(0.0, 0.0, 0.5))
    bound = SpeedBound.of(boat, Sea([[1.0, 2.0 * np.pi, np.arctan2(0.6, -0.8), 0.0]],
                                    current=[0.6, 0.8]))
    reach = np.sqrt(1.0 + 1.0 + 0.25)
    force = 4.0 * 9810.0 + 9810.0 + 300.0 + 0.5 * 1000.0 * 2.0
    torque = 4.0 * 9810.0 * reach + 0.5 * 300.0
    forcing = np.sqrt(force**2 / 1000.0 + torque**2 / 500.0)
    power = 2.0**2 / 4.0 * (1500.0 + 1000.0 * 0.2 + 60.0)
    assert bound.forcing(300.0, 150.0) == pytest.approx(forcing, rel=1e-12)
    assert bound.limit(300.0, 150.0) == pytest.approx(
        (forcing + np.sqrt(forcing**2 + 2.0 * power)) / 1.0, rel=1e-12)
    a = 100.0 + 0.1 * forcing
    assert bound.after(100.0, 0.1, 300.0, 150.0) == pytest.approx(
        (a + np.sqrt(a**2 + 4.0 * 1.05 * 0.1 * power)) / 2.1, rel=1e-12)


def test_the_bound_in_wind_is_that_of_drag_at_the_point_where_it_acts():
    # The side force acts 1.5 m ahead of a boat of 1000 kg and at least 500 kg m^2, wind 10 m/s.
    boat = reference_boat(damping=undamped(wind=[3.0, 8.0, 12.0]))
    bound = SpeedBound.of(boat, Sea(wind=[6.0, 8.0]))
    still = SpeedBound.of(boat, Sea())
    assert still.power == still.power_rate == 0.0
    assert bound.power == pytest.approx(10.0**2 / 4.0 * 8.0 * 10.0, rel=1e-12)
    assert bound.power_rate == pytest.approx(
        10.0**2 / 4.0 * 8.0 * np.sqrt(1.0 / 1000.0 + 1.5**2 / 500.0), rel=1e-12)


def test_a_column_of_hull_counts_the_farther_of_its_two_ends():
    hull = Hull([[0.0, 0.0, -0.5]], [20000.0], [4.0], 'column')
    boat = Boat(1000.0, hull, [500.0, 700.0, 900.0], undamped())
    assert SpeedBound.of(boat, Sea()).torque == pytest.approx(20000.0 * 3.5)


def test_a_speed_norm_is_the_root_of_twice_the_kinetic_energy():
    boat = reference_boat()
    state = State(velocity=[[3.0, 0.0, 4.0], [0.0, 0.0, 0.0]],
                  angular_velocity=[[0.0, 0.0, 0.0], [1.0, 2.0, 0.0]])
    assert speed_norm(boat, state) == pytest.approx([np.sqrt(25000.0), np.sqrt(3300.0)])


def test_terminal_speed_lies_under_the_overall_bound():
    # Sinking with hardly any lift at a drag of 0.5 1/s ends at 19.62 m/s.
    slow = undamped(linear_retention=[np.exp(-0.5)], angular_retention=[np.exp(-0.5)],
                    air_linear_retention=[np.exp(-0.5)], air_angular_retention=[np.exp(-0.5)])
    boat = reference_boat(floatiness=1e-6, damping=slow)
    simulation = Simulation(boat, Sea(), State(position=(0.0, 0.0, -1.0)), rate=10.0,
                            integrator='implicit')
    simulation.run(60.0)
    speed = abs(simulation.state.velocity[2])
    limit = SpeedBound.of(boat, Sea()).limit() / np.sqrt(boat.mass)
    # The lift that is left is a millionth of the weight.
    assert speed == pytest.approx(19.62, rel=2e-6)
    assert speed <= limit <= 19.62 * (1.0 + 2e-6)


def test_a_fading_sea_stays_within_its_own_bound():
    drawn = draw(3)
    sea = fade(Sea([[1.5, 5.0, 0.0, 0.0]]), wind_sea(), 0.1, 0.4)
    assert worst_ratio(drawn._replace(sea=sea, step=0.02)) <= 1.0 + ROUND_OFF


@pytest.mark.parametrize('step', [1e-6, 1.0, 1e3, 1e6])
def test_implicit_stays_finite_at_any_step(step):
    boat = reference_boat(law='column', damping=Damping(probe=1e9))
    start = State(position=(0.0, 0.0, 3.0), orientation=turned(1.0, 0.5),
                  velocity=(1.0, -2.0, 30.0), angular_velocity=(40.0, 1.0, -70.0))
    simulation = Simulation(boat, wind_sea(), start, rate=1.0 / step, integrator='implicit')
    try:
        for _ in range(50):
            simulation.step((1e6, 0.0, 1e6, 0.0, 1e5, 0.0))
    except SimulationError as error:
        pytest.fail(str(error))
    assert speed_norm(boat, simulation.state) <= max(
        speed_norm(boat, start), SpeedBound.of(boat, wind_sea()).limit(np.sqrt(2.0) * 1e6, 1e5))
