"""Light sources that have a formula: CIE daylight and the blackbody."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np

from .bands import FloatArray
from .spectrum import FULL_RANGE, Spectrum, Unit

_DATA = Path(__file__).parents[1] / "data"
DAYLIGHTS = (4000.0, 25000.0)  # [K]

# The SI's defining constants: Planck [J s], speed of light [m s-1], Boltzmann [J K-1].
_PLANCK, _LIGHT, _BOLTZMANN = 6.62607015e-34, 299792458.0, 1.380649e-23


def daylight(kelvin: float) -> Spectrum:
    """
    Return CIE daylight of a correlated colour temperature, relative, 100 at 560 nm.

    Parameters
    ----------
    kelvin : 4000 to 25000 [K], where the CIE defines it

    Notes
    -----
    CIE 15:2018, section 4.1.2. D65 is daylight(6504), not 6500: the D illuminants were named before the
    constant c2 changed.
    """
    if not DAYLIGHTS[0] <= kelvin <= DAYLIGHTS[1]:
        raise ValueError(f"daylight of {kelvin:g} K is not defined, want 4000 to 25000 K")
    x = _chromaticity_x(kelvin)
    y = -3.000 * x**2 + 2.870 * x - 0.275
    scale = 0.0241 + 0.2562 * x - 0.7341 * y
    first = round((-1.3515 - 1.7703 * x + 5.9114 * y) / scale, 3)
    second = round((0.0300 - 31.4424 * x + 30.0717 * y) / scale, 3)
    wavelengths, mean, blue_yellow, green_pink = daylight_basis()
    return Spectrum(wavelengths, mean + first * blue_yellow + second * green_pink, Unit.SHAPE)


def blackbody(kelvin: float) -> Spectrum:
    """
    Return the spectral radiance of a blackbody [W sr-1 m-2 nm-1], sampled at every nanometre.

    Parameters
    ----------
    kelvin : temperature [K]
    """
    if not 0 < kelvin < np.inf:
        raise ValueError(f"a blackbody of {kelvin:g} K does not shine, want a temperature above 0 K")
    nanometres = np.arange(FULL_RANGE[0], FULL_RANGE[1] + 1)
    metres = nanometres * 1e-9
    with np.errstate(over="ignore"):  # a cold body's exponential may pass the largest number: radiance 0
        bosons = 1 / np.expm1(_PLANCK * _LIGHT / (metres * _BOLTZMANN * kelvin))
    return Spectrum(nanometres, 2e-9 * _PLANCK * _LIGHT**2 / metres**5 * bosons, Unit.RADIANCE)


@cache
def daylight_basis() -> FloatArray:
    """Return the CIE's wavelengths [nm] and components S0, S1 and S2 of daylight, as (4, samples)."""
    table = np.loadtxt(_DATA / "daylight_basis.csv", delimiter=",", comments="#").T
    table.flags.writeable = False
    return table


def _chromaticity_x(kelvin: float) -> float:
    inverse = 1000 / kelvin
    if kelvin <= 7000:
        return ((-4.6070 * inverse + 2.9678) * inverse + 0.09911) * inverse + 0.244063
    return ((-2.0064 * inverse + 1.9018) * inverse + 0.24748) * inverse + 0.237040
