"""A recipe: what its folder holds, read when somebody asks, and where its renderings go."""

from __future__ import annotations

import json
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..conditions import Condition, Conditions, read_conditions
from ..errors import RecipeError
from ..files import write_text
from ..mappings import Mappings, read_mappings
from ..scene.document import Scene
from . import locks
from . import words as recipe_words
from .cells import options_in
from .options import Conventions, MontageOptions, RecipeOptions
from .problems import problems
from .resources import Resources
from .words import RECIPE

if TYPE_CHECKING:
    from .remodeler import Remodeler

PARENT, CONDITIONS, MAPPINGS = "parent.dae", "conditions.txt", "mappings.txt"
JSON_MAPPINGS = "mappings.json"  # RenderToolbox4's, where there is no mappings.txt
# Scenes and options that are remembered, however long the table is.
_MOST_BIG = 4


@dataclass(frozen=True, eq=False)
class Recipe:
    """
    A recipe and its folder.

    Parameters
    ----------
    folder : where it lives
    name : of the family; unnamed conditions are called after it
    options : how to render, where neither a condition nor the command line says otherwise
    conventions : what its numbers mean
    montage : how its renderings become one picture
    provenance : who made it, with what
    words : recipe.json as it was found; keys that nobody knows are kept
    overrides : options that the command line sets
    remodeler : code that changes its scenes, once somebody trusts it
    """

    folder: Path
    name: str
    options: RecipeOptions = field(default_factory=RecipeOptions)
    conventions: Conventions = field(default_factory=Conventions)
    montage: MontageOptions = field(default_factory=MontageOptions)
    provenance: Mapping[str, Any] = field(default_factory=dict)
    words: Mapping[str, Any] = field(default_factory=dict, repr=False)
    overrides: Mapping[str, Any] = field(default_factory=dict)
    remodeler: Remodeler | None = field(default=None, repr=False)
    resources: Resources = field(init=False, repr=False)
    _known: dict[Hashable, Any] = field(default_factory=dict, init=False, repr=False)
    _big: dict[Hashable, Any] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "folder", Path(self.folder).absolute())
        object.__setattr__(self, "resources", Resources(self.folder))

    @classmethod
    def load(cls, folder: Path | str) -> Recipe:
        """Read the recipe in a folder; its tables, mappings and scenes are read when somebody asks."""
        file = Path(folder) / RECIPE
        try:
            words = json.loads(file.read_text(encoding="utf-8"))
        except (FileNotFoundError, NotADirectoryError) as error:
            raise RecipeError(f"{folder} is no recipe folder: it holds no {RECIPE}") from error
        except json.JSONDecodeError as error:
            raise RecipeError(f"{error.msg}, it must be JSON", RECIPE, error.lineno) from error
        except UnicodeDecodeError as error:
            raise RecipeError("it must be JSON in UTF-8", RECIPE) from error
        except (ValueError, RecursionError) as error:  # a number or a nesting that only malice writes
            raise RecipeError(f"it cannot be read: {error}", RECIPE) from error
        except OSError as error:
            raise RecipeError(f"it cannot be read: {error.strerror}", RECIPE) from error
        return cls(Path(folder), **recipe_words.parsed(words, Path(folder).absolute().name))

    def save(self) -> None:
        """Write recipe.json, with the keys of others that it held."""
        locks.refuse_if_locked(self.folder)
        sections = {"options": self.options, "conventions": self.conventions, "montage": self.montage}
        words = recipe_words.words_of(self.name, sections, self.provenance, self.words)
        text = json.dumps(words, indent=2, ensure_ascii=False) + "\n"
        write_text(self.folder / RECIPE, text)

    def overridden(self, **options: Any) -> Recipe:
        """Return the recipe with options that win over its conditions; None stands for the recipe's own."""
        said = {name: value for name, value in options.items() if value is not None}
        return replace(self, overrides={**self.overrides, **said})

    @cached_property
    def conditions(self) -> Conditions:
        """The table; one condition called after the recipe when there is none."""
        file = self.folder / CONDITIONS
        return read_conditions(file, self.name) if file.is_file() else Conditions.single(self.name)

    @cached_property
    def mappings(self) -> Mappings:
        """What conditions change in the scene, where none names a mappings file of its own."""
        there = (self.folder / name for name in (MAPPINGS, JSON_MAPPINGS))
        file = next((file for file in there if file.is_file()), None)
        return Mappings() if file is None else self.once(file, lambda: read_mappings(file))

    def mappings_of(self, condition: Condition) -> Mappings:
        """Return the mappings of a condition: the recipe's, or its mappingsFile."""
        if not (name := condition.cells.get("mappingsFile")):
            return self.mappings
        file = self._file_of(condition, name, "mappings file")
        return self.once(file, lambda: read_mappings(file))

    def parent_file(self, condition: Condition) -> Path:
        """Return the parent scene's file of a condition: the recipe's, or its colladaFile."""
        if name := condition.parent_scene:
            return self._file_of(condition, name, "parent scene")
        if not (file := self.folder / PARENT).is_file():
            raise RecipeError(f"{self.folder} holds no {PARENT}, the parent scene of its conditions")
        return file

    def parent_of(self, condition: Condition) -> Scene:
        """Return the parent scene of a condition."""
        file = self.parent_file(condition)
        state = file.stat()  # an edited file is another scene, and has another key
        return self.lately((file, state.st_size, state.st_mtime_ns), lambda: Scene.read(file))

    def options_of(self, condition: Condition) -> RecipeOptions:
        """Return a condition's options: the command line's before the row's before recipe.json's."""
        return self.lately(("options", condition.name), lambda: self._options_of(condition))

    def _options_of(self, condition: Condition) -> RecipeOptions:
        if not (chosen := self.said_for(condition)):
            return self.options
        try:
            return replace(self.options, **chosen)
        except ValueError as error:
            place = (CONDITIONS, condition.line) if condition.line and not self.overrides else (None, None)
            raise RecipeError(str(error), *place) from error

    def said_for(self, condition: Condition) -> dict[str, Any]:
        """Return the options that the command line or a condition's row sets."""
        return {**options_in(condition), **self.overrides}

    def find_file(self, name: str) -> Path | None:
        """Return a file of the recipe by the name that a cell, a mapping or the parent scene gives it."""
        return self.resources.find(name)

    @property
    def scenes_folder(self) -> Path:
        """Where native scenes go, a folder for each renderer."""
        return self.folder / "scenes"

    def rendering_file(self, condition: Condition) -> Path:
        """Return where a condition's radiance cube is kept."""
        return self.folder / "renderings" / self.options_of(condition).renderer / f"{condition.name}.exr"

    def record_file(self, condition: Condition) -> Path:
        """Return where it is written how a condition's cube was made."""
        return self.rendering_file(condition).with_suffix(".json")

    def layers_file(self, condition: Condition) -> Path:
        """Return where a condition's depth, normals, standard errors and other layers are kept."""
        return self.folder / "layers" / self.options_of(condition).renderer / f"{condition.name}.exr"

    def montage_file(self, renderer: str) -> Path:
        """Return where the picture of all conditions is kept."""
        return self.folder / "images" / renderer / f"{self.name}.png"

    def unknown_words(self) -> list[str]:
        """Return one sentence for each key of recipe.json that nobody knows."""
        return recipe_words.unknown(self.words)

    def problems(self) -> list[RecipeError]:
        """Return everything that is wrong with the recipe, not the first thing only."""
        return problems(self)

    def once(self, what: Hashable, find_out: Callable[[], Any]) -> Any:
        """Return what something is, found out the first time that anybody asks this recipe."""
        if what not in self._known:
            self._known[what] = find_out()
        return self._known[what]

    def lately(self, what: Hashable, find_out: Callable[[], Any]) -> Any:
        """Return what something big is; only the last few are kept, however long the table is."""
        known = self._big.pop(what) if what in self._big else find_out()
        self._big[what] = known
        while len(self._big) > _MOST_BIG:
            del self._big[next(iter(self._big))]
        return known

    def _file_of(self, condition: Condition, name: str, what: str) -> Path:
        file = self.find_file(name)
        if file is None:
            raise RecipeError(
                f"the {what} {name} is not in {self.folder}, copy it into resources/",
                CONDITIONS,
                condition.line,
            )
        return file
