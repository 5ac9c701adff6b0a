"""Colours made into spectra."""

import numpy as np
import pytest

from rtb_addon.colorimetry import linear_srgb
from rtb_addon.observers import matching_functions
from rtb_addon.spectra import Bands, Unit
from rtb_addon.spectra.library import find
from rtb_addon.spectra.promotion import promoted

FINE = Bands.regular(380, 1, 401)


def test_grey_is_flat_and_the_primaries_add_up_to_white():
    wavelengths = np.arange(360, 831)
    np.testing.assert_allclose(promoted((0.3, 0.3, 0.3)).at(wavelengths), 0.3)
    total = sum(promoted(colour).at(wavelengths) for colour in np.eye(3))
    np.testing.assert_allclose(total, 1)


def test_negative_components_count_as_nothing_and_the_unit_is_kept():
    spectrum = promoted((-1, 0, 2), Unit.RADIANCE)
    assert spectrum.values.min() == 0
    assert spectrum.unit is Unit.RADIANCE


@pytest.mark.parametrize(
    "colour", [*np.eye(3), (1, 1, 1), (0.8, 0.1, 0.2), (0.64, 0.02, 0.09), (0.2, 0.5, 0.3)]
)
def test_a_surface_under_d65_shows_its_colour_again(colour):
    light = find("D65").at(FINE.centres)
    weights = matching_functions(FINE)
    shown = (promoted(colour).at(FINE.centres) * light) @ weights / (light @ weights[:, 1])
    np.testing.assert_allclose(linear_srgb(shown), colour, atol=0.03)
