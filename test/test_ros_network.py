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
A network that drops: remote hosts in network namespaces, and links that are cut.

Without the right to make namespaces only what needs none is tested (see conftest).
"""

import ast
import os
import signal
import subprocess
import sys
import time

from boat_buoyancy.ros import figures, network
from network import BOAT, Network
import pytest
from ros_probe import BoatProcess, ROOT

RATE = 100.0
SUBNET = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'SUBNET'}

# With so many packets a host that does not answer fills the socket for certain.
FILLING = 10_000

# Listens to a boat on some host, and says with each second of diagnostics what they say, and
# how many poses came.
LISTENER = """
import sys
from diagnostic_msgs.msg import DiagnosticArray
from ros_probe import nanoseconds, Probe
with Probe(sys.argv[1], sys.argv[2]) as one:
    poses, seen = one.listen_to_boat()[0], one.listen(DiagnosticArray, '/diagnostics')
    one.until(lambda: poses and seen, timeout=30.0)
    print('there', flush=True)
    while True:
        seen.clear()
        one.until(lambda: seen, timeout=1e6)
        values = {item.key: item.value for item in seen[-1].status[0].values}
        print(nanoseconds(seen[-1].header.stamp) / 1e9, values['steps'], len(poses), flush=True)
"""


class Voyage:
    """A boat and listeners on its own host and two others."""

    def __init__(self, environment, queue=None):
        """Start all and wait until they hear the boat."""
        self.net, self._listeners = Network('near', 'far', queue=queue), {}
        self.boat = None
        try:
            self.boat = BoatProcess({'status_period': 0.0}, namespace='/at_sea',
                                    prefix=self.net.on(BOAT),
                                    environment={**SUBNET, **environment})
            for host in (BOAT, 'near', 'far'):
                self._listeners[host] = subprocess.Popen(
                    [*self.net.on(host), sys.executable, '-c', LISTENER, '/at_sea', host],
                    cwd=os.path.dirname(__file__), stdout=subprocess.PIPE, text=True,
                    env={**os.environ, **SUBNET})
            for listener in self._listeners.values():
                assert listener.stdout.readline() == 'there\n'
        except Exception:
            self.close()
            raise

    def look(self, host):
        """
        Return stamp in s and steps of the next diagnostics, and how many poses have come.

        As the listener on a host has them.
        """
        now, stamp = time.time(), 0.0
        while stamp < now:
            stamp, steps, poses = self._listeners[host].stdout.readline().split()
            stamp = float(stamp)
        return stamp, int(steps), int(poses)

    def close(self):
        """End all."""
        for listener in self._listeners.values():
            listener.kill()
            listener.wait()
            listener.stdout.close()
        if self.boat is not None:
            self.boat.close()
        self.net.close()

    def __enter__(self):
        """Return itself."""
        return self

    def __exit__(self, *_):
        """End all."""
        self.close()


def rates(voyage, host, seconds):
    """Return steps and poses per second on a host over at least so many seconds from now on."""
    began, steps, poses = voyage.look(host)
    while True:
        now, more_steps, more_poses = voyage.look(host)
        if (lasted := now - began) > seconds:
            return (more_steps - steps) / lasted, (more_poses - poses) / lasted


@pytest.mark.namespaces
@pytest.mark.parametrize('hosts', [('far',), ('near', 'far')], ids='-'.join)
@pytest.mark.parametrize('carrier', [True, False])
@pytest.mark.parametrize(('seconds', 'queue'), [
    (5.0, None), (5.0, FILLING), pytest.param(20.0, None, marks=pytest.mark.long),
    pytest.param(65.0, None, marks=pytest.mark.long)])
def test_the_rate_is_held_while_links_to_other_hosts_are_cut(carrier, hosts, seconds, queue):
    left = 'near' if 'near' not in hosts else BOAT
    with Voyage({}, queue) as voyage:
        voyage.look(left)
        for host in hosts:
            voyage.net.cut(host, carrier)
        if seconds < 10.0:
            # What Linux does by itself within 45 s.
            voyage.net.forget()
        stepped, heard = rates(voyage, left, seconds)
        assert stepped == pytest.approx(RATE, rel=0.01)
        assert 'fell behind' not in voyage.boat.log
        # And the host that is left hears it as before, but where nothing can help: a full socket.
        assert queue or heard == pytest.approx(RATE, rel=0.02)


@pytest.mark.namespaces
def test_with_sends_that_wait_the_node_stands_still_and_names_publishing():
    with Voyage({'FASTDDS_BUILTIN_TRANSPORTS': 'DEFAULT'}, FILLING) as voyage:
        voyage.look('near')
        voyage.net.cut('far', carrier=False)
        voyage.net.forget()
        line = voyage.boat.wait_for_log('fell behind')
        assert 'Publishing is slow' in line and '<non_blocking_send>true' in line


ONE_SEA = """
import sys
from diagnostic_msgs.msg import DiagnosticArray
from ros_probe import Probe
from boat_buoyancy.ros.figures import SEA
with Probe('/watch') as one:
    seen, seas = one.listen(DiagnosticArray, '/diagnostics'), {}
    def both():
        for status in (status for message in seen for status in message.status):
            seas[status.hardware_id] = next(
                item.value for item in status.values if item.key == SEA)
        return len(seas) == 2
    one.until(both, timeout=60.0)
    print(*sorted(seas.items()), sep=chr(10))
"""


@pytest.mark.namespaces
def test_two_hosts_start_their_boats_in_one_sea():
    program = [sys.executable, str(ROOT / 'examples' / 'one_sea.py')]
    environment = {**os.environ, **SUBNET, 'PYTHONPATH': os.pathsep.join(sys.path)}
    with Network('far') as net:
        boats = [subprocess.Popen([*net.on(host), *program, boat], env=environment,
                                  stderr=subprocess.PIPE, text=True)
                 for host, boat in ((BOAT, 'red'), ('far', 'blue'))]
        try:
            # As each of the two hosts has it.
            for host in (BOAT, 'far'):
                heard = subprocess.run([*net.on(host), sys.executable, '-c', ONE_SEA],
                                       cwd=ROOT / 'test', env=environment, text=True,
                                       capture_output=True, timeout=90.0)
                blue, red = map(ast.literal_eval, heard.stdout.splitlines())
                assert (red[0], blue[0]) == ('/red/boat_buoyancy', '/blue/boat_buoyancy')
                assert red[1] == blue[1] and red[1]
            for boat in boats:
                boat.send_signal(signal.SIGINT)
                assert boat.wait(10.0) == 0
        finally:
            for boat in boats:
                boat.kill()
                boat.communicate()


def test_a_boat_that_is_not_known_is_one_line():
    for words, got in (([], 'none'), (['green'], 'green')):
        done = subprocess.run([sys.executable, str(ROOT / 'examples' / 'one_sea.py'), *words],
                              capture_output=True, text=True)
        assert (done.returncode, done.stderr) == (
            2, f'one_sea: expected the name of a boat, red or blue, got {got}\n')


def test_our_profile_is_for_those_who_have_chosen_nothing(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for given in ({}, {'RMW_IMPLEMENTATION': 'rmw_fastrtps_cpp'}, SUBNET):
        environment = dict(given)
        network.never_wait(environment)
        assert environment == {**given, network.VARIABLE: str(network.PROFILE)}
    assert 'non_blocking_send>true' in network.PROFILE.read_text()
    for given in ({network.VARIABLE: 'mine.xml'}, {'FASTDDS_DEFAULT_PROFILES_FILE': 'mine.xml'},
                  {'FASTDDS_BUILTIN_TRANSPORTS': 'UDPv4'}, {'ROS_LOCALHOST_ONLY': '1'},
                  {'RMW_IMPLEMENTATION': 'rmw_cyclonedds_cpp'},
                  {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}):
        environment = dict(given)
        network.never_wait(environment)
        assert environment == given
    (tmp_path / network.LOCAL_PROFILE).write_text('')
    environment = {}
    network.never_wait(environment)
    assert environment == {}


def test_what_is_slow_is_named_by_how_long_it_took():
    meter = figures.Meter(RATE, 0.0)
    for _ in range(50):
        meter.step(1e-4, 2e-4)
    # Neither takes half of 10 ms.
    assert meter.slow(2.7, RATE) == 'machine'
    meter.step(1e-4, 2.7)
    assert meter.slow(2.7, RATE) == 'publishing'
    meter.look(1.0)
    for _ in range(50):
        meter.step(9e-3, 2e-4)
    assert meter.slow(1.0, RATE) == 'stepping'
    # Five times as fast, a fifth of the time is what there is.
    meter.look(2.0)
    for _ in range(50):
        meter.step(2e-4, 1.5e-3)
    assert meter.slow(1.0, RATE) == 'machine' and meter.slow(1.0, 5 * RATE) == 'publishing'
