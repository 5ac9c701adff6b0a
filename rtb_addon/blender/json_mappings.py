"""RenderToolbox4's mappings as blocks, which Blender keeps: filled in, what varies becomes columns."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from ..conditions import Condition
from ..errors import RecipeError
from ..recipe import Recipe
from ..recipe.condition_scene import adjustments_of
from ..scene.adjustments import Adjustments, MatrixEdit, PathEdit
from ..scene.collada.ids import clean
from ..scene.collada.write_numbers import number, numbers
from ..scene.placement import placement_of

Line = tuple[str, str, str]  # block, left side, value; declarations have no value


def as_blocks(
    recipe: Recipe, rows: Sequence[Condition], removals: Sequence[str] = ()
) -> tuple[str, dict[str, list[str]]]:
    """
    Return a text of blocks that says the same for some rows, and new columns: a cell for each of the rows.

    Rows for which other things change than for others have blocks of their own, of a group that they name.

    Parameters
    ----------
    removals : ids that are deleted elsewhere, so that nothing need be said of them
    """
    alike: dict[tuple, dict[int, list[Line]]] = {}
    for place, row in enumerate(rows):
        lines = list(_lines(adjustments_of(recipe, row, recipe.find_file), removals))
        alike.setdefault(tuple((kind, left) for kind, left, _ in lines), {})[place] = lines
    columns: dict[str, list[str]] = {}
    if len(alike) > 1:
        columns["groupName"] = [""] * len(rows)
    texts = []
    for count, members in enumerate(alike.values(), 1):
        group = f"group{count}" if len(alike) > 1 else ""
        for place in members if group else ():
            columns["groupName"][place] = group
        texts.append(_blocks(members, group, len(rows), columns))
    return "".join(texts), columns


def _blocks(members: Mapping[int, list[Line]], group: str, count: int, columns: dict[str, list[str]]) -> str:
    """Return the blocks of rows for which the same things change; what varies becomes columns."""
    blocks: list[str] = []
    before = ""
    for same in zip(*members.values(), strict=True):
        kind, left, _ = same[0]
        if kind != before:
            blocks.append(f"{'}' + chr(10) if before else ''}{kind}{f' {group}' if group else ''} {{")
            before = kind
        cells = dict(zip(members, (value for *_, value in same), strict=True))
        blocks.append(f"    {left}{_value(left, cells, count, columns)}")
    return "\n".join([*blocks, "}", ""]) if blocks else ""


def _value(left: str, cells: Mapping[int, str], count: int, columns: dict[str, list[str]]) -> str:
    """Return the right side of a line, a variable where it is not the same everywhere."""
    first = next(iter(cells.values()))
    if not first:
        return ""
    if len(set(cells.values())) == 1:
        return f" = {first}"
    name = clean(left).strip("_")
    while name in columns:
        name += "_"
    columns[name] = [cells.get(place, first) for place in range(count)]  # others do not ask
    return f" = ({name})"


def _lines(said: Adjustments, removals: Sequence[str]) -> Iterator[Line]:
    for edit in said.edits:
        if isinstance(edit, PathEdit) and edit.path.split(":")[0] not in removals:
            yield "Collada", edit.path, edit.value
        elif isinstance(edit, MatrixEdit) and edit.node not in removals:
            yield from _placed(edit)
    for each in said.objects:
        if each.category:
            yield "Generic", f"{each.id}:{each.category}:{each.model}", ""
        for one in each.properties:
            kind = f".{one.type}" if one.type else ""
            yield "Generic", f"{each.id}:{one.name}{kind}", one.value
    for line in said.native:
        left, _, value = line.text.partition(" = ")
        yield line.block or "Mitsuba", left, value


def _placed(edit: MatrixEdit) -> Iterator[Line]:
    where = placement_of(np.reshape(edit.numbers, (4, 4)))
    if where is None:
        raise RecipeError(f"its mappings shear {edit.node}, which Blender's transforms cannot say")
    yield "Collada", f"{edit.node}:translate|sid=location", numbers(where.location)
    for k, axis in enumerate("XYZ"):
        turned = f"{numbers(np.eye(3)[k])} {number(where.rotation[k])}"
        yield "Collada", f"{edit.node}:rotate|sid=rotation{axis}", turned
    yield "Collada", f"{edit.node}:scale|sid=scale", numbers(where.scale)
