"""How observers weigh light of each wavelength, and the colours that lights are tested with: small tables."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np

from .spectra import Bands, FloatArray

_DATA = Path(__file__).parent / "data"
CONES = ("L", "M", "S")


def cie_1931() -> tuple[FloatArray, FloatArray]:
    """Return wavelengths [nm] and CIE 1931 2 degree functions, (wavelengths, 3), at every nanometre."""
    return _table("cie_1931.csv")


def test_colours() -> tuple[FloatArray, FloatArray]:
    """Return wavelengths [nm] and reflectances of the CIE's colours for testing lights, (wavelengths, 14)."""
    return _table("test_colours.csv")


def matching_functions(bands: Bands) -> FloatArray:
    """Return CIE 1931 2 degree functions at the bands' centres, (bands, 3); 0 outside 360-830 nm."""
    return _at_centres(bands, *cie_1931())


def cone_fundamentals(bands: Bands) -> FloatArray:
    """
    Return how sensitive L, M and S cones are at the bands' centres, (bands, 3); 0 outside 390-830 nm.

    Notes
    -----
    To energy, not to quanta; Stockman and Sharpe's for 2 degrees (CIE 170-1:2006), each 1 at its highest.
    """
    return _at_centres(bands, *_table("cones.csv"))


def lms(radiance: FloatArray, bands: Bands) -> FloatArray:
    """
    Return what the cones catch: radiance weighed by their sensitivities and summed over wavelength.

    Parameters
    ----------
    radiance : (..., bands) array [W sr-1 m-2 nm-1]

    Returns
    -------
    (..., 3) array [W sr-1 m-2] : L, M, S
    """
    return radiance @ (cone_fundamentals(bands) * bands.widths[:, None])


def _at_centres(bands: Bands, wavelengths: FloatArray, functions: FloatArray) -> FloatArray:
    columns = [np.interp(bands.centres, wavelengths, column, left=0, right=0) for column in functions.T]
    return np.stack(columns, axis=1)


@cache
def _table(name: str) -> tuple[FloatArray, FloatArray]:
    """Return wavelengths [nm] and the functions beside them, (wavelengths, functions)."""
    table = np.loadtxt(_DATA / name, delimiter=",", comments="#")
    table.flags.writeable = False
    return table[:, 0], table[:, 1:]
