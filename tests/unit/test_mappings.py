"""Mappings files: blocks and lines, read and written."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rtb_addon.errors import RecipeError
from rtb_addon.mappings import format_blocks, format_mappings, parse_mappings, read_mappings
from rtb_addon.mappings.lines import parse_statement, parse_target
from tests.unit.filled_mappings import OLD_FILES, OWN_FILE, RTB3, filled, generic


def counts(mappings):
    statements = [parse_statement(each.text) for block in mappings.blocks for each in block.mappings]
    declared = sum(not each.operator for each in statements)
    return len(mappings.blocks), declared, len(statements) - declared


def test_a_file_of_ours_with_every_kind_of_block():
    mappings = parse_mappings(OWN_FILE, "mappings.txt")
    assert counts(mappings) == (8, 4, 10)
    assert [(block.kind, block.group) for block in mappings.blocks[:4]] == [
        ("Collada", ""),
        ("Generic", ""),
        ("Generic", "night"),
        ("Generic", "day"),
    ]


def test_every_file_that_rendertoolbox3_shipped_reads_as_counted():
    if not RTB3.is_dir():
        pytest.skip(f"RENDERTOOLBOX3'S FILES ARE NOT HERE: no {RTB3}, set RTB3_FOLDER")
    found = {path.stem: read_mappings(path) for path in RTB3.rglob("*Mappings.txt")}
    assert {name: counts(each) for name, each in found.items()} == OLD_FILES


@pytest.mark.parametrize(
    ("line", "left", "operator", "right"),
    [
        ("X:light:point", "X:light:point", "", ""),
        ("X:intensity.spectrum = 300:1 800:1", "X:intensity.spectrum", "=", "300:1 800:1"),
        ("X:intensity.spectrum  = 300:1", "X:intensity.spectrum", "=", "300:1"),
        ("X:translate|sid=location += 0 0 (h)", "X:translate|sid=location", "+=", "0 0 (h)"),
        ("a = b = c", "a", "=", "b = c"),
        ("X:name = ", "X:name", "=", ""),
        ("<X:a.b> = c", "X:a.b", "=", "c"),
        ("X:a.b = 1 % one", "X:a.b", "=", "1 % one"),
    ],
)
def test_the_first_operator_between_blanks_splits_a_line(line, left, operator, right):
    statement = parse_statement(line)
    assert (statement.left.value, statement.operator, statement.right.value) == (left, operator, right)


def test_brackets_enclose_a_value_and_drop_what_is_outside():
    assert parse_statement("X:a.b = [Y:c.d]").right == ("Y:c.d", "[]")
    assert parse_statement("X:a = x [Y:c] <Z:d> y").right == ("Z:d", "<>")
    with pytest.raises(ValueError, match="without its"):
        parse_statement("X:a = [Y:c")


def test_the_kind_of_delimiter_in_a_target_does_not_matter():
    assert parse_target("Point-light:intensity:spectrum") == parse_target("Point-light:intensity.spectrum")
    assert parse_target("X:intensity") == ("X", "intensity", "")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Generic night {\n}", ("Generic", "night")),
        ("Generic{\n}", ("Generic", "")),
        ("Mitsuba path {\n}", ("Mitsuba", "path")),
        ("  Collada   {\n}", ("Collada", "")),
    ],
)
def test_a_block_begins_with_its_type_and_its_group(text, expected):
    (block,) = parse_mappings(text, "m").blocks
    assert (block.kind, block.group) == expected


def test_a_brace_alone_begins_no_block():
    assert parse_mappings("{\n}\n", "m").blocks == ()


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("Generic { X:light:point }\n}", 1, "'X:light:point }' is lost"),
        ("Generic {\nX:light:point }\n", 2, "'X:light:point' is lost"),
        ("some day Generic night {\n}", 1, "'some day' is lost"),
        ("Generic {\nX:light:point\n}\nX:radius = 1\n", 4, "counts to the Generic block above"),
        ("X:light:point\nGeneric {\n}", 1, "outside of all blocks does nothing"),
        ("Generic {\nCollada {\n}", 2, "begins inside another one"),
        ("Generic {\n", 1, "never ends"),
        ("}\n", 1, "a } without a block"),
        ("Genric {\nX:light:point\n}", 1, "nobody reads a block of type Genric"),
        ("Generic {\nX:light:point\nX:radius += 1\n}", 3, "+= acts like ="),
        ("Generic {\nX:light:point\nX:radius = <Y:c>\n}", 3, "Mitsuba's adjustments have nothing at <Y:c>"),
        (generic("X:intensity.spectrum= 300:1"), 2, "holds no operator and is lost, write it with spaces"),
        (generic("X:intensity.spectrum\t=\tD65"), 2, "holds no operator and is lost"),
        ("Collada {\nLamp:scale|sid=scale=1\n}", 2, "holds no operator and is lost"),
        ("Collada {\nLamp:translate|sid=location\n}", 2, "holds no operator and is lost"),
        (generic("X:a:b:c:d = 1"), 2, "is lost; want id:category:type or id:property.type = value"),
        (generic("X:light"), 2, "is lost; want id:category:type"),
        (generic("X:a.float = [Nobody:there]"), 2, "has nothing at [Nobody:there], the value is empty"),
        (generic("X:a.string = (b)"), 2, "no variable is called b, the conditions have"),
        ("Collada {\n(who):scale = 1\n}", 2, "no variable is called who"),
    ],
)
def test_odd_lines_are_remarked_upon_with_their_place(text, line, words):
    remarks = filled(text).remarks
    assert [each.line for each in remarks] == [line]
    assert words in remarks[0].message
    assert str(remarks[0]).startswith(f"mappings.txt:{line}: ")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (generic("X:intensity.spectrum = [Lamp"), r"'\[' without its '\]'"),
        ("Collada {\nLamp:translate|a=b=c=d = 1\n}", "want :child or :child|name=value"),
        (generic("X:intensity.spectrum = (colour)"), "no variable is called colour, the conditions have"),
        (generic("X:a.float = [Lamp]"), r"at \[Lamp\] is no text but other elements"),
    ],
)
def test_wrong_lines_are_refused_with_their_place(text, words):
    with pytest.raises(RecipeError, match=rf"^mappings.txt:2: .*{words}"):
        filled(text)


def test_a_property_that_a_generic_block_sets_twice_is_refused():
    text = generic("X:light:point", "X:radius.float = 1", "X:radius.float = 2")
    with pytest.raises(RecipeError, match=r"^mappings.txt:4: radius of X is set in line 3 already"):
        filled(text)


@given(st.text(st.characters(codec="utf-8")))
def test_any_text_at_all_is_kept_whole_or_refused_with_its_place(text):
    try:
        kept = format_mappings(parse_mappings(text, "mappings.txt"))
    except RecipeError as error:
        kept = text if error.line else str(error)
    assert kept == text


WORD = st.text("abcXYZ019_-", min_size=1, max_size=8)

VALUE = st.text("abc019.:() -+", min_size=1, max_size=12).map(str.strip).filter(bool)

LINE = st.one_of(
    st.builds("{}:{}:{}".format, WORD, WORD, WORD),
    st.builds("{}:{}.{} = {}".format, WORD, WORD, WORD, VALUE),
)

BLOCK = st.tuples(
    st.sampled_from(["Generic", "Mitsuba", "Tracer"]), st.one_of(st.just(""), WORD), st.lists(LINE)
)


@settings(max_examples=40)
@given(st.lists(BLOCK, max_size=5))
def test_blocks_survive_writing_and_reading(blocks):
    text = "".join(
        f"{kind} {group} {{\n" + "".join(f"    {line}\n" for line in lines) + "}\n% so much\n"
        for kind, group, lines in blocks
    )
    mappings = parse_mappings(format_mappings(parse_mappings(text, "m")), "m")
    for version in (mappings, parse_mappings(format_blocks(mappings.blocks), "m")):
        read = [(each.kind, each.group, [line.text for line in each.mappings]) for each in version.blocks]
        assert read == blocks
