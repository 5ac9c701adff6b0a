"""Mitsuba's films and lenses against closed forms: filters, crops, blur discs, means of bands."""

from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.renderers.filters import FILTERS, filter_of
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import renderer, session
from rtb_addon.scene.render_scene import Camera, Crop, Shape
from rtb_addon.spectra import Bands, Spectrum
from tests.renderings.mitsuba_scenes import DOWN, FULL_TURN, INTENSITY, at, disc, lamp, scene, square
from tests.renderings.noise import CHANCE, least_probability

BANDS = Bands.regular(450, 100, 3)
GLOW = Spectrum.constant(2.0)


def picture(one, folder, name="scene"):
    """A picture with its standard errors."""
    native = renderer().translate(one, (), folder, name)
    return renderer().render(native, RenderOptions(errors=True), lambda fraction: None)


def framed(camera, shapes, size, samples=1024, lights=(), **film):
    one = scene(lights, shapes, camera=camera, bands=BANDS, samples=samples, size=size)
    return replace(one, film=replace(one.film, **film))


def from_above(half=0.0, to_world=None, window=None, **lens):
    window = window or (-half, half, -half, half)
    return Camera("Camera", "perspective", at(0, 0, 2) if to_world is None else to_world, window, **lens)


EDGE = 0.3  # of a pixel to the right of the middle of the picture


def half_plane(name, samples=1024):
    """Sixteen pixels across a plane that shines to the right of an edge, each a unit wide."""
    camera = Camera("Camera", "orthographic", at(0, 0, 2), (-8.0, 8.0, -4.0, 4.0))
    bright = Shape("Bright", square(20), at(20 + EDGE, 0, 0), "soot", GLOW)
    return framed(camera, [bright], (16, 8), samples, filter=name)


def edge_spread(name):
    """Return what part of a filter lies beyond the edge, for each column of pixels."""
    evaluate, radius, _ = FILTERS[name]
    x = np.linspace(-radius, radius, 200_001)
    heights = evaluate(x)
    sums = np.cumsum(heights) / heights.sum()
    return 1 - np.interp(EDGE - (np.arange(16) - 7.5), x, sums, left=0.0, right=1.0)


@pytest.mark.parametrize("name", FILTERS)
def test_an_edge_is_spread_as_the_filters_integral(tmp_path, name):
    image = picture(half_plane(name), tmp_path)
    rows = image.radiance[:, :, 0].astype(float)
    error = np.sqrt((image.standard_error[:, :, 0].astype(float) ** 2).mean(axis=0) / len(rows))
    away = rows.mean(axis=0) - 2 * edge_spread(name)
    # Eight rows of sixteen rounds each tell their error to a sixteenth.
    assert (np.abs(away) <= 4.5 * 1.2 * error + 2e-4).all(), away
    # A tolerance that noise has blown up would prove nothing.
    assert error.max() < 0.02


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


def lit_floor(**film):
    floor = Shape("Floor", square(5), DOWN, "paint")
    lights = [lamp("point", at(0.4, -0.3, 1), radius=0.0)]
    return framed(from_above(window=(-0.6, 0.6, -0.4, 0.4)), [floor], (24, 16), 1024, lights, **film)


def test_a_crop_is_that_part_of_the_whole_picture(tmp_path):
    part = Crop(13, 4, 8, 6)
    whole, cut = picture(lit_floor(), tmp_path, "whole"), picture(lit_floor(crop=part), tmp_path, "cut")
    assert cut.radiance.shape == (6, 8, 3)
    there = np.s_[part.top : part.top + part.height, part.left : part.left + part.width]
    error = np.hypot(whole.standard_error[there], cut.standard_error)
    away = np.abs(cut.radiance - whole.radiance[there])
    assert (away < 6 * error + 1e-6).all()
    # Its neighbours are another part.
    beside = whole.radiance[part.top : part.top + part.height, part.left + 1 : part.left + part.width + 1]
    assert np.median(np.abs(cut.radiance - beside) / error) > 10


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


# Both go up and down twice in each band, together: the mean of the product is more than that of the means.
KNOTS = np.arange(400.0, 481.0, 5.0)
SPIKY = Spectrum(KNOTS, np.where(np.arange(len(KNOTS)) % 2, 0.9, 0.1))
SPIKY_LIGHT = Spectrum(KNOTS, np.where(np.arange(len(KNOTS)) % 2, 3.0, 1.0))
WIDE = Bands.regular(410, 20, 4)


def test_the_mean_of_a_band_is_that_of_the_product_of_spectra(tmp_path):
    # A hundred paths take each tenth of a band ten times.
    one = scene([lamp("point", radius=0.0, intensity=SPIKY_LIGHT)], reflectance=SPIKY, samples=100)
    one = replace(one, film=replace(one.film, bands=WIDE, band_kind="mean"))
    native = renderer().translate(one, (), tmp_path, "scene")
    image = renderer().render(native, RenderOptions(), lambda fraction: None)
    assert image.band_kind == "mean"
    found = image.radiance.mean(axis=(0, 1), dtype=float) * 9 * np.pi
    # The product of lines from 0.1 to 0.9 and from 1 to 3 has the mean (2 a c + a d + b c + 2 b d) / 6.
    truth = (2 * 0.1 * 1 + 0.1 * 3 + 0.9 * 1 + 2 * 0.9 * 3) / 6
    # Within a tenth of a band, 2 nm, lines rise by so much; a knot in its middle takes half of that away.
    rise = (0.8 / 5 * 2) * (2.0 / 5 * 2) / 12
    assert (found < truth + 1e-5).all()
    assert (found > truth - rise - 1e-5).all()
    averaged = replace(one, film=replace(one.film, band_kind="averaged"))
    native = renderer().translate(averaged, (), tmp_path, "averaged")
    of_means = renderer().render(native, RenderOptions(), lambda fraction: None).radiance * 9 * np.pi
    np.testing.assert_allclose(of_means, 0.5 * 2.0, rtol=2e-5)
    assert (truth - of_means > 6 * rise).all()


def test_any_number_of_samples_gives_the_mean_of_a_band_without_a_bias(tmp_path):
    # Seven paths cannot take ten parts evenly, but many pixels can.
    one = scene(
        [lamp("point", radius=0.0, intensity=SPIKY_LIGHT)], reflectance=SPIKY, samples=7, size=(64, 64)
    )
    one = replace(one, film=replace(one.film, bands=WIDE, band_kind="mean"))
    native = renderer().translate(one, (), tmp_path, "scene")
    pixels = renderer().render(native, RenderOptions(), lambda fraction: None).radiance.reshape(-1, 4)
    parts = [spectrum.in_bands(Bands.regular(401, 2, 40)).reshape(4, 10) for spectrum in (SPIKY, SPIKY_LIGHT)]
    expected = (parts[0] * parts[1]).mean(axis=1) / (9 * np.pi)
    error = pixels.std(axis=0, ddof=1) / np.sqrt(len(pixels))
    assert (np.abs(pixels.mean(axis=0, dtype=float) - expected) < 4.5 * error + 1e-5).all()
    assert (error < 0.01 * expected).all()


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
