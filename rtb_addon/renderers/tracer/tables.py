"""Spectra as the tracer computes with them: a row each, a column per band."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...errors import RenderingError
from ...scene.render_scene import Film
from ...spectra import FloatArray, Spectrum

# Products of a light and a few distances must stay within single precision.
_LARGEST = 1e30


def table(named: Sequence[tuple[str, object]], film: Film) -> FloatArray:
    """
    Return the (spectra, bands) float32 band values of spectra or plain numbers.

    Each comes with what it is called in the RenderingError that names one with numbers that cannot be.
    """
    rows = np.zeros((len(named), len(film.bands)))
    for row, (name, value) in zip(rows, named, strict=True):
        spectrum = value if isinstance(value, Spectrum) else Spectrum.constant(float(value))  # type: ignore[arg-type]
        row[:] = spectrum.in_bands(film.bands, film.band_kind)
        if wrong := [band for band in range(len(row)) if not 0 <= row[band] < _LARGEST]:
            place = f"{row[wrong[0]]:g} at {film.bands.centres[wrong[0]]:g} nm"
            raise RenderingError(f"{name} is {place}, give numbers from 0 to {_LARGEST:g}")
    return rows.astype(np.float32)
