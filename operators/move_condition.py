"""A row of the table to another place."""

import bpy

from ..rtb_addon.blender.table_edits import move_row
from .table_verbs import RowVerb


class RTB_OT_move_condition(RowVerb, bpy.types.Operator):
    """Move the active condition up or down"""

    bl_idname = "rtb.move_condition"
    bl_label = "Move Condition"

    by: bpy.props.IntProperty(name="Rows", description="Down, or up if negative", default=1)

    def edit(self, context):
        move_row(context.scene.rtb, self.by)
