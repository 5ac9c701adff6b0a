"""A column of the table, twice."""

import bpy

from ..rtb_addon.blender.table_edits import duplicate_variable
from .table_verbs import ColumnVerb


class RTB_OT_duplicate_variable(ColumnVerb, bpy.types.Operator):
    """Put a copy of the active variable's column beside it"""

    bl_idname = "rtb.duplicate_variable"
    bl_label = "Duplicate Variable"

    def edit(self, context):
        duplicate_variable(context.scene.rtb)
