"""
Rough surfaces as many small mirrors, turned like those of a bumpy ellipsoid: long tails around a highlight.

GGX and Smith's masking as in Walter, Marschner, Li and Torrance, *Microfacet Models for Refraction through
Rough Surfaces*, 2007 (equations 33 and 34), with one roughness along each axis. Vectors are (3, n), along the
axes of their surface.
"""

from __future__ import annotations

import numpy as np

from ....spectra import FloatArray
from ..directions import cross, dot, normalised


def distribution(h: FloatArray, along: FloatArray, across: FloatArray) -> FloatArray:
    """
    Return how much mirror faces unit vectors h [sr-1], for roughnesses along and across; 0 below the surface.

    D = 1 / (pi a b ((hx/a)^2 + (hy/b)^2 + hz^2)^2).
    """
    stretched = (h[0] / along) ** 2 + (h[1] / across) ** 2 + h[2] ** 2
    return np.where(h[2] > 0, 1 / (np.pi * along * across * np.maximum(stretched, 1e-30) ** 2), 0)


def facets(
    back: FloatArray, u: FloatArray, v: FloatArray, along: FloatArray, across: FloatArray
) -> FloatArray:
    """
    Return unit vectors with density(): the mirrors in sight from back.

    Heitz, *Sampling the GGX Distribution of Visible Normals*, 2018: seen from there the ellipsoid is half a
    disc and half an ellipse, on which points are spread evenly.
    """
    seen = normalised(np.stack([along * back[0], across * back[1], back[2]]))
    level = np.hypot(seen[0], seen[1])
    flat = level < 1e-12
    first = np.stack([-seen[1], seen[0], np.zeros_like(level)]) / np.where(flat, 1, level)
    first = np.where(flat, [[1.0], [0.0], [0.0]], first)
    second = cross(seen, first)
    r, turn = np.sqrt(u), 2 * np.pi * v
    x, y = r * np.cos(turn), r * np.sin(turn)
    half = (1 + seen[2]) / 2
    y = (1 - half) * np.sqrt(1 - x**2) + half * y
    h = x * first + y * second + np.sqrt(np.maximum(1 - x**2 - y**2, 0)) * seen
    return normalised(np.stack([along * h[0], across * h[1], np.maximum(h[2], 1e-12)]))


def density(back: FloatArray, h: FloatArray, along: FloatArray, across: FloatArray) -> FloatArray:
    """Return the density of facets() at unit vectors h, D G1 (back.h) / cos [sr-1]."""
    # Isotropic masking is enough: the roughness that back sees is that of its own direction.
    level2 = np.maximum(back[0] ** 2 + back[1] ** 2, 1e-30)
    roughness = np.sqrt(((along * back[0]) ** 2 + (across * back[1]) ** 2) / level2)
    seen = unmasked(back, roughness) * np.maximum(dot(back, h), 0) / np.maximum(back[2], 1e-20)
    return np.where(back[2] > 0, seen * distribution(h, along, across), 0)


def unmasked(w: FloatArray, roughness: FloatArray) -> FloatArray:
    """Return the share of the small mirrors that unit vectors see, Smith's G1."""
    cosine2 = np.maximum(w[2] ** 2, 1e-30)
    return 2 / (1 + np.sqrt(1 + roughness**2 * np.maximum(1 - cosine2, 0) / cosine2))
