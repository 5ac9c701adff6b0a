"""What RGB renderers call 1, in the units of spectra."""

from __future__ import annotations

from functools import cache

from .colorimetry import EFFICACY
from .observers import cie_1931
from .spectra import library


@cache
def daylight_efficacy() -> float:
    """Return the luminance of D65 of 1 W sr-1 m-2 from 360 to 830 nm [cd m-2]."""
    places, functions = cie_1931()
    return EFFICACY * float(library.find("D65").with_watts(1.0).at(places) @ functions[:, 1])
