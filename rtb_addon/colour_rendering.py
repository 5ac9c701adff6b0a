"""How true colours look in a light: the general colour rendering index of the CIE."""

from __future__ import annotations

import numpy as np

from .observers import cie_1931, test_colours
from .photometry import temperature
from .spectra import FloatArray, Spectrum
from .spectra.sources import DAYLIGHTS, blackbody, daylight

GENERAL = 8  # of the CIE's test colours make up the general index
_DAYLIGHT_FROM = 5000.0  # [K]; colder references are blackbodies


def rendering_index(light: Spectrum) -> float | None:
    """
    Return the general colour rendering index Ra of a light, 100 at best; None where it has no temperature.

    Notes
    -----
    CIE 13.3-1995: eight colours in the light and in daylight or a blackbody of the same temperature, compared
    in CIE 1964 U*V*W* after von Kries's adaptation of the light's white to the reference's.
    """
    found = temperature(light)
    if found is None or found[0] > DAYLIGHTS[1]:
        return None
    reference = (blackbody if found[0] < _DAYLIGHT_FROM else daylight)(found[0])
    here, there = _seen(light), _seen(reference)
    white, wanted = here[0], there[0]
    here = np.column_stack([here[:, 0], _adapted(here[:, 1:], white[1:], wanted[1:])])
    differences = np.linalg.norm(_uniform(here[1:], wanted) - _uniform(there[1:], wanted), axis=1)
    return float((100 - 4.6 * differences).mean())


def _seen(light: Spectrum) -> FloatArray:
    """Return Y, u, v (CIE 1960) of a light, Y of 100, and of the test colours in it, (1 + colours, 3)."""
    places, functions = cie_1931()
    wavelengths, reflectances = test_colours()
    surfaces = [np.interp(places, wavelengths, each) for each in reflectances.T[:GENERAL]]
    weights = functions * light.at(places)[:, None]
    x, y, z = (np.array([np.ones(len(places)), *surfaces]) @ weights / weights[:, 1].sum() * 100).T
    whole = x + 15 * y + 3 * z
    return np.column_stack([y, 4 * x / whole, 6 * y / whole])


def _adapted(uv: FloatArray, white: FloatArray, wanted: FloatArray) -> FloatArray:
    """Return CIE 1960 u, v as they look where another white is white."""
    gains = _cones(wanted[None]) / _cones(white[None])
    c, d = (_cones(uv) * gains).T
    below = 16.518 + 1.481 * c - d
    return np.column_stack([(10.872 + 0.404 * c - 4 * d) / below, 5.520 / below])


def _cones(uv: FloatArray) -> FloatArray:
    """Return c and d, what von Kries's rule scales, (places, 2)."""
    u, v = uv.T
    return np.column_stack([(4 - u - 10 * v) / v, (1.708 * v + 0.404 - 1.481 * u) / v])


def _uniform(seen: FloatArray, white: FloatArray) -> FloatArray:
    """Return W*, U*, V* of the CIE's diagram of 1964, (colours, 3)."""
    lightness = 25.0 * np.cbrt(seen[:, 0]) - 17.0
    return np.column_stack([lightness, 13 * lightness[:, None] * (seen[:, 1:] - white[1:])])
