"""A new column of the table."""

import bpy

from ..rtb_addon.blender.table_edits import add_row, add_variable, free_name
from ..rtb_addon.blender.table_properties import KINDS
from .table_verbs import TableVerb


class RTB_OT_add_variable(TableVerb, bpy.types.Operator):
    """Add a variable: a column of the conditions that spectra may name"""

    bl_idname = "rtb.add_variable"
    bl_label = "Add Variable"

    name: bpy.props.StringProperty(name="Name", description="What (name) stands for in a spectrum")
    value: bpy.props.StringProperty(name="Value", description="What every cell says at first")

    kind: bpy.props.EnumProperty(name="Type", description="What its cells hold", items=KINDS)

    def invoke(self, context, event):
        taken = [each.name for each in context.scene.rtb.variables]
        self.name, self.value = free_name("variable", taken), ""
        return context.window_manager.invoke_props_dialog(self, confirm_text="Add")

    def edit(self, context):
        settings = context.scene.rtb
        add_variable(settings, self.name.strip(), self.value, self.kind)
        if not settings.conditions:
            add_row(settings, "", [self.value])
