"""Spectra, where they come from and how they are kept."""

from .bands import DEFAULT_BANDS, BandKind, Bands, FloatArray
from .spectrum import FULL_RANGE, Spectrum, Unit

__all__ = ["DEFAULT_BANDS", "FULL_RANGE", "BandKind", "Bands", "FloatArray", "Spectrum", "Unit"]
