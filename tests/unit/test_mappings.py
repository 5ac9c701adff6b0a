"""Mappings files: blocks, lines, and what they say for one condition."""

import os
import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rtb_addon.conditions import Condition
from rtb_addon.errors import RecipeError
from rtb_addon.mappings import format_blocks, format_mappings, parse_mappings, read_mappings
from rtb_addon.mappings.lines import parse_statement, parse_target
from rtb_addon.scene.document import Scene

RTB3 = Path(os.environ.get("RTB3_FOLDER", Path(__file__).resolve().parents[3] / "shared" / "rtb3"))

# Blocks, declarations and configurations of the files that RenderToolbox3 shipped, counted by an independent
# reader.
OLD_FILES = {
    "CheckerShadowSceneMappings": (4, 11, 33),
    "DiceMappings": (3, 5, 7),
    "DiceTransformationsMappings": (7, 5, 13),
    "DragonColorCheckerMappings": (2, 5, 6),
    "DragonGradedMappings": (3, 6, 7),
    "DragonMappings": (2, 6, 7),
    "DragonMaterialsMappings": (8, 11, 17),
    "InteriorDragonMappings": (5, 32, 34),
    "InteriorMappings": (8, 33, 38),
    "MaterialSphereBumpsMappings": (6, 6, 13),
    "MaterialSphereMappings": (5, 4, 9),
    "RadianceTestMappings": (4, 5, 14),
    "ScalingTestMappings": (4, 2, 28),
    "SimpleSphereMappings": (4, 2, 14),
    "SimpleSquareMappings": (1, 2, 2),
    "SpectralIllusionMappings": (5, 31, 33),
    "DefaultMappings": (1, 0, 1),
    "SpectralPromotionMappings": (5, 3, 6),
}
# A file of ours with everything in it that those have.
OWN_FILE = """\
% Every kind of block
Collada {
    % move the lamp
    Lamp:translate|sid=location += 0 0 (height)
    Camera:scale|sid=scale  =  -1 1 1
}

Generic{
    Paint-material:material:matte
    Paint-material:diffuseReflectance.spectrum    = (paint)
    Lamp-light:light:point
    Lamp-light:intensity:spectrum = (lamp).spd
}
Generic night {
    Lamp-light:intensity.spectrum = 300:0 800:0
}
Generic day {
    Paint-material:diffuseReflectance.spectrum = 300:0.5 800:0.75
}
mitsuba {
    integrator:integrator:path
    integrator:maxDepth.integer = 7
}
Mitsuba-path {
    Camera-camera_film$ = merge
    Camera-camera:transform|name=toWorld:scale.x = [Camera-camera:optics:technique_common:perspective:xfov]
}
PBRT {
    integrator:SurfaceIntegrator:path
}
PBRT-path {
    sampler:parameter|name=pixelsamples = (samples that nobody asked for)
}
"""
SCENE = Scene.parse(
    b"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"><camera id="Camera-camera"><optics>
    <technique_common><perspective><xfov>40</xfov></perspective></technique_common></optics></camera>
    <node id="Lamp"><translate sid="location">1 2 3</translate></node></COLLADA>""",
    "parent.dae",
)
ROW = Condition("first", {"imageName": "first", "height": "2.5", "paint": "300:1 800:1", "lamp": "D65"})


def nothing(name):
    return None


def filled(text, renderer="mitsuba", find_file=nothing, **cells):
    row = Condition("first", {**ROW.cells, **cells})
    return parse_mappings(text, "mappings.txt").fill_in(row, renderer, SCENE, find_file)


def generic(*lines):
    return "Generic {\n" + "\n".join(lines) + "\n}\n"


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


def adjusted(*lines, renderer="mitsuba", block="Mitsuba-path"):
    return filled(f"{block} {{\n" + "\n".join(lines) + "\n}\n", renderer)


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        (["Eye_sampler:integer|name=sampleCount.value = 64"], ["Eye_sampler:sampleCount.integer = 64"]),
        (
            ["Camera-camera_sampler:integer|name=sampleCount.value *= 4"],
            ["Camera-camera_sampler:sampleCount.integer = 32"],
        ),
        (["Camera-camera_sampler.type = halton"], ["Camera-camera_sampler:sampler:halton"]),
        (["Camera-camera.type = thinlens"], ["Camera-camera:sensor:thinlens"]),
        (["Camera-camera.type = perspective"], []),  # it is already
        (["integrator:ref|name=map.id = checks"], ["integrator:map.texture = checks"]),
        (["Camera-camera$ = merge", "Camera-camera_film$ = merge"], []),
        (
            ["Camera-camera_film:rfilter|type=box:float|name=radius.value = 0.25"],
            ["filter:rfilter:box", "filter:radius.float = 0.25"],
        ),
        (["Paint-material:rgb|name=reflectance.intent = reflectance"], []),
        (["Lamp:transform|name=toWorld:scale.x = 2"], ["Lamp:transform|name=toWorld:scale.x = 2"]),
        (["integrator$ = emitter"], ["integrator$ = emitter"]),
    ],
)
def test_paths_into_mitsubas_adjustments_become_lines_of_its_own_block(lines, expected):
    assert [line.text for line in adjusted(*lines).native] == expected


def test_paths_into_pbrts_adjustments_become_lines_of_its_own_block():
    lines = (
        "filter:parameter|name=alpha = 4",
        "sampler:parameter|name=pixelsamples.type = integer",
        "sampler:parameter|name=pixelsamples *= 2",
        "Eye-camera.type = perspective",
        "Eye-camera:parameter|name=lensradius = 0.2",
        "Eye-camera:parameter|name=lensradius.type = float",
    )
    assert [line.text for line in adjusted(*lines, renderer="PBRT", block="PBRT-path").native] == [
        "filter:alpha.float = 4",
        "sampler:pixelsamples.integer = 8",
        "sampler:pixelsamples.integer = 16",
        "Eye-camera:Camera:perspective",
        "Eye-camera:lensradius = 0.2",
        "Eye-camera:lensradius.float = 0.2",
    ]


def test_a_path_in_angle_brackets_is_read_from_the_adjustments_as_they_stand():
    text = """Mitsuba {
integrator:integrator:path
integrator:maxDepth.integer = 7
integrator:rrDepth.integer = <integrator:integer|name=maxDepth.value>
integrator:kind.string = <integrator.type>
}
Mitsuba-path {
integrator:integer|name=maxDepth.value += 2
integrator:integer|name=rrDepth.value = <integrator:integer|name=maxDepth.value>
}
"""
    assert [line.text for line in filled(text).native] == [
        "integrator:integrator:path",
        "integrator:maxDepth.integer = 7",
        "integrator:rrDepth.integer = 7",
        "integrator:kind.string = path",
        "integrator:maxDepth.integer = 9",
        "integrator:rrDepth.integer = 9",
    ]


def test_the_width_of_a_parallel_view_needs_no_scaling_of_its_camera():
    scene = Scene.parse(
        SCENE.tobytes().replace(b"perspective", b"orthographic").replace(b"xfov", b"xmag"), "p"
    )
    text = """Mitsuba-path {
Camera-camera:transform|name=toWorld:scale.x = [Camera-camera:optics:technique_common:orthographic:xmag]
Camera-camera:transform|name=toWorld:scale.y = 41
}
"""
    found = parse_mappings(text, "mappings.txt").fill_in(ROW, "mitsuba", scene, nothing)
    assert [line.line for line in found.native] == [3]
    assert "a parallel view has its width from the parent scene" in found.remarks[0].message


def test_a_material_of_mitsubas_in_a_generic_block_goes_to_mitsuba():
    text = generic("Cup-material:material:ward", "Cup-material:alphaU.float = 0.1")
    assert [line.text for line in filled(text).native] == [
        "Cup-material:bsdf:ward",
        "Cup-material:alphaU.float = 0.1",
    ]
    assert filled(generic("Cup-material:material:plastic")).native == ()


@pytest.mark.parametrize("renderer", ["mitsuba", "tracer", "pbrt"])
def test_every_file_that_rendertoolbox3_shipped_can_be_filled_in(renderer):
    if not RTB3.is_dir():
        pytest.skip(f"RENDERTOOLBOX3'S FILES ARE NOT HERE: no {RTB3}, set RTB3_FOLDER")
    for path in RTB3.rglob("*Mappings.txt"):
        mappings = read_mappings(path)
        words = set(re.findall(r"\((\w+)\)", mappings.text))
        row = Condition("first", dict.fromkeys(words, "1"))
        strange = [
            remark
            for remark in mappings.fill_in(row, renderer, SCENE, nothing).remarks
            if not re.search("has nothing at|parallel view|intent", remark.message)
        ]
        assert not strange


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


@pytest.mark.parametrize("renderer", ["mitsuba", "Mitsuba", "tracer", "cycles", "radiance"])
def test_mitsubas_blocks_are_read_by_its_relatives_too(renderer):
    native = filled(OWN_FILE, renderer).native
    assert [line.text for line in native] == [
        "integrator:integrator:path",
        "integrator:maxDepth.integer = 7",
        "Camera-camera:transform|name=toWorld:scale.x = 40",
    ]
    assert [line.block for line in native] == ["mitsuba", "mitsuba", "Mitsuba-path"]
    assert native[1][1:3] == ("mappings.txt", 22)


def test_a_block_of_the_tracers_own_keeps_mitsubas_from_it():
    text = OWN_FILE + "Tracer {\nintegrator:integrator:direct\n}\n"
    assert [line.text for line in filled(text, "tracer").native] == ["integrator:integrator:direct"]
    assert len(filled(text, "mitsuba").native) == 3


def test_a_renderer_reads_no_other_ones_blocks():
    assert filled(OWN_FILE, "sphere").native == ()


def test_mitsubas_own_words_in_a_generic_block_go_to_mitsuba():
    text = generic("Cup-material:bsdf:roughplastic", "Cup-material:alpha.float = 0.1")
    adjustments = filled(text, "mitsuba")
    assert adjustments.objects == ()
    assert [line.text for line in adjustments.native] == [
        "Cup-material:bsdf:roughplastic",
        "Cup-material:alpha.float = 0.1",
    ]
    assert filled(text, "pbrt").native == ()


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
