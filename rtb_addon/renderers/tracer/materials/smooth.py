"""Surfaces that scatter each ray into one other: mirrors, and holes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ....scene.render_scene import IntArray, Material
from ....spectra import FloatArray
from ..directions import dot
from ..meeting import Meeting, Model, Onward
from ..tables import Palette


class Single(Model):
    """What scatters into single directions has in common: a light is never in just that one."""

    single = True

    def evaluate(self, met: Meeting, rows: IntArray, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return 0 twice."""
        nothing = np.zeros(len(rows))
        return nothing[:, None], nothing


class Mirror(Single):
    """Perfect mirrors, on both sides, times a reflectance."""

    def __init__(self, materials: Sequence[Material], palette: Palette) -> None:
        self._reflectance = palette.colours(materials, "specularReflectance")
        self.plain = self._reflectance.plain

    def shared(self, met: Meeting) -> FloatArray:
        """Return the reflectance."""
        return self._reflectance.at(met)

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Return the mirrored directions."""
        return Onward(mirrored(met), only_one(met))


class Nothing(Single):
    """What masks let through: paths go straight on."""

    transmits = True

    def __init__(self, materials: Sequence[Material], palette: Palette) -> None:
        self.plain = np.ones((len(materials), len(palette.film.bands)), np.float32)

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Return the directions as they were."""
        return Onward(met.directions, only_one(met))


def mirrored(met: Meeting) -> FloatArray:
    """Return the directions of paths after a mirror in each place's shading normal."""
    normals = met.places.normals
    return met.directions - 2 * dot(met.directions, normals) * normals


def only_one(met: Meeting) -> FloatArray:
    """Return the densities of directions that are the only ones."""
    return np.full(len(met.row), np.inf)
