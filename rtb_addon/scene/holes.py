"""A polygon with holes made into one outline that goes into each hole and comes back the same way."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..spectra import FloatArray
from .render_scene import IntArray
from .triangulation import flattened


def bridged(outline: IntArray, holes: Sequence[IntArray], points: FloatArray) -> IntArray:
    """
    Return the corners of an outline without holes that covers the same area.

    Parameters
    ----------
    outline : corners of the polygon
    holes : corners of each hole in it, in either sense
    points : (corners, 3) array, where all corners are
    """
    rings = [outline, *holes]
    flat = np.zeros((len(points), 2))
    every = np.concatenate(rings)
    flat[every] = flattened(points[every], points[outline])
    left = [ring if _area(flat[ring]) < 0 else ring[::-1] for ring in holes]
    while left:
        a, b, ring = _shortest_bridge(outline, left, flat)
        inner = left.pop(ring)
        turned = np.roll(inner, -b)
        outline = np.concatenate([outline[: a + 1], turned, turned[:1], outline[a:]])
    return outline


def _area(ring: FloatArray) -> float:
    after = np.roll(ring, -1, axis=0)
    return float((ring[:, 0] * after[:, 1] - ring[:, 1] * after[:, 0]).sum()) / 2


def _shortest_bridge(outline: IntArray, holes: Sequence[IntArray], flat: FloatArray) -> tuple[int, int, int]:
    """Return places in the outline and in a hole, and which hole, that see each other and are near."""
    rings = [outline, *holes]
    starts, ends = np.concatenate(rings), np.concatenate([np.roll(ring, -1) for ring in rings])
    pairs = [
        (float(np.square(flat[corner] - flat[other]).sum()), a, b, k)
        for k, hole in enumerate(holes)
        for b, other in enumerate(hole)
        for a, corner in enumerate(outline)
    ]
    for _, a, b, k in sorted(pairs):
        if not _crosses(flat[outline[a]], flat[holes[k][b]], flat[starts], flat[ends]):
            return a, b, k
    return pairs[0][1:]  # only polygons that cross themselves come here


def _crosses(a: FloatArray, b: FloatArray, starts: FloatArray, ends: FloatArray) -> bool:
    """Return whether a line from a to b meets an edge anywhere but at its own ends."""
    meets = (_turn(a, b, starts) * _turn(a, b, ends) <= 0) & (
        _turn(starts, ends, a) * _turn(starts, ends, b) <= 0
    )
    shares = np.zeros(len(starts), bool)
    for own in (a, b):
        shares |= (starts == own).all(axis=1) | (ends == own).all(axis=1)
    return bool((meets & ~shares).any())


def _turn(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    return (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (
        c[..., 0] - a[..., 0]
    )
