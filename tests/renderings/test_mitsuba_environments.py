"""Pictures around a scene: every direction where it belongs, in every band, found where it is bright."""

from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from rtb_addon.errors import RecipeError, RenderingError
from rtb_addon.renderers.mitsuba import llvm, renderer, session
from rtb_addon.renderers.pictures import read_picture, sky_gamma
from rtb_addon.scene.render_scene import Camera, Light
from rtb_addon.spectra import Spectrum
from tests.renderings.mitsuba_scenes import (
    BANDS,
    INTENSITY,
    REFLECTANCE,
    assert_within_noise,
    kernels,
    picture,
    scene,
)
from tests.renderings.noise import CHANCE, in_blocks, least_probability
from tests.renderings.spectral_pictures import write_spectra

RANDOM = np.random.default_rng(11)
PAINTED = REFLECTANCE.in_bands(BANDS) * INTENSITY.in_bands(BANDS)
COLOURS = RANDOM.integers(0, 256, (4, 8, 3), dtype=np.uint8)
SPECTRA = RANDOM.random((5, 7, len(BANDS))).astype(np.float32)
# Tilted and turned about all axes.
TURN = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
TURN = TURN * np.sign(np.linalg.det(TURN))


@pytest.fixture
def coloured(tmp_path):
    Image.fromarray(COLOURS).save(tmp_path / "colours.png")
    return tmp_path / "colours.png"


@pytest.fixture
def spectral(tmp_path):
    return write_spectra(tmp_path / "spectra.exr", SPECTRA, BANDS)


def sky(path, intensity=INTENSITY, turn=None):
    matrix = np.eye(4)
    matrix[:3, :3] = np.eye(3) if turn is None else turn
    return Light("Sky", "environment", matrix, {"intensity": intensity, "filename": str(path)})


def towards(direction):
    """Return a camera that sees nearly one direction."""
    z = -np.array(direction) / np.linalg.norm(direction)
    x = np.cross(np.eye(3)[np.abs(z).argmin()], z)
    x /= np.linalg.norm(x)
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([x, np.cross(z, x), z], axis=1)
    return Camera("Camera", "perspective", matrix, (-1e-4, 1e-4, -1e-4, 1e-4))


def shown(path, directions):
    """Return the (directions, bands) radiance that a picture has in unit directions of its own frame."""
    found = read_picture(path, sky_gamma(path))
    texels = found.texels.astype(float) @ found.weights(BANDS, "averaged")
    height, width = texels.shape[:2]
    x, y, z = np.array(directions).T
    across = (0.5 - np.arctan2(y, x) / (2 * np.pi)) * width - 0.5
    down = (0.5 - np.arctan2(z, np.hypot(x, y)) / np.pi) * height - 0.5
    column, row = np.floor(across).astype(int), np.floor(down).astype(int)
    total = 0
    for k, along in ((column, 1 - across + column), (column + 1, across - column)):
        for j, deep in ((row, 1 - down + row), (row + 1, down - row)):
            total = total + texels[j.clip(0, height - 1), k % width] * (along * deep)[:, None]
    return total


def everywhere(count=400):
    """Return (count, count, 3) directions evenly over the sphere, at the middles of cells of equal size."""
    z = np.linspace(1, -1, count + 1)
    z, turn = np.meshgrid((z[1:] + z[:-1]) / 2, (np.arange(count) + 0.5) / count * 2 * np.pi, indexing="ij")
    return np.stack([np.sqrt(1 - z**2) * np.cos(turn), np.sqrt(1 - z**2) * np.sin(turn), z], axis=-1)


DIRECTIONS = {
    "ahead": (1, 0.01, 0),
    "behind": (-1, 1e-3, 0.1),
    "left": (0.1, 1, -0.4),
    "up": (0.03, -0.02, 1),
    "down": (-0.2, -0.3, -1),
}


@pytest.mark.parametrize("kind", ["coloured", "spectral"])
@pytest.mark.parametrize("turn", [None, TURN], ids=["upright", "turned"])
def test_every_direction_shows_its_place_in_the_picture(tmp_path, kind, turn, request):
    path = request.getfixturevalue(kind)
    for name, direction in DIRECTIONS.items():
        seen = scene(shapes=(), environment=sky(path, turn=turn), camera=towards(direction), size=(1, 1))
        local = np.array(direction) @ (np.eye(3) if turn is None else turn)
        expected = shown(path, [local / np.linalg.norm(local)])[0] * INTENSITY.in_bands(BANDS)
        found = picture(seen, tmp_path).radiance[0, 0]
        np.testing.assert_allclose(found, expected, rtol=2e-3, err_msg=name)


def test_a_multispectral_sky_is_exact_in_every_band(tmp_path, spectral):
    one = sky(spectral, Spectrum.constant(1.0))
    # The middle of the texel in row 1, column 2 of 5 x 7.
    turn, height = 2 * np.pi * (0.5 - 2.5 / 7), np.pi * (0.5 - 1.5 / 5)
    middle = np.cos(height) * np.cos(turn), np.cos(height) * np.sin(turn), np.sin(height)
    camera = replace(towards(middle), window=(-1e-6, 1e-6, -1e-6, 1e-6))
    found = picture(scene(shapes=(), environment=one, camera=camera, size=(1, 1)), tmp_path).radiance[0, 0]
    np.testing.assert_allclose(found, SPECTRA[1, 2], rtol=1e-4)


@pytest.mark.parametrize("grey", [0, 1])
def test_in_a_sky_of_one_colour_paint_shows_its_reflectance(tmp_path, grey):
    if grey:
        path = write_spectra(tmp_path / "even.exr", np.full((3, 4, len(BANDS)), 0.7), BANDS)
        radiance = 0.7
    else:
        path = tmp_path / "even.png"
        Image.new("RGB", (6, 3), (188, 188, 188)).save(path)
        radiance = ((188 / 255 + 0.055) / 1.055) ** 2.4
    image = picture(scene(environment=sky(path), samples=256), tmp_path)
    assert_within_noise(image, radiance * PAINTED)


def irradiance(path, up, count=1200):
    """Return what falls on a plane whose normal is a direction of the picture's own frame, by quadrature."""
    ways = everywhere(count).reshape(-1, 3)
    cosines = np.maximum(ways @ np.array(up), 0)
    lit = cosines > 0
    return cosines[lit] @ shown(path, ways[lit]) * 4 * np.pi / count**2


def one_bright(path, at=(2, 9), size=(16, 32)):
    """Write a dim sky of one spectrum with one texel that is 10 000 times as bright in another."""
    texels = np.full((*size, len(BANDS)), 0.01, np.float32) * np.linspace(1, 2, len(BANDS), dtype=np.float32)
    texels[at] = 100 * np.linspace(3, 1, len(BANDS), dtype=np.float32)
    return write_spectra(path, texels, BANDS)


@pytest.mark.parametrize("turn", [None, TURN.T], ids=["upright", "turned"])
def test_one_bright_texel_lights_a_plane_as_the_integral_says_and_is_found(tmp_path, turn):
    path = one_bright(tmp_path / "sun.exr")
    upright = np.eye(3) if turn is None else turn
    expected = (
        irradiance(path, upright[2]) / np.pi * (REFLECTANCE.in_bands(BANDS) * INTENSITY.in_bands(BANDS))
    )
    image = picture(scene(environment=sky(path, turn=turn), samples=256), tmp_path)
    # The quadrature's own error is below a thousandth.
    assert_within_noise(image, expected, floor=1e-3)
    # 4 x 4 pixels of 256 samples: blind directions would be wrong by some 60 per cent.
    pixels = image.radiance.reshape(16, -1)
    assert (pixels.std(axis=0) < 0.05 * pixels.mean(axis=0)).all()


def test_directions_are_drawn_as_densely_as_they_say(tmp_path):
    llvm.prepare()
    mi = session.start(session.FAST, 1)
    from rtb_addon.renderers.mitsuba.sky_sampling import SkySampling

    sampling = SkySampling(RANDOM.random((5, 12)) ** 4)
    ways = everywhere(300).reshape(-1, 3)
    density = np.array(sampling.density(mi.Vector3f(ways.T.astype(np.float32))))
    assert density.mean() * 4 * np.pi == pytest.approx(1, abs=2e-3)
    count = 2**18
    drawn, said = sampling.sample(mi.Point2f(RANDOM.random((2, count)).astype(np.float32)))
    np.testing.assert_allclose(np.linalg.norm(np.array(drawn), axis=0), 1, rtol=1e-5)
    again = np.array(sampling.density(drawn))
    # On the edge between two texels either may be taken.
    assert (np.isclose(again, np.array(said), rtol=1e-4)).mean() > 0.9999
    # The mean of 1 over the density is the area of the sphere, of any part of it as well.
    x, y, z = np.array(drawn)
    for part, area in ((z > 0.3, 1.4 * np.pi), (x > y, 2 * np.pi), ((z < -0.9), 0.2 * np.pi)):
        values = np.where(part, 1 / np.array(said), 0)
        assert abs(values.mean() - area) < 4.5 * values.std() / np.sqrt(count)


def test_stock_mitsubas_spectral_film_shows_the_same_with_our_plugin(tmp_path, spectral):
    lit = scene(environment=sky(spectral, turn=TURN), samples=256, kind="centre", size=(4, 4))
    native = renderer().translate(lit, (), tmp_path, "scene")
    assert "Sky needs a plugin of ours" in native.read_text()
    seeds = [replace(lit, integrator=replace(lit.integrator, seed=seed)) for seed in range(6)]
    ours = np.stack([in_blocks(picture(one, tmp_path).radiance, 4) for one in seeds])
    mi = session.start("llvm_ad_spectral", 1)
    loaded = mi.load_file(str(native))
    theirs = [in_blocks(np.array(mi.render(loaded, spp=2048, seed=seed)), 4) for seed in range(50, 60)]
    assert least_probability(ours, np.stack(theirs)) > CHANCE


def test_another_sky_of_about_that_size_recompiles_nothing(tmp_path, spectral):
    picture(scene(environment=sky(spectral)), tmp_path)
    other = write_spectra(tmp_path / "other.exr", RANDOM.random((8, 8, 16)), BANDS)
    changed = scene(environment=sky(other, REFLECTANCE, TURN))
    ran, compiled = kernels(changed, tmp_path, "other")
    assert (ran > 0, compiled) == (True, 0)


def test_a_sky_that_is_scaled_to_nothing_is_refused(tmp_path, spectral):
    with pytest.raises(RecipeError, match="scaled to nothing"):
        picture(scene(environment=sky(spectral, turn=np.diag([1.0, 0, 1]))), tmp_path)


def test_without_llvm_a_picture_of_the_sky_is_refused(tmp_path, spectral, monkeypatch):
    monkeypatch.setattr(llvm, "prepare", lambda: None)
    with pytest.raises(RenderingError, match="cannot render the picture Sky around the scene"):
        picture(scene(environment=sky(spectral)), tmp_path)
