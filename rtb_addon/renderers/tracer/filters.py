"""
Reconstruction filters, by sampling them: a path goes through a place that the filter itself has chosen.

A path counts for its own pixel alone, so that pixels have nothing to do with each other. What a filter weighs
less is chosen less often; where it is negative, a path counts with a minus. As in Ernst, Stamminger and
Greiner, *Filter Importance Sampling*, 2006. The parameters are Mitsuba's defaults.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache

import numpy as np

from ...scene.render_scene import Filter
from ...spectra import FloatArray

# Steps into which a filter is cut to be sampled; within a step all places are alike, and weighed.
_STEPS = 4096


def offsets(filter: Filter, u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray | None]:
    """
    Return where paths go through, from the middle of their pixel [pixels], and how much each counts.

    Parameters
    ----------
    u, v : (n,) arrays in [0, 1)
    """
    if filter == "box":
        return u - 0.5, v - 0.5, None
    (x, across), (y, down) = _sampled(filter, u), _sampled(filter, v)
    return x, y, (across * down).astype(np.float32)


def _sampled(filter: Filter, u: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return places along one direction, and the filter there over their density and its integral."""
    radius, shape = FILTERS[filter]
    sums, chance, whole = _table(filter)
    step = np.searchsorted(sums[1:], u, side="right").clip(max=_STEPS - 1)
    inside = ((u - sums[step]) / chance[step]).clip(0, 1)
    width = 2 * radius / _STEPS
    place = (step + inside) * width - radius
    return place, shape(place) * width / (chance[step] * whole)


@cache
def _table(filter: Filter) -> tuple[FloatArray, FloatArray, float]:
    """Return how often each step is chosen, summed up from 0 and itself, and the filter's integral."""
    radius, shape = FILTERS[filter]
    edges = np.linspace(-radius, radius, _STEPS + 1)
    middle = (edges[1:] + edges[:-1]) / 2
    # Simpson's rule; a step in which the filter changes its sign must be chosen, too.
    parts = (shape(edges[:-1]) + 4 * shape(middle) + shape(edges[1:])) / 6
    size = (np.abs(shape(edges[:-1])) + 4 * np.abs(shape(middle)) + np.abs(shape(edges[1:]))) / 6
    chance = size / size.sum()
    sums = np.concatenate([[0.0], np.cumsum(chance)])
    return sums, chance, float(parts.sum() * 2 * radius / _STEPS)


def _tent(x: FloatArray) -> FloatArray:
    return np.maximum(1 - np.abs(x), 0)


def _gaussian(x: FloatArray) -> FloatArray:
    """Return a bell of standard deviation 0.5, let down to 0 at four of them."""
    return np.maximum(np.exp(-2 * x * x) - np.exp(-8.0), 0)


def _cubic(b: float, c: float) -> Callable[[FloatArray], FloatArray]:
    """Return a filter of Mitchell and Netravali, *Reconstruction Filters in Computer Graphics*, 1988."""

    def shape(x: FloatArray) -> FloatArray:
        x = np.abs(x)
        near = (12 - 9 * b - 6 * c) * x**3 + (-18 + 12 * b + 6 * c) * x**2 + (6 - 2 * b)
        far = (-b - 6 * c) * x**3 + (6 * b + 30 * c) * x**2 + (-12 * b - 48 * c) * x + (8 * b + 24 * c)
        return np.where(x < 1, near, np.where(x < 2, far, 0)) / 6

    return shape


def _lanczos(x: FloatArray) -> FloatArray:
    """Return a sinc that a wider one cuts off after three lobes."""
    return np.where(np.abs(x) < 3, np.sinc(x) * np.sinc(x / 3), 0)


# Name -> radius [pixels] and shape, up to a factor.
FILTERS: Mapping[str, tuple[float, Callable[[FloatArray], FloatArray]]] = {
    "tent": (1.0, _tent),
    "gaussian": (2.0, _gaussian),
    "mitchell": (2.0, _cubic(1 / 3, 1 / 3)),
    "catmullrom": (2.0, _cubic(0.0, 0.5)),
    "lanczos": (3.0, _lanczos),
}
