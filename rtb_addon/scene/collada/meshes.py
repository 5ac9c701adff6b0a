"""A Collada geometry made into meshes, one for each of its primitives."""

from __future__ import annotations

import hashlib
from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from ...spectra import FloatArray
from ..paths import Element, local_name
from ..render_scene import Mesh
from ..welding import welded
from .faces import read_faces
from .sources import children, read_source

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
    faces = read_faces(primitive, 1 + max(each.offset for each in inputs.values()))
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
    triangles = faces.triangles(points[places])
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
