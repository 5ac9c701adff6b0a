"""Parent scene and mappings made into the neutral scene: places, cameras, lights, materials."""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rtb_addon.conditions import Condition, Conditions, read_conditions
from rtb_addon.errors import RecipeError
from rtb_addon.mappings import parse_mappings, read_mappings
from rtb_addon.scene.adjustments import Adjustments
from rtb_addon.scene.build import Placement, SceneBuilder
from rtb_addon.scene.document import Scene
from rtb_addon.scene.render_scene import Film
from rtb_addon.scene.resolve import SceneSettings, resolve

RTB3 = Path(os.environ.get("RTB3_FOLDER", Path(__file__).resolve().parents[3] / "shared" / "rtb3"))
SETTINGS = SceneSettings(Film(320, 240))
DEFAULT_MAPPINGS = "Collada {\n    Camera:scale|sid=scale = -1 1 1\n}\n"


def nothing(name):
    return None


def old(*parts):
    file = RTB3.joinpath(*parts)
    if not file.exists():
        pytest.skip(f"RENDERTOOLBOX3'S FILES ARE NOT HERE: no {file}, set RTB3_FOLDER")
    return file


def in_folder(folder):
    return lambda name: folder / name if (folder / name).is_file() else None


def resolved(scene, mappings="", settings=SETTINGS, find_file=nothing, condition=None):
    document = Scene.parse(scene if isinstance(scene, bytes) else scene.tobytes(), "parent.dae")
    row = condition or next(iter(Conditions.single("one")))
    adjustments = parse_mappings(mappings, "mappings.txt").fill_in(row, "tracer", document, find_file)
    return resolve(document, adjustments, settings, find_file)


def generic(*lines):
    return "Generic {\n" + "\n".join(lines) + "\n}\n"


def room(camera=True, lamp=True):
    """Return a builder with a wall, a camera and a lamp."""
    builder = SceneBuilder()
    builder.plane("Wall", 2, 2, "Paint")
    if camera:
        builder.camera(placement=Placement((0, 0, 5)))
    if lamp:
        builder.point("Lamp", placement=Placement((0, 0, 3)))
    return builder


def with_nodes(nodes, unit="1", up="Z_UP", library=""):
    """Return a document of a room whose visual scene holds other nodes."""
    text = room().tobytes().decode()
    start, end = text.index("<node"), text.index("</visual_scene>")
    asset = text.index("<up_axis>")
    text = text[:start] + nodes + text[end:]
    text = text.replace("</library_geometries>", "</library_geometries>" + library)
    return (
        (text[:asset] + text[asset:].replace("Z_UP", up, 1)).replace('meter="1"', f'meter="{unit}"').encode()
    )


CAMERA = '<node id="Camera"><translate>0 0 5</translate><instance_camera url="#Camera-camera"/></node>'
LAMP = '<node id="Lamp"><instance_light url="#Lamp-light"/></node>'


def wall(transforms="", inside="", id="Wall"):
    return (
        f'<node id="{id}">{transforms}<instance_geometry url="#Wall-mesh"><bind_material><technique_common>'
        '<instance_material symbol="Paint-material" target="#Paint-material"/></technique_common>'
        f"</bind_material></instance_geometry>{inside}</node>"
    )


def wall_matrix(transforms, **document):
    scene = resolved(with_nodes(CAMERA + LAMP + wall(transforms), **document)).scene
    return scene.shapes[0].to_world


def world_area(shape):
    points = shape.mesh.vertices @ shape.to_world[:3, :3].T + shape.to_world[:3, 3]
    a, b, c = points[shape.mesh.triangles].transpose(1, 0, 2)
    return np.cross(b - a, c - a).sum(axis=0) / 2


def pixel_of(camera, film, point):
    """Return column and row [pixels] of a point in the world."""
    x, y, z, _ = np.linalg.inv(camera.to_world) @ [*point, 1]
    left, right, bottom, top = camera.window
    if camera.projection == "perspective":
        x, y = x / -z, y / -z
    return (x - left) / (right - left) * film.width, (top - y) / (top - bottom) * film.height


# Where things stand.


@pytest.mark.parametrize(
    ("transforms", "point", "expected"),
    [
        ("<translate>1 2 3</translate>", (0, 0, 0), (1, 2, 3)),
        ("<rotate>0 0 1 90</rotate>", (1, 0, 0), (0, 1, 0)),
        ("<rotate>2 0 0 90</rotate>", (0, 1, 0), (0, 0, 1)),
        ("<scale>2 3 4</scale>", (1, 1, 1), (2, 3, 4)),
        ("<matrix>0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 1</matrix>", (1, 0, 0), (5, 7, 7)),
        ("<translate>1 0 0</translate><rotate>0 0 1 90</rotate><scale>2 1 1</scale>", (1, 0, 0), (1, 2, 0)),
        (
            "<matrix>1 0 0 0 0 1 0 0 0 0 1 10 0 0 0 1</matrix><translate>4 -5 0</translate>",
            (0, 0, 0),
            (4, -5, 10),
        ),
        ("<lookat>0 0 5 0 0 0 0 1 0</lookat>", (1, 2, -1), (1, 2, 4)),
        ("<lookat>5 0 0 0 0 0 0 0 1</lookat>", (0, 0, -5), (0, 0, 0)),
        ("<lookat>5 0 0 0 0 0 0 0 1</lookat>", (0, 1, 0), (5, 0, 1)),
        ("<skew>45 0 1 0 1 0 0</skew>", (0, 2, 0), (2, 2, 0)),
        ("<skew>45 0 1 0 1 0 0</skew>", (3, 0, 1), (3, 0, 1)),
        # An axis half-way to the other one and 15 degrees more of it.
        ("<skew>15 0 0 1 0 1 0 </skew>", (0, 0, 1), (0, 0.2679491924311227, 1)),
        ("<skew>15 0 1 1 0 1 0 </skew>", (0, 0, 1), (0, 0.7320508075688772, 1)),
    ],
)
def test_every_transform_acts_in_its_turn(transforms, point, expected):
    np.testing.assert_allclose((wall_matrix(transforms) @ [*point, 1])[:3], expected, atol=1e-12)


@pytest.mark.parametrize(
    ("transforms", "words"),
    [
        ("<skew>30 0 1 0 0 2 0</skew>", "must not be parallel, in the node Wall"),
        ("<skew>90 0 1 0 1 0 0</skew>", "turns its axis too far"),
        ("<skew>30 0 0 0 1 0 0</skew>", "a skew needs two axes"),
        ("<scale>2</scale>", "a scale holds 1 numbers, want 3, in the node Wall"),
        ("<rotate>0 0 0 30</rotate>", "needs an axis"),
        ("<lookat>0 0 1 0 0 0 0 0 1</lookat>", "a direction up"),
    ],
)
def test_a_transform_that_makes_no_sense_is_refused(transforms, words):
    with pytest.raises(RecipeError, match=words):
        wall_matrix(transforms)


def test_nodes_stand_where_all_their_parents_put_them():
    inner = wall("<translate>1 0 0</translate>", id="Inner")
    outer = f'<node id="Outer"><translate>0 0 2</translate><rotate>0 0 1 90</rotate>{inner}</node>'
    scene = resolved(with_nodes(CAMERA + LAMP + outer)).scene
    np.testing.assert_allclose(scene.shapes[0].to_world[:3, 3], [0, 1, 2], atol=1e-12)


def test_nodes_of_a_library_stand_wherever_they_are_used():
    library = f"<library_nodes>{wall('<translate>1 0 0</translate>', id='Kept')}</library_nodes>"
    uses = "".join(
        f'<node id="{name}"><translate>0 {y} 0</translate><instance_node url="#Kept"/></node>'
        for name, y in (("A", 3), ("B", 4))
    )
    shapes = resolved(with_nodes(CAMERA + LAMP + uses, library=library)).scene.shapes
    assert [shape.id for shape in shapes] == ["Wall-mesh_0", "Wall-mesh_1"]
    np.testing.assert_allclose([shape.to_world[:3, 3] for shape in shapes], [[1, 3, 0], [1, 4, 0]])
    assert shapes[0].mesh is shapes[1].mesh


def test_a_node_that_holds_itself_is_refused():
    loop = '<node id="Loop"><instance_node url="#Loop"/></node>'
    with pytest.raises(RecipeError, match="the node Loop holds itself"):
        resolved(with_nodes(CAMERA + LAMP + loop))


def test_centimetres_with_y_up_are_metres_with_z_up():
    metres = CAMERA + LAMP + wall("<translate>1 2 3</translate><rotate>1 0 0 30</rotate>")
    turn = "<rotate>1 0 0 -90</rotate><scale>100 100 100</scale>"
    centimetres = f'<node id="World">{turn}{metres}</node>'
    here, there = (
        resolved(with_nodes(nodes, unit, up)).scene
        for nodes, unit, up in ((metres, "1", "Z_UP"), (centimetres, "0.01", "Y_UP"))
    )
    np.testing.assert_allclose(there.shapes[0].to_world, here.shapes[0].to_world, atol=1e-12)
    np.testing.assert_allclose(there.camera.to_world, here.camera.to_world, atol=1e-12)
    np.testing.assert_allclose(there.lights[0].to_world, here.lights[0].to_world, atol=1e-12)
    assert there.camera.window == pytest.approx(here.camera.window)


@pytest.mark.parametrize(
    ("up", "point", "expected"),
    [("Y_UP", (1, 2, 3), (1, -3, 2)), ("X_UP", (1, 2, 3), (-2, -3, 1)), ("Z_UP", (1, 2, 3), (1, 2, 3))],
)
def test_what_is_up_in_the_document_is_up_in_the_world(up, point, expected):
    np.testing.assert_allclose((wall_matrix("", up=up) @ [*point, 1])[:3], expected)


def test_a_mirrored_object_shows_its_front_and_no_mirroring_matrix():
    straight, mirrored = (
        resolved(with_nodes(CAMERA + LAMP + wall(f"<scale>{x} 1 1</scale><rotate>1 0 0 20</rotate>"))).scene
        for x in (1, -1)
    )
    shape = mirrored.shapes[0]
    assert np.linalg.det(shape.to_world[:3, :3]) > 0
    np.testing.assert_allclose(world_area(shape), world_area(straight.shapes[0]) * [-1, 1, 1], atol=1e-6)


def test_an_object_scaled_to_nothing_is_left_out_and_said():
    found = resolved(with_nodes(CAMERA + LAMP + wall("<scale>1 1 0</scale>", id="Gone") + wall()))
    assert len(found.scene.shapes) == 1
    assert "Gone is scaled to nothing and left out" in found.warnings


# Cameras.


def view(film, **camera):
    builder = room(camera=False)
    builder.camera(**camera)
    return resolved(builder, settings=SceneSettings(film)).scene.camera


def test_xfov_spans_the_width_whatever_the_aspect_ratio_says():
    half = np.tan(np.radians(49.13434) / 2)
    for film in (Film(320, 240), Film(100, 100), Film(100, 300)):
        window = view(film, xfov=49.13434, aspect=1.777778).window
        high = half * film.height / film.width
        assert window == pytest.approx((-half, half, -high, high))


@pytest.mark.parametrize(
    ("size", "expected"),
    [  # as Blender 4.5's view_frame() gives them for a shift of (0.1, 0.2), times 35 / 32 for a lens of 35 mm
        ((320, 240), (-0.4, 0.6, -0.175, 0.575)),
        ((240, 320), (-0.275, 0.475, -0.3, 0.7)),
    ],
)
def test_shift_is_a_fraction_of_the_longer_side(size, expected):
    width = (expected[1] - expected[0]) / 1.09375
    window = view(Film(*size), xfov=np.degrees(2 * np.arctan(width / 2)), shift=(0.1, 0.2)).window
    assert window == pytest.approx([each / 1.09375 for each in expected])


def test_an_orthographic_view_is_twice_xmag_wide():
    builder = room(camera=False)
    builder.orthographic_camera(width=6.0, shift=(0.1, 0.2))
    camera = resolved(builder).scene.camera
    assert camera.projection == "orthographic"
    assert camera.window == pytest.approx((-2.4, 3.6, -1.05, 3.45))  # Blender's view_frame() again


def test_yfov_alone_spans_the_height_and_both_make_pixels_that_are_not_square():
    text = room().tobytes().decode()
    xfov = text[text.index("<xfov") : text.index("</xfov>") + len("</xfov>")]
    high = np.tan(np.radians(30) / 2)
    only = resolved(text.replace(xfov, "<yfov>30</yfov>").encode()).scene.camera
    assert only.window == pytest.approx((-high * 4 / 3, high * 4 / 3, -high, high))
    both = resolved(text.replace(xfov, f"{xfov}<yfov>30</yfov>").encode()).scene.camera
    wide = np.tan(np.radians(20))
    assert both.window == pytest.approx((-wide, wide, -high, high))


def test_the_scale_of_a_camera_changes_nothing_but_its_sign():
    def orientation(scale, handedness):
        scene = room(camera=False)
        scene.camera(placement=Placement((1, 2, 3), (10, 20, 30), scale))
        return resolved(scene, settings=replace(SETTINGS, handedness=handedness)).scene.camera.to_world

    straight = orientation((1, 1, 1), "blender")
    np.testing.assert_allclose(straight[:3, :3] @ straight[:3, :3].T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(orientation((2, 3, 4), "blender"), straight, atol=1e-7)
    flipped = straight @ np.diag([-1, 1, 1, 1])
    np.testing.assert_allclose(orientation((-1, 1, 1), "blender"), flipped, atol=1e-7)
    np.testing.assert_allclose(orientation((1, 1, 1), "rtb3"), flipped, atol=1e-7)
    np.testing.assert_allclose(orientation((-2, 1, 1), "rtb3"), straight, atol=1e-7)


def test_a_camera_is_chosen_by_its_id_or_its_nodes():
    builder = room()
    builder.camera("Second", xfov=20.0)
    for name in ("Second", "Second-camera"):
        assert resolved(builder, settings=replace(SETTINGS, camera=name)).scene.camera.id == "Second"
    assert resolved(builder).scene.camera.id == "Camera"
    with pytest.raises(RecipeError, match="no camera is called Secnd, there are Second, Camera"):
        resolved(builder, settings=replace(SETTINGS, camera="Secnd"))


def test_clip_distances_are_in_metres():
    builder = SceneBuilder(meter=0.01)
    builder.plane("Wall", material="Paint")
    builder.camera(clip=(10, 1000))
    builder.point("Lamp")
    assert resolved(builder).scene.camera.clip == pytest.approx((0.1, 10))


# The old scenes, as they are.


def old_scene(name, mappings_file, condition, size):
    folder = old("ExampleScenes", name)
    document = Scene.read(folder / f"{name}.dae")
    mappings = read_mappings(mappings_file)
    adjustments = mappings.fill_in(condition, "tracer", document, in_folder(folder))
    return resolve(document, adjustments, SceneSettings(Film(*size), handedness="rtb3"), in_folder(folder))


def test_the_centres_of_the_coordinates_test_fall_on_their_pixels():
    row = next(iter(Conditions.single("CoordinatesTest")))
    scene = old_scene("CoordinatesTest", old("RenderData", "DefaultMappings.txt"), row, (320, 240)).scene
    found = {shape.id: pixel_of(scene.camera, scene.film, shape.to_world[:3, 3]) for shape in scene.shapes}
    expected = {
        "Icosphere_002-mesh": (234.1, 139.9),
        "Icosphere_003-mesh": (230.7, 17.3),
        "Icosphere_004-mesh": (157.7, 88.1),
        "Cube_003-mesh": (112.1, 34.5),
        "Cube_004-mesh": (125.0, 143.8),
        "Cube_005-mesh": (179.2, 86.2),
    }
    assert found.keys() == expected.keys()
    for name, pixel in expected.items():
        assert found[name] == pytest.approx(pixel, abs=0.1)


def test_our_own_axes_fall_on_the_same_pixels():
    """The camera of the old CoordinatesTest about spheres of ours, unmirrored."""
    columns = np.array(
        [[0.75441, 0.63302, -0.17365], [-0.65612, 0.73502, -0.17101], [0.01938, 0.24295, 0.96985]]
    )
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = columns.T, (2, 2, 25)
    builder = SceneBuilder()
    for axis, name in enumerate("XYZ"):
        builder.sphere(name, placement=Placement(tuple(10.0 * (k == axis) for k in range(3))))
    builder.camera(xfov=77.31962, placement=matrix)
    builder.point("Lamp")
    scene = resolved(builder).scene
    found = [pixel_of(scene.camera, scene.film, shape.to_world[:3, 3]) for shape in scene.shapes]
    np.testing.assert_allclose(found, [(234.1, 139.9), (230.7, 17.3), (157.7, 88.1)], atol=0.1)


def test_the_square_of_the_simple_square_covers_its_pixels():
    folder = old("ExampleScenes", "SimpleSquare")
    rows = read_conditions(folder / "SimpleSquareConditions.txt", "SimpleSquare")
    found = old_scene("SimpleSquare", folder / "SimpleSquareMappings.txt", rows.rows[3], (50, 50))
    scene = found.scene
    left, top = pixel_of(scene.camera, scene.film, (-1, 1, 0))
    right, bottom = pixel_of(scene.camera, scene.film, (1, -1, 0))
    assert abs(right - left) == pytest.approx(43.75, abs=1e-3)
    assert bottom - top == pytest.approx(43.75, abs=1e-3)
    # mccBabel-4.spd, the white patch, comes from the library: another measurement of the same chart.
    material = scene.materials[scene.shapes[0].material]
    assert material.parameters["diffuseReflectance"].at(520) == pytest.approx(0.9082, abs=5e-3)
    assert any("mccBabel-4.spd is not in the recipe's folder" in each for each in found.warnings)


RADIANCE_TEST = {
    # name: light at, disc radius, camera y and z, its turn, reflector's turn
    "reference": (110, 0.01, (5, 5), -45, 0),
    "2xFarLight": (210, 0.01, (5, 5), -45, 0),
    "2xFarCamera": (110, 0.01, (10, 10), -45, 0),
    "rotateReflector": (110, 0.01, (5, 5), -45, -41.4),
    "rotateCamera": (110, 0.01, (1.23, 6.96), -10, 0),
    "sparseSpectrum": (110, 0.01, (5, 5), -45, 0),
    "unitAreaLight": (None, 0.5642, (5, 5), -45, 0),
    "halfAreaLight": (None, 0.3989, (5, 5), -45, 0),
}


@pytest.mark.parametrize("name", RADIANCE_TEST)
def test_the_old_radiance_test_stands_where_it_stood(name):
    light, radius, place, turn, tilt = RADIANCE_TEST[name]
    folder = old("ExampleScenes", "RadianceTest")
    row = read_conditions(folder / "RadianceTestConditions.txt", "RadianceTest")[name]
    found = old_scene("RadianceTest", folder / "RadianceTestMappings.txt", row, (100, 100))
    check_radiance_test(found.scene, light, radius, place, turn, tilt)
    assert found.extras == ()


@pytest.mark.parametrize("name", RADIANCE_TEST)
def test_a_radiance_test_of_ours_stands_where_its_mappings_put_it(name):
    light, radius, place, turn, tilt = RADIANCE_TEST[name]
    cells = {"distance": str((light or 110) - 10), "y": str(place[0]), "z": str(place[1]), "turn": str(turn)}
    cells |= {"radius": str(radius), "tilt": str(tilt), "groupName": "point" if light else "area"}
    found = resolved(
        own_radiance_test(), OWN_MAPPINGS, SceneSettings(Film(100, 100)), condition=Condition(name, cells)
    )
    check_radiance_test(found.scene, light, radius, place, turn, tilt)


OWN_MAPPINGS = """
Collada {
    Camera:translate|sid=location = 0 (y) (z)
    Camera:rotate|sid=rotationX = 1 0 0 (turn)
    Point:translate|sid=location += 0 0 (distance)
    Disc:translate|sid=location += 0 0 (distance)
    Disc:translate|sid=location += 0 0 0.1
    Disc:scale|sid=scale = (radius) (radius) 1
    Square:rotate|sid=rotationX = 1 0 0 (tilt)
}
Generic {
    White-material:material:matte
    White-material:diffuseReflectance.spectrum = 300:1 800:1
    Black-material:material:matte
    Black-material:diffuseReflectance.spectrum = 300:0 800:0
}
Generic point {
    Point-light:light:point
    Point-light:intensity:spectrum = 300:1 800:1
}
Generic area {
    Point-light:light:point
    Point-light:intensity:spectrum = 300:0 800:0
    Disc-mesh:light:area
    Disc-mesh:intensity.spectrum = 300:1 800:1
}
"""


def own_radiance_test():
    builder = SceneBuilder()
    builder.plane("Square", material="White")
    around = np.arange(32) * np.pi / 16
    rim = np.column_stack([np.cos(around), np.sin(around), np.zeros(32)])
    triangles = np.column_stack([np.zeros(32), 1 + np.arange(32), 1 + (np.arange(32) + 1) % 32]).astype(int)
    turned = Placement((0, 0, 10), (180, 0, 0))
    builder.mesh("Disc", np.vstack([np.zeros(3), rim]), triangles, material="Black", placement=turned)
    builder.point("Point", placement=Placement((0, 0, 10)))
    builder.camera(xfov=49.13434)
    return builder


def check_radiance_test(scene, light, radius, place, turn, tilt):
    square, disc = scene.shapes
    heights = [lamp.to_world[2, 3] for lamp in scene.lights]
    assert heights == pytest.approx([light] if light else [])
    tilted = np.radians(tilt)
    np.testing.assert_allclose(world_area(square), [0, -4 * np.sin(tilted), 4 * np.cos(tilted)], atol=1e-5)
    np.testing.assert_allclose(world_area(disc), [0, 0, -3.121445 * radius**2], atol=1e-5 * radius**2)
    assert disc.to_world[2, 3] == pytest.approx((light or 110) + 0.1)
    assert (disc.emission is not None) == (light is None)
    assert len(disc.mesh.vertices) == 33
    camera = scene.camera
    np.testing.assert_allclose(camera.to_world[:3, 3], [0, *place], atol=1e-9)
    turned = np.radians(turn)
    np.testing.assert_allclose(-camera.to_world[:3, 2], [0, np.sin(turned), -np.cos(turned)], atol=1e-6)
    np.testing.assert_allclose(camera.to_world[:3, 0], [1, 0, 0], atol=1e-6)
    half = np.tan(np.radians(49.13434) / 2)
    assert camera.window == pytest.approx((-half, half, -half, half))
    white = scene.materials[square.material].parameters["diffuseReflectance"]
    assert white.values.tolist() == [1, 1]


@pytest.mark.parametrize(
    ("folder", "name", "shapes"),
    [
        ("ExampleScenes/MaterialSphere", "MaterialSphere", 1),
        ("ExampleScenes/ScalingTest", "ScalingTest", 1),
        ("ExampleScenes/ColladaTexture", "ColladaTexture", 2),
        ("Utilities/SpectralPromotion", "SpectralPromotion", 1),
        ("recovered-old-versions/ExampleScenes/SimpleSphere", "SimpleSphere", 1),
        ("recovered-old-versions/ExampleScenes/SpectralIllusion", "SpectralIllusion", 27),
    ],
)
def test_every_other_old_scene_can_be_read(folder, name, shapes):
    document = Scene.read(old(folder, f"{name}.dae"))
    found = resolve(document, Adjustments(), SETTINGS, nothing)
    assert len(found.scene.shapes) == shapes
    assert len({shape.id for shape in found.scene.shapes}) == shapes
    assert found.warnings


# Materials.


def test_a_material_without_a_mapping_keeps_its_colour_and_says_so():
    builder = room()
    builder.material("Red", (0.8, 0.1, 0.2))
    builder.plane("Other", material="Red")
    found = resolved(builder)
    red = found.scene.materials["Red-material"]
    assert red.model == "matte"
    assert red.parameters["diffuseReflectance"].at([430, 545, 650]) == pytest.approx([0.2, 0.1, 0.8])
    assert (
        "Red-material has no mapping: its colour 0.8 0.1 0.2 was promoted to a reflectance" in found.warnings
    )


def test_a_declared_material_has_what_it_says_and_the_defaults():
    lines = ("Paint-material:material:anisoward", "Paint-material:alphaU.float = 0.25")
    material = resolved(room(), generic(*lines)).scene.materials["Paint-material"]
    assert material.model == "anisoward"
    assert material.parameters["alphaU"] == 0.25
    assert material.parameters["alphaV"] == 0.1
    assert material.parameters["variant"] == "ward"
    assert material.parameters["diffuseReflectance"].values.tolist() == [0.5, 0.5]


def test_declaring_again_begins_anew_and_configuring_again_does_not():
    first = generic("Paint-material:material:anisoward", "Paint-material:alphaU.float = 0.25")
    more = generic("Paint-material:alphaV.float = 0.3")
    anew = generic("Paint-material:material:anisoward", "Paint-material:alphaV.float = 0.3")

    def alphas(text):
        parameters = resolved(room(), text).scene.materials["Paint-material"].parameters
        return parameters["alphaU"], parameters["alphaV"]

    assert alphas(first + more) == (0.25, 0.3)
    assert alphas(first + anew) == (0.1, 0.3)
    said = "mappings.txt:6: Paint-material is declared again, so alphaU of line 2 no longer counts"
    assert said in resolved(room(), first + anew).warnings
    assert not any("declared again" in each for each in resolved(room(), first + more).warnings)


@pytest.mark.parametrize("text", ["paint.spd", "300:0.25 800:0.75"])
def test_a_spectrum_is_a_file_or_a_text(tmp_path, text):
    (tmp_path / "paint.spd").write_text("300 0.25\n800 0.75\n")
    lines = ("Paint-material:material:matte", f"Paint-material:diffuseReflectance.spectrum = {text}")
    scene = resolved(room(), generic(*lines), find_file=in_folder(tmp_path)).scene
    assert scene.materials["Paint-material"].parameters["diffuseReflectance"].at(550) == pytest.approx(0.5)


def test_a_texture_is_used_by_its_id():
    lines = (
        "Paint-material:material:matte",
        "Paint-material:diffuseReflectance.texture = checks",
        "checks:spectrumTexture:checkerboard",
        "checks:checksPerU.float = 8",
    )
    scene = resolved(room(), generic(*lines)).scene
    assert scene.materials["Paint-material"].parameters["diffuseReflectance"].texture == "checks"
    assert scene.textures["checks"].kind == "checkerboard"
    assert scene.textures["checks"].parameters["checksPerU"] == 8


METAL = ("Paint-material:eta.spectrum = 300:1", "Paint-material:k.spectrum = 300:1")
BUMPS = (
    "checks:floatTexture:checkerboard",
    "Bumps:material:bumpmap",
    "Bumps:materialID.string = Paint-material",
    "Bumps:textureID.string = checks",
)


@pytest.mark.parametrize("lines", [BUMPS, ("Paint-material:material:metal", *METAL, *BUMPS)])
def test_bumps_go_around_the_material_that_they_name(lines):
    found = resolved(room(), generic(*lines))
    (shape,) = found.scene.shapes
    outer = found.scene.materials[shape.material]
    assert (outer.id, outer.model, outer.parameters["scale"]) == ("Paint-material", "bumpmap", 1)
    inner = found.scene.materials[outer.parameters["materialID"]]
    assert (inner.id, inner.model) == ("Paint-material-inner", "metal" if len(lines) > 4 else "matte")
    assert outer.parameters["textureID"] in found.scene.textures
    assert not any("material of nothing" in each for each in found.warnings)


def test_bumps_that_are_a_shapes_own_material_leave_others_flat():
    builder = room()
    builder.plane("Floor", 2, 2, "Bumps")
    lines = (each.replace("Bumps:", "Bumps-material:") for each in BUMPS)
    scene = resolved(builder, generic(*lines)).scene
    assert [scene.materials[each.material].model for each in scene.shapes] == ["matte", "bumpmap"]
    assert scene.materials["Bumps-material"].parameters["materialID"] == "Paint-material"


MATTE = "Paint-material:material:matte"


@pytest.mark.parametrize(
    ("lines", "line", "words"),
    [
        (["Paint-material:material:mate"], 2, "no material is called mate, want one of matte, "),
        (["Paint-material:stuff:matte"], 2, "is declared a stuff, want one of .*material"),
        (
            [MATTE, "Paint-material:diffuseReflectanse.spectrum = 1"],
            3,
            "matte has no diffuseReflectanse, it has diff",
        ),
        (
            [MATTE, "Paint-material:diffuseReflectance.spectrum = nosuch.spd"],
            3,
            "there is no spectrum file nosuch.spd",
        ),
        (
            [MATTE, "Paint-material:diffuseReflectance.spectrum = bright"],
            3,
            "no wavelength:value pair|no number",
        ),
        ([MATTE, "Paint-material:diffuseReflectance.texture = wood"], 2, "uses a texture wood, declare it"),
        (["Paint-material:diffuseReflectance.spectrum = 300:1"], 2, "is not declared, add .*:material:matte"),
        (
            ["Paint-material:material:anisoward", "Paint-material:alphaU.float = few"],
            3,
            "alphaU is 'few', want one number",
        ),
        (["Paint-material:material:metal", "Paint-material:k = Xx.k.spd"], 3, "no spectrum file Xx.k.spd"),
        (["Paint-material:material:bumpmap"], 2, "Paint-material must say its materialID"),
        (["Lamp-light:light:pont"], 2, "no light is called pont, want one of point"),
        (
            ["Lampe-light:light:point"],
            2,
            "no light in the scene has the id Lampe-light, there are Lamp-light",
        ),
        (["Wal-mesh:light:area"], 2, "no mesh in the scene has the id Wal-mesh, there are Wall-mesh"),
        (
            ["Lamp-light:light:area"],
            2,
            "Lamp-light is a lamp, declare the mesh that emits: Lamp-mesh:light:area",
        ),
        (["Lamp-light:material:matte"], 2, "Lamp-light is a light of the parent scene, declare it a light"),
        (
            ["Paint-material:light:point"],
            2,
            "Paint-material is the material of a shape|no light in the scene",
        ),
        (["sky:light:environment", "more:light:environment"], 3, "more is a second environment, beside sky"),
    ],
)
def test_what_is_wrong_in_a_block_is_said_with_its_place_and_what_would_be_right(lines, line, words):
    with pytest.raises(RecipeError, match=rf"^mappings.txt:{line}: .*({words})"):
        resolved(room(), generic(*lines))


def test_a_missing_file_says_where_it_was_looked_for():
    lines = (MATTE, "Paint-material:diffuseReflectance.spectrum = resources/nosuch.spd")
    with pytest.raises(
        RecipeError, match="in the recipe's folder or its resources/, and the library serves none"
    ):
        resolved(room(), generic(*lines))


def test_a_reflectance_above_one_is_said():
    lines = (MATTE, "Paint-material:diffuseReflectance.spectrum = 300:1.78 800:0.1")
    assert any(
        "diffuseReflectance of Paint-material reaches 1.78" in each
        for each in resolved(room(), generic(*lines)).warnings
    )


def test_a_material_of_nothing_is_said():
    found = resolved(room(), generic("Pant-material:material:matte"))
    assert "mappings.txt:2: Pant-material is the material of nothing in the scene" in found.warnings


def test_an_object_without_material_is_grey_and_said():
    text = room().tobytes().decode().replace('material="Paint-material"', "").encode()
    found = resolved(text)
    assert found.scene.shapes[0].material == "no-material"
    assert "the object Wall has no material and becomes grey" in found.warnings
    declared = resolved(text, generic("no-material:material:matte", "no-material:diffuseReflectance = 1"))
    assert declared.scene.materials["no-material"].parameters["diffuseReflectance"].at(500) == 1


def test_a_metal_is_copper_unless_it_says_another(tmp_path):
    for name in ("Cu.eta.spd", "Cu.k.spd"):
        (tmp_path / name).write_text("300 0.2\n800 0.3\n")
    scene = resolved(room(), generic("Paint-material:material:metal"), find_file=in_folder(tmp_path)).scene
    metal = scene.materials["Paint-material"]
    assert metal.parameters["eta"].at(550) == pytest.approx(0.25)
    assert metal.parameters["roughness"] == 0.4


def test_metals_that_the_recipe_has_no_files_of_are_the_librarys():
    found = resolved(room(), generic("Paint-material:material:metal", "Paint-material:k = Ag.k.spd"))
    metal = found.scene.materials["Paint-material"].parameters
    assert (metal["eta"].at(582.1), metal["k"].at(582.1)) == (0.7, 3.858)  # Johnson and Christy 1972
    assert any("Cu.eta.spd is not in the recipe's folder" in each for each in found.warnings)


@pytest.mark.parametrize("symbol", ["Paint", "Paint-material"])
def test_very_old_files_bind_materials_by_their_names(symbol):
    text = (
        room()
        .tobytes()
        .decode()
        .replace('triangles material="Paint-material"', f'triangles material="{symbol}"')
    )
    bound = text[text.index("<bind_material>") : text.index("</bind_material>") + len("</bind_material>")]
    for version in (text, text.replace(bound, "")):
        assert resolved(version.encode()).scene.shapes[0].material == "Paint-material"


# Lights.


def test_a_lamp_without_a_mapping_shines_with_its_colour_and_says_so():
    found = resolved(room())
    (lamp,) = found.scene.lights
    assert lamp.kind == "point"
    assert lamp.parameters["intensity"].unit == "W sr-1 nm-1"
    assert lamp.parameters["intensity"].at(550) == 1
    assert lamp.parameters["radius"] == 0
    assert (
        "Lamp-light has no mapping: its colour 1 1 1 was promoted to its intensity [W sr-1 nm-1]"
        in found.warnings
    )


def test_a_spot_keeps_its_cone_and_may_be_told_another():
    builder = room(lamp=False)
    builder.spot("Lamp", cone=30.0)
    declared = ("Lamp-light:light:spot", "Lamp-light:intensity.spectrum = 300:2")
    (lamp,) = resolved(builder, generic(*declared)).scene.lights
    assert lamp.parameters["cone"] == pytest.approx(30)
    (lamp,) = resolved(builder, generic(*declared, "Lamp-light:cone.float = 60")).scene.lights
    assert lamp.parameters["cone"] == 60


def test_a_sun_is_measured_in_irradiance():
    builder = room(lamp=False)
    builder.sun("Sun", placement=Placement((0, 0, 9), (0, 90, 0)))
    (sun,) = resolved(
        builder, generic("Sun-light:light:directional", "Sun-light:intensity.spectrum = 300:2")
    ).scene.lights
    assert sun.parameters["intensity"].unit == "W m-2 nm-1"
    np.testing.assert_allclose(-sun.to_world[:3, 2], [-1, 0, 0], atol=1e-12)


def test_an_area_light_is_every_part_of_its_mesh_wherever_it_stands():
    builder = room(lamp=False)
    builder.instance("Twin", "Wall", Placement((3, 0, 0)))
    lines = ("Wall-mesh:light:area", "Wall-mesh:intensity.spectrum = 300:2 800:2")
    shapes = resolved(builder, generic(*lines)).scene.shapes
    assert [shape.id for shape in shapes] == ["Wall-mesh_0", "Wall-mesh_1"]
    assert all(shape.emission is not None and shape.emission.unit == "W sr-1 m-2 nm-1" for shape in shapes)


def test_an_environment_lights_a_scene_without_lamps():
    lines = ("sky:light:environment", "sky:intensity.spectrum = 300:0.5 800:0.5")
    scene = resolved(room(lamp=False), generic(*lines)).scene
    assert scene.environment is not None
    assert scene.environment.kind == "environment"
    assert scene.environment.parameters["intensity"].at(500) == 0.5


def test_a_lamp_that_is_off_is_left_out():
    builder = room()
    builder.point("Dark")
    scene = resolved(
        builder, generic("Dark-light:light:point", "Dark-light:intensity.spectrum = 300:0 800:0")
    ).scene
    assert [lamp.id for lamp in scene.lights] == ["Lamp-light"]


def test_when_every_light_is_off_the_black_picture_is_announced():
    lines = ("Lamp-light:light:point", "Lamp-light:intensity.spectrum = 300:0 800:0")
    found = resolved(room(), generic(*lines))
    assert "every light is off in this condition, its picture will be black" in found.warnings
    assert len(found.scene.lights) == 1


def test_an_emission_without_a_mapping_shines_and_says_so():
    text = room(lamp=False).tobytes().decode().replace(">0 0 0 1<", ">0.2 0.4 0.6 1<")
    found = resolved(text.encode())
    emission = found.scene.shapes[0].emission
    assert emission is not None
    assert emission.at(545) == pytest.approx(0.4)
    assert any("its emission 0.2 0.4 0.6 was promoted to a radiance" in each for each in found.warnings)


def test_ambient_light_is_left_out_and_said():
    text = room().tobytes().decode()
    start, end = text.index("<point>"), text.index("</point>") + len("</point>")
    ambient = "<ambient><color>1 1 1</color></ambient>"
    builder_text = (text[:start] + ambient + text[end:]).encode()
    with pytest.raises(RecipeError, match="the scene has no light"):
        resolved(builder_text)


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ({"camera": False}, "parent.dae: the scene has no camera, add one"),
        ({"lamp": False}, "parent.dae: the scene has no light, add a lamp"),
    ],
)
def test_a_scene_without_camera_or_light_is_refused(parts, words):
    with pytest.raises(RecipeError, match=words):
        resolved(room(**parts))


# The rest.


def test_native_lines_travel_beside_the_scene():
    text = "Mitsuba {\nintegrator:integrator:path\n}\nGeneric {\nPaint-material:bsdf:roughplastic\n}\n"
    found = resolved(room(), text)
    assert [line.text for line in found.extras] == [
        "integrator:integrator:path",
        "Paint-material:bsdf:roughplastic",
    ]
    assert not any("Paint-material has no mapping" in each for each in found.warnings)


def test_resolving_an_adjusted_document_adjusts_it_once():
    document = Scene.parse(room().tobytes(), "parent.dae")
    mappings = parse_mappings("Collada {\nLamp:translate += 0 0 1\n}\n", "mappings.txt")
    adjustments = mappings.fill_in(next(iter(Conditions.single("one"))), "tracer", document, nothing)
    for scene in (document, document.adjusted(adjustments)):
        assert resolve(scene, adjustments, SETTINGS, nothing).scene.lights[0].to_world[2, 3] == 4


def test_resolving_twice_gives_the_same_bytes():
    meshes = [[each.mesh.digest for each in resolved(room()).scene.shapes] for _ in range(2)]
    assert meshes[0] == meshes[1]


def test_an_object_with_a_skeleton_is_left_out_and_said():
    controller = '<library_controllers><controller id="Rig"/></library_controllers>'
    node = '<node id="Arm"><instance_controller url="#Rig"/></node>'
    found = resolved(with_nodes(CAMERA + LAMP + wall() + node, library=controller))
    assert "Arm follows a skeleton or morph and is left out" in found.warnings


def test_links_that_lead_nowhere_are_errors():
    text = room().tobytes().decode()
    for link, words in (("#Wall-mesh", "no geometry #Gone"), ("#Lamp-light", "no light #Gone")):
        with pytest.raises(RecipeError, match=words):
            resolved(text.replace(f'url="{link}"', 'url="#Gone"').encode())


def test_a_material_without_an_effect_is_grey():
    text = room().tobytes().decode()
    start = text.index("<instance_effect")
    bare = text[:start] + text[text.index("/>", start) + 2 :]
    assert (
        resolved(bare.encode())
        .scene.materials["Paint-material"]
        .parameters["diffuseReflectance"]
        .values.tolist()
        == [0.5] * 4
    )
