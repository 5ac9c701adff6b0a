"""
Small arithmetic on many vectors at once.

They are (3, n) arrays, a row per axis of space, because numpy is quickest along rows.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...spectra import FloatArray


class Frame(NamedTuple):
    """Axes at many places, (3, n) unit vectors across each other."""

    s: FloatArray
    t: FloatArray
    n: FloatArray

    @classmethod
    def about(cls, n: FloatArray, s: FloatArray | None = None) -> Frame:
        """Return axes about unit vectors n; the first as near as can be to s, or anywhere."""
        if s is None:
            return cls(*tangents(n), n)
        s = normalised(s - dot(s, n) * n)
        return cls(s, cross(n, s), n)

    def local(self, a: FloatArray) -> FloatArray:
        """Return vectors of the world along these axes."""
        return np.stack([dot(self.s, a), dot(self.t, a), dot(self.n, a)])

    def world(self, a: FloatArray) -> FloatArray:
        """Return vectors along these axes in the world."""
        return a[0] * self.s + a[1] * self.t + a[2] * self.n


def dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the (n,) scalar products of vectors."""
    return np.einsum("ij,ij->j", a, b)


def length(a: FloatArray) -> FloatArray:
    """Return the (n,) lengths of vectors."""
    return np.sqrt(dot(a, a))


def normalised(a: FloatArray) -> FloatArray:
    """Return vectors at length 1; a null vector stays null."""
    lengths = length(a)
    lengths[lengths == 0] = 1
    return a / lengths


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the vector products of vectors."""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def sphere(u: FloatArray, v: FloatArray) -> FloatArray:
    """Return float32 points spread evenly over the unit sphere, from (n,) numbers in [0, 1)."""
    points = np.empty((3, len(u)), np.float32)
    points[2] = 1 - 2 * u
    r = np.sqrt(1 - points[2] ** 2)
    turn = (2 * np.pi * v).astype(np.float32)
    points[0], points[1] = r * np.cos(turn), r * np.sin(turn)
    return points


def disc(u: FloatArray, v: FloatArray) -> FloatArray:
    """
    Return points (x, y, 0) spread evenly over the unit disc, from (n,) numbers in [0, 1).

    Squares become rings (Shirley and Chiu, *A Low Distortion Map Between Disk and Square*, 1997), so that
    numbers spread evenly stay so.
    """
    a, b = 2 * u - 1, 2 * v - 1
    wide = np.abs(a) > np.abs(b)
    r: FloatArray = np.where(wide, a, b)
    share = np.where(wide, b, a) / np.where(r == 0, 1, r)
    turn: FloatArray = np.where(wide, share * np.pi / 4, np.pi / 2 - share * np.pi / 4)
    return np.stack([r * np.cos(turn), r * np.sin(turn), np.zeros_like(r)])


def cone(axes: FloatArray, one_minus_cosine: FloatArray, u: FloatArray, v: FloatArray) -> FloatArray:
    """
    Return directions spread evenly within cones, density 1 / (2 pi (1 - cos)).

    Parameters
    ----------
    axes : (3, n) unit vectors
    one_minus_cosine : (n,) of the half angle; so given because cones may be as thin as a star's
    """
    below = u * one_minus_cosine
    r = np.sqrt(below * (2 - below))
    turn = 2 * np.pi * v
    s, t = tangents(axes)
    return s * (r * np.cos(turn)) + t * (r * np.sin(turn)) + axes * (1 - below)


def tangents(n: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return two vectors across each unit vector (Duff et al. 2017, JCGT 6(1), listing 3)."""
    x, y, z = n
    sign = np.where(z < 0, -1.0, 1.0)
    a = -1 / (sign + z)
    b = x * y * a
    return np.stack([1 + sign * x * x * a, sign * b, -sign * x]), np.stack([b, sign + y * y * a, -y])
