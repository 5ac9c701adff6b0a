"""Two cubes of one condition, compared: numbers that follow from how they were made."""

from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.compare import compare_cubes, compare_renderers, table
from rtb_addon.errors import RecipeError
from rtb_addon.spectra import Bands
from rtb_addon.spectral_image import SpectralImage

BANDS = Bands.regular(400, 10, 4)


def cube(radiance, **attributes):
    return SpectralImage(np.asarray(radiance, np.float32), BANDS, attributes=attributes)


def grey(level=1.0, **attributes):
    return cube(np.full((3, 5, 4), level), **attributes)


def test_a_cube_equals_itself():
    same = compare_cubes("one", grey(), grey())
    assert (same.ratio, same.rms, same.largest, same.noise) == (1, 0, 0, None)


def test_the_band_that_lies_farthest_off_is_named():
    brighter = np.ones((3, 5, 4))
    brighter[..., 2] = 1.2
    found = compare_cubes("one", cube(brighter), grey())
    assert found.numbers[2:4] == ("420", "1.20000")
    np.testing.assert_allclose(found.ratio, 1.05, rtol=1e-6)
    np.testing.assert_allclose(found.rms, 0.2 / 2, rtol=1e-6)


def test_one_pixel_counts_in_the_largest_difference():
    spot = np.full((3, 5, 4), 2.0)
    spot[1, 1, 0] = 7.0
    found = compare_cubes("one", cube(spot), grey(2.0))
    np.testing.assert_allclose(found.largest, 5.0 / 2.0)
    np.testing.assert_allclose(found.rms, 5.0 / 2.0 / np.sqrt(60))


def test_what_the_noise_explains_stands_beside_the_difference():
    rng = np.random.default_rng(3)
    noisy = [cube(4 + 0.1 * rng.standard_normal((40, 50, 4)), noise="0.025") for _ in range(2)]
    found = compare_cubes("one", *noisy)
    np.testing.assert_allclose(found.noise, 0.025 * np.sqrt(2), rtol=0.01)
    np.testing.assert_allclose(found.rms, found.noise, rtol=4 / np.sqrt(2 * 8000))


@pytest.mark.parametrize(
    ("other", "complaint"),
    [
        (cube(np.ones((3, 4, 4))), "differ in size or bands"),
        (SpectralImage(np.ones((3, 5, 4), np.float32), Bands.regular(500, 10, 4)), "differ in size or bands"),
        (replace(grey(), band_kind="centre"), "are averaged and centre, want one kind"),
        (grey(units="rtb3"), "units of one are None and rtb3"),
        (grey(0.0), "one is black in the second"),
    ],
)
def test_cubes_that_are_not_of_one_kind_are_refused(other, complaint):
    with pytest.raises(RecipeError, match=complaint):
        compare_cubes("one", grey(), other)


def test_a_table_has_a_row_for_each_condition():
    lines = table([compare_cubes("one", grey(), grey()), compare_cubes("two", grey(2), grey())]).splitlines()
    assert [line.split("\t")[0] for line in lines] == ["condition", "one", "two"]
    assert len({line.count("\t") for line in lines}) == 1


def test_a_renderer_that_has_not_rendered_yet_is_named(write_family):
    with pytest.raises(RecipeError, match="a is not rendered with tracer yet, render it with tracer first"):
        list(compare_renderers(write_family({"a": "0.8"}), "tracer", "mitsuba"))


def test_conditions_that_are_not_there_leave_nothing_to_compare(write_family):
    with pytest.raises(RecipeError, match="no condition is left"):
        list(compare_renderers(write_family({"a": "0.8"}), "tracer", "mitsuba", ["b"]))
