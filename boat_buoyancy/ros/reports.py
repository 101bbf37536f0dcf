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
What the node says of itself: log, status line, /diagnostics once a second.

It looks and speaks; it changes nothing.
"""

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from . import figures, network, qos
from .complaints import Complaints, Throttle
from .messages import Frame, set_stamp
from .neighbours import Neighbours

DIAGNOSTICS_PERIOD = 1.0  # s
# What steps are lost to, and what to do.
SLOW = {
    'stepping': 'Stepping is slow: lower rate or substeps, use fewer probes or waves, or a faster '
                'machine',
    'publishing': 'Publishing is slow, as to a host that does not answer any more: give UDPv4 '
                  '<non_blocking_send>true</non_blocking_send> in the Fast DDS profile, as '
                  f'{network.PROFILE.name} of this package has it',
    'machine': 'Neither stepping nor publishing is slow: the machine is too busy, stood still, or '
               'the clock went ahead'}


class Reports:
    """
    The reports of a node.

    Main arguments: ``node``; ``session``; ``now`` s on the steady clock.  Public: ``complaints``,
    where refused messages are counted and said.
    """

    def __init__(self, node, session, now):
        """Create the publisher and begin to count."""
        self._node, self._session, self._log = node, session, node.get_logger()
        self.complaints, self._neighbours = Complaints(self._log.warning), Neighbours(node)
        self._refused, self._wrong_before = 0, set()
        rate = session.simulation.rate
        self._meter, self._status_meter = figures.Meter(rate, now), figures.Meter(rate, now)
        self._publisher = node.create_publisher(DiagnosticArray, '/diagnostics', qos.OUTPUT)
        self._status = DiagnosticStatus(
            # Aggregators tell statuses apart by their names alone.
            name=f'{node.get_fully_qualified_name().lstrip("/")}: motion',
            hardware_id=node.get_fully_qualified_name())
        self._next_diagnostics = now + DIAGNOSTICS_PERIOD
        self._status_period = session.scene.values['status_period']
        self._next_status = now + self._status_period
        self._drops_said, self._unsaid_drops = None, 0
        self._said, self._stepping = set(), ()

    def command(self, topic, act):
        """Return a callback as `Complaints` do, for a topic that only one may publish on."""
        return self._neighbours.watched(topic, self.complaints.guarded(topic, act))

    def loaded(self):
        """Say what was loaded and what the boat will do, and what is wrong with it."""
        scene, simulation = self._session.scene, self._session.simulation
        self._log.info(figures.loaded(scene, simulation) + '; '
                       + figures.heading_and_speed(Frame(self._session)))
        self.warnings(scene, scene.plan())

    def warnings(self, scene, plan=None):
        """Say the warnings of a scene, and of its `Plan` if that is new, not said before."""
        if plan is not None:
            self._stepping = plan.warnings
        sentences = (*scene.warnings, *self._stepping)
        for sentence in sentences:
            if sentence not in self._said:
                self._log.warning(sentence)
        self._said = set(sentences)

    def stepped(self, stepping, publishing):
        """Count a step that took so many s, and its publications."""
        self._meter.step(stepping, publishing)
        self._status_meter.step(stepping, publishing)

    def stopped(self):
        """Say that the motion has a fault."""
        self._log.error(f'the motion was stopped: {self._session.fault}; call ~/reset to go on')

    def dropped(self, steps, lost_to_boat, now):
        """Count steps given up, and say so once in a while; see `drive` for who loses them."""
        self._meter.drop(steps)
        self._unsaid_drops += steps
        if self._drops_said is not None and now - self._drops_said < Throttle.PERIOD:
            return
        pace = self._session.simulation.rate
        seconds = self._unsaid_drops / pace
        lost = ('the boat stood still in them, stamps and sea went on' if lost_to_boat
                else 'simulated time went slower than asked')
        pace *= self._session.scene.values['time_factor'] or 1.0
        slow = SLOW[self._meter.slow(steps / pace, pace)]
        self._log.warning(
            f'fell behind: {self._unsaid_drops} steps ({seconds:.2f} s) dropped, {lost}. {slow}')
        self._drops_said, self._unsaid_drops = now, 0

    def look(self, paused, now):
        """Publish diagnostics and say the status line when it is time; return True if it was."""
        if self._status_period and now >= self._next_status:
            self._next_status = max(now, self._next_status + self._status_period)
            session, held = self._session, self._status_meter.look(now)
            self._log.info(figures.status_line(
                Frame(session), session.steps / session.simulation.rate, held.real_time_factor,
                paused))
        if now < self._next_diagnostics:
            return False
        self._next_diagnostics = max(now, self._next_diagnostics + DIAGNOSTICS_PERIOD)
        self._diagnose(paused, now)
        return True

    def _diagnose(self, paused, now):
        held, refused = self._meter.look(now), self.complaints.total - self._refused
        self._refused += refused
        wrong = self._neighbours.look(now)
        for subject, sentence in wrong.items():
            if subject not in self._wrong_before:
                self._log.warning(sentence)
        self._wrong_before = set(wrong)
        warnings = [*wrong.values()]
        if refused:
            warnings.append(f'{refused} messages refused, the last: {self.complaints.last}')
        if held.dropped:
            warnings.append(f'{held.dropped} steps dropped')
        level, message = DiagnosticStatus.OK, 'paused' if paused else 'moving'
        if warnings:
            level, message = DiagnosticStatus.WARN, '; '.join(warnings)
        if self._session.fault:
            level, message = DiagnosticStatus.ERROR, self._session.fault
        values = figures.values(self._session, self._meter, held, self.complaints)
        self._status.level, self._status.message = level, message
        self._status.values = [KeyValue(key=key, value=value) for key, value in values.items()]
        array = DiagnosticArray(status=[self._status])
        # Where the node is the source of time, its own; its clock object knows only others'.
        own = self._session.scene.values['publish_clock']
        set_stamp(array.header.stamp,
                  self._session.stamp if own else self._node.get_clock().now().nanoseconds)
        self._publisher.publish(array)
