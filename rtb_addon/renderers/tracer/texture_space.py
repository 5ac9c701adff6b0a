"""Texture coordinates of triangles, and the directions in which they grow."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...scene.render_scene import Shape
from ...spectra import FloatArray
from .directions import tangents


def corner_uvs(shapes: Sequence[Shape]) -> FloatArray:
    """Return (3, 2, triangles) texture coordinates, corner first; 0 for shapes without."""
    return np.concatenate([np.zeros((3, 2, 0)), *map(_uvs, shapes)], axis=2)


def along_uv(shapes: Sequence[Shape], normals: FloatArray, one: FloatArray, two: FloatArray) -> FloatArray:
    """
    Return (2, 3, triangles) vectors dp/du and dp/dv [m]; without coordinates, anything across the normal.

    Parameters
    ----------
    normals, one, two : (3, triangles) normals and edges from the first corner to the others [m]
    """
    first, second, third = corner_uvs(shapes)
    (u1, v1), (u2, v2) = second - first, third - first
    area = u1 * v2 - v1 * u2
    flat = area == 0
    u, v = v2 * one - v1 * two, u1 * two - u2 * one
    return np.where(flat, tangents(normals), np.stack([u, v]) / np.where(flat, 1, area))


def _uvs(shape: Shape) -> FloatArray:
    mesh = shape.mesh
    if mesh.uvs is None:
        return np.zeros((3, 2, len(mesh.triangles)))
    return mesh.uvs.astype(float)[mesh.triangles].transpose(1, 2, 0)
