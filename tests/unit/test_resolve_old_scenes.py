"""Old parent scenes, and ours like them, stand where they stood."""

import numpy as np
import pytest

from rtb_addon.conditions import Condition, Conditions, read_conditions
from rtb_addon.mappings import read_mappings
from rtb_addon.scene.adjustments import Adjustments
from rtb_addon.scene.build import Placement, SceneBuilder
from rtb_addon.scene.document import Scene
from rtb_addon.scene.render_scene import Film
from rtb_addon.scene.resolve import SceneSettings, resolve
from tests.unit.small_rooms import SETTINGS, in_folder, nothing, old, pixel_of, resolved, world_area

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
