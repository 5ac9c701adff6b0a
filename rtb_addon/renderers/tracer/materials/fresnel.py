"""
How much light smooth surfaces reflect, unpolarised: Fresnel's equations.

As in Born and Wolf, *Principles of Optics*, sections 1.5 and 14.2.
"""

from __future__ import annotations

import numpy as np

from ....spectra import FloatArray


def dielectric(cosine: FloatArray, eta: FloatArray) -> tuple[FloatArray, FloatArray]:
    """
    Return the reflectance of a clear surface and the cosine behind it; 1 and 0 where all is reflected.

    Parameters
    ----------
    cosine : of the angle of incidence, 0 to 1
    eta : index behind the surface per index before it
    """
    squared = 1 - (1 - cosine**2) / eta**2
    behind = np.sqrt(np.maximum(squared, 0))
    across = (cosine - eta * behind) / np.maximum(cosine + eta * behind, 1e-30)
    along = (eta * cosine - behind) / np.maximum(eta * cosine + behind, 1e-30)
    return np.where(squared > 0, (across**2 + along**2) / 2, 1.0), behind


def conductor(cosine: FloatArray, eta: FloatArray, k: FloatArray) -> FloatArray:
    """
    Return the (n, bands) float32 reflectance of a metal.

    Parameters
    ----------
    cosine : (n,) of the angle of incidence, 0 to 1
    eta, k : (n, bands) index of refraction and of extinction, per that of the air before
    """
    c = cosine.astype(np.float32)[:, None]
    cos2, sin2 = c * c, 1 - c * c
    difference = eta * eta - k * k - sin2
    both = np.sqrt(difference * difference + 4 * (eta * k) ** 2)
    twice = 2 * c * np.sqrt(np.maximum((both + difference) / 2, 0))
    # Whatever the index, nothing is divided by nothing.
    tiny = np.float32(1e-30)
    across = (both + cos2 - twice) / (both + cos2 + twice + tiny)
    low, high = both * cos2 + sin2 * sin2, twice * sin2
    return across * (1 + (low - high) / (low + high + tiny)) / 2


def diffuse(eta: FloatArray) -> FloatArray:
    """
    Return the reflectance of a clear surface for light from all sides.

    Below 1, from inside, the fit of Egan and Hilgeman, *Optical Properties of Inhomogeneous Materials*, 1973;
    above 1 that of d'Eon and Irving, *A Quantized-Diffusion Model*, 2011; Mitsuba takes them, too. Both are
    good to 0.2 % for the indices of plastics.
    """
    inverse = 1 / eta
    inside = -1.4399 * eta**2 + 0.7099 * eta + 0.6681 + 0.0636 * inverse
    outside = np.polyval([-1.36881, 4.98554, -7.80989, 6.75335, -3.4793, 0.919317], inverse)
    return np.where(eta < 1, inside, outside)
