"""What old recipes name: their textures, spectra and tables."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from .. import renderers
from ..conditions import Condition, Conditions, decoded
from ..errors import RecipeError
from ..mappings import Mappings, parse_mappings
from ..recipe.named_files import texture_names
from ..recipe.resources import leads_outside, listed
from ..scene.archives import files_beside
from ..scene.document import Scene
from ..spectra.library import served
from .search import Search

_FILE_NAME = re.compile(r"\.[A-Za-z][A-Za-z0-9]{1,4}$")


class Wanted:
    """
    The files that a recipe names: those found, and those missing.

    Parameters
    ----------
    search : finds files
    renderer : that is to render the recipe
    """

    def __init__(self, search: Search, renderer: str) -> None:
        self.found: dict[str, Path] = {}
        self._missing: dict[str, None] = {}
        self._search, self._renderer = search, renderer

    def find(self, name: str) -> Path | None:
        """Look a name up and remember the outcome."""
        if name not in self.found and (file := self._search.find(name)) is not None:
            self.found[name] = file
        if name not in self.found and _FILE_NAME.search(name):
            self._missing[name] = None
        return self.found.get(name)

    def of_parent(self, parent: Path) -> None:
        """Find the textures of a parent scene that its archive does not hold."""
        held = {PurePosixPath(name).name for name in files_beside(parent)}
        for name in texture_names(parent):
            if PurePosixPath(unquote(name)).name not in held:
                self.find(name)

    def of_family(self, document: Scene, conditions: Conditions, mappings: Mappings) -> None:
        """Find what the rows of a table and the mappings that apply to them name."""
        for condition in conditions:
            scene, changes = self._own(condition, document, mappings)
            for renderer in dict.fromkeys((self._renderer, "pbrt", *renderers.names())):
                # What only another renderer's block has wrong is said when that one is to render.
                with suppress(*([] if renderer == self._renderer else [RecipeError])):
                    changes.fill_in(condition, renderer, scene, self.find)

    def sentences(self) -> Iterator[str]:
        """Yield what somebody should know about files that were not found."""
        stand_ins = [name for name in self._missing if served(name) is not None]
        if stand_ins:
            yield f"not found, the library's own will be served: {listed(stand_ins)}"
        for name in self._missing:
            if name not in stand_ins:
                yield f"{name} was not found, name its folder with --data or put it into resources/"

    def _own(self, condition: Condition, document: Scene, mappings: Mappings) -> tuple[Scene, Mappings]:
        """Return the parent scene and the mappings of a condition, where its row names its own."""
        if (name := condition.parent_scene) and (file := self.find(name)):
            self.of_parent(file)
            document = Scene.read(file)
        if (name := condition.cells.get("mappingsFile")) and (file := self.find(name)):
            mappings = parse_mappings(text_of(file), file)
        return document, mappings


def place_below_resources(name: str) -> str:
    """Return where below resources/ a file of a name goes, such that the recipe finds it by that name."""
    plain = unquote(name.removeprefix("file://")).replace("\\", "/")
    path = PurePosixPath(plain)
    if leads_outside(plain):
        return path.name
    return str(path.relative_to("resources")) if path.parts[0] == "resources" else str(path)


def bytes_of(file: Path) -> bytes:
    """Return what an old file holds."""
    try:
        return file.read_bytes()
    except OSError as error:
        raise RecipeError(f"cannot read {file}: {error.strerror}") from error


def text_of(file: Path) -> str:
    """Return the text of an old file, in whichever letters it was written."""
    return decoded(bytes_of(file))
