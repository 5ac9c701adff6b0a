"""The neutral scene of a condition: what travels beside it, and what is left out."""

import pytest

from rtb_addon.conditions import Conditions
from rtb_addon.errors import RecipeError
from rtb_addon.mappings import parse_mappings
from rtb_addon.scene.document import Scene
from rtb_addon.scene.resolve import resolve
from tests.unit.small_rooms import CAMERA, LAMP, SETTINGS, nothing, resolved, room, wall, with_nodes

# The rest.


def test_native_lines_travel_beside_the_scene():
    text = "Mitsuba {\nintegrator:integrator:path\n}\nGeneric {\nPaint-material:bsdf:roughplastic\n}\n"
    found = resolved(room(), text)
    assert [line.text for line in found.extras] == [
        "integrator:integrator:path",
        "Paint-material:bsdf:roughplastic",
    ]
    assert not any("Paint-material has no mapping" in each for each in found.warnings)


def test_resolving_an_adjusted_document_adjusts_it_once():
    document = Scene.parse(room().tobytes(), "parent.dae")
    mappings = parse_mappings("Collada {\nLamp:translate += 0 0 1\n}\n", "mappings.txt")
    adjustments = mappings.fill_in(next(iter(Conditions.single("one"))), "tracer", document, nothing)
    for scene in (document, document.adjusted(adjustments)):
        assert resolve(scene, adjustments, SETTINGS, nothing).scene.lights[0].to_world[2, 3] == 4


def test_resolving_twice_gives_the_same_bytes():
    meshes = [[each.mesh.digest for each in resolved(room()).scene.shapes] for _ in range(2)]
    assert meshes[0] == meshes[1]


def test_an_object_with_a_skeleton_is_left_out_and_said():
    controller = '<library_controllers><controller id="Rig"/></library_controllers>'
    node = '<node id="Arm"><instance_controller url="#Rig"/></node>'
    found = resolved(with_nodes(CAMERA + LAMP + wall() + node, library=controller))
    assert "Arm follows a skeleton or morph and is left out" in found.warnings


def test_links_that_lead_nowhere_are_errors():
    text = room().tobytes().decode()
    for link, words in (("#Wall-mesh", "no geometry #Gone"), ("#Lamp-light", "no light #Gone")):
        with pytest.raises(RecipeError, match=words):
            resolved(text.replace(f'url="{link}"', 'url="#Gone"').encode())


def test_a_material_without_an_effect_is_grey():
    text = room().tobytes().decode()
    start = text.index("<instance_effect")
    bare = text[:start] + text[text.index("/>", start) + 2 :]
    assert (
        resolved(bare.encode())
        .scene.materials["Paint-material"]
        .parameters["diffuseReflectance"]
        .values.tolist()
        == [0.5] * 4
    )


def test_what_is_wrong_with_the_matrix_of_a_fluorescent_material_is_said(tmp_path):
    text = "Generic {\nPaint-material:material:fluorescent\nPaint-material:filename.string = m.txt\n}\n"
    file = tmp_path / "m.txt"
    file.write_text("300 400\n400 0.1 0.2\n500 0.3 0.1\n")
    paint = resolved(room(), text, find_file=lambda name: file).scene.materials["Paint-material"]
    assert (paint.model, paint.parameters["filename"]) == ("fluorescent", str(file))
    file.write_text("300 400\n400 0.1 0.2\n500 0.3\n")
    with pytest.raises(RecipeError, match="2 numbers, want an outgoing wavelength and 2 shares") as refused:
        resolved(room(), text, find_file=lambda name: file)
    assert refused.value.line == 3
