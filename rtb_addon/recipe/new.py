"""A new recipe from Python, with as little said as possible."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..conditions import Conditions, parse_conditions
from ..errors import RecipeError
from ..scene.archives import taken_out
from ..scene.document import Scene
from . import CONDITIONS, PARENT, Recipe, write_recipe
from .options import Conventions, MontageOptions, RecipeOptions
from .words import RECIPE

_AS_EVER, _SI = MontageOptions(), Conventions()


def new_recipe(
    folder: Path | str,
    parent: bytes | Path | str,
    *,
    conditions: str = "",
    mappings: str = "",
    resources: Mapping[str, bytes] | None = None,
    conventions: Conventions = _SI,
    montage: MontageOptions = _AS_EVER,
    **options: Any,
) -> Recipe:
    """
    Write the folder of a new recipe, called as the folder is, and return the recipe.

    Parameters
    ----------
    parent : the parent scene, Collada 1.4.1, or the file that holds it; a .zae's pictures become resources
    conditions, mappings : texts of these files; empty: one condition, nothing changed
    resources : contents of files by their names below resources/
    options : of RecipeOptions, such as width=64 or renderer="tracer"
    """
    folder = Path(folder)
    if (folder / RECIPE).exists():
        raise RecipeError(f"{folder} holds a recipe already, load it or name a new folder")
    try:
        chosen = RecipeOptions(**options)
    except (ValueError, TypeError) as error:
        raise RecipeError(str(error)) from error
    name = folder.absolute().name
    content = parent if isinstance(parent, bytes) else _bytes_of(Path(parent))
    Scene.parse(content, PARENT)
    content, packed = taken_out(content, PARENT)
    return write_recipe(
        folder,
        name,
        chosen,
        conventions,
        montage,
        content,
        parse_conditions(conditions, CONDITIONS, name) if conditions else Conditions.single(name),
        mappings,
        {**packed, **(resources or {})},
        {},
    )


def _bytes_of(file: Path) -> bytes:
    try:
        return file.read_bytes()
    except OSError as error:
        raise RecipeError(f"cannot read the parent scene {file}: {error.strerror}") from error
