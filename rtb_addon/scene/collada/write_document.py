"""A whole Collada document, and the nodes of its visual scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from lxml import etree
from numpy.typing import ArrayLike

from ..placement import Placement
from .write_elements import Element, new
from .write_meshes import LongTexts
from .write_numbers import number, numbers

# A document needs a time; one that changed would make the same scene another file.
_TIME = "1970-01-01T00:00:00"


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


def transform(where: Placement | ArrayLike) -> list[Element]:
    """Return a node's transform: separate parts as Blender's exporter called them, or a (4, 4) matrix."""
    if not isinstance(where, Placement):
        return [new("matrix", sid="transform", text=numbers(where))]
    turns = [
        new("rotate", sid=f"rotation{axis}", text=f"{numbers(np.eye(3)[k])} {number(where.rotation[k])}")
        for k, axis in ((2, "Z"), (1, "Y"), (0, "X"))
    ]
    location = new("translate", sid="location", text=numbers(where.location))
    return [location, *turns, new("scale", sid="scale", text=numbers(where.scale))]


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
