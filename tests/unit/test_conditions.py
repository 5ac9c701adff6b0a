"""The table of conditions, by the rules of old files."""

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtb_addon.conditions import Conditions, format_conditions, parse_conditions, read_conditions
from rtb_addon.errors import RecipeError

RTB3 = Path(os.environ.get("RTB3_FOLDER", Path(__file__).resolve().parents[3] / "shared" / "rtb3"))

RTB4 = Path(os.environ.get("RTB4_FOLDER", RTB3.parent / "rtb4"))
# Columns and rows of RenderToolbox4's, in no order.
RTB4_TABLES = [(2, 1), (2, 24), (3, 1), (3, 1), (9, 8)]

# Columns and rows of the tables that RenderToolbox3 shipped, counted by an independent reader.
OLD_TABLES = {
    "DiceTransformationsConditions": (2, 4),
    "DragonColorCheckerConditions": (2, 24),
    "DragonGradedConditions": (2, 6),
    "DragonMaterialsConditions": (2, 4),
    "InteriorConditions": (5, 6),
    "MaterialSphereConditions": (2, 3),
    "RadianceTestConditions": (9, 8),
    "ScalingTestConditions": (11, 6),
    "SimpleSquareConditions": (1, 24),
    "SpectralIllusionConditionsClever": (3, 1),
    "SpectralIllusionConditionsInitial": (3, 1),
}
# The same habits in a table of ours: several tabs, tabs at the end, blanks inside cells, comments.
OWN_TABLE = (
    "imageName\t\tlamp\t\t\theight\t\r\n"
    "  % the two of them\r\n"
    "\r\n"
    "day\t\t300:1 800:1\t\t2\t\r\n"
    "night bright\tresources/a b.spd\t5\r\n"
)


def table(text):
    return parse_conditions(text, "conditions.txt", "base")


def cells(text):
    return [list(row.cells.values()) for row in table(text)]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a\tb\n1\t2", [["1", "2"]]),
        ("a\t\t\tb\t\n1\t\t2\t", [["1", "2"]]),
        ("\ta\tb\n\t\t1\t2", [["1", "2"]]),
        ("a\tb\nx y\t300:0 800:0", [["x y", "300:0 800:0"]]),
        ("a,b\n1,2", [["1,2"]]),
        ("a\tb\n1\t,2", [["1", "2"]]),
        ("a\tb\n% c\td\n   % c\td\n1\t%d", [["1", "%d"]]),
        ("a\tb\n\n1\t2\n\n", [["1", "2"]]),
        ("a\tb\r\n1\t2\r\n", [["1", "2"]]),
        ("% what this is\n\na\tb\n1\t2", [["1", "2"]]),
        ("a\tb\n1 \t 2", [["1 ", " 2"]]),
        ('a\tb\n"1\t2"', [['"1', '2"']]),
        ("a\tb", []),
    ],
)
def test_a_line_splits_into_cells_as_it_always_did(text, expected):
    assert cells(text) == expected


def test_a_table_of_ours_with_all_the_old_habits():
    conditions = table(OWN_TABLE)
    assert conditions.variables == ("imageName", "lamp", "height")
    assert [row.name for row in conditions] == ["day", "night bright"]
    assert [row.line for row in conditions] == [4, 5]
    assert conditions["night bright"].cells["lamp"] == "resources/a b.spd"


def test_a_row_with_too_few_cells_says_where_and_for_which_variables():
    text = "imageName\tlight\tpaint\tgloss\n\n% a comment\nfirst\tD65\tred\n"
    with pytest.raises(RecipeError) as caught:
        table(text)
    assert str(caught.value) == (
        "conditions.txt:4: 3 values for 4 variables (imageName, light, paint, gloss)"
    )


@pytest.mark.parametrize("row", ["1", "1\t\t", "1\t2\t3"])
def test_an_old_table_goes_without_rows_of_another_length_and_says_so(row):
    conditions = parse_conditions(f"a\tb\n{row}\n3\t4\n", "conditions.txt", "base", old=True)
    assert [(each.name, each.cells["a"], each.line) for each in conditions] == [("base-001", "3", 3)]
    (remark,) = conditions.remarks
    assert str(remark).startswith("conditions.txt:2: ")
    assert str(remark).endswith("for 2 variables (a, b), the row is left out")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a\ta\n1\t2", "a names 2 columns, the first one counts"),
        ("a,b\n1,2", "the comma belongs to the name 'a,b', write tabs between names"),
        ("a \tb\n1\t2", "the blanks belong to the name 'a '"),
        ("a\tb", "no rows follow"),
    ],
)
def test_what_is_odd_in_a_header_is_said_with_its_place(text, words):
    (remark,) = table("% what this is\n" + text).remarks
    assert str(remark).startswith(f"conditions.txt:2: {words}")


def test_a_row_may_name_a_parent_scene_in_the_words_of_both_toolboxes():
    assert table("colladaFile\ta\nx.dae\t1").rows[0].parent_scene == "x.dae"
    assert table("parentScene\ta\nx.dae\t1").rows[0].parent_scene == "x.dae"
    assert table("a\n1").rows[0].parent_scene == ""


def test_rows_without_names_are_numbered():
    assert [row.name for row in table("paint\nred\nblue\n")] == ["base-001", "base-002"]
    assert [row.name for row in Conditions.single("base")] == ["base"]


def test_of_two_columns_of_one_name_the_first_counts():
    assert table("a\ta\n1\t2").rows[0].cells == {"a": "1"}


@pytest.mark.parametrize("twin", ["red", "RED"])
def test_two_rows_of_one_name_are_refused(twin):
    with pytest.raises(RecipeError, match=rf"conditions.txt:3: imageName {twin} stands in line 2 already"):
        table(f"imageName\nred\n{twin}\n")


@pytest.mark.parametrize("name", ["a/b", "..", "a\\b", "a:b", "con", "NUL.x", "x ", ".x", "a?", "x" * 201])
def test_a_name_that_is_no_file_name_is_refused(name):
    with pytest.raises(RecipeError, match=r"conditions.txt:2: .* cannot name files"):
        table(f"imageName\n{name}\n")


def test_a_missing_table_and_an_empty_one_are_errors(tmp_path):
    with pytest.raises(RecipeError, match="cannot read the conditions"):
        read_conditions(tmp_path / "none.txt", "base")
    with pytest.raises(RecipeError, match="must name the variables"):
        table("\n% nothing\n")


def test_an_unknown_condition_is_answered_with_those_that_are_there():
    with pytest.raises(RecipeError, match="no condition is called rad, there are red, blue"):
        table("imageName\nblue\nred\n")["rad"]


def test_old_files_in_latin_1_can_be_read(tmp_path):
    file = tmp_path / "conditions.txt"
    file.write_bytes("imageName\tpaint\nMünze\tweiß\n".encode("latin-1"))
    assert read_conditions(file, "base")["Münze"].cells["paint"] == "weiß"


@pytest.mark.parametrize("bad", ["", "a\tb", "a\nb", ",a", "\r"])
def test_a_cell_that_would_read_back_differently_is_not_written(bad):
    conditions = table("imageName\tpaint\nred\tx\n")
    row = conditions.rows[0]
    broken = Conditions(conditions.variables, (type(row)(row.name, {**row.cells, "paint": bad}),))
    with pytest.raises(RecipeError, match="a table cannot hold the cells"):
        format_conditions(broken)


CELL = st.text(st.characters(blacklist_characters="\t\n\r\v\f", codec="utf-8"), min_size=1).filter(
    lambda text: not text.startswith(("%", ",")) and text.strip() == text
)


@given(st.data(), st.lists(CELL, min_size=1, max_size=4, unique=True))
def test_conditions_survive_writing_and_reading(data, variables):
    variables = [name for name in variables if name != "imageName"] or ["a"]
    rows = data.draw(st.lists(st.lists(CELL, min_size=len(variables), max_size=len(variables)), max_size=4))
    text = "".join("\t".join(row) + "\n" for row in [variables, *rows])
    conditions = table(text)
    again = table(format_conditions(conditions))
    assert [row.cells for row in again] == [dict(zip(variables, row, strict=True)) for row in rows]
    assert again == conditions


def test_every_table_that_rendertoolbox4_shipped_reads_without_a_remark():
    if not RTB4.is_dir():
        pytest.skip(f"RENDERTOOLBOX4'S FILES ARE NOT HERE: no {RTB4}, set RTB4_FOLDER")
    found = [read_conditions(path, "base") for path in RTB4.rglob("*Conditions*.txt")]
    assert sorted((len(each.variables), len(each)) for each in found) == RTB4_TABLES
    assert not any(each.remarks for each in found)


def test_every_table_that_rendertoolbox3_shipped_reads_as_counted():
    if not RTB3.is_dir():
        pytest.skip(f"RENDERTOOLBOX3'S FILES ARE NOT HERE: no {RTB3}, set RTB3_FOLDER")
    found = {path.stem: path for path in RTB3.rglob("*Conditions*.txt")}
    counted = {name: read_conditions(path, name) for name, path in found.items()}
    assert {name: (len(each.variables), len(each)) for name, each in counted.items()} == OLD_TABLES
