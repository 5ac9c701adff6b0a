"""Edits of the table of conditions that a scene holds: rows, columns, and what is said of them elsewhere."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

import bpy

from ..errors import RecipeError, choices
from .conditions import IMAGE_NAME
from .fields import fields_of, group_of

_NO_NAME = re.compile(r"[()\t\r\n]")
# What may name a variable in its spectra: lists of things, and what fields.py calls one of them.
_THINGS = {"materials": "material", "lights": "light", "worlds": "world", "objects": "object"}
# Of them those spectra that have a colour and are the thing's own.
SPECTRA = tuple(
    (home, tuple(field.name for field in fields_of(word) if not (field.within or field.index)))
    for home, word in _THINGS.items()
)


def add_row(settings, name: str = "", cells: Sequence[str] = ()) -> None:
    """Add a condition at the end and make it the active one."""
    add_rows(settings, [(name, cells)])


def add_rows(settings, rows: Iterable[tuple[str, Sequence[str]]]) -> None:
    """Add conditions, each a name and cells, at the end, and make the last one active."""
    taken, count = {each.name for each in settings.conditions}, len(settings.variables)
    for name, cells in rows:
        row = settings.conditions.add()
        row.name = free_name(name, taken)
        taken.add(row.name)
        for value in [*cells[:count], *[""] * (count - len(cells))]:
            row.cells.add().value = value
    settings.active_condition = max(len(settings.conditions) - 1, 0)


def cells_of(settings, row) -> list[str]:
    """Return a row's cells, as many as there are variables."""
    cells = [each.value for each in row.cells][: len(settings.variables)]
    return cells + [""] * (len(settings.variables) - len(cells))


def remove_row(settings) -> None:
    """Remove the active condition."""
    settings.conditions.remove(settings.active_condition)
    settings.active_condition = max(min(settings.active_condition, len(settings.conditions) - 1), 0)


def duplicate_row(settings) -> None:
    """Put a copy of the active condition below it."""
    source, place = settings.conditions[settings.active_condition], settings.active_condition + 1
    add_row(settings, source.name, cells_of(settings, source))
    settings.conditions.move(len(settings.conditions) - 1, place)
    settings.active_condition = place


def move_row(settings, by: int) -> None:
    """Move the active condition down, or up by a negative number of rows."""
    place = min(max(settings.active_condition + by, 0), len(settings.conditions) - 1)
    settings.conditions.move(settings.active_condition, place)
    settings.active_condition = place


def add_variable(settings, name: str, value: str = "", kind: str = "TEXT") -> int:
    """Add a column whose every cell says the same, make it the active one, and return its index."""
    _refuse_name(settings, name)
    cells = [cells_of(settings, row) for row in settings.conditions]
    variable = settings.variables.add()
    variable.name, variable.kind = name, kind
    for row, said in zip(settings.conditions, cells, strict=True):
        _set_cells(row, [*said, value], len(settings.variables))
    settings.active_variable = len(settings.variables) - 1
    return settings.active_variable


def remove_variable(settings) -> None:
    """Remove the active column."""
    index = settings.active_variable
    for row in settings.conditions:
        if index < len(row.cells):
            row.cells.remove(index)
    settings.variables.remove(index)
    settings.active_variable = max(min(index, len(settings.variables) - 1), 0)


def duplicate_variable(settings) -> None:
    """Put a copy of the active column at its right."""
    index = settings.active_variable
    name = free_name(settings.variables[index].name, [each.name for each in settings.variables])
    said = [cells_of(settings, row)[index] for row in settings.conditions]
    add_variable(settings, name, kind=settings.variables[index].kind)
    for row, value in zip(settings.conditions, said, strict=True):
        row.cells[-1].value = value
    move_variable(settings, index + 1 - settings.active_variable)


def move_variable(settings, by: int) -> None:
    """Move the active column to the right, or to the left by a negative number of columns."""
    index = settings.active_variable
    place = min(max(index + by, 0), len(settings.variables) - 1)
    for row in settings.conditions:
        _set_cells(row, cells_of(settings, row), len(settings.variables))
        row.cells.move(index, place)
    settings.variables.move(index, place)
    settings.active_variable = place


def rename_variable(settings, name: str) -> None:
    """Rename the active column, also where spectra of this file and mappings of this scene name it."""
    variable = settings.variables[settings.active_variable]
    if name == variable.name:
        return
    _refuse_name(settings, name)
    for owner, field in spoken_fields():
        text = getattr(owner, field)
        if f"({variable.name})" in text and not owner.id_data.library:
            setattr(owner, field, text.replace(f"({variable.name})", f"({name})"))
    for mapping in settings.mappings:
        mapping.value = mapping.value.replace(f"({variable.name})", f"({name})")
    if (text := settings.mappings_text) is not None and f"({variable.name})" in (said := text.as_string()):
        text.from_string(said.replace(f"({variable.name})", f"({name})"))
    variable.name = name


def columns(settings, names: Iterable[str]) -> list[int]:
    """Return the indices of variables; those that are not there are added, or none if one has a bad name."""
    wanted, there = list(dict.fromkeys(names)), [each.name for each in settings.variables]
    new = [name for name in wanted if name not in there]
    for name in new:
        _refuse_name(settings, name)
    for name in new:
        add_variable(settings, name)
    return [[*there, *new].index(name) for name in wanted]


def refuse_unknown(settings, name: str) -> None:
    """Raise a sentence if no variable is called that."""
    if name not in (names := [each.name for each in settings.variables]):
        raise RecipeError(f"no variable is called {name}, there are {choices(name, names)}")


def free_name(name: str, taken: Iterable[str]) -> str:
    """Return a name that is not taken, also not in other letters' case: blue, blue-2, blue-3 ..."""
    known = {each.casefold() for each in taken if each}
    number, found = 1, name
    while found.casefold() in known:
        number += 1
        found = f"{re.sub(r'-[0-9]+$', '', name)}-{number}"
    return found


def spoken_fields() -> Iterator[tuple[bpy.types.PropertyGroup, str]]:
    """Yield everything of the file that may name a variable: its owner and the property."""
    for kind, word in _THINGS.items():
        fields = list(fields_of(word))
        for thing in getattr(bpy.data, kind):
            yield from ((group_of(thing, field), field.name) for field in fields)


def _set_cells(row, cells: Sequence[str], count: int) -> None:
    for index in range(count):
        cell = row.cells[index] if index < len(row.cells) else row.cells.add()
        cell.value = cells[index] if index < len(cells) else ""


def _refuse_name(settings, name: str) -> None:
    if not name.strip() or name != name.strip() or _NO_NAME.search(name):
        raise RecipeError(f"'{name}' cannot name a variable, use a word like paint")
    if name == IMAGE_NAME:
        raise RecipeError(f"{IMAGE_NAME} is the name of the condition itself, choose another word")
    if name in [each.name for each in settings.variables]:
        raise RecipeError(f"a variable is called {name} already, choose another word")
