"""A recipe's folder as it was before anything was rendered."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from . import Recipe
from .locks import locked
from .named_files import NamedFiles
from .resources import GENERATED

# Of batches that were killed, beside what a batch that ended well leaves.
_HALVES = {".unfinished", ".under-way"}


def clean_recipe(recipe: Recipe | Path | str) -> list[Path]:
    """
    Remove what can be rendered again from a recipe's folder and return the files that are gone.

    Native scenes, renderings, layers and pictures go. The table, the mappings, scenes and resources stay,
    and so does the log; a file that the recipe names stays wherever it is.
    """
    recipe = recipe if isinstance(recipe, Recipe) else Recipe.load(recipe)
    named = {path.resolve() for path in NamedFiles(recipe).found.values()}
    with locked(recipe.folder):
        places = [recipe.folder / name for name in sorted(GENERATED | _HALVES)]
        return [path for place in places for path in _emptied(place, named)]


def _emptied(place: Path, inputs: set[Path]) -> list[Path]:
    """Remove all files below a folder but inputs, and the folders that are empty then."""
    gone = []
    for folder, _, files in os.walk(place, topdown=False):
        for path in (Path(folder) / name for name in files):
            if path.resolve() not in inputs:
                path.unlink()
                gone.append(path)
        if not Path(folder).is_symlink():  # a link is how somebody keeps renderings on another disk
            with suppress(OSError):  # it still holds an input
                Path(folder).rmdir()
    return gone
