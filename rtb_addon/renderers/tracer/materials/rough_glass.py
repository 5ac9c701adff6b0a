"""
Rough glass: many small clear surfaces, distributed like the mirrors of facets.py.

Walter, Marschner, Li and Torrance, *Microfacet Models for Refraction through Rough Surfaces*, 2007, equations
16 to 21 and 38 to 41; what is behind is 1 / eta^2 as bright (see glass.py).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ....scene.render_scene import IntArray, Material
from ....spectra import FloatArray
from ..directions import dot, normalised
from ..meeting import Meeting, Model, Onward, chosen, column, weighed
from ..tables import Palette, numbers
from . import facets, fresnel
from .glass import relative


class RoughGlass(Model):
    """Rough surfaces of solid glass."""

    transmits = True

    def __init__(self, materials: Sequence[Material], palette: Palette) -> None:
        self._eta = self._indices(materials, palette)
        self._roughness, self._slopes = numbers(materials, "roughness"), facets.slopes_of(materials)
        self._reflectance = palette.colours(materials, "specularReflectance")
        self._transmittance = palette.colours(materials, "specularTransmittance")

    def evaluate(self, met: Meeting, rows: IntArray, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return f cos, and the density of scattered()."""
        some = met.only(rows)
        return self._evaluated(some, some.frame.local(towards.take(rows, axis=1)))

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Choose a small surface, then whether it reflects."""
        return self._scattered(met, u, v, relative(self._eta, met))

    def _indices(self, materials: Sequence[Material], palette: Palette) -> FloatArray:
        """Return the (materials,) indices inside per index outside."""
        return numbers(materials, "intIOR") / numbers(materials, "extIOR")

    def _scattered(self, met: Meeting, u: FloatArray, v: FloatArray, eta: FloatArray) -> Onward:
        alpha = self._roughness[met.row]
        h = self._slopes.facets(met.back, u, v, alpha, alpha)
        cosine = dot(met.back, h)
        reflectance, behind = fresnel.dielectric(cosine.clip(0, 1), eta)
        # The last 16 bits say which, the first ones turned the surface.
        back, _ = chosen(reflectance, v * 2.0**16 % 1)
        towards = np.where(back, 2 * cosine * h - met.back, (cosine / eta - behind) * h - met.back / eta)
        towards = np.where(cosine > 0, towards, [[0.0], [0.0], [1.0]])
        value, density = self._evaluated(met, towards)
        # A small surface that faces away has no path go on, nor has one whose light leaves on the wrong side.
        density = np.where((cosine > 0) & (back == (towards[2] > 0)), density, 0)
        return Onward(met.frame.world(towards), density, weighed(value, density))

    def _evaluated(self, met: Meeting, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        gain, density = self._lobes(met.back, towards, relative(self._eta, met), self._roughness[met.row])
        return column(gain) * self._colour(met, towards), density

    def _colour(self, met: Meeting, towards: FloatArray) -> FloatArray:
        reflected = (towards[2] > 0)[:, None]
        return np.where(reflected, self._reflectance.at(met), self._transmittance.at(met))

    def _lobes(
        self, back: FloatArray, towards: FloatArray, eta: FloatArray, alpha: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return f cos without a colour, and the density, along the axes of the surfaces."""
        reflected = towards[2] > 0
        h = normalised(back + np.where(reflected, 1, eta) * towards)
        h = np.where(h[2] < 0, -h, h)
        before, after = dot(back, h), dot(towards, h)
        seen = (back[2] > 0) & (before > 0) & (np.where(reflected, after, -after) > 0)
        share, _ = fresnel.dielectric(before.clip(0, 1), eta)
        share = np.where(reflected, share, 1 - share)
        # How many directions one small surface's slope stands for: the Jacobian of h.
        spread = np.where(reflected, 1 / np.where(seen, 4 * after, 1), _refracted(before, after, eta, seen))
        part = seen * share * np.abs(spread)
        masked = self._slopes.unmasked(back, alpha) * self._slopes.unmasked(towards, alpha)
        d = self._slopes.distribution(h, alpha, alpha)
        gain = part * d * masked * before / np.where(seen, back[2], 1) / np.where(reflected, 1, eta**2)
        return gain, part * self._slopes.density(back, h, alpha, alpha)


def _refracted(before: FloatArray, after: FloatArray, eta: FloatArray, seen: FloatArray) -> FloatArray:
    """Return the Jacobian of refraction, eta^2 |towards.h| / (back.h + eta towards.h)^2."""
    total = np.where(seen, before + eta * after, 1)
    return eta**2 * after / np.where(np.abs(total) > 1e-12, total, 1) ** 2
