"""Spectra as pictures: curves, digits and swatches."""

import numpy as np
import pytest

from rtb_addon.curves import RANGE, curve_picture, nice_above
from rtb_addon.digits import HEIGHT, WIDTH, letters
from rtb_addon.spectra import Spectrum
from rtb_addon.spectra.library import find
from rtb_addon.spectra.sources import blackbody
from rtb_addon.swatches import light_colour, surface_colour

INK = (200, 200, 200)


def drawn(spectrum: Spectrum, size: int = 200) -> np.ndarray:
    """Return the alpha of a picture's plot, without letters and swatch."""
    return curve_picture(spectrum, size, (255, 0, 0), INK)[..., 3]


def curve_rows(alpha: np.ndarray, columns: range) -> np.ndarray:
    """Return the mean row of what is fully drawn in each column, without the frame."""
    inner = alpha[50:190]
    return np.array([50 + np.flatnonzero(inner[:, column] == 1).mean() for column in columns])


def test_a_line_from_zero_to_one_is_drawn_as_a_straight_line():
    alpha = drawn(Spectrum.of(RANGE, [0.0, 1.0]))
    columns = range(90, 140)
    rows = curve_rows(alpha, columns)
    slope, start = np.polyfit(columns, rows, 1)
    assert np.abs(rows - (slope * np.array(columns) + start)).max() < 1.0
    assert slope > 0.5


def test_a_flat_spectrum_is_drawn_at_its_height():
    # Axes end at 1, 0.5 and 0.5: these are 0.6, 0.8 and 0.5 of their height.
    rows = [curve_rows(drawn(Spectrum.constant(value)), range(60, 190)) for value in (0.6, 0.4, 0.25)]
    assert max(np.ptp(row) for row in rows) < 1
    six, eight, five = (row.mean() for row in rows)
    assert (eight - five) / (six - five) == pytest.approx(3, abs=0.2)


def test_a_line_narrower_than_a_pixel_is_not_lost():
    lamp = Spectrum.of([380, 545.9, 546.1, 546.3, 780], [0.1, 0.1, 1.0, 0.1, 0.1])
    alpha = drawn(lamp)
    assert (alpha[100:150] == 1).any()


def test_the_swatch_has_the_colour_and_what_is_empty_is_clear():
    picture = curve_picture(Spectrum.constant(0.3), 200, (255, 0, 51), INK)
    assert picture[10, 100] == pytest.approx([1.0, 0.0, 0.2, 1.0])
    assert picture[180, 100, 3] == 0
    assert picture.shape == (200, 200, 4)


@pytest.mark.parametrize(
    ("value", "nice"), [(0.03, 0.05), (0.2, 0.2), (0.21, 0.5), (0.999, 1), (117, 200), (0, 1), (6e5, 1e6)]
)
def test_an_axis_ends_at_the_next_1_2_or_5(value, nice):
    assert nice_above(value) == pytest.approx(nice)


@pytest.mark.parametrize("size", [100, 150, 400])
@pytest.mark.parametrize("highest", [1e-7, 0.4, 3e12])
def test_every_scale_and_size_can_be_drawn(size, highest):
    picture = curve_picture(Spectrum.of(RANGE, [0, highest]), size, (0, 0, 0), INK, magnified=2)
    assert np.isfinite(picture).all()
    assert 0 <= picture.min() <= picture.max() <= 1


def test_digits_differ_and_grow_by_whole_pixels():
    shapes = {letters(each).tobytes() for each in "0123456789.-+e"}
    assert len(shapes) == 14
    assert letters("400", 3).shape == (3 * HEIGHT, 9 * WIDTH)
    assert letters("400", 3).sum() == 9 * letters("400").sum()


def test_white_in_daylight_is_white_and_black_is_black():
    light = find("D65")
    assert surface_colour(Spectrum.constant(1.0), light).tolist() == [255, 255, 255]
    assert surface_colour(Spectrum.constant(0.0), light).tolist() == [0, 0, 0]


def test_patches_show_the_published_colours_of_the_chart():
    # BabelColor's sRGB (D65) of its average chart; theirs are adapted from D50, hence a few units.
    for patch, published in (("blue", (36, 63, 147)), ("green", (67, 149, 74)), ("red", (180, 49, 57))):
        shown = surface_colour(find(f"BabelColor Average/{patch}"), find("D65"))
        assert np.abs(shown.astype(int) - published).max() < 12, patch


def test_a_candle_is_warmer_than_daylight_and_no_light_is_black():
    red, green, blue = map(int, light_colour(blackbody(1900)))
    assert red == 255 > green > blue
    assert light_colour(find("D65")).min() > 250
    assert light_colour(Spectrum.constant(0.0)).tolist() == [0, 0, 0]
