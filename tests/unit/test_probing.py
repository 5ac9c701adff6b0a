"""Probes: spectra of regions, what observers make of them, how two differ; against colour-science."""

import csv
import io
import json
import warnings

import numpy as np
import pytest

from rtb_addon.colour_difference import D65, delta_e, lab, white
from rtb_addon.errors import RecipeError
from rtb_addon.observers import cie_1931, cone_fundamentals, lms
from rtb_addon.probe_tables import csv_text
from rtb_addon.probing import Probe, Region, difference, probed
from rtb_addon.spectra import DEFAULT_BANDS, Bands, library
from rtb_addon.spectral_image import SpectralImage

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import colour

LIGHT = library.find("D65").at(DEFAULT_BANDS.centres)
FINE = Bands.regular(390, 1, 441)
# Pairs in CIELAB with their CIEDE2000, where formulas go wrong; Sharma, Wu and Dalal 2005, table 1.
SHARMA = [
    ((50.0, 2.6772, -79.7751), (50.0, 0.0, -82.7485), 2.0425),
    ((50.0, 0.0, 0.0), (50.0, -1.0, 2.0), 2.3669),
    ((50.0, 2.49, -0.001), (50.0, -2.49, 0.0009), 7.1792),
    ((50.0, 2.49, -0.001), (50.0, -2.49, 0.0011), 7.2195),
    ((50.0, -0.001, 2.49), (50.0, 0.0011, -2.49), 4.7461),
    ((50.0, 2.5, 0.0), (50.0, 0.0, -2.5), 4.3065),
    ((50.0, 2.5, 0.0), (73.0, 25.0, -18.0), 27.1492),
    ((22.7233, 20.0904, -46.694), (23.0331, 14.973, -42.5619), 2.0373),
    ((2.0776, 0.0795, -1.135), (0.9033, -0.0636, -0.5514), 0.9082),
]


def noisy(mean: np.ndarray, spread: float, height: int = 20, width: int = 30) -> SpectralImage:
    """Return a cube of spectra around a mean, (bands,)."""
    noise = np.random.default_rng(5).normal(1, spread, (height, width, len(mean)))
    return SpectralImage((mean * noise).astype(np.float32), DEFAULT_BANDS)


def patches(*levels: np.ndarray) -> SpectralImage:
    """Return a cube of one row, a pixel for each spectrum."""
    return SpectralImage(np.array([levels], np.float32), DEFAULT_BANDS)


def test_the_tables_are_those_of_colour_science():
    for (places, functions), name in (
        (cie_1931(), "CIE 1931 2 Degree Standard Observer"),
        ((FINE.centres, cone_fundamentals(FINE)), "Stockman & Sharpe 2 Degree Cone Fundamentals"),
    ):
        theirs = colour.MSDS_CMFS[name]
        np.testing.assert_array_equal(places, theirs.wavelengths)
        np.testing.assert_array_equal(functions, theirs.values)


def test_cones_catch_the_integral_of_light_times_sensitivity():
    cones = colour.MSDS_CMFS["Stockman & Sharpe 2 Degree Cone Fundamentals"]
    radiance = library.find("A").at(FINE.centres)
    expected = (radiance[:, None] * cones.values).sum(axis=0) * cones.shape.interval
    np.testing.assert_allclose(lms(radiance, FINE), expected, rtol=1e-12)
    np.testing.assert_allclose(lms(2 * radiance, FINE), 2 * lms(radiance, FINE))


def test_lab_is_that_of_colour_science():
    tristimulus = np.random.default_rng(1).uniform(0, 100, (500, 3))
    theirs = colour.XYZ_to_Lab(tristimulus / 100, np.array(D65))
    np.testing.assert_allclose(lab(tristimulus, white(100)), theirs, atol=1e-10)


def test_delta_e_is_that_of_colour_science_near_and_far():
    draws = np.random.default_rng(2)
    first = draws.uniform([0, -100, -100], [100, 100, 100], (2000, 3))
    for second in (first[::-1], first + draws.normal(0, 1, first.shape)):
        theirs = colour.difference.delta_E_CIE2000(first, second)
        np.testing.assert_allclose(delta_e(first, second), theirs, atol=1e-9)


@pytest.mark.parametrize(("first", "second", "expected"), SHARMA)
def test_delta_e_has_the_published_numbers(first, second, expected):
    assert float(delta_e(np.array(first), np.array(second))) == pytest.approx(expected, abs=5e-5)


def test_a_pixel_gives_its_own_spectrum_and_no_error():
    cube = noisy(LIGHT, 0.1)
    probe = probed(cube, "one", Region(7, 3))
    assert probe.radiance == tuple(cube.radiance[3, 7].astype(float))
    assert set(probe.standard_error) == {0.0}
    assert probe.luminance_error == 0
    assert probe.wavelengths == tuple(DEFAULT_BANDS.centres)


def test_a_region_gives_its_mean_within_the_standard_error_that_it_states():
    probe = probed(noisy(LIGHT, 0.1), "whole", Region(0, 0, 30, 20))
    expected_error = 0.1 * LIGHT / np.sqrt(600)
    np.testing.assert_allclose(probe.standard_error, expected_error, rtol=0.15)  # 600 draws: 3 % each
    z = (np.array(probe.radiance) - LIGHT) / expected_error
    assert np.abs(z).max() < 4.5
    # 31 independent bands: the error of luminance is smaller than that of any of them.
    assert 0 < probe.luminance_error / probe.luminance < 0.1 / np.sqrt(600)


def test_daylight_has_its_chromaticity_and_luminance():
    probe = probed(patches(LIGHT), "light", Region(0, 0))
    assert probe.xy == pytest.approx((0.31267, 0.32933), abs=1e-5)  # of bands that end at 700 nm
    assert probe.luminance == pytest.approx(probe.xyz[1])
    assert probe.white == pytest.approx(probe.luminance)


def test_no_light_has_the_chromaticity_of_equal_energy_and_no_contrast():
    black = probed(patches(0 * LIGHT), "black", Region(0, 0))
    assert black.xy == (1 / 3, 1 / 3)
    assert np.isnan(difference(black, black).cone_contrast).all()
    assert difference(black, black).delta_e == 0


def test_twice_the_light_has_a_contrast_of_one_and_the_delta_e_of_its_lightness():
    cube = patches(LIGHT, LIGHT / 2)
    dim, bright = probed(cube, "c", Region(1, 0)), probed(cube, "c", Region(0, 0))
    found = difference(dim, bright)
    assert found.cone_contrast == pytest.approx((1, 1, 1))
    first, second = (
        colour.XYZ_to_Lab(np.array(each.xyz) / bright.luminance, np.array(D65)) for each in (dim, bright)
    )
    assert found.delta_e == pytest.approx(float(colour.difference.delta_E_CIE2000(first, second)), abs=1e-6)


@pytest.mark.parametrize("region", [(-1, 0, 1, 1), (30, 0, 1, 1), (0, 19, 1, 2), (0, 0, 0, 1)])
def test_a_region_outside_of_the_picture_is_refused(region):
    with pytest.raises(RecipeError, match="30 x 20 pixels has no region"):
        probed(noisy(LIGHT, 0.1), "c", Region(*region))


def test_a_probe_survives_being_sent():
    probe = probed(noisy(LIGHT, 0.1), "whole", Region(2, 3, 4, 5))
    assert Probe.from_words(json.loads(json.dumps(probe.to_words()))) == probe


def test_the_table_holds_all_there_is_to_know():
    cube = patches(LIGHT, LIGHT / 2)
    probes = [probed(cube, "c", Region(number, 0)) for number in (0, 1)]
    rows = {row[0]: row[1:] for row in csv.reader(io.StringIO(csv_text(probes)))}
    assert rows["condition"] == ["c", "", "c", ""]
    assert float(rows["550"][0]) == pytest.approx(probes[0].radiance[15], rel=1e-6)
    assert float(rows["550"][2]) == pytest.approx(probes[1].radiance[15], rel=1e-6)
    assert float(rows["M contrast to the first"][2]) == pytest.approx(-0.5)
    assert len(csv_text(probes[:1]).splitlines()) == 10 + 1 + 31


def test_a_probe_says_which_renderer_its_light_is_of():
    cube = patches(LIGHT).with_attributes({"renderer": "tracer"})
    probe = probed(cube, "c", Region(0, 0))
    assert probe.renderer == "tracer"
    assert csv_text([probe]).splitlines()[1] == "renderer,tracer,"


def test_probes_of_other_bands_share_a_table():
    coarse = SpectralImage(np.ones((1, 1, 2), np.float32), Bands.regular(500, 5, 2))
    probes = [probed(patches(LIGHT), "fine", Region(0, 0)), probed(coarse, "coarse", Region(0, 0))]
    rows = {row[0]: row[1:] for row in csv.reader(io.StringIO(csv_text(probes)))}
    assert rows["505"][:2] == ["", ""]
    assert rows["505"][2] == "1"
