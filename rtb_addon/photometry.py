"""Light as people measure it: lumens, the blackbody that looks alike, and how far it is off."""

from __future__ import annotations

from functools import cache

import numpy as np

from .colorimetry import EFFICACY
from .observers import cie_1931
from .spectra import FULL_RANGE, FloatArray, Spectrum, Unit
from .spectra.sources import blackbody

COLDEST, HOTTEST = 1000.0, 100000.0  # [K] between which a correlated temperature is looked for
FARTHEST = 0.05  # from the blackbodies, beyond which the CIE gives none [CIE 1960 uv]
_GOLDEN = (5**0.5 - 1) / 2


def lumens(spectrum: Spectrum) -> float:
    """
    Return what a spectral quantity comes to in photometric units: lm for W nm-1, cd for W sr-1 nm-1 ...

    Straight lines between the samples of both the spectrum and the eye's sensitivity, integrated exactly.
    """
    places, functions = cie_1931()
    low, high = FULL_RANGE
    own = spectrum.wavelengths[(spectrum.wavelengths > low) & (spectrum.wavelengths < high)]
    knots = np.union1d(places, own)
    middles = (knots[1:] + knots[:-1]) / 2
    at_knots, at_middles = (
        spectrum.at(each) * np.interp(each, places, functions[:, 1]) for each in (knots, middles)
    )
    # A product of two straight lines is a parabola, of which Simpson's rule is exact.
    parts = np.diff(knots) * (at_knots[1:] + 4 * at_middles + at_knots[:-1]) / 6
    return EFFICACY * float(parts.sum())


def with_lumens(shape: Spectrum, amount: float) -> Spectrum:
    """Return a shape that carries a luminous flux [lm]."""
    if (whole := lumens(shape)) <= 0:
        raise ValueError("a spectrum that nobody sees cannot carry lumens")
    return shape.scaled(amount / whole, Unit.POWER)


def temperature(light: Spectrum) -> tuple[float, float] | None:
    """
    Return the correlated colour temperature [K] of a light and its distance from it (Duv); None without.

    Notes
    -----
    The nearest blackbody in the CIE 1960 diagram, as CIE 15 has it; positive distances lie above it.
    """
    place = _uv(light)
    if place is None:
        return None
    mireds, locus = _locus()
    distances = np.hypot(*(locus - place).T)
    nearest = int(distances.argmin())
    if distances[nearest] > FARTHEST or nearest in (0, len(mireds) - 1):
        return None
    low, high = mireds[nearest - 1], mireds[nearest + 1]
    mired = _least(lambda each: float(np.hypot(*(_blackbody_uv(1e6 / each) - place))), low, high)
    kelvin = 1e6 / mired
    off = place - _blackbody_uv(kelvin)
    return kelvin, float(np.copysign(np.hypot(*off), off[1]))


def _uv(light: Spectrum) -> FloatArray | None:
    """Return CIE 1960 u, v of a light, or None where there is none."""
    places, functions = cie_1931()
    x, y, z = light.at(places) @ functions
    whole = x + 15 * y + 3 * z
    return np.array([4 * x, 6 * y]) / whole if whole > 0 else None


def _blackbody_uv(kelvin: float) -> FloatArray:
    found = _uv(blackbody(kelvin))
    assert found is not None  # above 1000 K every blackbody can be seen
    return found


@cache
def _locus() -> tuple[FloatArray, FloatArray]:
    """Return inverse temperatures [1e6 K-1], evenly apart, and (n, 2) u, v of the blackbodies there."""
    mireds = np.linspace(1e6 / HOTTEST, 1e6 / COLDEST, 100)
    return mireds, np.array([_blackbody_uv(1e6 / each) for each in mireds])


def _least(distance, low: float, high: float) -> float:
    """Return where a function with one valley between two places is least."""
    for _ in range(40):
        left, right = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        if distance(left) < distance(right):
            high = right
        else:
            low = left
    return (low + high) / 2
