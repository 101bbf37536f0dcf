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

"""Scenes: a parameter file, or the same values from elsewhere, turned into a boat on a sea."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
import os

import numpy as np

from . import parameter_file, parameters
from .build import (AHEAD, assembled_boat, assembled_sea, assembled_start, assembled_thrusters,
                    gives_drag, MADE_OF, NO_LIMITS, RETENTION, start_attitude)
from .parameter_names import check_names
from .parameter_values import checked
from .parameters_together import check_together, PROBES_ONLY, remarks, without_use
from ..boat.boat import Boat
from ..boat.state import PARTS, State
from ..forces.thrusters import Propulsion
from ..hydrostatics.warnings import flotation_warnings
from ..sea.waves import Sea
from ..step_size.plan import Plan, plan
from ..stepping.fleet import Fleet
from ..stepping.simulation import Simulation


@dataclass(frozen=True, eq=False)
class Scene:
    """
    A boat, its sea and its start, and how to step it.

    Main arguments: ``boat``, ``sea``, ``start`` (`State` of the centre of mass); ``rate`` Hz,
    ``integrator`` and ``substeps`` as asked for, 0 = chosen.
    Other arguments: ``world_frame``, ``body_frame`` with its prefix, ``thrust_timeout`` s;
    ``thrusters``, a tuple of `Thruster`; ``warnings``, sentences, those of ``flotation`` about
    the hull at rest among them; ``given``, the parameters that were given, {name: value};
    ``values``, every parameter in force, what was derived filled in: given again they make the
    same scene.
    """

    boat: Boat
    sea: Sea
    start: State
    rate: float
    integrator: str
    substeps: int
    world_frame: str
    body_frame: str
    thrust_timeout: float
    thrusters: tuple
    warnings: tuple
    flotation: tuple
    given: dict
    values: dict

    def simulation(self, *, integrator: str | None = None, rate: float | None = None,
                   substeps: int | None = None, allow_unstable: bool = False,
                   state: State | None = None) -> Simulation:
        """
        Return a `Simulation` of the scene.

        Main arguments: ``integrator``, ``rate`` Hz and ``substeps`` (0 = chosen from the
        stability limit) replace the scene's; ``state`` replaces its start.
        Other arguments: ``allow_unstable`` runs substeps past the stability limit, for study;
        otherwise they are a ValueError.
        """
        rate = self.rate if rate is None else checked('rate', rate)
        chosen = self.plan(integrator, rate, substeps, allow_unstable)
        return Simulation(
            self.boat, self.sea, self.start if state is None else state, rate=rate,
            integrator=chosen.integrator, substeps=chosen.substeps,
            warnings=self.warnings + tuple(chosen.warnings))

    def propulsion(self) -> Propulsion:
        """Return the thrusters of the scene, ready to drive a `Simulation` of it."""
        return Propulsion(self.thrusters)

    def plan(self, integrator: str | None = None, rate: float | None = None,
             substeps: int | None = None, allow_unstable: bool = False) -> Plan:
        """Return the `Plan` of `simulation` with the same arguments."""
        substeps = self.substeps if substeps is None else checked('substeps', substeps)
        return plan(self.boat, integrator=self.integrator if integrator is None else integrator,
                    rate=self.rate if rate is None else rate, substeps=substeps,
                    allow_unstable=allow_unstable)


def load_scene(source: str | os.PathLike | Mapping) -> Scene:
    """
    Return the `Scene` of a parameter file, or of a dict of parameters.

    ``source`` is the path of a file as ROS reads it, or a dict with dotted or nested names; {} is
    the default boat.  ValueError says in one line which parameter is wrong, what was given and
    what is expected.
    """
    if isinstance(source, Mapping):
        return scene_from_values(dict(_flattened(source)))
    if not isinstance(source, (str, os.PathLike)):
        raise ValueError('scene: expected the path of a parameter file or a dict of parameters, '
                         f'got {source!r}')
    values = {name: value for name, value in parameter_file.read(source).items()
              if name.partition('.')[0] not in parameter_file.ROS_OWN}
    try:
        return scene_from_values(values, folder=os.path.dirname(source))
    except ValueError as error:
        raise ValueError(f'{source}: {error}') from None


def load_fleet(scenes: Iterable, *, threads: int | None = None) -> Fleet:
    """
    Return a `Fleet` of many scenes, each with its own boat, sea and start.

    Main arguments: ``scenes``, each a `Scene` or what `load_scene` takes; the same object may
    stand many times.  They have one rate, one integrator and equally many probes.
    Other arguments: ``threads`` as of `Fleet`.  ValueError says what differs.  The warnings of
    the scenes are those of the fleet, with the number of the first scene that each is about.
    """
    scenes = list(scenes)
    loaded, plans, warnings = {}, {}, {}
    for place, source in enumerate(scenes):
        if id(source) not in loaded:
            try:
                scene = source if isinstance(source, Scene) else load_scene(source)
                loaded[id(source)], plans[id(source)] = scene, scene.plan()
            except ValueError as error:
                raise ValueError(f'fleet: scene {place}: {error}') from None
            for sentence in (*scene.warnings, *plans[id(source)].warnings):
                warnings.setdefault(sentence, f'scene {place}: {sentence}')
    for name, values in (('rate', {scene.rate for scene in loaded.values()}),
                         ('integrator', {chosen.integrator for chosen in plans.values()})):
        if len(values) > 1:
            raise ValueError(f'fleet: expected scenes of one {name}, got '
                             f'{" and ".join(map(str, sorted(values)))}; give them the same '
                             f'{name}' + ''.join(f' ({said})' for said in warnings.values()
                                                 if name == 'integrator' and 'substeps' in said))
    each = [loaded[id(source)] for source in scenes]
    if not each:
        raise ValueError('fleet: expected at least one scene, got none')
    start = State(*(np.stack([getattr(scene.start, part) for scene in each]) for part in PARTS))
    return Fleet([scene.boat for scene in each], [scene.sea for scene in each], start,
                 rate=each[0].rate, integrator=plans[id(scenes[0])].integrator,
                 substeps=[plans[id(source)].substeps for source in scenes], threads=threads,
                 warnings=tuple(warnings.values()))


def scene_from_values(values, before=None, folder='.'):
    """
    Return the `Scene` of parameters {dotted name: value}; None means not given.

    Parts of the `Scene` ``before`` whose parameters are the same are taken over as they are.
    ``folder``, the one that paths start from.  ValueError as in `load_scene`.
    """
    values = {name: value for name, value in values.items() if value is not None}
    check_names(values)
    given = {name: checked(name, value) for name, value in values.items()}
    if 'hull.mesh' in given:
        # Absolute, so that what is in force makes the same boat from anywhere.
        given['hull.mesh'] = os.path.abspath(os.path.join(folder, given['hull.mesh']))
    in_force = _in_force(given)
    check_together(given, in_force)

    kept = _kept(in_force, before)
    parts = {part: {name: in_force[name] for name in names} for part, names in MADE_OF.items()}
    sea = before.sea if 'sea' in kept else assembled_sea(parts['sea'])
    boat, said = (before.boat.on(sea), ()) if kept >= {'hull', 'damping'} else assembled_boat(
        {**parts['hull'], **parts['damping']}, sea, before.boat if 'hull' in kept else None)
    start = before.start if kept >= {'hull', 'start'} else assembled_start(boat, parts['start'])
    flotation = before.flotation if 'hull' in kept else (*said, *flotation_warnings(boat))
    thrusters = assembled_thrusters(in_force)
    return Scene(
        boat, sea, start, in_force['rate'], in_force['integrator'], in_force['substeps'],
        in_force['world_frame'], in_force['frame_prefix'] + in_force['body_frame'],
        in_force['thrust.timeout'], thrusters,
        (*flotation, *remarks(boat, sea, thrusters, given, in_force)), flotation, given,
        _complete(boat, given, in_force))


def _in_force(given):
    """Return {name: value} of every parameter, None where it is to be derived from the boat."""
    values = {name: given.get(name, parameter.default)
              for name, parameter in parameters.PARAMETERS.items()}
    return values | {name: (1.0,) if gives_drag(values) else kept
                     for name, kept in RETENTION.items() if values[name] is None}


def _kept(in_force, before):
    """Return the parts whose parameters are those of a scene before, or were derived to be."""
    if before is None:
        return set()
    then, derived = _in_force(before.given), before.values
    return {part for part, names in MADE_OF.items()
            if all(in_force[name] == then[name] or in_force[name] == derived.get(name)
                   for name in names)}


def _flattened(values, prefix=''):
    """Yield (dotted name, value) of a dict with dotted or nested names, each name once."""
    seen = set()
    for key, value in values.items():
        name = f'{prefix}{key}'
        inner = (_flattened(value, name + '.') if isinstance(value, Mapping)
                 else ((name, value),))
        for pair in inner:
            if pair[0] in seen:
                raise ValueError(f'{pair[0]}: given twice')
            seen.add(pair[0])
            yield pair


def _complete(boat, given, in_force):
    """Return every parameter in force, with derived ones as they were derived."""
    count = len(in_force['thrusters.names'] or ())
    derived = {
        'boat.inertia': tuple(float(boat.inertia[i]) for i in (
            (0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))),
        'damping.probe': tuple(boat.damping.probe.tolist()),
        'hull.bottom': float(boat.hull.positions[0, 2]),
        'probes.weights': (1.0,) * len(boat.hull.positions),
        'probes.law': boat.hull.law, 'sea.waves': (),
        'start.orientation': start_attitude(boat, in_force),
        'thrusters.directions': AHEAD * count,
        'thrusters.limits': NO_LIMITS * count}
    absent = ('hull.',) if 'probes.positions' in given else (*PROBES_ONLY, *without_use(in_force))
    if not count:
        absent = (*absent, 'thrusters.')
    return {name: derived[name] if value is None else value
            for name, value in in_force.items() if not name.startswith(absent)}
