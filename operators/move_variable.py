"""A column of the table to another place."""

import bpy

from ..rtb_addon.blender.table_edits import move_variable
from .table_verbs import ColumnVerb


class RTB_OT_move_variable(ColumnVerb, bpy.types.Operator):
    """Move the active variable's column to the left or right"""

    bl_idname = "rtb.move_variable"
    bl_label = "Move Variable"

    by: bpy.props.IntProperty(name="Columns", description="To the right, or left if negative", default=1)

    def edit(self, context):
        move_variable(context.scene.rtb, self.by)
