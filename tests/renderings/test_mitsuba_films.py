"""Mitsuba's films and lenses against closed forms: filters, crops, blur discs, means of bands."""

from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.renderers.filters import filter_of
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import renderer, session
from rtb_addon.scene.render_scene import Crop, Shape
from tests.renderings.film_scenes import GLOW, edge_spread, framed, from_above, half_plane, lit_floor
from tests.renderings.mitsuba_scenes import DOWN, FULL_TURN, INTENSITY, at, disc, square
from tests.renderings.noise import CHANCE, least_probability


def picture(one, folder, name="scene"):
    """A picture with its standard errors."""
    native = renderer().translate(one, (), folder, name)
    return renderer().render(native, RenderOptions(errors=True), lambda fraction: None)


@pytest.mark.parametrize("name", ["gaussian", "mitchell", "lanczos"])
def test_stock_mitsuba_with_the_same_filter_shows_the_same_within_noise(tmp_path, name):
    one = half_plane(name, 256)
    ours = np.stack(
        [
            picture(replace(one, integrator=replace(one.integrator, seed=seed)), tmp_path).radiance
            for seed in range(6)
        ]
    )
    mi = session.start("llvm_ad_spectral", 1)
    stock = mi.load_file(str(tmp_path / "scene.xml"))
    theirs = np.stack([np.array(mi.render(stock, spp=256, seed=seed)) for seed in range(6)])
    # Rows are alike; in columns away from the edge nothing is left to chance.
    ours, theirs = (images.mean(axis=1, dtype=float).sum(axis=2) for images in (ours, theirs))
    busy = (edge_spread(name) > 2e-3) & (np.abs(edge_spread(name) - 1) > 2e-3)
    assert least_probability(ours[:, busy, None], theirs[:, busy, None]) > CHANCE


def test_filters_that_are_negative_somewhere_keep_their_gain():
    for name in ("mitchell", "catmullrom", "lanczos"):
        one = filter_of(name)
        middles = (one.places[1:] + one.places[:-1]) / 2
        signs = np.where((np.abs(middles)[:, None] > np.array(one.zeros)).sum(axis=1) % 2, -1, 1)
        # So much of all paths counts negatively that the rest, at its gain, is one.
        assert abs(one.gain * signs.mean() - 1) < 2e-3, name


def test_stock_mitsuba_sees_the_same_crop(tmp_path):
    one = lit_floor(crop=Crop(13, 4, 8, 6))
    ours = picture(one, tmp_path).radiance
    mi = session.start("llvm_ad_spectral", 1)
    theirs = np.array(mi.render(mi.load_file(str(tmp_path / "scene.xml")), spp=1024))
    assert theirs.shape == ours.shape
    np.testing.assert_allclose(theirs.sum(axis=2), ours.sum(axis=2), rtol=0.1)


RADIUS, FOCUS, DEPTH, SPOT = 0.2, 4.0, 2.0, 0.02


def test_a_small_light_out_of_focus_is_an_even_disc(tmp_path):
    small = Shape("Spot", disc(SPOT), DOWN, "soot", GLOW)
    blur = RADIUS * abs(1 / FOCUS - 1 / DEPTH)
    half = 1.5 * blur
    camera = from_above(half, lens_radius=RADIUS, focus_distance=FOCUS)
    image = picture(framed(camera, [small], (24, 24), 4096), tmp_path)
    middles = (np.arange(24) + 0.5) / 24 * 2 * half - half
    distance = np.hypot(*np.meshgrid(middles, middles))
    pixel, spot = 2 * half / 24, SPOT / DEPTH
    # Through how much of the lens the light is seen from where its image is whole.
    expected = 2 * (SPOT / (RADIUS * (1 - DEPTH / FOCUS))) ** 2
    inside, outside = distance < blur - spot - pixel, distance > blur + spot + pixel
    mean = image.radiance[inside].mean(dtype=float)
    error = np.sqrt((image.standard_error[inside].mean(axis=1) ** 2).mean() / inside.sum())
    assert abs(mean - expected) < 4.5 * error + 1e-3 * expected
    assert error < 0.01 * expected
    spread = (image.radiance[inside, 0] - expected) / np.sqrt((image.standard_error[inside, 0] ** 2).mean())
    assert np.sqrt(np.mean(spread**2)) < 1.3
    assert not image.radiance[outside].any()
    whole = image.radiance.mean(axis=2, dtype=float).sum() * pixel**2
    assert abs(whole - 2 * np.pi * spot**2) < 0.01 * whole


WINDOWS = {
    "in the middle": (-0.3, 0.3, -0.3, 0.3),
    "shifted": (-0.1, 0.5, -0.45, 0.15),
    "of pixels that are not square": (-0.2, 0.4, -0.3, 0.6),
}


@pytest.mark.parametrize("window", WINDOWS)
def test_what_is_in_focus_is_as_sharp_as_through_a_pinhole(tmp_path, window):
    shapes = [Shape("Bright", square(0.35), at(0.25, 0.1, 0), "soot", GLOW)]
    lens = {"lens_radius": 0.3, "focus_distance": 2.0}
    images = [
        picture(framed(from_above(window=WINDOWS[window], **how), shapes, (20, 20), 256), tmp_path)
        for how in ({}, lens)
    ]
    assert 0.2 < (images[0].radiance > 0).mean() < 0.9
    # A path at the very edge may fall on either side of it.
    np.testing.assert_allclose(images[0].radiance, images[1].radiance, atol=2 * 2 / 256)


def test_a_lens_that_is_shifted_is_said_to_be_beyond_stock_mitsuba(tmp_path):
    camera = from_above(window=WINDOWS["shifted"], lens_radius=0.1)
    native = renderer().translate(framed(camera, [], (4, 4)), (), tmp_path, "scene")
    assert "looks past the middle" in native.read_text()


def test_a_camera_from_below_sees_a_lens_the_same_way(tmp_path):
    """The focus plane lies along the view axis, wherever the camera looks."""
    lens = {"lens_radius": 0.3, "focus_distance": 3.0}
    below = from_above(0.3, at(0, 0, -3, FULL_TURN), **lens)
    shape = Shape("Bright", square(0.35), at(0.2, 0.1, 0, FULL_TURN), "soot", INTENSITY)
    pinhole = from_above(0.3, at(0, 0, -3, FULL_TURN))
    images = [
        picture(framed(camera, [shape], (12, 12), 64), tmp_path).radiance for camera in (below, pinhole)
    ]
    assert images[1].any()
    np.testing.assert_allclose(images[0], images[1], atol=3 * 2 / 64)
