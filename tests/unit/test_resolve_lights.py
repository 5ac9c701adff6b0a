"""Lights of the neutral scene, from mappings or from the parent scene."""

import numpy as np
import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.scene.build import Placement
from tests.unit.small_rooms import generic, resolved, room

# Lights.


def test_a_lamp_without_a_mapping_shines_with_its_colour_and_says_so():
    found = resolved(room())
    (lamp,) = found.scene.lights
    assert lamp.kind == "point"
    assert lamp.parameters["intensity"].unit == "W sr-1 nm-1"
    assert lamp.parameters["intensity"].at(550) == 1
    assert lamp.parameters["radius"] == 0
    assert (
        "Lamp-light has no mapping: its colour 1 1 1 was promoted to its intensity [W sr-1 nm-1]"
        in found.warnings
    )


def test_a_spot_keeps_its_cone_and_may_be_told_another():
    builder = room(lamp=False)
    builder.spot("Lamp", cone=30.0)
    declared = ("Lamp-light:light:spot", "Lamp-light:intensity.spectrum = 300:2")
    (lamp,) = resolved(builder, generic(*declared)).scene.lights
    assert lamp.parameters["cone"] == pytest.approx(30)
    (lamp,) = resolved(builder, generic(*declared, "Lamp-light:cone.float = 60")).scene.lights
    assert lamp.parameters["cone"] == 60


def test_a_sun_is_measured_in_irradiance():
    builder = room(lamp=False)
    builder.sun("Sun", placement=Placement((0, 0, 9), (0, 90, 0)))
    (sun,) = resolved(
        builder, generic("Sun-light:light:directional", "Sun-light:intensity.spectrum = 300:2")
    ).scene.lights
    assert sun.parameters["intensity"].unit == "W m-2 nm-1"
    np.testing.assert_allclose(-sun.to_world[:3, 2], [-1, 0, 0], atol=1e-12)


def test_an_area_light_is_every_part_of_its_mesh_wherever_it_stands():
    builder = room(lamp=False)
    builder.instance("Twin", "Wall", Placement((3, 0, 0)))
    lines = ("Wall-mesh:light:area", "Wall-mesh:intensity.spectrum = 300:2 800:2")
    shapes = resolved(builder, generic(*lines)).scene.shapes
    assert [shape.id for shape in shapes] == ["Wall-mesh_0", "Wall-mesh_1"]
    assert all(shape.emission is not None and shape.emission.unit == "W sr-1 m-2 nm-1" for shape in shapes)


def test_an_environment_lights_a_scene_without_lamps():
    lines = ("sky:light:environment", "sky:intensity.spectrum = 300:0.5 800:0.5")
    scene = resolved(room(lamp=False), generic(*lines)).scene
    assert scene.environment is not None
    assert scene.environment.kind == "environment"
    assert scene.environment.parameters["intensity"].at(500) == 0.5


def test_a_lamp_that_is_off_is_left_out():
    builder = room()
    builder.point("Dark")
    scene = resolved(
        builder, generic("Dark-light:light:point", "Dark-light:intensity.spectrum = 300:0 800:0")
    ).scene
    assert [lamp.id for lamp in scene.lights] == ["Lamp-light"]


def test_when_every_light_is_off_the_black_picture_is_announced():
    lines = ("Lamp-light:light:point", "Lamp-light:intensity.spectrum = 300:0 800:0")
    found = resolved(room(), generic(*lines))
    assert "every light is off in this condition, its picture will be black" in found.warnings
    assert len(found.scene.lights) == 1


def test_an_emission_without_a_mapping_shines_and_says_so():
    text = room(lamp=False).tobytes().decode().replace(">0 0 0 1<", ">0.2 0.4 0.6 1<")
    found = resolved(text.encode())
    emission = found.scene.shapes[0].emission
    assert emission is not None
    assert emission.at(545) == pytest.approx(0.4)
    assert any("its emission 0.2 0.4 0.6 was promoted to a radiance" in each for each in found.warnings)


def test_ambient_light_is_left_out_and_said():
    text = room().tobytes().decode()
    start, end = text.index("<point>"), text.index("</point>") + len("</point>")
    ambient = "<ambient><color>1 1 1</color></ambient>"
    builder_text = (text[:start] + ambient + text[end:]).encode()
    with pytest.raises(RecipeError, match="the scene has no light"):
        resolved(builder_text)


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ({"camera": False}, "parent.dae: the scene has no camera, add one"),
        ({"lamp": False}, "parent.dae: the scene has no light, add a lamp"),
    ],
)
def test_a_scene_without_camera_or_light_is_refused(parts, words):
    with pytest.raises(RecipeError, match=words):
        resolved(room(**parts))
