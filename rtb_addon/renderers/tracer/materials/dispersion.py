"""
Glass whose index of refraction depends on wavelength: every band sees an index of its own.

Where light is reflected to, and what goes straight on through a pane, is the same for all bands; only how
much of it there is differs, so that all bands share a path. Refraction sends each band another way:

- behind a smooth surface no two bands meet. A path goes on with one of them for all, N times as heavy: in
  every band that is right on average, for each of the N is chosen as often;
- a rough surface sends every band into every direction, some more than others. A path goes where one of the
  bands would, and all of them share it, weighed by how often they would on average have gone there.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ....scene.render_scene import IntArray, Material
from ....spectra import FloatArray
from ..meeting import Meeting, Onward, chosen
from ..tables import Palette
from . import fresnel
from .glass import Glass, ThinGlass
from .rough_glass import RoughGlass
from .smooth import only_one


class DispersingGlass(Glass):
    """Smooth surfaces of solid glass."""

    parts = True

    def _indices(self, materials: Sequence[Material], palette: Palette) -> FloatArray:
        return _per_band(materials, palette)

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Return reflected directions of all bands, or the refracted direction of one."""
        eta, (free, band) = _relative(self._eta, met), _one_band(met, v, self._eta.shape[1])
        reflectance, behind = fresnel.dielectric(met.back[2].clip(0, 1)[:, None], eta)
        chance = _chance(reflectance, free, band)
        back, _ = chosen(chance, u)
        one, behind = _of(eta, band), _of(behind, band)
        through = np.stack([-met.back[0] / one, -met.back[1] / one, -behind])
        local = np.where(back, met.back * [[-1.0], [-1.0], [1.0]], through)
        alone = (1 - _of(reflectance, band)) / np.maximum(1 - chance, 1e-30) / one**2
        only = np.zeros_like(reflectance)
        only[np.arange(len(band)), band] = np.where(free, alone * eta.shape[1], alone)
        weight = np.where(back[:, None], reflectance / np.maximum(chance, 1e-30)[:, None], only)
        density = np.where(back | (behind > 0), only_one(met), 0)
        onward = weight.astype(np.float32) * self._colour(met, back)
        return Onward(met.frame.world(local), density, onward, np.where(back & free, -1, band))


class DispersingThinGlass(ThinGlass):
    """Panes so thin that what goes through is not displaced."""

    def _indices(self, materials: Sequence[Material], palette: Palette) -> FloatArray:
        return _per_band(materials, palette)

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Return reflected directions, or those that go straight on, of all bands."""
        free, band = _one_band(met, v, self._eta.shape[1])
        once, _ = fresnel.dielectric(met.back[2].clip(0, 1)[:, None], self._eta[met.row])
        share = 2 * once / (1 + once)
        chance = _chance(share, free, band)
        back, _ = chosen(chance, u)
        local = np.where(back, met.back * [[-1.0], [-1.0], [1.0]], -met.back)
        taken = np.where(back, chance, 1 - chance)
        weight = np.where(back[:, None], share, 1 - share) / np.maximum(taken, 1e-30)[:, None]
        return Onward(
            met.frame.world(local), only_one(met), weight.astype(np.float32) * self._colour(met, back)
        )


class DispersingRoughGlass(RoughGlass):
    """Rough surfaces of solid glass."""

    def _indices(self, materials: Sequence[Material], palette: Palette) -> FloatArray:
        return _per_band(materials, palette)

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Choose a small surface, then whether it reflects one of the bands."""
        # The last 16 bits, as the first ones choose the surface.
        _, band = _one_band(met, u * 2.0**16 % 1, self._eta.shape[1])
        return self._scattered(met, u, v, _of(_relative(self._eta, met), band))

    def _evaluated(self, met: Meeting, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        eta = _relative(self._eta, met)
        count = eta.shape[1]
        each = np.repeat(np.arange(len(met.row)), count)
        ways = met.back.take(each, axis=1), towards.take(each, axis=1)
        gain, density = (
            one.reshape(-1, count)
            for one in self._lobes(*ways, eta.ravel(), self._roughness[met.row].take(each))
        )
        free, band = _one_band(met, np.zeros(len(met.row)), count)
        return gain.astype(np.float32) * self._colour(met, towards), _chance(density, free, band)


def _per_band(materials: Sequence[Material], palette: Palette) -> FloatArray:
    """Return the (materials, bands) indices inside per index outside."""
    inside, outside = (palette.rows(materials, name).astype(float) for name in ("intIOR", "extIOR"))
    return inside / outside


def _relative(eta: FloatArray, met: Meeting) -> FloatArray:
    """Return the (n, bands) indices behind each surface per index before it."""
    own = eta[met.row]
    return np.where(met.places.side[:, None] > 0, own, 1 / own)


def _one_band(met: Meeting, u: FloatArray, count: int) -> tuple[NDArray[np.bool_], IntArray]:
    """Return which paths are of all bands, and the band of each; numbers in [0, 1) choose it for those."""
    chosen_band = (u * count).astype(int)
    if met.band is None:
        return np.ones(len(u), bool), chosen_band
    free = met.band < 0
    return free, np.where(free, chosen_band, met.band)


def _of(values: FloatArray, band: IntArray) -> FloatArray:
    """Return the (n,) numbers of one band each, out of (n, bands)."""
    return values[np.arange(len(band)), band]


def _chance(values: FloatArray, free: NDArray[np.bool_], band: IntArray) -> FloatArray:
    """Return the (n,) means over all bands, or numbers of the one band that a path is of."""
    return np.where(free, values.mean(axis=1), _of(values, band))
