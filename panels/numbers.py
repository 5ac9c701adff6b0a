"""Measured numbers in panels: a name, a value and its unit in a line that fits the sidebar."""

from __future__ import annotations

import math
from collections.abc import Sequence

PREFIXES = {-4: "p", -3: "n", -2: "µ", -1: "m", 0: "", 1: "k", 2: "M", 3: "G"}
LEFT = 0.4  # of the width, for the names; Blender's own properties take as much


def number(value: float) -> str:
    """Return three digits of a value."""
    return f"{value:.3g}"


def in_prefix(values: Sequence[float]) -> tuple[str, str]:
    """Return some values of one unit as short as they can be read, and the prefix that their unit gets."""
    high = max(map(abs, values), default=0.0)
    place = min(max(math.floor(math.log10(high) / 3), -4), 3) if high > 0 else 0
    return " ".join(f"{each / 1000.0**place:.3g}" for each in values), PREFIXES[place]


def draw_numbers(layout, rows) -> None:
    """Draw (name, value) pairs below each other, as Blender's properties are."""
    column = layout.column(align=True)
    column.scale_y = 0.85
    for name, value in rows:
        split = column.split(factor=LEFT)
        left = split.row()
        left.alignment = "RIGHT"
        left.label(text=name)
        split.label(text=value)
