"""Shapes that need no modelling: planes, disks and spheres, centred on the origin."""

from __future__ import annotations

import numpy as np

from .surface import Surface, corners


def plane(width: float = 2.0, depth: float = 2.0) -> Surface:
    """Return a rectangle across Z that faces +Z, with texture coordinates from 0 to 1."""
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    flat = (uvs - np.float32(0.5)) * np.array([width, depth], np.float32)
    vertices = np.column_stack([flat, np.zeros(4, np.float32)])
    triangles = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    normals = np.tile(np.array([0, 0, 1], np.float32), (4, 1))
    return Surface(vertices, triangles, corners(normals, triangles), corners(uvs, triangles))


def disk(width: float = 2.0, depth: float = 2.0, segments: int = 128) -> Surface:
    """Return an ellipse across Z that faces +Z; the polygon has exactly the ellipse's area."""
    step = 2 * np.pi / segments
    around = np.arange(segments) * step
    grown = np.sqrt(step / np.sin(step))
    unit = np.column_stack([np.cos(around), np.sin(around)])
    rim = np.column_stack([grown * unit * np.array([width / 2, depth / 2]), np.zeros(segments)])
    vertices = np.vstack([np.zeros(3), rim]).astype(np.float32)
    following = np.roll(np.arange(segments), -1)
    triangles = np.column_stack([np.zeros(segments), np.arange(segments) + 1, following + 1]).astype(np.int32)
    normals = np.tile(np.array([0, 0, 1], np.float32), (segments + 1, 1))
    uvs = 0.5 + 0.5 * np.vstack([np.zeros(2), unit])
    return Surface(vertices, triangles, corners(normals, triangles), corners(uvs, triangles))


def sphere(radius: float = 1.0, segments: int = 64, rings: int = 32) -> Surface:
    """Return a smooth sphere with its vertices on the sphere, its poles on Z."""
    down, around = np.meshgrid(
        np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, segments, endpoint=False), indexing="ij"
    )
    normals = np.stack([np.sin(down) * np.cos(around), np.sin(down) * np.sin(around), np.cos(down)], axis=-1)
    normals = np.vstack([[[0, 0, 1]], normals[1:-1].reshape(-1, 3), [[0, 0, -1]]]).astype(np.float32)
    triangles = _sphere_triangles(segments, rings)
    around = np.arctan2(normals[:, 1], normals[:, 0])[triangles] / (2 * np.pi) % 1.0
    seam = around.max(axis=1, keepdims=True) - around > 0.5
    height = 1 - np.arccos(np.clip(normals[:, 2], -1, 1))[triangles] / np.pi
    uvs = np.stack([around + seam, height], axis=-1)
    return Surface(
        normals * np.float32(radius), triangles, corners(normals, triangles), corners(uvs, triangles)
    )


def _sphere_triangles(segments: int, rings: int):
    """Return fans around the poles and two triangles in each cell between them."""
    here = np.arange(segments)
    after = np.roll(here, -1)
    last = 1 + segments * (rings - 1)
    top = np.column_stack([np.zeros(segments, int), 1 + here, 1 + after])
    bottom = np.column_stack([np.full(segments, last), last - segments + after, last - segments + here])
    cells = [top]
    for ring in range(rings - 2):
        upper, lower = 1 + ring * segments, 1 + (ring + 1) * segments
        cells.append(np.column_stack([upper + here, lower + here, lower + after]))
        cells.append(np.column_stack([upper + here, lower + after, upper + after]))
    return np.vstack([*cells, bottom]).astype(np.int32)
