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

"""A hull's surface from a mesh file: read, checked, and repaired where that is safe."""

from io import BytesIO
from pathlib import Path
import warnings

import numpy as np

from .closed_mesh import containing, edge_counts, filled, oriented, volumes_of_shells, welded
from .surface import Surface
from .. import checks

FORMATS = ('stl', 'obj', 'ply')
MOST_TRIANGLES = 100_000
# Of a mesh's greatest extent: corners nearer than this are one but for the file's round-off.
NEAR = 1e-5
# Of its extent cubed: what encloses less is flat.
FLAT = 1e-12
# Of its breadth squared, the product of what is on either side of the middle plane at least.
HALF = 1e-3
# Few boats are so many times as wide as long, or as high as wide.
WIDE = 1.5
# No boat is shorter or longer, m.
LENGTHS = 0.05, 500.0


def read_mesh(path, scale=1.0):
    """
    Return the `Surface` of a mesh file, and sentences (a tuple) on what was repaired or looks odd.

    ``path`` of a closed mesh: STL (binary or ASCII), OBJ or PLY; ``scale`` metres per unit of the
    file.  Polygons are cut into triangles.  Several shells side by side are fine, and one inside
    another is a cavity when it faces inward.

    Repaired, and said: triangles given twice or without area; gaps of round-off; holes of 3 or 4
    edges; triangles and shells that face the wrong way.  Refused, by a ValueError in one line:
    a file that cannot be read; a mesh that is empty, too fine, open, of one side, without volume,
    or with a shell in another whose volume would count twice.  Not looked for: a shell that passes
    through itself.
    """
    path, scale = Path(path), checks.number('hull.scale', scale, above=0.0)
    said = []
    try:
        corners, triangles = _read(path)
        corners = corners * scale
        corners, triangles = _closed(corners, triangles, said)
        corners, triangles = _outward(corners, triangles, said)
    except ValueError as error:
        raise ValueError(f'hull.mesh: {" ".join(str(path).split())}: {error}') from None
    length = float(np.ptp(corners, axis=0).max())
    if not LENGTHS[0] <= length <= LENGTHS[1]:
        likely = '0.001 for a mesh in mm' if length > LENGTHS[1] else '1 for a mesh in m'
        said.append(f'makes this boat {length:.4g} m long: is hull.scale right ({likely})?')
    (x, y, z), middle = np.ptp(corners, axis=0), corners[:, 1].min() * corners[:, 1].max()
    if y > WIDE * x or z > WIDE * y:
        said.append(f'is {x:.3g} m long (x), {y:.3g} m wide (y) and {z:.3g} m high (z): is it in '
                    'body axes, x ahead, y to port, z up?')
    if middle >= -HALF * y * y:
        said.append('lies all on one side of its middle plane, y = 0: is it half a hull?')
    return Surface(corners, triangles), tuple(f'The mesh {path.name} {what}' for what in said)


def _read(path):
    """Return corners (n, 3) and triangles (m, 3) of a mesh file."""
    kind = path.suffix[1:].lower()
    if kind not in FORMATS:
        raise ValueError(f'expected a file that ends in .{", .".join(FORMATS)}, '
                         f'got {path.suffix or "no ending"}')
    try:
        import trimesh
    except ImportError as error:
        raise ValueError(f'a mesh needs trimesh ({error}): ./install.sh mesh, or '
                         'pip install "boat_buoyancy[mesh]"') from None
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ValueError(f'cannot be read: {error.strerror}') from None
    try:
        with warnings.catch_warnings():
            # NumPy's word for text that is no number and was left out.
            warnings.filterwarnings('error', 'string or file could not be read')
            # Of a stream nothing beside it is opened: no materials, no textures.
            loaded = trimesh.load(BytesIO(_readable(content, kind)), file_type=kind,
                                  process=False, skip_materials=True)
        meshes = [mesh for mesh in getattr(loaded, 'geometry', {'': loaded}).values()
                  if len(getattr(mesh, 'faces', ()))]
    except Exception as error:
        # Whatever a damaged file makes a reader do.
        reason = ' '.join(str(error).split())[:200] or type(error).__name__
        raise ValueError(f'cannot be read as {kind.upper()}: {reason}') from None
    if not meshes:
        raise ValueError('has no triangles or is damaged: expected a closed mesh in '
                         f'{kind.upper()} format')
    firsts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    corners = np.concatenate([np.array(mesh.vertices, float) for mesh in meshes])
    triangles = np.concatenate([np.array(mesh.faces, np.int64) + first
                                for mesh, first in zip(meshes, firsts)])
    if len(triangles) > MOST_TRIANGLES:
        raise ValueError(f'has {len(triangles)} triangles, at most {MOST_TRIANGLES} are taken: '
                         'simplify it (a few hundred are enough for most hulls)')
    if triangles.min() < 0 or triangles.max() >= len(corners):
        raise ValueError(f'refers to a corner that is not there: it has {len(corners)}')
    return corners, triangles


def _readable(content, kind):
    """Return the bytes of a file with text made UTF-8: names in it may be anything."""
    number = int.from_bytes(content[80:84], 'little')
    binary = kind == 'ply' or (kind == 'stl' and len(content) == 84 + 50 * number)
    return content if binary else content.decode('utf-8', 'replace').encode()


def _closed(corners, triangles, said):
    """Return corners and triangles whose every edge belongs to two triangles."""
    wrong = ~np.isfinite(corners[triangles]).all(axis=(1, 2))
    if wrong.any():
        raise ValueError(f'has {wrong.sum()} of {len(wrong)} triangles with a corner that is not '
                         'finite: export it again')
    given = len(triangles)
    corners, triangles = welded(corners, triangles)
    if len(triangles) < given:
        said.append(f'had {given - len(triangles)} of {given} triangles without area or given '
                    'twice; they were left out.')
    if not len(triangles):
        raise ValueError('encloses no volume: all its triangles are without area')
    gaps, crowded = edge_counts(triangles)
    if gaps:
        near = NEAR * np.ptp(corners, axis=0).max()
        joined = welded(corners, triangles, near)
        if len(joined[1]) and edge_counts(joined[1]) == (0, 0):
            said.append(f'had {gaps} open edges; they were closed by joining corners nearer than '
                        f'{near:.1g} m.')
            return joined
        more = filled(triangles)
        if edge_counts(more) == (0, 0):
            added = len(more) - len(triangles)
            said.append(f'had {gaps} open edges; the holes were closed with {added} '
                        f'triangle{"" if added == 1 else "s"}.')
            return corners, more
        raise ValueError(f'is open: {gaps} edges belong to one triangle only; close its holes, or '
                         'make a solid of it')
    if crowded:
        raise ValueError(f'has {crowded} edges shared by more than two triangles: take out walls '
                         'inside it, and join parts that touch into one solid')
    return corners, triangles


def _outward(corners, triangles, said):
    """Return corners and triangles of shells that face outward, and cavities inward."""
    agreed = oriented(triangles)
    if agreed is None:
        raise ValueError('has one side only, as a Moebius strip has: it encloses nothing')
    triangles, shell, turned = agreed
    if turned:
        said.append(f'had {turned} of {len(triangles)} triangles that faced the other way than '
                    'their neighbours; they were turned.')
    volumes = volumes_of_shells(corners, triangles, shell)
    flat = np.abs(volumes) <= FLAT * np.ptp(corners, axis=0).max() ** 3
    if flat.all():
        raise ValueError(f'encloses no volume: {np.abs(volumes).sum():.2g} m^3 in '
                         f'{len(triangles)} triangles')
    if flat.any():
        said.append(f'had {flat.sum()} of {len(flat)} parts that are flat; they were left out.')
        shell, triangles = shell[~flat[shell]], triangles[~flat[shell]]
    outward = np.sign(volumes)
    if volumes.sum() < 0.0:
        said.append('was inside out and has been turned.')
        outward = -outward
    doubled, overlapping, inverted = [], [], []
    for number in np.argsort(-np.abs(volumes), kind='stable')[:len(volumes) - flat.sum()]:
        around = dict(containing(corners, triangles, shell, number))
        depth = sum(outward[other] for other, share in around.items() if share == 1.0)
        overlapping += [number] if any(share < 1.0 for share in around.values()) else []
        if depth <= 0 and outward[number] < 0:
            inverted.append(number)
            outward[number] = 1.0
        elif depth > 0 and outward[number] > 0:
            doubled.append(number)
    if doubled:
        raise ValueError(f'has {len(doubled)} of {len(volumes)} shells inside another and facing '
                         'outward, so that their volume would count twice: delete them, or turn '
                         'them inward for a cavity')
    if inverted:
        said.append(f'had {len(inverted)} of {len(volumes)} shells inside out; they were turned.')
    if overlapping:
        said.append(f'has {len(overlapping)} of {len(volumes)} shells that overlap another: what '
                    'they share counts twice; join them into one solid.')
    change = (outward * np.sign(volumes))[shell] < 0.0
    triangles = np.where(change[:, None], triangles[:, ::-1], triangles)
    used, triangles = np.unique(triangles, return_inverse=True)
    return corners[used], triangles.reshape(-1, 3)
