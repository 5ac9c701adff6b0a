"""Rows of a spreadsheet into the table."""

import bpy

from ..rtb_addon.blender.table_texts import append_rows, replace_table
from ..rtb_addon.errors import RecipeError
from ..rtb_addon.spreadsheets import parse_rows
from .table_verbs import TableVerb


class RTB_OT_paste_conditions(TableVerb, bpy.types.Operator):
    """Add the rows of a spreadsheet from the clipboard; a first row of names says which columns they fill"""

    bl_idname = "rtb.paste_conditions"
    bl_label = "Paste Conditions"

    text: bpy.props.StringProperty(
        name="Text", description="What is pasted; empty for the clipboard", options={"SKIP_SAVE", "HIDDEN"}
    )
    replace: bpy.props.BoolProperty(name="Replace the Table", options={"SKIP_SAVE"})

    def edit(self, context):
        rows = parse_rows(self.text or context.window_manager.clipboard)
        if not rows:
            raise RecipeError("the clipboard holds no text, copy cells in a spreadsheet first")
        if self.replace:
            replace_table(context.scene, rows)
            return f"{len(rows) - 1} conditions pasted"
        return f"{append_rows(context.scene.rtb, rows)} conditions pasted"
