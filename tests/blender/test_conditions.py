"""The table of conditions, edited as its panel's buttons and menus edit it."""

import sys
from types import SimpleNamespace

import bpy
import pytest

from tests.blender.stand_in_layout import RecordingLayout
from tests.blender.tables import ROWS, column, sentence, table, variables


def test_a_row_is_added_like_the_active_one(settings):
    assert bpy.ops.rtb.add_condition() == {"FINISHED"}
    assert table(settings) == [*ROWS, ("", "0.2", "A")]
    assert settings.active_condition == 3


def test_a_copy_comes_below_under_a_name_of_its_own(settings):
    bpy.ops.rtb.duplicate_condition()
    bpy.ops.rtb.duplicate_condition()
    assert [row[0] for row in table(settings)] == ["a", "b", "b-2", "b-3", "c"]
    assert table(settings)[3][1:] == ("0.2", "A")


def test_rows_move_and_stay_within_the_table(settings):
    bpy.ops.rtb.move_condition(by=-1)
    assert [row[0] for row in table(settings)] == ["b", "a", "c"]
    bpy.ops.rtb.move_condition(by=-1)
    assert settings.active_condition == 0
    bpy.ops.rtb.move_condition(by=9)
    assert [row[0] for row in table(settings)] == ["a", "c", "b"]
    assert settings.active_condition == 2


def test_the_active_row_stays_one_that_is_there(settings):
    settings.active_condition = 2
    for left in (2, 1, 0):
        bpy.ops.rtb.remove_condition()
        assert len(settings.conditions) == left
        assert settings.active_condition == max(left - 1, 0)
    assert not bpy.ops.rtb.remove_condition.poll()


def test_a_new_variable_says_the_same_in_every_row(settings):
    bpy.ops.rtb.add_variable(name="gloss", value="0.5")
    assert variables(settings) == ["paint", "light", "gloss"]
    assert column(settings, "gloss") == ["0.5"] * 3
    assert settings.active_variable == 2


def test_the_first_variable_brings_the_first_row(empty):
    bpy.ops.rtb.add_variable(name="paint", value="0.5")
    assert table(empty) == [("", "0.5")]


def test_columns_are_copied_moved_and_removed_with_their_cells(settings):
    settings.active_variable = 0
    bpy.ops.rtb.duplicate_variable()
    assert variables(settings) == ["paint", "paint-2", "light"]
    assert column(settings, "paint-2") == ["0.1", "0.2", "0.3"]
    bpy.ops.rtb.move_variable(by=1)
    assert variables(settings) == ["paint", "light", "paint-2"]
    assert column(settings, "light") == ["D65", "A", "FL2"]
    settings.active_variable = 0
    bpy.ops.rtb.remove_variable()
    assert table(settings) == [("a", "D65", "0.1"), ("b", "A", "0.2"), ("c", "FL2", "0.3")]


def test_a_variable_is_renamed_wherever_spectra_name_it(settings):
    bpy.data.materials["Material"].rtb.reflectance = "(paint)"
    bpy.data.lights["Light"].rtb.spectrum = "400:(light) 700:0.5"
    bpy.ops.rtb.rename_variable(name="lamp")
    settings.active_variable = 0
    bpy.ops.rtb.rename_variable(name="cover")
    assert variables(settings) == ["cover", "lamp"]
    assert bpy.data.materials["Material"].rtb.reflectance == "(cover)"
    assert bpy.data.lights["Light"].rtb.spectrum == "400:(lamp) 700:0.5"


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("", "cannot name"),
        ("a(b", "cannot name"),
        ("imageName", "the condition itself"),
        ("paint", "already"),
    ],
)
def test_a_name_that_no_variable_can_have_is_refused(settings, name, why):
    assert why in sentence(bpy.ops.rtb.rename_variable, name=name)
    assert why in sentence(bpy.ops.rtb.add_variable, name=name)
    assert variables(settings) == ["paint", "light"]


def test_undo_takes_an_edit_of_the_table_back_exactly(settings):
    bpy.ops.ed.undo_push(message="before")
    before = table(settings)
    bpy.ops.rtb.duplicate_variable("EXEC_DEFAULT", True)
    assert table(bpy.context.scene.rtb) != before
    bpy.ops.ed.undo()
    assert table(bpy.context.scene.rtb) == before
    assert variables(bpy.context.scene.rtb) == ["paint", "light"]


def test_rows_with_cells_too_few_are_edited_as_if_those_were_empty(settings):
    settings.conditions.add().name = "short"
    bpy.ops.rtb.move_variable(by=-1)
    bpy.ops.rtb.add_variable(name="gloss", value="1")
    assert table(settings)[-1] == ("short", "", "", "1")


def test_what_a_spreadsheet_copied_arrives_as_rows(settings):
    bpy.ops.rtb.paste_conditions(text="imageName\tlight\tgloss\nd\tD50\t0.9\n")
    assert variables(settings) == ["paint", "light", "gloss"]
    assert table(settings)[-1] == ("d", "", "D50", "0.9")


def test_cells_without_names_go_into_the_columns_from_the_left(settings):
    bpy.ops.rtb.paste_conditions(text="0.7\tC\n0.8\tD50\n")
    assert table(settings)[-2:] == [("", "0.7", "C"), ("", "0.8", "D50")]
    bpy.ops.rtb.paste_conditions(text="named\t0.9\tD75\n")
    assert table(settings)[-1] == ("named", "0.9", "D75")


def test_pasting_more_cells_than_columns_is_refused_before_anything_changes(settings):
    assert "4 cells for 2 columns" in sentence(bpy.ops.rtb.paste_conditions, text="1\t2\t3\t4\n")


def test_the_whole_table_survives_a_spreadsheet(settings, extension):
    rows = sys.modules[f"{extension}.rtb_addon.blender.table_texts"].table_rows(settings)
    text = sys.modules[f"{extension}.rtb_addon.spreadsheets"].format_rows(rows)
    before = table(settings)
    bpy.ops.rtb.paste_conditions(text=text, replace=True)
    assert table(settings) == before


@pytest.mark.parametrize("ending", ["tsv", "csv", "txt"])
def test_the_whole_table_survives_a_file(settings, tmp_path, ending):
    before, file = table(settings), str(tmp_path / f"table.{ending}")
    bpy.ops.rtb.export_conditions(filepath=file)
    settings.conditions.clear()
    bpy.ops.rtb.import_conditions(filepath=file)
    assert table(settings) == before
    assert variables(settings) == ["paint", "light"]


def test_a_file_that_is_no_table_is_refused_with_its_name(settings, tmp_path):
    (tmp_path / "odd.csv").write_text("a,a\n1,2\n")
    assert sentence(bpy.ops.rtb.import_conditions, filepath=str(tmp_path / "odd.csv")).startswith(
        "Error: odd.csv"
    )
    assert "cannot read" in sentence(bpy.ops.rtb.import_conditions, filepath=str(tmp_path / "gone.csv"))


def test_marked_patches_become_rows_of_their_names(empty):
    marked = [number in (0, 12) for number in range(32)]
    bpy.ops.rtb.fill_from_library(variable="paint", group="BabelColor Average", marked=marked)
    assert table(empty) == [
        ("dark skin", "BabelColor Average/dark skin"),
        ("blue", "BabelColor Average/blue"),
    ]
    assert "did you mean" in sentence(bpy.ops.rtb.fill_from_library, variable="paint", names="D64")


def test_new_rows_take_the_place_of_a_single_one_that_was_never_named(empty):
    bpy.ops.rtb.add_variable(name="paint")
    assert table(empty) == [("", "")]
    bpy.ops.rtb.fill_range(variable="paint", first=0.1, last=0.2, count=2)
    assert table(empty) == [("paint-1", "0.1"), ("paint-2", "0.2")]


def test_a_group_of_more_spectra_than_can_be_marked_at_once_comes_in_parts(empty, monkeypatch, module):
    verb = module("operators.fill_from_library")
    monkeypatch.setattr(verb, "MOST", 10)
    verb.forget()
    marked = [number == 2 for number in range(32)]
    bpy.ops.rtb.fill_from_library(variable="paint", group="BabelColor Average from 11", marked=marked)
    assert column(empty, "paint") == ["BabelColor Average/blue"]
    verb.forget()


def test_a_range_adds_rows_like_the_active_one(settings):
    bpy.ops.rtb.fill_range(variable="paint", first=0.1, last=0.3, count=3)
    assert table(settings)[3:] == [
        ("paint-1", "0.1", "A"),
        ("paint-2", "0.2", "A"),
        ("paint-3", "0.3", "A"),
    ]


def test_every_combination_makes_a_factorial_design_with_unique_names(settings):
    bpy.ops.rtb.fill_range(variable="gloss", first=0, last=1, count=2, how="CROSS")
    assert len(settings.conditions) == 6
    assert set(zip(column(settings, "paint"), column(settings, "gloss"), strict=True)) == {
        (paint, gloss) for paint in ("0.1", "0.2", "0.3") for gloss in ("0", "1")
    }
    assert len({row.name for row in settings.conditions}) == 6


def test_values_go_down_the_rows_there_are(settings):
    bpy.ops.rtb.fill_range(variable="paint", first=5, last=7, count=3, how="FILL")
    assert table(settings) == [("a", "5", "D65"), ("b", "6", "A"), ("c", "7", "FL2")]
    assert "2 values for 3 rows" in sentence(bpy.ops.rtb.fill_range, variable="new", count=2, how="FILL")
    assert "cannot name" in sentence(bpy.ops.rtb.fill_random, ranges="new = 0 1; (odd) = 0 1")
    assert variables(settings) == ["paint", "light"]


def test_a_list_is_typed_between_commas_or_semicolons(empty):
    bpy.ops.rtb.fill_list(variable="light", values="D65, 300:1 800:2 , A")
    assert column(empty, "light") == ["D65", "300:1 800:2", "A"]
    bpy.ops.rtb.fill_list(variable="light", values="1,5; 2", how="ADD")
    assert column(empty, "light")[3:] == ["1,5", "2"]
    assert "there are no values" in sentence(bpy.ops.rtb.fill_list, variable="light", values=" , ")


def test_a_grid_of_several_variables_is_filled_in_at_once(empty):
    bpy.ops.rtb.fill_grid(values="paint = 0.2, 0.5; light = D65, A")
    assert [row[1:] for row in table(empty)] == [("0.2", "D65"), ("0.2", "A"), ("0.5", "D65"), ("0.5", "A")]


@pytest.mark.parametrize("sequence", ["SOBOL", "RANDOM"])
def test_random_rows_repeat_with_their_seed(empty, sequence):
    drawn = []
    for seed in (1, 1, 2):
        empty.conditions.clear()
        bpy.ops.rtb.fill_random(ranges="paint = 0 1; gloss = 5 6", count=8, seed=seed, sequence=sequence)
        drawn.append([row[1:] for row in table(empty)])
    assert drawn[0] == drawn[1] != drawn[2]
    assert all(5 <= float(row[1]) <= 6 for row in drawn[0])


def test_graded_rows_begin_and_end_with_the_spectra_that_were_said(empty, library):
    bpy.ops.rtb.fill_graded(variable="paint", first="0.2", last="BabelColor Average/blue", count=3)
    spectrum_from = library("spectra.spoken").spectrum_from
    cells = [spectrum_from(text).at([450, 600]) for text in column(empty, "paint")]
    blue = library("spectra.library").find("BabelColor Average/blue").at([450, 600])
    assert cells[0] == pytest.approx(0.2)
    assert cells[1] == pytest.approx((0.2 + blue) / 2, abs=1e-6)
    assert cells[2] == pytest.approx(blue, abs=1e-6)


def test_conditions_made_by_buttons_are_those_of_the_recipe(empty, library):
    bpy.data.materials["Material"].rtb.use_spectra = True
    bpy.data.materials["Material"].rtb.reflectance = "(paint)"
    bpy.ops.rtb.fill_from_library(variable="paint", names="BabelColor Average/blue; BabelColor Average/red")
    bpy.context.scene.rtb.folder = "/nowhere/"
    recipe = library("blender").read_recipe(bpy.context.scene)
    assert [(row.name, row.cells["paint"]) for row in recipe.conditions] == [
        ("blue", "resources/BabelColor-Average-blue.spd"),
        ("red", "resources/BabelColor-Average-red.spd"),
    ]


def drawn(extension, name: str, width: int = 250, **attributes) -> RecordingLayout:
    """Let a class of the table's panel draw into a stand-in."""
    kind = getattr(bpy.types, name)
    layout = RecordingLayout()
    context = SimpleNamespace(
        scene=bpy.context.scene,
        region=SimpleNamespace(width=width),
        window_manager=bpy.context.window_manager,
    )
    if name == "RTB_UL_conditions":
        rows = bpy.context.scene.rtb.conditions
        for index, row in enumerate(rows):
            kind.draw_item(None, context, layout, None, row, 0, None, "", index)
    else:
        kind.draw(SimpleNamespace(layout=layout), context)
    return layout


def test_a_scene_without_table_shows_how_to_begin(empty, extension):
    assert drawn(extension, "RTB_PT_conditions").names("operator") == ["rtb.add_variable"]


def test_the_panel_draws_a_header_a_list_and_the_active_cell(settings, extension):
    layout = drawn(extension, "RTB_PT_conditions")
    assert layout.names("operator").count("rtb.select_variable") == 2
    assert layout.names("list") == ["RTB_UL_conditions"]
    assert layout.names("prop")[-2:] == ["value", "rtb_preview"]


def test_columns_that_do_not_fit_are_on_other_pages(settings, extension):
    for name in "efgh":
        bpy.ops.rtb.add_variable(name=name)
    narrow, wide = (
        len(drawn(extension, "RTB_UL_conditions", width).names("prop")) / 3 for width in (250, 600)
    )
    assert narrow < wide == 7
    seen = []
    for first in range(0, 6, int(narrow) - 1):
        bpy.ops.rtb.turn_page(first=first)
        seen += sys.modules[f"{extension}.panels.conditions"].columns_shown(
            SimpleNamespace(
                scene=bpy.context.scene,
                region=SimpleNamespace(width=250),
                window_manager=bpy.context.window_manager,
            )
        )
    assert set(seen) == set(range(6))


@pytest.mark.parametrize("menu", ["RTB_MT_conditions", "RTB_MT_designs", "RTB_MT_variable"])
def test_menus_hold_operators_that_are_there(settings, extension, menu):
    assert drawn(extension, menu).names("operator")
