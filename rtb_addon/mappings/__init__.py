"""
The mappings of a recipe: what each condition changes in the parent scene.

Two syntaxes say the same: RenderToolbox3's blocks of lines, and RenderToolbox4's JSON. Reading finds
blocks or changes; filling in, once for each condition, puts the row's values into those that apply and
sorts them into edits of the document, neutral objects and native lines.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from ..conditions import Condition, decoded
from ..errors import RecipeError
from ..scene.adjustments import Adjustments, Remark
from .blocks import Block, format_blocks, parse_blocks
from .changes import Change, format_changes, parse_changes
from .default_mappings import default_mappings
from .fill_blocks import fill_blocks
from .fill_changes import fill_changes
from .filling import Filling

if TYPE_CHECKING:
    from ..scene.document import Scene

__all__ = [
    "Mappings",
    "default_mappings",
    "format_blocks",
    "format_changes",
    "format_mappings",
    "parse_mappings",
    "read_mappings",
]

FindFile = Callable[[str], Path | None]


@dataclass(frozen=True)
class Mappings:
    """
    A mappings file, kept whole.

    Parameters
    ----------
    text : of the file
    file : its name, for messages; one that ends in .json holds RenderToolbox4's syntax
    """

    text: str = ""
    file: str = "mappings.txt"

    @property
    def is_json(self) -> bool:
        """Whether it holds RenderToolbox4's syntax."""
        return Path(self.file).suffix.lower() == ".json"

    @cached_property
    def blocks(self) -> tuple[Block, ...]:
        """Its blocks, in the order of the file; none in JSON."""
        return self._parsed[0]

    @cached_property
    def changes(self) -> tuple[Change, ...]:
        """Its changes, in the order of the file; none but in JSON."""
        return parse_changes(self.text, self.file) if self.is_json else ()

    @cached_property
    def _parsed(self) -> tuple[tuple[Block, ...], tuple[Remark, ...]]:
        return ((), ()) if self.is_json else parse_blocks(self.text, self.file)

    def fill_in(
        self, condition: Condition, renderer: str, document: Scene, find_file: FindFile
    ) -> Adjustments:
        """
        Return what the mappings say for one condition and one renderer.

        Parameters
        ----------
        document : the parent scene as it is before any mapping, where ``[path]`` looks
        find_file : returns the recipe's file of a name, or None
        """
        filling = Filling(self.file, condition, document, find_file, list(self._parsed[1]))
        if self.is_json:
            return fill_changes(self.changes, filling, renderer)
        return fill_blocks(self.blocks, filling, renderer)


def read_mappings(path: Path | str) -> Mappings:
    """Read a mappings file."""
    try:
        content = Path(path).read_bytes()
    except OSError as error:
        raise RecipeError(f"cannot read the mappings {path}: {error.strerror}") from error
    return parse_mappings(decoded(content), path)


def parse_mappings(text: str, file: str | Path) -> Mappings:
    """Return the mappings in a text, of the syntax that its file's name tells; raise what is wrong."""
    mappings = Mappings(text, str(file))
    _ = mappings.blocks, mappings.changes  # reading is what raises
    return mappings


def format_mappings(mappings: Mappings) -> str:
    """Return the text of a mappings file, its comments and blanks as they were."""
    return mappings.text
