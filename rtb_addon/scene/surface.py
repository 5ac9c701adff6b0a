"""Triangles as a Collada geometry holds them: each corner has its own normal and texture coordinate."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..spectra import FloatArray

IntArray = NDArray[np.integer]


@dataclass(frozen=True, eq=False)
class Corners:
    """
    Something that each corner of each triangle has.

    Parameters
    ----------
    values : (values, n) float32 array
    indices : (triangles, 3) array, of values
    """

    values: FloatArray
    indices: IntArray


@dataclass(frozen=True, eq=False)
class Surface:
    """
    Triangles of one or several materials.

    Parameters
    ----------
    vertices : (vertices, 3) float32 array [scene units]
    triangles : (triangles, 3) array
        Indices of vertices, counter-clockwise seen from the side that the normal points to.
    normals : unit normals of the corners, or None for flat faces
    uvs : texture coordinates of the corners, V up, or None
    parts : (triangles,) array, which of the symbols each triangle has
    symbols : names for the materials, bound where the geometry is used
    """

    vertices: FloatArray
    triangles: IntArray
    normals: Corners | None = None
    uvs: Corners | None = None
    parts: IntArray = field(default_factory=lambda: np.zeros(0, np.int32))
    symbols: tuple[str, ...] = ()


def corners(values: ArrayLike, triangles: IntArray) -> Corners:
    """
    Return the values of corners, each different one once.

    Parameters
    ----------
    values : (vertices, n) array: one per vertex; or (triangles, 3, n): one per corner
    """
    given = np.ascontiguousarray(values, np.float32)
    if given.ndim == 2:
        return Corners(given, triangles)
    if given.shape[:2] != triangles.shape:
        raise ValueError(f"{given.shape[:2]} corners for {triangles.shape} triangles")
    shared = distinct(given.reshape(-1, given.shape[2]))
    return Corners(shared.values, shared.indices.reshape(triangles.shape))


def distinct(rows: FloatArray) -> Corners:
    """Return each different row once, and for every row which one it is: (rows,) indices."""
    rows = np.ascontiguousarray(rows, np.float32) + np.float32(0)  # no -0
    keys = np.zeros(len(rows), np.uint64)
    for column in rows.view(np.uint32).astype(np.uint64).T:
        keys = (keys ^ column) * np.uint64(0x9E3779B97F4A7C15)
        keys ^= keys >> np.uint64(29)
    _, first, places = np.unique(keys, return_index=True, return_inverse=True)
    if not np.array_equal(rows[first][places.ravel()], rows):  # two rows share a key: rare, slow is fine
        _, first, places = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return Corners(rows[first], places.ravel().astype(np.int32))


def distinct_at(values: FloatArray, places: IntArray) -> Corners:
    """
    Return each different row once, for rows that are mostly the same at the same place.

    Parameters
    ----------
    values : (rows, n) array, of the corners of a mesh
    places : (rows,) array, the vertex of each
    """
    rows = np.ascontiguousarray(values, np.float32) + np.float32(0)  # no -0
    usual = np.zeros((int(places.max(initial=-1)) + 1, rows.shape[1]), np.float32)
    usual[places] = rows
    others = np.flatnonzero(_differ(usual, places, rows))
    rest = distinct(rows[others])
    indices = places.astype(np.int32)
    indices[others] = len(usual) + rest.indices
    return Corners(np.concatenate([usual, rest.values]), indices)


def _differ(usual: FloatArray, places: IntArray, rows: FloatArray) -> NDArray[np.bool_]:
    """Return which rows are not what is usual at their places; pairs are compared as one number each."""
    if rows.shape[1] == 2:
        return usual.view(np.uint64)[:, 0].take(places) != rows.view(np.uint64)[:, 0]
    return (usual.take(places, axis=0) != rows).any(axis=1)
