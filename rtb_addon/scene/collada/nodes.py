"""The tree of nodes: what stands where, in metres with Z up."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ...errors import RecipeError, at
from ...spectra import FloatArray
from ..document import Scene
from ..paths import Element, local_name
from .sources import child, children, text_of
from .transforms import local_matrix

# What becomes of X, Y, Z of a document when Z is up, by its up_axis.
_UP = {
    "Z_UP": np.eye(3),
    "Y_UP": np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
    "X_UP": np.array([[0.0, -1, 0], [0, 0, -1], [1, 0, 0]]),
}


class Instance(NamedTuple):
    """
    Something that stands in the scene.

    Parameters
    ----------
    kind : geometry, light, camera or controller
    node : the node that places it
    to_world : (4, 4) array [m]
    thing : what is placed, an element of a library
    link : the instance_ element, where materials are bound
    """

    kind: str
    node: Element
    to_world: FloatArray
    thing: Element
    link: Element

    @property
    def name(self) -> str:
        """What a person calls it: the node's name, or its id."""
        return self.node.get("name") or self.node.get("id") or "a node without a name"


def metres_per_unit(document: Scene) -> float:
    """Return the document's unit [m]."""
    unit = child(document.root, "asset", "unit")
    with at(document.file, None if unit is None else document.line_of(unit)):
        metres = 1.0 if unit is None else float(unit.get("meter", 1.0))
        if not 0 < metres < np.inf:
            raise ValueError(f"the unit is {metres} m, it must be above 0")
    return metres


def instances(document: Scene) -> Iterator[Instance]:
    """Yield what the visual scene holds, in the order of the document."""
    world = np.eye(4)
    world[:3, :3] = axes_up(document) * metres_per_unit(document)
    for node in children(visual_scene(document), "node"):
        yield from _below(document, node, world, ())


def axes_up(document: Scene) -> FloatArray:
    """Return what becomes of a document's axes where Z is up, (3, 3)."""
    up = text_of(child(document.root, "asset", "up_axis")) or "Y_UP"
    if up not in _UP:
        raise RecipeError(f"up_axis is {up}, want one of {', '.join(_UP)}", document.file)
    return _UP[up]


def visual_scene(document: Scene) -> Element:
    """Return the element that holds a document's nodes."""
    chosen = child(document.root, "scene", "instance_visual_scene")
    if chosen is not None:
        return document.linked(chosen.get("url"), "visual_scene")
    first = child(document.root, "library_visual_scenes", "visual_scene")
    if first is None:
        raise RecipeError("it holds no visual_scene", document.file)
    return first


def _below(
    document: Scene, node: Element, parent: FloatArray, above: tuple[Element, ...]
) -> Iterator[Instance]:
    if node in above:
        raise RecipeError(f"the node {node.get('id')} holds itself", document.file, document.line_of(node))
    with at(document.file, document.line_of(node)):
        to_world = parent @ local_matrix(node)
    for each in node:
        kind = local_name(each)
        if kind in ("instance_geometry", "instance_light", "instance_camera", "instance_controller"):
            kind = kind.removeprefix("instance_")
            yield Instance(kind, node, to_world, document.linked(each.get("url"), kind), each)
        elif kind == "instance_node":
            linked = document.linked(each.get("url"), "node")
            yield from _below(document, linked, to_world, (*above, node))
    for inner in children(node, "node"):
        yield from _below(document, inner, to_world, (*above, node))
