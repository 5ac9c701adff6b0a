"""
The ray kernel where Embree has no wheel: a bounding volume hierarchy in plain numpy.

Triangles are ordered along a Morton curve and boxed in groups of two to the root, a complete binary
tree without pointers (Lauterbach et al. 2009 without the splits). All rays go down it together: a list of
(ray, node) pairs, a level at a time. The arithmetic is double, on the same single-precision corners as
Embree's.
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
        levels = max(len(order) - 1, 0) // _LEAF
        self._depth = levels.bit_length()
        # The last triangle fills up the tree: it is met twice, at the same place.
        self._order = np.pad(order, (0, (_LEAF << self._depth) - len(order)), "edge") if len(order) else order
        self._first = corners[self._order, 0]
        self._edges = corners[self._order, 1:] - corners[self._order, :1]
        self._boxes = _boxes(corners[self._order], self._depth) if len(order) else []

    def closest(self, origins: FloatArray, directions: FloatArray, reach: FloatArray | None) -> Hits:
        """Return the first triangle of each ray, the one with the lower number where two tie."""
        far = np.full(len(origins), np.inf) if reach is None else reach.astype(float)
        ray, slot, t, u, v = self._all(origins.astype(float), directions.astype(float), far)
        triangle = np.full(len(origins), -1, np.int32)
        distance, at = far.astype(np.float32), np.zeros((2, len(origins)), np.float32)
        first = np.lexsort((self._order[slot], t, ray))
        first = first[np.diff(ray[first], prepend=-1) > 0]
        met = ray[first]
        triangle[met], distance[met] = self._order[slot[first]], t[first]
        at[:, met] = u[first], v[first]
        return Hits(triangle, distance, at[0], at[1])

    def blocked(self, origins: FloatArray, directions: FloatArray, reach: FloatArray) -> NDArray[np.bool_]:
        """Return which rays meet any triangle before their reach."""
        blocked = np.zeros(len(origins), bool)
        blocked[self._all(origins.astype(float), directions.astype(float), reach.astype(float))[0]] = True
        return blocked

    def _all(self, origins: FloatArray, directions: FloatArray, far: FloatArray) -> tuple:
        """Return every meeting of rays with triangles, as arrays: ray, slot, t, u, v."""
        ray = np.arange(len(origins) if len(self._order) else 0)
        node = np.zeros(len(ray), int)
        inverse = 1 / np.where(directions == 0, 1e-30, directions)
        for level, boxes in enumerate(self._boxes):
            if level:
                ray, node = np.repeat(ray, 2), np.repeat(2 * node, 2)
                node[1::2] += 1
            ray, node = _entered(origins, inverse, far, boxes, ray, node)
        ray = np.repeat(ray, _LEAF)
        slot = (node[:, None] * _LEAF + np.arange(_LEAF)).ravel()
        t, u, v = self._planes(origins[ray], directions[ray], slot)
        met = np.nonzero((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0) & (t <= far[ray]))[0]
        return ray[met], slot[met], t[met], u[met], v[met]

    def _planes(self, origins: FloatArray, directions: FloatArray, slot: IntArray) -> tuple:
        """Return t, u, v of rays in the planes of triangles (Moller and Trumbore 1997); NaN where none."""
        one, two = self._edges[slot, 0], self._edges[slot, 1]
        across = np.cross(directions, two)
        start = origins - self._first[slot]
        turned = np.cross(start, one)
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = 1 / np.einsum("ij,ij->i", one, across)
            u = np.einsum("ij,ij->i", start, across) * scale
            v = np.einsum("ij,ij->i", directions, turned) * scale
            return np.einsum("ij,ij->i", two, turned) * scale, u, v


def _morton_order(centres: FloatArray) -> IntArray:
    """Return the order of (n, 3) points along a Morton curve, 10 bits an axis."""
    if not len(centres):
        return np.zeros(0, int)
    low = centres.min(axis=0)
    cell = ((centres - low) / max((centres.max(axis=0) - low).max(), 1e-30) * 1023).astype(np.int64)
    code = sum(((cell[:, axis] >> bit) & 1) << (3 * bit + axis) for bit in range(10) for axis in range(3))
    return np.argsort(code, kind="stable")


def _boxes(corners: FloatArray, depth: int) -> list[FloatArray]:
    """Return (nodes, 2, 3) lower and upper corners for each level, the root first."""
    groups = corners.reshape(1 << depth, -1, 3)
    # Boxes are a little too big rather than too small by the last bit of an inverse.
    margin = 1e-9 * np.abs(corners).max()
    boxes = [np.stack([groups.min(axis=1) - margin, groups.max(axis=1) + margin], axis=1)]
    while len(boxes[0]) > 1:
        pairs = boxes[0].reshape(-1, 2, 2, 3)
        boxes.insert(0, np.stack([pairs[:, :, 0].min(axis=1), pairs[:, :, 1].max(axis=1)], axis=1))
    return boxes


def _entered(
    origins: FloatArray,
    inverse: FloatArray,
    far: FloatArray,
    boxes: FloatArray,
    ray: IntArray,
    node: IntArray,
) -> tuple[IntArray, IntArray]:
    """Return the pairs of rays and nodes whose boxes the rays enter (slabs, Kay and Kajiya 1986)."""
    walls = (boxes[node] - origins[ray][:, None]) * inverse[ray][:, None]
    enter = walls.min(axis=1).max(axis=1)
    leave = walls.max(axis=1).min(axis=1)
    inside = np.nonzero((enter <= leave) & (leave >= 0) & (enter <= far[ray]))[0]
    return ray[inside], node[inside]
