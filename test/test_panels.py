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

"""Pressure on a closed surface: Archimedes at any attitude, and what it makes of a motion."""

from dataclasses import replace
from importlib.util import find_spec
import math

from boat_buoyancy.physics import Fleet, load_scene, Sea, Simulation, State
from boat_buoyancy.physics.boat.clipping import level_for, submerged
from boat_buoyancy.physics.boat.records import hull_view, readable
from boat_buoyancy.physics.boat.surface import box_surface, joined, Surface
from boat_buoyancy.physics.forces.buoyancy import lift_stiffness
from boat_buoyancy.physics.forces.load import load_at
from boat_buoyancy.physics.hydrostatics.metacentric_height import metacentric_heights
from boat_buoyancy.physics.hydrostatics.natural_modes import modes
from boat_buoyancy.physics.hydrostatics.rest import draft, floating_state, rest_state
from boat_buoyancy.physics.hydrostatics.righting_arm import righting_arms, surface_righting_arms
from boat_buoyancy.physics.hydrostatics.stiffness import hydrostatic_stiffness, still_load
from boat_buoyancy.physics.rotation import rotation_matrix, to_roll_pitch_yaw
from boats import all_damping, box_boat, crossings, same, simulate, turned, undamped, wind_sea
import numpy as np
import pytest
from random_boats import afloat_in_waves, draw
from scipy.spatial import ConvexHull, HalfspaceIntersection
from scipy.spatial.transform import Rotation
from test_bound import ROUND_OFF, worst_ratio

pytestmark = pytest.mark.plain

SALT, GRAVITY = 1025.0, 9.81
SPECIFIC_WEIGHT = SALT * GRAVITY
SIZE = np.array([4.0, 2.0, 1.0])


def panelled(boat, surface, specific_weight=SPECIFIC_WEIGHT):
    """Return a boat that the pressure on a surface lifts, and not its probes."""
    return replace(boat, hull=replace(boat.hull, surface=surface, panels=surface,
                                      specific_weight=specific_weight))


def panelled_box(damping=None, **changes):
    """Return the default box on its twelve triangles."""
    return replace(panelled(box_boat(damping or undamped()), box_surface(SIZE)), **changes)


def lift_and_torque(boat, state, sea=None):
    """Return the force N and torque N m of the water about the centre of mass, world axes."""
    sea = sea or Sea()
    load = load_at(boat.plain_records[0], hull_view(boat, plain=True), readable(sea.record),
                   sea.table.tolist(), state.position.tolist(), state.orientation.tolist(), 0.0)
    turn = Rotation.from_quat(state.orientation)
    return turn.apply(load.force) + [0.0, 0.0, boat.weight], turn.apply(load.torque)


def sphere(radius, halvings):
    """Return the surface of an octahedron whose triangles are halved and pushed to a sphere."""
    corners = np.array([[x, 0, 0] for x in (1, -1)] + [[0, y, 0] for y in (1, -1)]
                       + [[0, 0, z] for z in (1, -1)], float)
    triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4],
                 [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    surface = Surface(corners, triangles)
    for _ in range(halvings):
        surface = surface.refined(0.6 * surface.longest_edge)
        length = np.linalg.norm(surface.corners, axis=1, keepdims=True)
        surface = Surface(surface.corners / length, surface.triangles)
    return Surface(radius * surface.corners, surface.triangles)


def cylinder(radius, length, sides):
    """Return the surface of a cylinder along x, of flat ``sides``."""
    angle = 2.0 * np.pi * np.arange(sides) / sides
    ring = np.stack([np.zeros(sides), radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    shift = np.array([length / 2.0, 0.0, 0.0])
    corners = np.concatenate([ring - shift, ring + shift, [-shift, shift]])
    i, j = np.arange(sides), (np.arange(sides) + 1) % sides
    aft, bow = np.full(sides, 2 * sides), np.full(sides, 2 * sides + 1)
    return Surface(corners, np.concatenate([np.stack(three, axis=1) for three in (
        (i, j, j + sides), (i, j + sides, i + sides), (aft, j, i), (bow, i + sides, j + sides))]))


# In still water.

def test_a_box_is_lifted_by_the_water_that_it_takes_the_place_of_at_any_attitude():
    # The volume and centre of the convex body under water, by intersecting half spaces.
    random, boat = np.random.default_rng(3), panelled_box(center_of_mass=(0.3, -0.2, 0.1))
    for turn in Rotation.random(60, random_state=4):
        height = random.uniform(-0.8, 0.8)
        state = State([5.0, -3.0, height], turn.as_quat())
        force, torque = lift_and_torque(boat, state)
        center = state.position - turn.apply([*boat.center_of_mass])
        axes = turn.as_matrix()
        sides = [[*(sign * axes[:, i]), -sign * (axes[:, i] @ center) - SIZE[i] / 2.0]
                 for i in range(3) for sign in (1.0, -1.0)]
        wet, moment = submerged(boat.hull.surface.facets @ axes.T + center)
        inside = np.array(moment / wet)
        points = HalfspaceIntersection(np.array([*sides, [0.0, 0.0, 1.0, 0.0]]),
                                       inside).intersections
        body = ConvexHull(points)
        cones = [(abs(np.linalg.det(points[s] - inside)) / 6.0,
                  (points[s].sum(axis=0) + inside) / 4.0) for s in body.simplices]
        middle = sum(v * place for v, place in cones) / sum(v for v, _ in cones)
        lift = np.array([0.0, 0.0, SPECIFIC_WEIGHT * body.volume])
        np.testing.assert_allclose(force, lift, atol=1e-9 * boat.weight)
        np.testing.assert_allclose(torque, np.cross(middle - state.position, lift),
                                   atol=1e-9 * boat.weight)


def test_a_body_all_under_water_is_lifted_by_its_volume_through_its_centre():
    for surface in (sphere(0.7, 3), cylinder(0.5, 2.0, 12), box_surface(SIZE, (0.2, 0.1, -0.3)),
                    joined([box_surface((1.0, 1.0, 1.0), (0.0, y, 0.0)) for y in (-2, 2)])):
        boat = panelled(box_boat(undamped()), surface)
        for turn in Rotation.random(10, random_state=1):
            force, torque = lift_and_torque(boat, State([0.0, 0.0, -50.0], turn.as_quat()))
            lift = np.array([0.0, 0.0, SPECIFIC_WEIGHT * surface.volume])
            np.testing.assert_allclose(force, lift, atol=1e-11 * lift[2])
            np.testing.assert_allclose(torque, np.cross(turn.apply(surface.center), lift),
                                       atol=1e-10 * lift[2])


def test_a_sphere_floats_at_its_published_draft_as_the_square_of_the_edge():
    errors, edges = [], []
    for halvings in (2, 3, 4):
        surface = sphere(0.25, halvings)
        boat = replace(panelled(box_boat(undamped()), surface), mass=6.545)
        errors.append(0.25 - rest_state(boat).position[2] - 0.096603)
        edges.append(surface.longest_edge)
    # The draft is given to 1e-6 m.
    order = np.diff(np.log(np.abs(errors))) / np.diff(np.log(edges))
    assert abs(errors[-1]) < 2e-3 and order == pytest.approx([2.0, 2.0], abs=0.25)


@pytest.mark.parametrize('angle', [0.7, 1.2, 2.1])
def test_a_cylinder_displaces_its_segment_as_the_square_of_the_edge(angle):
    # Wet up to ``angle`` from the keel: R^2 (a - sin a cos a).
    exact = 0.5 ** 2 * (angle - math.sin(angle) * math.cos(angle)) * 2.0
    errors = []
    for sides in (64, 128, 256):
        boat = panelled(box_boat(undamped()), cylinder(0.5, 2.0, sides))
        state = State([0.0, 0.0, 0.5 * math.cos(angle)], turned(roll=0.1))
        errors.append(lift_and_torque(boat, state)[0][2] / SPECIFIC_WEIGHT - exact)
    assert abs(errors[-1]) < 3.0 * exact / 256 ** 2 * math.pi ** 2
    assert abs(errors[0] / errors[2]) == pytest.approx(16.0, rel=0.3)


def test_righting_arms_are_those_of_the_surface_from_upright_to_upside_down_on_both_sides():
    heel = np.radians(np.arange(-180.0, 181.0, 7.5))
    boat = panelled_box(center_of_mass=(0.2, 0.1, 0.15))
    np.testing.assert_allclose(righting_arms(boat, heel), surface_righting_arms(boat, heel),
                               atol=1e-9)


def test_the_barge_has_its_published_righting_arms_past_the_deck_edge():
    surface = box_surface((20.0, 6.0, 3.0), (0.0, 0.0, 1.5))
    boat = replace(panelled(box_boat(undamped()), surface), mass=SALT * 20.0 * 6.0 * 1.5,
                   center_of_mass=(0.0, 0.0, 1.8))
    np.testing.assert_allclose(righting_arms(boat, np.radians([10.0, 20.0, 30.0, 40.0, 50.0])),
                               [0.1704, 0.3702, 0.6078, 0.6287, 0.5171], atol=5e-5)


def test_stiffness_is_the_slope_of_force_and_torque_at_any_attitude():
    boat, size = panelled_box(center_of_mass=(0.3, -0.2, 0.1)), 1e-6
    for roll, pitch in ((0.0, 0.0), (0.4, -0.2), (1.4, 0.1), (2.9, 0.3)):
        rest, measured = floating_state(boat, roll, pitch), np.zeros((3, 3))
        for column in range(3):
            wrenches = []
            for sign in (1.0, -1.0):
                nudge = sign * size * np.eye(3)[column]
                turn = Rotation.from_rotvec([nudge[1], nudge[2], 0.0])
                state = State(rest.position + [0.0, 0.0, nudge[0]],
                              (turn * Rotation.from_quat(rest.orientation)).as_quat())
                force, torque = lift_and_torque(boat, state)
                wrenches.append([force[2], *torque[:2]])
            measured[:, column] = np.diff(wrenches, axis=0)[0] / (2.0 * size)
        np.testing.assert_allclose(hydrostatic_stiffness(boat, rest), measured, rtol=1e-6,
                                   atol=1e-8 * boat.weight)


def test_the_implicit_integrator_sees_that_stiffness_where_it_is_positive():
    for roll, pitch in ((0.0, 0.0), (0.4, -0.2), (1.0, 0.3)):
        boat = panelled_box(center_of_mass=(0.1, 0.1, -3.0))
        state = floating_state(boat, roll, pitch)
        hull, R = hull_view(boat, plain=True), rotation_matrix(state.orientation.tolist())
        load_at(boat.plain_records[0], hull, readable(Sea().record), Sea().table.tolist(),
                state.position.tolist(), state.orientation.tolist(), 0.0)
        k, lever, T = lift_stiffness(boat.plain_records[0], hull, R)
        turn = np.array(R)
        xx, yy, zz, xy, xz, yz = T
        found = np.zeros((3, 3))
        found[0, 0], found[0, 1:] = k, (turn @ lever)[:2]
        found[1:, 0] = found[0, 1:]
        found[1:, 1:] = (turn @ [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] @ turn.T)[:2, :2]
        # Hung below its centre of buoyancy, all of it is positive.
        np.testing.assert_allclose(found, hydrostatic_stiffness(boat, state), rtol=1e-12,
                                   atol=1e-9 * boat.weight)


# Moving.

def test_a_box_a_twin_without_a_gap_and_a_mesh_of_the_same_box_move_alike(tmp_path):
    path = tmp_path / 'box.obj'
    surface = box_surface(SIZE)
    path.write_text(''.join(f'v {x!r} {y!r} {z!r}\n' for x, y, z in surface.corners.tolist())
                    + ''.join(f'f {a + 1} {b + 1} {c + 1}\n' for a, b, c in surface.triangles))
    start = {'start.position': [0.0, 0.0, 0.5], 'start.orientation': [0.5, 0.2, 0.4],
             'hull.model': 'panels', 'boat.inertia': [900.0, 2900.0, 3300.0],
             'start.velocity': [0.2, 0.1, 0.0], 'damping.probe': 0.0,
             **{f'damping.{name}retention': [1.0] for name in (
                 'linear_', 'angular_', 'air_linear_', 'air_angular_')}}
    shapes = [{}, {'hull.shape': 'twin', 'hull.size': [4.0, 1.0, 1.0], 'hull.spacing': 1.0}]
    if find_spec('trimesh'):
        shapes.append({'hull.shape': 'mesh', 'hull.mesh': str(path)})
    runs = [load_scene({**start, **shape}).simulation().run(5.0) for shape in shapes]
    for run in runs[1:]:
        np.testing.assert_allclose(run.position, runs[0].position, atol=1e-9)
        np.testing.assert_allclose(run.orientation, runs[0].orientation, atol=1e-9)


def test_panels_move_as_columns_do_where_columns_are_exact():
    # Until an edge dips or rises, in still water.
    start = State([0.0, 0.0, 0.26], turned(0.06, -0.03, 0.2), (0.3, 0.1, 0.05), (0.1, 0.0, 0.2))
    damping = all_damping()
    _, columns = simulate(box_boat(damping), start, 8.0)
    _, panels = simulate(panelled_box(damping), start, 8.0)
    np.testing.assert_allclose(panels.position, columns.position, atol=1e-9)
    np.testing.assert_allclose(panels.orientation, columns.orientation, atol=1e-9)


@pytest.mark.parametrize('mode, row', [('heave', 0), ('roll', 1), ('pitch', 2)])
@pytest.mark.parametrize('integrator', ['leapfrog', 'rk4', 'symplectic_euler'])
def test_small_swings_take_the_predicted_period(integrator, mode, row):
    boat, size = panelled_box(), 1e-4
    rest, nudge = rest_state(boat), size * np.eye(3)[row]
    start = State(rest.position + [0.0, 0.0, nudge[0]], turned(nudge[1], nudge[2]))
    time, states = simulate(boat, start, 4.0, rate=400.0, integrator=integrator)
    roll, pitch, _ = to_roll_pitch_yaw(tuple(states.orientation.T))
    value = (states.position[:, 2] - rest.position[2], roll, pitch)[row]
    rate = (states.velocity[:, 2], states.angular_velocity[:, 0],
            states.angular_velocity[:, 1])[row]
    passed = crossings(time, value, rate, rising=True)
    assert passed[1] - passed[0] == pytest.approx(modes(boat)[mode].period, rel=1e-4)


def energies(boat, states):
    """Return kinetic energy and that of boat and water displaced, J, of all states of a run."""
    found = []
    for i in range(len(states.position)):
        state = states[i]
        facets = (boat.hull.surface.facets - boat.center_of_mass) @ np.array(
            rotation_matrix(tuple(state.orientation))).T + state.position
        _, moment = submerged(facets)
        spin = state.angular_velocity
        found.append(0.5 * boat.mass * state.velocity @ state.velocity
                     + 0.5 * spin @ boat.inertia @ spin + boat.weight * state.position[2]
                     - SPECIFIC_WEIGHT * moment[2])
    return np.array(found)


def test_leapfrog_keeps_energy_through_a_full_roll_and_gains_its_order():
    # Fast enough to go over the top, again and again; it has to bob on edges and corners.
    boat = panelled_box(inertia=[833.3, 2833.3, 3333.3])
    start = State(rest_state(boat).position, turned(0.1, 0.05), angular_velocity=(6.0, 0.3, 0.2))
    swings, drifts = [], []
    for rate in (100.0, 200.0, 400.0):
        _, states = simulate(boat, start, 20.0, rate=rate)
        roll = np.unwrap(to_roll_pitch_yaw(tuple(states.orientation.T))[0])
        assert np.ptp(roll) > 4.0 * np.pi
        energy = energies(boat, states)
        second = int(rate)
        swings.append(abs(energy - energy[0]).max())
        drifts.append(abs(energy[-5 * second:].mean() - energy[:5 * second].mean()))
    kinetic = 0.5 * 833.3 * 36.0
    # u^2 / 4 of what swings, u = w h of the fastest mode; and no drift beyond that.
    u = max(mode.angular_frequency for mode in modes(boat).values()) / 100.0
    assert swings[0] < u ** 2 * kinetic * 4.0
    assert swings[0] / swings[1] == pytest.approx(4.0, rel=0.35)
    assert swings[1] / swings[2] == pytest.approx(4.0, rel=0.35)
    assert max(drifts) < 0.3 * swings[0]


def test_motion_in_waves_converges_at_second_order():
    boat = panelled(box_boat(all_damping()), box_surface(SIZE).refined(1.0))
    start = State([0.0, 0.0, 0.3], turned(0.2, 0.1, 0.3), angular_velocity=(0.3, 0.1, 0.2))
    ends = [simulate(boat, start, 2.0, rate=rate, sea=wind_sea())[1].position[-1]
            for rate in (100.0, 200.0, 400.0)]
    ratio = np.linalg.norm(ends[1] - ends[0]) / np.linalg.norm(ends[2] - ends[1])
    assert np.log2(ratio) == pytest.approx(2.0, abs=0.15)


@pytest.mark.parametrize('heel', [70.0, 80.0, 85.0, 100.0])
def test_the_default_box_ends_upright_or_inverted_and_never_on_its_side(heel):
    start = {'start.orientation': [math.radians(heel), 0.02, 0.0],
             'damping.angular_retention': [0.3]}
    run = load_scene({'hull.model': 'panels', **start}).simulation().run(120.0)
    roll = abs(math.degrees(run.roll[-1]))
    # As the surface says: it rights itself up to 90 degrees.
    assert roll == pytest.approx(0.0 if heel < 90.0 else 180.0, abs=0.1)
    assert abs(run.velocity[-1]).max() < 1e-3


# In waves.

def test_the_lift_of_a_level_box_in_waves_converges_as_the_square_of_the_edge():
    # A wave of length L lifts a box of length l by sin(k l / 2) / (k l / 2) of its amplitude.
    k = 2.0 * np.pi / 5.0
    sea = Sea([[0.02, 2.0 * np.pi / math.sqrt(GRAVITY * k), 0.0, 0.4]])
    exact = SPECIFIC_WEIGHT * 8.0 * 0.02 * math.cos(0.4) * math.sin(2.0 * k) / (2.0 * k)
    errors, edges = [], []
    for longest in (1.2, 0.6, 0.3):
        boat = panelled(box_boat(undamped()), box_surface(SIZE).refined(longest))
        rest = State([0.0, 0.0, 0.5 - 2000.0 / (SALT * 8.0)])
        errors.append(lift_and_torque(boat, rest, sea)[0][2] - boat.weight - exact)
        edges.append(boat.hull.panels.longest_edge)
    assert abs(errors[-1]) < 0.02 * abs(exact)
    order = np.diff(np.log(np.abs(errors))) / np.diff(np.log(edges))
    assert order == pytest.approx([2.0, 2.0], abs=0.3)


def test_panels_are_as_fine_as_an_eighth_of_the_shortest_wave_that_matters():
    calm = load_scene({'hull.model': 'panels'})
    assert len(calm.boat.hull.panels.triangles) == 12
    # 25 m, and one of 1.6 m that carries less than a hundredth of the energy.
    long = load_scene({'hull.model': 'panels', 'sea.waves': [1.0, 4.0, 0.0, 0.0]})
    both = load_scene({'hull.model': 'panels',
                       'sea.waves': [1.0, 4.0, 0.0, 0.0, 0.09, 1.0, 0.0, 0.0]})
    short = load_scene({'hull.model': 'panels',
                        'sea.waves': [1.0, 4.0, 0.0, 0.0, 0.11, 1.0, 0.0, 0.0]})
    assert long.boat.hull.panels.longest_edge <= 24.98 / 8.0
    assert len(both.boat.hull.panels.triangles) == len(long.boat.hull.panels.triangles)
    assert 0.5 * 1.561 / 8.0 < short.boat.hull.panels.longest_edge <= 1.561 / 8.0
    fixed = load_scene({'hull.model': 'panels', 'hull.panel_size': 0.5,
                        'sea.waves': [1.0, 4.0, 0.0, 0.0]})
    assert 0.25 < fixed.boat.hull.panels.longest_edge <= 0.5


def test_panels_change_with_the_sea_and_the_motion_goes_on():
    sim = load_scene({'hull.model': 'panels'}).simulation()
    sim.run(1.0, [300.0, 0.0, 0.0, 50.0, 0.0, 0.0])
    state = sim.state
    sim.sea = Sea([[0.1, 1.5, 0.3, 0.0]])
    assert len(sim.boat.hull.panels.triangles) > 500 and same(sim.state, state)
    sim.run(1.0)
    sim.sea = Sea()
    assert len(sim.boat.hull.panels.triangles) == 12
    before = sim.state.position[2]
    sim.step()
    assert abs(sim.state.position[2] - before) < 0.01


# Whatever it is put through.

def hostile(seed):
    """Return a `Draw` of a boat on panels: a box, a tetrahedron or a twin, any way round."""
    drawn, random = draw(seed), np.random.default_rng(seed)
    boat = drawn.boat
    size = np.ptp(boat.hull.positions, axis=0) + 0.1 * boat.size
    tetrahedron = Surface(np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) * size / 2,
                          [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    assert tetrahedron.volume > 0.0
    surface = (box_surface(size), tetrahedron, joined([
        box_surface(size, (0.0, y * size[1], 0.0)) for y in (-1.0, 1.0)]))[seed % 3]
    surface = surface.refined(surface.longest_edge * random.choice([1.0, 0.5]))
    lift = boat.weight * random.uniform(0.5, 10.0)
    return drawn._replace(boat=panelled(boat, surface, lift / surface.volume))


def test_no_step_of_implicit_passes_the_bound_of_random_boats_on_panels():
    ratios = [worst_ratio(hostile(seed)) for seed in range(120)]
    assert max(ratios) <= 1.0 + ROUND_OFF


def test_no_step_of_implicit_passes_the_bound_of_random_panelled_boats_that_follow_the_waves():
    ratios = [worst_ratio(afloat_in_waves(hostile(seed), seed)) for seed in range(120)]
    assert max(ratios) <= 1.0 + ROUND_OFF


@pytest.mark.parametrize('size, mass, low, rate', [
    ([1.0, 1.0, 10.0], 2000.0, -2.0, 5.0), ([4.0, 0.2, 4.0], 800.0, -0.5, 5.0),
    ([4.0, 2.0, 1.0], 2000.0, 0.0, 4.0)])
def test_a_tall_or_thin_box_on_its_side_gains_no_energy_by_the_steps_that_are_chosen(
        size, mass, low, rate):
    # There its waterplane is many times larger than upright.
    scene = load_scene({
        'hull.model': 'panels', 'hull.size': size, 'boat.mass': mass, 'rate': rate,
        'boat.center_of_mass': [0.0, 0.0, low], 'start.orientation': [1.4, 0.02, 0.0],
        'damping.probe': 0.0, **{f'damping.{name}retention': [1.0] for name in (
            'linear_', 'angular_', 'air_linear_', 'air_angular_')}})
    simulation = scene.simulation()
    run = simulation.run(100.0)
    states = [State(place, turn, speed, spin) for place, turn, speed, spin in zip(
        run.position + (np.array([rotation_matrix(tuple(q)) for q in run.orientation])
                        @ scene.boat.center_of_mass), run.orientation, run.velocity,
        run.angular_velocity)]
    # The velocity of the centre of mass, v + w x r.
    states = [State(state.position, state.orientation, state.velocity + np.array(
        rotation_matrix(tuple(state.orientation))) @ np.cross(
            state.angular_velocity, scene.boat.center_of_mass), state.angular_velocity)
        for state in states]
    together = State(*(np.stack([getattr(state, name) for state in states]) for name in (
        'position', 'orientation', 'velocity', 'angular_velocity')))
    energy = energies(scene.boat, together)
    # omega h <= 0.5: the energy swings by u^2 / 4 of what moves, less than the weight times the
    # size, and does not grow.
    assert energy.max() - energy[0] < 0.25 * 0.5 ** 2 * scene.boat.weight * scene.boat.size


@pytest.mark.parametrize('integrator', ['leapfrog', 'implicit'])
def test_boats_on_panels_and_on_columns_move_in_one_fleet_as_alone(integrator):
    coarse = panelled_box(all_damping())
    fine = panelled(box_boat(all_damping()), box_surface(SIZE).refined(0.8))
    boats, sea = [coarse, box_boat(all_damping()), fine, coarse], wind_sea()
    rest = [State([i, 0.0, 0.3], turned(0.3 * i, 0.1, 0.2)) for i in range(4)]
    together = State(*(np.stack([getattr(state, name) for state in rest]) for name in (
        'position', 'orientation', 'velocity', 'angular_velocity')))
    fleet = Fleet(boats, [sea] * 4, together, integrator=integrator)
    for _ in range(50):
        fleet.step()
    for i, (boat, state) in enumerate(zip(boats, rest)):
        alone = Simulation(boat, sea, state, integrator=integrator)
        for _ in range(50):
            alone.step()
        assert same(alone.state, fleet.state[i])


def test_what_is_known_of_the_boat_is_that_of_its_surface():
    boat = panelled_box()
    assert draft(boat, rest_state(boat)) == pytest.approx(2000.0 / (SALT * 8.0), rel=1e-12)
    # KB + I / V - KG, and the lift of all of it.
    volume, sunk = 2000.0 / SALT, 2000.0 / (SALT * 8.0)
    assert metacentric_heights(boat) == pytest.approx(
        (sunk / 2.0 + 8.0 * 4.0 / 12.0 / volume - 0.5,
         sunk / 2.0 + 8.0 * 16.0 / 12.0 / volume - 0.5), rel=1e-12)
    assert boat.floatiness == pytest.approx(SALT * 8.0 / 2000.0, rel=1e-12)
    assert level_for(boat.hull.surface.facets, volume) == pytest.approx(sunk - 0.5, rel=1e-12)
    load, depths = still_load(boat, rest_state(boat))
    np.testing.assert_allclose(depths, sunk, rtol=1e-12)
    np.testing.assert_allclose(load.force, 0.0, atol=1e-9)
