"""A recipe taken apart into what scenes of Blender can hold: rows of one parent scene and mappings file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import PurePath
from typing import NamedTuple

from ..conditions import Condition
from ..recipe import Recipe
from ..recipe.condition_scene import adjustments_of
from ..scene.adjustments import Adjustments, MatrixEdit, Removal
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
    placed : ids of nodes whose place the mappings set as one matrix
    mappings : their mappings, in blocks
    columns : cells of each variable, which the rows have or the blocks need
    """

    name: str
    rows: Sequence[Condition]
    document: Scene
    placed: frozenset[str]
    mappings: str
    columns: Mapping[str, Sequence[str]]


def parts_of(recipe: Recipe) -> list[Part]:
    """Return the parts of a recipe, the rows of each in their order."""
    together: dict[tuple, list[tuple[Condition, Adjustments]]] = {}
    for row in recipe.conditions:
        said = _said(recipe, row)
        removals = tuple(dict.fromkeys(each.id for each in said.edits if isinstance(each, Removal)))
        key = row.parent_scene, row.cells.get("mappingsFile", ""), removals
        together.setdefault(key, []).append((row, said))
    names = _names(recipe.name, [key[0] for key in together])
    return [
        _part(recipe, name, [row for row, _ in pairs], [said for _, said in pairs], removals)
        for name, ((*_, removals), pairs) in zip(names, together.items(), strict=True)
    ]


def _part(
    recipe: Recipe,
    name: str,
    rows: Sequence[Condition],
    said: Sequence[Adjustments],
    removals: Sequence[str],
) -> Part:
    document, mappings = recipe.parent_of(rows[0]), recipe.mappings_of(rows[0])
    columns = {
        variable: [row.cells[variable] for row in rows]
        for variable in dict.fromkeys(recipe.conditions.variables)
        if variable not in (IMAGE_NAME, *_OF_PARTS)
    }
    text = mappings.text
    if mappings.is_json:
        text, added = as_blocks(said, removals)
        columns |= added
    if removals:
        edits = tuple(Removal(id, mappings.file, 0) for id in removals)
        document = document.adjusted(Adjustments(edits=edits))
    placed = frozenset(each.node for one in said for each in one.edits if isinstance(each, MatrixEdit))
    return Part(name, rows, document, placed, text, columns)


def _said(recipe: Recipe, row: Condition) -> Adjustments:
    """Return what a row's mappings say where they are in JSON, which Blender does not keep."""
    if not recipe.mappings_of(row).is_json:
        return Adjustments()
    return adjustments_of(recipe, row, recipe.find_file)


def _names(base: str, parents: Sequence[str]) -> list[str]:
    """Return a name for each part: after its parent scene where these differ, else with a number."""
    if len(parents) == 1:
        return [base]
    stems = [PurePath(each.replace("\\", "/")).stem or "parent" for each in parents]
    if len({each.casefold() for each in stems}) < len(stems):
        stems = [str(number) for number in range(1, len(parents) + 1)]
    return [f"{base}-{stem}" for stem in stems]
