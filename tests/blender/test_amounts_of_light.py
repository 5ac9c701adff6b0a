"""Lamps in lumens, candelas, luminances and lux, against closed forms and sums over directions."""

import math
import sys
from types import SimpleNamespace

import bpy
import numpy as np
import pytest

from rtb_addon.photometry import lumens
from rtb_addon.spectra import Spectrum
from rtb_addon.spectra.library import find
from tests.blender.stand_in_layout import RecordingLayout


@pytest.fixture
def shining(scene, lamp, resolved):
    """Return how to see what becomes of a tagged lamp: shining("POINT", measure="LUMENS", amount=800)."""

    def shine(kind, measure, amount, distance=1.0, **properties):
        light = lamp(kind, location=(0, 0, 3), **properties).data
        settings = light.rtb
        settings.use_spectra, settings.spectrum = True, "FL2"
        settings.measure, settings.amount, settings.distance = measure, amount, distance
        found = resolved(scene)
        spectra = [each.parameters["intensity"] for each in found.lights]
        (spectrum,) = spectra + [each.emission for each in found.shapes if each.emission is not None]
        at, fl2 = np.arange(400, 701, 10), find("FL2")
        np.testing.assert_allclose(spectrum.at(at) * fl2.at(550), fl2.at(at) * spectrum.at(550), rtol=1e-6)
        return lumens(spectrum)

    return shine


def test_lumens_and_candelas_and_lux_of_a_point_lamp(shining):
    assert shining("POINT", "LUMENS", 800) == pytest.approx(800 / (4 * math.pi), rel=1e-6)


@pytest.mark.parametrize(
    ("measure", "amount", "wanted"),
    [
        ("CANDELAS", 50, 50),
        ("LUX", 100, 100 * 2.5**2),
        ("NITS", 1000, 1000 * math.pi * 0.2**2),
    ],
)
def test_intensity_of_a_point_lamp(shining, measure, amount, wanted):
    found = shining("POINT", measure, amount, distance=2.5, shadow_soft_size=0.2)
    assert found == pytest.approx(wanted, rel=1e-6)


@pytest.mark.parametrize("blend", [0.0, 0.4, 1.0])
def test_lumens_of_a_spot_are_the_sum_over_its_cone(shining, library, blend):
    cone = math.radians(70)
    intensity = shining("SPOT", "LUMENS", 800, spot_size=cone, spot_blend=blend)
    cosines = (np.arange(200000) + 0.5) / 200000
    edge = library("blender.lights").smooth_edge
    seen = np.array([edge(each, cone, blend) for each in cosines[::50]])
    assert 2 * math.pi * intensity * seen.mean() == pytest.approx(800, rel=2e-3)


def test_lux_and_luminance_of_a_sun(shining):
    assert shining("SUN", "LUX", 100000) == pytest.approx(100000, rel=1e-6)


def test_the_luminance_of_a_sun_is_seen_over_its_disc(shining):
    angle = math.radians(10)
    steps = (np.arange(2000) + 0.5) / 2000 * angle / 2
    solid = (2 * math.pi * np.sin(steps) * np.cos(steps)).sum() * (angle / 2 / 2000)
    assert shining("SUN", "NITS", 3000, angle=angle) == pytest.approx(3000 * solid, rel=1e-6)


@pytest.mark.parametrize("shape", ["SQUARE", "RECTANGLE", "DISK", "ELLIPSE"])
@pytest.mark.parametrize("measure", ["LUMENS", "CANDELAS", "NITS", "LUX"])
def test_radiance_of_an_area_lamp_gives_back_its_amount(shining, shape, measure):
    distance = 0.7
    luminance = shining("AREA", measure, 500, distance, shape=shape, size=0.8, size_y=0.4)
    x, y = places_on(shape, 0.8, 0.4 if shape in ("RECTANGLE", "ELLIPSE") else 0.8)
    whole = luminance * x.cell
    wanted = {
        "LUMENS": math.pi * whole * len(x.at),
        "CANDELAS": whole * len(x.at),
        "NITS": luminance,
        # From each piece of the lamp: the cosines at both ends over the square of the distance.
        "LUX": (whole * distance**2 / (x.at**2 + y.at**2 + distance**2) ** 2).sum(),
    }
    assert wanted[measure] == pytest.approx(500, rel=3e-3)


def places_on(shape: str, width: float, height: float):
    """Return the middles of small pieces of a lamp, along x and y, and the area of one."""
    from types import SimpleNamespace

    steps = (np.arange(400) + 0.5) / 400 - 0.5
    x, y = np.meshgrid(steps * width, steps * height)
    inside = (2 * x / width) ** 2 + (2 * y / height) ** 2 < 1
    if shape in ("SQUARE", "RECTANGLE"):
        inside = np.full_like(inside, True)
    cell = width * height / 400**2
    return tuple(SimpleNamespace(at=each[inside], cell=cell) for each in (x, y))


def test_a_scaled_area_lamp_counts_as_large_as_it_stands(scene, lamp, resolved):
    placed = lamp("AREA", size=1.0, shape="SQUARE")
    placed.scale = (2, 3, 1)
    settings = placed.data.rtb
    settings.use_spectra, settings.measure, settings.amount = True, "LUMENS", 60 * math.pi
    (shape,) = resolved(scene).shapes
    assert lumens(shape.emission) == pytest.approx(10, rel=1e-6)


def test_meshes_and_the_world_are_measured_as_people_do(scene, box, resolved):
    shining = box()
    for measure, wanted in (("nits", 240.0), ("lumens", 240 / (math.pi * 24))):
        shining.rtb.emits, shining.rtb.spectrum, shining.rtb.emission, shining.rtb.amount = (
            True,
            "A",
            measure,
            240,
        )
        (shape,) = resolved(scene).shapes
        assert lumens(shape.emission) == pytest.approx(wanted, rel=1e-6)
    world = scene.world = bpy.data.worlds.new("Sky")
    world.rtb.use_spectra, world.rtb.spectrum, world.rtb.measure, world.rtb.amount = True, "D65", "NITS", 5000
    assert lumens(resolved(scene).environment.parameters["intensity"]) == pytest.approx(5000, rel=1e-6)


@pytest.mark.parametrize(
    ("kind", "measure", "properties", "sentence"),
    [
        ("SUN", "LUMENS", {}, "is a sun, which has no lumens: give it lux or cd/m²"),
        ("POINT", "NITS", {"shadow_soft_size": 0}, "is a point without a luminance, give it a radius"),
        ("AREA", "LUX", {"distance": 0}, "at a distance of 0, give it a distance"),
    ],
)
def test_an_amount_that_a_lamp_cannot_have_is_refused(shining, kind, measure, properties, sentence):
    with pytest.raises(Exception, match=sentence):
        shining(kind, measure, 10, **properties)


@pytest.mark.parametrize(("measure", "luminance"), [("RADIANCE", None), ("NITS", 250.0)])
def test_the_panel_tells_what_a_world_comes_to(scene, library, measure, luminance):
    settings = bpy.data.worlds.new("Sky").rtb
    settings.spectrum, settings.measure, settings.amount = "D65", measure, 250.0
    words, d65 = library("blender.light_words"), find("D65")
    words.told_surface(settings, measure, scene)
    words.tell_wanted()
    rows = dict(words.told_surface(settings, measure, scene).rows)
    assert (rows["CCT"], rows["CRI (Ra)"]) == ("6503 K", "100")
    sums = library("blender.light_sums").in_digits
    luminance = luminance or 250 * lumens(d65)
    assert rows[""] == f"{sums(luminance)} cd/m²"
    assert rows["Radiance"] == f"{sums(luminance * d65.integral() / lumens(d65))} W/(sr m²)"


def test_of_a_mesh_in_watts_only_the_colour_is_told(scene, box, library):
    words, settings = library("blender.light_words"), box().rtb
    settings.spectrum, settings.emission = "FL2", "watts"
    words.told_surface(settings, settings.emission, scene)
    words.tell_wanted()
    rows = words.told_surface(settings, settings.emission, scene).rows
    assert [name for name, _ in rows] == ["CCT", "Duv", "CRI (Ra)"]


def test_a_lamp_without_a_temperature_has_no_rendering_index_either(scene, lamp, library):
    light = lamp("SUN").data
    light.rtb.use_spectra, light.rtb.spectrum = True, "531:0 532:1 533:0"
    words = library("blender.light_words")
    words.told(light, scene)
    words.tell_wanted()
    assert dict(words.told(light, scene).rows[:3]) == dict.fromkeys(("CCT", "Duv", "CRI (Ra)"), "none")


def test_the_panel_tells_what_the_light_comes_to(scene, lamp, library):
    light = lamp("POINT", energy=100).data
    light.rtb.use_spectra, light.rtb.spectrum = True, "D65"
    words = library("blender.light_words")
    words.tell_wanted()
    assert words.told(light, scene) == words.Told(), "nothing is worked out while drawing"
    assert words.tell_wanted() == 1
    *colour, radiometric, photometric = words.told(light, scene).rows
    assert colour == [("CCT", "6503 K"), ("Duv", "+0.0032"), ("CRI (Ra)", "100")]
    assert radiometric == ("Intensity", f"{100 / (4 * math.pi):.4g} W/sr")
    d65 = find("D65")
    assert photometric == ("", f"{100 / (4 * math.pi) * lumens(d65) / d65.integral():.4g} cd")
    light.rtb.measure, light.rtb.amount = "CANDELAS", 25
    words.told(light, scene)
    words.tell_wanted()
    assert words.told(light, scene).rows[-1] == ("", "25 cd")
    light.rtb.amount = 12345.6
    words.told(light, scene)
    words.tell_wanted()
    assert words.told(light, scene).rows[-1] == ("", "12350 cd")
    light.rtb.spectrum = "D64"
    words.told(light, scene)
    words.tell_wanted()
    assert "did you mean D65" in words.told(light, scene).sentence


def test_watts_of_a_spectrum_nobody_sees_are_no_lumens(shining, scene, lamp, resolved):
    light = lamp("POINT").data
    light.rtb.use_spectra, light.rtb.spectrum, light.rtb.measure = True, "300:0 800:0", "LUMENS"
    with pytest.raises(Exception, match="that nobody sees cannot carry lumens"):
        resolved(scene)


def test_lumens_of_a_flat_watt_are_the_efficacy_of_equal_energy():
    assert lumens(Spectrum.constant(1.0)) / 470 == pytest.approx(683 * 106.857 / 470, rel=1e-4)


def test_what_is_wrong_with_a_lamps_spectrum_is_said_once(scene, lamp, library, extension):
    light = lamp("POINT").data
    light.rtb.use_spectra, light.rtb.spectrum = True, "D64"
    words, previews = library("blender.light_words"), library("blender.curve_previews")
    panel = sys.modules[f"{extension}.panels.spectral_light"].RTB_PT_spectral_light
    region = SimpleNamespace(width=300)
    context = SimpleNamespace(light=light, scene=scene, region=region, preferences=bpy.context.preferences)

    def drawn() -> str:
        layout = RecordingLayout()
        panel.draw_spectra(None, layout, context, light.rtb)
        return " ".join(text for kind, text in layout.drawn if kind == "label")

    drawn()
    previews.make_wanted()
    words.tell_wanted()
    drawn()
    assert drawn().count("did you mean") == 1
    light.rtb.spectrum, light.rtb.measure, light.shadow_soft_size = "D65", "NITS", 0
    drawn()
    previews.make_wanted()
    drawn()
    words.tell_wanted()
    assert drawn().count("give it a radius") == 1
