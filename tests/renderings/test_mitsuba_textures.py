"""Mitsuba's textures: every texel where it belongs, in every band, in stock Mitsuba too with our plugin."""

import re
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from rtb_addon.errors import RecipeError, RenderingError
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import llvm, renderer, session
from rtb_addon.renderers.pictures import read_picture
from rtb_addon.scene.render_scene import Camera, Material, Mesh, Shape, Texture, TextureUse
from rtb_addon.spectra import Bands, Spectrum
from tests.renderings.mitsuba_scenes import (
    BANDS,
    REFLECTANCE,
    assert_within_noise,
    at,
    kernels,
    lamp,
    picture,
    scene,
    square,
)
from tests.renderings.spectral_pictures import write_spectra

PLAIN = square(1)
SHEET = Mesh(PLAIN.vertices, PLAIN.triangles, None, np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32))
# Straight from above and so strong that a matte surface shows its reflectance.
SUN = lamp("directional", intensity=Spectrum.constant(np.pi), angle=0.0)
DEFAULTS = {
    **{"wrapMode": "repeat", "filterMode": "nearest", "gamma": 1.0, "maxAnisotropy": 20.0},
    **{"offsetU": 0.0, "offsetV": 0.0, "scaleU": 1.0, "scaleV": 1.0},
}
RANDOM = np.random.default_rng(5)
COLOURS = RANDOM.integers(0, 256, (3, 4, 3), dtype=np.uint8)
SPECTRA = RANDOM.random((3, 4, len(BANDS))).astype(np.float32)


@pytest.fixture
def coloured(tmp_path):
    Image.fromarray(COLOURS).save(tmp_path / "colours.png")
    return tmp_path / "colours.png"


@pytest.fixture
def spectral(tmp_path):
    return write_spectra(tmp_path / "spectra.exr", SPECTRA, BANDS, "T")


def sheet(texture, size=(4, 3), window=(-1.0, 1.0, -1.0, 1.0), model="matte", **changes):
    """Return a square that shows a texture from edge to edge, seen from above."""
    camera = Camera("Camera", "orthographic", at(0, 0, 2), window)
    one = scene([SUN], [Shape("Sheet", SHEET, np.eye(4), "paint")], camera=camera, size=size, **changes)
    uses = {"diffuseReflectance": TextureUse("texture")}
    coat = {"intIOR": 1.5, "extIOR": 1.0} if model == "plastic" else {}
    materials = {**one.materials, "paint": Material("paint", model, {**uses, **coat})}
    return replace(one, materials=materials, textures={"texture": texture})


def bitmap(path, **changes):
    return Texture("texture", "bitmap", {"filename": str(path), **DEFAULTS, **changes})


def in_bands(path, bands=BANDS):
    found = read_picture(path)
    return found.texels @ found.weights(bands, "averaged")


@pytest.mark.parametrize("kind", ["coloured", "spectral"])
def test_every_texel_shows_where_it_belongs_in_every_band(tmp_path, kind, request):
    path = request.getfixturevalue(kind)
    image = picture(sheet(bitmap(path)), tmp_path)
    # The picture stands upright: its first row on top, where V is 1.
    np.testing.assert_allclose(image.radiance, in_bands(path), rtol=1e-5, atol=1e-6)


def test_a_multispectral_texture_is_exact_in_every_band(tmp_path, spectral):
    image = picture(sheet(bitmap(spectral)), tmp_path)
    np.testing.assert_allclose(image.radiance, SPECTRA, rtol=1e-5, atol=1e-6)


def test_a_texture_is_scaled_then_moved(tmp_path, spectral):
    moved = bitmap(spectral, scaleU=2.0, offsetU=0.25, offsetV=1 / 3)
    image = picture(sheet(moved, size=(8, 3)), tmp_path)
    expected = np.roll(np.tile(SPECTRA, (1, 2, 1)), (1, -1), axis=(0, 1))
    np.testing.assert_allclose(image.radiance, expected, rtol=1e-5, atol=1e-6)


BEYOND = {
    "repeat": lambda row: np.concatenate([row, row, row], axis=1),
    "mirror": lambda row: np.concatenate([row[:, ::-1], row, row[:, ::-1]], axis=1),
    "clamp": lambda row: np.concatenate([row[:, :1]] * 4 + [row] + [row[:, -1:]] * 4, axis=1),
}


@pytest.mark.parametrize("wrap", BEYOND)
def test_beyond_its_edges_a_picture_goes_on_as_asked(tmp_path, spectral, wrap):
    wide = bitmap(spectral, wrapMode=wrap, scaleU=3.0, offsetU=-1.0)
    image = picture(sheet(wide, size=(12, 3)), tmp_path)
    np.testing.assert_allclose(image.radiance, BEYOND[wrap](SPECTRA), rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("kind", ["coloured", "spectral"])
def test_texels_fade_into_each_other_in_a_straight_line(tmp_path, kind, request):
    path = request.getfixturevalue(kind)
    # A row of tiny windows between the middles of two texels of the middle row.
    window = (-0.75, -0.25, -1e-4, 1e-4)
    image = picture(
        sheet(bitmap(path, filterMode="bilinear"), size=(5, 1), window=window, samples=256), tmp_path
    )
    left, right = in_bands(path)[1, :2]
    share = (np.arange(5) + 0.5)[:, None] / 5
    np.testing.assert_allclose(image.radiance[0], left + (right - left) * share, atol=2e-3)


def test_a_checkerboard_begins_with_even_at_the_lower_left(tmp_path):
    even, odd = REFLECTANCE, Spectrum.constant(0.1)
    numbers = {"checksPerU": 4.0, "checksPerV": 2.0, "offsetU": 0.0, "offsetV": 0.0}
    board = Texture("texture", "checkerboard", {"evenColor": even, "oddColor": odd, **numbers})
    shown = picture(sheet(board, size=(4, 2)), tmp_path).radiance
    places = np.indices((2, 4))
    pattern = ((1 - places[0] + places[1]) % 2 == 0)[..., None]
    np.testing.assert_allclose(shown, np.where(pattern, even.in_bands(BANDS), odd.in_bands(BANDS)), rtol=1e-5)


def test_plastic_wears_a_picture_under_its_coat(tmp_path, coloured):
    one = sheet(bitmap(coloured), model="plastic", samples=1024, size=(8, 6), window=(-1, -0.5, 1 / 3, 1.0))
    one = replace(
        one, lights=(), environment=lamp("environment", filename="", intensity=Spectrum.constant(1.0))
    )
    expected = 0.04 + 0.96 * in_bands(coloured)[0, 0]
    # As in the closed form of plastic, whose inner reflection Mitsuba takes from a fit.
    assert_within_noise(picture(one, tmp_path), expected, floor=3e-3)


def test_several_surfaces_show_pictures_of_both_kinds_side_by_side(tmp_path, coloured, spectral):
    one = sheet(bitmap(coloured), size=(4, 6), window=(-1.0, 1.0, -1.0, 3.0))
    others = {"other": ("second", spectral), "again": ("third", spectral)}
    made = {
        name: Material(name, "matte", {"diffuseReflectance": TextureUse(texture)})
        for name, (texture, _) in others.items()
    }
    textures = {name: replace(bitmap(path), id=name) for name, path in others.values()}
    textures["third"] = replace(bitmap(spectral, scaleU=-1.0, offsetU=1.0), id="third")
    half = SHEET.vertices * np.array([0.5, 1, 1], np.float32)
    narrow = Mesh(half, SHEET.triangles, None, SHEET.uvs)
    above = [Shape(name, narrow, at(x, 2, 0), name) for name, x in [("other", -0.5), ("again", 0.5)]]
    one = replace(
        one,
        shapes=(*one.shapes, *above),
        materials={**one.materials, **made},
        textures={**one.textures, **textures},
        film=replace(one.film, width=8),
    )
    shown = picture(one, tmp_path).radiance
    np.testing.assert_allclose(shown[3:, ::2], in_bands(coloured), rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(shown[:3], np.hstack([SPECTRA, SPECTRA[:, ::-1]]), rtol=1e-5, atol=1e-6)


def test_another_picture_of_the_same_kind_recompiles_nothing(tmp_path, spectral):
    picture(sheet(bitmap(spectral)), tmp_path)
    file = write_spectra(tmp_path / "other.exr", RANDOM.random((7, 9, 7)), Bands.regular(400, 50, 7), "T")
    other = bitmap(file, wrapMode="mirror", filterMode="ewa", scaleV=3.0)
    assert kernels(sheet(other), tmp_path, "other")[1] == 0


@pytest.mark.parametrize("kind", ["coloured", "spectral"])
@pytest.mark.parametrize("filter", ["nearest", "bilinear"])
def test_stock_mitsubas_spectral_film_shows_the_same_with_our_plugin(tmp_path, kind, filter, request):
    path = request.getfixturevalue(kind)
    bands = Bands.around([430.0, 530.0, 590.0, 650.0])
    changes = {"bands": bands, "kind": "centre", "samples": 4096}
    native = renderer().translate(
        sheet(bitmap(path, filterMode=filter, wrapMode="mirror", scaleU=1.5), **changes),
        (),
        tmp_path,
        "scene",
    )
    assert "paint needs a plugin of ours" in native.read_text()
    ours = renderer().render(native, RenderOptions(), lambda fraction: None).radiance
    mi = session.start("llvm_ad_spectral", 1)
    loaded = mi.load_file(str(native))
    seeds = np.stack([np.array(mi.render(loaded, spp=4096, seed=seed)) for seed in range(8)])
    error = seeds.std(axis=0, ddof=1) / np.sqrt(8)
    # The bands lie between channels, where lines do not bend. Eight seeds give a t distribution with long
    # tails, and ours has noise of its own where texels fade.
    assert (np.abs(seeds.mean(axis=0) - ours) < 8 * error + 4e-3).all()
    assert (error < 0.02).all()


def test_a_texture_on_a_mesh_without_coordinates_is_refused(tmp_path, coloured):
    bare = replace(sheet(bitmap(coloured)), shapes=(Shape("Sheet", PLAIN, np.eye(4), "paint"),))
    with pytest.raises(RecipeError, match="shape Sheet has texture texture but no texture coordinates"):
        renderer().translate(bare, (), tmp_path, "bare")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"wrapMode": "zero"}, "wrapMode zero, give one of"),
        ({"filterMode": "cubic"}, "filterMode cubic, give one of"),
        ({"scaleU": np.inf}, "has inf as its scaleU"),
    ],
)
def test_a_word_that_no_picture_knows_is_refused(tmp_path, coloured, change, words):
    with pytest.raises(RecipeError, match=re.escape(words)):
        renderer().translate(sheet(bitmap(coloured, **change)), (), tmp_path, "wrong")


def test_without_llvm_a_picture_is_refused(tmp_path, coloured, monkeypatch):
    monkeypatch.setattr(llvm, "prepare", lambda: None)
    with pytest.raises(RenderingError, match="cannot render the picture on paint"):
        picture(sheet(bitmap(coloured)), tmp_path)
