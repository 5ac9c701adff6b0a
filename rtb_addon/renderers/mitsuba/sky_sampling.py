"""
Directions towards a picture around the scene, most of them where it is bright.

The sky is cut into the picture's own texels, each as likely as its share of the light, and evenly bright for
all that matters here: a row is drawn first, then a texel of that row, then a place in it.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

import math
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

from ...spectra import FloatArray
from .arrays import floats


def axes_of(turn: FloatArray) -> list[Any]:
    """Return the columns of a (3, 3) matrix in memory, so that another rotation is the same kernel."""
    return [mi.Vector3f(*(dr.opaque(mi.Float, float(x)) for x in column)) for column in turn.T]


def uv_of(local) -> Any:
    """Return where in the picture a unit direction of its own frame lies, V up."""
    u = 0.5 - dr.atan2(local.y, local.x) * dr.inv_two_pi
    # The angle from the horizon keeps its digits near the poles in this form.
    v = 0.5 + dr.atan2(local.z, dr.sqrt(dr.square(local.x) + dr.square(local.y))) * dr.inv_pi
    return mi.Point2f(u, v)


class SkySampling:
    """Draws directions of the picture's own frame."""

    def __init__(self, brightness: FloatArray) -> None:
        """Take the (height, width) brightness of texels, row 0 on top."""
        height, width = brightness.shape
        edges = np.sin(np.pi * (0.5 - np.arange(height + 1) / height))
        light = _in_texels(brightness.astype(float)) * (edges[:-1] - edges[1:])[:, None]
        rows = _cumulative(light.sum(axis=1)[None])
        columns = _cumulative(light)
        share = np.diff(rows, prepend=0, axis=1).T * np.diff(columns, prepend=0, axis=1)
        density = share / ((edges[:-1] - edges[1:])[:, None] * 2 * math.pi / width)
        self._height, self._width = (dr.opaque(mi.UInt32, count) for count in (height, width))
        self._edges, self._density = floats(edges), floats(density)
        self._row_steps, self._column_steps = (math.ceil(math.log2(n)) for n in (height, width))
        # Beyond the end no number is ever found.
        self._rows, self._columns = (floats(_padded(each)) for each in (rows, columns))

    def sample(self, sample) -> tuple[Any, Any]:
        """Return unit directions and their density [1 / sr] from two random numbers each."""
        row, down = self._find(self._rows, mi.UInt32(0), self._row_steps, sample.y)
        first = row << self._column_steps
        column, along = self._find(self._columns, first, self._column_steps, sample.x)
        top, bottom = (dr.gather(mi.Float, self._edges, row + k) for k in (0, 1))
        z = dr.lerp(top, bottom, down)
        sine, cosine = dr.sincos((0.5 - (mi.Float(column) + along) / mi.Float(self._width)) * dr.two_pi)
        radius = dr.safe_sqrt(1 - dr.square(z))
        density = dr.gather(mi.Float, self._density, row * self._width + column)
        return mi.Vector3f(cosine * radius, sine * radius, z), density

    def density(self, local) -> Any:
        """Return how densely directions are drawn around a unit direction [1 / sr]."""
        uv = uv_of(local)
        column, row = (
            dr.clip(mi.Int32(dr.floor(place * mi.Float(count))), 0, mi.Int32(count) - 1)
            for place, count in ((uv.x, self._width), (1 - uv.y, self._height))
        )
        return dr.gather(mi.Float, self._density, mi.UInt32(row) * self._width + mi.UInt32(column))

    def _find(self, table, first, steps: int, sample) -> tuple[Any, Any]:
        """Return which of 2^steps cumulative shares a random number falls in, and where between its ends."""
        found = mi.UInt32(0)
        for step in (2**k for k in reversed(range(steps))):
            beyond = dr.gather(mi.Float, table, first + found + (step - 1)) <= sample
            found = dr.select(beyond, found + step, found)
        end = dr.gather(mi.Float, table, first + found)
        start = dr.gather(mi.Float, table, first + dr.maximum(found, 1) - 1)
        start = dr.select(found == 0, 0, start)
        return found, dr.clip((sample - start) / dr.maximum(end - start, 1e-30), 0, 1)


def _in_texels(brightness: FloatArray) -> FloatArray:
    """Return the mean brightness of each texel, where texels fade into their neighbours, all around."""
    above, below = brightness[[0, *range(len(brightness) - 1)]], brightness[[*range(1, len(brightness)), -1]]
    down = (above + 6 * brightness + below) / 8
    return (np.roll(down, 1, axis=1) + 6 * down + np.roll(down, -1, axis=1)) / 8


def _cumulative(shares: FloatArray) -> FloatArray:
    """Return the cumulative shares of each row, the last of them 1; a row of nothing is divided evenly."""
    shares = np.where(shares.sum(axis=1, keepdims=True) > 0, shares, 1)
    sums = shares.cumsum(axis=1)
    sums /= sums[:, -1:]
    # What counts is what single precision leaves of them.
    return sums.astype(np.float32).astype(float)


def _padded(cumulative: FloatArray) -> FloatArray:
    whole = 2 ** math.ceil(math.log2(cumulative.shape[1]))
    return np.pad(cumulative, ((0, 0), (0, whole - cumulative.shape[1])), constant_values=2.0)
