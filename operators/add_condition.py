"""A new row of the table."""

import bpy

from ..rtb_addon.blender.table_edits import add_row, cells_of
from .table_verbs import TableVerb


class RTB_OT_add_condition(TableVerb, bpy.types.Operator):
    """Add a condition like the active one"""

    bl_idname = "rtb.add_condition"
    bl_label = "Add Condition"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    def edit(self, context):
        settings = context.scene.rtb
        active = settings.conditions[settings.active_condition : settings.active_condition + 1]
        add_row(settings, "", cells_of(settings, active[0]) if active else ())
