"""Pictures all around and lenses of some width: what becomes of Blender's, beside Cycles' pictures."""

import math

import bpy
import numpy as np
import pytest
from mathutils import Euler

import rtb_addon as rtb

WIDTH, HEIGHT = 32, 16


def sky_of(path, pixels) -> bpy.types.Image:
    """Return an equirectangular image, saved as an EXR of linear numbers."""
    height, width, _ = pixels.shape
    image = bpy.data.images.new(path.stem, width, height, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    image.pixels = np.concatenate([pixels, np.ones((height, width, 1))], axis=2).ravel().tolist()
    image.filepath_raw, image.file_format = str(path), "OPEN_EXR"
    image.save()
    return image


@pytest.fixture
def sky(scene, tmp_path):
    """A smooth sky of greys, brighter where the numbers are higher, in the world's nodes and in its tags."""
    u, v = np.meshgrid((np.arange(WIDTH) + 0.5) / WIDTH, (np.arange(HEIGHT) + 0.5) / HEIGHT)
    # At the poles, where Cycles goes on at the other one, all is alike.
    up = np.sin(np.pi * v)
    grey = 0.5 + 0.3 * np.cos(2 * np.pi * u + 0.7) * up + 0.3 * np.sin(2 * np.pi * v) * up**2
    image = sky_of(tmp_path / "sky.exr", np.repeat(grey[..., None], 3, axis=2))
    world = scene.world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    tree = world.node_tree
    background = next(node for node in tree.nodes if node.type == "BACKGROUND")
    source, mapping, place = (
        tree.nodes.new(f"ShaderNode{name}") for name in ("TexEnvironment", "Mapping", "TexCoord")
    )
    source.image, background.inputs["Strength"].default_value = image, 1.5
    mapping.inputs["Rotation"].default_value = (0.3, -0.2, 0.8)
    tree.links.new(place.outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs["Vector"], source.inputs["Vector"])
    tree.links.new(source.outputs["Color"], background.inputs["Color"])
    return world


def rendered_by_cycles(scene, path, samples=64) -> np.ndarray:
    """Return Cycles' picture of the first component, from the lowest row up."""
    scene.render.engine, scene.cycles.samples = "CYCLES", samples
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type, scene.view_settings.view_transform = "BOX", "Raw"
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    return np.array(image.pixels).reshape(height, width, 4)[..., 0]


def rendered_by(renderer, scene, library, folder) -> np.ndarray:
    """Return a renderer's picture in one band, from the lowest row up."""
    settings = scene.rtb
    settings.bands_start, settings.bands_step, settings.bands_count = 550, 10, 1
    made = library("blender").read_recipe(scene).save(folder)
    (rendering,) = rtb.execute_recipe(made, renderer=renderer)
    return rendering.image.radiance[::-1, :, 0]


@pytest.mark.parametrize("renderer", ["mitsuba", "tracer"])
def test_a_sky_is_promoted_from_the_nodes_and_stands_where_cycles_shows_it(
    scene, sky, library, tmp_path, renderer
):
    bpy.ops.rtb.use_spectra(thing="WORLD")
    assert (sky.rtb.kind, sky.rtb.image.name, sky.rtb.amount) == ("IMAGE", "sky", 1.5)
    camera = scene.camera
    camera.data.angle = math.radians(100)
    scene.render.resolution_x, scene.render.resolution_y, scene.rtb.samples = 24, 16, 16
    for turn in ((1.3, 0.2, 0.4), (2.5, 0.0, -2.0)):
        camera.rotation_euler = turn
        cycles = rendered_by_cycles(scene, tmp_path / "cycles.exr")
        ours = rendered_by(renderer, scene, library, tmp_path / f"{turn[0]}")
        assert np.ptp(cycles) > 0.2, "there is something to see"
        np.testing.assert_allclose(ours, cycles, atol=0.012)


def test_a_turned_sky_is_written_as_blenders_rotation(scene, sky, resolved, put, lamp):
    lamp()
    bpy.ops.rtb.use_spectra(thing="WORLD")
    sky.rtb.rotation = (0.1, 0.2, 0.3)
    found = resolved(scene).environment
    np.testing.assert_allclose(
        found.to_world[:3, :3], np.array(Euler((0.1, 0.2, 0.3)).to_matrix()), atol=1e-6
    )
    np.testing.assert_allclose(found.parameters["intensity"].values, 1.5)
    assert found.parameters["filename"].endswith("sky.exr")


def test_the_sun_stands_where_its_elevation_and_azimuth_say(scene, lamp, resolved):
    lamp()
    world = scene.world = bpy.data.worlds.new("Sky")
    settings = world.rtb
    settings.use_spectra, settings.kind, settings.turbidity = True, "SUNSKY", 4.5
    settings.elevation, settings.azimuth = math.radians(30), math.radians(20)
    found = resolved(scene).environment
    assert (found.kind, found.parameters["turbidity"]) == ("sunsky", 4.5)
    towards = (
        math.cos(math.radians(30)) * math.cos(math.radians(20)),
        math.cos(math.radians(30)) * math.sin(math.radians(20)),
        0.5,
    )
    np.testing.assert_allclose(found.to_world[:3, 2], towards, atol=1e-6)


def test_a_sky_of_spectra_keeps_its_bands_through_saving_opening_and_undo(scene, box, library, tmp_path):
    radiance = np.broadcast_to([1.0, 2.0, 0.5], (4, 8, 3))
    rtb.SpectralImage(radiance, rtb.Bands.regular(440, 110, 3)).save(tmp_path / "sky.exr")
    box(location=(0, 0, 50))  # behind the camera
    world = scene.world = bpy.data.worlds.new("Sky")
    world.rtb.use_spectra, world.rtb.kind, world.rtb.amount = True, "IMAGE", 1.5
    world.rtb.spectrum, world.rtb.image = "1", bpy.data.images.load(str(tmp_path / "sky.exr"))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "sky.blend"), relative_remap=True)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "sky.blend"))
    scene, world = bpy.context.scene, bpy.data.worlds["Sky"]
    bpy.ops.ed.undo_push(message="before")
    world.rtb.image = None
    bpy.ops.ed.undo_push(message="after")
    bpy.ops.ed.undo()
    scene, settings = bpy.context.scene, bpy.context.scene.rtb
    assert bpy.data.worlds["Sky"].rtb.image is not None
    settings.bands_start, settings.bands_step, settings.bands_count = 440, 110, 3
    settings.band_kind, settings.samples = "centre", 4
    made = library("blender").read_recipe(scene).save(tmp_path / "recipe")
    for renderer in ("tracer", "mitsuba"):
        (rendering,) = rtb.execute_recipe(made, renderer=renderer)
        seen = rendering.image.radiance.reshape(-1, 3)
        np.testing.assert_allclose(seen, np.broadcast_to([1.5, 3.0, 0.75], seen.shape), rtol=1e-5)


def test_an_image_that_is_missing_is_said(scene, sky, lamp, read):
    lamp()
    sky.rtb.use_spectra, sky.rtb.kind = True, "IMAGE"
    with pytest.raises(Exception, match="the world Sky is to show an image, choose one"):
        read(scene)


@pytest.fixture
def lens(scene):
    """The scene's camera, with a lens of some width."""
    camera = scene.camera
    camera.data.dof.use_dof, camera.data.lens, camera.data.dof.aperture_fstop = True, 50, 0.5
    camera.data.dof.focus_distance = 4
    return camera


def test_the_lens_is_the_focal_length_by_twice_the_f_number_in_metres(scene, lens, box, lamp, resolved):
    box()
    lamp()
    found = resolved(scene).camera
    assert (found.lens_radius, found.focus_distance) == pytest.approx((0.05, 4))
    scene.unit_settings.scale_length = 0.1
    found = resolved(scene).camera
    assert (found.lens_radius, found.focus_distance) == pytest.approx((0.005, 0.4))
    lens.data.dof.use_dof = False
    assert resolved(scene).camera.lens_radius == 0


def test_focus_on_an_object_is_its_distance_along_the_view(scene, lens, box, lamp, resolved):
    lamp()
    lens.location, lens.rotation_euler, lens.scale = (1, 2, 3), (0.4, 0.3, 0.2), (2, 2, 2)
    lens.data.dof.focus_object = box(location=(0.5, 3, -2))
    bpy.context.view_layer.update()
    ahead = -np.array(lens.matrix_world.col[2].to_3d().normalized())
    wanted = abs(ahead @ (np.array((0.5, 3, -2)) - np.array((1, 2, 3))))
    assert resolved(scene).camera.focus_distance == pytest.approx(wanted, rel=1e-5)


@pytest.mark.parametrize("renderer", ["mitsuba", "tracer"])
def test_what_is_out_of_focus_is_as_blurred_as_in_cycles(scene, lens, put, library, tmp_path, renderer):
    mesh = bpy.data.meshes.new("Bar")
    mesh.from_pydata([(-3, -3, 0), (0, -3, 0), (0, 3, 0), (-3, 3, 0)], [], [(0, 1, 2, 3)])
    glow = bpy.data.materials.new("Glow")
    glow.use_nodes = True
    tree = glow.node_tree
    tree.nodes.clear()
    emission, output = (tree.nodes.new(name) for name in ("ShaderNodeEmission", "ShaderNodeOutputMaterial"))
    tree.links.new(emission.outputs[0], output.inputs[0])
    mesh.materials.append(glow)
    shining = put("Bar", mesh)
    shining.rtb.emits, shining.rtb.spectrum = True, "1"
    lens.location, lens.data.dof.focus_distance, lens.data.dof.aperture_fstop = (0, 0, 5), 2.5, 0.1
    scene.render.resolution_x, scene.render.resolution_y, scene.rtb.samples = 48, 4, 1024
    cycles = rendered_by_cycles(scene, tmp_path / "cycles.exr", samples=1024).mean(axis=0)
    ours = rendered_by(renderer, scene, library, tmp_path / "blurred").mean(axis=0)
    blurred = (cycles > 0.02) & (cycles < 0.98)
    assert blurred.sum() > 4
    # A share p of n = 4096 rays that see the bar has a standard error of sqrt(p (1 - p) / n), in both.
    error = np.sqrt(2 * np.maximum(cycles * (1 - cycles), 1 / 4096) / 4096)
    np.testing.assert_array_less(np.abs(ours - cycles), 5 * error)
