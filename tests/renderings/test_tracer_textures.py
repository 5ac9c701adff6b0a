"""The tracer's textures, texel by texel."""

import json
import shutil
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from rtb_addon.errors import RecipeError
from rtb_addon.renderers import find
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.scene.render_scene import Material, Shape, Texture, TextureUse
from rtb_addon.scene.vocabulary import TEXTURES
from rtb_addon.spectra import Spectrum
from rtb_addon.spectra.promotion import promoted
from tests.renderings.spectral_pictures import write_spectra
from tests.renderings.tracer_scenes import (
    BANDS,
    GREY,
    SQUARE,
    lamp,
    looking_down,
    matrix,
    matte,
    picture,
    reflected,
    scene,
    ward,
)

ODD, EVEN = Spectrum.of([400, 700], [0.1, 0.9]), Spectrum.of([400, 700], [0.8, 0.3])
# U from 0 to 1 along X, V along Y.
UNIT = replace(SQUARE, uvs=(SQUARE.vertices[:, :2] + 1) / 2)


def texture(kind, **said):
    defaults = {name: one.default_value() for name, one in TEXTURES[kind].items()}
    return Texture("board", kind, {**defaults, **said})


def painted(made, size=(8, 8), mesh=UNIT, half=1.0, **options):
    """Return a scene that looks down at a square metre with a texture, under a sun."""
    floor = Shape("floor", mesh, matrix(), "paint")
    paint = matte("paint", TextureUse("board"))
    lights = [lamp("directional", matrix(), [1] * 4)]
    return replace(
        scene([floor], lights, [paint], looking_down(half), size=size, **options), textures={"board": made}
    )


def seen(made, folder, **more):
    """Return the reflectance of each pixel."""
    return picture(painted(made, **more), folder) * np.pi


def test_a_checkerboard_has_as_many_checks_as_it_says(tmp_path):
    board = texture("checkerboard", checksPerU=4.0, checksPerV=2.0, oddColor=ODD, evenColor=EVEN)
    columns, rows = np.meshgrid(np.arange(8) // 2, (7 - np.arange(8)) // 4)
    odd = (columns + rows) % 2 == 1
    expected = np.where(odd[..., None], ODD.in_bands(BANDS), EVEN.in_bands(BANDS))
    np.testing.assert_allclose(seen(board, tmp_path), expected, rtol=1e-5)


def test_a_checkerboard_is_moved_by_its_offset(tmp_path):
    board = texture("checkerboard", oddColor=ODD, evenColor=EVEN)
    moved = texture("checkerboard", oddColor=ODD, evenColor=EVEN, offsetU=0.5)
    np.testing.assert_allclose(seen(moved, tmp_path), seen(board, tmp_path)[:, ::-1], rtol=1e-6)


def colours_of(reflectances):
    """Return what promotion makes of an array of colours, per band."""
    flat = np.reshape(reflectances, (-1, 3))
    spectra = np.array([promoted(colour).in_bands(BANDS) for colour in flat])
    return spectra.reshape(*np.shape(reflectances)[:2], len(BANDS))


FOUR = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [51, 102, 153]]], np.uint8)


@pytest.fixture
def file(tmp_path):
    """Return a picture of two by two colours: red, green above, blue, dusk below."""
    path = tmp_path / "four.png"
    Image.fromarray(FOUR).save(path)
    return str(path)


def test_a_picture_lies_on_its_surface_the_right_way_round(tmp_path, file):
    shown = seen(texture("bitmap", filename=file, filterMode="nearest"), tmp_path)
    expected = colours_of(FOUR / 255).repeat(4, axis=0).repeat(4, axis=1)
    np.testing.assert_allclose(shown, expected, atol=1e-6)


def test_gamma_makes_stored_numbers_linear(tmp_path, file):
    shown = seen(texture("bitmap", filename=file, filterMode="nearest", gamma=2.2), tmp_path)
    np.testing.assert_allclose(shown[7, 7], colours_of((FOUR / 255) ** 2.2)[1, 1], rtol=1e-5)


@pytest.mark.parametrize(
    ("wrap", "columns"),
    [("repeat", [0, 1, 0, 1, 0, 1]), ("mirror", [1, 0, 0, 1, 1, 0]), ("clamp", [0, 0, 0, 1, 1, 1])],
)
def test_beyond_its_edge_a_picture_goes_on_as_it_says(tmp_path, file, wrap, columns):
    said = {"filename": file, "filterMode": "nearest", "wrapMode": wrap}
    wide = texture("bitmap", **said, scaleU=3.0, offsetU=-1.0)
    shown = seen(wide, tmp_path, size=(6, 2))
    np.testing.assert_allclose(shown, colours_of(FOUR / 255)[:, columns], atol=1e-6)


def test_between_texels_their_mean_is_seen(tmp_path, file):
    # The middle of the picture belongs to all four texels.
    shown = seen(texture("bitmap", filename=file), tmp_path, size=(1, 1), half=1e-6)
    np.testing.assert_allclose(shown[0, 0], colours_of(FOUR / 255).mean(axis=(0, 1)), rtol=1e-4)


def test_a_spectral_picture_is_exact_in_every_band(tmp_path):
    """Random reflectances, a channel at each band's centre: each pixel shows its texel's numbers."""
    texels = np.random.default_rng(1).random((4, 4, len(BANDS))).astype(np.float32)
    path = write_spectra(tmp_path / "spectral.exr", texels, BANDS, "T")
    shown = seen(texture("bitmap", filename=str(path), filterMode="nearest"), tmp_path, size=(4, 4))
    np.testing.assert_allclose(shown, texels, rtol=1e-6)


def test_any_reflectance_may_have_a_texture(tmp_path, file):
    """A highlight whose colour comes from a picture, over a plain diffuse lobe."""
    floor = Shape("floor", UNIT, matrix(), "gloss")
    made = texture("bitmap", filename=file, filterMode="nearest")
    lit = scene(
        [floor], [lamp("directional", matrix(), [1] * 4)], [ward("gloss", GREY, 0.0)], looking_down(1.0)
    )
    gloss = ward("gloss", GREY, TextureUse("board"))
    plain = picture(replace(lit, film=replace(lit.film, width=2, height=2)), tmp_path)
    shown = picture(
        replace(
            lit,
            film=replace(lit.film, width=2, height=2),
            materials={"gloss": gloss},
            textures={"board": made},
        ),
        tmp_path,
    )
    np.testing.assert_allclose(
        plain, np.broadcast_to(reflected(1.0) / [2, 3, 1, 0.5], plain.shape), rtol=1e-6
    )
    # Straight down and back: 1 / (4 pi alpha^2).
    np.testing.assert_allclose(
        shown - plain, colours_of(FOUR / 255) / (4 * np.pi * 0.04), rtol=1e-5, atol=1e-6
    )


def test_textures_and_plain_materials_share_a_picture(tmp_path):
    board = texture("checkerboard", oddColor=ODD, evenColor=ODD)
    floors = [Shape(id, UNIT, matrix((x, 0, 0)), id) for id, x in (("paint", -1), ("grey", 1))]
    materials = [matte("paint", TextureUse("board")), matte("grey")]
    lit = scene(floors, [lamp("directional", matrix())], materials, looking_down(1.0), size=(2, 1))
    shown = picture(replace(lit, textures={"board": board}), tmp_path)
    np.testing.assert_allclose(shown[0, 1], reflected(1.0), rtol=1e-6)
    np.testing.assert_allclose(
        shown[0, 0] / shown[0, 1], ODD.in_bands(BANDS) / GREY.in_bands(BANDS), rtol=1e-5
    )


def test_a_native_scene_names_its_pictures_from_where_it_lies(tmp_path, file):
    made = texture("bitmap", filename=file, filterMode="nearest")
    here, there = tmp_path / "here", tmp_path / "elsewhere"
    native = find("tracer").translate(painted(made), (), here / "scenes", "scene")
    assert json.loads(native.read_text())["textures"][0]["parameters"]["filename"] == "../../four.png"
    shutil.copytree(here, there)
    pictures = [
        find("tracer").render(path, RenderOptions(), lambda fraction: None).radiance
        for path in (native, there / "scenes" / "scene.json")
    ]
    np.testing.assert_array_equal(*pictures)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"wrapMode": "zero"}, "texture board has wrapMode zero, choose one of repeat, mirror, clamp"),
        ({"filterMode": "best"}, "texture board has filterMode best, choose one of ewa, trilinear, bilinear"),
        ({"scaleU": "wide"}, "texture board has scaleU wide, give a number"),
    ],
)
def test_textures_that_cannot_be_are_refused_in_a_sentence(tmp_path, file, change, sentence):
    with pytest.raises(RecipeError, match=sentence):
        seen(texture("bitmap", filename=file, **change), tmp_path)


def test_a_texture_on_a_mesh_without_coordinates_is_refused(tmp_path):
    with pytest.raises(
        RecipeError, match="shape floor has no texture coordinates for texture board, unwrap its"
    ):
        seen(texture("checkerboard"), tmp_path, mesh=SQUARE)


def test_a_number_cannot_have_a_texture(tmp_path):
    rough = Material(
        "paint",
        "metal",
        {"eta": Spectrum.constant(1.0), "k": Spectrum.constant(1.0), "roughness": TextureUse("board")},
    )
    with pytest.raises(RecipeError, match="material paint has roughness"):
        picture(replace(painted(texture("checkerboard")), materials={"paint": rough}), tmp_path)
