"""Light from so far away that it comes from the same direction everywhere."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ....scene.render_scene import IntArray, Light
from ....spectra import FloatArray
from ..directions import cone, dot, normalised
from .groups import Sample, number


class Suns:
    """Directional lights, as a single direction or as a disc in the sky."""

    def __init__(self, lights: Sequence[Light], first: int, radius: float) -> None:
        self.rows = first + np.arange(len(lights))
        self.powers = np.full(len(lights), np.pi * radius**2)
        axes = np.array([light.to_world[:3, 2] for light in lights], float).reshape(-1, 3).T
        self.towards = normalised(axes)
        half = np.radians(np.array([number(light, "angle", 0.0) for light in lights], float)) / 2
        self.one_minus_cosine: FloatArray = 2 * np.sin(half / 2) ** 2
        self.extended = half > 0
        self.densities = 1 / np.where(self.extended, 2 * np.pi * self.one_minus_cosine, 1)
        self.radiance = 1 / np.where(self.extended, np.pi * np.sin(half) ** 2, 1)

    def sample(self, which: IntArray, points: FloatArray, u: FloatArray, v: FloatArray) -> Sample:
        """Sample evenly over the disc."""
        directions = cone(self.towards[:, which], self.one_minus_cosine[which], u, v)
        reach = np.full(len(u), 1e30)
        strength, density = self.radiance[which], self.densities[which]
        return Sample(directions, reach, self.rows[which], strength, density, self.extended[which] * 1.0)

    def seen(self, sun: int, directions: FloatArray) -> NDArray[np.bool_]:
        """Return which directions point into a sun's disc."""
        apart = directions - self.towards[:, sun, None]
        return self.extended[sun] & (dot(apart, apart) < 2 * self.one_minus_cosine[sun])
