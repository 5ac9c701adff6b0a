"""Surfaces that shine, triangle by triangle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ....scene.render_scene import IntArray
from ....spectra import FloatArray
from ..directions import cross, dot, length
from ..intersect import Surfaces
from .groups import Sample


class Triangles:
    """Emitting triangles; they shine to the side of their normals."""

    def __init__(self, surfaces: Surfaces, row_of: NDArray[np.int32]) -> None:
        shining = np.nonzero(row_of >= 0)[0]
        corner, second, third = surfaces.corners[:, :, shining]
        one, two = second - corner, third - corner
        area = length(cross(one, two)) / 2
        kept = area > 0
        self.triangle, self.area = shining[kept], area[kept]
        self.rows, self.powers = row_of[self.triangle], np.pi * self.area
        normals, lift = surfaces.normals[:, shining], surfaces.lift[shining]
        table = np.concatenate([corner, one, two, normals, area[None], lift[None]])[:, kept]
        self._table = table.astype(np.float32)

    def sample(self, which: IntArray, points: FloatArray, u: FloatArray, v: FloatArray) -> Sample:
        """Sample evenly over the area: Turk 1990, *Generating Random Points in Triangles*, method 2."""
        root = np.sqrt(1 - u)
        first, second = (1 - root).astype(np.float32), (v * root).astype(np.float32)
        table = self._table.take(which, axis=1)
        way = table[0:3] + first * table[3:6] + second * table[6:9] - points
        distance = np.maximum(length(way), np.float32(1e-30))
        way /= distance
        cosine = -dot(table[9:12], way)
        shines = cosine > 0
        cosine = np.maximum(cosine, np.float32(1e-12))
        density = distance**2 / (cosine * table[12])
        # As rays start a little above a surface, they end a little above this one.
        reach = np.maximum(distance - table[13] / cosine, 0)
        ones = np.ones(len(u), np.float32)
        return Sample(way, reach, self.rows.take(which), shines * ones, density, ones)
