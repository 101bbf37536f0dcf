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

"""Names that are no parameters, and the parameters that were meant: by letters and by meaning."""

import difflib

from .parameters import PARAMETERS

SURE = 0.9
# {what one might write: the parameter that has it}; where another is wanted, with its group.
WORDS = {
    'weight': 'boat.mass', 'displacement': 'boat.mass',
    'draft': 'boat.mass (draft follows from it and the hull)',
    'draught': 'boat.mass (draft follows from it and the hull)',
    'com': 'boat.center_of_mass', 'cog': 'boat.center_of_mass',
    'center_of_gravity': 'boat.center_of_mass', 'centre_of_gravity': 'boat.center_of_mass',
    'moment_of_inertia': 'boat.inertia', 'moments_of_inertia': 'boat.inertia',
    'length': 'hull.size', 'beam': 'hull.size', 'width': 'hull.size', 'dimensions': 'hull.size',
    'hull.depth': 'hull.size', 'hull.height': 'hull.size', 'boat.height': 'hull.size',
    'type': 'hull.shape', 'file': 'hull.mesh', 'stl': 'hull.mesh',
    'buoyancy': 'probes.floatiness', 'budget': 'probes.floatiness',
    'spring': 'probes.stiffness', 'spring_constant': 'probes.stiffness',
    'points': 'probes.positions', 'floats': 'probes.positions',
    'drag': 'damping.linear', 'friction': 'damping.linear', 'linear_drag': 'damping.linear',
    'drag_coefficients': 'damping.quadratic', 'quadratic_drag': 'damping.quadratic',
    'wave_height': 'sea.significant_height', 'height': 'sea.significant_height',
    'hs': 'sea.significant_height', 'wave_period': 'sea.peak_period', 'tp': 'sea.peak_period',
    'period': 'sea.peak_period', 'wave_direction': 'sea.direction',
    'wave_amplitude': 'sea.waves', 'amplitude': 'sea.waves', 'state': 'sea.sea_state',
    'wind.speed': 'wind.velocity', 'wind_speed': 'wind.velocity',
    'density': 'water_density', 'rho': 'water_density', 'g': 'gravity',
    'frequency': 'rate', 'hz': 'rate', 'dt': 'rate', 'time_step': 'rate', 'timestep': 'rate',
    'solver': 'integrator', 'method': 'integrator', 'real_time_factor': 'time_factor',
    'heading': 'start.orientation', 'yaw': 'start.orientation', 'attitude': 'start.orientation',
    'frame_id': 'world_frame', 'base_frame': 'body_frame', 'thrusters': 'thrusters.names'}


def check_names(names):
    """Raise ValueError for the first name that is no parameter, with the nearest that is."""
    for name in names:
        if name not in PARAMETERS:
            near = meant(str(name).lower())
            raise ValueError(f'{name}: no such parameter'
                             + (f', did you mean {near}?' if near else
                                f'; expected one of {", ".join(PARAMETERS)}'))


def meant(name):
    """Return the parameter that a name most likely stands for, or ''."""
    own, last = name.rpartition('.')[2], {known.rpartition('.')[2]: known for known in PARAMETERS}
    # A slip of the finger, then another word for it, then what looks like it.
    return (_closest(name, PARAMETERS, SURE) or WORDS.get(name) or WORDS.get(own)
            or _closest(name, PARAMETERS) or last.get(_closest(own, last), ''))


def _closest(name, known, cutoff=0.6):
    return next(iter(difflib.get_close_matches(name, known, 1, cutoff)), '')
