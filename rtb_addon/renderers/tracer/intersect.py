"""
Where rays meet surfaces.

Embree (or bvh.py) says which triangle a ray meets, in single precision; the place on it is computed
in double precision from the triangle itself, so that it lies on the surface however far away
the camera or a light may be.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import IntArray, Shape
from ...spectra import FloatArray
from .bvh import Bvh
from .directions import dot, normalised
from .kernels import Embree, Hits, Kernel

# How far a ray starts off a surface, per size of the numbers in it: 16 units of single precision.
_LIFT = 2.0**-20


def best_kernel(corners: FloatArray) -> Kernel:
    """Return Embree where it is installed, else the kernel in numpy."""
    try:
        return Embree(corners)
    except ImportError:
        return Bvh(corners)


class Places(NamedTuple):
    """
    Places on surfaces, seen from where a ray came.

    Parameters
    ----------
    points : (n, 3) array [m]
    faces : (n, 3) unit normals of the triangles, towards the ray's origin
    normals : (n, 3) unit normals to shade with, on the same side for a smooth mesh
    start : (n, 3) points [m] a little above, which single precision tells from the surface
    """

    points: FloatArray
    faces: FloatArray
    normals: FloatArray
    start: FloatArray


class Surfaces:
    """
    All triangles of a scene in the world.

    A mirrored shape (negative determinant) follows Mitsuba: a flat triangle's normal follows the order of
    its corners after the transform; a mesh with normals keeps the side that they point to.

    Attributes
    ----------
    corners : (triangles, 3, 3) float64 array [m]
    normals : (triangles, 3) unit normals; a triangle without area has none
    shape, material : (triangles,) int32 arrays, numbers of its shape and material
    kernel : what finds them
    """

    def __init__(
        self, shapes: Sequence[Shape], materials: Mapping[str, int], make: Callable[[FloatArray], Kernel]
    ) -> None:
        self.corners = _joined([_corners(shape) for shape in shapes], (0, 3, 3))
        edges = self.corners[:, 1:] - self.corners[:, :1]
        sides = _joined([np.full(len(shape.mesh.triangles), _side(shape)) for shape in shapes], (0,))
        self.normals = normalised(np.cross(edges[:, 0], edges[:, 1])) * sides[:, None]
        counts = [len(shape.mesh.triangles) for shape in shapes]
        self.shape = np.repeat(np.arange(len(shapes), dtype=np.int32), counts)
        numbers = np.array([materials[shape.material] for shape in shapes], np.int32)
        self.material = numbers[self.shape] if len(shapes) else self.shape
        self._smooth = _shading_normals(shapes, self.normals)
        self._centre = self._middle()
        self._lift = np.abs(self.corners - self._centre).max(axis=(1, 2), initial=0) * _LIFT
        # One row a triangle, since one gather of 13 numbers is quicker than five of a few.
        self._rows = np.hstack(
            [self.corners[:, 0], edges[:, 0], edges[:, 1], self.normals, self._lift[:, None]]
        )
        self.kernel = make((self.corners - self._centre).astype(np.float32))

    def meet(self, origins: FloatArray, directions: FloatArray, reach: FloatArray | None = None) -> Hits:
        """
        Return what rays meet first.

        Parameters
        ----------
        origins, directions : (n, 3) arrays [m], unit vectors
        reach : (n,) array [m], or None for rays without end
        """
        limit = None if reach is None else np.array(reach, np.float32)
        return self.kernel.closest(*self._single(origins, directions), limit)

    def blocked(self, origins: FloatArray, directions: FloatArray, reach: FloatArray) -> NDArray[np.bool_]:
        """Return which rays (as in meet) meet a surface before their reach."""
        return self.kernel.blocked(*self._single(origins, directions), np.array(reach, np.float32))

    def places(self, hits: Hits, directions: FloatArray) -> Places:
        """Return where rays met surfaces; every one of them must have met one."""
        rows = self._rows.take(hits.triangle, axis=0)
        u, v = hits.u[:, None], hits.v[:, None]
        points = rows[:, 0:3] + u * rows[:, 3:6] + v * rows[:, 6:9]
        side = np.where(dot(rows[:, 9:12], directions) < 0, 1.0, -1.0)[:, None]
        faces = side * rows[:, 9:12]
        normals = faces
        if self._smooth is not None:
            a, b, c = np.moveaxis(self._smooth.take(hits.triangle, axis=0), 1, 0)
            normals = side * normalised(a + u * (b - a) + v * (c - a))
        return Places(points, faces, normals, points + faces * rows[:, 12:])

    def lift_of(self, triangles: IntArray) -> FloatArray:
        """Return the (n,) distances [m] at which single precision tells places from these triangles."""
        return self._lift[triangles]

    def radius(self) -> float:
        """Return the radius [m] of a sphere around everything; 1 when there is nothing."""
        return float(np.linalg.norm(self.corners - self._centre, axis=2).max(initial=0)) or 1.0

    def _middle(self) -> FloatArray:
        """Return the middle of everything [m]: single precision is finest around zero."""
        if not len(self.corners):
            return np.zeros(3)
        return (self.corners.min(axis=(0, 1)) + self.corners.max(axis=(0, 1))) / 2

    def _single(self, origins: FloatArray, directions: FloatArray) -> tuple[FloatArray, FloatArray]:
        return (origins - self._centre).astype(np.float32), np.ascontiguousarray(directions, np.float32)


def _corners(shape: Shape) -> FloatArray:
    turn, place = shape.to_world[:3, :3], shape.to_world[:3, 3]
    return (shape.mesh.vertices.astype(float) @ turn.T + place)[shape.mesh.triangles]


def _side(shape: Shape) -> float:
    """Return -1 where the corners' order and the mesh's own normals disagree, else 1."""
    mirrored = np.linalg.det(shape.to_world[:3, :3]) < 0
    return -1.0 if mirrored and shape.mesh.normals is not None else 1.0


def _shading_normals(shapes: Sequence[Shape], flat: FloatArray) -> FloatArray | None:
    """Return (triangles, 3, 3) float32 normals at the corners, or None when all shapes are flat."""
    if all(shape.mesh.normals is None for shape in shapes):
        return None
    normals = np.repeat(flat.astype(np.float32)[:, None], 3, axis=1)
    first = 0
    for shape in shapes:
        last = first + len(shape.mesh.triangles)
        if shape.mesh.normals is not None:
            turned = shape.mesh.normals @ _normal_matrix(shape.to_world).T
            normals[first:last] = normalised(turned)[shape.mesh.triangles]
        first = last
    return normals


def _normal_matrix(to_world: FloatArray) -> FloatArray:
    """Return what turns normals: the inverse transposed, up to length, of a flattened shape too."""
    a, b, c = to_world[:3, :3]
    sign = -1.0 if np.dot(a, np.cross(b, c)) < 0 else 1.0
    return sign * np.array([np.cross(b, c), np.cross(c, a), np.cross(a, b)])


def _joined(arrays: list[FloatArray], empty: tuple[int, ...]) -> FloatArray:
    return np.concatenate(arrays) if arrays else np.zeros(empty)
