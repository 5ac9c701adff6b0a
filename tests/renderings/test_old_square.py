"""
The SimpleSquare: what comes off a surface is its reflectance times the light, band by band.

A directional light and a matte square leave nothing to chance but the square's edges, so that the bound
below is that of 32-bit numbers.
"""

import csv
import math
import runpy

import numpy as np
import pytest

from rtb_addon.observers import matching_functions
from rtb_addon.recipe import Recipe
from rtb_addon.spectra import DEFAULT_BANDS
from rtb_addon.spectra.files import read_spd
from tests.renderings.old_files import RENDERERS, ROOT, RTB3, old, rendered, said

ROUNDING = 3e-6
WHITE = 3  # the patch that is the reference white of the old figure
SHOWN = (24, 3, 7, 11)  # the patches whose spectra the old figure shows


def squares(recipe, renderer):
    """Return all conditions' cubes: (conditions, height, width, bands)."""
    size = {"renderer": renderer, "width": 50, "height": 50, "samples": 4}
    return np.stack([rendered(recipe, each.name, **size).radiance for each in recipe.conditions])


def predicted(recipe, column, kind):
    """Return reflectance times light over pi of every condition: (conditions, bands)."""
    light = read_spd(recipe.find_file("D65.spd")).in_bands(DEFAULT_BANDS, kind)
    files = [recipe.find_file(each.cells[column]) for each in recipe.conditions]
    return np.stack([read_spd(file).in_bands(DEFAULT_BANDS, kind) for file in files]) * light / math.pi


@pytest.fixture(scope="module")
def ours(tmp_path_factory):
    make_recipe = runpy.run_path(str(ROOT / "examples/simple_square/make_recipe.py"))["make_recipe"]
    return make_recipe(tmp_path_factory.mktemp("square")), "paint"


@pytest.fixture(scope="module")
def olds(tmp_path_factory):
    files = [old("ExampleScenes", "SimpleSquare", f"SimpleSquare{end}") for end in ENDS]
    folder = tmp_path_factory.mktemp("old-square")
    said("import", *files, "--output", folder, "--data", RTB3 / "RenderData")
    return Recipe.load(folder), "squareColor"


ENDS = (".dae", "Conditions.txt", "Mappings.txt")


@pytest.fixture(scope="module", params=[(name, source) for name in RENDERERS for source in ("ours", "olds")])
def family(request):
    """All 24 squares, by a renderer, and what they should be."""
    renderer, source = request.param
    recipe, column = request.getfixturevalue(source)
    return squares(recipe, renderer), predicted(recipe, column, "averaged")


@pytest.fixture(scope="module", params=RENDERERS)
def old_square(request, olds):
    """The old figure's pixel of all 24 pictures, and its prediction by single wavelengths."""
    return squares(olds[0], request.param)[:, 11, 11].astype(float), predicted(*olds, "centre")


def test_every_pixel_on_the_square_has_its_reflectance_times_the_light_over_pi(family):
    cubes, expected = family
    assert len(cubes) == 24
    inside = cubes[:, 4:46, 4:46]
    np.testing.assert_allclose(inside, np.broadcast_to(expected[:, None, None], inside.shape), rtol=ROUNDING)


def test_the_square_covers_its_share_of_the_picture_and_nothing_shines_beside_it(family):
    cubes, expected = family
    covered = cubes[..., 15].sum(axis=(1, 2)) / expected[:, 15]
    # Of 175 pixels on the edge each is covered by chance, with four samples; all 24 by the same chance.
    np.testing.assert_allclose(covered, 43.75**2, atol=4 * math.sqrt(175 / 4 / 4))
    assert cubes[:, :3].max() == cubes[:, :, :3].max() == 0


def test_the_stated_numbers_of_three_patches_come_out(olds):
    expected = predicted(*olds, "centre")
    assert expected[3, 12] == pytest.approx(30.294, rel=1e-3)
    assert expected[23, 12] == pytest.approx(1.061, rel=1e-3)
    assert expected[10, 30] == pytest.approx(16.73, rel=1e-3)


def test_colours_are_those_of_the_averages_in_each_band(old_square, olds):
    pixels, _ = old_square
    assert colour_differences(predicted(*olds, "averaged"), pixels).max() < 1e-3


def test_the_old_figures_differences_of_colour_come_out(old_square):
    """It compared with single wavelengths: up to 0.87 of difference, the same for all renderers."""
    pixels, by_wavelength = old_square
    stored = table("SimpleSquare-LAB-distance.csv")
    found = colour_differences(by_wavelength, pixels)
    np.testing.assert_allclose(found, stored[:, 1], atol=2e-4)  # PBRT
    np.testing.assert_allclose(found, stored[:, 2], atol=0.01)  # Mitsuba, in 16-bit numbers


def test_the_old_figures_spectra_come_out(old_square):
    pixels, by_wavelength = old_square
    stored = table("SimpleSquare-spectra.csv")
    factor = scale(by_wavelength, pixels)
    np.testing.assert_array_equal(stored[:, 0], DEFAULT_BANDS.centres)
    for patch, columns in zip(SHOWN, stored[:, 1:].reshape(-1, 4, 3).transpose(1, 2, 0), strict=True):
        largest = by_wavelength[patch - 1].max()
        np.testing.assert_allclose(by_wavelength[patch - 1] / largest, columns[0], atol=1e-7)
        np.testing.assert_allclose(factor * pixels[patch - 1] / largest, columns[1], atol=1e-5)
        np.testing.assert_allclose(factor * pixels[patch - 1] / largest, columns[2], atol=5e-4)


def colour_differences(expected, pixels):
    """Return CIE 1976 differences of colour, one a patch, after the least-squares factor of all of them."""
    white = expected[WHITE]
    return np.linalg.norm(lab(expected, white) - lab(scale(expected, pixels) * pixels, white), axis=1)


def scale(expected, pixels):
    return (expected * pixels).sum() / (pixels**2).sum()


def lab(spectra, white):
    functions = matching_functions(DEFAULT_BANDS)
    ratios = (spectra @ functions) / (white @ functions)
    x, y, z = np.where(ratios > (6 / 29) ** 3, np.cbrt(ratios), ratios * (29 / 6) ** 2 / 3 + 4 / 29).T
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=1)


def table(name):
    with old("extracted", name).open() as file:
        return np.array([[float(cell) for cell in row] for row in list(csv.reader(file))[1:]])
