"""
Reconstruction filters, done by sampling them: a path begins where the filter of its pixel sends it.

A pixel is then the plain mean of its own paths, and its passes are independent of its neighbours'. Where a
filter is negative, a path counts negatively, and all paths count for as much more as its parts cancel out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ..spectra import FloatArray

# Places of the filter that are equally probable, with straight lines between.
_QUANTILES, _GRID = 2048, 40_001


@dataclass(frozen=True, eq=False)
class Filter:
    """
    A filter along one axis; over a pixel it is the product of two.

    Parameters
    ----------
    radius : beyond it, the filter is 0 [pixels]
    zeros : distances from the middle at which its sign changes, in order [pixels]
    gain : integral of its magnitude over that of itself
    places : (quantiles + 1,) array of places between which the magnitude has equal integrals [pixels]
    """

    radius: float
    zeros: tuple[float, ...]
    gain: float
    places: FloatArray


def _box(x: FloatArray) -> FloatArray:
    return np.ones(x.shape)


def _tent(x: FloatArray) -> FloatArray:
    return np.interp(x, [-1.0, 0.0, 1.0], [0.0, 1.0, 0.0])


def _gaussian(x: FloatArray) -> FloatArray:
    # A standard deviation of half a pixel, cut off at four of them.
    return np.exp(-2 * x**2) - np.exp(-8.0)


def _cubic(b: float, c: float) -> Callable[[FloatArray], FloatArray]:
    """Return a filter of Mitchell and Netravali's family."""

    def evaluate(x: FloatArray) -> FloatArray:
        x = np.abs(x)
        inner = (12 - 9 * b - 6 * c) * x**3 + (-18 + 12 * b + 6 * c) * x**2 + (6 - 2 * b)
        outer = (-b - 6 * c) * x**3 + (6 * b + 30 * c) * x**2 + (-12 * b - 48 * c) * x + (8 * b + 24 * c)
        return np.where(x < 1, inner, outer) / 6

    return evaluate


def _lanczos(x: FloatArray) -> FloatArray:
    return np.sinc(x) * np.sinc(x / 3)


# With Mitsuba's default parameters: the function, its radius, and where its sign changes.
FILTERS: Mapping[str, tuple[Callable[[FloatArray], FloatArray], float, tuple[float, ...]]] = {
    "box": (_box, 0.5, ()),
    "tent": (_tent, 1.0, ()),
    "gaussian": (_gaussian, 2.0, ()),
    "mitchell": (_cubic(1 / 3, 1 / 3), 2.0, (8 / 7,)),
    "catmullrom": (_cubic(0.0, 0.5), 2.0, (1.0,)),
    "lanczos": (_lanczos, 3.0, (1.0, 2.0)),
}


def filter_of(name: str) -> Filter:
    """Return a filter by its name."""
    evaluate, radius, zeros = FILTERS[name]
    places = np.linspace(-radius, radius, _GRID)
    heights = evaluate(places)
    steps = (np.abs(heights[1:]) + np.abs(heights[:-1])) / 2
    sums = np.concatenate([[0.0], np.cumsum(steps)])
    gain = steps.sum() / ((heights[1:] + heights[:-1]) / 2).sum()
    shares = np.linspace(0, sums[-1], _QUANTILES + 1)
    return Filter(radius, zeros, float(gain), np.interp(shares, sums, places))
