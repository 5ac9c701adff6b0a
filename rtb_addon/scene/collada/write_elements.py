"""Elements of Collada, as an XML library keeps them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lxml import etree

NAMESPACE = "http://www.collada.org/2005/11/COLLADASchema"
# An lxml element.
Element = Any
Colour = Sequence[float]


def new(tag: str, /, *children: Element, text: str | None = None, **attributes: object) -> Element:
    """Return an element; names of attributes may end in ``_`` where Python needs that."""
    words = {key.rstrip("_"): str(value) for key, value in attributes.items()}
    element = etree.Element(f"{{{NAMESPACE}}}{tag}", words, nsmap={None: NAMESPACE})
    element.text = text
    element.extend(children)
    return element
