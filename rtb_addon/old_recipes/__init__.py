"""RenderToolbox3's files become a recipe folder that holds all they need."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from ..batch import records
from ..conditions import Conditions, parse_conditions
from ..files import write_text
from ..mappings import parse_mappings
from ..recipe import CONDITIONS, Conventions, MontageOptions, Recipe, RecipeOptions, write_recipe
from ..scene.archives import taken_out
from ..scene.document import Scene
from .search import Search
from .wanted import Wanted, bytes_of, place_below_resources, text_of

# What RenderToolbox3 did when no mappings file was named: its renderers mirrored the camera's x axis.
DEFAULT_MAPPINGS = """\
% RenderToolbox3's default mappings: mirror the camera's x axis back
Collada {
    Camera:scale|sid=scale = -1 1 1
}
"""
# Of RenderToolbox3's defaults: direct light only, in a small image.
_OPTIONS = RecipeOptions(width=320, height=240, integrator="direct", depth=2)


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
    files = [path for path in (parent, conditions, mappings) if path]
    name = re.sub(r"[^\w .-]", "_", parent.stem).strip(" .") or "recipe"
    scene, packed = taken_out(bytes_of(parent), parent)
    table_text = text_of(conditions) if conditions else ""
    table = (
        parse_conditions(table_text, conditions, name, old=True) if conditions else Conditions.single(name)
    )
    changes_text = text_of(mappings) if mappings else DEFAULT_MAPPINGS
    changes = parse_mappings(changes_text, mappings or name)
    wanted = Wanted(Search([path.parent for path in files], data), _OPTIONS.renderer)
    wanted.of_parent(parent)
    wanted.of_family(Scene.parse(scene, parent), table, changes)
    found = {place_below_resources(each): file.read_bytes() for each, file in wanted.found.items()}
    recipe = write_recipe(
        folder,
        name,
        options,
        # RenderToolbox4 mirrored cameras by itself, its files hold no mirroring.
        Conventions(units, "blender" if changes.is_json else "rtb3"),
        MontageOptions(),
        scene,
        table,
        changes_text,
        {**packed, **found},
        {"imported from": [path.name for path in files], "library version": records.library_version()},
        json_mappings=changes.is_json,
    )
    if conditions and not table.left_out:  # with its comments
        write_text(recipe.folder / CONDITIONS, table_text)
    return recipe, [*map(str, table.remarks), *wanted.sentences()]
