"""Fields that hold a spectrum: the ways to say one, its curve, and how it becomes a variable."""

import math
import sys
from types import SimpleNamespace

import bpy
import numpy as np
import pytest

from tests.blender.stand_in_layout import RecordingLayout


@pytest.fixture
def material(extension):
    """The default scene's material, with spectra."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    material = bpy.data.materials["Material"].rtb
    material.use_spectra = True
    return material


@pytest.fixture
def previews(library):
    """The module that makes curves, with none made."""
    module = library("blender.curve_previews")
    module.forget()
    return module


def sentence(operator, **properties) -> str:
    with pytest.raises(RuntimeError) as caught:
        operator(**properties)
    return str(caught.value).strip()


def test_every_way_writes_what_somebody_would_type(material):
    for verb, asked, text in (
        (bpy.ops.rtb.use_flat_spectrum, {"value": 0.25}, "0.25"),
        (bpy.ops.rtb.use_daylight, {"kelvin": 5000}, "daylight 5000"),
        (bpy.ops.rtb.use_blackbody, {"kelvin": 2856}, "blackbody 2856"),
        (bpy.ops.rtb.use_library_spectrum, {"name": "BabelColor Average/blue"}, "BabelColor Average/blue"),
        (bpy.ops.rtb.use_colour, {"colour": (0.5, 0.5, 0.5)}, "0.5"),
    ):
        assert verb(field="REFLECTANCE", **asked) == {"FINISHED"}
        assert material.reflectance == text


@pytest.mark.parametrize("field", ["REFLECTANCE", "LIGHT", "WORLD", "EMISSION", "CELL"])
def test_every_field_is_written_where_it_belongs(material, field):
    scene, light = bpy.context.scene, bpy.data.objects["Light"]
    scene.rtb.set_conditions(["paint"], [["0.1"]])
    with bpy.context.temp_override(object=light if field == "LIGHT" else bpy.data.objects["Cube"]):
        bpy.ops.rtb.use_daylight(field=field, kelvin=7500)
    written = {
        "REFLECTANCE": material.reflectance,
        "LIGHT": light.data.rtb.spectrum,
        "WORLD": scene.world.rtb.spectrum,
        "EMISSION": bpy.data.objects["Cube"].rtb.spectrum,
        "CELL": scene.rtb.conditions[0].cells[0].value,
    }
    assert [name for name, text in written.items() if text == "daylight 7500"] == [field]


def test_a_file_is_named_relative_to_the_blend_file(material, tmp_path):
    (tmp_path / "paint.spd").write_text("400 0.2\n700 0.6\n")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "paint.blend"))
    bpy.ops.rtb.use_spectrum_file(field="REFLECTANCE", filepath=str(tmp_path / "paint.spd"))
    assert bpy.data.materials["Material"].rtb.reflectance == "//paint.spd"


def test_a_file_that_is_no_spectrum_is_refused_with_its_line(material, tmp_path):
    before = material.reflectance
    (tmp_path / "odd.spd").write_text("400 0.2\n700 red\n")
    assert "odd.spd:2" in sentence(
        bpy.ops.rtb.use_spectrum_file, field="REFLECTANCE", filepath=str(tmp_path / "odd.spd")
    )
    assert material.reflectance == before


def test_without_a_material_the_sentence_says_what_to_select(material):
    bpy.context.view_layer.objects.active = None
    assert "no material is active" in sentence(bpy.ops.rtb.use_flat_spectrum, field="REFLECTANCE")


def test_varying_makes_a_column_that_says_what_the_field_said(material):
    material.reflectance = "0.4"
    bpy.ops.rtb.vary_in_recipe(field="REFLECTANCE")
    settings = bpy.context.scene.rtb
    assert material.reflectance == "(reflectance)"
    assert [each.name for each in settings.variables] == ["reflectance"]
    assert [cell.value for row in settings.conditions for cell in row.cells] == ["0.4"]
    assert "varies already" in sentence(bpy.ops.rtb.vary_in_recipe, field="REFLECTANCE")
    with bpy.context.temp_override(object=bpy.data.objects["Light"]):
        bpy.ops.rtb.vary_in_recipe(field="LIGHT")
    assert [each.name for each in settings.variables] == ["reflectance", "light"]
    assert [cell.value for cell in settings.conditions[0].cells] == ["0.4", "D65"]


def test_varying_changes_nothing_of_what_the_recipe_renders(material, library):
    bpy.context.scene.rtb.folder = "/nowhere/"
    material.reflectance = "BabelColor Average/red"
    read_recipe = library("blender").read_recipe
    before = read_recipe(bpy.context.scene)
    bpy.ops.rtb.vary_in_recipe(field="REFLECTANCE")
    after = read_recipe(bpy.context.scene)
    assert sorted(before.resources.values()) == sorted(after.resources.values())
    assert before.parent == after.parent
    assert after.conditions.rows[0].cells["reflectance"] == "resources/BabelColor-Average-red.spd"


def test_undo_takes_a_variable_and_its_field_back_together(material):
    material.reflectance = "0.4"
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.rtb.vary_in_recipe("EXEC_DEFAULT", True, field="REFLECTANCE")
    bpy.ops.ed.undo()
    assert bpy.data.materials["Material"].rtb.reflectance == "0.4"
    assert not bpy.context.scene.rtb.variables


def test_a_variable_of_the_table_can_be_taken_and_no_other(material):
    bpy.context.scene.rtb.set_conditions(["paint"], [["0.1"]])
    bpy.ops.rtb.use_variable(field="REFLECTANCE", variable="paint")
    assert material.reflectance == "(paint)"
    assert "there are paint" in sentence(bpy.ops.rtb.use_variable, field="REFLECTANCE", variable="pain")


def test_the_right_click_offers_to_vary_spectra_and_nothing_else(material, extension):
    menus = sys.modules[f"{extension}.panels.spectrum_menus"]
    offered = set()
    groups = (material, material.reflectance_texture, bpy.context.scene.rtb, bpy.data.lights["Light"].rtb)
    for group in groups:
        for name, kind in group.bl_rna.properties.items():
            layout = RecordingLayout()
            context = SimpleNamespace(button_prop=kind, button_pointer=group)
            menus.draw_in_context_menu(SimpleNamespace(layout=layout), context)
            if layout.names("operator"):
                offered.add((type(group).__name__, name))
    typed = "reflectance base_reflectance specular_reflectance transmittance eta k ior"
    assert offered == {
        *(("RTB_PG_material", name) for name in typed.split()),
        *(("RTB_PG_texture", name) for name in ("even", "odd")),
        ("RTB_PG_light", "spectrum"),
    }


@pytest.mark.parametrize("field", ["REFLECTANCE", "ETA", "REFLECTANCE_ODD", "LIGHT", "WORLD", "CELL"])
def test_the_menu_offers_the_library_first_to_every_field(material, extension, field):
    menus = sys.modules[f"{extension}.panels.spectrum_menus"]
    bpy.context.scene.rtb.set_conditions(["paint"], [["0.1"]])
    kind, layout = menus.RTB_MT_spectrum, RecordingLayout()
    menu = SimpleNamespace(
        layout=layout, draw_variables=lambda *drawn: kind.draw_variables(SimpleNamespace(), *drawn)
    )
    kind.draw(menu, SimpleNamespace(scene=bpy.context.scene, rtb_field=field))
    offered = layout.names("operator")
    assert offered[0] == "rtb.use_library_spectrum"
    assert ("rtb.use_variable" in offered) == (field != "CELL")
    assert ("rtb.use_daylight" in offered) == (field != "ETA"), "an index is no light"


def test_a_curve_is_made_once_and_drawing_only_looks_it_up(material, previews, monkeypatch):
    assert previews.shown("D65", True, 120) == previews.Shown()
    assert previews.make_wanted() == 1
    made = []
    monkeypatch.setattr(previews, "_made", lambda key: made.append(key))
    for _ in range(100):
        assert previews.shown("D65", True, 120).sentence == ""
    assert previews.make_wanted() == 0
    assert not made


def test_the_pictures_pixels_are_those_of_the_curve(material, previews, library):
    previews.shown("BabelColor Average/blue", False, 120)
    previews.make_wanted()
    (preview,) = previews._pictures.values()
    pixels = np.empty(math.prod(preview.image_size) * 4, np.float32)
    preview.image_pixels_float.foreach_get(pixels)
    swatches, find = library("swatches"), library("spectra.library").find
    colour = swatches.surface_colour(find("BabelColor Average/blue"), find("D65"))
    assert pixels.reshape(120, 120, 4)[5, 60] == pytest.approx([*(colour / 255), 1], abs=0.5 / 255)


def test_a_text_that_is_no_spectrum_shows_why(material, previews):
    previews.shown("D64", True, 120)
    previews.make_wanted()
    assert "did you mean D65" in previews.shown("D64", True, 120).sentence


def test_pictures_do_not_pile_up(material, previews):
    for number in range(previews.MOST + 20):
        previews.shown(f"{number / 1000}", False, 40)
        previews.make_wanted()
    assert len(previews._pictures) <= previews.MOST


def test_the_curve_of_a_variable_is_that_of_the_active_condition(material, library):
    settings = bpy.context.scene.rtb
    settings.set_conditions(["paint"], [["0.1"], ["BabelColor Average/red"]])
    material.reflectance = "(paint)"
    typed_in = library("blender.fields").typed_in
    settings.active_condition = 1
    assert typed_in(material, "reflectance", settings) == "BabelColor Average/red"
    material.reflectance = "400:(paint) 700:(gone)"
    settings.active_condition = 0
    assert typed_in(material, "reflectance", settings) == "400:0.1 700:(gone)"


# The user's own spectra


@pytest.fixture
def own(extension, tmp_path, previews):
    """A folder that the user prefers for spectra of their own."""
    preferences = bpy.context.preferences.addons[extension].preferences
    (tmp_path / "own").mkdir()
    preferences.spectra = str(tmp_path / "own")
    yield tmp_path / "own"
    preferences.spectra = ""


def test_imported_spectra_are_found_in_the_library_and_mean_the_same_everywhere(
    material, own, previews, read
):
    (own.parent / "paints.csv").write_text("nm,red,blue\n400,0.1,0.9\n700,0.8,0.2\n")
    assert bpy.ops.rtb.import_spectra(filepath=str(own.parent / "paints.csv")) == {"FINISHED"}
    assert sorted(file.name for file in own.rglob("*.spd")) == ["blue.spd", "red.spd"]
    bpy.ops.rtb.use_library_spectrum(field="REFLECTANCE", name="Own/paints/red")
    assert material.reflectance == "Own/paints/red"
    previews.shown(material.reflectance, False, 40)
    previews.make_wanted()
    assert not previews.shown(material.reflectance, False, 40).sentence
    assert read(bpy.context.scene).resources["Material.spd"] == (own / "paints/red.spd").read_bytes()


def test_further_folders_are_searched_after_the_one_of_imports(own, tmp_path, extension):
    from rtb_addon.spectra.library import own_files

    offers = sys.modules[f"{extension}.operators.use_library_spectrum"]
    folders = sys.modules[f"{extension}.rtb_addon.blender.own_spectra"].own_folders
    lab, shared = tmp_path / "lab", tmp_path / "shared"
    for folder, value in ((own, 0.1), (lab, 0.2), (shared, 0.3)):
        folder.mkdir(exist_ok=True)
        (folder / "wall.spd").write_text(f"400 {value}\n700 {value}\n")
    (shared / "floor.spd").write_text("400 0.4\n700 0.4\n")
    for folder in (lab, shared):
        assert bpy.ops.rtb.add_spectra_folder(directory=str(folder)) == {"FINISHED"}
    try:
        assert folders()[:3] == [own, lab, shared]
        found = own_files(folders())
        assert (found["Own/wall"], found["Own/floor"]) == (own / "wall.spd", shared / "floor.spd")
        offers.look_again()
        names = [item[0] for item in offers._names(SimpleNamespace(field="LIGHT"), bpy.context)]
        (lab / "door.spd").write_text("400 0.4\n700 0.4\n")
        offers.look_again()
        later = [item[0] for item in offers._names(SimpleNamespace(field="LIGHT"), bpy.context)]
        assert set(later) - set(names) == {"Own/door"}
        bpy.ops.rtb.remove_spectra_folder(index=0)
        assert folders()[:2] == [own, shared]
        assert "no folder 7" in sentence(bpy.ops.rtb.remove_spectra_folder, index=7)
    finally:
        bpy.context.preferences.addons[extension].preferences.spectra_folders.clear()
        offers.forget()


def test_the_toolboxs_files_are_dropped_on_the_window(own, extension):
    from scipy.io import savemat

    savemat(own.parent / "sur_x.mat", {"S_x": [400, 100, 3], "sur_x": [[0.1, 0.2], [0.3, 0.4], [0.5, 0.6]]})
    handler = bpy.types.RTB_FH_spectra
    assert handler.bl_import_operator == "rtb.import_spectra"
    assert ".mat" in handler.bl_file_extensions
    dropped = {"directory": str(own.parent), "files": [{"name": "sur_x.mat"}]}
    assert bpy.ops.rtb.import_spectra(**dropped) == {"FINISHED"}
    assert (own / "sur_x/sur_x-2.spd").read_text().splitlines() == ["400 0.2", "500 0.4", "600 0.6"]
    assert "scipy.io" not in {name for name in sys.modules if name.startswith(extension)}


def test_a_file_that_is_no_spectrum_leaves_the_library_alone(own):
    (own.parent / "odd.csv").write_text("nm,red\n400,blue\n")
    said = sentence(bpy.ops.rtb.import_spectra, filepath=str(own.parent / "odd.csv"))
    assert "odd.csv" in said
    assert not list(own.rglob("*.spd"))


def test_each_field_is_offered_what_fits_it(material, own, extension, previews):
    offers = sys.modules[f"{extension}.operators.use_library_spectrum"]

    def names(field):
        return [item[0] for item in offers._names(SimpleNamespace(field=field), bpy.context)]

    assert "Metals/Au gold eta" in names("ETA")
    assert not [name for name in names("K") if not name.endswith(" k")]
    assert "Glasses/water" in names("IOR")
    assert "D65" in names("LIGHT")
    assert not [name for name in names("REFLECTANCE") if name.startswith(("Metals/", "Glasses/"))]
    offers.forget()
    assert len(previews._thumbnails) == 0
    assert len(names("LIGHT")) == len(previews._thumbnails), "each has its curve as an icon"


def test_a_table_is_edited_as_numbers(material):
    table = [{"name": "", "wavelength": nm, "value": value} for nm, value in ((700, 0.5), (400, 0.25))]
    bpy.ops.rtb.use_table(field="REFLECTANCE", samples=table)
    assert material.reflectance == "400:0.25 700:0.5"
    table[0]["wavelength"] = 400
    assert "have the same wavelength" in sentence(bpy.ops.rtb.use_table, field="REFLECTANCE", samples=table)
    assert "the table is empty" in sentence(bpy.ops.rtb.use_table, field="REFLECTANCE")


def test_swatches_are_shown_under_the_chosen_light(material, previews, library):
    colours = []
    for light in ("D65", "A", ""):
        previews.forget()
        previews.shown("0.8", False, 40, light)
        previews.make_wanted()
        (preview,) = previews._pictures.values()
        pixels = np.empty(math.prod(preview.image_size) * 4, np.float32)
        preview.image_pixels_float.foreach_get(pixels)
        colours.append(pixels.reshape(40, 40, 4)[2, 30])
    assert colours[0][0] == pytest.approx(colours[0][2], abs=0.02), "white in daylight"
    assert colours[1][0] > 1.5 * colours[1][2], "orange in the light of a bulb"
    assert colours[2][3] == 0, "none for what has no colour"


def test_a_curve_goes_through_what_the_field_says_and_is_written_as_pairs(material, extension, library):
    curve = sys.modules[f"{extension}.operators.use_curve"]
    mapping = bpy.data.node_groups.new("Drawn", "ShaderNodeTree").nodes.new("ShaderNodeFloatCurve").mapping
    curve.lay(mapping, [0, 0.25, 0.5, 1], [0.2, 0.4, 0.4, 1])
    drawn = library("spectra.spoken").spectrum_from(curve.drawn(mapping, 0.5))
    assert [*drawn.wavelengths] == [*range(380, 781, 10)]
    assert drawn.at([380, 480, 530, 580, 780]) == pytest.approx([0.1, 0.2, 0.2, 0.2, 0.5], abs=1e-3)


def test_what_was_drawn_is_written_again_by_a_script(material):
    assert bpy.ops.rtb.use_curve(field="REFLECTANCE", pairs="400:0.2 700:0.8") == {"FINISHED"}
    assert material.reflectance == "400:0.2 700:0.8"
    assert "nothing has been drawn" in sentence(bpy.ops.rtb.use_curve, field="REFLECTANCE", pairs="")
