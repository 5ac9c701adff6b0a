"""The table to a spreadsheet."""

import bpy

from ..rtb_addon.blender.table_texts import table_rows
from ..rtb_addon.spreadsheets import format_rows


class RTB_OT_copy_conditions(bpy.types.Operator):
    """Copy the whole table to the clipboard, ready to be pasted into a spreadsheet"""

    bl_idname = "rtb.copy_conditions"
    bl_label = "Copy Conditions"
    bl_options = {"REGISTER"}

    def execute(self, context):
        rows = table_rows(context.scene.rtb)
        context.window_manager.clipboard = format_rows(rows)
        self.report({"INFO"}, f"{len(rows) - 1} conditions are in the clipboard")
        return {"FINISHED"}
