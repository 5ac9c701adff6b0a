"""Files of earlier versions, brought to how this one keeps a recipe."""

from __future__ import annotations

import bpy

from ..errors import RecipeError
from .table_edits import cells_of, spoken_fields
from .table_properties import numbers_of

SCHEMA = 2  # 2: variables have types


def migrate() -> None:
    """Bring every scene of the open file up to date, and write down that it is."""
    for scene in bpy.data.scenes:
        if scene.library is None and scene.rtb.schema < SCHEMA:
            if scene.rtb.schema < 2:
                _type_variables(scene)
            scene.rtb.schema = SCHEMA


def refuse_newer(scene) -> None:
    """Raise where a file comes from a later version, whose words this one may not know."""
    if scene.rtb.schema > SCHEMA:
        raise RecipeError(
            f"the scene {scene.name} was made by a later RenderToolbox, take that one to write its recipe"
        )


def _type_variables(scene) -> None:
    """Give variables the types that their uses and cells tell."""
    for number, variable in enumerate(scene.rtb.variables):
        cells = [cells_of(scene.rtb, row)[number] for row in scene.rtb.conditions]
        variable.kind = kind_of(variable.name, cells)


def kind_of(name: str, cells: list[str]) -> str:
    """Return the type that fits a variable: what it is used for, else what all its cells are."""
    if any(f"({name})" in getattr(owner, field) for owner, field in spoken_fields()):
        return "SPECTRUM"
    said = [cell for cell in cells if cell.strip()]
    if said and all(len(numbers_of(cell)) == 1 for cell in said):
        return "NUMBER"
    if said and all(cell in bpy.data.objects for cell in said):
        return "OBJECT"
    return "TEXT"
