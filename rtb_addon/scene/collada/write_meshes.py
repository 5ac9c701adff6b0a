"""Triangles as Collada's geometries, and their use by nodes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

import numpy as np

from ...spectra import FloatArray
from ..surface import IntArray, Surface
from .write_elements import Element, new
from .write_numbers import floats, indices


class LongTexts:
    """Arrays of numbers, kept beside the elements: an XML library would look at each of their letters."""

    _PLACE = re.compile(rb"(?<=>)\[\[(\d+)\]\](?=<)")

    def __init__(self) -> None:
        self._texts: list[bytes] = []

    def keep(self, text: bytes) -> str:
        """Return what stands for a text until the document is whole; nothing else can look like it."""
        self._texts.append(text)
        return f"[[{len(self._texts) - 1}]]"

    def put_into(self, document: bytes) -> bytes:
        """Return a document with each text in its place."""
        parts: list[bytes] = self._PLACE.split(document)
        parts[1::2] = [self._texts[int(number)] for number in parts[1::2]]
        return b"".join(parts)


def geometry(id: str, name: str, surface: Surface, texts: LongTexts) -> Element:
    """Return triangles with their normals and texture coordinates."""
    mesh = new("mesh", _source(f"{id}-positions", surface.vertices, "XYZ", texts))
    inputs, places = [("VERTEX", f"{id}-vertices")], [surface.triangles]
    for semantic, part, axes, channel in (
        ("NORMAL", f"{id}-normals", "XYZ", surface.normals),
        ("TEXCOORD", f"{id}-map-0", "ST", surface.uvs),
    ):
        if channel is not None:
            mesh.append(_source(part, channel.values, axes, texts))
            inputs.append((semantic, part))
            places.append(channel.indices)
    position = new("input", semantic="POSITION", source=f"#{id}-positions")
    mesh.append(new("vertices", position, id=f"{id}-vertices"))
    for symbol, corners in _parts(surface, np.stack(places, axis=-1, dtype=np.int32, casting="same_kind")):
        mesh.append(_triangles(symbol, inputs, corners, texts))
    return new("geometry", mesh, id=id, name=name)


def _source(id: str, values: FloatArray, axes: str, texts: LongTexts) -> Element:
    count = len(values)
    text = texts.keep(floats(values))
    array = new("float_array", text=text, id=f"{id}-array", count=count * len(axes))
    params = [new("param", name=axis, type="float") for axis in axes]
    accessor = new("accessor", *params, source=f"#{id}-array", count=count, stride=len(axes))
    return new("source", array, new("technique_common", accessor), id=id)


def _parts(surface: Surface, corners: IntArray) -> Iterator[tuple[str, IntArray]]:
    """Yield the symbols that have triangles, with the corners of those."""
    if len(surface.symbols) < 2:
        yield "".join(surface.symbols), corners
        return
    for part, symbol in enumerate(surface.symbols):
        if len(chosen := corners[surface.parts == part]):
            yield symbol, chosen


def _triangles(symbol: str, inputs: list[tuple[str, str]], corners: IntArray, texts: LongTexts) -> Element:
    named = {"material": symbol} if symbol else {}
    triangles = new("triangles", **named, count=len(corners))
    for offset, (semantic, source) in enumerate(inputs):
        triangles.append(new("input", semantic=semantic, source=f"#{source}", offset=offset))
    if inputs[-1][0] == "TEXCOORD":
        triangles[-1].set("set", "0")
    triangles.append(new("p", text=texts.keep(indices(corners))))
    return triangles


def instance_geometry(id: str, name: str, bound: Mapping[str, str], has_uvs: bool) -> Element:
    """Return the use of a geometry, with the material for each of its symbols."""
    used = new("instance_geometry", url=f"#{id}", name=name)
    instances = [
        new("instance_material", symbol=symbol, target=f"#{target}") for symbol, target in bound.items()
    ]
    if has_uvs:
        for each in instances:
            words = {"semantic": "UVMap", "input_semantic": "TEXCOORD", "input_set": "0"}
            each.append(new("bind_vertex_input", **words))
    if instances:
        used.append(new("bind_material", new("technique_common", *instances)))
    return used
