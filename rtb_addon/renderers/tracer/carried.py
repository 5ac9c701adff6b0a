"""
What paths carry of the spectra that they met, and the light that they bring to pixels.

How much light a path brings is a product of spectra and numbers. Where every surface and light has one
spectrum, whatever the directions, it is enough to remember which spectra a path met, in any order: paths
carry the number of their history, light is summed for each pixel and history, and only these sums are
multiplied out in all bands (histories.py). Else paths carry a number for each band (InBands). What comes
out is the same.
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
from .meeting import Meeting, Model
from .paths import Paths


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
