"""
What tells parent scenes of a family apart, as values at paths that mappings can set.

Scenes that differ in nothing else share one document; those whose triangles or nodes differ need one each.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from .paths import Element, find, local_name, parse_path, write

# What a lamp shows to readers without mappings; ours say its spectrum.
_SHOWN = re.compile(r":technique_common:\w+:color\|sid=color$")
_GEOMETRIES = (b"<library_geometries>", b"</library_geometries>")


class Told(NamedTuple):
    """
    Parent scenes told apart.

    Parameters
    ----------
    contents : for each scene the document that it shares with those that are like it
    values : path -> for each scene the text that stands there
    """

    contents: list[bytes]
    values: dict[str, list[str]]


def told_apart(contents: Sequence[bytes]) -> Told:
    """Return which documents a family of parent scenes needs, and what mappings set in them."""
    if all(content is contents[0] for content in contents):  # a look into a big one takes its time
        return Told(list(contents), {})
    distinct = {content: _Skeleton(content) for content in dict.fromkeys(contents)}
    groups: dict[bytes, list[_Skeleton]] = {}
    for each in distinct.values():
        groups.setdefault(each.bones, []).append(each)
    paths = list(dict.fromkeys(path for group in groups.values() for path in _differing(group)))
    if not all(path in each.texts for path in paths for each in distinct.values()):
        return Told(list(contents), {})  # what one group sets, another has not
    first = {each: group[0].content for group in groups.values() for each in (one.content for one in group)}
    values = {path: [distinct[content].texts[path] for content in contents] for path in paths}
    return Told([first[content] for content in contents], values)


class _Skeleton:
    """
    A document with its settable texts taken out.

    Attributes
    ----------
    bones : all the rest
    texts : by their paths
    """

    def __init__(self, content: bytes) -> None:
        from lxml import etree

        self.content = content
        start, end = content.find(_GEOMETRIES[0]), content.find(_GEOMETRIES[1])
        meshes = content[start:end] if 0 <= start < end else b""
        root = etree.fromstring(content[:start] + content[end + len(_GEOMETRIES[1]) :] if meshes else content)
        self.texts: dict[str, str] = {}
        for element in root.iter("{*}*"):
            if len(element) == 0 and element.text and (path := _path_of(root, element)):
                self.texts[path] = element.text
        for path in self.texts:
            write(root, parse_path(path), "=", "")
        self.bones = etree.tostring(root) + meshes


def _differing(group: Sequence[_Skeleton]) -> list[str]:
    texts = ((path, {each.texts[path] for each in group}) for path in group[0].texts)
    return [path for path, found in texts if len(found) > 1 and not _SHOWN.search(path)]


def _path_of(root: Element, element: Element) -> str:
    """Return a path that leads to an element, nothing where none does."""
    steps: list[str] = []
    above = element
    while above is not None and not above.get("id"):
        sid, profile = above.get("sid"), above.get("profile")
        key = f"|sid={sid}" if sid else f"|profile={profile}" if profile else ""
        steps.insert(0, local_name(above) + key)
        above = above.getparent()
    if above is None:
        return ""
    path = ":".join([above.get("id"), *steps])
    try:
        return path if find(root, parse_path(path)) is element else ""
    except ValueError:
        return ""
