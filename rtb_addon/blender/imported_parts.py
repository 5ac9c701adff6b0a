"""A recipe taken apart into what scenes of Blender can hold: rows of one parent scene and mappings file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import PurePath
from typing import NamedTuple

from ..conditions import Condition
from ..recipe import Recipe
from ..recipe.condition_scene import adjustments_of
from ..scene.adjustments import Adjustments, Removal
from ..scene.document import Scene
from .baked import PARENT_COLUMNS
from .conditions import IMAGE_NAME
from .json_mappings import as_blocks

# Columns that say what belongs to a part, which its scene then has.
_OF_PARTS = (*PARENT_COLUMNS, "mappingsFile")


class Part(NamedTuple):
    """
    Rows of a recipe that a scene of Blender holds.

    Parameters
    ----------
    name : of the recipe that it becomes
    rows : of the table
    document : their parent scene, without what their mappings delete
    mappings : their mappings, in blocks
    columns : cells of each variable, which the rows have or the blocks need
    """

    name: str
    rows: Sequence[Condition]
    document: Scene
    mappings: str
    columns: Mapping[str, Sequence[str]]


def parts_of(recipe: Recipe) -> list[Part]:
    """Return the parts of a recipe, the rows of each in their order."""
    together: dict[tuple, list[Condition]] = {}
    for row in recipe.conditions:
        key = row.parent_scene, row.cells.get("mappingsFile", ""), _removals(recipe, row)
        together.setdefault(key, []).append(row)
    names = _names(recipe.name, [key[0] for key in together])
    return [
        _part(recipe, name, rows, removals)
        for name, ((*_, removals), rows) in zip(names, together.items(), strict=True)
    ]


def _part(recipe: Recipe, name: str, rows: Sequence[Condition], removals: tuple[str, ...]) -> Part:
    document, mappings = recipe.parent_of(rows[0]), recipe.mappings_of(rows[0])
    columns = {
        variable: [row.cells[variable] for row in rows]
        for variable in dict.fromkeys(recipe.conditions.variables)
        if variable not in (IMAGE_NAME, *_OF_PARTS)
    }
    text = mappings.text
    if mappings.is_json:
        text, added = as_blocks(recipe, rows, removals)
        columns |= added
    if removals:
        edits = tuple(Removal(id, mappings.file, 0) for id in removals)
        document = document.adjusted(Adjustments(edits=edits))
    return Part(name, rows, document, text, columns)


def _removals(recipe: Recipe, row: Condition) -> tuple[str, ...]:
    """Return the ids that a row's mappings delete, which only those in JSON can."""
    if not recipe.mappings_of(row).is_json:
        return ()
    edits = adjustments_of(recipe, row, recipe.find_file).edits
    return tuple(dict.fromkeys(each.id for each in edits if isinstance(each, Removal)))


def _names(base: str, parents: Sequence[str]) -> list[str]:
    """Return a name for each part: after its parent scene where these differ, else with a number."""
    if len(parents) == 1:
        return [base]
    stems = [PurePath(each.replace("\\", "/")).stem or "parent" for each in parents]
    if len({each.casefold() for each in stems}) < len(stems):
        stems = [str(number) for number in range(1, len(parents) + 1)]
    return [f"{base}-{stem}" for stem in stems]
