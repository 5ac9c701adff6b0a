"""A Collada geometry made into meshes, one for each of its primitives."""

from __future__ import annotations

import hashlib
from collections import OrderedDict
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..spectra import FloatArray
from .collada_sources import child, children, integers, read_source
from .paths import Element, local_name
from .render_scene import IntArray, Mesh
from .triangulation import triangulate
from .welding import welded

_DRAWN = ("triangles", "polylist", "polygons")
_REFUSED = ("trifans", "tristrips")
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


# Geometries read already, the latest last: the conditions of a recipe mostly share theirs.
_read: OrderedDict[bytes, tuple[Part, ...]] = OrderedDict()
_KEPT = 256


def geometry_parts(geometry: Element) -> tuple[Part, ...]:
    """Return a geometry's parts; the same objects for the same content."""
    from lxml import etree

    content = etree.tostring(geometry, with_tail=False)
    key = hashlib.blake2b(content, digest_size=20).digest()
    if key not in _read:
        _read[key] = read_geometry(geometry)
        if len(_read) > _KEPT:
            _read.popitem(last=False)
    _read.move_to_end(key)
    return _read[key]


def read_geometry(geometry: Element) -> tuple[Part, ...]:
    """Return a geometry's parts, in the order of the document; ValueError where it cannot be read."""
    mesh = child(geometry, "mesh")
    if mesh is None:
        raise ValueError(f"{geometry.get('id')} holds no mesh, export it as one")
    by_id = {each.get("id"): each for each in mesh.iter() if each.get("id")}
    tables: dict[tuple[str, int], FloatArray] = {}
    try:
        return tuple(_parts(mesh, by_id, tables))
    except ValueError as error:
        raise ValueError(f"{geometry.get('id')}: {error}") from error


def _parts(mesh: Element, by_id: dict, tables: dict) -> Iterator[Part]:
    for primitive in mesh:
        if local_name(primitive) in _REFUSED:
            raise ValueError(f"{local_name(primitive)} are not read, export triangles or polygons")
        if local_name(primitive) in _DRAWN and (part := _read_primitive(primitive, by_id, tables)):
            yield Part(primitive.get("material", ""), part)


def _read_primitive(primitive: Element, by_id: dict, tables: dict) -> Mesh | None:
    inputs = _inputs(primitive, by_id)
    counts, indices = _corners(primitive, 1 + max(each.offset for each in inputs.values()))
    values = {}
    for semantic, each in inputs.items():
        key = (each.source, _WIDTHS[semantic])
        if key not in tables:
            tables[key] = read_source(by_id[each.source], by_id, key[1])
        column = indices[:, each.offset]
        if len(column) and not 0 <= column.min() <= column.max() < len(tables[key]):
            raise ValueError(f"an index of {each.source} is not among its {len(tables[key])} rows")
        values[semantic] = tables[key], column
    points, places = values["POSITION"]
    triangles = triangulate(counts, points[places])
    return welded(triangles, values["POSITION"], values.get("NORMAL"), values.get("TEXCOORD"))


def _inputs(primitive: Element, by_id: dict) -> dict[str, _Input]:
    """Return the inputs by their meaning; of several texture coordinates the first set."""
    found: dict[str, _Input] = {}
    for each in sorted(children(primitive, "input"), key=lambda one: int(one.get("set", 0))):
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


def _corners(primitive: Element, least_stride: int) -> tuple[IntArray, IntArray]:
    """Return each polygon's number of corners, and (corners, inputs) indices."""
    offsets = [int(each.get("offset", 0)) for each in children(primitive, "input")]
    stride = max(least_stride, 1 + max(offsets, default=0))
    if children(primitive, "ph"):
        raise ValueError("polygons with holes are not read, export triangles")
    lists = [integers(each) for each in children(primitive, "p")]
    if any(len(each) % stride for each in lists):
        raise ValueError(f"its {local_name(primitive)} need {stride} indices for each corner")
    indices = np.concatenate([*lists, np.zeros(0, np.int64)]).reshape(-1, stride)
    counts = _counts(primitive, [len(each) // stride for each in lists])
    if counts.sum() != len(indices):
        raise ValueError(f"its {local_name(primitive)} have {len(indices)} corners, want {counts.sum()}")
    return counts, indices


def _counts(primitive: Element, lengths: list[int]) -> IntArray:
    if local_name(primitive) == "triangles":
        return np.full(-(-sum(lengths) // 3), 3)
    if local_name(primitive) == "polygons":
        return np.array(lengths, np.int64)
    counted = child(primitive, "vcount")
    return np.zeros(0, np.int64) if counted is None else integers(counted)
