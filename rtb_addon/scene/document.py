"""The parent scene: a Collada document that is read, addressed, and changed only in copies."""

from __future__ import annotations

import copy
import re
from collections.abc import Iterable
from functools import cached_property
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import unquote

from ..errors import RecipeError, at, choices
from .adjustments import Adjustments, Edit, Remark
from .archives import taken_out
from .collada.text import utf8
from .edits import apply
from .paths import Element, local_name, parse_path, read

_ESCAPED = re.compile(r"_x([0-9A-Fa-f]{4})_")
# lxml keeps no line numbers above this one.
_LAST_LINE = 65534


class Scene:
    """
    A Collada document; treat it as immutable.

    Attributes
    ----------
    root : its root element
    file : its name, for messages
    remarks : what was odd about its text and the edits that made it
    """

    def __init__(
        self,
        root: Element,
        file: str | Path,
        edits: tuple[Edit, ...] = (),
        remarks: tuple[Remark, ...] = (),
    ) -> None:
        self.root, self.file, self.remarks = root, str(file), remarks
        self._edits = edits

    @classmethod
    def read(cls, path: Path | str) -> Scene:
        """Read a Collada file."""
        try:
            content = Path(path).read_bytes()
        except OSError as error:
            raise RecipeError(f"cannot read the parent scene {path}: {error.strerror}") from error
        return cls.parse(content, path)

    @classmethod
    def parse(cls, data: bytes, file: str | Path) -> Scene:
        """Return the document in some bytes, or in their archive; it may hold no entities."""
        from lxml import etree

        data, _ = taken_out(data, file)
        text, changes = utf8(data, file)
        parser = etree.XMLParser(
            encoding="utf-8", resolve_entities=False, no_network=True, load_dtd=False, huge_tree=True
        )
        try:
            root: Any = etree.fromstring(text, parser)
        except etree.XMLSyntaxError as error:
            raise RecipeError(f"this is no XML: {error.msg}", file, error.lineno or None) from error
        if local_name(root) != "COLLADA":
            raise RecipeError(f"this is a {local_name(root)} document, want Collada 1.4 or 1.5", file)
        return cls(root, file, remarks=tuple(Remark(each, str(file), None) for each in changes))

    @cached_property
    def ids(self) -> tuple[str, ...]:
        """Every id, in the order of the document."""
        return tuple(self._by_id)

    def element(self, id: str) -> Element | None:
        """Return the element with an id, or None."""
        return self._by_id.get(id)

    @cached_property
    def _by_id(self) -> dict[str, Element]:
        # XPath would sort what it finds, which takes minutes for ten thousand objects.
        return {id: each for each in self.root.iter("{*}*") if (id := each.get("id"))}

    def linked(self, url: str | None, what: str) -> Element:
        """Return the element that a link like ``#Cube-mesh`` leads to."""
        place, _, id = (url or "").partition("#")
        for name in dict.fromkeys((id, unquote(id), _unescaped(id))):
            if name and (found := self.element(name)) is not None:
                return found
        if place and PurePosixPath(unquote(place)).name != Path(self.file).name:
            raise RecipeError(f"the {what} {url} is in another file, export one that holds all", self.file)
        known = self.root.xpath("//*[local-name()=$what]/@id", what=what)
        raise RecipeError(f"there is no {what} {url}, only {choices(id, known)}", self.file)

    def of_kind(self, name: str) -> list[Element]:
        """Return the elements of a name, in the order of the document."""
        return list(self.root.iter(f"{{*}}{name}"))

    def users_of(self, element: Element) -> list[Element]:
        """Return the nodes that place a light, a camera or a geometry."""
        return self._users.get(element.get("id"), [])

    @cached_property
    def _users(self) -> dict[str, list[Element]]:
        found: dict[str, list[Element]] = {}
        for node in self.of_kind("node"):
            for each in node:
                if local_name(each).startswith("instance_") and (url := each.get("url", "")).startswith("#"):
                    found.setdefault(url[1:], []).append(node)
        return found

    def value_at(self, path: str) -> str | None:
        """Return the text or attribute that a path leads to, or None."""
        return read(self.root, parse_path(path))

    def line_of(self, element: Element) -> int | None:
        """Return the line that an element begins on, where it is known."""
        line = element.sourceline
        return line if line and line < _LAST_LINE else None

    def adjusted(self, adjustments: Adjustments) -> Scene:
        """Return a copy with a condition's edits; itself where those are in it already."""
        if adjustments.edits == self._edits:
            return self
        root = copy.deepcopy(self.root)
        remarks = [remark for edit in adjustments.edits for remark in self._applied(root, edit)]
        return Scene(root, self.file, adjustments.edits, (*self.remarks, *remarks))

    def tobytes(self) -> bytes:
        """Return the document as UTF-8."""
        from lxml import etree

        return etree.tostring(self.root, xml_declaration=True, encoding="utf-8")

    def _applied(self, root: Element, edit: Edit) -> Iterable[Remark]:
        with at(edit.file, edit.line):
            missing = apply(root, edit)
        if missing:
            near = choices(missing, self.ids, 5)
            message = f"nothing in {Path(self.file).name} has the id {missing}, there are {near}"
            yield Remark(message, edit.file, edit.line)


def _unescaped(name: str) -> str:
    """Return a name as it was before an exporter wrote ``_x0020_`` for a blank."""
    return _ESCAPED.sub(lambda found: chr(int(found[1], 16)), name)
