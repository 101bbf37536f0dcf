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
The node: it wires topics, services and parameters to a `Session` and steps it.

Everything happens in one thread, so callbacks act between two steps; `tick` runs the steps that
are due and is called as often as there is something to do.
"""

import os
import sys
import time

from geometry_msgs.msg import PoseWithCovarianceStamped, Vector3Stamped, WrenchStamped
import rclpy
from rclpy.signals import SignalHandlerOptions
from std_srvs.srv import SetBool, Trigger

from . import network, qos, startup, transforms
from .clocks import ClockDrive, SteadyDrive, WallDrive
from .complaints import Refused, Throttle
from .ending import told_to_end
from .initial_pose import read_place
from .markers import Markers
from .messages import ClockOutput, Outputs, WavesOutput
from .parameters import LiveParameters, ParameterNode
from .reports import Reports
from .sensors import sensors_of
from .session import Session
from .thrust import read_wrench
from .thrusters import ThrusterInput
from .topics import NodeTopics
from .wave_messages import WavesInput
from .wind import read_wind
from ..physics.compiled import notice
from ..physics.scene.parameters import NODE_NAME
from ..physics.scene.parameters_together import sea_warnings
from ..physics.scene.scene import scene_from_values
from ..physics.stepping.march import march_by

IDLE = 0.05  # s between looks at the signals and clocks when nothing is due
# Steps that are due go before what others ask for, but for no longer than this at a time.
BUSY = 0.02  # s


class BoatNode(ParameterNode):
    """A boat on its water, as a ROS 2 node."""

    def __init__(self):
        """Read the parameters and start; ValueError says what is wrong with them."""
        super().__init__(NODE_NAME)
        given = self.given_values()
        self._sim_time = self.get_parameter('use_sim_time').value
        with startup.warnings_said(self.get_logger().warning):
            if given.get('publish_tf') is True:
                given.setdefault('frame_prefix', transforms.prefix(self.get_namespace()))
            if isinstance(given.get('hull.mesh'), str):
                folder = startup.folder_of(sys.argv, 'hull.mesh', given['hull.mesh'])
                given['hull.mesh'] = os.path.join(folder, given['hull.mesh'])
            scene = scene_from_values(given)
            startup.check_time(scene.values, self._sim_time)
            transforms.check(scene.values)
            # Said before it is done: it takes long.
            if compiling := notice(march_by(scene.integrator)):
                self.get_logger().info(compiling)
            self.session = Session(scene)
        self._own_clock = scene.values['publish_clock']
        self.declare(scene)
        LiveParameters(self, given, scene, self.session.sea_with, self._change)
        self._paused = False
        # rclpy wants one severity for each line of code that it is called from.
        self._news = Throttle(lambda sentence: self.get_logger().info(sentence))
        self._bad_news = Throttle(lambda sentence: self.get_logger().warning(sentence))
        now = time.monotonic()
        self._reports = Reports(self, self.session, now)
        self._reports.loaded()
        for sentence in startup.remarks(self, given, scene.values):
            self.get_logger().warning(sentence)

        topics = NodeTopics(self)
        self._outputs = Outputs(
            topics, scene, sensors_of(topics, scene),
            transforms.topics_of(topics, scene, self.get_clock().now().nanoseconds))
        self._markers = Markers(topics, scene)
        self._clock_output = ClockOutput(topics) if self._own_clock else None
        self._waves_output = WavesOutput(topics)
        self._waves_input = WavesInput(self, self._reports.complaints, self._on_waves)
        guarded = self._reports.complaints.guarded
        command = self._reports.command
        self.create_subscription(
            WrenchStamped, 'thrust', command('thrust', self._on_thrust), qos.THRUST)
        for thruster in scene.thrusters:
            ThrusterInput(self, thruster, self.session, command)
        self.create_subscription(
            Vector3Stamped, 'wind', guarded('wind', self._on_wind), qos.WIND)
        self.create_subscription(PoseWithCovarianceStamped, 'initialpose',
                                 guarded('initialpose', self._on_place), qos.REQUEST)
        self.create_service(Trigger, '~/reset', self._on_reset)
        self.create_service(SetBool, '~/set_paused', self._on_set_paused)
        self.create_service(Trigger, '~/step', self._on_step)

        self._drive = self._chosen_drive(scene.rate, scene.values['time_factor'])
        self._waves_output.publish(self.session.sea)

    def _chosen_drive(self, rate, time_factor):
        """Return what the steps follow."""
        if self._sim_time:
            return ClockDrive(rate, lambda: self.get_clock().now().nanoseconds,
                              self.get_logger().warning)
        if self._own_clock:
            return SteadyDrive(rate, time_factor)
        if time_factor != 1.0:
            return SteadyDrive(rate, time_factor, time.time_ns())
        return WallDrive(rate, time.time_ns, self.get_logger().warning)

    # What is done over and over.

    def tick(self):
        """Run the steps that are due and what is beside them; return the s until the next look."""
        now = time.monotonic()
        halted = self._paused or self.session.fault
        if not halted:
            self._run_due(now)
        # Afterwards, so that what is said of lost steps is of the second that lost them.
        self._look_around(now)
        return IDLE if halted else min(self._drive.wait(), IDLE)

    def _run_due(self, now):
        """Run the steps that are due, or give them up."""
        turn = self._drive.turn()
        if turn.moved_to is not None:
            self.session.rebase(turn.moved_to)
            self._publish()
        if turn.dropped:
            self._reports.dropped(turn.dropped, self._drive.skips, now)
            if self._drive.skips:
                self.session.skip(turn.dropped)
        for _ in range(turn.due):
            if not self._step() or time.monotonic() - now > BUSY:
                break

    def _step(self):
        """Step once and publish what came of it; return True when it went well."""
        began = time.monotonic()
        if not self.session.step():
            self._reports.stopped()
            return False
        self._drive.ran()
        stepped = time.monotonic()
        self._publish()
        self._reports.stepped(stepped - began, time.monotonic() - stepped)
        return True

    def _publish(self):
        if self._clock_output:
            self._clock_output.publish(self.session.stamp)
        self._outputs.publish(self.session)

    def _look_around(self, now):
        """Do what goes by wall time: markers, reports, looking for who latches waves."""
        self._markers.look(self.session, now)
        self._waves_input.look(now)
        halted = self._paused or self.session.fault
        if self._reports.look(self._paused, now) and halted and self._clock_output:
            # Who comes while time stands still has to learn the time, too.
            self._clock_output.publish(self.session.stamp)

    # What others ask for.

    def _on_thrust(self, message):
        wrench, in_world = read_wrench(message, self.session.scene)
        self.session.thrust.hold(wrench, in_world, self.session.age)

    def _on_waves(self, rows):
        if self.session.set_waves(rows):
            self._waves_output.publish(self.session.sea)
            hull = self.session.simulation.boat.hull
            panels = f', on {hull.carriers}' if hull.panels is not None else ''
            self._news.say('waves', f'waves: {len(self.session.sea.waves)} in force{panels}',
                           time.monotonic())
            for sentence in sea_warnings(self.session.sea):
                self._bad_news.say('waves', sentence, time.monotonic())

    def _on_wind(self, message):
        x, y = wind = read_wind(message, self.session.scene)
        if self.session.set_wind(wind):
            felt = self.session.scene.boat.damping.wind.any()
            self._news.say('wind', f'wind: x {x:.2f} y {y:.2f} m/s' + (
                '' if felt else ' has no effect: wind.drag is all zeros'), time.monotonic())

    def _on_place(self, message):
        x, y, yaw = read_place(message, self.session.scene)
        if self.session.fault:
            raise Refused('stopped', 'initialpose: the motion was stopped by a fault; expected a '
                          'call of ~/reset first')
        self.session.place(x, y, yaw)
        self._news.say('place', f'boat put at x {x:.2f} y {y:.2f} m, as it lies at rest',
                       time.monotonic())
        self._show_paused()

    def _show_paused(self):
        """Show a paused boat where it was put; one that runs is shown with its next stamp."""
        if self._paused:
            self._publish()

    def _change(self, scene, plan, names):
        before = self.session.sea
        self.session.change(scene, plan, names)
        self._reports.warnings(scene, plan)
        if self.session.sea is not before:
            self._waves_output.publish(self.session.sea)

    def _on_reset(self, _, response):
        faulted = self.session.fault is not None
        self.session.reset()
        if faulted and not self._paused:
            self.session.skip(self._drive.resume())
        self._show_paused()
        response.success, response.message = True, 'at the start; sea and time go on'
        return response

    def _on_set_paused(self, request, response):
        if self._paused and not request.data and not self.session.fault:
            self.session.skip(self._drive.resume())
        if self._paused != request.data:
            self.get_logger().info('paused' if request.data else 'running')
        self._paused = request.data
        response.success, response.message = True, 'paused' if request.data else 'running'
        return response

    def _on_step(self, _, response):
        if not self._paused:
            response.success = False
            response.message = 'expected a paused node: call ~/set_paused with data: true first'
        elif self._step():
            response.success = True
            response.message = f'at {self.session.steps / self.session.simulation.rate:g} s'
        else:
            response.success, response.message = False, str(self.session.fault)
        return response


def main(arguments=None):
    """Run the node until a signal and return its exit status."""
    with told_to_end() as told:
        return _run(arguments, told)


def _run(arguments, told):
    """Run the node until an event is set and return its exit status."""
    try:
        given = sys.argv if arguments is None else arguments
        # Files first: what finds the arguments of ROS reads them, too, and says less.
        startup.check_files(given)
        if startup.check_arguments(given):
            print(startup.USAGE)
            return 0
        network.never_wait()
        with startup.quiet_stderr():
            rclpy.init(args=arguments, signal_handler_options=SignalHandlerOptions.NO)
        node = BoatNode()
    except Exception as error:
        rclpy.try_shutdown()
        print(startup.one_line(error), file=sys.stderr)
        return 2
    executor = startup.executor()
    executor.add_node(node)
    try:
        while not told.is_set():
            wait = node.tick()
            try:
                executor.spin_once(wait)
            except Exception as error:  # a callback of rclpy's own, as for a malformed request
                node.get_logger().error(f'a request was not understood: {error!r}')
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())
