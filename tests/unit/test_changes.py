"""RenderToolbox4's mappings in JSON: read, written, and what they say for one condition."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtb_addon.conditions import Condition
from rtb_addon.errors import RecipeError
from rtb_addon.mappings import format_changes, format_mappings, parse_mappings, read_mappings
from rtb_addon.mappings.changes import OPERATIONS, Change, ChangedProperty, parse_changes
from rtb_addon.scene.render_scene import Film
from rtb_addon.scene.resolve import SceneSettings, resolve
from tests.unit.filled_changes import OLD_FILES, RTB4, filled, moved, nothing, room, said, update


def test_the_example_of_the_format():
    """A lamp, a panel that shines in one group, an integrator, by their modeller's names."""
    text = """[ { "name": "Lamp", "broadType": "lights", "specificType": "point", "operation": "update",
    "properties": { "name": "intensity", "valueType": "spectrum", "value": "(lampSpectrum)" } },
  { "name": "Panel", "broadType": "meshes", "operation": "blessAsAreaLight", "group": "windowOn",
    "properties": [ { "name": "intensity", "valueType": "spectrum", "value": "D65.spd" } ] },
  { "name": "integrator", "broadType": "integrator", "specificType": "path", "operation": "update",
    "destination": "Mitsuba",
    "properties": [ { "name": "maxDepth", "valueType": "integer", "value": 6 } ] } ]"""
    mappings = parse_mappings(text, "mappings.json")
    assert [change.line for change in mappings.changes] == [1, 3, 5]
    lit = {"lampSpectrum": "300:2 800:2", "groupName": "windowOn"}
    found = mappings.fill_in(Condition("first", lit), "mitsuba", room(), nothing)
    assert said(found) == [
        ("Lamp-light", "light", "point", {"intensity": "300:2 800:2"}),
        ("Panel-mesh", "light", "area", {"intensity": "D65.spd"}),
    ]
    assert [line.text for line in found.native] == [
        "integrator:integrator:path",
        "integrator:maxDepth.integer = 6",
    ]
    assert [(line.file, line.line, line.block) for line in found.native] == [
        ("mappings.json", 5, "Mitsuba")
    ] * 2
    dark = mappings.fill_in(Condition("first", {**lit, "groupName": "off"}), "pbrt", room(), nothing)
    assert len(dark.objects) == 1
    assert dark.native == ()


def matrix_of(*changes, node="Lamp", **cells):
    scene = room()
    changed = scene.adjusted(filled(*changes, scene=scene, **cells))
    return np.array((changed.value_at(f"{node}:matrix|sid=transform") or "").split(), float).reshape(4, 4)


def test_a_node_moves_by_an_expression_of_where_it_stands():
    matrix = matrix_of(moved("Lamp", "mexximpTranslate([0 0 (far)]) * oldValue"), far="100")
    np.testing.assert_allclose(matrix[:3, 3], [0, 0, 103])
    # The object is scaled before it goes where it stood, and each change sees the one before.
    twice = matrix_of(moved("Lamp", "mexximpScale([2 2 1]) * oldValue"), moved("Lamp", "oldValue * oldValue"))
    np.testing.assert_allclose(np.diag(twice), [4, 4, 1, 1])
    np.testing.assert_allclose(twice[:3, 3], [0, 0, 6])


def test_a_node_gets_a_matrix_for_row_vectors():
    value = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [7, 8, 9, 1]]
    changed = update("Lamp", "nodes", destination="mexximp", transformation=value)
    np.testing.assert_allclose(matrix_of(changed)[:3, 3], [7, 8, 9])


def value_at(path, *changes):
    scene = room()
    return scene.adjusted(filled(*changes, scene=scene)).value_at(path)


def test_cameras_and_spots_of_the_parent_scene_change_in_radians():
    wide = update("Camera", "cameras", destination="mexximp", horizontalFov=np.pi / 3)
    assert float(value_at("Camera-camera:optics:technique_common:perspective:xfov", wide)) == pytest.approx(
        60
    )
    cone = update("Beam", "lights", destination="mexximp", innerConeAngle=np.pi / 3, outerConeAngle=np.pi / 2)
    assert float(value_at("Beam-light:technique_common:spot:falloff_angle", cone)) == pytest.approx(90)
    blend = float(value_at("Beam-light:extra:technique|profile=blender:spotblend", cone))
    full, edge = np.cos(np.radians([30, 45]))
    assert blend == pytest.approx((full - edge) / (1 - edge))
    red = update("Lamp", "lights", destination="mexximp", diffuseColor=[1, 0.5, 0])
    assert value_at("Lamp-light:technique_common:point:color", red) == "1 0.5 0"
    axes = {"lookAtDirection": [0, 0, -1], "upDirection": "0 1 0", "aspectRatio": 1.5}
    assert filled(update("Camera", "cameras", destination="mexximp", **axes)).edits == ()


def test_what_is_deleted_is_gone():
    scene = room()
    gone = {"operation": "delete"}
    changes = (
        {"name": "Lamp", "broadType": "lights", **gone},
        {"name": "Panel", "broadType": "nodes", "destination": "mexximp", **gone},
    )
    adjustments = filled(*changes, scene=scene)
    found = resolve(scene, adjustments, SceneSettings(Film(8, 8)), nothing).scene
    assert [lamp.id for lamp in found.lights] == ["Beam-light"]
    assert [shape.id for shape in found.shapes] == ["Wall-mesh"]


@pytest.mark.parametrize(
    ("kind", "name", "index", "expected", "words"),
    [
        ("lights", "Lamp", None, "Lamp-light", ""),
        ("lights", "lamp", None, "Lamp-light", ""),
        ("lights", "Lamp-light", None, "Lamp-light", ""),
        ("lights", "", 2, "Beam-light", ""),
        ("lights", "", None, "Lamp-light", ""),
        ("lights", "Lampe", None, "Lamp-light", "none of the lights is called Lampe, Lamp was taken"),
        (
            "lights",
            "Sun",
            None,
            None,
            "none of the lights is called Sun, so that is left out; there are Beam, Lamp",
        ),
        ("lights", "", 7, None, "none of the lights is number 7"),
        ("materials", "Paint", None, "Paint-material", ""),
    ],
)
def test_elements_are_found_by_the_modellers_names(kind, name, index, expected, words):
    model = "point" if kind == "lights" else "matte"
    change = update(name, kind, model, intensity="300:1", diffuseReflectance="300:1")
    if index:
        change["index"] = index
    found = filled(change)
    assert [each.id for each in found.objects] == ([expected] if expected else [])
    assert [each for each in map(str, found.remarks) if "none of" in each] == (
        [each for each in map(str, found.remarks) if words in each] if words else []
    )
    assert all(str(each).startswith("mappings.json:2: ") for each in found.remarks)


def test_what_is_not_said_is_what_rendertoolbox4_took_and_is_remarked_upon():
    found = filled(update("Paint", "materials", "anisoward"), update("Lamp", "lights", "point"))
    assert said(found)[0][3] == {
        "diffuseReflectance": "300:0 800:0",
        "specularReflectance": "300:0.2 800:0.2",
        "alphaU": "0.15",
        "alphaV": "0.15",
        "variant": "balanced",
    }
    assert said(found)[1][3] == {"intensity": "300:0 800:0"}
    assert (
        "intensity of Lamp-light is not said, RenderToolbox4 takes 300:0 800:0" in found.remarks[-1].message
    )


def test_a_model_that_is_not_said_stays_what_it_is():
    found = filled(
        update("Beam", "lights", intensity="300:1"),
        update("Paint", "materials", "metal", eta="300:1", k="300:2", roughness=0.1),
        update("Paint", "materials", roughness=0.2),
    )
    assert [each[2] for each in said(found)] == ["spot", "metal", "metal"]


def test_a_bump_map_wraps_the_material_that_is_blessed():
    bless = {"name": "Paint", "broadType": "materials", "operation": "blessAsBumpMap"}
    bless["properties"] = [{"name": "texture", "value": "bumps"}, {"name": "scale", "value": 0.1}]
    texture = update("bumps", "floatTextures", "bitmap", filename="bumps.exr") | {"operation": "create"}
    assert said(filled(texture, bless)) == [
        ("bumps", "floatTexture", "bitmap", {"filename": "bumps.exr"}),
        (
            "Paint-material-bumps",
            "material",
            "bumpmap",
            {"materialID": "Paint-material", "textureID": "bumps", "scale": "0.1"},
        ),
    ]


def test_operations_compute_with_the_value_before():
    def changed(operation, value=None):
        change = update("Paint", "materials", "anisoward", alphaU=value)
        change["properties"][0]["operation"] = operation
        return change

    first = update("Paint", "materials", "anisoward", alphaU=0.2)
    assert said(filled(first, changed("oldValue * 2")))[1][3]["alphaU"] == "0.4"
    assert said(filled(first, changed("oldValue + value", "0.25")))[1][3]["alphaU"] == "0.45"
    assert said(filled(first, changed("=")))[1][3]["alphaU"] == "0.2"  # nothing new keeps what there was
    assert said(filled(changed("oldValue * 2", 0.3)))[0][3]["alphaU"] == "0.3"  # nothing there: as it is said


def test_native_words_get_the_ids_of_the_parent_scene():
    found = filled(
        update("Camera", "sensor", "thinlens", "Mitsuba", apertureRadius="(radius)"),
        update("Paint", "bsdf", "roughplastic", "Mitsuba", alpha=0.1),
        update("", "film", "hdrfilm", "Mitsuba"),
        update("x", "rfilter", "gaussian", "Mitsuba", stddev=0.5),
        update("Wall", "shape", "", "Mitsuba", flipNormals=True),
        update("Camera", "sensor", "perspective", "Mitsuba"),
        update("filter", "PixelFilter", "box", "PBRT"),
        radius="0.2",
    )
    assert [line.text for line in found.native] == [
        "Camera-camera:sensor:thinlens",
        "Camera-camera:apertureRadius = 0.2",
        "Paint-material:bsdf:roughplastic",
        "Paint-material:alpha = 0.1",
        "film:film:hdrfilm",
        "filter:rfilter:gaussian",
        "filter:stddev = 0.5",
        "Wall-mesh:flipNormals = true",
    ]


def test_texts_that_may_be_files_are_looked_up_and_numbers_are_not():
    asked = []
    change = update("Paint", "materials", "anisoward", diffuseReflectance="(paint).spd", alphaU=0.25)
    filled(change, find_file=asked.append, paint="red")
    assert asked == ["red.spd"]


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("{}", 1, "want an array of mappings"),
        ("", 1, "want an array"),
        ("[\n{,}]", 2, "it must be JSON"),
        ("[{}\n{}]", 2, "want , or ] after a mapping"),
        ("[{}]\n7", 2, "something follows the array"),
        ("[{},\n3]", 2, "a mapping is an object"),
        ('[{"name": 3}]', 1, "name is 3, want a text"),
        ('[{"index": 1.5}]', 1, "index is 1.5, want a whole number"),
        ('[{"operation": "bless"}]', 1, "operation is 'bless', want one of create, update"),
        ('[{"properties": [3]}]', 1, "a property is an object with a name"),
        ('[{"properties": {"value": NaN}}]', 1, "NaN is no number"),
        ("[" * 100000, None, "nested too deeply|must be JSON|a mapping is an object"),
    ],
)
def test_what_is_no_such_file_is_refused_with_its_place(text, line, words):
    with pytest.raises(RecipeError, match=words) as caught:
        parse_mappings(text, "mappings.json")
    assert caught.value.line == line


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            update("Lamp", "nodes", destination="mexximp", colour=1),
            "colour of nodes cannot be set, there are trans",
        ),
        (update("Paint", "materials", destination="mexximp", a=1), "use the destination Generic"),
        (update("Lamp", "nodes", destination="mexximp", transformation=[1, 2]), "16 numbers, got 2"),
        (update("Camera", "cameras", destination="mexximp", upDirection=[1, 0, 0]), "turn the camera's node"),
        (update("Camera", "cameras", destination="mexximp", horizontalFov=[1, 2]), "wants one number"),
        (moved("Lamp", "oldValue * colour"), "nothing is called colour"),
        (update("Lamp", "nodes", destination="mexximp") | {"operation": "create"}, "nothing can be created"),
        (update("Paint", "materials") | {"operation": "delete"}, "cannot be deleted"),
        (update("Paint", "bsdf", "", "Mitsuba") | {"operation": "delete"}, "cannot be deleted"),
    ],
)
def test_what_cannot_be_done_is_refused_with_its_place(change, words):
    with pytest.raises(RecipeError, match=rf"^mappings.json:2: .*{words}"):
        filled(change)


def test_a_kind_that_a_destination_does_not_know_is_skipped_with_a_remark():
    (remark,) = filled(update("Lamp", "nodes")).remarks
    assert str(remark).startswith("mappings.json:2: broadType 'nodes' is skipped, want one of lights")
    (remark,) = filled(update("Lamp", "", destination="mexximp")).remarks
    assert str(remark).startswith("mappings.json:2: broadType '' is skipped, of the parent scene want one of")


JSON = st.recursive(
    st.none() | st.booleans() | st.integers(-9, 9) | st.floats(-1e3, 1e3) | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3),
    max_leaves=5,
)

PROPERTY = st.builds(
    ChangedProperty, st.text(min_size=1, max_size=5), st.text(max_size=5), JSON, st.text(max_size=9)
)

TEXT = st.text(max_size=6)

CHANGE = st.builds(
    Change,
    TEXT,
    st.none() | st.integers(1, 9),
    TEXT,
    TEXT,
    st.sampled_from(OPERATIONS),
    TEXT,
    TEXT,
    st.lists(PROPERTY, max_size=3).map(tuple),
)


@given(st.lists(CHANGE, max_size=4).map(tuple))
def test_changes_survive_writing_and_reading(changes):
    text = format_changes(changes)
    assert parse_changes(text, "mappings.json") == changes
    assert format_mappings(parse_mappings(text, "mappings.json")) == text


@given(st.text(max_size=60))
def test_any_text_at_all_is_read_or_refused_with_a_sentence(text):
    try:
        changes = parse_changes(text, "mappings.json")
    except RecipeError as error:
        changes = () if error.file == "mappings.json" else None
    assert isinstance(changes, tuple)


@pytest.mark.parametrize("renderer", ["mitsuba", "tracer", "pbrt"])
def test_every_file_that_rendertoolbox4_shipped_reads_as_counted_and_fills_in(renderer):
    if not RTB4.is_dir():
        pytest.skip(f"RENDERTOOLBOX4'S FILES ARE NOT HERE: no {RTB4}, set RTB4_FOLDER")
    found = {path.relative_to(RTB4).as_posix(): read_mappings(path) for path in RTB4.rglob("*Mappings.json")}
    counts = {name: (len(m.changes), sum(len(c.properties) for c in m.changes)) for name, m in found.items()}
    assert counts == OLD_FILES
    for mappings in found.values():
        assert parse_changes(format_changes(mappings.changes), "again.json") == mappings.changes
        words = set(re.findall(r"\((\w+)\)", mappings.text))
        row = Condition("first", {word: "1" for word in words if not word.isdigit()})
        assert isinstance(mappings.fill_in(row, renderer, room(), nothing).objects, tuple)
