"""The table of conditions that a scene holds, as tests look at it."""

import bpy
import pytest

ROWS = [("a", "0.1", "D65"), ("b", "0.2", "A"), ("c", "0.3", "FL2")]


def table(settings) -> list[tuple[str, ...]]:
    return [(row.name, *(cell.value for cell in row.cells)) for row in settings.conditions]


def variables(settings) -> list[str]:
    return [each.name for each in settings.variables]


def column(settings, name: str) -> list[str]:
    index = variables(settings).index(name)
    return [row.cells[index].value for row in settings.conditions]


def sentence(operator, **properties) -> str:
    """Run an operator that must refuse, and return its sentence; the table is as it was."""
    before = table(bpy.context.scene.rtb)
    with pytest.raises(RuntimeError) as caught:
        operator(**properties)
    assert table(bpy.context.scene.rtb) == before
    return str(caught.value).strip()
