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

"""What the pages say, taken apart for the tests that hold them against the code."""

from pathlib import Path
import re

ROOT = Path(__file__).parents[1]
# The text of every page by its path.
PAGES = {path: path.read_text(encoding='utf-8') for path in (
    ROOT / 'README.md', ROOT / 'CONTRIBUTING.md', *sorted((ROOT / 'doc').glob('*.md')))}
README = PAGES[ROOT / 'README.md']
TEXT = '\n'.join(PAGES.values())


def page(name):
    """Return the text of a page of doc/."""
    return PAGES[ROOT / 'doc' / name]


def prose(text):
    """Return a text without its fenced blocks."""
    return re.sub(r'^```.*?^```$', '', text, flags=re.MULTILINE | re.DOTALL)


def headings(text):
    """Return the headings of a text as (level, title)."""
    return [(len(marks), title)
            for marks, title in re.findall(r'^(#+) (.*)$', prose(text), re.MULTILINE)]


def section(title):
    """Return the text under a heading, up to the next of the same or a higher level."""
    text, = (text for text in PAGES.values() if title in dict(map(reversed, headings(text))))
    inside, level, fenced = [], 0, False
    for line in text.splitlines(keepends=True):
        fenced ^= line.startswith('```')
        heading = None if fenced else re.match(r'(#+) (.*)$', line)
        if heading and level and len(heading[1]) <= level:
            break
        if heading and heading[2] == title:
            level = len(heading[1])
        elif level:
            inside.append(line)
    return ''.join(inside)


def table(title):
    """Return the rows of the first table under a heading, cells without backquotes."""
    first = re.search(r'(?:^\|.*\n?)+', section(title), re.MULTILINE)[0]
    rows = [[cell.strip().replace('`', '') for cell in line.strip('|').split('|')]
            for line in first.splitlines()]
    return rows[2:]


def blocks(language, text=TEXT):
    """Return the fenced blocks of a language."""
    return re.findall(rf'^```{language}\n(.*?)^```$', text, re.MULTILINE | re.DOTALL)


def commands():
    """Return every command line of the bash blocks, joined over line ends, without comments."""
    joined = '\n'.join(blocks('bash')).replace('\\\n', ' ')
    lines = [line.partition('  #')[0].strip() for line in joined.splitlines()]
    return [part.strip() for line in lines if line and not line.startswith('#')
            for part in line.split('&&')]
