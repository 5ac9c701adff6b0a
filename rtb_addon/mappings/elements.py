"""Elements of a parent scene by the names that a modeller gave them, as RenderToolbox4's mappings do."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches
from typing import NamedTuple

from ..errors import choices
from ..scene.document import Scene
from ..scene.paths import Element, local_name

# broadType -> element of a Collada document.
KINDS = {
    "cameras": "camera",
    "lights": "light",
    "materials": "material",
    "meshes": "geometry",
    "nodes": "node",
}
# The native words that stand for the same elements.
NATIVE_KINDS = {
    "sensor": "cameras",
    "Camera": "cameras",
    "emitter": "lights",
    "LightSource": "lights",
    "bsdf": "materials",
    "Material": "materials",
    "MakeNamedMaterial": "materials",
    "shape": "meshes",
    "Shape": "meshes",
}


class Found(NamedTuple):
    """An element, and what is odd about how it was found; no element where nothing is like the name."""

    element: Element | None
    remark: str = ""


def find_element(document: Scene, broad_type: str, name: str, index: int | None) -> Found:
    """Return the element of a kind that is called so or nearly so; without a name the one of an index."""
    elements = document.of_kind(KINDS[broad_type])
    if not name and (index or 1) <= len(elements):
        return Found(elements[(index or 1) - 1])
    named = [(label, each) for each in elements for label in _labels(document, each)]
    for same in (str, _plain):
        matching = list(dict.fromkeys(each for label, each in named if same(label) == same(name)))
        if matching:
            return Found(matching[(index or 1) - 1 if (index or 1) <= len(matching) else 0])
    near = get_close_matches(name, [label for label, _ in named], n=1)
    if not near:
        there = choices(name, (each.get("name") or each.get("id") for each in elements))
        what = f"called {name}" if name else f"number {index or 1}"
        return Found(None, f"none of the {broad_type} is {what}, so that is left out; there are {there}")
    element = next(each for label, each in named if label == near[0])
    return Found(element, f"none of the {broad_type} is called {name}, {near[0]} was taken")


def _labels(document: Scene, element: Element) -> Iterator[str]:
    """Yield what an element goes by: its name, its id, the names of nodes that show it."""
    yield from filter(None, (element.get("name"), element.get("id")))
    if local_name(element) in ("camera", "light", "geometry"):
        for node in document.users_of(element):
            yield from filter(None, (node.get("name"), node.get("id")))


def _plain(label: str) -> str:
    """Return a name as exporters change it: one case, no dots and blanks, no suffix of the kind."""
    return re.sub(r"-(mesh|light|camera|material)$", "", re.sub(r"[^a-z0-9-]", "_", label.lower()))
