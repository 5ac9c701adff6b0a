"""The elements of a Collada 1.4.1 document, in the order of the format."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from lxml import etree

from ..spectra import FloatArray
from .collada_sources import PROFILE
from .placement import Placement
from .surface import IntArray, Surface
from .write_numbers import floats, indices, number, numbers

NAMESPACE = "http://www.collada.org/2005/11/COLLADASchema"
# An lxml element.
Element = Any
Colour = Sequence[float]
# A document needs a time; one that changed would make the same scene another file.
_TIME = "1970-01-01T00:00:00"


def new(tag: str, /, *children: Element, text: str | None = None, **attributes: object) -> Element:
    """Return an element; names of attributes may end in ``_`` where Python needs that."""
    words = {key.rstrip("_"): str(value) for key, value in attributes.items()}
    element = etree.Element(f"{{{NAMESPACE}}}{tag}", words, nsmap={None: NAMESPACE})
    element.text = text
    element.extend(children)
    return element


def asset(tool: str, meter: float) -> Element:
    """Return who made the document, and how long its unit is [m]."""
    return new(
        "asset",
        new("contributor", new("authoring_tool", text=tool)),
        new("created", text=_TIME),
        new("modified", text=_TIME),
        new("unit", name="meter", meter=number(meter)),
        new("up_axis", text="Z_UP"),
    )


def camera(
    id: str, name: str, view: Element, shift: tuple[float, float], lens: tuple[float, float] | None = None
) -> Element:
    """
    Return a camera.

    Parameters
    ----------
    view : perspective() or orthographic()
    shift : of the picture, right and up, as fractions of its longer side
    lens : radius of a thin lens and the distance that is sharp [scene units]; None for a pinhole
    """
    optics = new("optics", new("technique_common", view))
    parts = [_technique(_extra_numbers(("shiftx", "shifty"), shift))]
    if lens is not None:
        parts.append(_technique(_extra_numbers(("lens_radius", "focus_distance"), lens), PROFILE))
    return new("camera", optics, new("extra", *parts), id=id, name=name)


def perspective(xfov: float, aspect: float, clip: tuple[float, float], yfov: float | None = None) -> Element:
    """
    Return a perspective view.

    Parameters
    ----------
    xfov : angle across the width of the picture [degrees]
    aspect : width by height of the picture; not written where yfov is given
    clip : near and far [scene units]
    yfov : angle across the height [degrees], where pixels are not square
    """
    height = _aspect(aspect) if yfov is None else new("yfov", sid="yfov", text=number(yfov))
    return new("perspective", new("xfov", sid="xfov", text=number(xfov)), height, *_clip(clip))


def orthographic(
    width: float, aspect: float, clip: tuple[float, float], height: float | None = None
) -> Element:
    """Return a parallel view of a width and perhaps a height [scene units]; Collada writes the halves."""
    second = _aspect(aspect) if height is None else new("ymag", sid="ymag", text=number(height / 2))
    return new("orthographic", new("xmag", sid="xmag", text=number(width / 2)), second, *_clip(clip))


def _aspect(aspect: float) -> Element:
    return new("aspect_ratio", text=number(aspect))


def _clip(clip: tuple[float, float]) -> list[Element]:
    near, far = map(number, clip)
    return [new("znear", sid="znear", text=near), new("zfar", sid="zfar", text=far)]


def light(id: str, name: str, kind: str, colour: Colour, cone: float, blend: float) -> Element:
    """
    Return a lamp: ``point`` or ``spot`` with the square of the distance, ``directional`` or ``ambient``.

    Parameters
    ----------
    colour : linear Rec.709 components of what the kind is measured in
    cone, blend : of a spot: the full angle [degrees] and how much of it is a soft edge, as Blender wrote them
    """
    lamp = new(kind, new("color", sid="color", text=numbers(colour)))
    if kind not in ("directional", "ambient"):
        lamp.extend(new(f"{term}_attenuation", text="0") for term in ("constant", "linear"))
        lamp.append(new("quadratic_attenuation", text="1"))
    if kind == "spot":
        lamp.append(new("falloff_angle", sid="fall_off_angle", text=number(cone)))
        lamp.append(new("falloff_exponent", sid="fall_off_exponent", text=number(blend)))
    return new("light", new("technique_common", lamp), id=id, name=name)


def effect(id: str, colour: Colour) -> Element:
    """Return what a matte surface of a colour does: linear Rec.709, and one for opaque."""
    black = new("emission", new("color", sid="emission", text="0 0 0 1"))
    diffuse = new("diffuse", new("color", sid="diffuse", text=numbers([*colour, 1])))
    technique = new("technique", new("lambert", black, diffuse), sid="common")
    return new("effect", new("profile_COMMON", technique), id=id)


def material(id: str, name: str, effect_id: str) -> Element:
    """Return a material."""
    return new("material", new("instance_effect", url=f"#{effect_id}"), id=id, name=name)


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


def transform(where: Placement | Any) -> list[Element]:
    """Return a node's transform: separate parts as Blender's exporter called them, or a (4, 4) matrix."""
    if not isinstance(where, Placement):
        return [new("matrix", sid="transform", text=numbers(where))]
    turns = [
        new("rotate", sid=f"rotation{axis}", text=f"{numbers(np.eye(3)[k])} {number(where.rotation[k])}")
        for k, axis in ((2, "Z"), (1, "Y"), (0, "X"))
    ]
    location = new("translate", sid="location", text=numbers(where.location))
    return [location, *turns, new("scale", sid="scale", text=numbers(where.scale))]


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


def instance(kind: str, id: str) -> Element:
    """Return the use of a ``camera`` or ``light``."""
    return new(f"instance_{kind}", url=f"#{id}")


def node(id: str, name: str, *content: Element) -> Element:
    """Return a node of the scene's hierarchy."""
    return new("node", *content, id=id, name=name, type="NODE")


def document(
    head: Element,
    libraries: Mapping[str, Sequence[Element]],
    nodes: Element,
    texts: LongTexts,
) -> bytes:
    """
    Return a whole document.

    Parameters
    ----------
    libraries : elements by the name of their library
    nodes : the visual scene
    texts : those of the geometries
    """
    root = new("COLLADA", head, version="1.4.1")
    root.extend(new(name, *elements) for name, elements in libraries.items() if elements)
    root.append(new("library_visual_scenes", nodes))
    root.append(new("scene", new("instance_visual_scene", url=f"#{nodes.get('id')}")))
    return texts.put_into(etree.tostring(root, xml_declaration=True, encoding="utf-8", pretty_print=True))


def _technique(parts: Sequence[Element], profile: str = "blender") -> Element:
    return new("technique", *parts, profile=profile)


def _extra_numbers(names: Sequence[str], values: Sequence[float]) -> list[Element]:
    return [_extra_number(name, value) for name, value in zip(names, values, strict=True)]


def _extra_number(name: str, value: float) -> Element:
    return new(name, sid=name, type="float", text=number(value))
