"""
A picture of spectra all around the scene, most of its light looked for where it is bright.

Blender's equirectangular way: a unit direction (x, y, z) of the picture's own frame, Z up, is seen at
u = 1/2 - atan2(y, x) / (2 pi) and v = 1/2 + atan2(z, hypot(x, y)) / pi, V up. Texels are their middles, and
fade into each other along straight lines: all around, but not beyond the poles.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ....scene.render_scene import Film, IntArray, Light
from ....spectra import FloatArray
from ...pictures import read_picture, sky_gamma
from ..directions import length
from ..textures import around
from .groups import Sample

# How texels go on across the picture and down it.
_WRAPS = "repeat", "clamp"


class Skies:
    """
    The environment as a kind of light: one picture, or none at all.

    Directions are drawn as if every texel were a tent, as wide as two texels, of the light that its middle
    has. Such tents add up to the straight lines between texels; so the density is, up to the cosine of the
    elevation, what is seen, and never 0 where anything is.

    Parameters
    ----------
    light : the environment; without a picture there is nothing to look for
    row : the environment's row in Lights.spectra
    radius : of a sphere around the scene [m]

    Attributes
    ----------
    grey : the (bands,) spectrum that the whole picture has, up to its brightness; None where it has colours
    """

    grey: FloatArray | None = None

    def __init__(self, light: Light | None, film: Film, row: int, radius: float) -> None:
        file = "" if light is None else str(light.parameters.get("filename", ""))
        self.rows = np.full(int(bool(file)), row)
        self.powers: FloatArray = np.zeros(len(self.rows))
        if light is None or not file:
            return
        picture = read_picture(Path(file), sky_gamma(Path(file)))
        self._height, self._width, channels = picture.texels.shape
        self._texels = picture.texels.reshape(-1, channels)
        self._weights = picture.weights(film.bands, film.band_kind).astype(np.float32)
        self._turn = light.to_world[:3, :3] / length(light.to_world[:3, :3])
        if not np.ptp(self._texels, axis=1).any():
            self.grey = self._weights.sum(axis=0)
        self._plan()
        self.powers[0] = np.pi * radius**2 * self._whole

    def radiance(self, directions: FloatArray) -> FloatArray:
        """Return the (n, bands) float32 radiance, per intensity, that comes from unit directions."""
        x, y, _ = self._place(directions)
        return self._mixed(self._texels, x, y) @ self._weights

    def seen(self, directions: FloatArray) -> tuple[FloatArray, FloatArray]:
        """
        Return what (3, n) unit directions show, two arrays of n.

        Returns
        -------
        brightness : of a grey picture, without its spectrum; 1 of one with colours
        density : with which sample() draws these directions [sr-1]
        """
        x, y, cosine = self._place(directions)
        brightness, tents = self._mixed(self._planned, x, y).T
        return brightness, tents / cosine

    def sample(self, which: IntArray, points: FloatArray, u: FloatArray, v: FloatArray) -> Sample:
        """Draw a row, then a texel of that row, then a place in its tent."""
        row, v = self._rows.draw(np.zeros(len(v), int), v)
        column, u = self._columns.draw(row, u)
        # Beyond the first and last row a tent folds back: there the picture goes on as it is at its edge.
        y = row + 0.5 + _tent(v)
        y = np.where(y > self._height, 2 * self._height - y, np.abs(y))
        directions = self._direction((column + 0.5 + _tent(u)) / self._width, y / self._height)
        ones, (strength, density) = np.ones(len(u), np.float32), self.seen(directions)
        return Sample(directions, 1e30 * ones, self.rows[which], strength, density, ones)

    def _plan(self) -> None:
        """Fix how often each texel is drawn: by its light, all bands together, and the sky that it fills."""
        elevation = np.pi * (0.5 - (np.arange(self._height) + 0.5) / self._height)
        angle = np.cos(elevation)[:, None] * 2 * np.pi**2 / (self._height * self._width)
        seen = (self._texels @ self._weights).mean(axis=1, dtype=float).reshape(self._height, self._width)
        light = seen * angle
        self._whole = light.sum()
        if not self._whole:
            light = np.ones_like(light)
        self._rows, self._columns = _Chances(light.sum(axis=1)[None]), _Chances(light)
        # What is drawn per texel, per its share of the angle without the cosine.
        share = light / light.sum() * (self._height * self._width) / (2 * np.pi**2)
        bright = np.ones(light.size) if self.grey is None else self._texels[:, 0]
        self._planned = np.stack([bright, share.ravel()], axis=1).astype(np.float32)

    def _mixed(self, texels: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return the texels around each place, mixed."""
        mixed = np.zeros((len(x), texels.shape[1]), texels.dtype)
        for number, share in around((x, y), (self._width, self._height), _WRAPS):
            mixed += texels.take(number, axis=0) * share[:, None]
        return mixed

    def _place(self, directions: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return where directions are seen, in texels from left and top, and cosines of their elevations."""
        x, y, z = (self._turn.T @ directions).astype(np.float32)
        level = np.hypot(x, y)
        u, v = 0.5 - np.arctan2(y, x) / (2 * np.pi), 0.5 - np.arctan2(z, level) / np.pi
        return u * self._width, v * self._height, np.maximum(level, 1e-12)

    def _direction(self, u: FloatArray, down: FloatArray) -> FloatArray:
        """Return the (3, n) unit vectors seen at u, 0 to 1, and as far down from the top."""
        turn, elevation = 2 * np.pi * (0.5 - u), np.pi * (0.5 - down)
        level = np.cos(elevation)
        return self._turn @ np.stack([level * np.cos(turn), level * np.sin(turn), np.sin(elevation)])


def _tent(u: FloatArray) -> FloatArray:
    """Return numbers from -1 to 1 with the density 1 - |number|, from numbers in [0, 1)."""
    return np.where(u < 0.5, np.sqrt(2 * u) - 1, 1 - np.sqrt(2 - 2 * u))


class _Chances:
    """
    Columns of rows, each drawn by its share of its row; those of a row without light evenly.

    Parameters
    ----------
    light : (rows, columns) array
    """

    def __init__(self, light: FloatArray) -> None:
        light = np.where(light.sum(axis=1, keepdims=True) > 0, light, 1)
        sums = np.pad(light.cumsum(axis=1), ((0, 0), (1, 0)))
        self._sums = sums / sums[:, -1:]
        # Row after row in one ascending line.
        self._line = (self._sums[:, 1:] + np.arange(len(light))[:, None]).ravel()

    def draw(self, row: IntArray, u: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return a column of each row, chosen by numbers in [0, 1), and numbers as random as before."""
        columns = self._sums.shape[1] - 1
        column = np.searchsorted(self._line, row + u, side="right") - row * columns
        column = column.clip(0, columns - 1)
        low, high = self._sums[row, column], self._sums[row, column + 1]
        return column, ((u - low) / np.maximum(high - low, 1e-30)).clip(0, 1 - 2.0**-53)
