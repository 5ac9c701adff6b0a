"""Matte surfaces: f = reflectance / pi, on both sides."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ....scene.render_scene import IntArray, Material
from ....spectra import FloatArray
from ..directions import dot, normalised, sphere
from ..meeting import Meeting, Model, Onward, column
from ..tables import Palette


class Matte(Model):
    """Lambert's surfaces. Their spectrum is shared by all that they scatter; the rest is one number."""

    def __init__(self, materials: Sequence[Material], palette: Palette) -> None:
        self._reflectance = palette.colours(materials, "diffuseReflectance")
        self.plain = self._reflectance.plain

    def shared(self, met: Meeting) -> FloatArray:
        """Return the reflectance."""
        return self._reflectance.at(met)

    def evaluate(self, met: Meeting, rows: IntArray, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return cos / pi twice: it is the density of scattered() as well."""
        density = lobe(dot(met.places.normals, towards).take(rows))
        return column(density), density

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Return directions whose weight is thus the reflectance itself."""
        directions = scattered(met.places.normals, u, v)
        return Onward(directions, lobe(dot(met.places.normals, directions)))


def lobe(cosines: FloatArray) -> FloatArray:
    """Return f cos / reflectance [sr-1] of a matte surface: max(cos, 0) / pi."""
    return np.maximum(cosines, 0) / np.pi


def scattered(normals: FloatArray, u: FloatArray, v: FloatArray) -> FloatArray:
    """
    Return directions with density cos / pi about unit normals.

    An even point of the unit sphere that the surface touches from below, seen from the
    surface, is so distributed (Malley's method without the disc).
    """
    return normalised(normals + sphere(u, v))
