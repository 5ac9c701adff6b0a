"""Columns with types: their fields, their guesses, pairs, and files from before there were any."""

import bpy
import pytest

from tests.blender.tables import column, sentence, table


def kinds(settings) -> dict[str, str]:
    return {each.name: each.kind for each in settings.variables}


def test_types_are_what_columns_are_used_for_and_what_their_cells_are(empty):
    bpy.data.materials["Material"].rtb.reflectance = "(paint)"
    rows = [("0.5", "3", "Cube", "red"), ("0.6", "4.5", "Camera", "green")]
    empty.set_conditions(["paint", "height", "thing", "word"], rows)
    assert kinds(empty) == {"paint": "SPECTRUM", "height": "NUMBER", "thing": "OBJECT", "word": "TEXT"}
    bpy.ops.rtb.fill_range(variable="gloss", how="CROSS", count=2)
    bpy.ops.rtb.fill_from_library(variable="light", names="D65", how="CROSS")
    assert (kinds(empty)["gloss"], kinds(empty)["light"]) == ("NUMBER", "SPECTRUM")


@pytest.mark.parametrize(
    ("view", "value", "text"),
    [
        ("number", 0.1, "0.1"),
        ("number", 1234567.0, "1234567"),
        ("number", -2.5e-7, "-2.5e-07"),
        ("colour", (0.8, 0.25, 0.1), "0.8 0.25 0.1"),
    ],
)
def test_a_field_and_its_text_are_the_same_cell(empty, view, value, text):
    empty.set_conditions(["v"], [[""]])
    cell = empty.conditions[0].cells[0]
    setattr(cell, view, value)
    assert cell.value == text
    found = getattr(cell, view)
    assert (tuple(found) if view == "colour" else found) == pytest.approx(value, rel=1e-7)


def test_a_spectrum_of_a_chart_is_called_briefly_and_so_are_others_of_it(empty):
    empty.set_conditions(["v"], [["BabelColor Average/blue"]])
    cell = empty.conditions[0].cells[0]
    assert cell.short == "blue"
    cell.short = "blue"
    assert cell.value == "BabelColor Average/blue"
    cell.short = "yellow green"
    assert cell.value == "BabelColor Average/yellow green"
    for text in ("0.5", "D65", "//spectra/paint.spd", "300:1 800:2"):
        cell.short = text
        assert (cell.value, cell.short) == (text, text)


def test_the_type_changes_and_the_cells_stay(settings):
    before = table(settings)
    bpy.ops.rtb.set_variable_kind(kind="COLOUR")
    assert kinds(settings)["light"] == "COLOUR"
    bpy.ops.rtb.duplicate_variable()
    assert kinds(settings)["light-2"] == "COLOUR"
    bpy.ops.rtb.remove_variable()
    assert table(settings) == before


def test_a_colour_is_a_spectrum_that_shows_it_where_a_spectrum_is_wanted(empty, library, tmp_path):
    material = bpy.data.materials["Material"]
    material.rtb.use_spectra, material.rtb.reflectance = True, "(paint)"
    empty.set_conditions(["paint"], [["0.8 0.2 0.1"]])
    empty.variables[0].kind = "COLOUR"
    empty.folder = "/nowhere/"
    recipe = library("blender").read_recipe(bpy.context.scene)
    name = recipe.conditions.rows[0].cells["paint"].removeprefix("resources/")
    (tmp_path / name).write_bytes(recipe.resources[name])
    spectrum = library("spectra.files").read_spd(tmp_path / name)
    assert spectrum.at([650, 545, 450]) == pytest.approx([0.8, 0.2, 0.1])


def test_pairs_are_every_condition_with_an_object_and_without_it(settings, library):
    assert bpy.ops.rtb.fill_pairs(object="Cube", variable="cube", how="CROSS") == {"FINISHED"}
    assert column(settings, "cube") == ["1", "0"] * 3
    assert [row.name for row in settings.conditions][:2] == ["a-with-Cube", "a-without-Cube"]
    settings.folder = "/nowhere/"
    recipe = library("blender").read_recipe(bpy.context.scene)
    files = {"": recipe.parent, "parent.dae": recipe.parent}
    files |= {f"resources/{name}": content for name, content in recipe.resources.items()}
    there = [b"Cube-mesh" in files[row.parent_scene] for row in recipe.conditions]
    assert there == [True, False] * 3
    assert not bpy.data.objects["Cube"].hide_render


def test_pairs_without_an_object_are_refused(settings):
    assert "no object is called" in sentence(bpy.ops.rtb.fill_pairs, object="Ball")


def test_a_variable_is_renamed_in_mappings_too(settings):
    bpy.ops.rtb.vary_property(home="objects", thing="Light", path="location", index=2, variable="height")
    settings.mappings_text = bpy.data.texts.new("Mappings")
    settings.mappings_text.write("Collada {\n    Cube:scale|sid=scale = (height) 1 1\n}\n")
    bpy.ops.rtb.rename_variable(name="distance")
    assert settings.mappings[0].value == "(distance)"
    assert "(distance) 1 1" in settings.mappings_text.as_string()


def test_a_file_of_the_first_schema_gets_types_when_it_is_opened(settings, library, tmp_path):
    bpy.data.materials["Material"].rtb.reflectance = "(light)"
    for variable in settings.variables:
        variable.property_unset("kind")
    migrating = bpy.app.handlers.save_pre[:]
    bpy.app.handlers.save_pre.clear()
    try:
        settings.property_unset("schema")
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "first.blend"))
    finally:
        bpy.app.handlers.save_pre.extend(migrating)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "first.blend"))
    opened = bpy.context.scene.rtb
    assert opened.schema == library("blender.migration").SCHEMA == 2
    assert kinds(opened) == {"paint": "NUMBER", "light": "SPECTRUM"}


def test_a_file_of_a_later_version_is_not_written_as_if_it_were_understood(settings, library):
    settings.schema = 99
    with pytest.raises(RuntimeError, match="later RenderToolbox"):
        bpy.ops.rtb.export_recipe()
