"""The principled material in lobes: stock Mitsuba's own, spectrum by spectrum, alone and in blends."""

from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.exr import write_exr
from rtb_addon.renderers.mitsuba import llvm, session
from rtb_addon.scene.render_scene import Material, Mesh, Shape, TextureUse
from rtb_addon.spectra import Spectrum
from rtb_addon.spectra.channels import channel_name
from tests.renderings import materials_scene
from tests.renderings.mitsuba_scenes import BANDS, INTENSITY, REFLECTANCE, lamp, picture, scene
from tests.renderings.test_mitsuba_textures import SHEET, bitmap

RANDOM = np.random.default_rng(8)
NUMBERS = [
    {"metallic": 0.0, "roughness": 0.5, "specular": 0.5},
    {"metallic": 1.0, "roughness": 0.2, "specular": 0.5},
    {"metallic": 0.35, "roughness": 0.8, "specular": 0.9},
    {"metallic": 0.0, "roughness": 0.05, "specular": 0.0},
    # Words that only a native scene may have as yet.
    {"metallic": 0.2, "roughness": 0.4, "anisotropic": 0.7, "flatness": 0.6},
    {"roughness": 0.4, "sheen": 0.8, "clearcoat": 0.9, "clearcoat_gloss": 0.3},
]


@pytest.mark.parametrize("numbers", NUMBERS)
def test_lobes_add_up_to_the_spectrum_of_stock_mitsuba_for_any_pair_of_directions(numbers):
    llvm.prepare()
    ways = RANDOM.normal(size=(2, 3, 500))
    ways[:, 2] = np.abs(ways[:, 2])
    back, out = (way / np.linalg.norm(way, axis=0) for way in ways)
    draws = RANDOM.random((3, 500)).astype(np.float32)
    colours = np.array([0.1, 0.35, 0.8, 1.2])

    def of(mi, colour, wavelengths=None):
        """Return values, densities, samples' directions and weights."""
        import drjit as dr

        bsdf = mi.load_dict({"type": "principled", **numbers, "base_color": colour})
        si = dr.zeros(mi.SurfaceInteraction3f, 500)
        si.wi = mi.Vector3f(back.astype(np.float32))
        if wavelengths is not None:
            si.wavelengths = mi.Spectrum(*wavelengths)
        wo = mi.Vector3f(out.astype(np.float32))
        found = bsdf.eval_pdf_sample(mi.BSDFContext(), si, wo, mi.Float(draws[0]), mi.Point2f(draws[1:]))
        value, density, turn, weight = found
        return [np.array(each) for each in (value, density, turn.wo, weight)]

    mi = session.start(session.FAST, 1)
    value, density, turned, weight = of(mi, {"type": "rawconstant", "value": mi.ScalarVector3f(1, 0, 0)})
    mi = session.start("llvm_ad_spectral", 1)
    table = {"type": "regular", "wavelength_min": 400.0, "wavelength_max": 700.0}
    table["values"] = ", ".join(map(str, colours))
    stock = of(mi, table, [400.0, 500.0, 600.0, 700.0])
    # Nothing that is drawn depends on the colour.
    np.testing.assert_allclose(density, stock[1], rtol=2e-5)
    np.testing.assert_allclose(turned, stock[2], atol=2e-6)
    for lobes, spectral in ((value, stock[0]), (weight, stock[3])):
        made = lobes[2] + (lobes[0] - lobes[2]) * colours[:, None]
        np.testing.assert_allclose(made, spectral, rtol=1e-4, atol=1e-6)


def of_paint(model, made=(), **parameters):
    one = scene(environment=lamp("environment", filename=""), samples=600, depth=2)
    paints = {**{each.id: each for each in made}, "paint": Material("paint", model, parameters)}
    return replace(one, materials={**one.materials, **paints})


COLOURS = {390.0: 0.2, 530.0: 0.9, 610.0: 0.5, 730.0: 0.3, 790.0: 0.4}
PLAIN = {"metallic": 0.0, "roughness": 0.4, "specular": 0.5}
SHINING = INTENSITY.in_bands(BANDS)


def test_what_a_principled_surface_reflects_is_a_straight_line_in_its_colour(tmp_path):
    dark, mixed, light = (
        picture(of_paint("principled", baseColor=colour, **PLAIN), tmp_path).radiance[..., :]
        for colour in (Spectrum.constant(0.0), REFLECTANCE, Spectrum.constant(1.0))
    )
    expected = dark + (light - dark) * REFLECTANCE.in_bands(BANDS)
    # The same paths, so that there is no noise between them.
    np.testing.assert_allclose(mixed, expected, rtol=1e-4)
    # Black paint reflects some four per cent from its surface, in all bands alike.
    share = dark / SHINING
    assert 0.03 < share.min() <= share.max() < 0.06
    np.testing.assert_allclose(share, share[..., :1] + 0 * share, rtol=1e-4)


def test_a_picture_as_the_colour_is_as_good_as_a_spectrum(tmp_path):
    one = of_paint("principled", baseColor=TextureUse("picture"), **PLAIN)
    planes = {channel_name(nm): np.full((2, 2), value, np.float32) for nm, value in COLOURS.items()}
    write_exr(tmp_path / "even.exr", {}, planes)
    one = replace(one, textures={"picture": replace(bitmap(tmp_path / "even.exr"), id="picture")})
    floor = Shape("Floor", Mesh(50 * SHEET.vertices, SHEET.triangles, None, SHEET.uvs), np.eye(4), "paint")
    shown = picture(replace(one, shapes=(floor,)), tmp_path).radiance
    colour = Spectrum.of(list(COLOURS), list(COLOURS.values()))
    plain = picture(replace(of_paint("principled", baseColor=colour, **PLAIN), shapes=(floor,)), tmp_path)
    np.testing.assert_allclose(shown, plain.radiance, rtol=1e-4)


@pytest.mark.parametrize("other", ["matte", "metal", "mirror"])
def test_a_blend_with_a_principled_surface_keeps_the_lobes_apart(tmp_path, other):
    coat = Material("coat", "principled", {"baseColor": REFLECTANCE, **PLAIN})
    blue = Spectrum.of([400, 500, 700], [0.9, 0.3, 0.1])
    said = {
        "matte": {"diffuseReflectance": blue},
        "mirror": {"specularReflectance": blue},
        "metal": {**materials_scene.GOLD, "roughness": 0.3},
    }[other]
    base = Material("base", other, said)
    names = {"materialID": "coat", "otherMaterialID": "base"}
    parts = [
        picture(of_paint(one.model, **one.parameters), tmp_path).radiance.mean(axis=(0, 1))
        for one in (coat, base)
    ]
    image = picture(of_paint("blend", (coat, base), **names, weight=0.3), tmp_path).radiance
    mean, error = image.mean(axis=(0, 1)), image.std(axis=(0, 1)) / 4
    expected = 0.7 * parts[0] + 0.3 * parts[1]
    # The parts have noise of their own, of about the same size.
    assert (np.abs(mean - expected) < 6 * error + 1e-3 * expected).all()
    assert (error < 0.01 * mean).all()
