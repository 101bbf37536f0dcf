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

"""Hosts in a network of their own, each a network namespace of this machine, and links to cut."""

import os
import subprocess

BOAT = 'boat'


def ip(*words, check=True):
    """Run the command ip, of iproute2."""
    return subprocess.run(['ip', *words], check=check, capture_output=True, text=True)


def may_make_namespaces():
    """Return whether this user may make network namespaces and links between them."""
    name = f'boat_buoyancy_{os.getpid()}'
    try:
        ip('netns', 'add', name)
        ip('netns', 'exec', name, 'true')
        ip('-n', name, 'link', 'add', 'one', 'type', 'veth', 'peer', 'name', 'other')
    except (OSError, subprocess.CalledProcessError):
        return False
    finally:
        if os.path.exists(f'/run/netns/{name}'):
            ip('netns', 'del', name, check=False)
    return True


class Network:
    """
    A boat and other hosts, each on a link of its own to the boat.

    ``hosts``, their names; ``queue``, how many packets may wait for a host that does not answer:
    None is what Linux has, about as many as fill a socket.

    Needs the right to make namespaces; OSError or CalledProcessError where there is none.
    """

    def __init__(self, *hosts, queue=None):
        """Make namespaces and links."""
        self._hosts, self._made = hosts, []
        try:
            for host in (BOAT, *hosts):
                ip('netns', 'add', self._space(host))
                self._made.append(host)
                ip('-n', self._space(host), 'link', 'set', 'lo', 'up')
            for i, host in enumerate(hosts):
                ip('-n', self._space(BOAT), 'link', 'add', host, 'type', 'veth',
                   'peer', 'name', 'eth0', 'netns', self._space(host))
                self._connect(BOAT, host, f'10.77.{i}.1/24', default=i == 0)
                self._connect(host, 'eth0', f'10.77.{i}.2/24', default=True)
                if queue is not None:
                    ip('-n', self._space(BOAT), 'ntable', 'change', 'name', 'arp_cache',
                       'dev', host, 'queue', str(queue))
        except Exception:
            self.close()
            raise

    def _space(self, host):
        return f'boat_buoyancy_{os.getpid()}_{host}'

    def _connect(self, host, link, address, default):
        space = self._space(host)
        ip('-n', space, 'link', 'set', link, 'up')
        ip('-n', space, 'addr', 'add', address, 'dev', link)
        if default:
            # Multicast, by which participants find each other, has to go somewhere.
            ip('-n', space, 'route', 'add', 'default', 'dev', link)

    def on(self, host):
        """Return the beginning of a command that runs the rest of it on a host."""
        return ['ip', 'netns', 'exec', self._space(host)]

    def cut(self, host, carrier):
        """Cut the link to a host: it does not answer any more, or the cable is out, too."""
        if carrier:
            ip('-n', self._space(host), 'addr', 'flush', 'dev', 'eth0')
        else:
            ip('-n', self._space(host), 'link', 'set', 'eth0', 'down')

    def forget(self):
        """Let the boat forget where its neighbours are, which Linux does by itself in time."""
        ip('-n', self._space(BOAT), 'neigh', 'flush', 'all')

    def close(self):
        """Take all of it away."""
        for host in self._made:
            ip('netns', 'del', self._space(host), check=False)

    def __enter__(self):
        """Return itself."""
        return self

    def __exit__(self, *_):
        """Take all of it away."""
        self.close()
