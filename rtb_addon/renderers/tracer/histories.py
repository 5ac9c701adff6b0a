"""Paths that remember which spectra they met: light is multiplied out in all bands at the end."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import IntArray
from ...spectra import FloatArray
from .carried import Carrier, Light, Turned
from .lights import Lights
from .materials import Plain
from .meeting import Meeting, Model
from .paths import Paths

# Sums that are kept for all pixels and histories of a tile, those that are 0 too; beyond it, only the others.
_DENSE = 2**22


class Histories:
    """
    Which spectra paths met: a number for each set of them, counted as often as they were met.

    Parameters
    ----------
    spectra : (rows, bands) array
    """

    def __init__(self, spectra: FloatArray) -> None:
        self._spectra = spectra
        self._numbers: dict[tuple[int, ...], int] = {(): 0}
        self.rows: list[tuple[int, ...]] = [()]
        self._products = [np.ones(spectra.shape[1])]
        self._after = np.full((64, len(spectra)), -1, np.int32)

    def after(self, history: IntArray, spectrum: IntArray) -> IntArray:
        """Return the histories of paths that met one spectrum more."""
        place = history * len(self._spectra) + spectrum
        found = self._after.ravel().take(place)
        if len(found) and found.min() < 0:
            for each in np.unique(place[found < 0]).tolist():
                self._learn(*divmod(each, len(self._spectra)))
            found = self._after.ravel().take(place)
        return found

    def products(self, histories: IntArray) -> FloatArray:
        """Return the (histories, bands) products of the spectra of some histories."""
        return np.stack([self._products[one] for one in histories]).astype(np.float32)

    def _learn(self, history: int, spectrum: int) -> None:
        """Find the number of a history and one spectrum more, a new one perhaps."""
        rows = tuple(sorted((*self.rows[history], spectrum)))
        number = self._numbers.setdefault(rows, len(self.rows))
        if number == len(self.rows):
            self.rows.append(rows)
            self._products.append(self._spectra[list(rows)].prod(axis=0, dtype=float))
            if number == len(self._after):
                self._after = np.concatenate([self._after, np.full_like(self._after, -1)])
        self._after[history, spectrum] = number


class InHistories(Carrier):
    """Paths that carry the number of their history: (n,) int32 arrays."""

    def __init__(self, lights: Lights, pixels: int, plain: Plain, histories: Histories) -> None:
        self._lights, self._pixels, self._plain, self._histories = lights.spectra, pixels, plain, histories
        self._brought: list[tuple[IntArray, IntArray, FloatArray]] = []

    def met(self, paths: Paths, model: Model, met: Meeting) -> NDArray:
        """Add one spectrum to each history."""
        return self._histories.after(paths.carried, self._plain.first[model] + met.row)

    def scattered(self, paths: Paths, weight: FloatArray | None) -> NDArray:
        """Return the same: surfaces of one spectrum are sampled so well that nothing is left to weigh."""
        assert weight is None
        return paths.carried

    def end(self) -> None:
        """Wait for the other waves."""

    def sums(self) -> FloatArray:
        """Sum up for each pixel, history and light, then multiply out in all bands."""
        if not self._brought:
            return np.zeros((self._pixels, self._lights.shape[1]), np.float32)
        pixel, key, value = (np.concatenate(part) for part in zip(*self._brought, strict=True))
        used = self._used(key)
        column = np.zeros(used.max() + 1, int)
        column[used] = np.arange(len(used))
        history, row = np.divmod(used, len(self._lights))
        table = self._histories.products(history) * self._lights[row]
        place = pixel * len(used) + column.take(key)
        if self._pixels * len(used) <= _DENSE:
            sums = np.bincount(place, value, self._pixels * len(used)).astype(np.float32)
            return sums.reshape(self._pixels, len(used)) @ table
        return self._sparse(place, value, table)

    def _used(self, key: IntArray) -> IntArray:
        """Return the keys that there are, in an order that does not depend on who met which history first."""
        rows, lights = self._histories.rows, len(self._lights)
        used = np.flatnonzero(np.bincount(key)).tolist()
        return np.array(sorted(used, key=lambda one: (rows[one // lights], one % lights)), int)

    def _sparse(self, place: IntArray, value: FloatArray, table: FloatArray) -> FloatArray:
        where, which = np.unique(place, return_inverse=True)
        pixel, column = np.divmod(where, len(table))
        light = table[column] * np.bincount(which, value).astype(np.float32)[:, None]
        first = np.nonzero(np.diff(pixel, prepend=-1))[0]
        total = np.zeros((self._pixels, table.shape[1]), np.float32)
        total[pixel[first]] = np.add.reduceat(light, first, axis=0)
        return total

    def _fresh(self, count: int) -> NDArray:
        return np.zeros(count, np.int32)

    def _bring(self, paths: Paths, light: Light, turned: Turned) -> None:
        if len(light.rows):
            pixel = self._pixel.take(paths.number.take(light.rows))
            key = paths.carried.take(light.rows) * len(self._lights) + light.row
            self._brought.append((pixel, key, light.strength[:, 0]))
