"""
Fluorescent surfaces: matte, but light comes back in other bands than it came in, too.

What such a surface sends towards the camera in each band is a sum over all bands of the light that it gets,
so that a path would carry a matrix from here on. Instead it goes on with one of the bands that excite the
surface, chosen by their shares, and counts what it finds there in all bands that it excites. What comes back
as it came needs no such choice, and of light that comes straight from a lamp the sum is taken as it stands.

Bands that excite are needed where the film has none, too: a scene has more bands than are seen.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ....scene.render_scene import IntArray, Material, RenderScene
from ....spectra import Bands, FloatArray
from ....spectra.donaldson import read_donaldson
from ..directions import dot
from ..meeting import Meeting, Model, Onward, chosen, column
from ..tables import Palette
from .matte import lobe, scattered

# Neither what comes back as it came nor what does not is looked for more seldom, where there is any.
_SELDOM = 0.1


class Fluorescent(Model):
    """
    Fluorescent surfaces, on both sides.

    Tables have a row for each band that a path may be of, and a last one for paths of all bands.
    """

    parts = True

    def __init__(self, materials: Sequence[Material], palette: Palette) -> None:
        film = palette.film
        found = [read_donaldson(Path(str(one.parameters["filename"]))) for one in materials]
        pairs = [one.in_bands(film.bands, film.band_kind) for one in found]
        self._plain = np.array([plain for plain, _ in pairs])
        self._turned = np.array([turned for _, turned in pairs])
        whole = self._turned + np.array([np.diag(plain) for plain in self._plain])
        self._whole = whole.astype(np.float32)
        # How much of the light that a path stands for comes back from each band, and as it came.
        excited = np.concatenate([self._turned, self._turned.sum(axis=1, keepdims=True)], axis=1)
        plain = np.concatenate([self._plain, self._plain.sum(axis=1, keepdims=True)], axis=1)
        total = excited.sum(axis=2)
        share = plain / np.where(plain + total > 0, plain + total, 1)
        self._share = np.where((plain > 0) & (total > 0), share.clip(_SELDOM, 1 - _SELDOM), share)
        self._lost = plain + total <= 0
        self._chance = excited / np.where(total > 0, total, 1)[..., None]
        self._sums = np.cumsum(self._chance, axis=2)

    def evaluate(self, met: Meeting, rows: IntArray, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return cos / pi twice, as of a matte surface; turned() knows the rest."""
        density = lobe(dot(met.places.normals, towards).take(rows))
        return column(density), density

    def turned(self, met: Meeting, rows: IntArray, light: FloatArray) -> FloatArray:
        """Return the sums over all bands."""
        out, material = np.empty_like(light), met.row.take(rows)
        for number in np.unique(material):
            its = np.nonzero(material == number)[0]
            out[its] = light[its] @ self._whole[number].T
        return out

    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Return directions of a matte surface, in all bands or in one that excites."""
        band = np.full(len(u), -1) if met.band is None else met.band
        share = self._share[met.row, band]
        as_it_came, u = chosen(share, u)
        exciting, chance, u = self._exciting(met.row, band, as_it_came, u)
        turned = self._turned[met.row, :, exciting] / np.maximum((1 - share) * chance, 1e-30)[:, None]
        plain = self._plain[met.row] / np.maximum(share, 1e-30)[:, None]
        weight = np.where(as_it_came[:, None], plain, turned).astype(np.float32)
        directions = scattered(met.places.normals, u, v)
        density = np.where(self._lost[met.row, band], 0, lobe(dot(met.places.normals, directions)))
        return Onward(directions, density, weight, np.where(as_it_came, band, exciting))

    def _exciting(
        self, row: IntArray, band: IntArray, as_it_came: NDArray[np.bool_], u: FloatArray
    ) -> tuple[IntArray, FloatArray, FloatArray]:
        """Return bands that excite, how often each is chosen, and random numbers that are left."""
        sums = self._sums[row, band]
        place = np.arange(len(u))
        exciting = np.minimum((u[:, None] >= sums).sum(axis=1), sums.shape[1] - 1)
        chance = self._chance[row, band, exciting]
        below = sums[place, exciting] - chance
        rest = ((u - below) / np.where(chance > 0, chance, 1)).clip(0, 1 - 2.0**-53)
        return exciting, chance, np.where(as_it_came, u, rest)


def widened(scene: RenderScene) -> tuple[RenderScene, slice]:
    """Return a scene with all bands that excite something in it, and which of them are the film's."""
    files = [one.parameters["filename"] for one in scene.materials.values() if one.model == "fluorescent"]
    exciting = [found for file in files if (found := read_donaldson(Path(str(file))).exciting)]
    if not exciting:
        return scene, slice(None)
    bands = scene.film.bands
    ends = min(low for low, _ in exciting), max(high for _, high in exciting)
    before = _more(bands.edges[0] - ends[0], bands.widths[0])
    after = _more(ends[1] - bands.edges[-1], bands.widths[-1])
    low = bands.edges[0] - bands.widths[0] * np.arange(before, 0, -1)
    high = bands.edges[-1] + bands.widths[-1] * np.arange(1, after + 1)
    centres = low + bands.widths[0] / 2, bands.centres, high - bands.widths[-1] / 2
    wide = Bands(np.concatenate(centres), np.concatenate([low, bands.edges, high]))
    return replace(scene, film=replace(scene.film, bands=wide)), slice(before, before + len(bands))


def _more(missing: float, width: float) -> int:
    """Return how many bands of a width reach over what is missing [nm]."""
    return max(int(np.ceil(missing / width - 1e-9)), 0)
