"""Another name for a column of the table."""

import bpy

from ..rtb_addon.blender.table_edits import rename_variable
from .table_verbs import ColumnVerb


class RTB_OT_rename_variable(ColumnVerb, bpy.types.Operator):
    """Rename the active variable, also in the spectra that name it"""

    bl_idname = "rtb.rename_variable"
    bl_label = "Rename Variable"

    name: bpy.props.StringProperty(name="Name", description="What (name) stands for in a spectrum")

    def invoke(self, context, event):
        settings = context.scene.rtb
        self.name = settings.variables[settings.active_variable].name
        return context.window_manager.invoke_props_dialog(self, confirm_text="Rename")

    def edit(self, context):
        rename_variable(context.scene.rtb, self.name.strip())
