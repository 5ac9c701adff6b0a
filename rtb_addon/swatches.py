"""The colour that a spectrum shows, for the interface: from numpy and a small table, as Blender needs it."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np

from .colorimetry import encoded, linear_srgb
from .spectra import FloatArray, Spectrum

_DATA = Path(__file__).parent / "data"


def surface_colour(reflectance: Spectrum, light: Spectrum) -> np.ndarray:
    """Return 8-bit sRGB of a surface in a light, where a perfect white is as bright as can be, (3,)."""
    places, functions = matching_functions()
    weights = functions * light.at(places)[:, None]
    return encoded(linear_srgb(reflectance.at(places) @ weights / weights[:, 1].sum()))


def light_colour(light: Spectrum) -> np.ndarray:
    """Return 8-bit sRGB of a light, as bright as can be, (3,); black where there is none."""
    places, functions = matching_functions()
    linear = np.maximum(linear_srgb(light.at(places) @ functions), 0)
    return encoded(linear / max(float(linear.max()), np.finfo(float).tiny))


@cache
def matching_functions() -> tuple[FloatArray, FloatArray]:
    """Return wavelengths [nm] and the CIE 1931 2 degree functions, (wavelengths, 3), every 5 nm."""
    table = np.loadtxt(_DATA / "cie_1931.csv", delimiter=",", comments="#")
    table.flags.writeable = False
    return table[:, 0], table[:, 1:]
