"""Evaluated meshes as surfaces: what Blender's own renderers would see of them, in arrays."""

from __future__ import annotations

import numpy as np

from ..scene.surface import Corners, IntArray, Surface, distinct_at
from ..spectra import FloatArray


def surface_of(mesh, symbols: tuple[str, ...]) -> Surface | None:
    """
    Return a mesh as a surface, or None when it has no faces.

    Parameters
    ----------
    symbols : names for the materials of its slots
    """
    if len(mesh.polygons) == 0:
        return None
    vertices = _read(mesh.attributes["position"].data, "vector", 3)
    mesh.calc_loop_triangles()
    loops = _read_indices(mesh.loop_triangles, "loops", 3)
    corners = _read_indices(mesh.attributes[".corner_vert"].data, "value", 1)[:, 0]
    triangles = corners[loops]
    polygons = _read_indices(mesh.loop_triangle_polygons, "value", 1)[:, 0]
    parts = np.minimum(_slots(mesh), max(len(symbols) - 1, 0))[polygons]
    normals = _normals(mesh, corners, loops, polygons)
    return Surface(vertices, triangles, normals, _uvs(mesh, corners, loops), parts, symbols)


def _normals(mesh, corners: IntArray, loops: IntArray, polygons: IntArray) -> Corners:
    """
    Return the normals of triangles' corners: of vertices where all is smooth, of faces where all is flat.

    Parameters
    ----------
    corners : (loops,) array, the vertex of each
    """
    if mesh.normals_domain == "POINT":
        return Corners(_read(mesh.vertex_normals, "vector", 3), corners[loops])
    if mesh.normals_domain == "FACE":
        return Corners(
            _read(mesh.polygon_normals, "vector", 3), np.broadcast_to(polygons[:, None], (len(polygons), 3))
        )
    shared = distinct_at(_read(mesh.corner_normals, "vector", 3), corners)
    return Corners(shared.values, shared.indices[loops])


def _uvs(mesh, corners: IntArray, loops: IntArray) -> Corners | None:
    layer = next((layer for layer in mesh.uv_layers if layer.active_render), None)
    if layer is None:
        return None
    shared = distinct_at(_read(layer.uv, "vector", 2), corners)
    return Corners(shared.values, shared.indices[loops])


def _slots(mesh) -> IntArray:
    """(polygons,) array: the material slot of each face"""
    attribute = mesh.attributes.get("material_index")
    slots = np.zeros(len(mesh.polygons), np.int32)
    if attribute is not None and attribute.domain == "FACE":
        attribute.data.foreach_get("value", slots)
    return np.maximum(slots, 0)


def _read(collection, name: str, width: int) -> FloatArray:
    values = np.empty(len(collection) * width, np.float32)
    collection.foreach_get(name, values)
    return values.reshape(-1, width)


def _read_indices(collection, name: str, width: int) -> IntArray:
    values = np.empty(len(collection) * width, np.int32)
    collection.foreach_get(name, values)
    return values.reshape(-1, width)
