"""A parent scene put into a Blender scene: its nodes under the names that give the same ids again."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np

from ..scene.collada.ids import clean
from ..scene.collada.nodes import axes_up, metres_per_unit, visual_scene
from ..scene.collada.sources import child, children, floats, text_of
from ..scene.collada.transforms import local_matrix
from ..scene.document import Scene
from ..scene.paths import Element, local_name
from .imported_things import make_camera, make_lamp, make_material, make_mesh

# The transforms of a node as Blender and its exporter separate them, in their order.
_SEPARATE = [
    ("translate", "location"),
    *(("rotate", f"rotation{axis}") for axis in "ZYX"),
    ("scale", "scale"),
]


@dataclass
class Importer:
    """
    Puts one document into a scene.

    Attributes
    ----------
    placed : ids of nodes whose place is to be written as one matrix, for mappings set it
    cameras : objects that are cameras, by the ids that a recipe may call them
    remarks : what is left out, a sentence each
    renamed : ids that become others when the scene is written, for their names were taken
    """

    document: Scene
    scene: bpy.types.Scene
    size: tuple[int, int]
    placed: frozenset[str] = frozenset()
    cameras: dict[str, bpy.types.Object] = field(default_factory=dict)
    remarks: list[str] = field(default_factory=list)
    renamed: dict[str, str] = field(default_factory=dict)
    _made: dict[str, Any] = field(default_factory=dict)

    def put(self) -> None:
        """Put everything into the scene; a file in which Z is not up stands on a turned empty."""
        unit = metres_per_unit(self.document)
        settings = self.scene.unit_settings
        settings.system, settings.scale_length = "METRIC", unit
        up = text_of(child(self.document.root, "asset", "up_axis")) or "Y_UP"
        root = None
        if up != "Z_UP":
            root = self._object(up, None)
            root.matrix_basis = np.vstack([np.c_[axes_up(self.document), [0, 0, 0]], [0, 0, 0, 1]]).T.tolist()
        for node in children(visual_scene(self.document), "node"):
            self._node(node, root)

    def _node(self, node: Element, parent) -> None:
        placed = [each for each in node if local_name(each).startswith("instance_")]
        contents = [content for each in placed if (content := self._content(each)) is not None]
        first = contents[0] if contents else None
        made = self._object(node.get("id") or node.get("name") or "Node", first, parent)
        self._note(node.get("id"), made.name, "")
        _place(made, node)
        made.rtb.as_matrix |= node.get("id") in self.placed
        for link, content in zip(placed, contents, strict=False):
            self._bind(made, link, content)
            if isinstance(content, bpy.types.Camera):
                for id in (node.get("id"), node.get("name"), link.get("url", "#")[1:]):
                    self.cameras.setdefault(id or "", made)
        for extra in contents[1:]:
            self._object(f"{made.name} {extra.name}", extra, made)
        for inner in children(node, "node"):
            self._node(inner, made)

    def _object(self, name: str, content, parent=None):
        made = bpy.data.objects.new(name, content)
        made.parent = parent
        self.scene.collection.objects.link(made)
        return made

    def _content(self, link: Element):
        kind = local_name(link).removeprefix("instance_")
        if kind not in ("geometry", "light", "camera"):
            self.remarks.append(f"a {kind} of the node is left out, it was {link.get('url')}")
            return None
        thing = self.document.linked(link.get("url"), kind)
        id = thing.get("id")
        if id not in self._made:
            made = self._make(kind, thing)
            if made is None:
                self.remarks.append(f"{id} is a light that Blender has not and left out")
            self._made[id] = made
            thing_made = made[0] if isinstance(made, tuple) else made
            if thing_made is not None:
                self._note(id, thing_made.name, "-mesh" if kind == "geometry" else f"-{kind}")
        found = self._made[id]
        return found[0] if isinstance(found, tuple) else found

    def _make(self, kind: str, thing: Element):
        if kind == "geometry":
            return make_mesh(thing)
        if kind == "light":
            return make_lamp(thing)
        return make_camera(thing, metres_per_unit(self.document), self.size)

    def _bind(self, made, link: Element, content) -> None:
        """Give an object the materials that its part's symbols are bound to."""
        if not isinstance(content, bpy.types.Mesh):
            return
        _, symbols = self._made[link.get("url", "#")[1:]]
        bound = {each.get("symbol"): each.get("target") for each in link.iter("{*}instance_material")}
        first_use = not len(content.materials)
        for slot, symbol in enumerate(symbols):
            material = self._material(bound.get(symbol), symbol)
            if first_use:
                content.materials.append(material)
            elif content.materials[slot] != material:
                made.material_slots[slot].link = "OBJECT"
                made.material_slots[slot].material = material

    def _material(self, target: str | None, symbol: str):
        element = self.document.linked(target, "material") if target else None
        if element is None:
            element = self.document.element(symbol) or self.document.element(f"{symbol}-material")
        key = "" if element is None else element.get("id")
        if key not in self._made:
            plain = element is None
            self._made[key] = bpy.data.materials.new("no") if plain else make_material(self.document, element)
            self._note(key, self._made[key].name, "-material")
        return self._made[key]

    def _note(self, id: str | None, name: str, suffix: str) -> None:
        """Note the id that a thing will have, where it is another one."""
        if id and (new := clean(name) + suffix) != id:
            self.renamed[id] = new


def _place(made, node: Element) -> None:
    """Give an object a node's transform, as the numbers that stand there where Blender has the same ones."""
    found = [(local_name(each), each.get("sid")) for each in node if local_name(each) in _TRANSFORMS]
    if found == _SEPARATE:
        parts = {each.get("sid"): floats(each) for each in node if each.get("sid")}
        made.location, made.scale = parts["location"].tolist(), parts["scale"].tolist()
        turns = [parts[f"rotation{axis}"] for axis in "XYZ"]
        if all(np.array_equal(turn[:3], np.eye(3)[k]) for k, turn in enumerate(turns)):
            made.rotation_euler = [math.radians(turn[3]) for turn in turns]
            return
    made.rtb.as_matrix = [kind for kind, _ in found] == ["matrix"]
    made.matrix_basis = local_matrix(node).T.tolist()


_TRANSFORMS = ("translate", "rotate", "scale", "matrix", "lookat", "skew")
