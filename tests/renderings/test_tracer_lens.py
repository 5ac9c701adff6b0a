"""The tracer's thin lens against closed forms: what is sharp, and how wide the rest is blurred."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from rtb_addon.errors import RecipeError
from rtb_addon.renderers.tracer.directions import disc
from rtb_addon.scene.render_scene import Camera, Shape
from rtb_addon.spectra import Unit
from tests.renderings.tracer_scenes import SHAPE_OF_LIGHT, SQUARE, matrix, matte, per_band, picture, scene

RADIANCE = per_band(SHAPE_OF_LIGHT, Unit.RADIANCE)


def view(half, radius, focus, **more):
    return Camera(
        "c", "perspective", matrix(), (-half, half, -half, half), (1e-3, 1e5), radius, focus, **more
    )


def glowing(camera, distance, half=1.0, size=(8, 8), place=(0, 0), **options):
    """Return a picture's scene: a luminous square across the view, so far away."""
    glow = Shape("glow", SQUARE, matrix((*place, -distance), (half, 0, 0), (0, half, 0)), "black", RADIANCE)
    return scene([glow], [], [matte("black", per_band([0.0] * 4))], camera, size=size, **options)


def test_what_lies_in_the_plane_of_focus_is_as_sharp_as_through_a_pinhole(tmp_path):
    """Columns 1 to 4 and rows 3 to 6 of eight, to the last sample."""
    camera = replace(view(1.0, 0.3, 4.0), window=(-0.75 / 2, 1.25 / 2, -0.75 / 2, 1.25 / 2))
    seen = picture(glowing(camera, 4.0, half=1.0, samples=16), tmp_path)[..., 0] / SHAPE_OF_LIGHT[0]
    expected = np.zeros((8, 8))
    expected[3:7, 1:5] = 1
    np.testing.assert_allclose(seen, expected, atol=1e-6)


@pytest.mark.parametrize(("focus", "distance"), [(2.0, 5.0), (5.0, 2.0)])
def test_a_small_light_out_of_focus_is_an_even_disc(tmp_path, focus, distance):
    """
    A light at distance d, focus at f, through a lens of radius r: a disc r |1/f - 1/d| wide one metre ahead.

    Its light is that of the pinhole's picture, spread over the disc.
    """
    radius, image = 0.1, 0.004
    blur, half = radius * abs(1 / focus - 1 / distance), image * distance
    camera = view(2 * blur, radius, focus)
    n = 32
    runs = np.array(
        [
            picture(glowing(camera, distance, half, (n, n), samples=128, seed=seed), tmp_path)[..., 0]
            for seed in range(8)
        ]
    )
    middles = ((np.arange(n) + 0.5) / n * 2 - 1) * 2 * blur
    r = np.hypot(*np.meshgrid(middles, middles))
    pixel = np.hypot(1, 1) * 2 * blur / n
    inside, outside = r < blur - 2 * image - pixel, r > blur + 2 * image + pixel
    even = SHAPE_OF_LIGHT[0] * (2 * image) ** 2 / (np.pi * blur**2)
    assert not runs[:, outside].any()
    # The seeds' means tell how far they may be off.
    halves = [runs[:, half].mean(axis=1) for half in (r < blur / 2, inside & (r >= blur / 2))]
    whole = runs.mean(axis=(1, 2)) * (4 * blur) ** 2 / (np.pi * blur**2)
    for means in (*halves, whole):
        assert abs(means.mean() - even) < 4 * means.std(ddof=1) / np.sqrt(8) + 1e-3 * even
        assert means.std(ddof=1) < 0.1 * even, "too noisy to tell"


def test_a_lens_without_width_is_a_pinhole(tmp_path):
    pinhole, lens = (
        picture(glowing(view(0.3, radius, 1.0), 5.0, samples=4, size=(16, 16)), tmp_path)
        for radius in (0.0, 1e-9)
    )
    np.testing.assert_allclose(lens, pinhole, atol=1e-5)


def test_a_shifted_lens_blurs_alike_and_elsewhere(tmp_path):
    """The window is shifted: the same disc, so many pixels aside."""
    plain = view(0.1, 0.1, 2.0)
    shifted = replace(plain, window=(-0.05, 0.15, -0.1, 0.1))
    one, other = (
        picture(glowing(camera, 5.0, 0.05, (16, 16), samples=512), tmp_path) for camera in (plain, shifted)
    )
    # Both are means of 512 samples; of the disc's pixels that lie whole in it at least.
    assert np.corrcoef(one[:, 4:, 0].ravel(), other[:, :-4, 0].ravel())[0, 1] > 0.97


def test_points_on_the_disc_are_even():
    u, v = np.random.default_rng(0).random((2, 100_000))
    x, y, z = disc(u, v)
    assert not z.any()
    radius, turn = x**2 + y**2, np.arctan2(y, x) % (2 * np.pi)
    assert radius.max() <= 1
    cells = np.floor(radius.clip(0, 1 - 1e-12) * 10) * 16 + np.floor(turn / (2 * np.pi) * 16)
    assert stats.chisquare(np.bincount(cells.astype(int), minlength=160)).pvalue > 1e-3


def test_a_lens_that_cannot_be_is_refused(tmp_path):
    with pytest.raises(RecipeError, match="camera c has focus_distance"):
        picture(glowing(view(0.1, 0.1, 0.0), 5.0), tmp_path)
