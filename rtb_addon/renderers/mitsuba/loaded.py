"""
A scene in Mitsuba's memory: what is as it was in the last rendering is not loaded again.

Objects go by what the file says of them. Other spectra are other tables and touch nothing here; another
camera or material is loaded by itself; a shape that moved has the scene put together anew, of shapes that are
there. Big meshes of small pictures are placed by a matrix, each in a tree of its own, which is ready in a
quarter of the time. Which meshes these are is decided by the native scene alone, so that a rendering is the
same whatever was rendered before it.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

import copy
import gc
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as Xml

import mitsuba as mi
import numpy as np

from ...errors import RenderingError
from ..ply import count_triangles
from .native import Native
from .one_hot import OneHotScene

# A placed mesh is ready sooner, by a microsecond a triangle, and slower to follow paths through, by a tenth
# of one a path. With few triangles neither can be seen.
_PATHS_PER_TRIANGLE, _MANY_TRIANGLES = 5, 20_000

# What the content of a placed mesh's tree begins with.
_TREE = "tree "


@dataclass(frozen=True, eq=False)
class LoadedScene:
    """
    A scene ready to be rendered.

    Parameters
    ----------
    scene, sensor : Mitsuba's
    materials, emitters, shapes : Mitsuba's objects by their ids in the native scene
    unwrapped : 1 for each shape whose points have texture coordinates, by its id
    """

    scene: Any
    sensor: Any
    materials: Mapping[str, Any]
    emitters: Mapping[str, Any]
    shapes: Mapping[str, Any]
    unwrapped: Mapping[str, int]


@dataclass
class _Kept:
    """What was loaded for the last rendering, by its content."""

    variant: str = ""
    objects: dict[str, Any] = field(default_factory=dict)
    parts: tuple[str, ...] = ()
    scene: Any = None

    def let_go(self, wanted: Collection[str], parts: tuple[str, ...]) -> None:
        """
        Forget what nobody needs any more, before something new is made.

        Kernels know every object that is alive by its number, and a new object takes the number of one that
        is gone: only so does a shape that moved not look like one more.
        """
        if self.variant != mi.variant():
            self.variant, wanted = mi.variant(), ()
        stale = self.objects.keys() - set(wanted)
        if stale or parts != self.parts:
            self.scene = None
        self.parts = parts
        for content in stale:
            del self.objects[content]
        if stale:
            self._take_off_paint()
            gc.collect()

    def _take_off_paint(self) -> None:
        """Have shapes that stay let go of their materials, which are put on again when all are there."""
        blank = mi.load_dict({"type": "null"})
        for content, each in self.objects.items():
            if isinstance(each, mi.Shape) and not content.startswith(_TREE):
                each.set_bsdf(blank)

    def take(self, content: str, make: Callable[[], Any]) -> Any:
        """Return an object, made if it is not there."""
        if content not in self.objects:
            self.objects[content] = make()
        return self.objects[content]

    def load(self, node: Xml.Element) -> Any:
        """Return the object of an element, loaded if it is not there."""
        return self.take(_content(node), lambda: _load(node))


_kept = _Kept()


def load(source: OneHotScene, native: Native) -> LoadedScene:
    """Return a scene, with as much of the last one in it as is the same."""
    root, paths = Xml.fromstring(source.xml), native.part.width * native.part.height * native.samples
    shapes = [_shape(node, number, paths) for number, node in enumerate(root.findall("shape"))]
    used = {shape.material for shape in shapes}
    # Materials that nothing is made of would only make kernels longer.
    paints = {_id(node): node for node in root.findall("bsdf") if _id(node) in used}
    lamps = {_id(node): node for node in root.findall("emitter")}
    sensor = next(root.iter("sensor"))
    parts = [part for shape in shapes for part in shape.parts] + [_content(node) for node in lamps.values()]
    single = {_content(node) for node in (*paints.values(), sensor)}
    _kept.let_go({*single, *parts, *(shape.content for shape in shapes)}, tuple(dict.fromkeys(parts)))
    materials = {name: _kept.load(node) for name, node in paints.items()}
    loaded = {shape.name: _put(shape, materials[shape.material]) for shape in shapes}
    emitters = {shape.emission: loaded[shape.name].emitter() for shape in shapes if shape.emission}
    emitters |= {name: _kept.load(node) for name, node in lamps.items()}
    meshes = {shape.name: _kept.objects[shape.content] for shape in shapes}
    unwrapped = {name: 1 for name, mesh in meshes.items() if _has_uvs(mesh)}
    return LoadedScene(_together(), _kept.load(sensor), materials, emitters, loaded, unwrapped)


def _has_uvs(shape: Any) -> bool:
    return isinstance(shape, mi.Mesh) and shape.has_vertex_texcoords()


def _together() -> Any:
    """Return the scene of all parts: the last one, if it had the same."""
    if _kept.scene is None:
        named = {f"part-{number}": _kept.objects[part] for number, part in enumerate(_kept.parts)}
        _kept.scene = mi.load_dict({"type": "scene", **named}, parallel=False, optimize=False)
    return _kept.scene


@dataclass(frozen=True, eq=False)
class _Shape:
    """
    A shape that is to be loaded.

    Parameters
    ----------
    name, material, emission : ids of it, of its material, and of the emitter that it is, if any
    node : the element without its material, and without its matrix where it is placed
    matrix : rows of a placed mesh's matrix, else none
    """

    name: str
    material: str
    emission: str
    node: Xml.Element
    matrix: Sequence[Sequence[float]] = ()

    @cached_property
    def content(self) -> str:
        """What tells the loaded shape from others; a mesh that is placed serves many."""
        return f"{_content(self.node)} {self.material if self.matrix else self.name}"

    @property
    def parts(self) -> list[str]:
        """What tells from others what becomes a part of the scene."""
        placed = f"{self.name} {self.matrix} {self.content}"
        return [f"{_TREE}{self.content}", placed] if self.matrix else [self.content]


def _shape(node: Xml.Element, number: int, paths: int) -> _Shape:
    emitter = node.find("emitter")
    emission = _id(emitter) if emitter is not None else ""
    name = node.get("id") or emission or f"shape-{number}"
    alone = copy.copy(node)
    material = next((each.get("id", "") for each in _taken(alone, "ref")), "")
    if not material:
        raise RenderingError(f"the native scene's {name} has no material, give it the ref of one")
    if emission or not _is_big(node, paths):
        return _Shape(name, material, emission, alone)
    alone.attrib = {"type": "ply"}
    words = _taken(alone, "transform")[0][0].get("value", "").split()
    rows = [[float(word) for word in words[start : start + 4]] for start in range(0, 16, 4)]
    return _Shape(name, material, emission, alone, rows)


def _put(shape: _Shape, material: Any) -> Any:
    """Return a shape of a material."""
    mesh = _kept.take(shape.content, lambda: _load(shape.node))
    mesh.set_bsdf(material)
    if not shape.matrix:
        return mesh
    tree, placed = shape.parts
    group = _kept.take(tree, lambda: mi.load_dict({"type": "shapegroup", "mesh": mesh}))
    to_world = mi.ScalarTransform4f(np.array(shape.matrix))
    instance = _kept.take(
        placed, lambda: mi.load_dict({"type": "instance", "tree": group, "to_world": to_world})
    )
    # A grey material of its own would be one more in every kernel.
    instance.set_bsdf(material)
    return instance


def _load(node: Xml.Element) -> Any:
    alone = copy.copy(node)
    alone.attrib = {**node.attrib, "version": "3.0.0"}
    return mi.load_string(Xml.tostring(alone, encoding="unicode"), parallel=False, optimize=False)


def _content(node: Xml.Element) -> str:
    """Return what tells an object from others: its element, and the sizes and times of its files."""
    files = (Path(each.get("value", "")) for each in node.iter("string") if each.get("name") == "filename")
    stamps = (file.stat() for file in files if file.is_file())
    words = [f"{status.st_size} {status.st_mtime_ns}" for status in stamps]
    return " ".join([Xml.tostring(node, encoding="unicode"), *words])


def _is_big(shape: Xml.Element, paths: int) -> bool:
    """Return whether a mesh has so many triangles for so few paths that it is better placed."""
    if shape.get("type") != "ply":
        return False
    file = next(each.get("value", "") for each in shape.iter("string") if each.get("name") == "filename")
    triangles = count_triangles(Path(file))
    return triangles >= _MANY_TRIANGLES and paths < _PATHS_PER_TRIANGLE * triangles


def _taken(node: Xml.Element, tag: str) -> list[Xml.Element]:
    """Remove the children of a tag, and return them."""
    found = node.findall(tag)
    for child in found:
        node.remove(child)
    return found


def _id(node: Xml.Element) -> str:
    return node.get("id", node.get("type", ""))
