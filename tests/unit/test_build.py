"""Parent scenes made without Blender: what they say, and that their numbers are those that were given."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from lxml import etree

from rtb_addon.scene.build import Placement, SceneBuilder
from rtb_addon.scene.collada.ids import Ids, clean
from rtb_addon.scene.collada.write_numbers import floats, indices, shortest
from rtb_addon.scene.placement import placement_of
from rtb_addon.scene.primitives import disk, plane, sphere
from rtb_addon.scene.surface import corners, distinct, distinct_at

# Children of each element in the order that Collada 1.4.1's schema asks for.
ORDER = {
    "COLLADA": "asset library_cameras library_lights library_effects library_materials library_geometries"
    " library_visual_scenes scene",
    "asset": "contributor created modified unit up_axis",
    "camera": "optics extra",
    "perspective": "xfov yfov aspect_ratio znear zfar",
    "orthographic": "xmag ymag aspect_ratio znear zfar",
    "light": "technique_common extra",
    "point": "color constant_attenuation linear_attenuation quadratic_attenuation",
    "spot": "color constant_attenuation linear_attenuation quadratic_attenuation falloff_angle"
    " falloff_exponent",
    "lambert": "emission diffuse",
    "mesh": "source vertices triangles",
    "source": "float_array technique_common",
    "triangles": "input p",
    "node": "translate rotate scale matrix instance_camera instance_geometry instance_light node",
}
NEEDED = {
    "camera": "id",
    "light": "id",
    "geometry": "id",
    "material": "id",
    "effect": "id",
    "accessor": "source",
}


def everything() -> SceneBuilder:
    """Return a scene of everything that can be built."""
    scene = SceneBuilder("Everything", meter=0.01)
    scene.material("Red.001", (0.5, 0.1, 0.1))
    scene.plane("Floor", 4, 3, material="Red.001")
    scene.sphere("Ball", placement=Placement((0, 0, 1), (10, 20, 30), (1, 2, 3)))
    scene.disk("Plate", parent="Ball", placement=np.diag([1, -1, -1, 1]))
    scene.mesh("Triangle", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], uvs=[[(0, 0), (1, 0), (0, 1)]])
    scene.instance("Copy", "Floor", Placement((0, 0, 5)))
    scene.point("Lamp")
    scene.spot("Spot", parent="Ball")
    scene.sun("Sun")
    scene.camera(shift=(0.25, 0))
    scene.camera("Parallel", width=6.0)
    return scene


@pytest.fixture(scope="module")
def root():
    return etree.fromstring(everything().tobytes())


def local(element) -> str:
    return etree.QName(element).localname


def test_elements_stand_in_the_order_of_the_format(root):
    for element in root.iter():
        if local(element) in ORDER:
            order = ORDER[local(element)].split()
            places = [order.index(local(child)) for child in element]
            assert places == sorted(places), local(element)


def test_every_link_leads_somewhere_and_every_id_is_there_once(root):
    ids = root.xpath("//@id")
    assert len(set(ids)) == len(ids)
    links = [link for name in ("url", "source", "target") for link in root.xpath(f"//@{name}")]
    assert len(links) > 20
    assert {link.removeprefix("#") for link in links} <= set(ids)
    for element in root.iter():
        assert NEEDED.get(local(element), "id") in element.attrib or local(element) not in NEEDED


def test_counts_are_those_of_the_numbers(root):
    for array in root.iter("{*}float_array"):
        assert len(array.text.split()) == int(array.get("count"))
    for triangles in root.iter("{*}triangles"):
        inputs = len(triangles.findall("{*}input"))
        assert len(triangles.find("{*}p").text.split()) == 3 * inputs * int(triangles.get("count"))


def test_ids_are_those_of_blenders_exporter(root):
    wanted = (
        "Floor Floor-mesh Lamp-light Spot-light Camera-camera Red_001-material Red_001-effect Grey-material"
    )
    assert set(wanted.split()) <= set(root.xpath("//@id"))
    sids = [each.get("sid") for each in root.xpath("//*[@id='Floor']/*[@sid]")]
    assert sids == ["location", "rotationZ", "rotationY", "rotationX", "scale"]


def test_the_same_calls_make_the_same_bytes():
    assert everything().tobytes() == everything().tobytes()


def test_the_unit_is_written(root):
    assert root.find(".//{*}unit").get("meter") == "0.01"


def test_a_child_added_after_its_parent_is_used_leaves_the_order_right():
    scene = SceneBuilder()
    group = scene.node("Group")
    scene.node("Below", parent=group)
    scene.use_lamp(group, scene.lamp("Lamp", "point", (1, 1, 1)))
    (node,) = etree.fromstring(scene.tobytes()).xpath("//*[@id='Group']")
    assert [local(each) for each in node][-2:] == ["instance_light", "node"]


def test_names_that_look_like_the_writers_own_marks_stay_names():
    scene = SceneBuilder()
    scene.plane("[[0]]")
    scene.plane(">[[1]]<")
    names = etree.fromstring(scene.tobytes()).xpath("//*[local-name()='geometry']/@name")
    assert names == ["[[0]]", ">[[1]]<"]


# Ids


@pytest.mark.parametrize(
    ("name", "cleaned"),
    [
        ("a.b", "a_b"),
        ("a b", "a_b"),
        ("a-b", "a-b"),
        ("1abc", "_abc"),
        ("-x", "_x"),
        ("é日", "é日"),
        ("", "_"),
    ],
)
def test_names_are_cleaned_as_blenders_exporter_cleans_them(name, cleaned):
    assert clean(name) == cleaned


@given(st.lists(st.text(), max_size=8))
def test_ids_are_unique_and_hold_nothing_that_xml_or_a_path_minds(names):
    ids = Ids()
    ids.reserve(names)
    taken = [ids.take(name) for name in (*names, *names)]
    assert len(set(taken)) == len(taken)
    for each in taken:
        assert not set(each) & set(". :$|=<>[](){}/\\\"'\n\t")
        etree.Element("node").set("id", each)


def test_a_name_that_needs_no_cleaning_keeps_its_id_whoever_comes_first():
    ids = Ids()
    ids.reserve(["a.b", "a b", "a_b"])
    assert [ids.take(name) for name in ("a.b", "a b", "a_b", "a_b")] == ["a_b3", "a_b2", "a_b", "a_b4"]


# Numbers


@given(
    arrays.arrays(
        np.float32, st.integers(0, 40), elements=st.floats(width=32, allow_nan=False, allow_infinity=False)
    ),
    st.sampled_from([1, 60]),
)
def test_numbers_are_read_back_as_they_were(values, times):
    many = np.tile(values, times)
    read = np.array(floats(many).split(), float).astype(np.float32)
    np.testing.assert_array_equal(read, many)


@pytest.mark.parametrize("spread", [0, 3, 12, 37])
def test_many_different_numbers_look_as_python_writes_them(spread):
    random = np.random.default_rng(spread)
    values = (random.normal(size=40_000) * 10.0 ** random.uniform(-spread, spread, 40_000)).astype(np.float32)
    values[::7] = np.round(values[::7])
    assert floats(values) == b" ".join(b"%.9g" % (value + 0.0) for value in values.tolist())


@pytest.mark.parametrize("count", [1, 9, 10, 11, 1000, 100_001])
def test_indices_look_as_python_writes_them(count):
    values = np.random.default_rng(count).permutation(count).reshape(-1, 1)
    assert indices(values).decode() == " ".join(map(str, values.ravel()))
    assert indices(values[:0]) == b""


@given(st.floats(width=32, allow_nan=False, allow_infinity=False))
def test_the_shortest_number_is_the_same_in_single_precision(value):
    assert np.float32(shortest(value)) == np.float32(value)
    assert len(repr(shortest(value))) <= len(repr(float(np.float32(value))))


# Placements

ANGLES = st.floats(-180, 180)
SIZES = st.floats(0.01, 100) | st.floats(-100, -0.01)


@given(st.tuples(ANGLES, ANGLES, ANGLES), st.tuples(SIZES, SIZES, SIZES))
def test_a_matrix_is_taken_apart_into_what_makes_it_again(rotation, scale):
    matrix = Placement((1, 2, 3), rotation, scale).matrix
    found = placement_of(matrix)
    assert found is not None
    np.testing.assert_allclose(found.matrix, matrix, atol=2e-6 * np.abs(scale).max())


@pytest.mark.parametrize("angle", [90, -90])
def test_a_matrix_that_looks_straight_up_is_taken_apart_too(angle):
    matrix = Placement((0, 0, 0), (35, angle, 50), (1, 2, 3)).matrix
    found = placement_of(matrix)
    assert found is not None
    np.testing.assert_allclose(found.matrix, matrix, atol=1e-6)


def test_a_sheared_or_flattened_matrix_has_no_parts():
    sheared = Placement(rotation=(0, 0, 30), scale=(1, 3, 1)).matrix @ Placement(rotation=(0, 0, 20)).matrix
    assert placement_of(sheared) is None
    assert placement_of(np.diag([1, 1, 0, 1])) is None


def test_scale_acts_first_then_x_then_y_then_z():
    matrix = Placement((1, 0, 0), (90, 0, 90), (2, 1, 1)).matrix
    np.testing.assert_allclose(matrix @ [1, 0, 0, 1], [1, 2, 0, 1], atol=1e-12)
    np.testing.assert_allclose(matrix @ [0, 1, 0, 1], [1, 0, 1, 1], atol=1e-12)


# Shapes


def area(surface) -> float:
    first, second, third = (surface.vertices[surface.triangles[:, k]].astype(float) for k in range(3))
    return np.linalg.norm(np.cross(second - first, third - first), axis=1).sum() / 2


def test_shapes_have_the_areas_of_their_closed_forms():
    assert area(plane(3, 2)) == pytest.approx(6)
    assert area(disk(3, 2)) == pytest.approx(np.pi * 3 * 2 / 4, rel=1e-6)
    assert area(disk(3, 2, segments=5)) == pytest.approx(np.pi * 3 * 2 / 4, rel=1e-6)
    assert area(sphere(2, 256, 128)) == pytest.approx(4 * np.pi * 4, rel=1e-3)


@pytest.mark.parametrize("surface", [plane(), disk(), sphere()])
def test_triangles_run_counterclockwise_round_their_normals(surface):
    first, second, third = (surface.vertices[surface.triangles[:, k]] for k in range(3))
    facing = np.cross(second - first, third - first)
    for corner in range(3):
        normal = surface.normals.values[surface.normals.indices[:, corner]]
        assert (np.einsum("ij,ij->i", facing, normal) > 0).all()
        np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1, atol=1e-6)


def test_texture_coordinates_of_a_sphere_do_not_run_back_across_its_seam():
    ball = sphere()
    u = ball.uvs.values[ball.uvs.indices][..., 0]
    assert np.ptp(u, axis=1).max() < 0.51


@given(arrays.arrays(np.float32, (12, 2), elements=st.sampled_from([0.0, -0.0, 0.25, 1.0])))
def test_shared_corners_are_those_that_were_given(values):
    triangles = np.array([[0, 1, 2], [0, 2, 3], [3, 2, 1], [1, 0, 3]])
    for shared in (
        corners(values.reshape(4, 3, 2), triangles),
        distinct(values),
        distinct_at(values, triangles.ravel()),
    ):
        np.testing.assert_array_equal(shared.values[shared.indices].reshape(-1, 2), values)
    assert len(distinct(values).values) == len(np.unique(values, axis=0))


def test_corners_that_are_no_corners_of_the_triangles_are_refused():
    with pytest.raises(ValueError, match="corners for"):
        corners(np.zeros((2, 3, 2)), np.zeros((1, 3), int))
