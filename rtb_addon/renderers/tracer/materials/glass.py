"""
Glass: light is reflected or goes through, by Fresnel's equations.

What is behind a surface is seen 1 / eta^2 as bright, for a cone of directions is as much narrower
there; on the way out the glass gives it back. Which of the two a path does is chosen as often as it happens.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ....scene.render_scene import Material
from ....spectra import FloatArray
from ..meeting import Meeting, Onward, chosen, column
from ..tables import Palette, numbers
from . import fresnel
from .smooth import Single, only_one


class _Smooth(Single):
    """What smooth kinds of glass share: two indices, and a colour for either way."""

    transmits = True

    def __init__(self, materials: Sequence[Material], palette: Palette) -> None:
        self._eta = self._indices(materials, palette)
        self._reflectance = palette.colours(materials, "specularReflectance")
        self._transmittance = palette.colours(materials, "specularTransmittance")

    def _indices(self, materials: Sequence[Material], palette: Palette) -> FloatArray:
        """Return the (materials,) indices inside per index outside."""
        return numbers(materials, "intIOR") / numbers(materials, "extIOR")

    def _colour(self, met: Meeting, reflected: NDArray[np.bool_]) -> FloatArray:
        return np.where(reflected[:, None], self._reflectance.at(met), self._transmittance.at(met))


class Glass(_Smooth):
    """Smooth surfaces of solid glass."""

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Return reflected or refracted directions (Snell's law)."""
        eta, cosine = relative(self._eta, met), met.back[2].clip(0, 1)
        reflectance, behind = fresnel.dielectric(cosine, eta)
        back, _ = chosen(reflectance, u)
        through = np.stack([-met.back[0] / eta, -met.back[1] / eta, -behind])
        local = np.where(back, met.back * [[-1.0], [-1.0], [1.0]], through)
        weight = column(np.where(back, 1, 1 / eta**2)) * self._colour(met, back)
        return Onward(met.frame.world(local), only_one(met), weight)


class ThinGlass(_Smooth):
    """Panes so thin that what goes through is not displaced; light goes back and forth inside."""

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Return reflected directions, or those that go straight on."""
        once, _ = fresnel.dielectric(met.back[2].clip(0, 1), self._eta[met.row])
        # r + (1 - r)^2 r (1 + r^2 + r^4 ...)
        back, _ = chosen(2 * once / (1 + once), u)
        local = np.where(back, met.back * [[-1.0], [-1.0], [1.0]], -met.back)
        return Onward(met.frame.world(local), only_one(met), self._colour(met, back))


def relative(eta: FloatArray, met: Meeting) -> FloatArray:
    """Return the index behind each surface per index before it, from the materials' inside per outside."""
    return np.where(met.places.side > 0, eta[met.row], 1 / eta[met.row])
