"""
Rough surfaces as many small mirrors whose slopes are normally distributed.

Beckmann's distribution and Smith's masking as in Walter, Marschner, Li and Torrance, *Microfacet Models for
Refraction through Rough Surfaces*, 2007 (equations 25 to 30), with one roughness along each axis.
Vectors are (3, n), along the axes of their surface.
"""

from __future__ import annotations

import numpy as np

from ....spectra import FloatArray


def distribution(h: FloatArray, along: FloatArray, across: FloatArray) -> FloatArray:
    """
    Return how much mirror faces unit vectors h [sr-1], for roughnesses along and across; 0 below the surface.

    D = exp(-((hx/a)^2 + (hy/b)^2) / hz^2) / (pi a b hz^4).
    """
    squared = np.maximum(h[2], 1e-20) ** 2
    slope = ((h[0] / along) ** 2 + (h[1] / across) ** 2) / squared
    return np.where(h[2] > 0, np.exp(-slope) / (np.pi * along * across * squared**2), 0)


def facets(
    back: FloatArray, u: FloatArray, v: FloatArray, along: FloatArray, across: FloatArray
) -> FloatArray:
    """Return unit vectors with density(): normally distributed slopes, those out of sight from back, too."""
    slope = np.sqrt(-np.log1p(-u))
    turn = 2 * np.pi * v
    h = np.stack([along * slope * np.cos(turn), across * slope * np.sin(turn), np.ones_like(u)])
    return h / np.sqrt(h[0] ** 2 + h[1] ** 2 + 1)


def density(back: FloatArray, h: FloatArray, along: FloatArray, across: FloatArray) -> FloatArray:
    """Return the density of facets() at unit vectors h, D hz [sr-1]."""
    return distribution(h, along, across) * h[2]


def unmasked(w: FloatArray, roughness: FloatArray) -> FloatArray:
    """Return the share of the small mirrors that unit vectors see, Smith's G1 in Walter's rational form."""
    cosine = np.abs(w[2])
    tangent = np.sqrt(np.maximum(1 - cosine**2, 0)) / np.maximum(cosine, 1e-20)
    a = 1 / np.maximum(roughness * tangent, 1e-20)
    fitted = (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a)
    return np.where(a < 1.6, fitted, 1.0)
