"""A recipe's folder, written whole."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..conditions import Conditions, format_conditions
from ..files import write_bytes, write_text
from . import locks
from .options import Conventions, MontageOptions, RecipeOptions
from .recipe import CONDITIONS, JSON_MAPPINGS, MAPPINGS, PARENT, Recipe
from .words import RECIPE


def write_recipe(
    folder: Path,
    name: str,
    options: RecipeOptions,
    conventions: Conventions,
    montage: MontageOptions,
    parent: bytes,
    conditions: Conditions,
    mappings: str,
    resources: Mapping[str, bytes],
    provenance: Mapping[str, Any],
    *,
    json_mappings: bool = False,
) -> Recipe:
    """
    Write a recipe's folder and return the recipe; what a folder held besides is kept.

    Parameters
    ----------
    parent : the parent scene, Collada 1.4.1
    mappings : text of the mappings file
    resources : contents of files by their names below resources/
    provenance : who made it, with what
    json_mappings : whether the mappings are RenderToolbox4's JSON
    """
    folder = Path(folder)
    locks.refuse_if_locked(folder)
    old = Recipe.load(folder).words if (folder / RECIPE).is_file() else {}
    for file, content in resources.items():
        write_bytes(folder / "resources" / file, content)
    write_bytes(folder / PARENT, parent)
    written, other = (JSON_MAPPINGS, MAPPINGS) if json_mappings else (MAPPINGS, JSON_MAPPINGS)
    write_text(folder / written, mappings)
    (folder / other).unlink(missing_ok=True)
    if conditions.variables:
        write_text(folder / CONDITIONS, format_conditions(conditions))
    else:
        (folder / CONDITIONS).unlink(missing_ok=True)
    recipe = Recipe(folder, name, options, conventions, montage, provenance, old)
    recipe.save()
    return recipe
