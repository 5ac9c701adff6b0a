"""Addresses in a scene document: found, read, made and changed."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from rtb_addon.scene.paths import Child, find, numbers_in, parse_path, read, write

DOCUMENT = """<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema">
<asset><unit meter="0.01" name="centimeter"/></asset>
<node id="Lamp"><!-- a lamp --><translate sid="location">1 2 3</translate>
<scale sid="scale">1 1 1</scale></node>
<camera id="Eye-camera"><optics><technique_common><perspective><xfov sid="xfov">40</xfov></perspective>
</technique_common></optics></camera><node id="Twin" name="first"/><node id="Twin" name="last"/></COLLADA>"""


@pytest.fixture
def root():
    return etree.fromstring(DOCUMENT)


def changed(root, path, operator, value):
    known = write(root, parse_path(path), operator, value)
    return known, read(root, parse_path(path.removesuffix("$")))


def text_at(root, path):
    return read(root, parse_path(path))


def test_a_path_is_taken_apart():
    path = parse_path("Lamp:translate|sid=location.sid$")
    assert (path.id, path.children, path.attribute, path.naming) == (
        "Lamp",
        (Child("translate", "sid", "location"),),
        "sid",
        True,
    )
    assert parse_path("Lamp:translate=sid|location").children == path.children


@pytest.mark.parametrize("text", ["", ":a", "X:", "X:a|b|c|d", "X.a:b", "X$a", "X$:b"])
def test_what_is_no_path_is_refused(text):
    with pytest.raises(ValueError, match="want"):
        parse_path(text)


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("Lamp:translate|sid=location", "1 2 3"),
        ("Lamp:translate", "1 2 3"),
        ("Lamp:translate|sid", "1 2 3"),
        ("Lamp:scale.sid", "scale"),
        ("Lamp:scale.sid$", "sid"),
        ("Lamp$", "node"),
        ("Eye-camera:optics:technique_common:perspective:xfov", "40"),
        ("document:COLLADA:asset:unit.meter", "0.01"),
        ("Twin.name", "last"),
        ("Lamp", None),
        ("Lamp:rotate", None),
        ("Lamp:translate|sid=nowhere", None),
        ("Lamp.type", None),
        ("Nobody", None),
        ("document", None),
    ],
)
def test_what_a_path_leads_to(root, path, expected):
    assert text_at(root, path) == expected


@pytest.mark.parametrize(
    ("path", "operator", "value", "expected"),
    [
        ("Lamp:translate|sid=location", "=", "4 5 6", "4 5 6"),
        ("Lamp:translate|sid=location", "+=", "0 0 10", "1 2 13"),
        ("Lamp:translate|sid=location", "-=", "1", "0 1 2"),
        ("Lamp:scale|sid=scale", "*=", "2", "2 2 2"),
        ("Eye-camera:optics:technique_common:perspective:xfov", "=", "25", "25"),
        ("Eye-camera:optics:technique_common:perspective:xfov", "/=", "2", "20"),
        ("Lamp:translate", "/=", "3", "0.3333333333333333 0.6666666666666666 1"),
        ("document:COLLADA:asset:unit.meter", "*=", "100", "1"),
        ("Lamp.name", "=", "sun", "sun"),
        ("Lamp:extra", "+=", "1 2", "1 2"),
    ],
)
def test_operators_change_what_is_there(root, path, operator, value, expected):
    assert changed(root, path, operator, value) == (True, expected)


def test_changes_add_up(root):
    for _ in range(3):
        write(root, parse_path("Lamp:translate"), "+=", "1 0 0")
    assert text_at(root, "Lamp:translate") == "4 2 3"


def test_a_missing_child_is_appended_after_the_others_with_its_check(root):
    write(root, parse_path("Lamp:rotate|sid=rotationZ"), "=", "0 0 1 90")
    lamp = find(root, parse_path("Lamp"))
    assert lamp is not None
    assert [etree.QName(each).localname for each in lamp.iterchildren(etree.Element)] == [
        "translate",
        "scale",
        "rotate",
    ]
    assert lamp[-1].get("sid") == "rotationZ"
    assert etree.QName(lamp[-1]).namespace == root.nsmap[None]


def test_a_missing_id_is_made_once_and_said(root):
    assert write(root, parse_path("Ghost:scale"), "=", "1") is False
    assert write(root, parse_path("Ghost:scale"), "+=", "1") is True
    assert text_at(root, "Ghost$") == "merge"
    assert text_at(root, "Ghost:scale") == "2"


def test_names_of_elements_and_attributes_can_change(root):
    write(root, parse_path("Lamp$"), "=", "joint")
    write(root, parse_path("Lamp:scale.sid$"), "=", "kind")
    assert text_at(root, "Lamp$") == "joint"
    assert text_at(root, "Lamp:scale.kind") == "scale"
    assert text_at(root, "Lamp:scale.sid") is None


def test_an_element_that_gets_a_text_loses_its_children(root):
    assert changed(root, "Eye-camera:optics", "=", "none") == (True, "none")


@pytest.mark.parametrize(
    ("path", "operator", "value", "words"),
    [
        ("Lamp:translate", "+=", "1 2", "on 3 numbers needs as many or one, got 2"),
        ("Lamp:translate", "+=", "far", r"\+= needs numbers, got 'far'"),
        ("Lamp:translate", "/=", "0", "by zero"),
        ("Lamp:translate", "*=", "1e308 1e308 1e308", "finite"),
        ("document", "=", "x", "names? an element in it"),
        ("document:other", "=", "x", "root is no other"),
        ("Lamp$", "=", "no name", "cannot be the name"),
    ],
)
def test_changes_that_make_no_sense_are_refused(root, path, operator, value, words):
    with pytest.raises(ValueError, match=words):
        write(root, parse_path(path), operator, value)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 2.5 -3e2", [1, 2.5, -300]),
        ("300:0.1 800:0.7", [300]),
        ("1,2", [1]),
        (" \n4\t.5", [4, 0.5]),
        ("far", []),
        ("", []),
        ("inf", [float("inf")]),
    ],
)
def test_numbers_are_read_up_to_what_is_none(text, expected):
    assert numbers_in(text) == expected


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=4), st.floats(-1e3, 1e3))
def test_arithmetic_keeps_every_digit(numbers, more):
    root = etree.fromstring(DOCUMENT)
    write(root, parse_path("Lamp:translate"), "=", " ".join(map(repr, numbers)))
    write(root, parse_path("Lamp:translate"), "+=", repr(more))
    assert numbers_in(text_at(root, "Lamp:translate") or "") == [each + more for each in numbers]
