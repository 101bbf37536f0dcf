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

"""The page of buoyancy_view in a real browser that reaches this host only."""

from contextlib import contextmanager
from pathlib import Path
import re
import socket
import subprocess
import sys
import threading
import time

from boat_buoyancy.physics import load_scene
from boat_buoyancy.tools.report import figures
from boat_buoyancy.tools.view.live_boat import LiveBoat
from boat_buoyancy.tools.view.loop import Loop
import browser
import pytest

pytestmark = pytest.mark.browser

CONFIG = Path(__file__).parents[1] / 'config'
PROGRAM = [sys.executable, '-m', 'boat_buoyancy.tools.view.main']
PARTS = ('position', 'orientation', 'velocity', 'angular_velocity')
# The field beside a slider, found by its label.
FIELD = '//label[text()="{}"]/following::input[not(@type="hidden")][1]'

VALUE = 'return document.evaluate(arguments[0], document).iterateNext().value'


@contextmanager
def program(scene, *words):
    """Give address and process of the program while it runs."""
    process = subprocess.Popen([*PROGRAM, str(CONFIG / scene), '--port', '0', '--no-open', *words],
                               stdout=subprocess.PIPE, text=True)
    try:
        yield re.search(r'http://\S+', process.stdout.readline())[0], process
    finally:
        process.terminate()
        assert process.wait(20) == 0
        process.stdout.close()


@pytest.fixture(scope='session')
def driver():
    if missing := browser.missing():
        pytest.fail(f'{" and ".join(missing)} missing: apt install chromium chromium-driver')
    with browser.driver() as address:
        yield address


@pytest.fixture
def window(driver):
    """Return a function that opens windows, which are closed afterwards."""
    opened = []

    def open_one(address):
        opened.append(browser.Browser(driver))
        opened[-1].visit(address)
        return opened[-1]

    yield open_one
    for one in opened:
        one.close()


@pytest.fixture
def default():
    with program('default.yaml') as (address, _):
        yield address


def tab(one, name):
    one.click(f'//*[@role="tab"][normalize-space()="{name}"]')


def turn(one, label, value):
    """Write a number beside a slider."""
    one.write(FIELD.format(label), f'{value}\ue007')


def set_value(one, text):
    """Write a value on the tab of all parameters, and have it set."""
    one.write(FIELD.format('value'), text)
    # A page sends what is typed now and then, and a person's hand goes to the mouse meanwhile.
    time.sleep(1.0)
    one.click('//button[normalize-space()="Set"]')


def draft_of(values):
    return f'draft {figures(load_scene(values))["draft_m"]:.3g} m'


def test_the_page_comes_up_and_asks_no_other_host(default, window, record_property):
    one = window('about:blank')
    began = time.monotonic()
    one.visit(default)
    one.wait_for(draft_of({}), 30.0)
    # On a quiet machine less than 5 s.
    record_property('seconds until the page is there', time.monotonic() - began)
    for words in ('scene', 'pause', 'Save as YAML', 'mass (kg)', 'damping ratio', 'heave (m)'):
        assert words in one.text()
    asked = one.run('return performance.getEntriesByType("resource").map(entry => entry.name)')
    assert [place for place in asked if not place.startswith((default, 'data:', 'blob:'))] == []
    assert one.errors() == []


def test_a_slider_moves_the_draft_to_where_the_report_says(default, window):
    one = window(default)
    one.wait_for('mass (kg)')
    turn(one, 'mass (kg)', 3000)
    # m / (rho L B).
    assert draft_of({'boat.mass': 3000.0}) == f'draft {3000.0 / (1025.0 * 8.0):.3g} m'
    one.wait_for(draft_of({'boat.mass': 3000.0}))


def test_a_boat_is_trimmed_by_the_bow_and_capsized_with_the_page_alone(default, window):
    one = window(default)
    one.wait_for('let down')
    # 2 % of 4 m each time.
    for wanted in ('0.08', '0.16', '0.24'):
        one.click('//button[normalize-space()="bow"]')
        clicked = began = time.monotonic()
        while one.run(VALUE, FIELD.format('center of mass x (m)')) != wanted:
            assert time.monotonic() < began + 30.0
            time.sleep(0.1)
            # As a person does, whose click met a page that was just being drawn.
            if time.monotonic() > clicked + 5.0:
                one.click('//button[normalize-space()="bow"]')
                clicked = time.monotonic()
    turn(one, 'center of mass z (m)', 1.5)
    one.wait_for('warning')
    tab(one, 'Warnings')
    one.wait_for(load_scene({'boat.center_of_mass': [0.24, 0.0, 1.5]}).warnings[0])


def test_an_illegal_value_is_refused_with_the_sentence_of_the_node(default, window):
    one = window(default)
    one.wait_for('Save as YAML')
    tab(one, 'All')
    one.wait_for('parameter')
    with pytest.raises(ValueError) as refusal:
        load_scene({'boat.mass': -5})
    set_value(one, '-5')
    one.wait_for(str(refusal.value))
    set_value(one, '2500')
    text = one.wait_for(draft_of({'boat.mass': 2500.0}))
    assert str(refusal.value) not in text
    # The field follows what another knob, or another page, sets.
    another = window(default)
    another.wait_for('mass (kg)')
    turn(another, 'mass (kg)', 3000)
    end = time.monotonic() + 20.0
    while one.run(VALUE, FIELD.format('value')) != '3000.0':
        assert time.monotonic() < end
        time.sleep(0.1)


def test_a_saved_scene_is_read_as_the_same_boat(default, window, tmp_path):
    one = window(default)
    one.ask_cdp('Browser.setDownloadBehavior', behavior='allow', downloadPath=str(tmp_path))
    one.wait_for('mass (kg)')
    turn(one, 'mass (kg)', 3000)
    one.wait_for(draft_of({'boat.mass': 3000.0}))
    tab(one, 'Sea')
    one.wait_for('sea state')
    turn(one, 'sea state', 3)
    time.sleep(2.0)
    one.click('//button[normalize-space()="Save as YAML"]')
    path, end = tmp_path / 'default_tuned.yaml', time.monotonic() + 20.0
    while not path.exists():
        assert time.monotonic() < end
        time.sleep(0.1)
    assert load_scene(path).values == load_scene(
        {'boat.mass': 3000.0, 'sea.sea_state': 3}).values


def test_two_pages_show_the_same_and_one_that_comes_back_shows_how_things_are(default, window):
    first, second = window(default), window(default)
    for one in (first, second):
        one.wait_for(draft_of({}))
    turn(first, 'mass (kg)', 3000)
    second.wait_for(draft_of({'boat.mass': 3000.0}))
    first.visit('about:blank')
    turn(second, 'mass (kg)', 2500)
    second.wait_for(draft_of({'boat.mass': 2500.0}))
    first.visit(default)
    first.wait_for(draft_of({'boat.mass': 2500.0}))


def test_keys_push_and_the_menu_leads_through_the_steps_of_the_idea(window):
    loop = Loop(LiveBoat(CONFIG / 'v4_tuned.yaml'), {
        path.stem: path for path in sorted(CONFIG.glob('v?_*.yaml'))})
    with shown(loop) as address:
        one = window(address)
        one.wait_for('Save as YAML')
        one.press('i', 2.0)
        end = time.monotonic() + 20.0
        while loop.snapshot.position[0] <= 0.0:
            assert time.monotonic() < end
            time.sleep(0.05)
        for name in ('v0_single_probe', 'v3_probe_damping'):
            one.click('//input[@value="' + loop.name + '"]')
            one.click(f'//*[@role="option"][normalize-space()="{name}"]')
            end = time.monotonic() + 20.0
            while loop.name != name:
                assert time.monotonic() < end
                time.sleep(0.05)


@contextmanager
def shown(loop):
    """Give the address of the page of a loop while it runs in this process."""
    from boat_buoyancy.tools.view.page import Page
    from boat_buoyancy.tools.view.stage import in_turn, served
    ending = threading.Event()
    with served('127.0.0.1', 0) as server:
        page = in_turn(server, Page, server, loop)

        def show():
            while not ending.wait(0.05):
                in_turn(server, page.show)

        showing = threading.Thread(target=show)
        loop.start()
        showing.start()
        try:
            yield f'http://127.0.0.1:{server.get_port()}'
        finally:
            ending.set()
            showing.join()
            loop.stop()
            assert loop.ended.result() is None


def test_a_boat_that_is_looked_at_moves_bitwise_as_the_simulation_alone(window):
    loop = Loop(LiveBoat(CONFIG / 'waves.yaml'))
    with shown(loop) as address:
        window(address).wait_for('damping ratio')
        time.sleep(3.0)
        loop.pause(True)
        alone = load_scene(CONFIG / 'waves.yaml').simulation()
        for _ in range(loop.boat.session.steps):
            alone.step()
        assert alone.steps > 300
        for part in PARTS:
            assert (getattr(loop.boat.session.simulation.state, part).tolist()
                    == getattr(alone.state, part).tolist())


def test_the_knobs_are_made_anew_when_a_parameter_has_fewer_numbers_by_now(window):
    loop = Loop(LiveBoat(CONFIG / 'default.yaml'))
    with shown(loop) as address:
        loop.tune({'damping.probe': [100.0, 100.0, 200.0]})
        one = window(address)
        one.wait_for('let down')
        tab(one, 'Damping')
        one.wait_for('damping probe x (N·s/m)')
        loop.tune({'damping.probe': [100.0]})
        # Made anew, they begin with the first tab again.
        one.wait_for('let down')
        tab(one, 'Damping')
        one.wait_for('damping probe (N·s/m)')


def test_physics_waits_for_no_browser_that_stands_still(driver):
    viser = pytest.importorskip('viser')
    loop = Loop(LiveBoat(CONFIG / 'waves.yaml'))
    with shown(loop) as address:
        port = int(address.rpartition(':')[2])
        with socket.create_connection(('127.0.0.1', port)) as silent:
            silent.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            silent.sendall(b'GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\n'
                           b'Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n'
                           b'Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n'
                           b'Sec-WebSocket-Protocol: viser-v' + viser.__version__.encode()
                           + b'\r\n\r\n')
            assert silent.recv(12) == b'HTTP/1.1 101'
            before, began = loop.boat.session.steps, time.monotonic()
            time.sleep(4.0)
            done, passed = loop.boat.session.steps - before, time.monotonic() - began
            # All that were due but for those of the last second, which are caught up.
            assert done >= 100.0 * (passed - 1.0)


def test_it_listens_on_this_host_only(default):
    port = int(default.rpartition(':')[2])
    socket.create_connection(('127.0.0.1', port)).close()
    # Another address, of this host too.
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(('127.0.0.2', port))
    listening = [line.split()[1] for line in Path('/proc/net/tcp').read_text().splitlines()[1:]
                 if line.split()[3] == '0A']
    assert [place for place in listening if place.endswith(f':{port:04X}')] == [
        f'0100007F:{port:04X}']


@pytest.mark.long
def test_ten_minutes_of_a_page_leave_nothing_behind_and_take_half_a_core(window):
    with program('waves.yaml') as (address, process):
        one = window(address)
        one.wait_for('damping ratio')
        time.sleep(60.0)
        memory, spent, began = used(process), processor(process), time.monotonic()
        time.sleep(600.0)
        assert processor(process) - spent < 0.5 * (time.monotonic() - began)
        # Kept by design: a track of 240 points and 600 moments, both full after two minutes.
        assert used(process) - memory < 10e6
        assert one.errors() == []


def used(process):
    """Return the memory in bytes that a process holds."""
    return 1024 * int(re.search(r'VmRSS:\s+(\d+)',
                                Path(f'/proc/{process.pid}/status').read_text())[1])


def processor(process):
    """Return the processor time in s that a process took."""
    fields = Path(f'/proc/{process.pid}/stat').read_text().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / 100.0
