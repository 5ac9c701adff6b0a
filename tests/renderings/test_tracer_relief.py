"""The tracer's bumps and normal maps against closed forms, around every kind of material."""

from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.errors import RecipeError, RenderingError
from rtb_addon.exr import write_exr
from rtb_addon.scene.render_scene import Camera, Material, Shape, Texture
from rtb_addon.scene.vocabulary import TEXTURES
from tests.renderings.scattering import assert_samples_as_it_says, direction, model_of
from tests.renderings.tracer_scenes import (
    BANDS,
    GREY,
    IOR,
    RADIANCE,
    SHAPE_OF_LIGHT,
    SQUARE,
    TINTS,
    WHITE,
    assert_within_noise,
    ball,
    facing,
    glass,
    lamp,
    matrix,
    matte,
    picture,
    scene,
    sky,
    ward,
)

# U from 0 to 1 along X over two metres, V along Y.
UNIT = replace(SQUARE, uvs=(SQUARE.vertices[:, :2] + 1) / 2)
SUN = np.array([0.3, -0.2, 0.9]) / np.linalg.norm([0.3, -0.2, 0.9])
GOLD = {"eta": GREY, "k": WHITE}
UNDER = {
    "matte": matte("under"),
    "ward": ward("under", alpha_v=0.4),
    "metal": Material("under", "metal", {**GOLD, "roughness": 0.3}),
    "roughplastic": Material("under", "roughplastic", {**IOR, "diffuseReflectance": GREY, "roughness": 0.2}),
    "roughglass": Material("under", "roughglass", {**IOR, **TINTS, "roughness": 0.3}),
}


def heights(path, numbers):
    """Write heights [m per scale], the mean of three channels, and return the file's name."""
    numbers = np.float32(numbers)
    write_exr(path, {}, {"R": numbers - 0.25, "G": numbers + 0.5, "B": numbers - 0.25})
    return str(path)


def coded(path, normal, shape=(4, 4)):
    """Write a map of one normal, and return the file's name."""
    plane = np.ones(shape, np.float32)
    write_exr(path, {}, {n: plane * np.float32((x + 1) / 2) for n, x in zip("RGB", normal, strict=True)})
    return str(path)


def bitmap(file, **said):
    defaults = {name: one.default_value() for name, one in TEXTURES["bitmap"].items()}
    return Texture("relief", "bitmap", {**defaults, "filename": file, **said})


def around(model, under="under", id="paint", **said):
    scale = {"scale": 1.0} if model == "bumpmap" else {}
    return Material(id, model, {"materialID": under, "textureID": "relief", **scale, **said})


def relieved(relief, texture, under=None, sun=SUN, side=1, mesh=UNIT, to_world=None, **more):
    """Return a scene that looks straight at a sheet with a relief under a sun."""
    sheet = Shape("sheet", mesh, matrix() if to_world is None else to_world, "paint")
    camera = Camera("c", "orthographic", facing((0, 0, 5 * side), (0, 0, 0)), (-0.4, 0.4, -0.4, 0.4))
    lights = [lamp("directional", facing(sun, (0, 0, 0)))]
    materials = [under or matte("under"), relief]
    options = {"size": (4, 4), "samples": 4, "textures": {"relief": texture}, **more}
    return scene([sheet], lights, materials, camera, **options)


def lit(normal, towards=SUN):
    """Return the radiance per band of grey paint whose normal is turned, under the sun."""
    n = np.array(normal) / np.linalg.norm(normal)
    roughness2, low = min((1 / n[2] ** 2 - 1) / 8, 1), 1 / towards[2] ** 2 - 1
    left = 2 / (1 + np.sqrt(1 + roughness2 * low))
    return GREY.in_bands(BANDS) / np.pi * max(n @ towards, 0) * left * SHAPE_OF_LIGHT


def ramp(folder, along_u, along_v, shape=(16, 32)):
    u, v = np.meshgrid((np.arange(shape[1]) + 0.5) / shape[1], 1 - (np.arange(shape[0]) + 0.5) / shape[0])
    return heights(folder / "ramp.exr", along_u * u + along_v * v)


def assert_even(seen, expected, rtol=2e-4):
    np.testing.assert_allclose(seen, np.broadcast_to(expected, seen.shape), rtol=rtol)


@pytest.mark.parametrize(("along_u", "along_v"), [(0.6, 0.0), (0.0, -0.8), (0.5, 0.3)])
@pytest.mark.parametrize("scale", [1.0, -0.5])
def test_a_ramp_leans_as_its_height_in_metres_says(tmp_path, along_u, along_v, scale):
    bumps = around("bumpmap", scale=scale)
    seen = picture(relieved(bumps, bitmap(ramp(tmp_path, along_u, along_v))), tmp_path)
    # The sheet is two metres wide.
    assert_even(seen, lit([-scale * along_u / 2, -scale * along_v / 2, 1]))


def test_a_ramp_that_is_repeated_more_often_is_steeper(tmp_path):
    texture = bitmap(ramp(tmp_path, 0.3, 0.2), scaleU=2.0, scaleV=0.5, offsetU=-0.5, offsetV=0.25)
    seen = picture(relieved(around("bumpmap"), texture), tmp_path)
    assert_even(seen, lit([-0.3, -0.05, 1]))


@pytest.mark.parametrize("flipped", [False, True])
def test_bumps_rise_outwards_however_the_texture_lies(tmp_path, flipped):
    """Turned by a right angle and perhaps mirrored: a height is a height."""
    uvs = UNIT.uvs[:, ::-1] * ([1, 1] if flipped else [1, -1])
    seen = picture(
        relieved(around("bumpmap"), bitmap(ramp(tmp_path, 0.4, 0.0)), mesh=replace(UNIT, uvs=uvs)), tmp_path
    )
    assert_even(seen, lit([0, -0.2, 1]))


def test_from_behind_a_bump_is_a_dent(tmp_path):
    behind = SUN * [1, 1, -1]
    seen = picture(
        relieved(around("bumpmap"), bitmap(ramp(tmp_path, 0.6, 0.0)), sun=behind, side=-1), tmp_path
    )
    # The same surface: its normal, turned round, as a mirror below the sheet shows it.
    assert_even(seen, lit([0.3, 0, 1]))


@pytest.mark.parametrize("normal", [(0, 0, 1), (0.3, 0, 0.9), (-0.2, 0.5, 0.8)])
def test_a_normal_map_says_the_normal(tmp_path, normal):
    seen = picture(relieved(around("normalmap"), bitmap(coded(tmp_path / "n.exr", normal))), tmp_path)
    assert_even(seen, lit(normal))


def test_a_normal_map_follows_u_and_the_surface(tmp_path):
    """On a sheet that is turned about the vertical, and coordinates that are turned once more."""
    uvs = np.stack([UNIT.uvs[:, 1], -UNIT.uvs[:, 0]], axis=1)
    turned = matrix((0, 0, 0), (0.6, 0.8, 0), (-0.8, 0.6, 0))
    texture = bitmap(coded(tmp_path / "n.exr", (0.4, 0.1, 0.9)))
    seen = picture(
        relieved(around("normalmap"), texture, mesh=replace(UNIT, uvs=uvs), to_world=turned), tmp_path
    )
    # U along the sheet's Y, which is (-0.8, 0.6); what is across it on the left is -X, (-0.6, -0.8).
    assert_even(seen, lit([0.4 * -0.8 + 0.1 * -0.6, 0.4 * 0.6 + 0.1 * -0.8, 0.9]))


@pytest.mark.parametrize("model", ["bumpmap", "normalmap"])
@pytest.mark.parametrize("name", [*UNDER, "glass", "mirror"])
def test_a_level_relief_changes_nothing(tmp_path, model, name):
    texture = bitmap(
        heights(tmp_path / "r.exr", np.full((4, 4), 0.3))
        if model == "bumpmap"
        else coded(tmp_path / "r.exr", (0, 0, 1))
    )
    more = {"glass": glass(), "mirror": Material("under", "mirror", {"specularReflectance": GREY})}
    under = replace({**UNDER, **more}[name], id="under")
    bare = replace(around(model), model=under.model, parameters=under.parameters)
    # Something that is brushed makes all axes follow U.
    brushed = ward("brushed", alpha_v=0.4)
    globe = ball(0.9, 12)
    globe = replace(globe, uvs=globe.vertices[:, :2].copy())
    scenes = [
        relieved(one, texture, under, mesh=globe, depth=4, environment=sky(0.4))
        for one in (around(model), bare)
    ]
    seen, plain = (
        picture(replace(one, materials={**one.materials, "brushed": brushed}), tmp_path) for one in scenes
    )
    # The same paths, but for rounding.
    np.testing.assert_allclose(seen, plain, rtol=2e-4, atol=1e-5)


@pytest.mark.parametrize("name", UNDER)
@pytest.mark.parametrize("back", [(0, 0), (40, 30), (75, 100)])
@pytest.mark.parametrize("side", [1, -1])
def test_what_has_a_relief_samples_as_it_says(tmp_path, name, back, side):
    texture = bitmap(coded(tmp_path / "n.exr", (0.3, -0.2, 0.8)))
    model = model_of(around("normalmap"), [UNDER[name]], [texture])
    assert_samples_as_it_says(model, direction(*back), side, seed=1)


def test_a_mirror_with_a_normal_map_shows_another_place(tmp_path):
    """Leaning by an eighth of a turn, it shows what is beside it."""
    mirror = Material("under", "mirror", {"specularReflectance": WHITE})
    texture = bitmap(coded(tmp_path / "n.exr", (np.sin(np.pi / 8), 0, np.cos(np.pi / 8))))
    base = relieved(around("normalmap"), texture, mirror)
    wall = Shape("wall", SQUARE, matrix((4, 0, 4), (0, 1, 0), (0, 0, -1), (-1, 0, 0)), "black", RADIANCE)
    both = replace(base, shapes=(*base.shapes, wall), lights=())
    both = replace(both, materials={**both.materials, "black": matte("black")})
    # The terminator's share at 45 degrees.
    left = 2 / (1 + np.sqrt(1 + np.tan(np.pi / 8) ** 2 / 8))
    assert_even(picture(both, tmp_path), np.array(SHAPE_OF_LIGHT) * left, 1e-4)


def test_reliefs_go_around_what_is_made_of_others(tmp_path):
    texture = bitmap(coded(tmp_path / "n.exr", (0.3, -0.2, 0.8)))
    mix = Material("under", "blend", {"materialID": "grey", "otherMaterialID": "black", "weight": 0.25})
    hole = Material("hole", "mask", {"materialID": "paint", "opacity": 0.5})
    one = relieved(around("normalmap"), texture, mix, samples=256)
    sheet = replace(one.shapes[0], material="hole")
    more = {"grey": matte("grey"), "black": matte("black", GREY.scaled(0.0)), "hole": hole}
    seen = picture(replace(one, shapes=(sheet,), materials={**one.materials, **more}), tmp_path)
    assert_even(seen, lit([0.3, -0.2, 0.8]) * 0.75 * 0.5, 2e-2)


def test_a_relief_on_a_relief_turns_twice(tmp_path):
    """Two ramps along U add up."""
    bumps = bitmap(ramp(tmp_path, 0.3, 0.0))
    inner, outer = around("bumpmap", id="inner"), around("bumpmap", "inner")
    one = relieved(outer, bumps, samples=1, sun=np.array([0, 0, 1.0]))
    seen = picture(replace(one, materials={**one.materials, "inner": inner}), tmp_path)
    n = np.array([-0.15, 0, 1]) / np.hypot(0.15, 1)
    # dp/du of the first lies in the leaning surface; the second is added at right angles to it.
    u = np.array([2, 0, 0.0])
    u = u - (u @ n) * n + 0.3 * n
    second = np.cross(u, [0, 2.0, 0])
    second /= np.linalg.norm(second)
    tangent2 = 1 / np.square([n[2], n @ second]) - 1
    # The sun is straight above the sheet, but not above the first relief.
    left = 2 / (1 + np.sqrt(1 + min(tangent2[1] / 8, 1) * tangent2[0]))
    expected = GREY.in_bands(BANDS) / np.pi * second[2] * left * SHAPE_OF_LIGHT
    assert_even(seen, expected)


def test_a_white_surface_with_bumps_makes_no_light(tmp_path):
    rng = np.random.default_rng(5)
    texture = bitmap(heights(tmp_path / "r.exr", rng.random((16, 16)) * 0.1))
    one = relieved(
        around("bumpmap"), texture, matte("under", WHITE), depth=2, environment=sky(1.0), samples=64
    )
    seen = picture(replace(one, lights=()), tmp_path)
    assert 0.6 < seen.mean() < 1


def test_a_tilt_under_an_even_sky_loses_what_lies_below_the_surface(tmp_path):
    """The integral over the sky above the sheet, by a grid of directions of our own."""
    texture = bitmap(coded(tmp_path / "n.exr", (0.5, 0, 0.8)))
    n = np.array([0.5, 0, 0.8]) / np.hypot(0.5, 0.8)
    z, turn = np.meshgrid((np.arange(1000) + 0.5) / 1000, (np.arange(1000) + 0.5) / 1000 * 2 * np.pi)
    r = np.sqrt(1 - z**2)
    ways = np.stack([r * np.cos(turn), r * np.sin(turn), z]).reshape(3, -1)
    roughness2 = (1 / n[2] ** 2 - 1) / 8
    left = 2 / (1 + np.sqrt(1 + roughness2 * (1 / ways[2] ** 2 - 1)))
    share = (np.maximum(n @ ways, 0) * left).mean() * 2
    expected = GREY.in_bands(BANDS) * share

    def make(seed):
        base = relieved(around("normalmap"), texture, environment=sky(1.0), samples=64, seed=seed)
        return replace(base, lights=())

    assert_within_noise(make, tmp_path, expected)


def test_reliefs_that_cannot_be_are_refused(tmp_path):
    board = Texture(
        "relief", "checkerboard", {k: v.default_value() for k, v in TEXTURES["checkerboard"].items()}
    )
    with pytest.raises(
        RecipeError, match="relief is a checkerboard, whose edges have no slope, give paint a"
    ):
        picture(relieved(around("bumpmap"), board), tmp_path)
    level = bitmap(coded(tmp_path / "n.exr", (0, 0, 1)))
    with pytest.raises(RecipeError, match="sheet has no texture coordinates for texture relief"):
        picture(relieved(around("normalmap"), level, mesh=SQUARE), tmp_path)
    with pytest.raises(RecipeError, match="material paint has scale"):
        picture(relieved(around("bumpmap", scale=np.inf), level), tmp_path)
    write_exr(tmp_path / "one.exr", {}, {"T.400,000000nm": np.ones((2, 2), np.float32)})
    with pytest.raises((RecipeError, RenderingError), match="channels, give a picture of colours"):
        picture(relieved(around("normalmap"), bitmap(str(tmp_path / "one.exr"))), tmp_path)
