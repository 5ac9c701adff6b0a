"""A row of the table, twice."""

import bpy

from ..rtb_addon.blender.table_edits import duplicate_row
from .table_verbs import RowVerb


class RTB_OT_duplicate_condition(RowVerb, bpy.types.Operator):
    """Put a copy of the active condition below it"""

    bl_idname = "rtb.duplicate_condition"
    bl_label = "Duplicate Condition"

    def edit(self, context):
        duplicate_row(context.scene.rtb)
