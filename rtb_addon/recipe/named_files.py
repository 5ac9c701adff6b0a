"""The files that a recipe names: in its table, in its mappings for every renderer, in its parent scenes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from html import unescape
from pathlib import Path
from typing import TYPE_CHECKING

from .. import renderers
from ..errors import RecipeError
from ..scene.archives import taken_out

if TYPE_CHECKING:
    from ..conditions import Condition
    from . import Recipe

_TEXTURE = re.compile(rb"<(?:\w+:)?init_from[^>]*>\s*(?:<(?:\w+:)?ref>\s*)?([^<]+?)\s*<")
_FILE_NAME = re.compile(r"\.[A-Za-z][A-Za-z0-9]{1,4}$")
# Renderers whose blocks old recipes have, whether they are installed here or not.
_OLD = ("pbrt",)


class NamedFiles:
    """
    What a recipe's names lead to.

    Attributes
    ----------
    found : files by the names that lead to them
    missing : a sentence for each name that leads nowhere
    """

    def __init__(self, recipe: Recipe) -> None:
        self.found: dict[str, Path] = {}
        self.missing: dict[str, str] = {}
        self._recipe = recipe
        for condition in recipe.conditions:
            self._look_up_names_of(condition)

    def find(self, name: str) -> Path | None:
        """Look a name up and remember the outcome."""
        try:
            file = self._recipe.find_file(name)
        except RecipeError as error:
            file, self.missing[name] = None, str(error)
        if file is not None:
            self.found[name] = file
        elif _FILE_NAME.search(name):
            self.missing.setdefault(name, f"{name} is not in the recipe's folder")
        return file

    def _look_up_names_of(self, condition: Condition) -> None:
        recipe = self._recipe
        document, mappings = recipe.parent_of(condition), recipe.mappings_of(condition)
        for file in (recipe.parent_file(condition), Path(mappings.file)):
            if file.is_file():
                self.found[file.name] = file
        for name in texture_names(recipe.parent_file(condition)):
            self.find(name)
        for renderer in self._renderers_of(condition):
            with suppress(RecipeError):  # what is wrong with a block is for check to say
                mappings.fill_in(condition, renderer, document, self.find)

    def _renderers_of(self, condition: Condition) -> Iterator[str]:
        names = (self._recipe.options_of(condition).renderer, *renderers.names(), *_OLD)
        yield from dict.fromkeys(names)


def texture_names(parent: Path) -> list[str]:
    """Return the files that a parent scene's image library names."""
    state = parent.stat()
    return _texture_names(parent, state.st_size, state.st_mtime_ns)


@cache
def _texture_names(file: Path, size: int, time: int) -> list[str]:
    """Return the names in a file; size and time only tell when to look again."""
    content = file.read_bytes()
    found = _TEXTURE.findall(taken_out(content, file)[0])
    return sorted({unescape(name.decode(errors="replace")) for name in found})
