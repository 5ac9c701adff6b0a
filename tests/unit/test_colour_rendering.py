"""Colour rendering indices, against the CIE's own table, colour-science and closed forms."""

import warnings

import numpy as np
import pytest

from rtb_addon import colour_rendering
from rtb_addon.colour_rendering import rendering_index
from rtb_addon.spectra import Spectrum, library
from rtb_addon.spectra.sources import blackbody, daylight

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # it tells which of its own optional packages are missing
    import colour
    from colour.quality.datasets.tcs import SDS_TCS

# Whole numbers, CIE 15:2004, table T.7.
PUBLISHED = dict(zip(range(1, 13), (76, 64, 57, 51, 72, 59, 90, 95, 90, 81, 83, 83), strict=True))


@pytest.mark.parametrize("kelvin", [2000, 4999, 5010, 6504, 20000])
def test_a_reference_renders_colours_as_itself(kelvin):
    light = (blackbody if kelvin < 5000 else daylight)(kelvin)
    # The temperature that gives a daylight its name is up to 4 K from what the blackbodies say.
    assert rendering_index(light) == pytest.approx(100, abs=0.01)


@pytest.mark.parametrize(("number", "index"), PUBLISHED.items())
def test_fluorescent_lamps_have_the_published_index(number, index):
    # Rounded there, and worked out there with a temperature in whole steps.
    assert rendering_index(library.find(f"FL{number}")) == pytest.approx(index, abs=0.6)


@pytest.mark.parametrize("name", ["A", "D50", "HP1", "HP2", "LED-B3", "LED-RGB1", "LED-V1"])
def test_the_index_is_that_of_colour_science(name, monkeypatch):
    # Between the samples of the colours it goes along Sprague's curves, which is as much as 0.1 for sodium.
    shape = colour.SpectralShape(360, 830, 1)
    colours = np.column_stack([each.copy().align(shape).values for each in SDS_TCS.values()])
    monkeypatch.setattr(colour_rendering, "test_colours", lambda: (shape.wavelengths, colours))
    theirs = colour.colour_rendering_index(colour.SDS_ILLUMINANTS[name])
    assert rendering_index(library.find(name)) == pytest.approx(theirs, abs=0.01)


def test_a_laser_and_darkness_have_none():
    assert rendering_index(Spectrum.of([531, 532, 533], [0, 1, 0])) is None
    assert rendering_index(Spectrum.constant(0.0)) is None
