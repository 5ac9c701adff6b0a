"""
Where rays meet surfaces.

Embree (or bvh.py) says which triangle a ray meets; the place on it is computed from the triangle itself, so
that it lies on the surface however far away the camera or a light may be. All in single precision, which is
finest around zero: the scene has been moved there (placed.py).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import IntArray, Shape
from ...spectra import FloatArray
from .bvh import Bvh
from .directions import cross, dot, normalised
from .kernels import Embree, Hits, Kernel
from .placed import corners, shading_normals, side_of
from .texture_space import along_uv, corner_uvs

# How far a ray starts off a surface, per size of the numbers in it: 16 units of single precision.
_LIFT = 2.0**-20


def best_kernel(corners: FloatArray) -> Kernel:
    """Return Embree where it is installed, else the kernel in numpy."""
    try:
        return Embree(corners)
    except ImportError:
        return Bvh(corners)


# The surfaces of the last scene: conditions that differ in spectra have them in common.
_warm: dict[tuple, Surfaces] = {}


def warm_surfaces(
    shapes: Sequence[Shape],
    materials: Mapping[str, int],
    make: Callable[[FloatArray], Kernel],
    oriented: bool,
    textured: bool,
) -> Surfaces:
    """Return the Surfaces of these, the last ones once more if they are the same."""
    placed = [(one.mesh.digest, one.to_world.tobytes(), materials[one.material]) for one in shapes]
    key = tuple(placed), make, oriented, textured
    if key not in _warm:
        _warm.clear()
        _warm[key] = Surfaces(shapes, materials, make, oriented, textured)
    return _warm[key]


class Places(NamedTuple):
    """
    Places on surfaces, seen from where a ray came.

    Parameters
    ----------
    faces : (3, n) unit normals of the triangles, towards the ray's origin
    normals : (3, n) unit normals to shade with, on the same side for a smooth mesh
    start : (3, n) points [m] a little above, which single precision tells from the surface
    lift : (n,) how far above [m]
    side : (n,) 1 where the ray came from the side that the triangle's own normal points to, else -1
    tangents, across : (3, n) vectors dp/du and dp/dv [m], or None where no material asks for them
    uvs : (2, n) texture coordinates, or None where no material asks for them
    """

    faces: FloatArray
    normals: FloatArray
    start: FloatArray
    lift: FloatArray
    side: FloatArray
    tangents: FloatArray | None = None
    uvs: FloatArray | None = None
    across: FloatArray | None = None

    @property
    def behind(self) -> FloatArray:
        """Points [m] as far below the surface as start is above."""
        return self.start - 2 * self.lift * self.faces

    def only(self, rows: IntArray) -> Places:
        """Return some of them."""
        return Places(
            self.faces.take(rows, axis=1),
            self.normals.take(rows, axis=1),
            self.start.take(rows, axis=1),
            self.lift[rows],
            self.side[rows],
            None if self.tangents is None else self.tangents.take(rows, axis=1),
            None if self.uvs is None else self.uvs.take(rows, axis=1),
            None if self.across is None else self.across.take(rows, axis=1),
        )


class Surfaces:
    """
    All triangles of a scene in the world.

    A mirrored shape (negative determinant) keeps its outside, as in Blender: its normals are those of
    its mesh, transformed.

    Attributes
    ----------
    corners : (3, 3, triangles) float64 array [m]: corner, axis, triangle
    normals : (3, triangles) float32 unit normals; a triangle without area has none
    lift : (triangles,) distance from each [m] at which single precision tells a place from its surface
    shape, material : (triangles,) int32 arrays, numbers of its shape and material
    kernel : what finds them

    Parameters
    ----------
    oriented : whether some material asks for the directions in which U and V grow
    textured : whether some material asks for texture coordinates
    """

    def __init__(
        self,
        shapes: Sequence[Shape],
        materials: Mapping[str, int],
        make: Callable[[FloatArray], Kernel],
        oriented: bool = False,
        textured: bool = False,
    ) -> None:
        counts = [len(shape.mesh.triangles) for shape in shapes]
        self.shape = np.repeat(np.arange(len(shapes), dtype=np.int32), counts)
        numbers = np.array([materials[shape.material] for shape in shapes], np.int32)
        self.material = numbers.take(self.shape)
        self.corners = corners(shapes)
        one, two = self.corners[1] - self.corners[0], self.corners[2] - self.corners[0]
        sides = np.array([side_of(shape) for shape in shapes]).take(self.shape)
        normals = normalised(cross(one, two)) * sides
        self.normals = normals.astype(np.float32)
        self._smooth = shading_normals(shapes, self.normals)
        self._uvs = corner_uvs(shapes) if textured else None
        self._tangents = along_uv(shapes, normals, one, two) if oriented else None
        self.lift = np.abs(self.corners).max(axis=(0, 1), initial=0) * _LIFT
        # One table, since one gather is quicker than many: a corner, two edges, normal and lift.
        table = np.concatenate([self.corners[0], one, two, normals, self.lift[None]])
        self._table = table.astype(np.float32)
        self.kernel = make(self.corners.transpose(2, 0, 1).astype(np.float32))

    def meet(self, origins: FloatArray, directions: FloatArray, reach: FloatArray | None = None) -> Hits:
        """
        Return what rays meet first.

        Parameters
        ----------
        origins, directions : (3, n) arrays [m], unit vectors
        reach : (n,) array [m], or None for rays without end
        """
        limit = None if reach is None else np.array(reach, np.float32)
        return self.kernel.closest(_in_rows(origins), _in_rows(directions), limit)

    def blocked(self, origins: FloatArray, directions: FloatArray, reach: FloatArray) -> NDArray[np.bool_]:
        """Return which rays (as in meet) meet a surface before their reach."""
        reach = np.array(reach, np.float32)
        return self.kernel.blocked(_in_rows(origins), _in_rows(directions), reach)

    def places(self, hits: Hits, directions: FloatArray) -> Places:
        """Return where rays met surfaces; every one of them must have met one."""
        rows = self._table.take(hits.triangle, axis=1)
        points = rows[0:3] + hits.u * rows[3:6] + hits.v * rows[6:9]
        side = -np.copysign(np.float32(1), dot(rows[9:12], directions))
        faces = side * rows[9:12]
        normals = faces
        if self._smooth is not None:
            a, b, c = self._smooth.take(hits.triangle, axis=2)
            normals = side * normalised(a + hits.u * (b - a) + hits.v * (c - a))
        tangents, across = None, None
        if self._tangents is not None:
            tangents, across = self._tangents.take(hits.triangle, axis=2)
        uvs = None
        if self._uvs is not None:
            a, b, c = self._uvs.take(hits.triangle, axis=2)
            uvs = a + hits.u * (b - a) + hits.v * (c - a)
        # A copy, for a view would keep the whole of rows.
        lift = rows[12].copy()
        return Places(faces, normals, points + faces * lift, lift, side, tangents, uvs, across)

    def radius(self) -> float:
        """Return the radius [m] of a sphere around everything; 1 when there is nothing."""
        return float(np.linalg.norm(self.corners, axis=1).max(initial=0)) or 1.0


def _in_rows(vectors: FloatArray) -> FloatArray:
    """Return vectors as kernels want them, (n, 3) float32 arrays."""
    rows = np.empty((vectors.shape[1], 3), np.float32)
    # One axis after the other: four times as quick as to turn them all at once.
    for axis in range(3):
        rows[:, axis] = vectors[axis]
    return rows
