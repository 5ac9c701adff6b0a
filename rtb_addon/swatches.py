"""The colour that a spectrum shows, for the interface: from numpy and a small table, as Blender needs it."""

from __future__ import annotations

import numpy as np

from .colorimetry import encoded, linear_srgb
from .observers import cie_1931
from .spectra import Spectrum


def surface_colour(reflectance: Spectrum, light: Spectrum) -> np.ndarray:
    """Return 8-bit sRGB of a surface in a light, where a perfect white is as bright as can be, (3,)."""
    places, functions = cie_1931()
    weights = functions * light.at(places)[:, None]
    return encoded(linear_srgb(reflectance.at(places) @ weights / weights[:, 1].sum()))


def light_colour(light: Spectrum) -> np.ndarray:
    """Return 8-bit sRGB of a light, as bright as can be, (3,); black where there is none."""
    places, functions = cie_1931()
    linear = np.maximum(linear_srgb(light.at(places) @ functions), 0)
    return encoded(linear / max(float(linear.max()), np.finfo(float).tiny))
