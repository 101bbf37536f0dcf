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
The parameters of the node: declared from the one table, checked as one scene, live.

What rclpy would say of a wrong value is not what a user needs to read; here every value is
judged by the table and the scene, and their sentence is the reason given.
"""

from array import array
import re

from rcl_interfaces.msg import (FloatingPointRange, IntegerRange, ParameterDescriptor,
                                SetParametersResult)
from rclpy.node import Node
from rclpy.parameter import Parameter

from ..physics.checks import shown
from ..physics.scene.changes import changed
from ..physics.scene.parameter_file import ROS_OWN
from ..physics.scene.parameter_names import check_names
from ..physics.scene.parameters import PARAMETERS
from ..physics.scene.scene import scene_from_values

TYPES = {
    'float': Parameter.Type.DOUBLE, 'int': Parameter.Type.INTEGER, 'bool': Parameter.Type.BOOL,
    'string': Parameter.Type.STRING, 'path': Parameter.Type.STRING,
    'float_array': Parameter.Type.DOUBLE_ARRAY, 'int_array': Parameter.Type.INTEGER_ARRAY,
    'string_array': Parameter.Type.STRING_ARRAY}
# Always declared and always live.
HARMLESS = 'thrust.timeout'


def is_ros_own(name):
    """Return True for a parameter that every node has, none of ours."""
    return name.partition('.')[0] in ROS_OWN


def plain(parameter):
    """Return the value of an rclpy Parameter as number, text or list."""
    if parameter.type_ is Parameter.Type.NOT_SET:
        # `[]` in a file: rcl knows no type for it.
        return []
    return list(parameter.value) if isinstance(parameter.value, array) else parameter.value


def typed(parameter):
    """
    Return `plain`; ValueError with what to type for a list of numbers that came as text.

    As text comes what ROS has no type for: a list of integers and others, or a list of lists.
    """
    value = plain(parameter)
    if isinstance(value, str) and PARAMETERS[parameter.name].kind == 'float_array':
        try:
            numbers = [float(word) for word in re.sub(r'[][,;]', ' ', value).split()]
        except ValueError:
            return value
        raise ValueError(f'{parameter.name}: expected one flat list of numbers, all with a '
                         f'decimal point or all without, got the text {shown(value)}; type '
                         f'{shown(str(numbers))}')
    return value


def ros_parameter(name, value):
    """Return an rclpy Parameter of the table's type."""
    if isinstance(value, tuple):
        value = list(value)
    return Parameter(name, TYPES[PARAMETERS[name].kind], value)


def descriptor(parameter):
    """Return the ParameterDescriptor of a row of the table."""
    unit = f' [{parameter.unit}]' if parameter.unit else ''
    description = ParameterDescriptor(
        name=parameter.name, type=TYPES[parameter.kind].value,
        description=parameter.description + unit, read_only=parameter.read_only,
        # Integers for doubles are taken as numbers; the table sees to the types.
        dynamic_typing=True, additional_constraints=constraints(parameter))
    if parameter.limits is not None:
        lowest, highest = parameter.limits
        if parameter.kind == 'float':
            description.floating_point_range = [
                FloatingPointRange(from_value=float(lowest), to_value=float(highest))]
        else:
            description.integer_range = [
                IntegerRange(from_value=int(lowest), to_value=int(highest), step=1)]
    return description


def constraints(parameter):
    """Return in words what a range cannot say."""
    words = []
    if parameter.choices:
        words.append('one of ' + ', '.join(parameter.choices))
    if parameter.lengths:
        words.append(' or '.join(map(str, parameter.lengths)) + ' numbers')
    if parameter.above is not None:
        words.append(f'above {parameter.above:g}')
    if parameter.kind.endswith('_array'):
        if parameter.at_least is not None:
            words.append(f'at least {parameter.at_least:g}')
        if parameter.at_most is not None:
            words.append(f'at most {parameter.at_most:g}')
    return ', '.join(words)


class ParameterNode(Node):
    """
    A node that is given parameters of any name and type, and declares ours when they are right.

    Main arguments: ``name`` of the node.
    """

    def __init__(self, name):
        """Take what files and command line give."""
        super().__init__(name, allow_undeclared_parameters=True,
                         automatically_declare_parameters_from_overrides=True)

    def declare_parameters(self, namespace, parameters, ignore_override=False):
        """
        Declare as rclpy does, but take what files and command line give whatever its type.

        rclpy's constructor hands all that was given to this function.  Left alone it would refuse
        `[]`, which has no type in a file; and ROS's own parameters are left out, because rclpy
        declares them itself afterwards and checks their types then.
        """
        if ignore_override:
            parameters = [one for one in parameters if not is_ros_own(one[0])]
            for _, _, description in parameters:
                description.dynamic_typing = True
        return super().declare_parameters(namespace, parameters, ignore_override)

    def given_values(self):
        """Return {name: value} of the parameters that files and command line gave the node."""
        return {name: plain(parameter)
                for name, parameter in self.get_parameters_by_prefix('').items()
                if not is_ros_own(name)}

    def declare(self, scene):
        """Declare every parameter that a scene has in force, with its value and description."""
        for name in self.given_values():
            self.undeclare_parameter(name)
        self.declare_parameters('', [
            (name, ros_parameter(name, value).value, descriptor(PARAMETERS[name]))
            for name, value in scene.values.items()], ignore_override=True)
        # Declared by its value alone, an empty list is one of bytes.
        self.set_parameters([ros_parameter(name, value)
                             for name, value in scene.values.items() if value == ()])


class LiveParameters:
    """
    Parameters that change while the node runs: a set is judged as a whole, then applied.

    Main arguments: ``node``; ``given`` {name: value}, what the user gave; ``scene`` made of it;
    ``check`` (scene, names that were set), whose ValueError refuses what cannot go with what
    runs; ``apply`` (scene, plan, names that were set), called between two steps, with the `Plan`
    of another boat, None where the boat is the same.
    """

    def __init__(self, node, given, scene, check, apply):
        """Take part in every set from now on."""
        self._node, self._at_start, self._given = node, dict(given), dict(given)
        self._scene, self._check, self._apply = scene, check, apply
        self._proposal = self._refusal = None
        node.add_pre_set_parameters_callback(self._propose)
        node.add_on_set_parameters_callback(self._judge)
        node.add_post_set_parameters_callback(self._take)

    def _propose(self, requested):
        """Work out the scene that a set asks for, and return everything that changes with it."""
        self._proposal = self._refusal = None
        # rclpy looks before `_judge` does, and at every name: whatever there is nothing to set
        # of, this can be set, and changes nothing.
        harmless = [ros_parameter(HARMLESS, self._scene.values[HARMLESS])]
        try:
            requested = [one for one in requested if not self._is_as_fixed(one)]
            if not requested:
                return harmless
            given = self._merged(requested)
            scene = scene_from_values(given, self._scene)
            names = {parameter.name for parameter in requested}
            self._check(scene, names)
            plan = None if scene.boat is self._scene.boat else scene.plan()
            self._proposal = given, scene, plan, frozenset(names)
        except Exception as error:  # a raise here would be the end of the node
            self._refusal = ' '.join(str(error).split()) or repr(error)
            return harmless
        # What was derived follows; how the boat would have started does not matter any more.
        names |= {name for name, value in scene.values.items()
                  if value != self._scene.values.get(name) and not PARAMETERS[name].read_only}
        return [ros_parameter(name, scene.values[name]) for name in sorted(names)]

    def _merged(self, requested):
        """Return what would be given after a set; ValueError for what can never be set."""
        for parameter in requested:
            if is_ros_own(parameter.name):
                raise ValueError(f'{parameter.name}: cannot change while the node runs')
        check_names(parameter.name for parameter in requested)
        for parameter in requested:
            if PARAMETERS[parameter.name].read_only:
                raise ValueError(f'{parameter.name}: cannot change while the node runs; '
                                 'start it again with the new value')
        # `ros2 param delete` goes back to the start.
        return changed(self._given, self._at_start, {
            parameter.name: None if parameter.type_ is Parameter.Type.NOT_SET
            else typed(parameter) for parameter in requested})

    def _is_as_fixed(self, parameter):
        """Return True for a value that cannot change and is in force, as of the node's dump."""
        name = parameter.name
        fixed = is_ros_own(name) or name in self._scene.values and PARAMETERS[name].read_only
        return fixed and plain(parameter) == plain(self._node.get_parameter(name))

    def _judge(self, _):
        if self._refusal:
            return SetParametersResult(successful=False, reason=self._refusal)
        return SetParametersResult(successful=True)

    def _take(self, _):
        if self._proposal is None:
            return
        self._given, self._scene, plan, names = self._proposal
        self._proposal = None
        self._apply(self._scene, plan, names)
