"""Spectra to XYZ to sRGB: RenderToolbox3's stored numbers, colour-science, and the edges."""

import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

from rtb_addon.colorimetry import (
    brightest_scale,
    encoded,
    linear_srgb,
    luminance_limited,
    srgb8,
    tone_mapped,
    xyz,
)
from rtb_addon.errors import RenderingError
from rtb_addon.observers import matching_functions
from rtb_addon.spectra import DEFAULT_BANDS, Bands, library
from rtb_addon.spectral_image import SpectralImage

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import colour

ROOT = Path(__file__).resolve().parents[2]
# D65 with two decimals, 400 to 700 nm in steps of 10, as RenderToolbox3's D65.spd has it.
ROUNDED_D65 = [
    82.75,
    91.49,
    93.43,
    86.68,
    104.86,
    117.01,
    117.81,
    114.86,
    115.92,
    108.81,
    109.35,
    107.8,
    104.79,
    107.69,
    104.41,
    104.05,
    100,
    96.33,
    95.79,
    88.69,
    90.01,
    89.6,
    87.7,
    83.29,
    83.7,
    80.03,
    80.21,
    82.28,
    78.28,
    69.72,
    71.61,
]


def pixel(spectrum, bands=DEFAULT_BANDS):
    return SpectralImage(np.asarray(spectrum, np.float32).reshape(1, 1, -1), bands)


def test_a_flat_unit_spectrum_has_the_known_numbers():
    flat = xyz(pixel(np.ones(31)))[0, 0]
    np.testing.assert_allclose(flat, [72852.80, 72954.56, 72742.23], rtol=1e-7)
    np.testing.assert_allclose(linear_srgb(flat), [87686.31, 69279.90, 66056.42], rtol=1e-7)
    # The constant that RenderToolbox3 stored for the red channel.
    assert linear_srgb(flat)[0] == pytest.approx(87686.4294998, rel=2e-6)


def test_d65_as_radiance_has_the_known_numbers():
    x, y, z = xyz(pixel(ROUNDED_D65))[0, 0]
    np.testing.assert_allclose([x, y, z], [6850907, 7216031, 7844278], rtol=1e-7)
    ours = xyz(pixel(library.find("D65").at(DEFAULT_BANDS.centres)))[0, 0]
    np.testing.assert_allclose(ours, [x, y, z], rtol=2e-5)
    assert x / (x + y + z) == pytest.approx(0.31267, abs=5e-6)
    assert y / (x + y + z) == pytest.approx(0.32933, abs=5e-6)


def test_xyz_agrees_with_colour_science():
    spectra = np.random.default_rng(3).random((4, 5, 31)).astype(np.float32)
    spectra[0, 0] = 1
    shape = colour.SpectralShape(400, 700, 10)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        theirs = colour.msds_to_XYZ(spectra, method="Integration", shape=shape, k=683)
    # Its releases differ by a factor of 100: compare relative to the flat spectrum.
    ours = xyz(SpectralImage(spectra, DEFAULT_BANDS))
    np.testing.assert_allclose(ours / ours[0, 0, 1], theirs / theirs[0, 0, 1], rtol=1e-6)


def test_linear_srgb_agrees_with_colour_science_to_its_four_decimals():
    tristimulus = np.random.default_rng(4).random((7, 3))
    theirs = colour.XYZ_to_sRGB(tristimulus, apply_cctf_encoding=False)
    np.testing.assert_allclose(linear_srgb(tristimulus), theirs, atol=1e-3)


def test_the_curve_agrees_with_colour_science_to_a_grey_level():
    linear = np.linspace(-0.2, 1.2, 5001)
    theirs = np.round(255 * colour.cctf_encoding(np.clip(linear, 0, 1), function="sRGB"))
    ours = encoded(linear)
    assert ours.dtype == np.uint8
    assert abs(ours.astype(float) - theirs).max() <= 1
    assert (ours == theirs).mean() > 0.999
    assert (ours[0], ours[-1]) == (0, 255)


def test_the_colour_checkers_patches_look_as_they_are_known_to():
    light = library.find("D65").at(DEFAULT_BANDS.centres)
    white = xyz(pixel(light))[0, 0, 1]
    # sRGB of RenderToolbox3's own measurement of the chart, which differs from this one by 1-2 %.
    known = {1: (115, 82, 67), 4: (245, 245, 240), 11: (175, 48, 56), 16: (120, 121, 121), 19: (187, 84, 150)}
    for number, expected in known.items():
        patch = library.served(f"mccBabel-{number}.spd").at(DEFAULT_BANDS.centres)
        ours = srgb8(xyz(pixel(patch * light)), scale=1 / white)[0, 0]
        np.testing.assert_allclose(ours, expected, atol=4)


def test_a_band_counts_by_its_width():
    fine = Bands.regular(397.5, 5, 62)  # the same 395 to 705 nm in halves
    np.testing.assert_allclose(
        xyz(pixel(np.ones(62), fine)), xyz(pixel(np.ones(31))), rtol=3e-3
    )  # matching functions are curved
    uneven = Bands(np.array([500.0, 560]), np.array([490.0, 515, 600]))
    per_band = 683 * matching_functions(uneven) * [[25], [85]]
    np.testing.assert_allclose(xyz(pixel([2, 3], uneven))[0, 0], per_band.T @ [2, 3], rtol=1e-12)


def test_bands_that_nobody_sees_add_nothing():
    infrared = Bands.regular(900, 10, 31)
    assert xyz(pixel(np.ones(31), infrared)).tolist() == [[[0, 0, 0]]]


def test_tone_mapping_limits_luminance_and_keeps_chromaticity():
    picture = np.array([[[1, 2, 3], [0.1, 0.2, 0.1], [0, 0, 0], [50, 100, 10]]], float)
    mapped = tone_mapped(picture, 2)
    limit = 2 * picture[..., 1].mean()
    np.testing.assert_array_equal(mapped[0, :3], picture[0, :3])
    assert mapped[0, 3, 1] == pytest.approx(limit)
    np.testing.assert_allclose(mapped[0, 3] / limit, picture[0, 3] / 100)
    np.testing.assert_array_equal(tone_mapped(picture, 0), picture)
    assert luminance_limited(picture, 0.5)[..., 1].max() == 0.5


def test_the_scale_makes_the_brightest_channel_one():
    picture = np.array([[[0.2, 0.3, 0.1], [2, 3, 1]]], float)
    pixels = srgb8(picture)
    assert pixels.max() == 255
    assert brightest_scale(linear_srgb(picture)) == pytest.approx(1 / linear_srgb(picture).max())
    np.testing.assert_array_equal(srgb8(picture * 17), pixels)
    np.testing.assert_array_equal(srgb8(picture / 100, scale=1), encoded(linear_srgb(picture / 100)))


def test_a_black_picture_stays_black_without_a_word():
    black = xyz(SpectralImage(np.zeros((2, 2, 31), np.float32), DEFAULT_BANDS))
    assert srgb8(tone_mapped(black, 10)).tolist() == np.zeros((2, 2, 3)).tolist()


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
def test_numbers_that_are_none_are_not_shown(wrong):
    with pytest.raises(RenderingError, match="no finite numbers"):
        xyz(pixel([wrong] + [1] * 30))


def test_colours_need_no_colour_science():
    heavy = "{'colour', 'scipy', 'PIL', 'OpenEXR'}"
    program = f"import sys, rtb_addon.montage; print(sorted({heavy} & set(sys.modules)))"
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True, cwd=ROOT
    )
    assert done.stdout.strip() == "[]"
