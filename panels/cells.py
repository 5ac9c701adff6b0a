"""A cell of the table, drawn as its variable's type wants it."""

import bpy

from ..rtb_addon.blender.table_properties import numbers_of
from .spectrum_menus import draw_menu

# The view of a cell's text that a type has, and how many numbers that takes.
_VIEWS = {"NUMBER": ("number", 1), "COLOUR": ("colour", 3)}


def draw_cell(layout, cell, kind: str, emboss: bool = False) -> None:
    """Draw the field of a cell; a text that is not of its type stays a text, in red."""
    view, count = _VIEWS.get(kind, ("value", 0))
    if kind == "OBJECT":
        layout.prop_search(cell, "value", bpy.data, "objects", text="")
    elif count and len(numbers_of(cell.value)) != count:
        red = layout.row(align=True)
        red.alert = bool(cell.value.strip())
        red.prop(cell, "value", text="", emboss=emboss)
    else:
        layout.prop(cell, view, text="", emboss=emboss or view == "colour")


def draw_wide_cell(layout, cell, kind: str) -> None:
    """Draw the field of a cell with all the width there is, and the menu of spectra where one may stand."""
    line = layout.row(align=True)
    draw_cell(line, cell, kind, emboss=True)
    if kind in ("SPECTRUM", "TEXT"):
        draw_menu(line, "CELL")
