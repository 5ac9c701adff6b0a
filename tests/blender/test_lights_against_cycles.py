"""The closed forms of Blender's lamps, each against a patch or a lamp that Cycles renders."""

import math

import bpy
import numpy as np
import pytest

TOLERANCE = 0.002
FAR = 10.0  # [m] from a lamp to the patch
REFLECTANCE = 0.5


@pytest.fixture
def cycles(scene, tmp_path):
    """Return how to render the scene: mean linear red, green, blue, and the standard error of the mean."""
    render, engine = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.dither_intensity = 0
    engine.use_adaptive_sampling = engine.use_denoising = False
    engine.sample_clamp_direct = engine.sample_clamp_indirect = 0
    engine.light_sampling_threshold = 0
    engine.pixel_filter_type, engine.samples, engine.max_bounces = "BOX", 32, 0
    scene.view_settings.view_transform = "Raw"
    scene.world = None
    settings = render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"
    render.filepath = str(tmp_path / "cycles.exr")

    def rendered():
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(render.filepath)
        image.colorspace_settings.name = "Non-Color"
        pixels = np.array(image.pixels).reshape(-1, 4)[:, :3]
        bpy.data.images.remove(image)
        return pixels.mean(axis=0), pixels.std(axis=0) / math.sqrt(len(pixels))

    return rendered


@pytest.fixture
def patch(scene, put):
    """A small white patch at the origin that fills the picture of a camera above it."""
    mesh = bpy.data.meshes.new("Patch")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new("White")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse, output = (tree.nodes.new(name) for name in ("ShaderNodeBsdfDiffuse", "ShaderNodeOutputMaterial"))
    diffuse.inputs["Color"].default_value = (REFLECTANCE, REFLECTANCE, REFLECTANCE, 1)
    diffuse.inputs["Roughness"].default_value = 0
    tree.links.new(diffuse.outputs[0], output.inputs[0])
    mesh.materials.append(material)
    look(scene, (0, 0, 1))
    return put("Patch", mesh)


def look(scene, location, up=False, width=0.001):
    """Let the camera see a little of what is below it, or above it."""
    scene.camera.location = location
    scene.camera.rotation_euler = (math.pi if up else 0, 0, 0)
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", width


def assert_same(rendered, wanted):
    mean, error = rendered
    assert (error < TOLERANCE / 4 * mean).all(), "too noisy to tell"
    np.testing.assert_allclose(mean, wanted, rtol=TOLERANCE)


def shines(library, light, meter=1.0):
    """Return what the library makes of a lamp: colour times watts times the closed form, and the lamp."""
    read = library("blender.lamps").read_lamp(light, meter)
    return np.array(read.colour) * read.watts * read.factor, read


@pytest.mark.parametrize("kind", ["POINT", "SPOT"])
@pytest.mark.parametrize("radius", [0.0, 0.1])
@pytest.mark.parametrize("normalize", [True, False])
def test_radiant_intensity_of_point_and_spot_lamps(patch, lamp, cycles, library, kind, radius, normalize):
    light = lamp(kind, location=(0, 0, FAR), energy=300, shadow_soft_size=radius, normalize=normalize).data
    light.color, light.exposure = (1.0, 0.5, 0.25), 0.5
    intensity, read = shines(library, light)
    assert read.numbers["radius"] == pytest.approx(radius)
    assert_same(cycles(), intensity * REFLECTANCE / (math.pi * FAR**2))


def test_a_point_lamp_with_a_radius_has_the_radiance_of_a_sphere_of_that_intensity(
    scene, lamp, cycles, library
):
    placed = lamp("POINT", location=(0, 0, FAR), energy=300, shadow_soft_size=0.5)
    placed.visible_camera = True
    look(scene, (0, 0, 0), up=True)
    intensity, read = shines(library, placed.data)
    assert_same(cycles(), intensity / (math.pi * read.numbers["radius"] ** 2))


def test_the_temperature_of_a_lamp_tints_its_colour(patch, lamp, cycles, library):
    light = lamp("POINT", location=(0, 0, FAR), energy=300, shadow_soft_size=0).data
    light.use_temperature, light.temperature, light.color = True, 3000, (1.0, 0.5, 0.25)
    intensity, _ = shines(library, light)
    assert_same(cycles(), intensity * REFLECTANCE / (math.pi * FAR**2))


@pytest.mark.parametrize("part", [0.0, 0.5, 0.8, 0.9, 0.97])
@pytest.mark.parametrize("blend", [0.15, 1.0])
def test_the_soft_edge_of_spot_lamps(patch, lamp, cycles, library, part, blend):
    cone = math.radians(60)
    placed = lamp(
        "SPOT", location=(0, 0, FAR), energy=300, shadow_soft_size=0, spot_size=cone, spot_blend=blend
    )
    placed.rotation_euler = (part * cone / 2, 0, 0)
    intensity, read = shines(library, placed.data)
    assert (read.numbers["cone"], read.numbers["blend"]) == pytest.approx((60, blend))
    edge = library("blender.lights").smooth_edge(math.cos(part * cone / 2), cone, blend)
    assert edge > 0
    assert_same(cycles(), intensity * edge * REFLECTANCE / (math.pi * FAR**2))


@pytest.mark.parametrize("degrees", [0.0, 0.5, 20.0])
@pytest.mark.parametrize("normalize", [True, False])
def test_irradiance_of_the_sun(patch, lamp, cycles, library, degrees, normalize):
    light = lamp("SUN", energy=3, angle=math.radians(degrees), normalize=normalize, exposure=-1).data
    irradiance, read = shines(library, light)
    assert read.numbers["angle"] == pytest.approx(degrees, abs=1e-5)
    # A disc of half angle a straight above sends pi sin^2 a times its radiance; our E is that of the disc.
    assert_same(cycles(), irradiance * REFLECTANCE / math.pi)


@pytest.mark.parametrize("shape", ["SQUARE", "RECTANGLE", "DISK", "ELLIPSE"])
@pytest.mark.parametrize("normalize", [True, False])
def test_radiance_of_area_lamps(scene, lamp, cycles, library, shape, normalize):
    placed = lamp(
        "AREA", location=(0, 0, FAR), energy=50, shape=shape, size=0.8, size_y=0.4, normalize=normalize
    )
    placed.scale, placed.visible_camera = (2.0, 1.5, 1.0), True
    look(scene, (0, 0, 0), up=True, width=0.01)
    assert_same(cycles(), radiance_in_recipe(scene, library))


def test_power_of_a_far_area_lamp(patch, lamp, cycles, library, scene):
    lamp("AREA", location=(0, 0, FAR), energy=50, shape="ELLIPSE", size=0.04, size_y=0.02)
    radiance = radiance_in_recipe(scene, library)
    area = math.pi * 0.04 * 0.02 / 4
    assert_same(cycles(), radiance * area * REFLECTANCE / (math.pi * FAR**2))


def radiance_in_recipe(scene, library) -> float:
    """Return the band of the recipe's area lamp, undoing what spreads its watts over the wavelengths."""
    recipe = library("blender").read_recipe(scene)
    assert "Lamp-mesh:light:area" in recipe.mappings
    lines = recipe.resources["Lamp.spd"].decode().splitlines()
    return float(lines[0].split()[1]) * (830 - 360)


def test_radiance_of_emitting_meshes(scene, box, cycles, library):
    shining = box("Shining", material="Glow", location=(0, 0, FAR), scale=(0.5, 0.7, 0.3))
    material = bpy.data.materials["Glow"]
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    emission, output = (tree.nodes.new(name) for name in ("ShaderNodeEmission", "ShaderNodeOutputMaterial"))
    emission.inputs["Strength"].default_value = 7
    tree.links.new(emission.outputs[0], output.inputs[0])
    look(scene, (0, 0, 0), up=True, width=0.01)
    shining.rtb.emits, shining.rtb.spectrum, shining.rtb.amount = True, "1", 7
    text = library("blender").read_recipe(scene).resources["Shining.spd"].decode()
    assert_same(cycles(), float(text.split()[1]))


def test_watts_of_an_emitting_mesh_leave_it_as_from_an_area_lamp(scene, box, lamp, library):
    lamp("AREA", energy=50, shape="SQUARE", size=2.0)
    shining = box("Shining", scale=(1.0, 1.0, 1.0))
    shining.rtb.emits, shining.rtb.spectrum, shining.rtb.emission, shining.rtb.amount = (
        True,
        "1",
        "watts",
        300,
    )
    resources = library("blender").read_recipe(scene).resources
    side, cube = (float(resources[name].decode().split()[1]) for name in ("Lamp.spd", "Shining.spd"))
    assert cube == pytest.approx(side, rel=1e-5)


def test_lengths_become_metres_and_watts_stay(scene, lamp, library):
    scene.unit_settings.scale_length = 0.01
    lamp("AREA", energy=50, shape="SQUARE", size=2.0)
    lamp("POINT", name="Ball", energy=50, shadow_soft_size=5.0)
    recipe = library("blender").read_recipe(scene)
    assert b'meter="0.01"' in recipe.parent
    assert "Ball-light:radius.float = 0.05\n" in recipe.mappings
    values = [float(recipe.resources[name].decode().split()[1]) * 470 for name in ("Lamp.spd", "Ball.spd")]
    assert values == pytest.approx([50 / (math.pi * 0.02**2), 50 / (4 * math.pi)], rel=1e-6)
