"""Measured numbers in panels: a name, a value and its unit in a line that fits the sidebar."""

LEFT = 0.4  # of the width, for the names; Blender's own properties take as much


def number(value: float) -> str:
    """Return three digits of a value."""
    return f"{value:.3g}"


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
