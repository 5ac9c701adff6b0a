"""The all-bands path: what lobes cannot carry, and what they can, on the same random numbers."""

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as Xml

import numpy as np
import pytest

from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import renderer, session
from rtb_addon.scene.render_scene import Material
from rtb_addon.spectra import Bands, Spectrum
from rtb_addon.spectra.files import read_spd
from rtb_addon.spectra.library import find
from tests.renderings.materials_scene import BLUE, GREEN, MATERIALS, MORE, PALE, RED, row
from tests.renderings.mitsuba_scenes import (
    BANDS,
    INTENSITY,
    assert_within_noise,
    kernels,
    lamp,
    picture,
    scene,
)
from tests.renderings.test_mitsuba_textures import bitmap, coloured, sheet, spectral

__all__ = ["coloured", "spectral"]  # fixtures

# Plastics weigh their two parts by the spectra, where these are spectra.
SAME = {name: each for name, each in {**MATERIALS, **MORE}.items() if "plastic" not in str((name, each))}
SHINING = INTENSITY.in_bands(BANDS)


@pytest.fixture
def by_both(tmp_path, monkeypatch):
    """Return a function that renders a scene by both paths."""

    def render(one):
        first = picture(one, tmp_path, name="lobes")
        with monkeypatch.context() as patch:
            patch.setattr("rtb_addon.renderers.mitsuba.lobes.MOST_LOBES", 0)
            second = picture(one, tmp_path, name="bands")
        assert (first.attributes["integrator"], second.attributes["integrator"]) == (
            "lobe path",
            "all-bands path",
        )
        return first.radiance, second.radiance

    return render


def assert_same(first, second):
    """Rounding takes a path another way now and then; nothing else may differ."""
    apart = np.abs(first - second) / first.mean()
    assert np.median(apart) < 2e-6
    assert np.quantile(apart, 0.98) < 1e-3
    np.testing.assert_allclose(first.mean(axis=(0, 1)), second.mean(axis=(0, 1)), rtol=1e-3)


@pytest.mark.parametrize("light", ["point", "area", "environment"])
def test_both_paths_are_the_same_on_the_same_random_numbers(by_both, light):
    names = tuple(SAME)
    one = row(light, names, SAME, samples=64)
    assert_same(*by_both(one))


@pytest.mark.parametrize("kind", ["averaged", "centre", "mean"])
def test_bands_of_every_kind_and_any_width_hold_the_same(by_both, kind):
    names = ("matte", "metal", "principled")
    one = row("area", names, {**MATERIALS, **MORE}, samples=64)
    uneven = Bands(np.array([380.0, 500.0, 555.0, 700.0, 900.0]), np.array([350, 450, 545, 600, 800, 950.0]))
    materials = {name: one.materials[name] for name in (*names, "floor", "soot")}
    one = replace(one, materials=materials, film=replace(one.film, bands=uneven, band_kind=kind))
    assert_same(*by_both(one))


@pytest.mark.parametrize("kind", ["coloured", "spectral"])
def test_pictures_are_the_same_to_both(by_both, kind, request):
    path = request.getfixturevalue(kind)
    first, second = by_both(sheet(bitmap(path, filterMode="bilinear"), size=(8, 6)))
    np.testing.assert_allclose(first, second, rtol=2e-5, atol=1e-6)


@pytest.mark.parametrize("kind", ["averaged", "centre"])
def test_nothing_leaks_from_band_to_band(by_both, kind):
    # A comb that reflects all of every other band and nothing of the others, under daylight.
    bands = Bands.regular(400, 10, 31)
    edges = bands.edges[1:-1]
    places = np.ravel([edges - 1e-4, edges + 1e-4], order="F")
    comb = Spectrum.of(places, np.resize([1.0, 0.0, 0.0, 1.0], len(places)))
    sun = lamp("directional", intensity=find("D65"), angle=0.0)
    daylight = sun.parameters["intensity"].in_bands(bands, kind) / np.pi
    one = scene([sun], reflectance=comb, bands=bands, kind=kind, samples=16)
    for radiance in by_both(one):
        assert radiance[..., 1::2].max() < 1e-4 * daylight.min()
        np.testing.assert_allclose(radiance[0, 0, ::2], daylight[::2], rtol=1e-4)


def blend_of(materials, weights):
    """Return a floor that is made of any number of materials, blended one after another."""
    one = scene(environment=lamp("environment", filename=""), samples=1024, depth=2)
    made = {material.id: material for material in materials}
    above = materials[0].id
    for number, (material, weight) in enumerate(zip(materials[1:], weights, strict=True)):
        id = "paint" if number == len(weights) - 1 else f"blend{number}"
        parts = {"materialID": above, "otherMaterialID": material.id, "weight": weight}
        made[id], above = Material(id, "blend", parts), id
    return replace(one, materials={**one.materials, **made})


def test_a_blend_of_five_spectra_shows_them_in_proportion(tmp_path):
    spectra = [RED, BLUE, GREEN, PALE, RED.scaled(0.3)]
    mattes = [Material(f"m{k}", "matte", {"diffuseReflectance": each}) for k, each in enumerate(spectra)]
    image = picture(blend_of(mattes, [0.5, 0.25, 0.4, 0.1]), tmp_path)
    assert image.attributes["integrator"] == "all-bands path"
    mixed = spectra[0].in_bands(BANDS)
    for weight, each in zip([0.5, 0.25, 0.4, 0.1], spectra[1:], strict=True):
        mixed = (1 - weight) * mixed + weight * each.in_bands(BANDS)
    assert_within_noise(image, mixed * SHINING)


def test_layers_of_what_lobes_cannot_carry(tmp_path):
    spectra = [RED, BLUE, GREEN, PALE]
    mattes = [Material(f"m{k}", "matte", {"diffuseReflectance": each}) for k, each in enumerate(spectra)]
    native = renderer().translate(blend_of(mattes, [0.5, 0.25, 0.4]), (), tmp_path, "scene")
    names = ("albedo", "direct", "indirect")
    planes = renderer().layers(native, names, RenderOptions(), lambda fraction: None).planes
    mixed = 0.6 * (
        0.75 * (0.5 * RED.in_bands(BANDS) + 0.5 * BLUE.in_bands(BANDS)) + 0.25 * GREEN.in_bands(BANDS)
    )
    mixed = mixed + 0.4 * PALE.in_bands(BANDS)
    np.testing.assert_allclose(planes["albedo"].mean(axis=(0, 1)), mixed, rtol=0.01)
    np.testing.assert_allclose(planes["direct"].mean(axis=(0, 1)), mixed * SHINING, rtol=0.01)
    assert not planes["indirect"].any()


def test_a_native_scene_that_names_its_metal_is_rendered_as_by_its_index(tmp_path):
    import mitsuba

    tables = Path(mitsuba.__file__).parent / "data" / "ior"
    index = {part: read_spd(tables / f"Au.{part}.spd") for part in ("eta", "k")}
    gold = Material("paint", "metal", {**index, "roughness": 0.3})
    one = scene(environment=lamp("environment", filename=""), samples=64, kind="centre")
    native = renderer().translate(
        replace(one, materials={**one.materials, "paint": gold}), (), tmp_path, "scene"
    )
    by_index = renderer().render(native, RenderOptions(), lambda fraction: None)
    root = Xml.parse(native).getroot()
    metal = next(node for node in root.iter("bsdf") if node.get("type") == "roughconductor")
    for node in [node for node in metal if node.get("name") in ("eta", "k")]:
        metal.remove(node)
    metal.append(Xml.Element("string", name="material", value="Au"))
    Xml.ElementTree(root).write(native)
    by_name = renderer().render(native, RenderOptions(), lambda fraction: None)
    variants = by_index.attributes["variant"], by_name.attributes["variant"]
    assert variants == (session.FAST, session.FAST_BANDS)
    np.testing.assert_allclose(by_name.radiance, by_index.radiance, rtol=1e-3)


def test_other_spectra_in_the_all_bands_path_recompile_nothing(tmp_path):
    def mattes(scale):
        spectra = [RED, BLUE, GREEN, PALE]
        return [
            Material(f"m{k}", "matte", {"diffuseReflectance": each.scaled(scale)})
            for k, each in enumerate(spectra)
        ]

    picture(blend_of(mattes(1.0), [0.5, 0.25, 0.4]), tmp_path)
    ran, compiled = kernels(blend_of(mattes(0.5), [0.5, 0.25, 0.4]), tmp_path, "other")
    assert (ran > 0, compiled) == (True, 0)
