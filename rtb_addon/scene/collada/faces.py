"""The faces of a Collada primitive: triangles, polygons, strips or fans, as corners of triangles."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...spectra import FloatArray
from ..holes import bridged
from ..paths import Element, local_name
from ..render_scene import IntArray
from ..triangulation import triangulate
from .sources import child, children, integers


class Faces(NamedTuple):
    """
    The faces of a primitive.

    Parameters
    ----------
    counts : (outlines,) array, corners of each
    indices : (corners, inputs) array
    holes : outline -> how many of the outlines behind it are holes in it
    """

    counts: IntArray
    indices: IntArray
    holes: dict[int, int]

    def triangles(self, points: FloatArray) -> IntArray:
        """Return (triangles, 3) corners, given where all corners are."""
        if not self.holes:
            return triangulate(self.counts, points)
        rings = np.split(np.arange(len(points)), np.cumsum(self.counts)[:-1])
        outlines, inside = [], 0
        for place, ring in enumerate(rings):
            if inside:
                inside -= 1
                continue
            inside = self.holes.get(place, 0)
            outlines.append(bridged(ring, rings[place + 1 : place + 1 + inside], points) if inside else ring)
        corners = np.concatenate(outlines)
        return corners[triangulate(np.array([len(each) for each in outlines]), points[corners])]


def read_faces(primitive: Element, least_stride: int) -> Faces:
    """
    Return the faces of a primitive; ValueError where its indices do not make up any.

    Parameters
    ----------
    least_stride : indices that each corner has at least
    """
    offsets = [int(each.get("offset", 0)) for each in children(primitive, "input")]
    stride = max(least_stride, 1 + max(offsets, default=0))
    outlines, holes = _outlines(primitive)
    if any(len(each) % stride for each in outlines):
        raise ValueError(f"its {local_name(primitive)} need {stride} indices for each corner")
    indices = np.concatenate([*outlines, np.zeros(0, np.int64)]).reshape(-1, stride)
    lengths = np.array([len(each) // stride for each in outlines], np.int64)
    if local_name(primitive) in ("tristrips", "trifans"):
        corners = _stripped(local_name(primitive), lengths)
        return Faces(np.full(len(corners) // 3, 3), indices[corners], {})
    counts = _counts(primitive, lengths)
    if counts.sum() != len(indices):
        raise ValueError(f"its {local_name(primitive)} have {len(indices)} corners, want {counts.sum()}")
    return Faces(counts, indices, holes)


def _outlines(primitive: Element) -> tuple[list[IntArray], dict[int, int]]:
    """Return lists of indices, holes behind the outline they are in, and how many holes follow an outline."""
    found: list[IntArray] = []
    holes: dict[int, int] = {}
    for each in primitive:
        if local_name(each) == "p":
            found.append(integers(each))
        elif local_name(each) == "ph":
            inner = children(each, "h")
            if (outline := child(each, "p")) is None:
                raise ValueError("a polygon with holes has no outline")
            holes[len(found)] = len(inner)
            found += map(integers, (outline, *inner))
    return found, {first: count for first, count in holes.items() if count}


def _stripped(kind: str, lengths: IntArray) -> IntArray:
    """Return the corners of the triangles of strips or fans, three by three."""
    found = [np.zeros((0, 3), np.int64)]
    starts = np.cumsum(lengths) - lengths
    for start, length in zip(starts, lengths, strict=True):
        first = np.arange(max(length - 2, 0))
        triangles = start + first[:, None] + np.arange(3)
        if kind == "trifans":
            triangles[:, 0] = start
        else:
            triangles[1::2, :2] = triangles[1::2, 1::-1]
        found.append(triangles)
    return np.concatenate(found).ravel()


def _counts(primitive: Element, lengths: IntArray) -> IntArray:
    if local_name(primitive) == "triangles":
        return np.full(-(-int(lengths.sum()) // 3), 3)
    if local_name(primitive) == "polygons":
        return lengths
    counted = child(primitive, "vcount")
    return np.zeros(0, np.int64) if counted is None else integers(counted)
