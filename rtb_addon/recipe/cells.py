"""Options that a row of the table says for its condition."""

from __future__ import annotations

from typing import Any

from ..conditions import Condition

_COLUMNS = {"renderer": "renderer", "width": "imageWidth", "height": "imageHeight", "camera": "camera"}


def options_in(condition: Condition) -> dict[str, Any]:
    """Return the options that a condition's row sets, by their names in recipe.json."""
    cells = condition.cells
    return {name: _cell_value(name, cells[column]) for name, column in _COLUMNS.items() if column in cells}


def _cell_value(option: str, text: str) -> Any:
    """Return a cell as an option's value; of several numbers the first counts, as in RenderToolbox3."""
    if option == "renderer":
        return text.strip().lower()
    if option == "camera":
        return text.strip()
    try:
        return int(float(text.split()[0]))
    except (ValueError, IndexError, OverflowError):
        return text
