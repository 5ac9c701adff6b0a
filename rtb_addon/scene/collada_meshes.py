"""A Collada geometry made into meshes, one for each of its primitives."""

from __future__ import annotations

import hashlib
from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

import numpy as np

from ..spectra import FloatArray
from .collada_sources import child, children, integers, read_source
from .holes import bridged
from .paths import Element, local_name
from .render_scene import IntArray, Mesh
from .triangulation import triangulate
from .welding import welded

_DRAWN = ("triangles", "polylist", "polygons", "tristrips", "trifans")
_LINES = ("lines", "linestrips")
_WIDTHS = {"POSITION": 3, "NORMAL": 3, "TEXCOORD": 2}


class Part(NamedTuple):
    """
    The part of a geometry that has one material.

    Parameters
    ----------
    symbol : name for its material, bound where the geometry is used; may be empty
    mesh : its triangles
    """

    symbol: str
    mesh: Mesh


class _Input(NamedTuple):
    semantic: str
    source: str
    offset: int


class _Faces(NamedTuple):
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


class _Known:
    """Geometries read already, the latest last: the conditions of a recipe mostly share theirs."""

    def __init__(self) -> None:
        self._parts: OrderedDict[bytes, tuple[Part, ...]] = OrderedDict()
        self._triangles = 0

    def find(self, key: bytes, read: Callable[[], tuple[Part, ...]]) -> tuple[Part, ...]:
        """Return the parts of a geometry, read where they are not known."""
        if key not in self._parts:
            self._parts[key] = read()
            self._triangles += _size(self._parts[key])
            while len(self._parts) > 1 and (self._triangles > _MOST_TRIANGLES or len(self._parts) > _MOST):
                self._triangles -= _size(self._parts.popitem(last=False)[1])
        self._parts.move_to_end(key)
        return self._parts[key]


def _size(parts: tuple[Part, ...]) -> int:
    return sum(len(part.mesh.triangles) for part in parts)


_MOST, _MOST_TRIANGLES = 50_000, 8_000_000
_known = _Known()


def geometry_parts(geometry: Element, uv_sets: Mapping[str, int] | None = None) -> tuple[Part, ...]:
    """
    Return a geometry's parts; the same objects for the same content.

    Parameters
    ----------
    uv_sets : which set of texture coordinates a part takes, by its symbol; the first one where unsaid
    """
    from lxml import etree

    content = etree.tostring(geometry, with_tail=False)
    chosen = repr(sorted((uv_sets or {}).items())).encode()
    key = hashlib.blake2b(content, digest_size=20).digest() + chosen
    return _known.find(key, lambda: read_geometry(geometry, uv_sets))


def read_geometry(geometry: Element, uv_sets: Mapping[str, int] | None = None) -> tuple[Part, ...]:
    """Return a geometry's parts, in the order of the document; ValueError where it cannot be read."""
    mesh = _mesh(geometry)
    if mesh is None:
        return ()
    by_id = {each.get("id"): each for each in mesh.iter() if each.get("id")}
    tables: dict[tuple[str, int], FloatArray] = {}
    try:
        return tuple(_parts(mesh, by_id, tables, uv_sets or {}))
    except ValueError as error:
        raise ValueError(f"{geometry.get('id')}: {error}") from error


def left_out(geometry: Element) -> Iterator[str]:
    """Yield a sentence for what a geometry holds besides faces, which is not drawn."""
    name = geometry.get("name") or geometry.get("id")
    if (mesh := _mesh(geometry)) is None:
        yield f"{name} holds no mesh and is left out, export it as one"
        return
    if any(local_name(each) in _LINES for each in mesh):
        yield f"the lines of {name} are left out, only faces are drawn"


def _mesh(geometry: Element) -> Element | None:
    """Return a geometry's mesh, which Collada also has as a convex one."""
    return next((each for each in geometry if local_name(each) in ("mesh", "convex_mesh")), None)


def _parts(mesh: Element, by_id: dict, tables: dict, uv_sets: Mapping[str, int]) -> Iterator[Part]:
    for primitive in mesh:
        if local_name(primitive) in _DRAWN:
            symbol = primitive.get("material", "")
            if part := _read_primitive(primitive, by_id, tables, uv_sets.get(symbol)):
                yield Part(symbol, part)


def _read_primitive(primitive: Element, by_id: dict, tables: dict, uv_set: int | None) -> Mesh | None:
    inputs = _inputs(primitive, by_id, uv_set)
    faces = _corners(primitive, 1 + max(each.offset for each in inputs.values()))
    values = {}
    for semantic, each in inputs.items():
        key = (each.source, _WIDTHS[semantic])
        if key not in tables:
            tables[key] = read_source(by_id[each.source], by_id, key[1])
        column = faces.indices[:, each.offset]
        if len(column) and not 0 <= column.min() <= column.max() < len(tables[key]):
            raise ValueError(f"an index of {each.source} is not among its {len(tables[key])} rows")
        values[semantic] = tables[key], column
    points, places = values["POSITION"]
    triangles = _triangles(faces, points[places])
    return welded(triangles, values["POSITION"], values.get("NORMAL"), values.get("TEXCOORD"))


def _inputs(primitive: Element, by_id: dict, uv_set: int | None) -> dict[str, _Input]:
    """Return the inputs by their meaning; of several texture coordinates the wanted set, else the first."""
    found: dict[str, _Input] = {}

    def order(each: Element) -> tuple[bool, int]:
        number = int(each.get("set", 0))
        return number != uv_set, number

    for each in sorted(children(primitive, "input"), key=order):
        offset, source = int(each.get("offset", 0)), each.get("source", "")[1:]
        if source not in by_id:
            raise ValueError(f"there is no source #{source}")
        if each.get("semantic") == "VERTEX":
            for vertex in children(by_id[source], "input"):
                found.setdefault(
                    vertex.get("semantic"),
                    _Input(vertex.get("semantic"), vertex.get("source", "")[1:], offset),
                )
        else:
            found.setdefault(each.get("semantic"), _Input(each.get("semantic"), source, offset))
    if "POSITION" not in found:
        raise ValueError(f"its {local_name(primitive)} have no positions")
    missing = [each.source for each in found.values() if each.source not in by_id]
    if missing:
        raise ValueError(f"there is no source #{missing[0]}")
    return {semantic: each for semantic, each in found.items() if semantic in _WIDTHS}


def _corners(primitive: Element, least_stride: int) -> _Faces:
    offsets = [int(each.get("offset", 0)) for each in children(primitive, "input")]
    stride = max(least_stride, 1 + max(offsets, default=0))
    outlines, holes = _outlines(primitive)
    if any(len(each) % stride for each in outlines):
        raise ValueError(f"its {local_name(primitive)} need {stride} indices for each corner")
    indices = np.concatenate([*outlines, np.zeros(0, np.int64)]).reshape(-1, stride)
    lengths = np.array([len(each) // stride for each in outlines], np.int64)
    if local_name(primitive) in ("tristrips", "trifans"):
        corners = _stripped(local_name(primitive), lengths)
        return _Faces(np.full(len(corners) // 3, 3), indices[corners], {})
    counts = _counts(primitive, lengths)
    if counts.sum() != len(indices):
        raise ValueError(f"its {local_name(primitive)} have {len(indices)} corners, want {counts.sum()}")
    return _Faces(counts, indices, holes)


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


def _triangles(faces: _Faces, points: FloatArray) -> IntArray:
    """Return the triangles of all faces, (triangles, 3) corners."""
    if not faces.holes:
        return triangulate(faces.counts, points)
    ends = np.cumsum(faces.counts)
    rings = np.split(np.arange(len(points)), ends[:-1])
    outlines, inside = [], 0
    for place, ring in enumerate(rings):
        if inside:
            inside -= 1
            continue
        inside = faces.holes.get(place, 0)
        outlines.append(bridged(ring, rings[place + 1 : place + 1 + inside], points) if inside else ring)
    corners = np.concatenate(outlines)
    return corners[triangulate(np.array([len(each) for each in outlines]), points[corners])]


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
