"""The table of conditions that a scene holds, from and to the rows of spreadsheets, and filled by designs."""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import RecipeError
from .conditions import IMAGE_NAME, set_conditions
from .migration import kind_of
from .table_edits import add_rows, cells_of, columns

HOW = (
    ("ADD", "New Rows", "A new row for each value, else like the active row; for a single unnamed one", 1),
    ("CROSS", "Every Combination", "Every row there is with each value: a factorial design", 2),
    ("FILL", "Rows There Are", "Down the rows there are, from the first", 3),
)


def table_rows(settings) -> list[list[str]]:
    """Return the whole table, its first row the names of the variables."""
    header = [IMAGE_NAME, *(each.name for each in settings.variables)]
    return [header, *([row.name, *cells_of(settings, row)] for row in settings.conditions)]


def replace_table(scene, rows: Sequence[Sequence[str]]) -> None:
    """Put rows into the place of the table, their first one the names of the variables."""
    if not rows:
        raise RecipeError("an empty table, its first row must name the variables")
    header = list(rows[0])
    if len(set(header)) < len(header) or not all(header):
        raise RecipeError(f"every column needs a name of its own, these are {', '.join(header)}")
    for number, row in enumerate(rows[1:], 2):
        if len(row) > len(header):
            raise RecipeError(f"row {number} has {len(row)} cells for {len(header)} variables")
    filled = [[*row, *[""] * (len(header) - len(row))] for row in rows[1:]]
    set_conditions(scene, header, filled)
    scene.rtb.active_variable = scene.rtb.active_condition = 0


def append_rows(settings, rows: Sequence[Sequence[str]]) -> int:
    """
    Add rows to the table and return how many.

    A first row that names variables says which columns the cells are for; unknown ones are added. Without it
    they are for the columns from the left, and a cell more than columns is the condition's name at the front.
    """
    names = [each.name for each in settings.variables]
    first = list(rows[0]) if rows else []
    if IMAGE_NAME in first or (first and not names) or (first and set(first) <= set(names)):
        header, rows = first, rows[1:]
    else:
        widest = max(map(len, rows), default=0)
        header = ([IMAGE_NAME] if widest == len(names) + 1 else []) + names
    for number, row in enumerate(rows, 1):
        if len(row) > len(header):
            raise RecipeError(f"row {number} has {len(row)} cells for {len(header)} columns of the table")
    known = len(names)
    columns(settings, (name for name in header if name != IMAGE_NAME))
    said = [dict(zip(header, row, strict=False)) for row in rows]
    names = [each.name for each in settings.variables]
    add_rows(settings, [(each.get(IMAGE_NAME, ""), [each.get(name, "") for name in names]) for each in said])
    for variable in settings.variables[known:]:
        variable.kind = kind_of(variable.name, [each.get(variable.name, "") for each in said])
    return len(rows)


def fill(
    settings,
    variables: Sequence[str],
    rows: Sequence[Sequence[str]],
    names: Sequence[str],
    how: str,
    kind: str = "",
) -> None:
    """
    Put a design into the table.

    Parameters
    ----------
    variables : the columns that it is for; unknown ones are added
    rows : a value for each of the variables
    names : of each row, for the conditions' names
    how : one of HOW
    kind : of new variables; empty for what fits their values
    """
    known = {each.name for each in settings.variables}
    if how == "FILL" and len(rows) < len(settings.conditions):
        raise RecipeError(f"{len(rows)} values for {len(settings.conditions)} rows, ask for one for each row")
    places = columns(settings, variables)
    if how == "FILL":
        _fill_down(settings, places, rows)
    elif how == "CROSS" and len(settings.conditions):
        _cross(settings, places, rows, names)
    else:
        _add(settings, places, rows, names)
    for place, name in zip(places, variables, strict=True):
        if name not in known:
            cells = [cells_of(settings, row)[place] for row in settings.conditions]
            settings.variables[place].kind = kind or kind_of(name, cells)
    settings.active_variable = places[0]


def _add(settings, places, rows, names) -> None:
    there = len(settings.conditions)
    pattern = cells_of(settings, settings.conditions[settings.active_condition]) if there else []
    pattern = pattern or [""] * len(settings.variables)
    if there == 1 and not settings.conditions[0].name:
        settings.conditions.clear()  # what the first variable began the table with, and was never named
    add_rows(settings, [(n, _with(pattern, places, row)) for row, n in zip(rows, names, strict=True)])


def _cross(settings, places, rows, names) -> None:
    before = [(each.name, cells_of(settings, each)) for each in settings.conditions]
    settings.conditions.clear()
    design = list(zip(rows, names, strict=True))
    crossed = [
        ("-".join(filter(None, (said, name))), _with(cells, places, row))
        for said, cells in before
        for row, name in design
    ]
    add_rows(settings, crossed)


def _fill_down(settings, places, rows) -> None:
    for condition, row in zip(settings.conditions, rows, strict=False):
        cells = _with(cells_of(settings, condition), places, row)
        for index, value in enumerate(cells):
            (condition.cells[index] if index < len(condition.cells) else condition.cells.add()).value = value


def _with(cells: Sequence[str], places: Sequence[int], values: Sequence[str]) -> list[str]:
    filled = list(cells)
    for place, value in zip(places, values, strict=True):
        filled[place] = value
    return filled
