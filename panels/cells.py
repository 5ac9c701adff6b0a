"""A cell of the table, drawn as its variable's type wants it."""

import bpy

from ..rtb_addon.blender.table_properties import numbers_of
from .spectrum_menus import draw_menu

# The view of a cell's text that a type has, and how many numbers that takes.
_VIEWS = {"NUMBER": ("number", 1), "COLOUR": ("colour", 3)}


def draw_cell(layout, cell, kind: str) -> None:
    """Draw the field of a cell among others of its row; what is not of its type stays a text, in red."""
    if kind == "OBJECT":
        line = layout.row(align=True)
        line.alert = bool(cell.value) and cell.value not in bpy.data.objects
        line.prop(cell, "value", text="", emboss=False)
    elif kind == "SPECTRUM":
        layout.prop(cell, "short", text="", emboss=False)
    else:
        _draw_field(layout, cell, kind, emboss=False)


def draw_wide_cell(layout, cell, kind: str) -> None:
    """Draw the field of a cell with all the width there is, and the menu of spectra where one may stand."""
    line = layout.row(align=True)
    if kind == "OBJECT":
        line.prop_search(cell, "value", bpy.data, "objects", text="")
        return
    _draw_field(line, cell, kind, emboss=True)
    if kind in ("SPECTRUM", "TEXT"):
        draw_menu(line, "CELL")


def _draw_field(layout, cell, kind: str, emboss: bool) -> None:
    view, count = _VIEWS.get(kind, ("value", 0))
    if count and len(numbers_of(cell.value)) != count:
        red = layout.row(align=True)
        red.alert = bool(cell.value.strip())
        red.prop(cell, "value", text="", emboss=emboss)
    else:
        layout.prop(cell, view, text="", emboss=emboss or view == "colour")
