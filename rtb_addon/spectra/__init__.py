"""Spectra, where they come from and how they are kept."""

from .bands import DEFAULT_BANDS, PARTS, BandKind, Bands, FloatArray, Part
from .spectrum import FULL_RANGE, Spectrum, Unit

__all__ = [
    "DEFAULT_BANDS",
    "FULL_RANGE",
    "PARTS",
    "BandKind",
    "Bands",
    "FloatArray",
    "Part",
    "Spectrum",
    "Unit",
]
