"""
Plastics, on both sides: a diffuse body under a clear coat, smooth or rough.

Light enters the coat, is scattered by the body, goes back and forth between body and coat, and leaves:

    f = F D G / (4 cos cos) + T(cos_i) T(cos_o) diffuse / (pi eta^2 (1 - inside)),

where T is what the coat lets in from a direction and ``inside`` what it reflects of the body's light. These
are the models of Mitsuba 3's plastic and roughplastic with ``nonlinear`` off: inside counts as if
the body were white between the first and the last time.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence

import numpy as np

from ....scene.render_scene import IntArray, Material
from ....spectra import FloatArray
from ..meeting import Meeting, Model, Onward, chosen, column, weighed
from ..tables import Palette, numbers
from . import facets, fresnel
from .coat import Coats
from .matte import lobe, scattered
from .smooth import mirrored


class _Plastic(Model):
    """What smooth and rough plastics share."""

    def __init__(self, materials: Sequence[Material], palette: Palette) -> None:
        self._eta = numbers(materials, "intIOR") / numbers(materials, "extIOR")
        self._diffuse = palette.colours(materials, "diffuseReflectance")

    def evaluate(self, met: Meeting, rows: IntArray, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return f cos, without a smooth coat's reflection, and the density of scattered()."""
        some = met.only(rows)
        return self._evaluated(some, some.frame.local(towards.take(rows, axis=1)))

    @abstractmethod
    def _evaluated(self, met: Meeting, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return f cos and the density for directions in the surface's own frame."""


class Plastic(_Plastic):
    """Smooth plastics."""

    def __init__(self, materials: Sequence[Material], palette: Palette) -> None:
        super().__init__(materials, palette)
        self._body = 1 / (self._eta**2 * (1 - fresnel.diffuse(1 / self._eta)))

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Be reflected by the coat as often as it reflects, else by the body."""
        coat, u = chosen(self._reflected(met, met.back), u)
        directions = np.where(coat, mirrored(met), scattered(met.places.normals, u, v))
        value, density = self._evaluated(met, met.frame.local(directions))
        weight = np.where(coat[:, None], np.float32(1), weighed(value, density))
        return Onward(directions, np.where(coat, np.inf, density), weight)

    def _evaluated(self, met: Meeting, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        entering = 1 - self._reflected(met, met.back)
        leaving = 1 - self._reflected(met, towards)
        matte = lobe(towards[2]) * (met.back[2] > 0)
        gain = self._body[met.row] * entering * leaving * matte
        return column(gain) * self._diffuse.at(met), entering * matte

    def _reflected(self, met: Meeting, way: FloatArray) -> FloatArray:
        return fresnel.dielectric(way[2].clip(0, 1), self._eta[met.row])[0]


class RoughPlastic(_Plastic):
    """Plastics whose coat is rough."""

    def __init__(self, materials: Sequence[Material], palette: Palette) -> None:
        super().__init__(materials, palette)
        self._roughness, self._slopes = numbers(materials, "roughness"), facets.slopes_of(materials)
        self._coats = Coats(self._eta, self._roughness, self._slopes)
        self._body = 1 / (self._eta**2 * (1 - self._coats.inside))

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Be reflected by the coat about as often as it reflects, else by the body."""
        coat, u = chosen(self._chance(met), u)
        directions = np.where(
            coat,
            met.frame.world(facets.mirrored(self._slopes, met.back, u, v, self._roughness[met.row])),
            scattered(met.places.normals, u, v),
        )
        value, density = self._evaluated(met, met.frame.local(directions))
        return Onward(directions, density, weighed(value, density))

    def _evaluated(self, met: Meeting, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        gain, density, cosine = facets.reflection(self._slopes, met.back, towards, self._roughness[met.row])
        gain = gain * fresnel.dielectric(cosine.clip(0, 1), self._eta[met.row])[0]
        matte = lobe(towards[2]) * (met.back[2] > 0)
        through = self._coats.transmitted(met.row, met.back[2]) * self._coats.transmitted(met.row, towards[2])
        value = column(self._body[met.row] * through * matte) * self._diffuse.at(met) + column(gain)
        chance = self._chance(met)
        return value, chance * density + (1 - chance) * matte

    def _chance(self, met: Meeting) -> FloatArray:
        """Return how often the coat is sampled: never too seldom for a highlight to be found."""
        return np.maximum(1 - self._coats.transmitted(met.row, met.back[2]), 0.1)
