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
The table of parameters: every name, default, unit, range and meaning, once.

The node declares its parameters from it, `load_scene` checks files against it, and tests hold
``config/default.yaml`` and ``doc/parameters.md`` to it.
"""

from dataclasses import dataclass

from ..boat.hull import LAWS
from ..boat.shapes import SHAPES
from ..sea.wave_rows import MAX_COMPONENTS
from ..stepping.integrators import INTEGRATORS

MODELS, WAVE_FORCES = ('columns', 'panels'), ('hydrostatic', 'froude_krylov')
# The kinds of waves that a sea can be asked for, one at a time: the parameters of each.
WAVE_KINDS = (('sea.waves',), ('sea.sea_state',), ('sea.significant_height', 'sea.peak_period'))
NODE_NAME = 'boat_buoyancy'


@dataclass(frozen=True)
class Parameter:
    """
    One parameter.

    Main arguments: ``kind`` is float, int, bool, string, path, float_array, int_array or
    string_array; ``default`` None means derived from others or none at all, the description says
    which; ``unit`` of a number, '-' for none; ``description`` ends with what changes when it is
    raised.
    Other arguments: ``above`` (not reached), ``at_least`` and ``at_most`` bound every number;
    ``lengths`` allowed of an array, () = any; ``choices`` of a string; ``read_only`` while the
    node runs.
    """

    name: str
    kind: str
    default: object
    unit: str
    description: str
    above: float | None = None
    at_least: float | None = None
    at_most: float | None = None
    lengths: tuple = ()
    choices: tuple = ()
    read_only: bool = False

    @property
    def limits(self):
        """Return (lowest, highest) of a number, as a ROS range has it, or None."""
        if self.at_most is None or self.kind not in ('float', 'int'):
            return None
        return (self.at_least if self.above is None else self.above), self.at_most


def _axes(name, default, description):
    return Parameter(name, 'float_array', default, '-', description, above=0.0, at_most=1.0,
                     lengths=(1, 3))


def _table():
    """Return the parameters in the order of the documentation."""
    fixed = {'read_only': True}
    return (
        Parameter('rate', 'float', 100.0, 'Hz',
                  'Physics periods and publications per second. Higher is more accurate and '
                  'costs more.', at_least=0.1, at_most=1e5, **fixed),
        Parameter('integrator', 'string', 'leapfrog', '',
                  'leapfrog for waves and drops, implicit for stiff boats, rk4 for '
                  'smooth motion; symplectic_euler and euler for study.',
                  choices=tuple(INTEGRATORS), **fixed),
        Parameter('substeps', 'int', 0, '-',
                  'Integrator steps per period; 0 chooses them from the stability limit. More '
                  'is more accurate and costs more.', at_least=0, at_most=10000, **fixed),
        Parameter('gravity', 'float', 9.81, 'm/s²',
                  'Acceleration of gravity. Higher makes the boat heavier, its lift stronger '
                  'and waves faster.', at_least=1e-3, at_most=1e3, **fixed),
        Parameter('water_density', 'float', 1025.0, 'kg/m³',
                  'Density of the water, for a hull shape only. Higher floats the hull higher.',
                  at_least=1e-3, at_most=1e5, **fixed),
        Parameter('world_frame', 'string', 'odom', '',
                  'Frame id of the world: x east, y north, z up, mean water level at z = 0.',
                  **fixed),
        Parameter('body_frame', 'string', 'base_link', '',
                  'Frame id of the boat: x forward, y left, z up.', **fixed),
        Parameter('frame_prefix', 'string', '', '',
                  "What comes before body_frame, as red/. With publish_tf the node's namespace, "
                  'where nothing else is given.', **fixed),
        Parameter('publish_tf', 'bool', False, '',
                  'True broadcasts world_frame to body_frame on /tf every period.', **fixed),
        Parameter('map_frame', 'string', '', '',
                  'Frame id of a map that is the same place as world_frame: initialpose is taken '
                  'in it, too, and with publish_tf it is on /tf_static.', **fixed),
        Parameter('status_period', 'float', 5.0, 's',
                  'Time between status lines of the node; 0 = none. Higher logs less often.',
                  at_least=0.0, at_most=1e6, **fixed),
        Parameter('publish_clock', 'bool', False, '',
                  'True makes the node the source of /clock, from 0 on.', **fixed),
        Parameter('time_factor', 'float', 1.0, '-',
                  'Simulated over wall time; 0 = as fast as it can. Higher runs faster.',
                  at_least=0.0, at_most=1e6, **fixed),
        Parameter('boat.mass', 'float', 2000.0, 'kg',
                  'Mass. Higher lies deeper (with a hull shape) and moves more slowly.',
                  at_least=1e-6, at_most=1e12),
        Parameter('boat.center_of_mass', 'float_array', (0.0, 0.0, 0.0), 'm',
                  'Centre of mass in the body frame. A higher z rolls more slowly, and '
                  'capsizes when above the metacentre.', at_least=-1e6, at_most=1e6,
                  lengths=(3,), **fixed),
        Parameter('boat.inertia', 'float_array', None, 'kg·m²',
                  'Ixx, Iyy, Izz or Ixx, Iyy, Izz, Ixy, Ixz, Iyz about the centre of mass, '
                  'off-diagonals as in URDF; without it a solid body of the shape of the hull, or '
                  'for probes mass times their mean square distance. Higher turns more slowly.',
                  at_least=-1e18, at_most=1e18, lengths=(3, 6)),
        Parameter('hull.shape', 'string', 'box', '',
                  'Shape of the hull: box; twin, two boxes side by side; or mesh. Give hull or '
                  'probes, not both.', choices=SHAPES, **fixed),
        Parameter('hull.model', 'string', 'columns', '',
                  'What lifts the hull: columns (cheap, a box exact until an edge dips or rises) '
                  'or panels (pressure on its surface, right at any heel).', choices=MODELS,
                  **fixed),
        Parameter('hull.size', 'float_array', (4.0, 2.0, 1.0), 'm',
                  'Length, beam and depth of a box, of each of a twin. Longer or beamier carries '
                  'more and is stiffer in pitch or roll; deeper carries more.', at_least=1e-6,
                  at_most=1e6, lengths=(3,), **fixed),
        Parameter('hull.spacing', 'float', None, 'm',
                  'Distance between the centre lines of the two boxes of a twin; needed for one. '
                  'Wider is stiffer in roll.', above=0.0, at_most=1e6, **fixed),
        Parameter('hull.bottom', 'float', None, 'm',
                  'z of the bottom of a box or twin in the body frame; without it half the depth '
                  'below the origin. Higher lowers the body frame in the water.',
                  at_least=-1e6, at_most=1e6, **fixed),
        Parameter('hull.middle', 'float', 0.0, 'm',
                  'x of the middle of a box or twin in the body frame. Higher moves the hull '
                  'ahead of the origin.', at_least=-1e6, at_most=1e6, **fixed),
        Parameter('hull.mesh', 'path', None, '',
                  'File of a closed triangle mesh (STL, OBJ or PLY) in body axes; its path is '
                  'from the folder of the parameter file. Needed for the shape mesh.', **fixed),
        Parameter('hull.scale', 'float', 1.0, '-',
                  'Metres for each unit of length of hull.mesh: 0.001 for millimetres. Higher is '
                  'a larger boat.', at_least=1e-9, at_most=1e9, **fixed),
        Parameter('hull.probes', 'int_array', (2, 2), '-',
                  'Probes along and across each hull: its columns, and with panels where depth '
                  'and probe damping are taken. More follow short waves and large heel better '
                  'and cost more.', at_least=1, at_most=100, lengths=(2,), **fixed),
        Parameter('hull.panel_size', 'float', 0.0, 'm',
                  'Longest edge of a panel; 0 = as fine as the sea needs, the facets of the shape '
                  'in flat water and else an eighth of the shortest wave that matters. Higher is '
                  'cheaper.', at_least=0.0, at_most=1e6, **fixed),
        Parameter('probes.positions', 'float_array', None, 'm',
                  'x, y, z of every probe in the body frame, one flat list. Wider apart is '
                  'stiffer in roll and pitch.', at_least=-1e6, at_most=1e6, **fixed),
        Parameter('probes.weights', 'float_array', None, '-',
                  'Relative importance of every probe; without it all 1. Higher lifts more '
                  'there, at the cost of the others.', at_least=0.0, at_most=1e12),
        Parameter('probes.floatiness', 'float', 1.2, '-',
                  'Buoyancy budget over weight, F_max / (m g): 1 is neutral, less sinks. Higher '
                  'floats higher and bobs faster.', at_least=1e-6, at_most=1e6),
        Parameter('probes.stiffness', 'float', 4.0, '1/m',
                  'Share of its maximum force that a probe gives per metre of depth. Higher '
                  'floats higher, bobs faster and needs smaller steps.',
                  at_least=1e-9, at_most=1e9),
        Parameter('probes.law', 'string', None, '',
                  'Force of a probe over its depth: spring, soft or column; without it column '
                  'for a hull shape, else spring.', choices=LAWS, **fixed),
        _axes('damping.linear_retention', None,
              'Part of the velocity kept after one second in water, for all or for three body '
              'axes; without it 0.95, or 1 with damping.linear or damping.quadratic. Higher '
              'glides farther; 1 = no drag.'),
        _axes('damping.angular_retention', None,
              'Part of the angular velocity kept after one second in water, for all or for '
              'three body axes; without it 0.9, or 1 with damping.linear or damping.quadratic. '
              'Higher keeps rolling longer; 1 = no drag.'),
        _axes('damping.air_linear_retention', (0.999,),
              'Part of the velocity kept after one second out of the water. Higher falls '
              'faster.'),
        _axes('damping.air_angular_retention', (0.999,),
              'Part of the angular velocity kept after one second out of the water. Higher '
              'tumbles longer.'),
        Parameter('damping.probe', 'float_array', None, 'N·s/m',
                  'Damping of the probes against the water, all together, shared by weight: one '
                  'number, or three of surge, sway and heave; without it, in parts of critical '
                  'damping in heave, 0.3 in heave and 0.01 in surge and sway, or none with '
                  'damping.linear or damping.quadratic. Higher in heave comes to rest sooner and '
                  'follows the water more closely, in surge and sway glides less.',
                  at_least=0.0, at_most=1e15, lengths=(1, 3)),
        Parameter('damping.linear', 'float_array', (0.0,) * 6, 'N/(m/s), N·m/(rad/s)',
                  'Drag per speed in surge, sway, heave, roll, pitch, yaw. Higher is slower '
                  'for the same thrust.', at_least=0.0, at_most=1e15, lengths=(6,)),
        Parameter('damping.quadratic', 'float_array', (0.0,) * 6, 'N/(m/s)², N·m/(rad/s)²',
                  'Drag per speed squared in surge, sway, heave, roll, pitch, yaw. Higher is '
                  'slower at high speed.', at_least=0.0, at_most=1e15, lengths=(6,)),
        Parameter('added_mass', 'float_array', (0.0,) * 6, 'kg, kg·m²',
                  'Mass of the water that moves along in surge, sway, heave, roll, pitch, yaw, '
                  'all wet, about the centre of mass; for waves together with wave_force: '
                  'froude_krylov. Higher moves more slowly.', at_least=0.0, at_most=1e18,
                  lengths=(6,)),
        Parameter('wave_force', 'string', 'hydrostatic', '',
                  'hydrostatic, straight up by the surface above; or froude_krylov, the pressure '
                  'of the waves: dies out with depth, pushes along the slope, and takes the boat '
                  'along with the water.', choices=WAVE_FORCES, **fixed),
        Parameter('sea.waves', 'float_array', None, 'm, s, rad, rad',
                  'Waves, rows of four in one flat list: amplitude, period at a fixed point, '
                  'direction they go to (counter-clockwise from x), phase; without it none. '
                  'Higher amplitudes are rougher, longer periods make longer waves.'),
        Parameter('sea.sea_state', 'int', 0, '-',
                  'WMO sea state 0 to 9: an irregular JONSWAP sea instead of rows; 0 = none. '
                  'Higher is rougher and longer.', at_least=0, at_most=9),
        Parameter('sea.significant_height', 'float', 0.0, 'm',
                  'Significant wave height of a JONSWAP sea, with sea.peak_period; 0 = none. '
                  'Higher is rougher.', at_least=0.0, at_most=100.0),
        Parameter('sea.peak_period', 'float', 0.0, 's',
                  'Period of the highest waves of a JONSWAP sea, with sea.significant_height. '
                  'Higher is longer and less steep.', at_least=0.0, at_most=1000.0),
        Parameter('sea.direction', 'float', 0.0, 'rad',
                  'Where a JONSWAP sea goes. Higher turns it counter-clockwise: 0 along world x, '
                  'pi/2 along y.',
                  at_least=-1e3, at_most=1e3),
        Parameter('sea.spreading', 'float', 0.0, '-',
                  'How closely the waves of a JONSWAP sea keep to sea.direction: the s of '
                  'cos^2s of half the angle to it; 5 to 9 in a wind sea, 13 and more in swell, 0 '
                  '= all go there. Higher is narrower, with longer crests.',
                  at_least=0.0, at_most=1000.0),
        Parameter('sea.components', 'int', 16, '-',
                  'Waves that make up a JONSWAP sea. More is more natural and costs more.',
                  at_least=1, at_most=MAX_COMPONENTS),
        Parameter('sea.seed', 'int', 1, '-',
                  'Chooses the phases of a JONSWAP sea, and which wave goes where about its '
                  'direction: same seed, same sea everywhere. Another is another sea of the same '
                  'kind.',
                  at_least=0, at_most=2 ** 63 - 1),
        Parameter('sea.depth', 'float', 0.0, 'm',
                  'Depth of the water; 0 = deep. Shallower makes long waves shorter and slower.',
                  at_least=0.0, at_most=1e5),
        Parameter('sea.current', 'float_array', (0.0, 0.0), 'm/s',
                  'Current along world x and y. Higher drifts faster, and makes waves longer that '
                  'go with it; against it they are shorter, and the shortest cannot run.',
                  at_least=-1e3, at_most=1e3, lengths=(2,)),
        Parameter('sea.transition', 'float', 4.0, 's',
                  'Time over which a new sea replaces the old; 0 = at once. Higher is gentler.',
                  at_least=0.0, at_most=1e6),
        Parameter('wind.velocity', 'float_array', (0.0, 0.0), 'm/s',
                  'Wind along world x and y, where it blows to; it acts through wind.drag. Higher '
                  'drifts faster.', at_least=-1e3, at_most=1e3, lengths=(2,)),
        Parameter('wind.drag', 'float_array', (0.0,) * 3, 'N/(m/s)², N·m/(m/s)²',
                  'Drag in the air per speed squared, of the boat relative to the wind: surge, '
                  'sway and yaw, the torque of the side force. Higher is slower and drifts '
                  'faster in wind; a yaw above 0 turns the bow away from the wind, below 0 into '
                  'it.', at_least=-1e15, at_most=1e15, lengths=(3,)),
        Parameter('start.position', 'float_array', (0.0, 0.0), 'm',
                  'Where the body frame starts in the world: x, y (floats at its draft) or '
                  'x, y, z. A higher z drops it from there.', at_least=-1e9, at_most=1e9,
                  lengths=(2, 3), **fixed),
        Parameter('start.orientation', 'float_array', None, 'rad',
                  'Roll, pitch, yaw at the start; without it as the boat lies at rest. Higher '
                  'roll lowers starboard, higher pitch the bow, higher yaw turns left.',
                  at_least=-1e3, at_most=1e3, lengths=(3,), **fixed),
        Parameter('start.velocity', 'float_array', (0.0, 0.0, 0.0), 'm/s',
                  'Velocity of the body frame at the start: ahead, to port, up in body axes. '
                  'Higher starts faster.',
                  at_least=-1e6, at_most=1e6, lengths=(3,), **fixed),
        Parameter('start.angular_velocity', 'float_array', (0.0, 0.0, 0.0), 'rad/s',
                  'Angular velocity at the start, in roll, pitch, yaw about body axes. Higher '
                  'starts turning faster.', at_least=-1e6, at_most=1e6,
                  lengths=(3,), **fixed),
        Parameter('thrust.timeout', 'float', 0.5, 's',
                  'Time without a wrench, or without a thrust for a thruster, before what it '
                  'asked for falls to zero; 0 = hold the last one. Higher bridges longer gaps.',
                  at_least=0.0, at_most=1e6),
        Parameter('thrusters.names', 'string_array', None, '',
                  'Name of each thruster, which is driven by topics of its own; without it none.',
                  **fixed),
        Parameter('thrusters.positions', 'float_array', None, 'm',
                  'x, y, z of every thruster in the body frame, one flat list. Wider apart turns '
                  'harder; out of the water it gives nothing.',
                  at_least=-1e6, at_most=1e6, **fixed),
        Parameter('thrusters.directions', 'float_array', None, '-',
                  'x, y, z of where each pushes the boat, of any length; without it ahead. Higher '
                  'x, y, z push more ahead, to port, up.', at_least=-1e6, at_most=1e6, **fixed),
        Parameter('thrusters.limits', 'float_array', None, 'N',
                  'Least and greatest thrust of each, 0 between them, one flat list; without it '
                  'no limits. Higher pushes harder at full power.', at_least=-1e15, at_most=1e15,
                  **fixed),
        Parameter('thrusters.lag', 'float', 0.0, 's',
                  'Time constant of their thrust; 0 = at once. Higher follows more slowly.',
                  at_least=0.0, at_most=1e6, **fixed),
        Parameter('imu.rate', 'float', 100.0, 'Hz',
                  'Messages of the IMU per second, at most one a period; 0 = no IMU. Higher '
                  'follows quick motion.', at_least=0.0, at_most=1e5, **fixed),
        Parameter('imu.position', 'float_array', (0.0, 0.0, 0.0), 'm',
                  'Where it sits in the body frame, its axes those of the boat. Higher feels '
                  'more of roll and pitch.', at_least=-1e6, at_most=1e6, lengths=(3,), **fixed),
        Parameter('imu.accelerometer_noise', 'float', 0.0, 'm/s²',
                  'Standard deviation of white noise on each axis. Higher is noisier.',
                  at_least=0.0, at_most=1e6, **fixed),
        Parameter('imu.gyroscope_noise', 'float', 0.0, 'rad/s',
                  'Standard deviation of white noise on each axis. Higher is noisier.',
                  at_least=0.0, at_most=1e6, **fixed),
        Parameter('imu.orientation_noise', 'float', 0.0, 'rad',
                  'Standard deviation of white noise of the attitude about each axis. Higher is '
                  'noisier.', at_least=0.0, at_most=1.0, **fixed),
        Parameter('imu.seed', 'int', 1, '-',
                  'Chooses the noise: same seed, same numbers from a node of the same name and '
                  'namespace; boats beside it have noise of their own. Another is other noise of '
                  'the same kind.', at_least=0, at_most=2 ** 63 - 1, **fixed),
        Parameter('fix.rate', 'float', 10.0, 'Hz',
                  'Messages of the satellite receiver per second, at most one a period; 0 = no '
                  'receiver. Higher follows quick motion.', at_least=0.0, at_most=1e5, **fixed),
        Parameter('fix.position', 'float_array', (0.0, 0.0, 0.0), 'm',
                  'Where its antenna is in the body frame. Higher swings more as the boat rolls.',
                  at_least=-1e6, at_most=1e6, lengths=(3,), **fixed),
        Parameter('fix.latitude', 'float', 0.0, 'deg',
                  "Latitude of the world's origin, on the ellipsoid WGS84. Higher is farther "
                  'north.', at_least=-90.0, at_most=90.0, **fixed),
        Parameter('fix.longitude', 'float', 0.0, 'deg',
                  "Longitude of the world's origin. Higher is farther east.",
                  at_least=-180.0, at_most=180.0, **fixed),
        Parameter('fix.altitude', 'float', 0.0, 'm',
                  'Height of the mean water level there above the ellipsoid. Higher adds to every '
                  'altitude.', at_least=-1e6, at_most=1e6, **fixed),
        Parameter('fix.noise', 'float_array', (0.0, 0.0), 'm',
                  'Standard deviation of white noise, horizontal on each axis and vertical. '
                  'Higher is noisier.', at_least=0.0, at_most=1e6, lengths=(2,), **fixed),
        Parameter('fix.seed', 'int', 1, '-',
                  'Chooses the noise: same seed, same numbers from a node of the same name and '
                  'namespace; boats beside it have noise of their own. Another is other noise of '
                  'the same kind.', at_least=0, at_most=2 ** 63 - 1, **fixed),
    )


PARAMETERS = {parameter.name: parameter for parameter in _table()}
