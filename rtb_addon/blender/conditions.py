"""The table of conditions that a scene holds."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

IMAGE_NAME = "imageName"
VARIABLE = re.compile(r"\(([^()]+)\)")  # stands for a cell of the condition


def set_conditions(scene, variables: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """
    Replace a scene's table of conditions.

    Parameters
    ----------
    variables : names of the columns; ``imageName`` names the conditions, which else get numbers
    rows : for each condition a cell for each variable, in their order
    """
    from .migration import kind_of  # stands on this

    names, table = list(variables), [list(map(str, row)) for row in rows]
    for number, cells in enumerate(table, 1):
        if len(cells) != len(names):
            raise ValueError(f"row {number} has {len(cells)} cells for {len(names)} variables")
    column = names.index(IMAGE_NAME) if IMAGE_NAME in names else None
    settings = scene.rtb
    own = [[cell for place, cell in enumerate(cells) if place != column] for cells in table]
    settings.variables.clear()
    settings.conditions.clear()
    for name in names:
        if name != IMAGE_NAME:
            settings.variables.add().name = name
    for number, variable in enumerate(settings.variables):
        variable.kind = kind_of(variable.name, [cells[number] for cells in own])
    for cells in table:
        row = settings.conditions.add()
        row.name = "" if column is None else cells.pop(column)
        for cell in cells:
            row.cells.add().value = cell
