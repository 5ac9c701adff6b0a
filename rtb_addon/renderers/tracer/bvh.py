"""
The ray kernel where Embree has no wheel: a bounding volume hierarchy in plain numpy.

Triangles are ordered along a Morton curve and boxed two by two up to the root: a complete binary
tree without pointers (after Lauterbach et al., *Fast BVH Construction on GPUs*, 2009). All rays go
down it together, as a list of rays and nodes, a level at a time. The arithmetic is double, on the same
single-precision corners as Embree's. Arrays have an axis of space first: numpy is quickest along rows.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import IntArray
from ...spectra import FloatArray
from .kernels import Hits

_LEAF = 4  # triangles in a leaf


class Bvh:
    """Triangles, (triangles, 3, 3) float32 corners, where rays find them."""

    name = "numpy"

    def __init__(self, corners: FloatArray) -> None:
        corners = corners.astype(float)
        order = _morton_order(corners.mean(axis=1))
        depth = (max(len(order) - 1, 0) // _LEAF).bit_length()
        # The last triangle fills up the tree: it is met several times, at the same place.
        self._order = np.pad(order, (0, (_LEAF << depth) - len(order)), "edge") if len(order) else order
        self._boxes = _boxes(corners[self._order], depth) if len(order) else []
        self._units = _units(corners[self._order])

    def closest(self, origins: FloatArray, directions: FloatArray, reach: FloatArray | None) -> Hits:
        """Return the first triangle of each ray, the one with the lower number where two tie."""
        far = np.full(len(origins), np.inf) if reach is None else reach.astype(float)
        ray, slot, t, u, v = self._all(origins, directions, far)
        first = np.lexsort((self._order[slot], t, ray))
        first = first[np.diff(ray[first], prepend=-1) > 0]
        met = ray[first]
        triangle, distance = np.full(len(origins), -1, np.int32), far.astype(np.float32)
        at = np.zeros((2, len(origins)), np.float32)
        triangle[met], distance[met] = self._order[slot[first]], t[first]
        at[:, met] = u[first], v[first]
        return Hits(triangle, distance, at[0], at[1])

    def blocked(self, origins: FloatArray, directions: FloatArray, reach: FloatArray) -> NDArray[np.bool_]:
        """Return which rays meet any triangle before their reach."""
        blocked = np.zeros(len(origins), bool)
        blocked[self._all(origins, directions, reach.astype(float))[0]] = True
        return blocked

    def _all(self, origins: FloatArray, directions: FloatArray, far: FloatArray) -> tuple:
        """Return every meeting of rays with triangles, as arrays: ray, slot, t, u, v."""
        o, d = origins.T.astype(float), directions.T.astype(float)
        inverse = 1 / np.where(d == 0, 1e-30, d)
        ray = np.arange(len(origins) if len(self._order) else 0)
        node = np.zeros_like(ray)
        for level, boxes in enumerate(self._boxes):
            if level:
                ray, node = np.repeat(ray, 2), np.repeat(2 * node, 2)
                node[1::2] += 1
            inside = _entered(o, inverse, far, boxes, ray, node)
            ray, node = ray[inside], node[inside]
        slot = (node[:, None] * _LEAF + np.arange(_LEAF)).ravel()
        return _met(o, d, far, self._units, np.repeat(ray, _LEAF), slot)


def _morton_order(centres: FloatArray) -> IntArray:
    """Return the order of (n, 3) points along a Morton curve, 10 bits an axis."""
    if not len(centres):
        return np.zeros(0, int)
    low = centres.min(axis=0)
    cell = ((centres - low) / max((centres.max(axis=0) - low).max(), 1e-30) * 1023).astype(np.int64)
    code = sum(((cell[:, axis] >> bit) & 1) << (3 * bit + axis) for bit in range(10) for axis in range(3))
    return np.argsort(code, kind="stable")


def _boxes(corners: FloatArray, depth: int) -> list[FloatArray]:
    """Return (2, 3, nodes) lower and upper corners for each level, the root first."""
    groups = corners.reshape(1 << depth, -1, 3)
    # Rounding must not close a box before a triangle in its wall.
    margin = 1e-9 * np.abs(corners).max()
    boxes = [np.stack([groups.min(axis=1).T - margin, groups.max(axis=1).T + margin])]
    while boxes[0].shape[2] > 1:
        (low, high), half = boxes[0], (3, -1, 2)
        boxes.insert(0, np.stack([low.reshape(half).min(axis=2), high.reshape(half).max(axis=2)]))
    return boxes


def _units(corners: FloatArray) -> FloatArray:
    """
    Return (3, 4, triangles) maps that turn each triangle into the unit triangle of the u, v plane.

    Baldwin and Weber, *Fast Ray-Triangle Intersections by Coordinate Transformation*, 2016. A
    triangle without area gets a map of zeros, which no ray meets.
    """
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(one, two)
    square = np.einsum("ij,ij->i", normal, normal)
    with np.errstate(divide="ignore", invalid="ignore"):
        rows = np.stack([np.cross(two, normal), np.cross(normal, one), normal]) / square[:, None]
    rows[:, ~(square > 0)] = 0
    shift = -np.einsum("aij,ij->ai", rows, corners[:, 0])
    return np.concatenate([np.moveaxis(rows, 2, 1), shift[:, None]], axis=1)


def _entered(
    o: FloatArray, inverse: FloatArray, far: FloatArray, boxes: FloatArray, ray: IntArray, node: IntArray
) -> IntArray:
    """Return where rays enter the boxes paired with them (slabs: Kay and Kajiya 1986)."""
    enter, leave = np.zeros(len(ray)), far[ray]
    for axis in range(3):
        start, slope = o[axis][ray], inverse[axis][ray]
        one, two = (boxes[0, axis][node] - start) * slope, (boxes[1, axis][node] - start) * slope
        enter = np.maximum(enter, np.minimum(one, two))
        leave = np.minimum(leave, np.maximum(one, two))
    return np.nonzero(enter <= leave)[0]


def _met(
    o: FloatArray, d: FloatArray, far: FloatArray, units: FloatArray, ray: IntArray, slot: IntArray
) -> tuple[IntArray, IntArray, FloatArray, FloatArray, FloatArray]:
    """Return the pairs of rays and triangles that meet: ray, slot, t, u, v."""
    with np.errstate(divide="ignore", invalid="ignore"):
        t = -_along(units[2], slot, o, ray, 1) / _along(units[2], slot, d, ray, 0)
        inside = np.nonzero((t > 0) & (t <= far[ray]))[0]
    ray, slot, t = ray[inside], slot[inside], t[inside]
    place = o[:, ray] + t * d[:, ray]
    u, v = (_along(row, slot, place, slice(None), 1) for row in units[:2])
    inside = np.nonzero((u >= 0) & (v >= 0) & (u + v <= 1))[0]
    return ray[inside], slot[inside], t[inside], u[inside], v[inside]


def _along(
    row: FloatArray, slot: IntArray, vectors: FloatArray, which: IntArray | slice, shift: int
) -> FloatArray:
    """Return one coordinate of points (shift 1) or directions (shift 0) in the triangles' own space."""
    x, y, z = vectors
    total = row[0][slot] * x[which] + row[1][slot] * y[which] + row[2][slot] * z[which]
    return total + row[3][slot] if shift else total
