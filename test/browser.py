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

"""Debian's Chromium, headless, driven over the WebDriver protocol; it reaches this host only."""

import base64
from contextlib import contextmanager
import json
from pathlib import Path
import re
import shutil
import subprocess
import time
from urllib.error import HTTPError
from urllib.request import Request, urlopen

PROGRAMS = ('chromium', 'chromedriver')
ELEMENT = 'element-6066-11e4-a52e-4f735466cecf'
OPTIONS = ['--headless=new', '--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle',
           '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--window-size=1200,760',
           # No name is found but this host's, and nothing is asked for in the background.
           '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1',
           '--disable-background-networking', '--disable-component-update', '--no-first-run']


def missing():
    """Return the programs that are not installed."""
    return [program for program in PROGRAMS if shutil.which(program) is None]


@contextmanager
def driver():
    """Give the address of a WebDriver that runs meanwhile."""
    process = subprocess.Popen([shutil.which('chromedriver'), '--port=0'], text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    try:
        for line in process.stdout:
            if found := re.search(r'started successfully on port (\d+)', line):
                yield f'http://127.0.0.1:{found[1]}'
                return
        raise RuntimeError('chromedriver ended before it listened')
    finally:
        process.terminate()
        process.wait(10)
        process.stdout.close()


class Browser:
    """A window of a browser of its own, closed by `close`; ``address`` of its WebDriver."""

    def __init__(self, address):
        """Open it."""
        capabilities = {'browserName': 'chrome', 'goog:chromeOptions': {
            'binary': shutil.which('chromium'), 'args': OPTIONS},
            'goog:loggingPrefs': {'browser': 'ALL'}}
        self._session = f'{address}/session'
        opened = self._ask('POST', '', {'capabilities': {'alwaysMatch': capabilities}})
        self._session += '/' + opened['sessionId']
        # An element may be about to come.
        self._ask('POST', '/timeouts', {'implicit': 20_000})

    def _ask(self, method, path, body=None):
        request = Request(self._session + path, method=method, headers={
            'Content-Type': 'application/json'}, data=json.dumps(body or {}).encode()
            if method == 'POST' else None)
        try:
            with urlopen(request, timeout=60) as answer:
                return json.load(answer)['value']
        except HTTPError as error:
            raise RuntimeError(json.load(error)['value']['message']) from None

    def close(self):
        """Close the window and end the browser."""
        self._ask('DELETE', '')

    def visit(self, address):
        """Go to a page."""
        self._ask('POST', '/url', {'url': address})

    def run(self, script, *arguments):
        """Return what a script gives."""
        return self._ask('POST', '/execute/sync', {'script': script, 'args': list(arguments)})

    def ask_cdp(self, command, **parameters):
        """Return what Chromium answers to a command of its DevTools protocol."""
        return self._ask('POST', '/goog/cdp/execute', {'cmd': command, 'params': parameters})

    def picture(self, path):
        """Write what is seen as PNG."""
        Path(path).write_bytes(base64.b64decode(self._ask('GET', '/screenshot')))

    def text(self):
        """Return all text that is shown."""
        return self.run('return document.body.innerText')

    def errors(self):
        """Return what the page complained of."""
        return [entry['message'] for entry in self._ask('POST', '/se/log', {'type': 'browser'})
                if entry['level'] == 'SEVERE']

    def wait_for(self, sought, seconds=20.0):
        """Return the text shown once it has what is sought; AssertionError when it does not."""
        end = time.monotonic() + seconds
        while sought not in (text := self.text()):
            assert time.monotonic() < end, f'{sought!r} is not in {text!r}'
            time.sleep(0.05)
        return text

    def find(self, xpath):
        """Return an element."""
        return self._ask('POST', '/element', {'using': 'xpath', 'value': xpath})[ELEMENT]

    def click(self, xpath):
        """Click on an element."""
        self._ask('POST', f'/element/{self.find(xpath)}/click')

    def write(self, xpath, text):
        """Write over what stands in a field."""
        field = self.find(xpath)
        # Ctrl-A, as clearing by itself is not seen by the page.
        for keys in ('\ue009a\ue000', text):
            self._ask('POST', f'/element/{field}/value', {'text': keys})

    def press(self, key, seconds=0.0):
        """Hold a key down for a while, on the page itself."""
        self._ask('POST', '/actions', {'actions': [{'type': 'key', 'id': 'keyboard', 'actions': [
            {'type': 'keyDown', 'value': key}, {'type': 'pause', 'duration': round(1e3 * seconds)},
            {'type': 'keyUp', 'value': key}]}]})
