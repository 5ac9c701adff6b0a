"""A spectrum: numbers over wavelengths, with their unit."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ..units import Unit
from .bands import BandKind, Bands, FloatArray, Part

# Spectra go on with their end values over this range [nm], and watts are spread over it.
FULL_RANGE = (360.0, 830.0)


@dataclass(frozen=True, eq=False)
class Spectrum:
    """
    A function of wavelength: straight lines between samples, end values beyond them.

    Parameters
    ----------
    wavelengths : (samples,) array [nm]
        Strictly increasing.
    values : (samples,) array [unit]
    unit : what the values are
    """

    wavelengths: FloatArray
    values: FloatArray
    unit: Unit = Unit.RATIO

    def __post_init__(self) -> None:
        if self.wavelengths.ndim != 1 or self.wavelengths.shape != self.values.shape:
            raise ValueError(f"{self.values.shape} values for {self.wavelengths.shape} wavelengths")
        if len(self.wavelengths) == 0:
            raise ValueError("a spectrum needs at least one sample")
        if not (np.isfinite(self.wavelengths).all() and np.isfinite(self.values).all()):
            raise ValueError("wavelengths and values must be finite numbers")
        if (np.diff(self.wavelengths) <= 0).any():
            raise ValueError("wavelengths must increase")

    @classmethod
    def of(cls, wavelengths: ArrayLike, values: ArrayLike, unit: Unit = Unit.RATIO) -> Spectrum:
        """Return the spectrum with these samples [nm], [unit]."""
        return cls(np.array(wavelengths, float), np.array(values, float), unit)

    @classmethod
    def constant(cls, value: float, unit: Unit = Unit.RATIO) -> Spectrum:
        """Return the same value [unit] at every wavelength."""
        return cls.of(FULL_RANGE, [value, value], unit)

    def at(self, wavelengths: ArrayLike) -> FloatArray:
        """Return the values [unit] at some wavelengths [nm], in their shape."""
        return np.interp(np.asarray(wavelengths, float), self.wavelengths, self.values)

    def integral(self, low: float = FULL_RANGE[0], high: float = FULL_RANGE[1]) -> float:
        """Return the exact integral from low to high [nm], in [unit nm]."""
        return float(np.diff(self._cumulative(np.array([low, high])))[0])

    def in_bands(self, bands: Bands, kind: BandKind | Part = "averaged") -> FloatArray:
        """Return one value [unit] per band: its exact average, that of a part of it, or its centre's."""
        if isinstance(kind, Part):
            ends = bands.part(kind)
            return np.diff(self._cumulative(ends), axis=0)[0] / np.diff(ends, axis=0)[0]
        if kind == "centre":
            return self.at(bands.centres)
        return np.diff(self._cumulative(bands.edges)) / bands.widths

    def scaled(self, factor: float, unit: Unit | None = None) -> Spectrum:
        """Return the spectrum times a factor, in another unit if one is given."""
        return replace(self, values=self.values * factor, unit=unit or self.unit)

    def with_watts(self, watts: float) -> Spectrum:
        """
        Return this shape carrying a power.

        Parameters
        ----------
        watts : integral of the result over 360-830 nm [W]
        """
        whole = self.integral()
        if whole <= 0:
            raise ValueError("a spectrum that is zero everywhere cannot carry watts")
        return self.scaled(watts / whole, Unit.POWER)

    def _cumulative(self, places: FloatArray) -> FloatArray:
        """Return the integral from the lowest place to each place; exact, the lines are straight."""
        inside = (self.wavelengths > places.min()) & (self.wavelengths < places.max())
        knots = np.union1d(self.wavelengths[inside], places)
        heights = self.at(knots)
        steps = np.diff(knots) * (heights[1:] + heights[:-1]) / 2
        sums = np.concatenate([[0.0], np.cumsum(steps)])
        return sums[np.searchsorted(knots, places)]
