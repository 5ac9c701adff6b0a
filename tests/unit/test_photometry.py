"""Lumens and colour temperatures, against colour-science and closed forms."""

import warnings

import numpy as np
import pytest

from rtb_addon.photometry import lumens, temperature
from rtb_addon.spectra import Spectrum, library
from rtb_addon.spectra.sources import blackbody, daylight

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # it tells which of its own optional packages are missing
    import colour
    from colour.temperature import uv_to_CCT_Ohno2013

OBSERVER = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]


def test_a_watt_at_555_nanometres_is_683_lumens():
    line = Spectrum.of([554.9999, 555, 555.0001], [0, 10000, 0])
    assert line.integral() == pytest.approx(1)
    assert lumens(line) == pytest.approx(683.0, rel=1e-6)


def test_a_flat_spectrum_is_the_integral_of_the_eyes_sensitivity():
    sensitivity = OBSERVER.values[:, 1]
    whole = (sensitivity[1:] + sensitivity[:-1]).sum() / 2
    assert lumens(Spectrum.constant(2.0)) == pytest.approx(2 * 683.0 * whole, rel=1e-12)


@pytest.mark.parametrize("name", ["A", "D65", "FL2", "HP1", "LED-B3"])
def test_lumens_are_a_fine_sum_over_the_table_of_the_eye(name):
    light = library.find(name)
    fine = np.arange(360, 830, 0.01) + 0.005
    seen = np.interp(fine, OBSERVER.wavelengths, OBSERVER.values[:, 1])
    assert lumens(light) == pytest.approx(683.0 * 0.01 * (light.at(fine) * seen).sum(), rel=1e-6)


@pytest.mark.parametrize("kelvin", [1500, 2856, 5000, 6504, 20000])
def test_a_blackbody_has_its_own_temperature(kelvin):
    found, off = temperature(blackbody(kelvin))
    assert found == pytest.approx(kelvin, rel=1e-6)
    assert abs(off) < 1e-8


@pytest.mark.parametrize("name", ["A", "C", "D50", "D65", "FL2", "FL11", "HP5", "LED-B1", "LED-RGB1"])
def test_temperatures_are_those_of_ohno(name):
    kelvin, off = temperature(library.find(name))
    places = OBSERVER.wavelengths
    x, y, z = library.find(name).at(places) @ OBSERVER.values
    theirs = uv_to_CCT_Ohno2013(np.array([4 * x, 6 * y]) / (x + 15 * y + 3 * z), cmfs=OBSERVER)
    assert kelvin == pytest.approx(theirs[0], rel=5e-4)
    assert off == pytest.approx(theirs[1], abs=1e-5)


def test_daylight_lies_above_the_blackbodies():
    kelvin, off = temperature(daylight(6504))
    assert kelvin == pytest.approx(6503, abs=3)
    assert off == pytest.approx(0.0032, abs=1e-4)


@pytest.mark.parametrize("light", [Spectrum.of([500, 510, 520], [0, 1, 0]), Spectrum.constant(0.0)])
def test_a_pure_colour_and_the_dark_have_no_temperature(light):
    assert temperature(light) is None
