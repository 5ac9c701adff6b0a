"""What finds the triangles that rays meet: the interface, and Embree behind it."""

from __future__ import annotations

from importlib.metadata import version
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import IntArray
from ...spectra import FloatArray


class Hits(NamedTuple):
    """
    What (n,) rays met.

    Parameters
    ----------
    triangle : its number; -1 for nothing, -2 - k for the emitting sphere k
    distance : how far away [m]
    u, v : where on the triangle, from its first corner along its first and second edge
    """

    triangle: NDArray[np.int32]
    distance: FloatArray
    u: FloatArray
    v: FloatArray

    def only(self, rows: IntArray) -> Hits:
        """Return some of them."""
        if len(rows) == len(self.u):
            return self
        return Hits(self.triangle.take(rows), self.distance.take(rows), self.u.take(rows), self.v.take(rows))


class Kernel(Protocol):
    """What finds triangles; origins, directions and distances are float32 and in the kernel's space."""

    name: str

    def closest(self, origins: FloatArray, directions: FloatArray, reach: FloatArray | None) -> Hits: ...

    def blocked(
        self, origins: FloatArray, directions: FloatArray, reach: FloatArray
    ) -> NDArray[np.bool_]: ...


class Embree:
    """
    Intel's ray kernel, one thread.

    In its robust mode rays cannot slip between two triangles that share an edge, as one in a
    million does otherwise, into the light behind a wall perhaps.
    """

    def __init__(self, corners: FloatArray) -> None:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        self.name = f"embreex {version('embreex')}"
        self._scene = EmbreeScene(robust=True)
        TriangleMesh(self._scene, np.ascontiguousarray(corners, np.float32))

    def closest(self, origins: FloatArray, directions: FloatArray, reach: FloatArray | None) -> Hits:
        met = self._scene.run(origins, directions, dists=reach, output=1)
        return Hits(met["primID"], met["tfar"], met["u"], met["v"])

    def blocked(self, origins: FloatArray, directions: FloatArray, reach: FloatArray) -> NDArray[np.bool_]:
        return np.asarray(self._scene.run(origins, directions, dists=reach, query="OCCLUDED")) != -1
