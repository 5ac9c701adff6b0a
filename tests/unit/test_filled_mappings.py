"""What mappings say for one condition."""

import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.mappings import read_mappings
from tests.unit.filled_mappings import OWN_FILE, filled, generic


def test_lines_of_a_block_that_nobody_reads_are_not_looked_into():
    assert filled("Strange {\nwhatever = [this\n}").objects == ()


def test_variables_are_put_in_literally_and_anywhere():
    text = "Collada {\n(what):translate|sid=(sid) = 0 0 -(height)\n}"
    (edit,) = filled(text, what="Lamp", sid="location").edits
    assert (edit.path, edit.value) == ("Lamp:translate|sid=location", "0 0 -2.5")
    (edit,) = filled("Collada {\nLamp.name = (a.b)\n}", **{"a.b": r"\1 $1"}).edits
    assert edit.value == r"\1 $1"


def test_what_an_earlier_column_puts_in_a_later_one_may_fill():
    (edit,) = filled("Collada {\nLamp.name = (first)\n}", first="(second)", second="x").edits
    assert edit.value == "x"


def test_a_path_in_brackets_is_read_from_the_parent_scene_before_any_change():
    text = "Collada {\nLamp:translate|sid=location = 9 9 9\nLamp.name = [Lamp:translate|sid=location]\n}"
    assert [edit.value for edit in filled(text).edits] == ["9 9 9", "1 2 3"]


def test_groups_choose_among_blocks():
    def paint(**cells):
        return filled(OWN_FILE, "tracer", **cells).objects[-1].properties[-1].value

    assert paint(groupName="night") == "300:0 800:0"
    assert paint(groupName="day") == "300:0.5 800:0.75"
    assert paint() == "300:0.5 800:0.75"  # without a group every block counts, in order


def test_lines_about_one_id_are_one_object_within_their_block():
    first, second = filled(
        generic("X:radius.float = 1", "Y:light:spot", "X:light:point", "X:intensity = 300:1")
    ).objects
    assert (first.id, first.category, first.model, first.line) == ("X", "light", "point", 4)
    assert [(each.name, each.type, each.value) for each in first.properties] == [
        ("radius", "float", "1"),
        ("intensity", "", "300:1"),
    ]
    assert second.id == "Y"


def test_files_are_looked_up_where_a_value_may_be_one(tmp_path):
    asked = []

    def find_file(name):
        asked.append(name)
        return tmp_path / name

    text = generic("X:light:point", "X:intensity.spectrum = (lamp).spd", "X:radius.float = 0.5", "X:a = b c")
    (thing,) = filled(text, find_file=find_file).objects
    assert asked == ["D65.spd"]
    assert thing.properties[0].found == tmp_path / "D65.spd"
    filled(generic("X:a.spectrum = 300:0.5 800:0.75"), find_file=find_file)
    assert asked == ["D65.spd"]


def test_a_missing_file_is_an_error(tmp_path):
    with pytest.raises(RecipeError, match="cannot read the mappings"):
        read_mappings(tmp_path / "mappings.txt")
