"""
Surfaces of many small mirrors: what they reflect, however their slopes are distributed.

Torrance and Sparrow, *Theory for Off-Specular Reflection from Roughened Surfaces*, 1967. Vectors are (3, n),
along the axes of their surface.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np

from ....scene.render_scene import Material
from ....spectra import FloatArray
from ..directions import dot, normalised
from . import beckmann, ggx


class Slopes(Protocol):
    """A distribution of small mirrors, by their unit normals h; see beckmann.py and ggx.py."""

    def distribution(self, h: FloatArray, along: FloatArray, across: FloatArray) -> FloatArray: ...

    def facets(
        self, back: FloatArray, u: FloatArray, v: FloatArray, along: FloatArray, across: FloatArray
    ) -> FloatArray: ...

    def density(
        self, back: FloatArray, h: FloatArray, along: FloatArray, across: FloatArray
    ) -> FloatArray: ...

    def unmasked(self, w: FloatArray, roughness: FloatArray) -> FloatArray: ...


SLOPES: Mapping[str, Slopes] = {"beckmann": beckmann, "ggx": ggx}


def slopes_of(materials: Sequence[Material]) -> Slopes:
    """Return the distribution that materials of one kind have in common."""
    return SLOPES[str(materials[0].parameters.get("distribution", "beckmann"))]


def mirrored(
    slopes: Slopes, back: FloatArray, u: FloatArray, v: FloatArray, roughness: FloatArray
) -> FloatArray:
    """Return where small mirrors send what comes from back; reflection() knows the density."""
    h = slopes.facets(back, u, v, roughness, roughness)
    return 2 * dot(back, h) * h - back


def reflection(
    slopes: Slopes, back: FloatArray, towards: FloatArray, roughness: FloatArray
) -> tuple[FloatArray, ...]:
    """
    Return how perfect small mirrors reflect.

    Three (n,) arrays: f cos = D G / (4 cos), the density of mirrored() [sr-1], and the cosine of the
    angle at which the mirrors are met. All three are 0 where a direction is below the surface.
    """
    seen = (back[2] > 0) & (towards[2] > 0)
    h = normalised(np.where(seen, back + towards, [[0.0], [0.0], [1.0]]))
    d = seen * slopes.distribution(h, roughness, roughness)
    cosine = seen * dot(back, h)
    masked = slopes.unmasked(back, roughness) * slopes.unmasked(towards, roughness)
    gain = d * masked / (4 * np.where(seen, back[2], 1))
    density = seen * slopes.density(back, h, roughness, roughness)
    return gain, density / (4 * np.where(cosine > 0, cosine, 1)), cosine
