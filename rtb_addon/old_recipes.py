"""RenderToolbox3's files become a recipe folder that holds all they need."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from functools import cached_property
from pathlib import Path, PurePosixPath
from typing import Literal
from urllib.parse import unquote

from . import renderers
from .batch import records
from .conditions import Condition, Conditions, decoded, parse_conditions
from .errors import RecipeError
from .files import write_text
from .mappings import Mappings, parse_mappings
from .recipe import CONDITIONS, Recipe, write_recipe
from .recipe.named_files import texture_names
from .recipe.options import Conventions, MontageOptions, RecipeOptions
from .recipe.resources import leads_outside, listed
from .scene.archives import files_beside, is_archive, read_archive
from .scene.document import Scene
from .spectra.library import served

# What RenderToolbox3 did when no mappings file was named: its renderers mirrored the camera's x axis.
DEFAULT_MAPPINGS = """\
% RenderToolbox3's default mappings: mirror the camera's x axis back
Collada {
    Camera:scale|sid=scale = -1 1 1
}
"""
# Of RenderToolbox3's defaults: direct light only, in a small image.
_OPTIONS = RecipeOptions(width=320, height=240, integrator="direct", depth=2)
_FILE_NAME = re.compile(r"\.[A-Za-z][A-Za-z0-9]{1,4}$")


def import_recipe(
    parent: Path,
    conditions: Path | None,
    mappings: Path | None,
    folder: Path,
    *,
    units: Literal["si", "rtb3"] = "si",
    data: Sequence[Path] = (),
    options: RecipeOptions = _OPTIONS,
) -> tuple[Recipe, list[str]]:
    """
    Write a recipe folder from old files and return the recipe with one sentence for each oddity.

    Parameters
    ----------
    parent : the parent scene, Collada
    conditions, mappings : the old tables; None: one condition, RenderToolbox3's default mappings
    folder : of the new recipe
    units : si, or rtb3: light spectra stay total power
    data : folders to search for files that are not beside these, nor in a resources/ there
    options : how to render
    """
    name = re.sub(r"[^\w .-]", "_", parent.stem).strip(" .") or "recipe"
    scene, table_text = _bytes_of(parent), _text_of(conditions)
    packed: dict[str, bytes] = {}
    if is_archive(scene):
        archive = read_archive(scene, parent)
        scene, packed = archive.scene, archive.beside_the_scene()
    mappings_text = DEFAULT_MAPPINGS if mappings is None else _text_of(mappings)
    table = (
        parse_conditions(table_text, conditions, name, old=True) if conditions else Conditions.single(name)
    )
    changes = parse_mappings(mappings_text, mappings or name)
    search = Search([path.parent for path in (parent, conditions, mappings) if path], data)
    wanted = _Wanted(search)
    wanted.of_parent(parent)
    wanted.of_family(Scene.parse(scene, parent), table, changes)
    recipe = write_recipe(
        folder,
        name,
        options,
        # RenderToolbox4 mirrored cameras by itself, its files hold no mirroring.
        Conventions(units, "blender" if changes.is_json else "rtb3"),
        MontageOptions(),
        scene,
        table,
        mappings_text,
        {**packed, **{_target(each): file.read_bytes() for each, file in wanted.found.items()}},
        {
            "imported from": [path.name for path in (parent, conditions, mappings) if path],
            "library version": records.library_version(),
        },
        json_mappings=changes.is_json,
    )
    if conditions and not table.left_out:  # with its comments
        write_text(recipe.folder / CONDITIONS, table_text)
    return recipe, [*map(str, table.remarks), *wanted.sentences()]


class Search:
    """
    Looks files up beside the old ones and in data folders, and nowhere else.

    Parameters
    ----------
    beside : folders of the old files; only they and their resources/ are searched
    data : folders that are searched with everything below
    """

    def __init__(self, beside: Iterable[Path], data: Iterable[Path]) -> None:
        self._beside = [place for folder in dict.fromkeys(beside) for place in (folder, folder / "resources")]
        self._data = list(data)
        for folder in self._data:
            if not folder.is_dir():
                raise RecipeError(f"{folder} is no folder, --data must name folders")

    def find(self, name: str) -> Path | None:
        """Return the file of a name; one that leads elsewhere is looked up by its base name, as ever."""
        for plain in dict.fromkeys((name.replace("\\", "/"), unquote(name.removeprefix("file://")))):
            base = PurePosixPath(plain.replace("\\", "/")).name
            wanted = [base] if leads_outside(plain) else [plain, base]
            for place in (*self._beside, *self._data):
                for each in wanted:
                    if each and os.path.isfile(place / each) and self._inside(place / each):  # noqa: PTH113
                        return place / each
            if base in self._below_data:
                return self._below_data[base]
        return None

    def _inside(self, file: Path) -> bool:
        folders = (*self._beside, *self._data)
        return any(file.resolve().is_relative_to(folder.resolve()) for folder in folders)

    @cached_property
    def _below_data(self) -> dict[str, Path]:
        found: dict[str, Path] = {}
        for folder in self._data:
            for place, below, files in os.walk(folder):
                below.sort()
                for name in sorted(files):
                    if self._inside(Path(place) / name):
                        found.setdefault(name, Path(place) / name)
        return found


class _Wanted:
    """The files that a recipe names: those found, and those missing."""

    def __init__(self, search: Search) -> None:
        self.found: dict[str, Path] = {}
        self._missing: dict[str, None] = {}
        self._search = search

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
            for renderer in dict.fromkeys((_OPTIONS.renderer, "pbrt", *renderers.names())):
                # What only another renderer's block has wrong is said when that one is to render.
                with suppress(*([] if renderer == _OPTIONS.renderer else [RecipeError])):
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
            mappings = parse_mappings(_text_of(file), file)
        return document, mappings


def _target(name: str) -> str:
    """Return where below resources/ a file of a name goes, such that the recipe finds it by that name."""
    plain = unquote(name.removeprefix("file://")).replace("\\", "/")
    path = PurePosixPath(plain)
    if leads_outside(plain):
        return path.name
    return str(path.relative_to("resources")) if path.parts[0] == "resources" else str(path)


def _bytes_of(file: Path) -> bytes:
    try:
        return file.read_bytes()
    except OSError as error:
        raise RecipeError(f"cannot read {file}: {error.strerror}") from error


def _text_of(file: Path | None) -> str:
    return "" if file is None else decoded(_bytes_of(file))
