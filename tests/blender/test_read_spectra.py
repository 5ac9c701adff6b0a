"""From Blender's scene to a recipe: spectra, what is assumed, what is refused."""

from pathlib import Path

import bpy
import numpy as np
import pytest

from tests.blender.recipe_sentences import sentence

# Spectra and conditions


def test_spectra_are_files_named_after_what_they_belong_to(still, read):
    recipe = read(still)
    assert "Paint-material:diffuseReflectance.spectrum = resources/Paint.spd\n" in recipe.mappings
    assert "Lamp-light:intensity.spectrum = resources/Lamp.spd\n" in recipe.mappings
    assert set(recipe.resources) == {"Paint.spd", "Lamp.spd"}


def test_watts_are_the_integral_of_a_lamps_spectrum(still, resolved):
    bpy.data.lights["Lamp"].energy = 60
    (light,) = resolved(still).lights
    assert light.parameters["intensity"].integral() == pytest.approx(60 / (4 * np.pi), rel=1e-6)


def test_a_variable_becomes_a_column_of_files(still, read, resolved, library):
    bpy.data.materials["Paint"].rtb.reflectance = "(paint)"
    rows = [("blue", "BabelColor Average/blue"), ("grey", "0.25")]
    library("blender").set_conditions(still, ["imageName", "paint"], rows)
    recipe = read(still)
    cells = {each.name: each.cells["paint"] for each in recipe.conditions}
    assert cells == {"blue": "resources/BabelColor-Average-blue.spd", "grey": "resources/0.25.spd"}
    paint = resolved(still, "grey").materials["Paint-material"].parameters["diffuseReflectance"]
    np.testing.assert_allclose(paint.values, 0.25)


def test_lamps_that_share_a_variable_have_a_column_each_for_their_watts(still, lamp, resolved, library):
    first, second = bpy.data.lights["Lamp"], lamp(name="Other").data
    second.rtb.use_spectra = True
    first.energy, second.energy = 10, 30
    first.rtb.spectrum = second.rtb.spectrum = "daylight (kelvin)"
    library("blender").set_conditions(still, ["imageName", "kelvin"], [("warm", 4000), ("cool", 9000)])
    for condition, warm in (("warm", True), ("cool", False)):
        spectra = {each.id: each.parameters["intensity"] for each in resolved(still, condition).lights}
        watts = [spectra[id].integral() * 4 * np.pi for id in ("Lamp-light", "Other-light")]
        assert watts == pytest.approx([10, 30], rel=1e-6)
        blue, red = spectra["Lamp-light"].at([450, 650])
        assert (red > blue) == warm


def test_a_variable_of_a_lamp_and_a_material_means_its_own_to_each(still, resolved, library):
    bpy.data.materials["Paint"].rtb.reflectance = "(value)"
    bpy.data.lights["Lamp"].rtb.spectrum = "(value)"
    library("blender").set_conditions(still, ["value"], [["0.5"], ["0.7"]])
    scene = resolved(still, "Scene-002")
    np.testing.assert_allclose(scene.materials["Paint-material"].parameters["diffuseReflectance"].values, 0.7)
    assert scene.lights[0].parameters["intensity"].integral() == pytest.approx(10 / (4 * np.pi), rel=1e-6)


def test_spd_files_are_found_beside_the_blend(still, read, tmp_path):
    (tmp_path / "spectra").mkdir()
    (tmp_path / "spectra/red.spd").write_text("400 0.125\n700 0.5\n")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "still.blend"))
    for text in ("spectra/red.spd", "//spectra/red.spd"):
        bpy.data.materials["Paint"].rtb.reflectance = text
        assert b"0.125" in read(bpy.context.scene).resources["Paint.spd"]


def test_tables_of_numbers_in_cells_become_files_that_are_called_after_their_conditions(
    still, read, tmp_path
):
    bpy.data.materials["Paint"].rtb.reflectance = "(paint)"
    bpy.ops.rtb.fill_graded(variable="paint", count=3)
    bpy.ops.rtb.fill_from_library(variable="paint", names="BabelColor Average/blue")
    recipe = read(still)
    folder = recipe.save(tmp_path / "graded")
    names = [Path(row.cells["paint"]).name for row in recipe.conditions]
    assert names == ["paint-1.spd", "paint-2.spd", "paint-3.spd", "BabelColor-Average-blue.spd"]
    first, last = ((folder / "resources" / name).read_text() for name in (names[0], names[3]))
    assert first == last, "the first step is where it begins"


def test_a_column_of_cameras_names_their_ids(still, put, resolved, library):
    put("Eye.two", bpy.data.cameras.new("Eye"), location=(0, 0, 9))
    library("blender").set_conditions(
        still, ["imageName", "camera"], [("near", "Camera"), ("far", "Eye.two")]
    )
    assert [each.cells["camera"] for each in library("blender").read_recipe(still).conditions] == [
        "Camera",
        "Eye_two",
    ]


def test_the_world_shines_where_it_is_tagged(still, resolved):
    world = still.world = bpy.data.worlds.new("Sky")
    assert resolved(still).environment is None
    world.rtb.use_spectra, world.rtb.spectrum, world.rtb.amount = True, "0.5", 3.0
    np.testing.assert_allclose(resolved(still).environment.parameters["intensity"].values, 1.5)


def test_an_emitting_object_does_not_light_those_that_share_its_mesh(still, put, resolved):
    shining = put("Shining", bpy.data.objects["Box"].data, location=(9, 0, 0))
    shining.rtb.emits, shining.rtb.spectrum, shining.rtb.amount = True, "2", 1.5
    emission = {float(each.to_world[0, 3]): each.emission for each in resolved(still).shapes}
    assert emission[0.0] is None
    np.testing.assert_allclose(emission[9.0].values, 3.0)


# What is assumed


def test_what_has_no_spectrum_is_promoted_and_the_report_says_so(still, read, resolved):
    material, light = bpy.data.materials["Paint"], bpy.data.lights["Lamp"]
    material.rtb.use_spectra = light.rtb.use_spectra = False
    material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (0.5, 0.25, 0.125, 1)
    light.color, light.energy = (0.5, 0.5, 0.5), 60
    world = still.world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    report = "\n".join(read(still).report)
    for part in (
        "material Paint has no spectrum: its base color 0.5 0.25 0.125",
        "light Lamp has no",
        "world Sky",
    ):
        assert part in report
    scene = resolved(still)
    paint = scene.materials["Paint-material"].parameters["diffuseReflectance"]
    np.testing.assert_allclose(paint.at([420, 540, 680]), (0.125, 0.25, 0.5))
    assert scene.lights[0].parameters["intensity"].integral() == pytest.approx(
        0.5 * 60 / (4 * np.pi), rel=1e-6
    )


def test_what_no_renderer_does_is_said(still, read):
    light = bpy.data.lights["Lamp"]
    light.diffuse_factor, light.use_shadow, light.shadow_soft_size, light.color = 0.5, False, 0.2, (1, 0, 0)
    still.camera.data.dof.use_dof, still.camera.data.dof.aperture_blades = True, 6
    bpy.data.objects["Box"].visible_shadow = False
    material = bpy.data.materials["Paint"]
    material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Emission Strength"].default_value = 1
    report = "\n".join(read(still).report)
    for part in (
        "diffuse factor",
        "shadows",
        "soft falloff",
        "not in its colour",
        "round aperture",
        "glows",
        "all light",
    ):
        assert part in report
    light.energy = -1
    assert "negative power" in "\n".join(read(still).report)


def test_a_tagged_scene_has_nothing_to_report(still, read):
    bpy.data.lights["Lamp"].shadow_soft_size = 0
    assert read(still).report == ()


# What is refused


def refusals():
    """Yield what is done to a scene, and what the one sentence must say."""
    things = bpy.data
    yield lambda scene: things.objects["Box"].data.materials.clear(), ("Box", "no material")
    yield lambda scene: setattr(scene, "camera", None), ("Scene", "no camera")
    yield lambda scene: setattr(scene.camera, "hide_render", True), ("Camera", "does not render")
    yield lambda scene: setattr(things.objects["Lamp"], "hide_render", True), ("Scene", "no light")
    yield (
        lambda scene: setattr(things.materials["Paint"].rtb, "reflectance", "gone.spd"),
        ("Paint", "gone.spd"),
    )
    yield lambda scene: setattr(things.materials["Paint"].rtb, "reflectance", ""), ("Paint", "empty")
    yield lambda scene: setattr(things.lights["Lamp"].rtb, "spectrum", "D66"), ("Lamp", "D66")
    yield lambda scene: setattr(things.lights["Lamp"].rtb, "spectrum", "0"), ("Lamp", "watts")
    yield (
        lambda scene: setattr(things.lights["Lamp"].rtb, "spectrum", "(light)"),
        ("Lamp", "(light)", "no conditions"),
    )
    yield lambda scene: setattr(scene.camera.data, "type", "PANO"), ("Camera", "panoramic")


@pytest.mark.parametrize("number", range(10))
def test_what_is_wrong_is_said_in_one_sentence(still, read, library, number):
    spoil, words = list(refusals())[number]
    spoil(still)
    said = sentence(library, lambda: read(still))
    assert all(word in said for word in words), said


def test_a_variable_that_is_not_there_or_says_nothing_is_refused(still, read, library):
    bpy.data.materials["Paint"].rtb.reflectance = "(pant)"
    library("blender").set_conditions(still, ["imageName", "paint"], [("one", "0.5")])
    assert "(pant), the variables of the conditions are paint" in sentence(library, lambda: read(still))
    bpy.data.materials["Paint"].rtb.reflectance = "(paint)"
    still.rtb.conditions[0].cells[0].value = " "
    assert "the condition one says nothing for paint" in sentence(library, lambda: read(still))


def test_rows_that_would_write_the_same_file_or_none_are_refused(still, read, library):
    for rows, words in (([("a", "1"), ("A", "2")], "stands in line"), ([("a/b", "1")], "cannot name files")):
        still.rtb.set_conditions(["imageName", "paint"], rows)
        assert words in sentence(library, lambda: read(still))
    still.rtb.set_conditions(["paint", "paint"], [("1", "2")])
    assert "'paint' needs a name" in sentence(library, lambda: read(still))


def test_an_unsaved_file_has_no_folder_to_save_a_relative_one_in(still, read, library, tmp_path):
    assert "save that first" in sentence(library, lambda: read(still).save())
    still.rtb.folder = str(tmp_path / "RENAMED" / "NAME")
    still.rtb.name = "elsewhere"
    assert read(still).save() == tmp_path / "RENAMED" / "elsewhere"
