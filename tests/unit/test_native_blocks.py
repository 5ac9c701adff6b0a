"""Blocks of a renderer's own, by paths or without, and what goes into them."""

import re

import pytest

from rtb_addon.conditions import Condition
from rtb_addon.mappings import parse_mappings, read_mappings
from rtb_addon.scene.document import Scene
from tests.unit.filled_mappings import OWN_FILE, ROW, RTB3, SCENE, filled, generic, nothing


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
