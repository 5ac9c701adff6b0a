"""A row less in the table."""

import bpy

from ..rtb_addon.blender.table_edits import remove_row
from .table_verbs import RowVerb


class RTB_OT_remove_condition(RowVerb, bpy.types.Operator):
    """Remove the active condition; what was rendered of it stays in its folder"""

    bl_idname = "rtb.remove_condition"
    bl_label = "Remove Condition"

    def edit(self, context):
        remove_row(context.scene.rtb)
