"""Corners that are the same in everything made into one vertex."""

from __future__ import annotations

import numpy as np

from ..spectra import FloatArray
from .render_scene import IntArray, Mesh
from .surface import distinct

# Values, and which of them each corner has.
Corners = tuple[FloatArray, IntArray]

# Corner normals that differ by less than this [radians] from their face's make it flat.
_FLAT = 1e-4
# So many triangles tell most smooth meshes from flat ones.
_FEW = 1000


def welded(
    triangles: IntArray, positions: Corners, normals: Corners | None, uvs: Corners | None
) -> Mesh | None:
    """
    Return the mesh of some triangles, or None when none has an area.

    Triangles turn so that they run counter-clockwise seen from the side of their normals; normals that
    are those of the faces are left out.

    Parameters
    ----------
    triangles : (triangles, 3) array of corners
    positions, normals, uvs : values, and (corners,) which of them each corner has
    """
    points, places = positions
    sides = points[places[triangles]].astype(float)
    areas = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    lengths = np.linalg.norm(areas, axis=1)
    triangles, faces = triangles[lengths > 0], areas[lengths > 0] / lengths[lengths > 0, None]
    if len(triangles) == 0:
        return None
    if normals is not None:
        triangles, normals = _turned(triangles, faces, _unit(normals))
    return _indexed(triangles, positions, normals, uvs)


def _unit(normals: Corners) -> Corners:
    values = normals[0].astype(float)
    lengths = np.linalg.norm(values, axis=1, keepdims=True)
    return np.divide(values, lengths, out=np.zeros_like(values), where=lengths > 0).astype(
        np.float32
    ), normals[1]


def _turned(triangles: IntArray, faces: FloatArray, normals: Corners) -> tuple[IntArray, Corners | None]:
    """Return triangles that run as their normals want, and the normals unless all faces are flat."""
    values, places = normals
    corners = values[places[triangles]]
    back = np.einsum("tcx,tx->t", corners, faces) < 0
    if back.any():
        triangles = np.where(back[:, None], triangles[:, ::-1], triangles)
        corners = np.where(back[:, None, None], corners[:, ::-1], corners)
        faces = np.where(back[:, None], -faces, faces)
    if _are_flat(corners[:_FEW], faces[:_FEW]) and _are_flat(corners, faces):
        return triangles, None
    silent = ~corners.any(axis=2)
    if not silent.any():
        return triangles, normals
    # A corner whose normal has no length takes its face's.
    places = places.copy()
    places[triangles[silent]] = len(values) + np.arange(silent.sum())
    return triangles, (np.concatenate([values, faces[np.nonzero(silent)[0]]]).astype(np.float32), places)


def _are_flat(corners: FloatArray, faces: FloatArray) -> bool:
    apart = corners - faces[:, None].astype(np.float32)
    near = np.einsum("tcx,tcx->tc", apart, apart) < _FLAT**2
    return bool((near | ~corners.any(axis=2)).all())


def _indexed(triangles: IntArray, positions: Corners, normals: Corners | None, uvs: Corners | None) -> Mesh:
    corners = triangles.ravel()
    keys = positions[1][corners]
    for extra in (normals, uvs):
        # Where each vertex has its own of it, it tells no vertices apart.
        if extra is not None and not np.array_equal(extra[1], positions[1]):
            same = distinct(extra[0]).indices[extra[1][corners]]
            keys = np.unique(keys * (int(same.max()) + 1) + same, return_inverse=True)[1].ravel()
    _, first, order = np.unique(keys, return_index=True, return_inverse=True)
    kept = corners[first]
    chosen = [None if each is None else each[0][each[1][kept]] for each in (normals, uvs)]
    return Mesh(positions[0][positions[1][kept]], order.reshape(-1, 3).astype(np.int32), *chosen)
