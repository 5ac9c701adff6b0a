"""Paths of light on their way, many at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

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
    throughput : (n, bands) float32 array, radiance seen per radiance met
    """

    number: IntArray
    origins: FloatArray
    directions: FloatArray
    reach: FloatArray | None
    density: FloatArray
    throughput: FloatArray

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
            self.throughput.take(rows, axis=0),
        )

    @classmethod
    def joined(cls, parts: Sequence[Paths], bands: int) -> Paths:
        """Return all paths of some parts, or none of so many bands; none of them still has a reach."""
        if len(parts) == 1:
            return parts[0]
        if not parts:
            way, none = np.empty((3, 0)), np.empty(0)
            return cls(np.empty(0, int), way, way, None, none, np.empty((0, bands), np.float32))
        number, origins, directions, _, density, throughput = zip(*parts, strict=True)
        return cls(
            np.concatenate(number),
            np.concatenate(origins, axis=1),
            np.concatenate(directions, axis=1),
            None,
            np.concatenate(density),
            np.concatenate(throughput),
        )
