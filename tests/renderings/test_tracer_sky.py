"""The tracer's pictures of the sky against closed forms: how they look, what they light, how often."""

import json
import shutil

import numpy as np
import pytest
from PIL import Image
from scipy import interpolate, stats

from rtb_addon.exr import write_exr
from rtb_addon.renderers import find
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.tracer.lights.sky import Skies
from rtb_addon.scene.render_scene import Camera, Film, Light, Material, Shape
from rtb_addon.spectra import Spectrum, Unit
from rtb_addon.spectra.promotion import promoted
from tests.renderings.scattering import direction, evaluate, model_of
from tests.renderings.spectral_pictures import write_spectra
from tests.renderings.tracer_scenes import (
    BANDS,
    GREY,
    SHAPE_OF_LIGHT,
    SQUARE,
    WHITE,
    assert_within_noise,
    cube,
    facing,
    lamp,
    matrix,
    matte,
    picture,
    scene,
)

FLOOR = Shape("floor", SQUARE, matrix(), "grey")
INTENSITY = Spectrum.of([400, 700], [1.0, 2.5], Unit.RADIANCE)
# Not about an axis of the picture, nor of the world.
TURNED = facing((0.3, -0.5, 0.8), (0, 0, 0)) @ np.diag([1, 1, 1, 1.0])


def painted(path, texels=None, turned=TURNED, intensity=INTENSITY):
    """Return an environment with this picture."""
    file = path if texels is None else write_spectra(path, texels, BANDS)
    turned = turned.copy()
    turned[:3, 3] = 0
    return Light("sky", "environment", turned, {"intensity": intensity, "filename": str(file)})


def towards(light, u, v):
    """Return the (3, n) unit vectors of the world that see the picture at u and v, V up."""
    turn, elevation = (0.5 - u) * 2 * np.pi, (v - 0.5) * np.pi
    own = [np.cos(elevation) * np.cos(turn), np.cos(elevation) * np.sin(turn), np.sin(elevation)]
    return light.to_world[:3, :3] @ np.array(own)


def fine(light, texels, times=48):
    """
    Return directions, solid angles [sr] and radiance per intensity on a fine grid, by a way of our own.

    Texels are interpolated by scipy's own interpolation along each axis, the last column before the first.
    """
    height, width, bands = texels.shape
    wide = np.concatenate([texels[:, -1:], texels, texels[:, :1]], axis=1)
    u = (np.arange(width * times) + 0.5) / (width * times)
    v = (np.arange(height * times) + 0.5) / (height * times)
    across = interpolate.interp1d(np.arange(width + 2) - 0.5, wide, axis=1)(u * width)
    down = ((1 - v) * height).clip(0.5, height - 0.5)
    seen = interpolate.interp1d(np.arange(height) + 0.5, across, axis=0)(down)
    us, vs = np.meshgrid(u, v)
    angle = np.cos((vs - 0.5) * np.pi) * 2 * np.pi**2 / us.size
    return towards(light, us.ravel(), vs.ravel()), angle.ravel(), seen.reshape(-1, bands)


def irradiance_on_top(light, texels):
    """Return the irradiance per band of a floor, facing up, under a picture."""
    ways, angle, seen = fine(light, texels)
    return (np.maximum(ways[2], 0) * angle) @ seen * INTENSITY.in_bands(BANDS)


def one_bright(height=6, width=12, row=2, column=4):
    texels = np.zeros((height, width, len(BANDS)))
    texels[row, column] = SHAPE_OF_LIGHT
    return texels


def looking_at(direction, half=1e-4):
    place = -np.asarray(direction, float)
    return Camera("c", "perspective", facing(place, (0, 0, 0)), (-half, half, -half, half))


@pytest.mark.parametrize("place", [(0, 0), (2, 4), (5, 11), (3, 0)])
def test_a_spectral_picture_is_seen_exactly_in_every_band(tmp_path, place):
    texels = np.random.default_rng(0).random((6, 12, len(BANDS))).astype(np.float32)
    light = painted(tmp_path / "sky.exr", texels)
    row, column = place
    way = towards(light, np.array([(column + 0.5) / 12]), np.array([1 - (row + 0.5) / 6]))[:, 0]
    seen = picture(scene([], camera=looking_at(way, 1e-7), environment=light), tmp_path)[0, 0]
    np.testing.assert_allclose(seen, texels[row, column] * INTENSITY.in_bands(BANDS), atol=3e-6)


def test_the_left_of_the_picture_is_behind_and_its_middle_ahead_of_x(tmp_path):
    """As Blender's own environment texture: +X in the middle, +Y a quarter to its left, +Z on top."""
    texels = np.zeros((2, 8, len(BANDS)))
    texels[..., 0] = np.arange(8)
    texels[0, :, 1] = 1
    light = painted(tmp_path / "sky.exr", texels, np.eye(4), Spectrum.constant(1.0, Unit.RADIANCE))
    ways = {(1, 0, 0): 3.5, (0, 1, 0): 1.5, (0, -1, 0): 5.5}
    for way, column in ways.items():
        seen = picture(scene([], camera=looking_at(way, 1e-7), environment=light), tmp_path)[0, 0]
        assert seen[0] == pytest.approx(column, abs=1e-5)
        assert seen[1] == pytest.approx(0.5, abs=1e-5)
    assert picture(scene([], camera=looking_at((0, 0.1, 1)), environment=light), tmp_path)[0, 0, 1] == 1


def test_a_picture_of_colours_is_what_its_colours_promote_to(tmp_path):
    colours = np.array([[[255, 128, 0], [0, 64, 255]]], np.uint8)
    Image.fromarray(colours).save(tmp_path / "sky.png")
    linear = np.where(colours <= 10, colours / 255 / 12.92, ((colours / 255 + 0.055) / 1.055) ** 2.4)
    write_exr(tmp_path / "sky.exr", {}, {name: np.float32(linear[..., k]) for k, name in enumerate("RGB")})
    for file in ("sky.png", "sky.exr"):
        light = painted(tmp_path / file)
        way = towards(light, np.array([0.25]), np.array([0.5]))[:, 0]
        seen = picture(scene([], camera=looking_at(way, 1e-7), environment=light), tmp_path)[0, 0]
        expected = promoted(linear[0, 0]).in_bands(BANDS) * INTENSITY.in_bands(BANDS)
        np.testing.assert_allclose(seen, expected, rtol=1e-5, atol=3e-6)


def test_one_bright_texel_lights_a_floor_as_its_integral_says(tmp_path):
    texels = one_bright()
    light = painted(tmp_path / "sky.exr", texels)
    expected = irradiance_on_top(light, texels) * GREY.in_bands(BANDS) / np.pi
    assert expected.min() > 0

    def lit(seed):
        return scene([FLOOR], environment=light, samples=1024, seed=seed)

    assert_within_noise(lit, tmp_path, expected)


def test_a_picture_and_lamps_add_up(tmp_path):
    texels = np.random.default_rng(1).random((4, 8, len(BANDS))) ** 4
    light = painted(tmp_path / "sky.exr", texels)
    sun = lamp("directional", matrix())
    expected = (irradiance_on_top(light, texels) + SHAPE_OF_LIGHT) * GREY.in_bands(BANDS) / np.pi

    def lit(seed):
        return scene([FLOOR], [sun], environment=light, samples=256, seed=seed)

    assert_within_noise(lit, tmp_path, expected)


@pytest.mark.parametrize("depth", [2, 4])
def test_a_white_convex_body_vanishes_before_an_even_picture(tmp_path, depth):
    body = Shape("body", cube(), matrix(), "white")
    light = painted(tmp_path / "sky.exr", np.ones((3, 5, len(BANDS))))
    camera = Camera("c", "perspective", facing((4, 3, 5), (0, 0, 0)), (-0.5, 0.5, -0.5, 0.5))

    def lit(seed):
        white = [matte("white", WHITE)]
        return scene([body], [], white, camera, depth, 64, (8, 8), seed, environment=light)

    assert_within_noise(lit, tmp_path, INTENSITY.in_bands(BANDS))


def test_looking_for_the_light_pays(tmp_path):
    """A texel as small as the sun's surroundings: without looking for it one path in a thousand finds it."""
    light = painted(tmp_path / "sky.exr", one_bright(32, 64, 8, 20))
    lit = scene([FLOOR], environment=light, samples=64, size=(16, 16))
    seen = picture(lit, tmp_path)[..., 0]
    assert seen.std() < 0.1 * seen.mean()


def test_a_rough_mirror_sees_what_a_fine_grid_of_directions_sees(tmp_path):
    """The glossy lobe finds the bright texel too; both ways together count it once."""
    texels = one_bright() + 0.1
    light = painted(tmp_path / "sky.exr", texels)
    said = {"eta": Spectrum.constant(0.2), "k": Spectrum.constant(3.0), "roughness": 0.3}
    metal = Material("grey", "metal", said)
    ways, angle, seen = fine(light, texels)
    value, _ = evaluate(model_of(metal), direction(0), ways)
    expected = (value * angle[:, None] * seen).sum(axis=0) * INTENSITY.in_bands(BANDS)

    def lit(seed):
        return scene([FLOOR], [], [metal], environment=light, samples=1024, seed=seed)

    assert_within_noise(lit, tmp_path, expected)


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (6, 1), (5, 8)])
def test_directions_are_drawn_with_the_density_that_is_said(tmp_path, shape):
    texels = np.random.default_rng(4).random((*shape, len(BANDS))) ** 6
    if texels.size > 40:
        texels[2] = 0
        texels[3, 4] = 30
    light = painted(tmp_path / "sky.exr", texels)
    skies = Skies(light, Film(bands=BANDS), 0, 1.0)
    n, rows, columns = 200_000, 12, 24
    u, v = np.random.default_rng(5).random((2, n))
    drawn = skies.sample(np.zeros(n, int), np.zeros((3, n)), u, v)
    np.testing.assert_allclose(np.linalg.norm(drawn.directions, axis=0), 1, rtol=1e-12)
    own = light.to_world[:3, :3].T @ drawn.directions
    place = (own[2] + 1) / 2 * rows, np.arctan2(own[1], own[0]) % (2 * np.pi) / (2 * np.pi) * columns
    cell = place[0].clip(0, rows - 1).astype(int) * columns + place[1].clip(0, columns - 1).astype(int)
    # Within a cell even steps of elevation, for at the poles the density per angle has no limit.
    edges = np.arcsin(np.linspace(-1, 1, rows + 1))
    steps = np.diff(edges)[:, None] / 200
    elevation = (edges[:-1, None] + steps * (np.arange(200) + 0.5)).ravel()
    angle = np.cos(elevation) * np.repeat(steps[:, 0], 200) * 2 * np.pi / (columns * 20)
    turn = (np.arange(columns * 20) + 0.5) / (columns * 20) * 2 * np.pi
    level, turn = np.meshgrid(np.cos(elevation), turn, indexing="ij")
    z = np.sin(elevation)[:, None] * np.ones_like(turn)
    ways = light.to_world[:3, :3] @ np.stack([level * np.cos(turn), level * np.sin(turn), z]).reshape(3, -1)
    drawn_there = skies.seen(ways)[1].reshape(len(angle), -1) * angle[:, None] * n
    expected = drawn_there.reshape(rows, 200, columns, 20).sum(axis=(1, 3)).ravel()
    assert expected.sum() == pytest.approx(n, rel=2e-3)
    seen = np.bincount(cell, minlength=rows * columns)
    often = expected > 5
    chi2 = ((seen - expected)[often] ** 2 / expected[often]).sum()
    assert stats.chi2.sf(chi2, often.sum() - 1) > 1e-3


def test_a_native_scene_names_its_sky_from_where_it_lies(tmp_path):
    light = painted(tmp_path / "sky.exr", one_bright())
    here, there = tmp_path / "here", tmp_path / "elsewhere"
    native = find("tracer").translate(scene([], environment=light), (), here / "scenes", "scene")
    assert json.loads(native.read_text())["environment"]["parameters"]["filename"] == "../../sky.exr"
    shutil.copytree(here, there)
    pictures = [
        find("tracer").render(path, RenderOptions(), lambda fraction: None).radiance
        for path in (native, there / "scenes" / "scene.json")
    ]
    np.testing.assert_array_equal(*pictures)
