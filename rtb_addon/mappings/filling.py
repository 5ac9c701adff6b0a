"""One condition's values put into the texts of a mappings file."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from ..conditions import Condition
from ..errors import choices
from ..scene.adjustments import Remark
from ..scene.paths import find, parse_path, read

if TYPE_CHECKING:
    from ..scene.document import Scene

_UNFILLED = re.compile(r"\(([A-Za-z_]\w*)\)")
_FILE_NAME = re.compile(r"\.\S*$")
_NUMBERS = re.compile(r"[-+.\d:eE\s]*")


@dataclass
class Filling:
    """
    One condition's values, and where to look things up.

    Parameters
    ----------
    file : the mappings file's name
    document : the parent scene as it is before any mapping
    find_file : returns the recipe's file of a name, or None
    remarks : what is odd, so far
    """

    file: str
    condition: Condition
    document: Scene
    find_file: Callable[[str], Path | None]
    remarks: list[Remark] = field(default_factory=list)

    @property
    def group(self) -> str:
        """The group of blocks that this condition chooses; empty for all of them."""
        return self.condition.cells.get("groupName", "")

    def remark(self, message: str, line: int) -> None:
        """Say that a line is odd."""
        self.remarks.append(Remark(message, self.file, line))

    def substituted(self, text: str) -> str:
        """Return a text with ``(variable)`` replaced, the table's columns in their order."""
        for variable, cell in self.condition.cells.items():
            text = text.replace(f"({variable})", cell)
        return text

    def unknown_variable(self, text: str) -> str:
        """Return what to say about a variable that nobody filled in, or nothing."""
        if (unknown := _UNFILLED.search(text)) is None:
            return ""
        known = choices(unknown[1], self.condition.cells)
        return f"no variable is called {unknown[1]}, the conditions have {known}"

    def found(self, value: str) -> Path | None:
        """Return the file that a value names: a dot, then no more blanks, tells that it may be one."""
        plain = not _FILE_NAME.search(value) or _NUMBERS.fullmatch(value)
        return None if plain else self.find_file(value)

    def at_path(self, text: str, line: int) -> str:
        """Return what the untouched parent scene holds at a path; nothing, with a remark, for no place."""
        path = parse_path(text)
        element = find(self.document.root, path)
        value = read(self.document.root, path)
        if value is None and element is not None and not path.attribute:
            raise ValueError(f"what the parent scene holds at [{text}] is no text but other elements")
        if value is None:
            self.remark(f"the parent scene has nothing at [{text}], the value is empty", line)
        return value or ""
