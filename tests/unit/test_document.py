"""Parent scenes: read safely, changed in copies."""

import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.scene.adjustments import Adjustments, PathEdit
from rtb_addon.scene.document import Scene

TEXT = """<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<node id="Lamp" name="Lämpchen"><translate sid="location">1 2 3</translate></node></COLLADA>"""


def edit(path, operator, value, line=3):
    return PathEdit(path, operator, value, "mappings.txt", line)


def test_a_document_is_read_and_written_back():
    scene = Scene.parse(TEXT.encode(), "parent.dae")
    assert scene.ids == ("Lamp",)
    again = Scene.parse(scene.tobytes(), "parent.dae")
    assert again.value_at("Lamp.name") == "Lämpchen"


@pytest.mark.parametrize("encoding", ["utf-16", "latin-1", "cp1252", "utf-8-sig"])
def test_other_encodings_are_read_as_they_say(encoding):
    declared = encoding.removesuffix("-sig")
    text = TEXT.replace('encoding="utf-8"', f'encoding="{declared}"')
    assert Scene.parse(text.encode(encoding), "parent.dae").value_at("Lamp.name") == "Lämpchen"


@pytest.mark.parametrize(
    "prolog",
    [
        '<!DOCTYPE COLLADA [<!ENTITY x SYSTEM "file:///etc/passwd">]>',
        '<!DOCTYPE COLLADA [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;">]>',
        '<!DOCTYPE COLLADA SYSTEM "http://somewhere/collada.dtd">',
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_a_document_with_entities_or_a_document_type_is_refused(prolog, encoding):
    text = TEXT.replace("<COLLADA", f"{prolog}<COLLADA").replace('"utf-8"', f'"{encoding}"')
    with pytest.raises(RecipeError, match="may declare no document type and no entities"):
        Scene.parse(text.encode(encoding), "parent.dae")


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "no XML"),
        (b"<COLLADA><node></COLLADA>", "parent.dae:1: this is no XML"),
        (b"<scene/>", "this is a scene document, want Collada"),
        (b'<?xml version="1.0" encoding="ibm037"?><COLLADA/>', "its encoding is ibm037, save it as UTF-8"),
        (b'<?xml version="1.0" encoding="nonsense"?><COLLADA/>', "its encoding is nonsense"),
        (b'<?xml version="1.0" encoding="utf-16"?><COLLADA/>', "its encoding is utf-16"),
        (b'<?xml version="1.0" encoding="ascii"?><COLLADA a="\xe4"/>', "its text is not ascii"),
        (b"<COLLADA>&nothing;</COLLADA>", "no XML"),
    ],
)
def test_what_is_no_collada_is_refused_in_a_sentence(content, words):
    with pytest.raises(RecipeError, match=words):
        Scene.parse(content, "parent.dae")


def test_a_missing_parent_scene_is_an_error(tmp_path):
    with pytest.raises(RecipeError, match="cannot read the parent scene"):
        Scene.read(tmp_path / "parent.dae")


def test_edits_change_a_copy_in_order():
    scene = Scene.parse(TEXT.encode(), "parent.dae")
    path = "Lamp:translate|sid=location"
    changed = scene.adjusted(Adjustments((edit(path, "+=", "1"), edit(path, "*=", "2"))))
    assert changed.value_at(path) == "4 6 8"
    assert scene.value_at(path) == "1 2 3"


def test_the_same_adjustments_are_not_applied_twice():
    scene = Scene.parse(TEXT.encode(), "parent.dae")
    once = Adjustments((edit("Lamp:translate", "+=", "1"),))
    assert scene.adjusted(once).adjusted(once).value_at("Lamp:translate") == "2 3 4"
    assert scene.adjusted(Adjustments()) is scene


def test_an_edit_of_an_id_that_is_not_there_is_remarked_upon():
    scene = Scene.parse(TEXT.encode(), "parent.dae")
    (remark,) = scene.adjusted(Adjustments((edit("Lam:scale", "=", "1 1 1"),))).remarks
    assert str(remark) == "mappings.txt:3: nothing in parent.dae has the id Lam, there are Lamp"


def test_an_edit_that_makes_no_sense_says_where_it_stands():
    scene = Scene.parse(TEXT.encode(), "parent.dae")
    with pytest.raises(RecipeError, match=r"^mappings.txt:3: "):
        scene.adjusted(Adjustments((edit("Lamp:translate", "+=", "1 2"),)))


def test_a_link_that_leads_nowhere_lists_what_there_is():
    scene = Scene.parse(TEXT.encode(), "parent.dae")
    with pytest.raises(RecipeError, match="there is no node #Lmp, only Lamp"):
        scene.linked("#Lmp", "node")
