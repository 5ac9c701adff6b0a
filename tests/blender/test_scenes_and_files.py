"""Several scenes in a file and copies of them, things of other files, files seen without the extension."""

from pathlib import Path

import bpy
import numpy as np
import pytest

from tests.blender.test_operators import sentence_of

LIBRARY = "library.blend"


@pytest.fixture
def copied(family):
    """The family's scene and a full copy of it, whose materials are its own."""
    with bpy.context.temp_override(scene=family):
        bpy.ops.scene.new(type="FULL_COPY")
    copy = next(scene for scene in bpy.data.scenes if scene != family)
    return family, copy


@pytest.fixture
def elsewhere(family, tmp_path):
    """The family's scene in a file that others take things of; an empty file is open."""
    family.name = "Lab"
    bpy.data.objects["Cube"].rtb.emits = True
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / LIBRARY))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "taker.blend"))
    return tmp_path / LIBRARY


def rows(scene) -> list[tuple[str, ...]]:
    return [(row.name, *(cell.value for cell in row.cells)) for row in scene.rtb.conditions]


def take(file: Path, link: bool, **wanted: list[str]):
    """Append or link things of a file, and return them by kind."""
    with bpy.data.libraries.load(str(file), link=link) as (_, found):
        for kind, names in wanted.items():
            setattr(found, kind, list(names))
    return {kind: getattr(found, kind) for kind in wanted}


def test_a_full_copy_of_a_scene_has_a_recipe_of_its_own(copied):
    first, second = copied
    before = rows(first)
    assert rows(second) == before
    second.rtb.conditions[0].cells[0].value = "0.5"
    second.rtb.renderer = "mitsuba"
    assert (rows(first), first.rtb.renderer) == (before, "tracer")


def test_what_was_found_in_a_scene_is_shown_with_that_one_alone(copied, module):
    first, second = copied
    findings = module("operators.findings")
    second.rtb.name, second.camera = "other", None
    with bpy.context.temp_override(scene=second):
        sentence_of(bpy.ops.rtb.export_recipe)
    assert (findings.is_about(first), findings.is_about(second)) == (False, True)
    with bpy.context.temp_override(scene=first):
        bpy.ops.rtb.export_recipe()
    assert (findings.is_about(first), findings.is_about(second)) == (True, False)
    findings.clear()


def test_two_scenes_never_write_to_the_same_folder(copied, tmp_path):
    first, second = copied
    for scene in copied:
        with bpy.context.temp_override(scene=scene):
            said = sentence_of(bpy.ops.rtb.export_recipe)
        assert "the scenes" in said
        assert first.name in said
        assert second.name in said
    assert not (tmp_path / "rtb").exists()
    second.rtb.name = "other"
    for scene in copied:
        with bpy.context.temp_override(scene=scene):
            assert bpy.ops.rtb.export_recipe() == {"FINISHED"}
    assert sorted(each.name for each in (tmp_path / "rtb").iterdir()) == ["cube", "other"]


def test_a_script_may_write_two_scenes_of_the_same_name_to_two_folders(copied, module, tmp_path):
    for number, scene in enumerate(copied):
        assert module("rtb_addon.blender").read_recipe(scene).save(tmp_path / str(number)).is_dir()


def test_the_view_layer_in_hand_is_written_whether_it_renders_or_not(family, module):
    bare = family.view_layers.new("Bare")
    bare.layer_collection.children[0].exclude = True
    read, window = module("rtb_addon.blender").read_recipe, bpy.context.window
    for layer in family.view_layers:
        layer.use = False
    assert b"Cube" in read(family).parent
    window.view_layer = bare
    with pytest.raises(module("rtb_addon.errors").RecipeError, match="no light"):
        read(family)


@pytest.mark.parametrize("link", [False, True])
def test_a_scene_of_another_file_brings_its_recipe_and_renders_the_same(elsewhere, module, tmp_path, link):
    (scene,) = take(elsewhere, link, scenes=["Lab"])["scenes"]
    assert [row[0] for row in rows(scene)] == ["blue", "green"]
    assert (scene.library is not None) == link
    cubes = [rendered(scene, module, tmp_path / "taken")]
    bpy.ops.wm.open_mainfile(filepath=str(elsewhere))
    cubes.append(rendered(bpy.context.scene, module, tmp_path / "own"))
    for name in ("blue", "green"):
        np.testing.assert_array_equal(cubes[0][name], cubes[1][name])


def rendered(scene, module, folder: Path) -> dict[str, np.ndarray]:
    """Return the radiance of each condition of a scene's recipe."""
    module("rtb_addon.batch.execute").execute_recipe(
        module("rtb_addon.blender").read_recipe(scene).save(folder)
    )
    load = module("rtb_addon.spectral_image").SpectralImage.load
    return {file.stem: load(file).radiance for file in folder.glob("renderings/tracer/*.exr")}


def test_what_an_override_of_a_linked_thing_says_is_kept_and_counts(elsewhere, module, tmp_path):
    linked = take(elsewhere, True, objects=["Cube", "Light", "Camera"], lights=["Light"])
    scene = bpy.context.scene
    for each in linked["objects"]:
        scene.collection.objects.link(each)
    scene.camera = linked["objects"][2]
    light = linked["lights"][0].override_create(remap_local_usages=True)
    lamp = linked["objects"][1].override_create(remap_local_usages=True)
    lamp.data = light
    light.rtb.spectrum = "A"
    body = linked["objects"][0].override_create(remap_local_usages=True)
    body.rtb.emits = False
    scene.rtb.set_conditions(["imageName", "paint"], [["one", "0.5"]])
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "taker.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "taker.blend"))
    said = {each.library is None: each.rtb.spectrum for each in bpy.data.lights}
    assert said == {True: "A", False: "D65"}
    assert not next(each for each in bpy.data.objects if each.name == "Cube" and not each.library).rtb.emits
    recipe = module("rtb_addon.blender").read_recipe(bpy.context.scene)
    table = [line.split() for line in recipe.resources["Light.spd"].decode().splitlines()]
    light = {float(at): float(value) for at, value in (each for each in table if len(each) == 2)}
    assert light[700.0] > 5 * light[450.0], "tungsten, not daylight"


def test_a_file_that_is_saved_without_the_extension_keeps_its_recipe(family, extension, tmp_path):
    import addon_utils

    before, file = rows(family), str(tmp_path / "cube.blend")
    addon_utils.disable(extension)
    try:
        bpy.ops.wm.open_mainfile(filepath=file)
        bpy.data.objects["Cube"].location.x = 3
        bpy.ops.wm.save_as_mainfile(filepath=file)
    finally:
        addon_utils.enable(extension, default_set=True)
    bpy.ops.wm.open_mainfile(filepath=file)
    assert rows(bpy.context.scene) == before
    assert bpy.data.objects["Cube"].location.x == 3
    assert bpy.data.materials["Material"].rtb.reflectance == "(paint)"
    assert bpy.ops.rtb.export_recipe() == {"FINISHED"}


def test_disabling_and_enabling_again_in_an_open_file_keeps_its_recipe(family, extension):
    import addon_utils

    before = rows(family)
    addon_utils.disable(extension)
    assert not hasattr(bpy.context.scene, "rtb")
    addon_utils.enable(extension, default_set=True)
    assert rows(bpy.context.scene) == before
