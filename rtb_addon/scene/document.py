"""The parent scene: a Collada document that is read, addressed, and changed only in copies."""

from __future__ import annotations

import codecs
import copy
import re
from collections.abc import Iterable
from functools import cached_property
from pathlib import Path
from typing import Any

from ..errors import RecipeError, at, choices
from .adjustments import Adjustments, Edit, Remark
from .edits import apply
from .paths import Element, local_name, parse_path, read

_DECLARED = re.compile(rb"""^\s*<\?xml[^>]*?encoding\s*=\s*["']([\w.-]+)["'][^>]*\?>""")
# Those in which "<!" is what it is in ASCII.
_ENCODINGS = {"utf-8", "ascii", "iso8859-1", "iso8859-15", "cp1252"}
# lxml keeps no line numbers above this one.
_LAST_LINE = 65534


class Scene:
    """
    A Collada document; treat it as immutable.

    Attributes
    ----------
    root : its root element
    file : its name, for messages
    remarks : what was odd about the edits that made it
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
        """Return the document in some bytes; it may hold no document type, hence no entities."""
        from lxml import etree

        text = _utf8(data, file)
        # Entities in attributes are expanded even with resolve_entities off, so none get that far.
        if b"<!DOCTYPE" in text or b"<!ENTITY" in text:
            raise RecipeError("a parent scene may declare no document type and no entities", file)
        parser = etree.XMLParser(
            encoding="utf-8", resolve_entities=False, no_network=True, load_dtd=False, huge_tree=True
        )
        try:
            root: Any = etree.fromstring(text, parser)
        except etree.XMLSyntaxError as error:
            raise RecipeError(f"this is no XML: {error.msg}", file, error.lineno or None) from error
        if local_name(root) != "COLLADA":
            raise RecipeError(f"this is a {local_name(root)} document, want Collada 1.4", file)
        return cls(root, file)

    @cached_property
    def ids(self) -> tuple[str, ...]:
        """Every id, in the order of the document."""
        return tuple(self._by_id)

    def element(self, id: str) -> Element | None:
        """Return the element with an id, or None."""
        return self._by_id.get(id)

    @cached_property
    def _by_id(self) -> dict[str, Element]:
        return {each.get("id"): each for each in self.root.xpath("//*[@id]")}

    def linked(self, url: str | None, what: str) -> Element:
        """Return the element that a link like ``#Cube-mesh`` leads to."""
        if url and url.startswith("#") and (found := self.element(url[1:])) is not None:
            return found
        known = self.root.xpath("//*[local-name()=$what]/@id", what=what)
        raise RecipeError(f"there is no {what} {url}, only {choices((url or '')[1:], known)}", self.file)

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


def _utf8(data: bytes, file: str | Path) -> bytes:
    """Return a document's bytes in UTF-8: what is searched must be just what is parsed."""
    declared = _DECLARED.match(data.removeprefix(codecs.BOM_UTF8))
    name = declared[1].decode() if declared else "utf-8"
    wide = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    try:
        codec = "utf-16" if wide else codecs.lookup(name).name
        if not wide and codec not in _ENCODINGS:
            raise LookupError
        return data if codec == "utf-8" else data.decode(codec).encode()
    except LookupError:
        raise RecipeError(f"its encoding is {name}, save it as UTF-8", file) from None
    except UnicodeError as error:
        raise RecipeError(f"its text is not {name}: {error}", file) from error
