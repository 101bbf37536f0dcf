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

"""Take doc/view.png, the page of buoyancy_view in Chromium: ``python doc/view_picture.py``."""

from pathlib import Path
import re
import subprocess
import sys
import time

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / 'test'))
import browser  # noqa: E402, I100

CLOSE = '//button[contains(@class, "Notification-closeButton")]'


def main():
    """Push the boat of config/waves.yaml until it has a track, and take the picture."""
    command = [sys.executable, '-m', 'boat_buoyancy.tools.view.main',
               str(ROOT / 'config' / 'waves.yaml'), '--port', '0', '--no-open']
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as program:
        try:
            address = re.search(r'http://\S+', program.stdout.readline())[0]
            with browser.driver() as driver:
                page = browser.Browser(driver)
                page.visit(address)
                page.wait_for('Software WebGL')
                # Chromium tells that it draws without a graphics card.
                page.click(CLOSE)
                # The curtain before the scene rises, and the plots fill.
                time.sleep(45.0)
                page.press('i', 8.0)
                page.press('j', 2.0)
                page.press('i', 1.0)
                page.picture(ROOT / 'doc' / 'view.png')
                page.close()
        finally:
            program.terminate()


if __name__ == '__main__':
    main()
