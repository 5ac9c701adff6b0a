"""RenderToolbox as a render engine: Render Image without a window."""

import importlib
from pathlib import Path

import bpy
import numpy as np
import pytest

from rtb_addon.colorimetry import linear_srgb, xyz
from rtb_addon.developing import daylight_efficacy
from rtb_addon.exr import read_exr
from rtb_addon.spectral_image import SpectralImage

ENGINE = "RENDERTOOLBOX"


@pytest.fixture
def module(extension):
    """Return a module of the extension as Blender has loaded it."""
    return lambda name: importlib.import_module(f"{extension}.{name}")


@pytest.fixture
def scene(extension, module, tmp_path):
    """Blender's default scene, saved, with two conditions, the second one active; the engine is ours."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene = bpy.context.scene
    bpy.data.materials["Material"].rtb.use_spectra = True
    bpy.data.materials["Material"].rtb.reflectance = "(paint)"
    rows = [[patch, f"BabelColor Average/{patch}"] for patch in ("blue", "red")]
    module("rtb_addon.blender").set_conditions(scene, ["imageName", "paint"], rows)
    scene.rtb.active_condition = 1
    scene.rtb.renderer, scene.rtb.samples = "tracer", 4
    scene.rtb.width, scene.rtb.height = 24, 16
    scene.render.engine = ENGINE
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "cube.blend"))
    return bpy.context.scene


def rendered(scene, folder: Path) -> np.ndarray:
    """Press Render Image and return the picture in linear numbers, (height, width, 3), row 0 on top."""
    file = folder / "still.exr"
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(file)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(file))
    width, height = image.size
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4)[::-1, :, :3]


def test_the_picture_is_the_cube_of_the_active_condition_in_linear_colours(scene, tmp_path):
    picture = rendered(scene, tmp_path)
    cubes = list((tmp_path / "rtb/cube/still/renderings").rglob("*.exr"))
    assert [cube.name for cube in cubes] == ["red.exr"]
    expected = linear_srgb(xyz(SpectralImage.load(cubes[0]))) / daylight_efficacy()
    np.testing.assert_allclose(picture, expected, rtol=2e-3, atol=2e-3 * expected.max())
    red, green, blue = picture.reshape(-1, 3).mean(axis=0)
    assert red > 2 * green
    assert red > 2 * blue


def test_a_colour_among_the_cells_is_the_spectrum_that_the_batch_renders(scene, module, tmp_path):
    scene.rtb.variables[0].kind = "COLOUR"
    scene.rtb.conditions[1].cells[0].value = "0.7 0.1 0.2"
    rendered(scene, tmp_path)
    bpy.ops.rtb.export_recipe()
    find = module("rtb_addon.recipe").Recipe.load
    batch, alone = find(tmp_path / "rtb/cube"), find(tmp_path / "rtb/cube/still")
    paints = [(each.folder / each.conditions["red"].cells["paint"]).read_text() for each in (batch, alone)]
    assert paints[0] == paints[1]


def test_the_recipes_own_folder_is_left_alone(scene, tmp_path):
    bpy.ops.rtb.export_recipe()
    before = {file: file.read_bytes() for file in (tmp_path / "rtb/cube").glob("*.*")}
    rendered(scene, tmp_path)
    assert {file: file.read_bytes() for file in (tmp_path / "rtb/cube").glob("*.*")} == before


def test_a_grey_scene_in_daylight_is_as_bright_as_in_cycles(scene, tmp_path):
    material = bpy.data.materials["Material"]
    material.rtb.use_spectra = False
    nodes, links = material.node_tree.nodes, material.node_tree.links
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1)
    links.new(diffuse.outputs["BSDF"], nodes["Material Output"].inputs["Surface"])
    bpy.data.lights["Light"].rtb.use_spectra = True
    bpy.data.lights["Light"].rtb.spectrum = "D65"
    scene.rtb.samples, scene.rtb.depth = 64, 2
    ours = rendered(scene, tmp_path)[..., 1]
    bpy.context.scene.world.node_tree.nodes["Background"].inputs[1].default_value = 0
    scene.render.engine, scene.cycles.samples, scene.cycles.max_bounces = "CYCLES", 256, 0
    scene.cycles.use_denoising = False
    theirs = rendered(scene, tmp_path)[..., 1]
    # Cycles has a wider filter, which leaves the sum of all pixels as it is. Our bands end at 700 nm.
    assert ours.mean() == pytest.approx(theirs.mean(), rel=0.01)


def test_properties_that_conditions_set_are_those_of_the_active_one(scene, tmp_path):
    light = bpy.data.lights["Light"]
    bpy.ops.rtb.add_variable(name="power", value="1000")
    mapping = scene.rtb.mappings.add()
    mapping.thing, mapping.path, mapping.value = light, "energy", "(power)"
    for row, power in zip(scene.rtb.conditions, ("100", "400"), strict=True):
        row.cells[1].value = power
    scene.rtb.conditions[0].cells[0].value = scene.rtb.conditions[1].cells[0].value
    before = light.energy
    bright = rendered(scene, tmp_path)
    assert light.energy == before
    scene.rtb.active_condition = 0
    dim = rendered(scene, tmp_path)
    np.testing.assert_allclose(bright, 4 * dim, rtol=1e-3, atol=1e-6)


def test_a_border_shows_the_part_of_the_picture_that_it_frames(scene, tmp_path):
    whole = rendered(scene, tmp_path)
    render = scene.render
    render.use_border = render.use_crop_to_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.25, 0.75, 0.5, 1.0
    part = rendered(scene, tmp_path)
    assert part.shape == (8, 12, 3)
    np.testing.assert_array_equal(part, whole[:8, 6:18])


def test_only_the_framed_part_is_rendered_and_stands_where_it_belongs(scene, tmp_path):
    whole = rendered(scene, tmp_path)
    render = scene.render
    render.use_border, render.resolution_percentage = True, 50
    render.resolution_x, render.resolution_y = 48, 32  # the same picture at half its size
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.3, 0.7, 0.1, 0.6
    part = rendered(scene, tmp_path)
    cube = next((tmp_path / "rtb/cube/still/renderings").rglob("*.exr"))
    left, right, top, bottom = 7, 16, 16 - 9, 16 - 1
    assert SpectralImage.load(cube).radiance.shape[:2] == (bottom - top, right - left)
    np.testing.assert_array_equal(part[top:bottom, left:right], whole[top:bottom, left:right])
    assert part.sum() == pytest.approx(part[top:bottom, left:right].sum())


def test_every_view_layer_has_a_picture_and_keeps_a_cube(scene, tmp_path):
    scene.view_layers.new("Without: Cube").layer_collection.children["Collection"].exclude = True
    for name in ("Light", "Camera"):
        scene.collection.objects.link(bpy.data.objects[name])
    layers = picture_layers(scene, tmp_path)
    assert layers["ViewLayer"].max() > 0
    assert layers["Without: Cube"].max() == 0
    kept = {cube.relative_to(tmp_path / "rtb/cube/still").parts[0] for cube in cubes_below(tmp_path)}
    assert kept == {"ViewLayer", "Without_ Cube"}


def picture_layers(scene, folder: Path) -> dict[str, np.ndarray]:
    """Press Render Image and return the green channel of each view layer."""
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.filepath = str(folder / "layers.exr")
    bpy.ops.render.render(write_still=True)
    _, channels = read_exr(folder / "layers.exr")
    return {layer.name: channels[f"{layer.name}.Combined.G"] for layer in scene.view_layers}


def cubes_below(folder: Path) -> list[Path]:
    return sorted((folder / "rtb/cube/still").rglob("renderings/*/*.exr"))


def test_each_frame_of_an_animation_keeps_its_cube(scene, tmp_path):
    cube = bpy.data.objects["Cube"]
    for frame, height in ((1, 0.0), (2, 100.0)):
        cube.location.z = height
        cube.keyframe_insert("location", frame=frame)
    scene.frame_start, scene.frame_end = 1, 2
    scene.render.filepath = str(tmp_path / "frame-####")
    bpy.ops.render.render(animation=True)
    kept = cubes_below(tmp_path)
    assert [file.relative_to(tmp_path / "rtb/cube/still").parts[0] for file in kept] == ["0001", "0002"]
    first, second = (SpectralImage.load(file).radiance.max() for file in kept)
    assert first > 0 == second
    assert [file.name for file in sorted(tmp_path.glob("frame-*"))] == ["frame-0001.png", "frame-0002.png"]


def test_a_file_that_was_never_saved_renders_and_says_that_its_cube_passes(scene, capfd):
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.engine, scene.rtb.renderer, scene.rtb.samples = ENGINE, "tracer", 2
    scene.rtb.width, scene.rtb.height = 8, 6
    assert bpy.ops.render.render() == {"FINISHED"}
    assert "until Blender ends" in capfd.readouterr().out
    kept = list((Path(bpy.app.tempdir) / "still/renderings/tracer").glob("*.exr"))
    assert len(kept) == 1


def test_what_is_wrong_is_said_in_one_sentence(scene, tmp_path):
    bpy.data.lights["Light"].energy = 0
    bpy.data.objects.remove(bpy.data.objects["Light"])
    with pytest.raises(RuntimeError, match="no light"):
        rendered(scene, tmp_path)


def test_blenders_panels_serve_the_engine_and_forget_it(extension):
    import addon_utils

    def serving() -> set[str]:
        kinds = bpy.types.Panel.__subclasses__()
        return {kind.__name__ for kind in kinds if ENGINE in getattr(kind, "COMPAT_ENGINES", ())}

    enabled = serving()
    assert {"DATA_PT_lens", "EEVEE_MATERIAL_PT_context_material", "RENDER_PT_format"} <= enabled
    assert not any("freestyle" in name for name in enabled)
    assert "DATA_PT_light" not in enabled  # Eevee's shows the kind of light as well
    addon_utils.disable(extension)
    assert serving() == set()
    addon_utils.enable(extension)
    assert serving() == enabled
