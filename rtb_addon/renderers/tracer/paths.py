"""Paths of light on their way, many at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import IntArray
from ...spectra import FloatArray


class Paths(NamedTuple):
    """
    Paths on their way.

    Parameters
    ----------
    number : (n,) int array, row of the wave that a path's light belongs to
    origins, directions : (3, n) arrays [m]
    reach : (n,) how far they see [m]; None without end
    density : (n,) of the direction [sr-1]; infinite where no light could have been chosen instead
    carried : array of n, what a Carrier keeps of the spectra that each met
    band : (n,) int array, the one band that a path is of, where glass or fluorescence made it choose: what it
        meets counts as it is there; -1 where each band that it carries sees its own. None: so they all are
    """

    number: IntArray
    origins: FloatArray
    directions: FloatArray
    reach: FloatArray | None
    density: FloatArray
    carried: NDArray
    band: IntArray | None = None

    def only(self, rows: IntArray) -> Paths:
        """Return some of them, in this order."""
        if len(rows) == len(self.number):
            return self
        reach = None if self.reach is None else self.reach[rows]
        # take() is two or three times as quick as an index, here and elsewhere.
        return Paths(
            self.number.take(rows),
            self.origins.take(rows, axis=1),
            self.directions.take(rows, axis=1),
            reach,
            self.density.take(rows),
            self.carried.take(rows, axis=0),
            None if self.band is None else self.band.take(rows),
        )

    def seen(self, values: FloatArray, rows: IntArray | None = None) -> FloatArray:
        """Return (n, bands or 1) numbers as all or some paths see them: those of one band in that alone."""
        if self.band is None or values.shape[1] == 1:
            return values
        band = self.band if rows is None else self.band.take(rows)
        alone = np.nonzero(band >= 0)[0]
        if len(alone):
            values = values.copy()
            values[alone] = values[alone, band[alone]][:, None]
        return values

    @classmethod
    def joined(cls, parts: Sequence[Paths]) -> Paths:
        """Return all paths of some parts, or none; none of them still has a reach."""
        if len(parts) == 1:
            return parts[0]
        if not parts:
            way, none = np.empty((3, 0)), np.empty(0)
            return cls(np.empty(0, int), way, way, None, none, none)
        number, origins, directions, _, density, carried, band = zip(*parts, strict=True)
        return cls(
            np.concatenate(number),
            np.concatenate(origins, axis=1),
            np.concatenate(directions, axis=1),
            None,
            np.concatenate(density),
            np.concatenate(carried),
            None if band[0] is None else np.concatenate(band),
        )
