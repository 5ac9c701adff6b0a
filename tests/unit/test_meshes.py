"""Collada geometries made into meshes: triangulated, welded, turned the right way round."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from rtb_addon.scene.build import SceneBuilder
from rtb_addon.scene.collada.meshes import geometry_parts, left_out, read_geometry
from rtb_addon.scene.document import Scene
from rtb_addon.scene.triangulation import triangulate

SQUARE = [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]]
# Each arm of a plus sign; four corners bend inwards.
PLUS = [(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3), (1, 2), (0, 2), (0, 1), (1, 1)]


def source(name, rows, columns=("X", "Y", "Z"), stride=None, offset=0):
    rows = np.asarray(rows, float)
    stride = stride or rows.shape[1]
    params = "".join(
        f'<param name="{each}" type="float"/>' if each else '<param type="float"/>' for each in columns
    )
    numbers = " ".join(map(repr, [0.0] * offset + rows.ravel().tolist()))
    return (
        f'<source id="{name}"><float_array id="{name}-array" count="{rows.size}">{numbers}</float_array>'
        f'<technique_common><accessor source="#{name}-array" count="{rows.size // stride}" stride="{stride}"'
        f' offset="{offset}">{params}</accessor></technique_common></source>'
    )


def geometry(sources, primitives, vertices='<input semantic="POSITION" source="#p"/>'):
    inside = f'{sources}<vertices id="v">{vertices}</vertices>{primitives}'
    return etree.fromstring(f'<geometry id="X-mesh"><mesh>{inside}</mesh></geometry>')


VERTEX = '<input semantic="VERTEX" source="#v" offset="0"/>'
NORMAL = '<input semantic="NORMAL" source="#n" offset="1"/>'


def only_mesh(element):
    (part,) = read_geometry(element)
    return part.mesh


def area(mesh):
    a, b, c = mesh.vertices[mesh.triangles].astype(float).transpose(1, 0, 2)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def facing(mesh):
    """Return the mean normal of a mesh's triangles, times their area."""
    a, b, c = mesh.vertices[mesh.triangles].astype(float).transpose(1, 0, 2)
    return np.cross(b - a, c - a).sum(axis=0) / 2


@pytest.mark.parametrize(
    "primitives",
    [
        f'<triangles count="2">{VERTEX}<p>0 1 2 0 2 3</p></triangles>',
        f'<polylist count="1">{VERTEX}<vcount>4</vcount><p>0 1 2 3</p></polylist>',
        f'<polylist count="2">{VERTEX}<vcount>3 3 </vcount><p>0 1 2 0 2 3</p></polylist>',
        f'<polygons count="1">{VERTEX}<p>0 1 2 3</p></polygons>',
        f'<polygons count="1">{VERTEX}<ph><p>0 1 2 3</p></ph></polygons>',
        f'<trifans count="2">{VERTEX}<p>0 1 2 3</p><p>0 1</p></trifans>',
    ],
)
def test_each_kind_of_primitive_gives_the_same_square(primitives):
    mesh = only_mesh(geometry(source("p", SQUARE), primitives))
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    np.testing.assert_array_equal(mesh.vertices, np.float32(SQUARE))
    assert mesh.normals is None
    assert mesh.uvs is None


def test_every_second_triangle_of_a_strip_runs_the_other_way():
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 2, 0], [9, 0, 0], [9, 1, 0], [8, 0, 0]]
    primitives = f'<tristrips count="2">{VERTEX}<p>0 1 2 3 4</p><p>5 6 7</p></tristrips>'
    mesh = only_mesh(geometry(source("p", points), primitives))
    assert mesh.triangles.tolist() == [[0, 1, 2], [2, 1, 3], [2, 3, 4], [5, 6, 7]]
    np.testing.assert_allclose(facing(mesh), [0, 0, 2])


def ring(count, radius, centre=(0, 0), back=False):
    angles = np.linspace(0, 2 * np.pi, count, endpoint=False)[:: -1 if back else 1]
    return np.column_stack([centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles)])


def ring_area(count, radius):
    return count / 2 * radius**2 * np.sin(2 * np.pi / count)


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize("count", [3, 4, 17])
@pytest.mark.parametrize("turn", [np.eye(3), np.eye(3)[[1, 2, 0]], np.diag([1, -1, -1])])
def test_a_polygon_with_holes_is_covered_but_for_its_holes(turn, count, back):
    rings = [
        ring(count, 10),
        *(ring(5, 0.7, centre, back) for centre in ((-1, 0), (2, 1), (0.5, -2), (2, -1))),
    ]
    flat = np.concatenate(rings)
    points = np.column_stack([flat, np.zeros(len(flat))]) @ turn.T
    ends = np.cumsum([len(each) for each in rings])
    outline, *holes = [" ".join(map(str, each)) for each in np.split(np.arange(len(flat)), ends[:-1])]
    ph = f"<ph><p>{outline}</p>" + "".join(f"<h>{hole}</h>" for hole in holes) + "</ph>"
    more = "<p>0 1 2</p>"  # an ordinary polygon behind it
    mesh = only_mesh(geometry(source("p", points), f'<polygons count="2">{VERTEX}{ph}{more}</polygons>'))
    a, b, c = points[[0, 1, 2]]
    extra = np.cross(b - a, c - a)[np.abs(turn[:, 2]).argmax()] / 2
    expected = ring_area(count, 10) - 4 * ring_area(5, 0.7)
    assert area(mesh) == pytest.approx(expected + abs(extra), rel=1e-5)
    np.testing.assert_allclose(facing(mesh), turn[:, 2] * (expected + abs(extra)), atol=1e-4)
    assert len(mesh.triangles) == count + 4 * 5 + 2 * 4 - 2 + 1


def test_a_part_takes_the_set_of_texture_coordinates_that_is_wanted():
    sets = [[[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 0], [2, 0], [2, 2], [0, 2]]]
    sources = source("p", SQUARE) + "".join(source(f"t{k}", uv, ("S", "T")) for k, uv in enumerate(sets))
    texture = "".join(
        f'<input semantic="TEXCOORD" source="#t{k}" offset="{k + 1}" set="{number}"/>'
        for k, number in enumerate((3, 1))
    )
    corners = " ".join(f"{k} {k} {k}" for k in (0, 1, 2, 0, 2, 3))
    primitives = f'<triangles material="wood" count="2">{VERTEX}{texture}<p>{corners}</p></triangles>'
    element = geometry(sources, primitives)
    for wanted, expected in (({}, 2), ({"wood": 1}, 2), ({"wood": 3}, 1), ({"wood": 7}, 2), ({"tin": 3}, 2)):
        (part,) = geometry_parts(element, wanted)
        assert part.mesh.uvs is not None
        assert part.mesh.uvs.max() == expected


def test_what_is_no_face_is_left_out_and_said():
    lines = f'<lines count="1">{VERTEX}<p>0 1</p></lines>'
    triangles = f'<triangles count="1">{VERTEX}<p>0 1 2</p></triangles>'
    element = geometry(source("p", SQUARE), lines + triangles)
    assert len(read_geometry(element)) == 1
    assert list(left_out(element)) == ["the lines of X-mesh are left out, only faces are drawn"]
    spline = etree.fromstring('<geometry id="Curve" name="Path"><spline/></geometry>')
    assert read_geometry(spline) == ()
    assert list(left_out(spline)) == ["Path holds no mesh and is left out, export it as one"]


@pytest.mark.parametrize("start", range(12))
@pytest.mark.parametrize("turn", ["flat", "standing", "tilted", "reversed"])
def test_a_concave_polygon_is_covered_once(start, turn):
    flat = np.roll(np.column_stack([PLUS, np.zeros(12)]), start, axis=0)
    points = {
        "flat": flat,
        "standing": flat[:, [2, 0, 1]],
        "tilted": flat @ np.linalg.qr(np.array([[1.0, 2, 3], [0, 1, 4], [5, 6, 0]]))[0],
        "reversed": flat[::-1],
    }[turn]
    triangles = points[triangulate(np.array([12]), points)]
    vectors = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2
    assert len(triangles) == 10
    assert np.linalg.norm(vectors, axis=1).sum() == pytest.approx(5)  # no triangle lies outside ...
    assert np.linalg.norm(vectors.sum(axis=0)) == pytest.approx(5)  # ... or the other way round


@given(st.lists(st.integers(3, 9), min_size=1, max_size=6))
def test_convex_polygons_of_any_size_keep_their_order_and_area(counts):
    rings = [np.linspace(0, 2 * np.pi, count, endpoint=False) for count in counts]
    points = np.concatenate(
        [np.column_stack([np.cos(a), np.sin(a), np.full(len(a), k)]) for k, a in enumerate(rings)]
    )
    triangles = triangulate(np.array(counts), points)
    assert len(triangles) == sum(count - 2 for count in counts)
    corners = points[triangles]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert areas.sum() == pytest.approx(sum(count / 2 * np.sin(2 * np.pi / count) for count in counts))
    assert (np.diff(corners[:, 0, 2]) >= 0).all()


def test_polygons_of_mixed_sizes_in_one_list():
    points = [*SQUARE, [3, 0.5, 0]]
    mesh = only_mesh(
        geometry(
            source("p", points),
            f'<polylist count="3">{VERTEX}<vcount>2 4 3</vcount><p>0 1 0 1 2 3 1 4 2</p></polylist>',
        )
    )
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [1, 4, 2]]
    assert area(mesh) == pytest.approx(2.5)


def test_sources_have_strides_offsets_and_columns_to_skip():
    rows = np.column_stack([np.full(4, 9), np.float32(SQUARE)])
    mesh = only_mesh(
        geometry(
            source("p", rows, ("", "X", "Y", "Z"), stride=4, offset=5),
            f'<triangles count="2">{VERTEX}<p>0 1 2 0 2 3</p></triangles>',
        )
    )
    np.testing.assert_array_equal(mesh.vertices, np.float32(SQUARE))


def test_corners_that_agree_in_everything_are_one_vertex():
    normals = [[0, 0, 1]] * 6  # one for each corner, all the same
    uvs = [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0.5, 1]]
    p = " ".join(f"{corner} {k} {k}" for k, corner in enumerate([0, 1, 2, 0, 2, 3]))
    texture = '<input semantic="TEXCOORD" source="#t" offset="2" set="0"/>'
    mesh = only_mesh(
        geometry(
            source("p", SQUARE) + source("n", normals) + source("t", uvs, ("S", "T")),
            f'<triangles count="2">{VERTEX}{NORMAL}{texture}<p>{p}</p></triangles>',
        )
    )
    assert len(mesh.vertices) == 4
    assert mesh.uvs is not None
    np.testing.assert_allclose(mesh.uvs[mesh.triangles[1]], [[0, 0], [1, 1], [0.5, 1]])


def test_a_seam_keeps_its_two_texture_coordinates():
    uvs = [[0, 0], [1, 0], [1, 1], [0.1, 0], [1, 1], [0, 1]]
    p = " ".join(f"{corner} {k}" for k, corner in enumerate([0, 1, 2, 0, 2, 3]))
    texture = '<input semantic="TEXCOORD" source="#t" offset="1"/>'
    mesh = only_mesh(
        geometry(
            source("p", SQUARE) + source("t", uvs, ("S", "T")),
            f'<triangles count="2">{VERTEX}{texture}<p>{p}</p></triangles>',
        )
    )
    assert len(mesh.vertices) == 5


def test_smooth_normals_stay_and_flat_ones_go():
    tilted = [[0.6, 0, 0.8], [0, 0, 1], [0, 0, 1], [0, 0, 2]]
    primitives = f'<triangles count="2">{VERTEX}{NORMAL}<p>0 0 1 1 2 2 0 0 2 2 3 3</p></triangles>'
    smooth = only_mesh(geometry(source("p", SQUARE) + source("n", tilted), primitives))
    assert smooth.normals is not None
    np.testing.assert_allclose(smooth.normals, [[0.6, 0, 0.8], [0, 0, 1], [0, 0, 1], [0, 0, 1]], atol=1e-7)
    flat = only_mesh(geometry(source("p", SQUARE) + source("n", [[0, 0, 1]] * 4), primitives))
    assert flat.normals is None


def test_a_normal_without_length_gives_way_to_the_faces():
    normals = [[0.6, 0, 0.8], [0, 0, 0], [0, 0, 1], [0, 0, 1]]
    primitives = f'<triangles count="2">{VERTEX}{NORMAL}<p>0 0 1 1 2 2 0 0 2 2 3 3</p></triangles>'
    mesh = only_mesh(geometry(source("p", SQUARE) + source("n", normals), primitives))
    assert mesh.normals is not None
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-6)
    np.testing.assert_allclose(mesh.normals[mesh.triangles[0, 1]], [0, 0, 1])


def test_triangles_turn_to_the_side_of_their_normals():
    primitives = f'<triangles count="2">{VERTEX}{NORMAL}<p>0 0 1 0 2 0 0 0 2 0 3 0</p></triangles>'
    mesh = only_mesh(geometry(source("p", SQUARE) + source("n", [[0, 0, -1]]), primitives))
    np.testing.assert_allclose(facing(mesh), [0, 0, -2])


def test_normals_may_stand_with_the_vertices():
    vertices = '<input semantic="POSITION" source="#p"/><input semantic="NORMAL" source="#n"/>'
    primitives = f'<triangles count="2">{VERTEX}<p>0 1 2 0 2 3</p></triangles>'
    sources = source("p", SQUARE) + source("n", [[0.6, 0, 0.8]] * 4)
    assert only_mesh(geometry(sources, primitives, vertices)).normals is not None


def test_a_mesh_of_several_materials_has_a_part_for_each():
    primitives = "".join(
        f'<triangles material="{name}" count="1">{VERTEX}<p>{p}</p></triangles>'
        for name, p in (("red", "0 1 2"), ("blue", "0 2 3"), ("empty", ""), ("point", "0 0 0"))
    )
    parts = read_geometry(geometry(source("p", SQUARE), primitives))
    assert [part.symbol for part in parts] == ["red", "blue"]
    assert [len(part.mesh.vertices) for part in parts] == [3, 3]


@pytest.mark.parametrize(
    ("sources", "primitives", "words"),
    [
        (
            source("p", SQUARE),
            f'<triangles count="1">{VERTEX}<p>0 1 9</p></triangles>',
            "index .* not among its 4 rows",
        ),
        (source("p", SQUARE), f'<triangles count="1">{VERTEX}<p>0 1</p></triangles>', "2 corners, want 3"),
        (
            source("p", SQUARE),
            f'<triangles count="1">{VERTEX}<p>0 1 x</p></triangles>',
            "must hold numbers only",
        ),
        (
            source("p", SQUARE),
            f'<polylist count="1">{VERTEX}<vcount>4</vcount><p>0 1 2</p></polylist>',
            "3 corners, want 4",
        ),
        (
            source("p", SQUARE),
            f'<polygons count="1">{VERTEX}<ph><h>0 1 2</h></ph></polygons>',
            "a polygon with holes has no outline",
        ),
        (
            source("q", SQUARE),
            f'<triangles count="1">{VERTEX}<p>0 1 2</p></triangles>',
            "there is no source #p",
        ),
        (
            source("p", SQUARE).replace("2.0", "NaN"),
            f"<triangles>{VERTEX}<p>0 1 2</p></triangles>",
            "not finite",
        ),
        (
            source("p", [[0, 0], [1, 1]], ("X", "Y")),
            f"<triangles>{VERTEX}<p>0 1 1</p></triangles>",
            "has 2 columns, want 3",
        ),
    ],
)
def test_broken_geometries_are_refused_in_a_sentence(sources, primitives, words):
    with pytest.raises(ValueError, match=f"^X-mesh: .*{words}"):
        read_geometry(geometry(sources, primitives))


def test_what_is_built_is_what_is_read():
    builder = SceneBuilder()
    builder.sphere("Ball", 2.0, segments=24)
    scene = Scene.parse(builder.tobytes(), "parent.dae")
    (part,) = geometry_parts(scene.linked("#Ball-mesh", "geometry"))
    assert part.mesh.normals is not None
    assert part.mesh.uvs is not None
    np.testing.assert_allclose(part.mesh.normals * 2, part.mesh.vertices, atol=1e-6)
    assert len(part.mesh.triangles) == 24 * 2 * (12 - 1)
    # Each vertex once, but for the seam and the poles, where texture coordinates differ.
    assert len(part.mesh.vertices) <= 25 * 13


def test_the_same_geometry_is_read_once():
    builder = SceneBuilder()
    builder.plane("Wall")
    first, second = (Scene.parse(builder.tobytes(), "parent.dae") for _ in range(2))
    parts = [geometry_parts(each.linked("#Wall-mesh", "geometry")) for each in (first, second)]
    assert parts[0] is parts[1]
