"""The tree of nodes: what stands where, in metres with Z up."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from ..errors import RecipeError, at
from ..spectra import FloatArray
from .collada_sources import child, children, floats, text_of
from .document import Scene
from .paths import Element, local_name

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
    up = text_of(child(document.root, "asset", "up_axis")) or "Y_UP"
    if up not in _UP:
        raise RecipeError(f"up_axis is {up}, want one of {', '.join(_UP)}", document.file)
    world = np.eye(4)
    world[:3, :3] = _UP[up] * metres_per_unit(document)
    for node in children(_visual_scene(document), "node"):
        yield from _below(document, node, world, ())


def _visual_scene(document: Scene) -> Element:
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
    to_world = parent @ _local_matrix(document, node)
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


def _local_matrix(document: Scene, node: Element) -> FloatArray:
    """Return what a node's transforms do together; the last one acts first."""
    matrix = np.eye(4)
    for each in node:
        name = local_name(each)
        with at(document.file, document.line_of(each)):
            if name == "skew":
                raise ValueError(f"the node {node.get('id')} is skewed, apply its transform in the modeller")
            if name in _TRANSFORMS:
                count, make = _TRANSFORMS[name]
                matrix = matrix @ make(_of_node(node, each, count))
    return matrix


def _of_node(node: Element, each: Element, count: int) -> FloatArray:
    try:
        return floats(each, count)
    except ValueError as error:
        raise ValueError(f"{error}, in the node {node.get('id')}") from error


def _translation(numbers: FloatArray) -> FloatArray:
    matrix = np.eye(4)
    matrix[:3, 3] = numbers
    return matrix


def _scale(numbers: FloatArray) -> FloatArray:
    return np.diag([*numbers, 1.0])


def _rotation(numbers: FloatArray) -> FloatArray:
    """Return a turn about an axis by an angle [degrees] (Rodrigues)."""
    length = float(np.linalg.norm(numbers[:3]))
    if length == 0:
        raise ValueError("a rotate needs an axis, not 0 0 0")
    x, y, z = numbers[:3] / length
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(numbers[3])
    matrix = np.eye(4)
    matrix[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return matrix


def _look_at(numbers: FloatArray) -> FloatArray:
    """Return where something stands that looks along its -Z axis from an eye to a point, +Y up."""
    eye, point, up = numbers.reshape(3, 3)
    back = eye - point
    right = np.cross(up, back)
    if not np.linalg.norm(right) > 0:
        raise ValueError("a lookat needs two points and a direction up that is not the way it looks")
    columns = [right, np.cross(back, right), back]
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([each / np.linalg.norm(each) for each in columns], axis=1)
    matrix[:3, 3] = eye
    return matrix


_TRANSFORMS: dict[str, tuple[int, Callable[[FloatArray], FloatArray]]] = {
    "matrix": (16, lambda numbers: numbers.reshape(4, 4)),
    "translate": (3, _translation),
    "rotate": (4, _rotation),
    "scale": (3, _scale),
    "lookat": (9, _look_at),
}
