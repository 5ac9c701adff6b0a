"""Where a node stands: location, rotation, scale as Blender's exporter separated them, or a matrix."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..spectra import FloatArray

# Columns that differ by less of their length are the same: single precision keeps seven digits.
SAME = 2e-6


@dataclass(frozen=True)
class Placement:
    """
    A transform in three parts, the scale acting first.

    Parameters
    ----------
    location : [scene units]
    rotation : about X, then Y, then Z [degrees]
    scale : along X, Y, Z
    """

    location: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rotation: tuple[float, float, float] = (0.0, 0.0, 0.0)
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)

    @property
    def matrix(self) -> FloatArray:
        """(4, 4) array that acts on column vectors."""
        matrix = np.eye(4)
        x, y, z = (_turn(axis, angle) for axis, angle in enumerate(self.rotation))
        matrix[:3, :3] = z @ y @ x * np.asarray(self.scale, float)
        matrix[:3, 3] = self.location
        return matrix

    def is_of(self, matrix: ArrayLike) -> bool:
        """Return whether a matrix is this placement, to single precision."""
        wanted, here = np.asarray(matrix, float), self.matrix
        sizes = np.linalg.norm(wanted[:3], axis=0)
        return bool((np.abs(here - wanted)[:3] <= SAME * np.maximum(sizes, [0, 0, 0, 1e-3])).all())


UNMOVED = Placement()


def placement_of(matrix: ArrayLike) -> Placement | None:
    """Return a matrix in three parts, or None when it shears or flattens and has none."""
    wanted = np.asarray(matrix, float)
    scale = np.linalg.norm(wanted[:3, :3], axis=0)
    if scale.min() <= 0:
        return None
    if np.linalg.det(wanted[:3, :3]) < 0:
        scale = -scale
    turn = wanted[:3, :3] / scale
    level = np.hypot(turn[0, 0], turn[1, 0])
    if level > 1e-7:
        angles = (
            np.arctan2(turn[2, 1], turn[2, 2]),
            np.arctan2(-turn[2, 0], level),
            np.arctan2(turn[1, 0], turn[0, 0]),
        )
    else:  # it looks straight up or down: one of X and Z says it all
        angles = (np.arctan2(-turn[1, 2], turn[1, 1]), np.arctan2(-turn[2, 0], level), 0.0)
    x, y, z = (float(angle) for angle in np.degrees(angles))
    found = Placement(_three(wanted[:3, 3]), (x, y, z), _three(scale))
    return found if found.is_of(wanted) else None


def _three(values: ArrayLike) -> tuple[float, float, float]:
    x, y, z = np.asarray(values, float).tolist()
    return x, y, z


def _turn(axis: int, angle: float) -> FloatArray:
    matrix = np.eye(3)
    a, b = (axis + 1) % 3, (axis + 2) % 3
    cosine, sine = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    matrix[[a, a, b, b], [a, b, a, b]] = cosine, -sine, sine, cosine
    return matrix
