"""
Metals, on both sides: mirrors of many small mirrors, or of one.

f = F D G / (4 cos cos): Fresnel's reflectance of each band's index (fresnel.py), mirrors as in facets.py.
"""

from __future__ import annotations

from collections.abc import Sequence

from ....scene.render_scene import IntArray, Material
from ....spectra import FloatArray
from ..meeting import Meeting, Model, Onward, column, weighed
from ..tables import Palette, numbers
from . import facets, fresnel
from .smooth import Single, mirrored, only_one


class SmoothMetal(Single):
    """Polished metals."""

    def __init__(self, materials: Sequence[Material], palette: Palette) -> None:
        self._eta, self._k = palette.colours(materials, "eta"), palette.colours(materials, "k")

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Return the mirrored directions."""
        weight = fresnel.conductor(met.back[2].clip(0, 1), self._eta.at(met), self._k.at(met))
        return Onward(mirrored(met), only_one(met), weight)


class RoughMetal(Model):
    """Metals with a roughness."""

    def __init__(self, materials: Sequence[Material], palette: Palette) -> None:
        self._eta, self._k = palette.colours(materials, "eta"), palette.colours(materials, "k")
        self._roughness, self._slopes = numbers(materials, "roughness"), facets.slopes_of(materials)

    def evaluate(self, met: Meeting, rows: IntArray, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return F D G / (4 cos), and the density of scattered()."""
        some = met.only(rows)
        return self._evaluated(some, some.frame.local(towards.take(rows, axis=1)))

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Choose a small mirror."""
        towards = facets.mirrored(self._slopes, met.back, u, v, self._roughness[met.row])
        value, density = self._evaluated(met, towards)
        return Onward(met.frame.world(towards), density, weighed(value, density))

    def _evaluated(self, met: Meeting, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        gain, density, cosine = facets.reflection(self._slopes, met.back, towards, self._roughness[met.row])
        reflectance = fresnel.conductor(cosine.clip(0, 1), self._eta.at(met), self._k.at(met))
        return column(gain) * reflectance, density
