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

"""Hulls from mesh files: each is read, repaired and said to be, or refused in one line."""

from pathlib import Path
import subprocess
import sys

from boat_buoyancy.physics.boat.mesh import read_mesh
from boat_buoyancy.physics.boat.surface import box_surface, joined, Surface
import numpy as np
from programs import WITHOUT
import pytest

trimesh = pytest.importorskip('trimesh')
pytestmark = pytest.mark.plain

BOX = box_surface((4.0, 2.0, 1.0), (0.5, 0.0, 0.25))
STL = np.dtype([('normal', '<f4', 3), ('corners', '<f4', (3, 3)), ('more', '<u2')])
QUADS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def ball(halvings=2):
    """Return the `Surface` of a finely cut icosahedron of radius 1."""
    mesh = trimesh.creation.icosphere(halvings)
    return Surface(mesh.vertices, mesh.faces)


def turned(surface, which=slice(None)):
    """Return a surface with some of its triangles facing the other way."""
    triangles = surface.triangles.copy()
    triangles[which] = triangles[which, ::-1]
    return Surface(surface.corners, triangles)


def beside(surface, *shift):
    """Return a surface moved by (3,) m."""
    return Surface(surface.corners + shift, surface.triangles)


def binary_stl(surface):
    """Return the bytes of a binary STL file, which shares no corners."""
    records = np.zeros(len(surface.triangles), STL)
    records['corners'] = surface.facets
    return b'any words'.ljust(80) + np.uint32(len(records)).tobytes() + records.tobytes()


def ascii_stl(surface):
    """Return the bytes of an ASCII STL file."""
    facets = ''.join(
        'facet normal 0 0 0\nouter loop\n' + ''.join('vertex {!r} {!r} {!r}\n'.format(
            *corner) for corner in facet) + 'endloop\nendfacet\n'
        for facet in surface.facets.tolist())
    return f'solid Schlauchboot für zwei\n{facets}endsolid\n'.encode('latin-1')


def obj(surface, faces=None):
    """Return the bytes of an OBJ file."""
    faces = surface.triangles.tolist() if faces is None else faces
    return (''.join('v {!r} {!r} {!r}\n'.format(*corner) for corner in surface.corners.tolist())
            + ''.join('f ' + ' '.join(str(i + 1) for i in face) + '\n' for face in faces)).encode()


def ply(surface, encoding):
    """Return the bytes of a PLY file, ``encoding`` 'ascii' or 'binary'."""
    return trimesh.Trimesh(surface.corners, surface.triangles, process=False).export(
        file_type='ply', encoding=encoding)


@pytest.fixture
def read(tmp_path):
    """Return a function that writes a file and reads it as a mesh."""
    def written(content, name='boat.stl', scale=1.0):
        path = tmp_path / name
        path.write_bytes(content)
        return read_mesh(path, scale)

    return written


def same(found, expected):
    """Return whether two surfaces have the same triangles, in any order, to a file's precision."""
    def rows(surface):
        facets = surface.facets.astype(np.float32).reshape(-1, 3, 3)
        first = [np.lexsort(facet.T[::-1])[0] for facet in facets]
        facets = np.stack([np.roll(facet, -i, axis=0) for facet, i in zip(facets, first)])
        return facets.reshape(-1, 9)[np.lexsort(facets.reshape(-1, 9).T)]

    return len(found.triangles) == len(expected.triangles) and np.allclose(
        rows(found), rows(expected), atol=1e-6)


@pytest.mark.parametrize('name, content', [
    ('boat.stl', binary_stl(BOX)), ('BOAT.STL', binary_stl(BOX)), ('boat.stl', ascii_stl(BOX)),
    ('boat.obj', obj(BOX)), ('boat.ply', ply(BOX, 'ascii')), ('boat.ply', ply(BOX, 'binary'))])
def test_every_format_gives_the_surface_with_shared_corners(read, name, content):
    surface, remarks = read(content, name)
    assert same(surface, BOX) and len(surface.corners) == 8 and remarks == ()


@pytest.mark.parametrize('words', ['', 'o hull\ng side\nusemtl red\n', 'vt 0 0\nvn 0 0 1\n'])
def test_quads_of_several_groups_are_one_hull(read, words):
    content = obj(BOX, QUADS[:3]).decode() + words + obj(BOX, QUADS[3:]).decode().partition(
        'f ')[1] + obj(BOX, QUADS[3:]).decode().partition('f ')[2]
    surface, remarks = read(content.encode(), 'boat.obj')
    assert len(surface.triangles) == 12 and remarks == ()
    assert surface.volume == pytest.approx(8.0)
    np.testing.assert_allclose(surface.center, [0.5, 0.0, 0.25], atol=1e-12)


def test_several_objects_are_one_surface_and_corners_that_no_triangle_has_are_dropped(read):
    twin = joined([beside(BOX, 0.0, y, 0.0) for y in (-3.0, 3.0)])
    content = obj(twin) + b'v 100 100 100\n'
    surface, remarks = read(content.replace(b'f 9', b'o other\nf 9', 1), 'boat.obj')
    assert same(surface, twin) and len(surface.corners) == 16
    assert all('is it in body axes' in remark for remark in remarks)


@pytest.mark.parametrize('surface', [
    ball(), joined([ball(), beside(ball(1), 0.0, 3.0, 0.0)]),
    joined([BOX, turned(beside(box_surface((1.0, 1.0, 0.5)), 0.5, 0.0, 0.25))])])
def test_balls_several_shells_and_cavities_are_taken_as_they_are(read, surface):
    found, remarks = read(binary_stl(surface))
    assert same(found, surface) and all('is it in body axes' in remark for remark in remarks)


def test_a_thousand_units_are_a_metre_in_a_mesh_of_millimetres(read):
    found, remarks = read(binary_stl(BOX), scale=0.5)
    assert found.volume == pytest.approx(1.0) and remarks == ()
    content = binary_stl(Surface(BOX.corners * 1000.0, BOX.triangles))
    found, remarks = read(content)
    assert remarks == ('The mesh boat.stl makes this boat 4000 m long: is hull.scale right '
                       '(0.001 for a mesh in mm)?',)
    found, remarks = read(content, scale=0.001)
    assert same(found, BOX) and remarks == ()
    _, remarks = read(binary_stl(BOX), scale=0.001)
    assert len(remarks) == 1 and '0.004 m long' in remarks[0]


BALL = ball()
NOISE = np.random.default_rng(3).uniform(-1e-7, 1e-7, (320, 3, 3))


@pytest.mark.parametrize('surface, expected, words', [
    (turned(BALL, slice(None, None, 7)), BALL, 'had 46 of 320 triangles that faced the other way'),
    (turned(BALL), BALL, 'was inside out and has been turned.'),
    (joined([BALL, turned(beside(BALL, 3.0, 0.0, 0.0))]),
     joined([BALL, beside(BALL, 3.0, 0.0, 0.0)]), 'had 1 of 2 shells inside out'),
    (turned(joined([BOX, turned(beside(box_surface((1, 1, 0.5)), 0.5, 0, 0.25))])),
     joined([BOX, turned(beside(box_surface((1, 1, 0.5)), 0.5, 0, 0.25))]), 'was inside out'),
    (joined([BALL, Surface(BALL.corners, BALL.triangles[:5])]), BALL,
     'had 5 of 325 triangles without area or given twice'),
    (Surface(BALL.corners, np.concatenate([BALL.triangles, [[1, 1, 2], [4, 5, 4]]])), BALL,
     'had 2 of 322 triangles without area'),
    (Surface(BALL.corners, BALL.triangles[1:]), BALL, 'the holes were closed with 1 triangle.'),
    (Surface(BOX.corners, BOX.triangles[2:]), BOX, 'the holes were closed with 2 triangles.'),
    (Surface((BALL.facets + NOISE).reshape(-1, 3), np.arange(960)), BALL,
     'had 960 open edges; they were closed by joining corners nearer than 2e-05 m.'),
    (joined([BALL, BALL]), BALL, 'given twice'),
    (joined([BALL, beside(BALL, 1.0, 0.0, 0.0)]), joined([BALL, beside(BALL, 1.0, 0.0, 0.0)]),
     'has 2 of 2 shells that overlap another')])
def test_what_can_be_repaired_is_repaired_and_said(read, surface, expected, words):
    found, remarks = read(obj(surface), 'boat.obj')
    assert len(remarks) == 1 and remarks[0].startswith('The mesh boat.obj ')
    assert words in remarks[0] and '\n' not in remarks[0]
    assert len(found.triangles) == len(expected.triangles)
    assert found.volume == pytest.approx(expected.volume, rel=1e-6)
    # Closed, and consistent: the area vectors cancel.
    assert np.abs(found.area_vectors.sum(axis=0)).max() < 1e-9


def klein():
    """Return the triangles of Klein's bottle, closed and of one side."""
    i, j = (grid.ravel() for grid in np.meshgrid(np.arange(24), np.arange(16), indexing='ij'))
    u, v = 2.0 * np.pi * i / 24, 2.0 * np.pi * j / 16
    r = 3.0 + np.cos(u / 2) * np.sin(v) - np.sin(u / 2) * np.sin(2 * v)
    corners = np.stack([r * np.cos(u), r * np.sin(u), np.sin(u / 2) * np.sin(v)
                        + np.cos(u / 2) * np.sin(2 * v)], axis=1)

    def number(i, j):
        return np.where(i < 24, 16 * i + j % 16, -j % 16)

    a, b, c, d = number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)
    return Surface(corners, np.concatenate([np.stack(t, axis=1) for t in ((a, b, c), (a, c, d))]))


def spoilt():
    """Return a ball with one corner that is not a number."""
    corners = BALL.corners.copy()
    corners[7, 1] = np.nan
    return Surface(corners, BALL.triangles)


@pytest.mark.parametrize('surface, words', [
    (Surface(BALL.corners, BALL.triangles[40:]), 'is open: '),
    (joined([BALL, Surface(BALL.corners + 5.0, BALL.triangles[:50])]), 'is open: '),
    (klein(), 'has one side only'), (spoilt(), 'with a corner that is not finite'),
    (joined([BOX, turned(BOX)]), 'shared by more than two triangles'),
    (joined([BOX, beside(BOX, 4.0, 0.0, 0.0)]), 'has 5 edges shared by more than two'),
    (Surface(BOX.corners, [[0, 1, 2], [2, 1, 0]]), 'encloses no volume'),
    (Surface(BOX.corners, [[0, 0, 2]]), 'encloses no volume'),
    (joined([BOX, beside(box_surface((1.0, 1.0, 0.5)), 0.5, 0.0, 0.25)]),
     'has 1 of 2 shells inside another and facing outward')])
def test_what_is_no_hull_is_refused_in_one_line(read, surface, words):
    with pytest.raises(ValueError) as refused:
        read(binary_stl(surface))
    line = str(refused.value)
    assert line.startswith('hull.mesh: ') and words in line and '\n' not in line


def test_the_open_edges_of_a_mesh_are_counted(read):
    # A prism on a hexagon without its lid.
    angle = 2.0 * np.pi * np.arange(6) / 6
    low = np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], axis=1)
    i, j = np.arange(6), (np.arange(6) + 1) % 6
    walls = np.concatenate([np.stack(t, axis=1) for t in ((i, j, j + 6), (i, j + 6, i + 6))])
    floor = [[0, k + 1, k] for k in range(1, 5)]
    with pytest.raises(ValueError, match=r'boat.stl: is open: 6 edges belong to one triangle'):
        read(binary_stl(Surface(np.concatenate([low, low + [0, 0, 1]]),
                                np.concatenate([walls, floor]))))


@pytest.mark.parametrize('name, content, words', [
    ('boat.stl', b'', 'has no triangles or is damaged'),
    ('boat.stl', b'hello ' * 100, 'has no triangles or is damaged'),
    ('boat.stl', binary_stl(BOX)[:-30], 'has no triangles or is damaged'),
    ('boat.stl', ascii_stl(BOX).replace(b'vertex -', b'vertex x', 1), 'cannot be read as STL'),
    ('boat.obj', b'', 'has no triangles or is damaged'), ('boat.obj', b'f 1 2 3\n', 'OBJ'),
    ('boat.obj', b'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n', 'cannot be read as OBJ'),
    ('boat.ply', b'', 'cannot be read as PLY'), ('boat.ply', b'ply\n', 'cannot be read as PLY'),
    ('boat.ply', ply(BOX, 'binary')[:-5], 'cannot be read as PLY'),
    ('boat.step', b'x', 'expected a file that ends in .stl, .obj, .ply, got .step'),
    ('boat', binary_stl(BOX), 'got no ending')])
def test_a_file_that_is_no_mesh_is_refused_in_one_line(read, name, content, words):
    with pytest.raises(ValueError) as refused:
        read(content, name)
    line = str(refused.value)
    assert line.startswith('hull.mesh: ') and words in line and '\n' not in line


def test_a_missing_file_and_a_folder_are_refused(tmp_path):
    with pytest.raises(ValueError, match='hull.mesh: .*none.stl: cannot be read: No such file'):
        read_mesh(tmp_path / 'none.stl')
    (tmp_path / 'folder.stl').mkdir()
    with pytest.raises(ValueError, match='hull.mesh: .*folder.stl: cannot be read: Is a dir'):
        read_mesh(str(tmp_path / 'folder.stl'))


@pytest.mark.parametrize('scale', [0.0, -1.0, np.nan, 'mm'])
def test_a_scale_is_above_nothing(read, scale):
    with pytest.raises(ValueError, match='hull.scale: expected a finite number above 0'):
        read(binary_stl(BOX), scale=scale)


def test_a_million_triangles_are_refused_with_their_number(read):
    with pytest.raises(ValueError, match='has 1000000 triangles, at most 100000 are taken'):
        read(binary_stl(Surface(BOX.corners, np.tile(BOX.triangles[:1], (1000000, 1)))))


def test_a_material_file_is_not_opened(read, tmp_path, monkeypatch):
    (tmp_path / 'red.mtl').write_text('newmtl red\nmap_Kd red.png\n')
    opened = []
    monkeypatch.setattr('builtins.open', lambda *words, **_: opened.append(words[0]))
    surface, _ = read(b'mtllib red.mtl\nusemtl red\n' + obj(BOX), 'boat.obj')
    assert same(surface, BOX) and [name for name in opened if 'red' in str(name)] == []


def test_without_trimesh_a_mesh_says_what_to_install():
    code = WITHOUT.replace('.main(', '.read_mesh(*').format(
        path=sys.path, hidden=('trimesh',), module='boat_buoyancy.physics.boat.mesh',
        words=['boat.stl'])
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True, timeout=60)
    assert done.stderr.splitlines()[-1] == (
        "ValueError: hull.mesh: boat.stl: a mesh needs trimesh (No module named 'trimesh'): "
        './install.sh mesh, or pip install "boat_buoyancy[mesh]"')


# The hulls that come with the package.

HULLS = Path(__file__).parents[1] / 'config' / 'hulls'


@pytest.fixture(scope='module')
def made():
    """Return what `make_hulls.py` defines."""
    names = {'__name__': 'make_hulls'}
    exec((HULLS / 'make_hulls.py').read_text(), names)
    return names


def test_the_hulls_are_what_their_script_makes(made):
    assert sorted(made['HULLS']) == sorted(path.name for path in HULLS.glob('*.stl'))
    for name, make in made['HULLS'].items():
        old, new = (np.frombuffer(content[84:], STL)['corners'] for content in (
            (HULLS / name).read_bytes(), made['stl'](make())))
        assert len(old) == len(new) and np.abs(old - new).max() < 1e-6


def test_the_wigley_hull_has_the_volume_of_its_formula_within_a_percent():
    surface, remarks = read_mesh(HULLS / 'wigley.stl')
    assert remarks == () and 300 < len(surface.triangles) < 700
    np.testing.assert_allclose(surface.extent, [[-10.0, -2.0, 0.0], [10.0, 2.0, 2.5]], atol=1e-6)
    # 4/9 L B T under its waterline, 2/3 L B (D - T) above.
    exact = 20.0 * 4.0 * 1.25 * (4 / 9 + 2 / 3)
    assert 0.99 * exact < surface.volume < exact


def test_the_rigid_inflatable_has_the_dimensions_of_its_source():
    surface, remarks = read_mesh(HULLS / 'rib.stl')
    assert remarks == () and 300 < len(surface.triangles) < 700
    np.testing.assert_allclose(surface.extent[:, :2], [[-2.425, -0.975], [2.425, 0.975]],
                               atol=1e-6)
    assert surface.extent[0, 2] == pytest.approx(0.0, abs=1e-6)
    # Aft, the panels beside the keel rise by its deadrise.
    x, y, z = np.moveaxis(surface.facets, 2, 0)
    bottom = ((x.max(axis=1) <= 0.0) & ((y == 0.0) & (z < 1e-6)).any(axis=1)
              & (np.ptp(x, axis=1) > 0.0))
    normals = surface.area_vectors[bottom]
    assert bottom.sum() == 12
    np.testing.assert_allclose(normals[:, 2] / np.linalg.norm(normals, axis=1),
                               -np.cos(np.radians(24.0)), rtol=1e-6)


@pytest.mark.parametrize('axes, said', [
    ([0, 1, 2], ()), ([0, 2, 1], ('is 3 m long (x), 0.5 m wide (y) and 1.2 m high (z)',)),
    ([1, 0, 2], ('is 1.2 m long (x), 3 m wide (y) and 0.5 m high (z)',))])
def test_axes_that_are_mixed_up_are_asked_about(read, axes, said):
    _, remarks = read(binary_stl(box_surface(np.array([3.0, 1.2, 0.5])[axes])))
    assert len(remarks) == len(said)
    assert all(part in remark and 'is it in body axes' in remark
               for part, remark in zip(said, remarks))


def test_half_a_hull_is_asked_about(read):
    remark, = read(binary_stl(box_surface((3.0, 0.6, 0.5), (0.0, 0.3, 0.0))))[1]
    assert 'lies all on one side of its middle plane' in remark
