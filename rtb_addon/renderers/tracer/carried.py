"""
What paths carry of the spectra that they met, and the light that they bring to pixels.

How much light a path brings is a product of spectra and numbers. Where every surface and light has one
spectrum, whatever the directions, it is enough to remember which spectra a path met, in any order: paths
carry the number of their history, light is summed for each pixel and history, and only these sums are
multiplied out in all bands (InHistories). Else paths carry a number for each band (InBands). What comes out
is the same.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import IntArray
from ...spectra import FloatArray
from .lights import Lights
from .materials import Plain
from .meeting import Meeting, Model
from .paths import Paths

# Sums that are kept for all pixels and histories of a tile, those that are 0 too; beyond it, only the others.
_DENSE = 2**22


class Light(NamedTuple):
    """
    Light that comes to some paths.

    Parameters
    ----------
    rows : (m,) int array, which paths, each at most once
    row : (m,) int array, row of each light's spectrum
    directions : (3, m) unit vectors towards the lights
    strength : (m, bands or 1) array, what else the light is multiplied by
    """

    rows: IntArray
    row: IntArray
    directions: FloatArray
    strength: FloatArray


Turned = Callable[[FloatArray], FloatArray]


class Carrier(ABC):
    """
    The paths of a tile, a wave after the other.

    Attributes
    ----------
    gain : what all light that the present wave brings is multiplied by from now on
    """

    gain = 1.0
    _pixel: IntArray
    _weight: FloatArray | None

    def begin(self, pixel: IntArray, weight: FloatArray | None) -> NDArray:
        """
        Begin a wave of paths; return what they carry, an array whose first axis is the paths.

        Parameters
        ----------
        pixel : (n,) int array, rising: whose light each path's is
        weight : (n,) how much each path counts, None where all count 1
        """
        self._pixel, self._weight, self.gain = pixel, weight, 1.0
        return self._fresh(len(pixel))

    def bring(self, paths: Paths, light: Light, turned: Turned = lambda coming: coming) -> None:
        """
        Take the light that comes to some paths.

        Parameters
        ----------
        turned : what a surface makes of the (m, bands) light that comes, once more
        """
        strength, gain = light.strength.astype(np.float32, copy=False), np.float32(self.gain)
        if self._weight is not None:
            gain = gain * self._weight.take(paths.number.take(light.rows))[:, None]
        if np.any(gain != 1):
            strength = strength * gain
        self._bring(paths, light._replace(strength=strength), turned)

    @abstractmethod
    def met(self, paths: Paths, model: Model, met: Meeting) -> NDArray:
        """Return what paths carry after they met surfaces, by Model.shared(); may change the old."""

    @abstractmethod
    def scattered(self, paths: Paths, weight: FloatArray | None) -> NDArray:
        """Return what paths carry after they went on with Onward.weight."""

    @abstractmethod
    def end(self) -> None:
        """End a wave."""

    @abstractmethod
    def sums(self) -> FloatArray:
        """Return the (pixels, bands) light that all waves brought."""

    @abstractmethod
    def _fresh(self, count: int) -> NDArray: ...

    @abstractmethod
    def _bring(self, paths: Paths, light: Light, turned: Turned) -> None: ...


class InBands(Carrier):
    """Paths that carry a number for each band: (n, bands) float32 arrays."""

    def __init__(self, lights: Lights, pixels: int) -> None:
        self._lights = lights
        self._total = np.zeros((pixels, lights.spectra.shape[1]), np.float32)

    def met(self, paths: Paths, model: Model, met: Meeting) -> NDArray:
        """Multiply by what is shared."""
        if (factor := model.shared(met)) is not None:
            np.multiply(paths.carried, paths.seen(factor), out=paths.carried)
        return paths.carried

    def scattered(self, paths: Paths, weight: FloatArray | None) -> NDArray:
        """Multiply by the weight."""
        return paths.carried if weight is None else paths.carried * paths.seen(weight)

    def end(self) -> None:
        """Add the paths of each pixel, which follow each other."""
        first = np.nonzero(np.diff(self._pixel, prepend=-1))[0]
        self._total[self._pixel[first]] += np.add.reduceat(self._found, first, axis=0)

    def sums(self) -> FloatArray:
        """Return the sums of all waves."""
        return self._total

    def _fresh(self, count: int) -> NDArray:
        self._found = np.zeros((count, self._total.shape[1]), np.float32)
        return np.ones_like(self._found)

    def _bring(self, paths: Paths, light: Light, turned: Turned) -> None:
        coming = self._lights.coming(light.row, light.directions)
        coming *= light.strength
        seen = paths.seen(turned(coming), light.rows)
        seen *= paths.carried.take(light.rows, axis=0)
        self._found[paths.number.take(light.rows)] += seen


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
