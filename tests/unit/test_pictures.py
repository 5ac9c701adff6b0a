"""Pictures of reflectances: files of colours and of spectra, and what they come to in each band."""

import numpy as np
import pytest
from PIL import Image

from rtb_addon.errors import RecipeError
from rtb_addon.exr import write_exr
from rtb_addon.renderers.pictures import read_picture
from rtb_addon.spectra import Bands, Spectrum
from rtb_addon.spectra.promotion import promoted

BANDS = Bands.regular(400, 10, 31)
RANDOM = np.random.default_rng(3)


def in_bands(picture, bands=BANDS, kind="averaged"):
    return picture.texels @ picture.weights(bands, kind)


def test_a_texel_of_colour_is_the_spectrum_that_the_colour_promotes_to(tmp_path):
    stored = RANDOM.integers(0, 256, (2, 3, 3), dtype=np.uint8)
    Image.fromarray(stored).save(tmp_path / "colours.png")
    found = in_bands(read_picture(tmp_path / "colours.png"))
    for row, column in np.ndindex(2, 3):
        expected = promoted(stored[row, column] / 255).in_bands(BANDS)
        np.testing.assert_allclose(found[row, column], expected, atol=1e-6)


@pytest.mark.parametrize(
    ("gamma", "expected"), [(1.0, 0.5), (2.2, 0.5**2.2), (-1.0, ((0.5 + 0.055) / 1.055) ** 2.4)]
)
def test_gamma_is_undone_as_asked(tmp_path, gamma, expected):
    write_exr(tmp_path / "grey.exr", {}, {name: np.full((1, 1), 0.5, np.float32) for name in "RGB"})
    np.testing.assert_allclose(in_bands(read_picture(tmp_path / "grey.exr", gamma)), expected, rtol=1e-6)


def test_dark_numbers_of_srgb_lie_on_its_straight_line(tmp_path):
    write_exr(tmp_path / "dark.exr", {}, {name: np.full((1, 1), 0.02, np.float32) for name in "RGB"})
    np.testing.assert_allclose(in_bands(read_picture(tmp_path / "dark.exr", -1)), 0.02 / 12.92, rtol=1e-6)


@pytest.mark.parametrize("word", ["T", "S0"])
def test_channels_of_a_spectral_file_are_its_bands_as_they_are(tmp_path, word):
    stored = RANDOM.random((2, 3, 31)).astype(np.float32)
    planes = {f"{word}.{nm},000000nm": stored[..., k] for k, nm in enumerate(range(400, 701, 10))}
    write_exr(tmp_path / "wood.exr", {}, planes)
    np.testing.assert_array_equal(in_bands(read_picture(tmp_path / "wood.exr")), stored)


def test_other_bands_are_averages_of_straight_lines_between_the_channels(tmp_path):
    stored = RANDOM.random((1, 1, 4)).astype(np.float32)
    planes = {f"T.{nm},000000nm": stored[..., k] for k, nm in enumerate((410, 480, 560, 690))}
    write_exr(tmp_path / "wood.exr", {}, planes)
    bands = Bands.regular(405, 17, 16)
    expected = Spectrum.of([410, 480, 560, 690], stored[0, 0]).in_bands(bands)
    np.testing.assert_allclose(
        in_bands(read_picture(tmp_path / "wood.exr"), bands)[0, 0], expected, rtol=1e-5
    )


def test_sixteen_bits_of_grey_are_not_cut_off(tmp_path):
    Image.fromarray(np.array([[0, 32768, 65535]], np.uint16)).save(tmp_path / "grey.png")
    found = in_bands(read_picture(tmp_path / "grey.png"))
    np.testing.assert_allclose(found[0, :, 7], [0, 32768 / 65535, 1], rtol=1e-6)


def test_what_is_no_picture_is_refused_in_one_sentence(tmp_path):
    (tmp_path / "text.png").write_text("no picture")
    with pytest.raises(RecipeError, match=r"text.png: not a picture that can be read"):
        read_picture(tmp_path / "text.png")
    write_exr(tmp_path / "depth.exr", {}, {"Z": np.zeros((1, 1), np.float32)})
    with pytest.raises(RecipeError, match="neither a picture of colours nor one of spectra"):
        read_picture(tmp_path / "depth.exr")
    write_exr(tmp_path / "dark.exr", {}, {"T.400,000000nm": np.full((1, 1), -1, np.float32)})
    with pytest.raises(RecipeError, match="numbers below 0"):
        read_picture(tmp_path / "dark.exr")
