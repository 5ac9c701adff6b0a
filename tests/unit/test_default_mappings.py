"""Mappings made for a scene from anywhere."""

import os
from pathlib import Path

import pytest

from rtb_addon.conditions import Conditions
from rtb_addon.errors import RecipeError
from rtb_addon.mappings import default_mappings, parse_mappings
from rtb_addon.scene.build import SceneBuilder
from rtb_addon.scene.document import Scene
from rtb_addon.scene.render_scene import Film
from rtb_addon.scene.resolve import SceneSettings, resolve

RTB3 = Path(os.environ.get("RTB3_FOLDER", Path(__file__).resolve().parents[3] / "shared" / "rtb3"))
FLIP = "Collada {\n    Camera:scale|sid=scale = -1 1 1\n}\n"


def nothing(name):
    return None


def room(materials=("Red", "Blue")):
    builder = SceneBuilder()
    for name in materials:
        builder.plane(f"Wall{name}", material=name)
    builder.camera()
    builder.point("Lamp")
    builder.spot("Beam")
    builder.sun("Sun")
    return Scene.parse(builder.tobytes(), "parent.dae")


def test_every_material_gets_a_patch_and_every_light_daylight():
    assert (
        default_mappings(room(), include=FLIP)
        == FLIP
        + """
% materials
Generic {
    Blue-material:material:matte
    Blue-material:diffuseReflectance.spectrum = mccBabel-1.spd

    Red-material:material:matte
    Red-material:diffuseReflectance.spectrum = mccBabel-2.spd
}

% lights
Generic {
    Beam-light:light:spot
    Beam-light:intensity.spectrum = D65.spd

    Lamp-light:light:point
    Lamp-light:intensity.spectrum = D65.spd

    Sun-light:light:directional
    Sun-light:intensity.spectrum = D65.spd
}
"""
    )


def test_spectra_begin_anew_when_they_run_out_and_excluded_ids_are_left_alone():
    scene = room([f"M{k:02}" for k in range(30)])
    text = default_mappings(scene, exclude="^M0|Beam", light_spectra=["300:1 800:1", "A.spd"])
    assert "M09" not in text
    assert "Beam" not in text
    assert "M10-material:diffuseReflectance.spectrum = mccBabel-1.spd" in text
    assert "Lamp-light:intensity.spectrum = 300:1 800:1" in text
    assert "Sun-light:intensity.spectrum = A.spd" in text
    assert "M24-material:diffuseReflectance.spectrum = mccBabel-1.spd" in default_mappings(scene)


def test_what_cannot_be_named_in_a_mapping_is_said_and_left_out():
    text = room().tobytes().decode().replace("Red-material", "Red.material")
    made = default_mappings(Scene.parse(text.encode(), "parent.dae"))
    assert "% Red.material cannot be named in a mapping, rename it in the modeller" in made
    assert parse_mappings(made, "mappings.txt").blocks


def test_an_ambient_light_becomes_directional():
    text = room().tobytes().decode().replace("<point>", "<ambient>").replace("</point>", "</ambient>")
    assert "Lamp-light:light:directional" in default_mappings(Scene.parse(text.encode(), "parent.dae"))


def test_a_pattern_that_is_none_is_refused_in_a_sentence():
    with pytest.raises(RecipeError, match="is no regular expression"):
        default_mappings(room(), exclude="(")


def check(document):
    """Return the scene that default mappings make of a document, all of its words known."""
    adjustments = parse_mappings(default_mappings(document), "mappings.txt").fill_in(
        next(iter(Conditions.single("one"))), "tracer", document, nothing
    )
    assert adjustments.remarks == ()
    found = resolve(document, adjustments, SceneSettings(Film(32, 24)), nothing)
    assert not any("has no mapping" in each for each in found.warnings)
    return found.scene


def test_default_mappings_leave_nothing_to_be_promoted():
    scene = check(room())
    assert {material.model for material in scene.materials.values()} == {"matte"}
    assert len(scene.lights) == 3


def test_default_mappings_fit_every_old_scene():
    files = sorted(RTB3.rglob("*.dae"))
    if not files:
        pytest.skip(f"RENDERTOOLBOX3'S FILES ARE NOT HERE: no scenes in {RTB3}, set RTB3_FOLDER")
    for file in files:
        assert check(Scene.read(file)).shapes, file
