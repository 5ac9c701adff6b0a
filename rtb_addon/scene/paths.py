"""
Addresses in a scene document: ``Camera:translate|sid=location`` or ``Sun-light.name``.

An id, then children by name (the first one, or the one whose attribute is as said), then perhaps an
attribute; a final ``$`` means the name instead of the value. None of ``. : $`` can be part of a word.
"""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from ..spectra.text import format_number

# An lxml element; this module needs no more of lxml than the elements that it is given.
Element = Any

_NUMBER = re.compile(r"\s*([+-]?(?:(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|inf|nan))(?=\s|$|[^\d.])", re.I)
_ARITHMETIC: dict[str, Callable[[float, float], float]] = {
    "+=": operator.add,
    "-=": operator.sub,
    "*=": operator.mul,
    "/=": operator.truediv,
}


class Child(NamedTuple):
    """A child element by its name; with a key and a value, the one that has such an attribute."""

    name: str
    key: str = ""
    value: str = ""


@dataclass(frozen=True)
class ScenePath:
    """An address taken apart; ``naming`` says that it ends in ``$``."""

    text: str
    id: str
    children: tuple[Child, ...] = ()
    attribute: str = ""
    naming: bool = False


def parse_path(text: str) -> ScenePath:
    """Return the parts of an address; ValueError with one sentence when it is none."""
    first, *parts = re.split(r"(?=[.:$])", text.strip())
    naming = bool(parts) and parts[-1] == "$"
    parts = parts[: len(parts) - naming]
    attribute = parts.pop()[1:] if parts and parts[-1][0] == "." else ""
    children = tuple(_child(part, text) for part in parts)
    if not first or any(not child.name for child in children):
        raise ValueError(f"cannot read the path '{text}', want id:child|sid=name.attribute")
    return ScenePath(text.strip(), first, children, attribute, naming)


def find(root: Element, path: ScenePath) -> Element | None:
    """Return the element that a path leads to (the owner of its attribute), or None."""
    found = find_id(root, path.id)
    for child in path.children:
        found = None if found is None else _find_child(found, child)
    return found


def find_id(root: Element, name: str) -> Element | None:
    """Return the element with an id, the last of several; ``document`` is what holds the root."""
    if name == "document":
        return root.getroottree()
    return (root.xpath("//*[@id=$name]", name=name) or [None])[-1]


def read(root: Element, path: ScenePath) -> str | None:
    """Return the text, attribute or name that a path leads to; None where there is none."""
    element = find(root, path)
    if element is None or not hasattr(element, "tag"):
        return None
    if path.attribute:
        return (
            None
            if (value := element.get(path.attribute)) is None
            else path.attribute
            if path.naming
            else value
        )
    if path.naming:
        return local_name(element)
    return element.text if len(element) == 0 else None


def write(root: Element, path: ScenePath, operation: str, text: str) -> bool:
    """
    Change what a path leads to, making what is missing; return whether its id was there.

    Parameters
    ----------
    operation : ``=``, or one of ``+= -= *= /=`` on lists of numbers, a single number going to all
    """
    known = find_id(root, path.id)
    found = _made(root, Child("merge", "id", path.id)) if known is None else known
    for child in path.children:
        nearer = _find_child(found, child)
        found = _made(found, child) if nearer is None else nearer
    if not hasattr(found, "tag"):
        raise ValueError(f"the path '{path.text}' leads to the whole document, name an element in it")
    if path.naming:
        _rename(found, path.attribute, text)
    elif path.attribute:
        found.set(path.attribute, _combined(found.get(path.attribute, ""), operation, text))
    else:
        _set_text(found, _combined(found.text or "" if len(found) == 0 else "", operation, text))
    return known is not None


def local_name(element: Element) -> str:
    """Return an element's name without its namespace; empty for comments."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""


def numbers_in(text: str) -> list[float]:
    """Return the numbers at the beginning of a text, up to the first thing that is none."""
    found, place = [], 0
    while match := _NUMBER.match(text, place):
        found.append(float(match[1]))
        place = match.end()
    return found


def _child(part: str, path: str) -> Child:
    words = re.split(r"[=|]", part[1:])
    if part[0] != ":" or len(words) > 3:
        raise ValueError(f"cannot read '{part}' in the path '{path}', want :child or :child|name=value")
    return Child(*words)


def _find_child(parent: Element, child: Child) -> Element | None:
    below = parent if hasattr(parent, "tag") else [parent.getroot()]
    for element in below:
        checked = not (child.key and child.value) or element.get(child.key) == child.value
        if local_name(element) == child.name and checked:
            return element
    return None


def _made(parent: Element, child: Child) -> Element:
    if not hasattr(parent, "tag"):
        raise ValueError(f"the document's root is no {child.name}")
    namespace = parent.tag[: parent.tag.rindex("}") + 1] if parent.tag.startswith("{") else ""
    element = parent.makeelement(namespace + child.name)
    if child.key:
        element.set(child.key, child.value)
    parent.append(element)
    return element


def _rename(element: Element, attribute: str, name: str) -> None:
    if not re.fullmatch(r"[^\W\d][\w.-]*", name):
        raise ValueError(f"'{name}' cannot be the name of an element or attribute")
    if not attribute:
        element.tag = element.tag[: element.tag.rfind("}") + 1] + name
        return
    renamed = {name if key == attribute else key: value for key, value in element.attrib.items()}
    element.attrib.clear()
    element.attrib.update(renamed)


def _set_text(element: Element, text: str) -> None:
    for child in list(element):
        element.remove(child)
    element.text = text


def _combined(old: str, operation: str, new: str) -> str:
    if operation == "=":
        return new
    left, right = numbers_in(old) or [0.0], numbers_in(new)
    if not right:
        raise ValueError(f"{operation} needs numbers, got '{new}'")
    if len(left) != len(right) and 1 not in (len(left), len(right)):
        raise ValueError(f"{operation} on {len(left)} numbers needs as many or one, got {len(right)}")
    size = max(len(left), len(right))
    pairs = zip(left * (size // len(left)), right * (size // len(right)), strict=True)
    try:
        changed = [_ARITHMETIC[operation](a, b) for a, b in pairs]
    except ZeroDivisionError:
        raise ValueError("/= by zero") from None
    if not all(map(math.isfinite, changed)):
        raise ValueError(f"'{old}' {operation} '{new}' is no finite number")
    return " ".join(map(format_number, changed))
