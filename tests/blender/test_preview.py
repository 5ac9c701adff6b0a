"""The preview of a condition: it follows the row, shows colours, and never gets into what is kept."""

import bpy
import pytest


@pytest.fixture
def family(extension):
    """Blender's default scene with a paint and a lamp that vary, previewed at its first row."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene = bpy.context.scene
    material, light = bpy.data.materials["Material"], bpy.data.lights["Light"]
    material.rtb.use_spectra, material.rtb.reflectance = True, "(paint)"
    light.rtb.use_spectra, light.rtb.spectrum = True, "(light)"
    scene.rtb.set_conditions(
        ["paint", "light"], [["BabelColor Average/red", "A"], ["BabelColor Average/blue", "D65"]]
    )
    bpy.ops.rtb.vary_property(home="objects", thing="Light", path="location", index=2, variable="height")
    for row, height in zip(scene.rtb.conditions, ("3", "5"), strict=True):
        row.cells[2].value = height
    return scene


@pytest.fixture
def seen(family):
    """Return what is to be seen: the base colour, the lamp's colour and its height."""

    def look() -> tuple:
        material = bpy.data.materials["Material"]
        socket = material.node_tree.nodes["Principled BSDF"].inputs["Base Color"]
        base, shown = tuple(socket.default_value), tuple(material.diffuse_color)
        return base, shown, tuple(bpy.data.lights["Light"].color), bpy.data.objects["Light"].location[2]

    return look


def test_a_surface_takes_the_colour_of_its_spectrum_and_a_lamp_that_of_its_light(family, seen):
    bpy.ops.rtb.preview_condition()
    base, shown, light, height = seen()
    assert base[0] > 2 * base[1]
    assert base[0] > 2 * base[2]
    assert base == shown
    assert light[0] > 2 * light[2], "tungsten light is reddish"
    assert height == 3


def test_it_follows_the_active_row_and_what_its_cells_say(family, seen):
    bpy.ops.rtb.preview_condition()
    family.rtb.active_condition = 1
    base, _, light, height = seen()
    assert base[2] > 2 * base[0]
    assert light == pytest.approx((1, 1, 1), abs=0.06)
    assert height == 5
    family.rtb.conditions[1].cells[2].value = "7"
    assert seen()[3] == 7
    family.rtb.mappings[0].value = "2 * (height)"
    assert seen()[3] == 14


def test_it_is_never_saved(family, seen, tmp_path):
    before = seen()
    bpy.ops.rtb.preview_condition()
    shown = seen()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "family.blend"))
    assert seen() == shown, "it comes back after saving"
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "family.blend"))
    assert seen() == before
    assert not bpy.context.window_manager.rtb_preview
    assert not len(bpy.context.scene.rtb.kept)


def test_a_file_that_was_saved_with_it_is_mended_when_it_is_opened(family, seen, tmp_path):
    before = seen()
    bpy.ops.rtb.preview_condition()
    watching = bpy.app.handlers.save_pre[:]
    bpy.app.handlers.save_pre.clear()
    try:
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "crashed.blend"))
    finally:
        bpy.app.handlers.save_pre.extend(watching)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "crashed.blend"))
    assert seen() == before


def test_undo_and_redo_never_make_it_permanent(family, seen):
    before = seen()
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.rtb.preview_condition()
    bpy.data.objects["Cube"].location[0] = 1
    bpy.ops.ed.undo_push(message="moved while previewed")
    bpy.ops.ed.undo()
    assert seen() != before, "it is still on"
    bpy.ops.ed.redo()
    bpy.ops.rtb.preview_condition(show=False)
    assert seen() == before
    bpy.ops.ed.undo()
    assert seen() == before
    bpy.ops.ed.redo()
    assert seen() == before


def test_exports_and_renders_see_the_scene_without_it(family, seen, library, tmp_path):
    family.rtb.folder = str(tmp_path)
    recipe = library("blender").read_recipe(family)
    bpy.ops.rtb.preview_condition()
    shown = seen()
    again = library("blender").read_recipe(family)
    assert (again.parent, again.mappings) == (recipe.parent, recipe.mappings)
    assert seen() == shown
    heights = []
    bpy.app.handlers.render_pre.append(lambda *_: heights.append(bpy.data.objects["Light"].location[2]))
    family.render.engine, family.render.resolution_percentage = "CYCLES", 1
    family.cycles.samples = 1
    bpy.ops.render.render()
    bpy.app.handlers.render_pre.pop()
    assert heights == [pytest.approx(5.9038619995)]
    assert seen() == shown


def test_disabling_takes_it_back(family, seen, extension):
    import addon_utils

    before = seen()
    bpy.ops.rtb.preview_condition()
    addon_utils.disable(extension)
    try:
        assert seen() == before
    finally:
        addon_utils.enable(extension)


def test_what_somebody_changes_meanwhile_stays(family, seen):
    bpy.ops.rtb.preview_condition()
    bpy.data.objects["Light"].location[2] = 9
    bpy.ops.rtb.preview_condition(show=False)
    assert seen()[3] == 9
    assert seen()[2] == (1, 1, 1)


def test_what_cannot_be_shown_is_said_and_the_rest_is_shown(family, seen, library):
    family.rtb.conditions[0].cells[0].value = "BabelColor Average/rid"
    bpy.ops.rtb.preview_condition()
    assert "rid" in library("blender.preview").problems()[0]
    assert seen()[3] == 3


def test_verbs_on_the_table_see_the_scene_without_it_and_show_it_once(family, seen, library, monkeypatch):
    preview = library("blender.preview")
    bpy.ops.rtb.preview_condition()
    shown, show = [], preview.show
    monkeypatch.setattr(preview, "show", lambda scene: shown.append(1) or show(scene))
    bpy.ops.rtb.vary_property(home="lights", thing="Light", path="color", variable="tint")
    assert family.rtb.conditions[0].cells[3].value == "1 1 1", "as it is, not as it is previewed"
    bpy.ops.rtb.fill_range(variable="height", how="ADD", first=1, last=200, count=200)
    assert len(shown) == 2
    assert seen()[3] == 200
