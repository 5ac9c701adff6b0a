"""RenderToolbox4's mappings as blocks, which Blender keeps: filled in, what varies becomes columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..errors import RecipeError
from ..recipe import Recipe
from ..recipe.condition_scene import adjustments_of
from ..scene.adjustments import Adjustments, MatrixEdit, PathEdit
from ..scene.collada.ids import clean
from ..scene.collada.write_numbers import number, numbers
from ..scene.placement import placement_of


def as_blocks(recipe: Recipe) -> tuple[str, dict[str, list[str]]]:
    """Return a text of blocks that says the same, and new columns: a cell for each condition."""
    family = [list(_lines(adjustments_of(recipe, row, recipe.find_file))) for row in recipe.conditions]
    if len({tuple((kind, left) for kind, left, _ in lines) for lines in family}) > 1:
        raise RecipeError("its mappings change other things in other conditions, which no table can say")
    columns: dict[str, list[str]] = {}
    blocks: list[str] = []
    before = ""
    for same in zip(*family, strict=True):
        kind, left, _ = same[0]
        if kind != before:
            blocks.append(f"{'}' + chr(10) if before else ''}{kind} {{")
            before = kind
        blocks.append(f"    {left}{_value(left, [value for *_, value in same], columns)}")
    return "\n".join([*blocks, "}", ""]) if blocks else "", columns


def _value(left: str, values: Sequence[str], columns: dict[str, list[str]]) -> str:
    """Return the right side of a line, a variable where it is not the same everywhere."""
    if not values[0]:
        return ""
    if len(set(values)) == 1:
        return f" = {values[0]}"
    name = clean(left).strip("_")
    while name in columns:
        name += "_"
    columns[name] = list(values)
    return f" = ({name})"


def _lines(said: Adjustments) -> Iterator[tuple[str, str, str]]:
    """Yield block, left side and value of each line; declarations have no value."""
    for edit in said.edits:
        if isinstance(edit, PathEdit):
            yield "Collada", edit.path, edit.value
        elif isinstance(edit, MatrixEdit):
            yield from _placed(edit)
        else:
            raise RecipeError(f"its mappings delete {edit.id}: take that out of the parent scene", edit.file)
    for each in said.objects:
        if each.category:
            yield "Generic", f"{each.id}:{each.category}:{each.model}", ""
        for one in each.properties:
            kind = f".{one.type}" if one.type else ""
            yield "Generic", f"{each.id}:{one.name}{kind}", one.value
    for line in said.native:
        left, _, value = line.text.partition(" = ")
        yield line.block or "Mitsuba", left, value


def _placed(edit: MatrixEdit) -> Iterator[tuple[str, str, str]]:
    where = placement_of(np.reshape(edit.numbers, (4, 4)))
    if where is None:
        raise RecipeError(f"its mappings shear {edit.node}, which Blender's transforms cannot say")
    yield "Collada", f"{edit.node}:translate|sid=location", numbers(where.location)
    for k, axis in enumerate("XYZ"):
        turned = f"{numbers(np.eye(3)[k])} {number(where.rotation[k])}"
        yield "Collada", f"{edit.node}:rotate|sid=rotation{axis}", turned
    yield "Collada", f"{edit.node}:scale|sid=scale", numbers(where.scale)
