"""Polygons into triangles: a fan where a polygon is convex, its ears one by one where it is not."""

from __future__ import annotations

import numpy as np

from ..spectra import FloatArray
from .render_scene import IntArray

# Corners that bend the wrong way by less than this part of the polygon's area are straight.
_STRAIGHT = 1e-7


def triangulate(counts: IntArray, points: FloatArray) -> IntArray:
    """
    Return triangles that cover polygons, in the polygons' order.

    Parameters
    ----------
    counts : (polygons,) array, corners of each
    points : (corners, 3) array, where they are, polygon after polygon

    Returns
    -------
    (triangles, 3) array of corners
    """
    if (counts == 3).all():
        return np.arange(len(points)).reshape(-1, 3)
    starts = np.cumsum(counts) - counts
    found: list[IntArray] = [np.zeros((0, 3), np.int64)]
    owners: list[IntArray] = [np.zeros(0, np.int64)]
    for count in np.unique(counts[counts > 2]):
        polygons = np.flatnonzero(counts == count)
        corners = starts[polygons, None] + np.arange(count)
        triangles = _fans(corners)
        if count > 3:
            for bent in np.flatnonzero(~_are_convex(points[corners])):
                triangles[bent] = _ears(corners[bent], points[corners[bent]])
        found.append(triangles.reshape(-1, 3))
        owners.append(np.repeat(polygons, count - 2))
    order = np.argsort(np.concatenate(owners), kind="stable")
    return np.concatenate(found)[order]


def _fans(corners: IntArray) -> IntArray:
    """Return (polygons, corners - 2, 3) triangles around each polygon's first corner."""
    first = np.broadcast_to(corners[:, :1], corners[:, 1:-1].shape)
    return np.stack([first, corners[:, 1:-1], corners[:, 2:]], axis=2)


def _normals(polygons: FloatArray) -> FloatArray:
    """Return twice the vector areas of (..., corners, 3) polygons."""
    return np.cross(polygons, np.roll(polygons, -1, axis=-2)).sum(axis=-2)


def _are_convex(polygons: FloatArray) -> np.ndarray:
    centred = polygons - polygons.mean(axis=1, keepdims=True, dtype=float)
    normals = _normals(centred)
    edges = np.roll(centred, -1, axis=1) - centred
    bends = np.einsum("ijk,ik->ij", np.cross(edges, np.roll(edges, -1, axis=1)), normals)
    return (bends >= -_STRAIGHT * np.square(normals).sum(axis=1)[:, None]).all(axis=1)


def _ears(corners: IntArray, polygon: FloatArray) -> IntArray:
    """Return the triangles of one polygon by cutting off ears, seen along its normal."""
    flat = flattened(polygon, polygon)
    left, triangles = list(range(len(corners))), []
    while len(left) > 3:
        ear = next((k for k in range(len(left)) if _is_ear(flat, left, k)), None)
        # Only a polygon that crosses itself has none; then any corner does.
        ear = 0 if ear is None else ear
        triangles.append([left[ear - 1], left[ear], left[(ear + 1) % len(left)]])
        del left[ear]
    return corners[np.array([*triangles, left])]


def flattened(points: FloatArray, polygon: FloatArray) -> FloatArray:
    """Return (n, 2) coordinates of points, in which a polygon of their plane runs counter-clockwise."""
    centre = polygon.mean(axis=0, dtype=float)
    normal = _normals(polygon - centre)
    drop = int(np.abs(normal).argmax())
    axes = [(drop + 1) % 3, (drop + 2) % 3]
    return (points - centre)[:, axes if normal[drop] >= 0 else axes[::-1]]


def _is_ear(flat: FloatArray, left: list[int], k: int) -> bool:
    a, b, c = flat[left[k - 1]], flat[left[k]], flat[left[(k + 1) % len(left)]]
    if _turn(a, b, c) <= 0:
        return False
    others = flat[[each for each in left if each not in (left[k - 1], left[k], left[(k + 1) % len(left)])]]
    inside = (_turn(a, b, others) >= 0) & (_turn(b, c, others) >= 0) & (_turn(c, a, others) >= 0)
    # A corner that lies on one of the ear's own corners does not stand in its way.
    on_corner = (others[:, None] == np.stack([a, b, c])).all(axis=2).any(axis=1)
    return not (inside & ~on_corner).any()


def _turn(a: FloatArray, b: FloatArray, c: FloatArray) -> np.ndarray:
    """Return twice the signed area of a, b, c; c may be several points."""
    return (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (
        c[..., 0] - a[..., 0]
    )
