"""Small arithmetic on many vectors at once: (n, 3) arrays, one vector a row."""

from __future__ import annotations

import numpy as np

from ...spectra import FloatArray


def dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the (n,) scalar products of two (n, 3) arrays."""
    return np.einsum("ij,ij->i", a, b)


def length(a: FloatArray) -> FloatArray:
    """Return the (n,) lengths of vectors."""
    return np.sqrt(dot(a, a))


def normalised(a: FloatArray) -> FloatArray:
    """Return vectors at length 1; a null vector stays null."""
    lengths = length(a)
    lengths[lengths == 0] = 1
    unit = a.astype(float)
    unit /= lengths[:, None]
    return unit


def sphere(u: FloatArray, v: FloatArray) -> FloatArray:
    """Return points spread evenly over the unit sphere, from (n,) numbers in [0, 1)."""
    z = 1 - 2 * u
    r = np.sqrt(np.maximum(1 - z * z, 0))
    turn = 2 * np.pi * v
    return np.stack([r * np.cos(turn), r * np.sin(turn), z], axis=1)


def cone(axes: FloatArray, one_minus_cosine: FloatArray, u: FloatArray, v: FloatArray) -> FloatArray:
    """
    Return directions spread evenly within cones, density 1 / (2 pi (1 - cos)).

    Parameters
    ----------
    axes : (n, 3) unit vectors
    one_minus_cosine : (n,) of the half angle; so given because cones may be as thin as a star's
    """
    below = u * one_minus_cosine
    r = np.sqrt(below * (2 - below))
    turn = 2 * np.pi * v
    s, t = _tangents(axes)
    around = s * (r * np.cos(turn))[:, None] + t * (r * np.sin(turn))[:, None]
    return around + axes * (1 - below)[:, None]


def _tangents(n: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return two vectors across each unit vector (Duff et al. 2017, JCGT 6(1), listing 3)."""
    x, y, z = n.T
    sign = np.where(z < 0, -1.0, 1.0)
    a = -1 / (sign + z)
    b = x * y * a
    return (
        np.stack([1 + sign * x * x * a, sign * b, -sign * x], axis=1),
        np.stack([b, sign + y * y * a, -y], axis=1),
    )
