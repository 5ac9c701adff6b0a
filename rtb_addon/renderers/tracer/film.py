"""
Where on the film paths go through: a place that the reconstruction filter itself has chosen.

A path counts for its own pixel alone, so that pixels have nothing to do with each other. What a filter weighs
less is chosen less often; where it is negative, a path counts with a minus. As in Ernst, Stamminger and
Greiner, *Filter Importance Sampling*, 2006.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from ...scene.render_scene import Filter
from ...spectra import FloatArray
from ..filters import FILTERS

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
    shape, radius, _ = FILTERS[filter]
    sums, chance, whole = _table(filter)
    step = np.searchsorted(sums[1:], u, side="right").clip(max=_STEPS - 1)
    inside = ((u - sums[step]) / chance[step]).clip(0, 1)
    width = 2 * radius / _STEPS
    place = (step + inside) * width - radius
    return place, shape(place) * width / (chance[step] * whole)


@cache
def _table(filter: Filter) -> tuple[FloatArray, FloatArray, float]:
    """Return how often each step is chosen, summed up from 0 and itself, and the filter's integral."""
    shape, radius, _ = FILTERS[filter]
    edges = np.linspace(-radius, radius, _STEPS + 1)
    middle = (edges[1:] + edges[:-1]) / 2
    # Simpson's rule; a step in which the filter changes its sign must be chosen, too.
    parts = (shape(edges[:-1]) + 4 * shape(middle) + shape(edges[1:])) / 6
    size = (np.abs(shape(edges[:-1])) + 4 * np.abs(shape(middle)) + np.abs(shape(edges[1:]))) / 6
    chance = size / size.sum()
    sums = np.concatenate([[0.0], np.cumsum(chance)])
    return sums, chance, float(parts.sum() * 2 * radius / _STEPS)
