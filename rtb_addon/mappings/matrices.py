"""RenderToolbox4's transformations: (4, 4) arrays for row vectors, so that the left one acts first."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..scene.collada.transforms import look_at as standing
from ..scene.collada.transforms import rotate
from ..spectra import FloatArray


def translation(offset: ArrayLike) -> FloatArray:
    """Return a shift by (3,) numbers."""
    matrix = np.eye(4)
    matrix[3, :3] = offset
    return matrix


def scaling(factors: ArrayLike) -> FloatArray:
    """Return a scale by (3,) factors."""
    return np.diag([*np.asarray(factors, float), 1.0])


def rotation(axis: ArrayLike, angle: ArrayLike) -> FloatArray:
    """Return a turn about an axis, (3,) numbers, by an angle [radians]."""
    return rotate(np.array([*np.asarray(axis, float), np.degrees(float(np.ravel(angle)[0]))])).T


def look_at(eye: ArrayLike, point: ArrayLike, up: ArrayLike) -> FloatArray:
    """Return where something stands at an eye that looks at a point along its -Z axis, +Y up."""
    return standing(np.concatenate([np.ravel(eye), np.ravel(point), np.ravel(up)])).T
