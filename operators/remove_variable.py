"""A column less in the table."""

import bpy

from ..rtb_addon.blender.table_edits import remove_variable
from .table_verbs import ColumnVerb


class RTB_OT_remove_variable(ColumnVerb, bpy.types.Operator):
    """Remove the active variable and its column; spectra that name it must say something else"""

    bl_idname = "rtb.remove_variable"
    bl_label = "Remove Variable"

    def edit(self, context):
        remove_variable(context.scene.rtb)
